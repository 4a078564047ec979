//! Geometric shapes of the raysect ray tracer.
//!
//! A shape is described in its own space and placed by the transform of its node. Constructors refuse impossible
//! dimensions with an error that names them; `Default` gives Raysect's default shape.
//!
//! ```
//! use raysect_core::{Node, Ray, World};
//! use raysect_math::{Point3D, Vector3D, translate};
//! use raysect_primitive::{Cuboid, Sphere};
//!
//! let mut world = World::<()>::new();
//! world.add(Cuboid::centred(2.0, 2.0, 2.0)?)?;
//! world.add(Node::of(Sphere::new(0.5)?, ()).transform(translate(0.0, 0.0, 4.0)))?;
//! let hits = world.crossings(&Ray::new(Point3D::new(0.0, 0.0, -3.0), Vector3D::Z))?;
//! let distances: Vec<f64> = hits.iter().map(|h| h.distance()).collect();
//! assert_eq!(distances, [2.0, 4.0, 6.5, 7.5]);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! A shape of your own implements [`Primitive`](raysect_core::Primitive); test it with
//! [`check_primitive`](raysect_core::testing::check_primitive).

mod chord;
mod cone;
mod csg;
mod cuboid;
mod cylinder;
mod error;
mod inner;
mod lens;
pub mod mesh;
mod parabola;
mod register;
mod revolution;
mod select;
mod sphere;
mod torus;
mod unit;

#[cfg(test)]
mod double_double;
#[cfg(test)]
mod judges;

pub use cone::Cone;
pub use csg::{Intersect, Operand, Place, Subtract, Union};
pub use cuboid::Cuboid;
pub use cylinder::Cylinder;
pub use error::PrimitiveError;
pub use lens::{BiConcave, BiConvex, LensFace, Meniscus, PlanoConcave, PlanoConvex};
pub use mesh::{Mesh, MeshBuilder, MeshData, MeshError, MeshHealth};
pub use parabola::Parabola;
pub use register::register;
pub use sphere::Sphere;
pub use torus::Torus;
