//! Rays, bounds, scene-graph, acceleration and engines of the raysect ray tracer.
//!
//! This crate knows shapes and places, not light: no material and no wavelength. Another kind of transport could
//! stand on it. A [`World`] is a tree of frames, shapes and observers with something attached to each shape; with
//! `()` attached it is geometry alone:
//!
//! ```
//! use raysect_core::{Node, Ray, World};
//! use raysect_core::testing::Ball;
//! use raysect_math::{Point3D, Vector3D, translate};
//!
//! let mut world = World::<()>::new();
//! world.add(Ball::new(1.0))?;
//! world.add(Node::of(Ball::new(0.5), ()).transform(translate(0.0, 0.0, 3.0)).name("moon"))?;
//!
//! // Where a ray goes in and out of everything along its way:
//! let ray = Ray::new(Point3D::new(0.0, 0.0, -5.0), Vector3D::Z);
//! let distances: Vec<f64> = world.crossings(&ray)?.iter().map(|c| c.distance()).collect();
//! assert_eq!(distances, [4.0, 6.0, 7.5, 8.5]);
//!
//! // What is where:
//! let inside = world.contains(Point3D::new(0.0, 0.0, 3.2))?;
//! assert_eq!(world.name(inside[0])?, "moon");
//! # Ok::<(), raysect_core::CoreError>(())
//! ```
//!
//! The description compiles into a [`Scene`], flat and immutable, at the first question after a change. Rays that
//! start on a surface say so with [`Leaving`]: nothing is moved off a surface by a small distance.

pub mod accel;
mod atomic;
mod bounds;
mod csv;
pub mod engine;
mod error;
mod intersection;
mod primitive;
mod ray;
pub mod save;
mod scene;
pub mod testing;
mod world;

pub use accel::Acceleration;
pub use atomic::write_atomically;
pub use bounds::{BoundingBox2D, BoundingBox3D, BoundingSphere3D};
pub use csv::{csv_number, csv_text};
pub use engine::{Engine, Multicore, Serial};
pub use error::{CoreError, EngineError};
pub use intersection::Intersection;
pub use primitive::{
    Crossing, Departure, DirectionSample, Feature, Primitive, Scratch, Surface, SurfaceSample,
    SurfaceSampling,
};
pub use ray::{Interval, Ray};
pub use scene::{Candidate, Instance, Leaving, Scene, SurfacePoint};
pub use world::{Attachment, Node, NodeId, NodeKind, World};
