//! A spectral, double-precision Monte Carlo ray tracer for physics and engineering.
//!
//! raysect follows light through scenes of exact shapes and measured materials, and puts an error bar on every
//! number. It is a new implementation of the ideas of [Raysect](https://www.raysect.org) (A. Meakins, M. Carr et
//! al.) in Rust.
//!
//! # A first picture
//! A world is a tree of shapes with materials; a camera observes it, and pipelines keep what it sees:
//!
//! ```
//! use raysect::prelude::*;
//!
//! fn main() -> raysect::Result<()> {
//!     let mut world = World::new();
//!     let ground = Cuboid::new(Point3D::new(-50.0, -1.51, -50.0), Point3D::new(50.0, -1.5, 50.0))?;
//!     world.add(ground.material(Lambert::new(0.6)).name("ground"))?;
//!     world.add(Sphere::new(1.5)?.material(schott("N-BK7")?).transform(translate(0.0, 0.0, 4.0)))?;
//!     let wall = Cuboid::new(Point3D::new(-10.0, -10.0, 10.0), Point3D::new(10.0, 10.0, 10.1))?;
//!     world.add(wall.material(Checkerboard::new(4.0)?).transform(rotate(45.0, 0.0, 0.0)))?;
//!
//!     let camera = PinholeCamera::new((32, 32), 45.0)?
//!         .transform(translate(0.0, 0.0, -6.0))
//!         .spectral_bins(15)
//!         .pixel_samples(16);
//!     println!("{}", camera.plan(&world)?);              // what is modelled, what is not, and why
//!
//!     let mut rgb = RgbPipeline2D::new();
//!     let report = camera.observe(&world, &mut rgb)?;
//!     println!("{report}");
//!     let luminance = rgb.frame().average_of(1);
//!     println!("mean luminance {luminance} W/m²/sr/nm");  // a value and its standard error, like 0.161(3)
//!     # assert!(luminance.value > 0.0 && luminance.relative_error() < 0.2);
//!     Ok(())
//! }
//! ```
//!
//! # Until it is good enough
//! A rule says when to stop; several pipelines see the same rays:
//!
//! ```
//! # use raysect::prelude::*;
//! # fn main() -> raysect::Result<()> {
//! # let mut world = World::new();
//! # world.add(Sphere::new(1.0)?.material(UniformSurfaceEmitter::new(1.0, 1.0)).transform(translate(0.0, 0.0, 5.0)))?;
//! let camera = PinholeCamera::new((16, 16), 30.0)?.aperture(1e-6)?;       // étendue from an opening of 1 mm²
//! let (mut rgb, mut power) = (RgbPipeline2D::new(), PowerPipeline2D::new());
//! let stop = Stop::relative_error(0.02).or_after(minutes(10.0));
//! let report = camera.observe_until(&world, &mut (&mut rgb, &mut power), stop)?;
//! assert!(report.convergence.is_some_and(|c| c.reached));
//! println!("{report}");                                // what became of the paths, and what to beware of
//! println!("{} W", power.frame().total());
//! # Ok(())
//! # }
//! ```
//!
//! # Saved and read again
//! World, cameras and pipelines go into a readable file and come back with every bit; see [`save`].
//!
//! # Layers
//! The crates depend strictly downward and can be used alone: [`math`], [`core`] (geometry without optics),
//! [`primitive`], [`optical`], [`observer`]. This crate re-exports them and their [`prelude`].
//!
//! # Conventions
//! Right-handed axes: x to the left, y up, z forward. Metres, degrees, nanometres, W/m²/sr/nm. `a * b` of two
//! transforms applies `b` first. Wavelengths are vacuum wavelengths.

mod error;
pub mod prelude;
pub mod save;

pub use error::{Error, Result};
pub use raysect_core as core;
pub use raysect_math as math;
pub use raysect_observer as observer;
pub use raysect_optical as optical;
pub use raysect_primitive as primitive;
