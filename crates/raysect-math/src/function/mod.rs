//! Functions of one, two and three variables with values that are numbers or vectors: profiles, fields, tables.
//!
//! # Functions and expressions
//!
//! A [`Function`] has a value at each place. Closures, numbers, vectors, tables and `Arc`s of functions are functions.
//! [`Function1D`], [`Function2D`], [`Function3D`], [`VectorFunction1D`] and so on name them by what they take and yield,
//! for bounds and for `Arc<dyn Function2D>`.
//!
//! An [`Expression`] is a function with arithmetic. It begins with a variable of [`Arg`], or with any function in
//! [`function`] or [`function1d`], and grows by operators and methods. It is one type without a pointer in it; where its
//! type is in the way, `Arc::new(expression)` as `Arc<dyn Function1D>` hides it.
//!
//! ```
//! use raysect_math::function::{Arg, Function, blend, function1d};
//!
//! let bell = (-Arg::X * Arg::X / 2.0).exp();
//! let ripple = bell * 3.0 + function1d(|x| (20.0 * x).sin()) / 10.0;
//! let cut = blend(0.0, ripple, Arg::X.greater(-1.0));
//! assert_eq!((cut.evaluate(0.0), cut.evaluate(-2.0)), (3.0, 0.0));
//! ```
//!
//! Values follow IEEE 754: a root of −1 is NaN, 1/0 is infinite, a table has NaN outside its range. Where a value is
//! needed, [`Function::checked`] says what is wrong instead. Angles of `sin`, `atan` and the like are in radians, as in
//! Rust.
//!
//! # Tables
//!
//! [`Interpolator1DArray`], [`Interpolator2DArray`] and [`Interpolator3DArray`] pass through values on a grid, linear or
//! cubic, and agree with those of Raysect; in one variable there is a monotone curve too. They have derivatives, and go
//! on beyond the grid if they are told how and how far. [`sample1d`], [`sample2d`], [`sample3d`] and [`sample_path`] go the
//! other way.
//!
//! # A plasma
//!
//! A tokamak's equilibrium gives the normalised magnetic flux on a grid of r and z, and a fit gives the temperature as a
//! function of the flux:
//!
//! ```
//! use raysect_math::function::{
//!     Arg, Function, Interpolation, Interpolation1D, Interpolator1DArray, Interpolator2DArray, axisymmetric, blend,
//!     components, function, sample_path, sample2d,
//! };
//! use raysect_math::{Point3D, Vector3D};
//! use std::sync::Arc;
//!
//! // Flux on a grid of r and z [m]: 0 on the magnetic axis, 1 at the last closed surface. Here it is an ellipse.
//! let ellipse = ((Arg::X - 3.0) / 1.0).pow(2.0) + (Arg::Y / 1.5).pow(2.0);
//! let ([r, z], flux) = sample2d(&ellipse, (1.0, 5.0, 65), (-3.0, 3.0, 65))?;
//! let flux = Interpolator2DArray::new(&r, &z, &flux, Interpolation::Cubic)?;
//!
//! // Temperature [eV] by flux: monotone, so that it cannot fall below zero between the knots.
//! let profile = Interpolator1DArray::new(
//!     &[0.0, 0.3, 0.6, 0.9, 1.0],
//!     &[5000.0, 4200.0, 2300.0, 400.0, 0.0],
//!     Interpolation1D::Monotone,
//! )?;
//!
//! // In the poloidal plane: the profile of the flux, and nothing outside the last closed surface.
//! let flux = Arc::new(flux);
//! let inside = function(flux.clone()).less(1.0);
//! let plane = blend(0.0, function(profile).of(flux.clone()), inside);
//! // In space, all around the z axis.
//! let temperature = axisymmetric(plane);
//! assert_eq!(temperature.evaluate((0.0, 3.0, 0.0)), 5000.0);
//! assert_eq!(temperature.evaluate((-4.5, 0.0, 0.0)), 0.0);
//!
//! // Along a line of sight through the axis [m].
//! let line = [Point3D::new(1.5, 0.0, 0.0), Point3D::new(4.5, 0.0, 0.0)];
//! let (distance, along) = sample_path(&temperature, &line, 7)?;
//! assert_eq!((distance[3], along[0], along[3], along[6]), (1.5, 0.0, 5000.0, 0.0));
//!
//! // The poloidal field by the slopes of the flux, the toroidal one as 1/r; parts: radial, toroidal, vertical.
//! let (by_r, by_z) = (flux.clone(), flux);
//! let radial = function(move |r: f64, z: f64| -by_z.derivative((r, z), (0, 1))) / Arg::X;
//! let vertical = function(move |r: f64, z: f64| by_r.derivative((r, z), (1, 0))) / Arg::X;
//! let field = axisymmetric(components(radial, 6.0 / Arg::X, vertical));
//! let on_axis = field.evaluate((0.0, 3.0, 0.0));
//! assert!((on_axis - Vector3D::new(-2.0, 0.0, 0.0)).length() < 1e-12);
//! # Ok::<(), raysect_math::MathError>(())
//! ```

mod arg;
mod blend;
mod components;
mod contract;
mod expression;
mod interpolate;
mod mapping;
mod of;
pub mod operator;
mod place;
mod sample;
mod shells;
mod structure;
#[cfg(test)]
mod tests;
mod value;

pub use arg::Arg;
pub use blend::{Blend, blend};
pub use components::{Components, components};
pub use contract::{
    Function, Function1D, Function2D, Function3D, VectorFunction1D, VectorFunction2D, VectorFunction3D,
};
pub use expression::{Expression, function, function1d, function2d, function3d};
pub use interpolate::{
    Extrapolation, Extrapolation1D, Interpolation, Interpolation1D, Interpolator1DArray, Interpolator2DArray,
    Interpolator3DArray,
};
pub use mapping::{
    AxisymmetricMapper, CoaxialMapper, CylindricalTransform, PeriodicSectors, SphericalMapper, axisymmetric,
    coaxial, cylindrical, periodic_sectors, spherical,
};
pub use of::Of;
pub use place::Place;
pub use sample::{GridAxis, GridSamples, sample_path, sample_points, sample1d, sample2d, sample3d};
pub use shells::Shells;
pub use structure::{Structured1D, Structured2D, Structured3D};
pub use value::Value;
