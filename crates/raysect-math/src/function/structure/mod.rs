//! Functions that know where they change, so that integrals along lines need not guess.

mod revolved;
mod round;
#[cfg(test)]
mod round_tests;
#[cfg(test)]
mod tests;

use std::sync::Arc;

use super::{Expression, Function};
use crate::{Point3D, Vector3D};

/// A function in space that knows its structure.
///
/// No rule of integration sees what lies between its nodes: a function that jumps, or has corners, must tell where.
/// Grids and meshes do, and so do those that are turned [around an axis](super::axisymmetric), and profiles about
/// [a point](super::spherical) or [an axis](super::coaxial). Another shape of one's own needs but the two functions.
///
/// ```
/// use raysect_math::function::{Arg, Interpolation, Interpolator3DArray, Structured3D, sample3d};
/// use raysect_math::{Point3D, Vector3D};
/// let axis = (0.0, 1.0, 3);
/// let ([x, y, z], f) = sample3d(&(Arg::X * Arg::Y - Arg::Z), axis, axis, axis)?;
/// let f = Interpolator3DArray::new(&x, &y, &z, &f, Interpolation::Linear)?;
/// assert_eq!(f.length_scale(), 0.5);
/// let mut breaks = Vec::new();
/// f.add_breaks(Point3D::new(-1.0, 0.2, 0.2), Vector3D::X * 2.0, &mut breaks);
/// assert_eq!(breaks, [0.5, 0.75, 1.0]);
/// # Ok::<(), raysect_math::MathError>(())
/// ```
pub trait Structured3D: Function<(f64, f64, f64), Value = f64> {
    /// The shortest length over which it changes between breaks [units of x, y and z]; positive and finite.
    fn length_scale(&self) -> f64;

    /// Adds the places ahead of the origin of a ray, in lengths of its direction, where the function jumps or has a
    /// corner. Order and repetition do not matter, nor do places where nothing happens, or that lie behind.
    fn add_breaks(&self, origin: Point3D, direction: Vector3D, out: &mut Vec<f64>);
}

/// A function of one variable that knows its structure.
pub trait Structured1D: Function<f64, Value = f64> {
    /// The shortest length over which it changes between its edges [unit of the variable]; positive and finite.
    fn length_scale(&self) -> f64;

    /// Lends `each` every place at which the function jumps or has a corner; perhaps more than once.
    fn each_edge(&self, each: &mut dyn FnMut(f64));

    /// True if it is constant between its edges.
    fn is_stepped(&self) -> bool {
        false
    }
}

/// A function in a plane that knows its structure.
pub trait Structured2D: Function<(f64, f64), Value = f64> {
    /// The shortest length over which it changes between its edges [units of x and y]; positive and finite.
    fn length_scale(&self) -> f64;

    /// Lends `each` the two ends of every straight line at which the function jumps or has a corner; perhaps more than
    /// once.
    fn each_edge(&self, each: &mut dyn FnMut([f64; 2], [f64; 2]));
}

impl<T: Structured3D> Structured3D for Expression<T> {
    fn length_scale(&self) -> f64 {
        self.0.length_scale()
    }

    fn add_breaks(&self, origin: Point3D, direction: Vector3D, out: &mut Vec<f64>) {
        self.0.add_breaks(origin, direction, out);
    }
}

impl<T: Structured1D> Structured1D for Expression<T> {
    fn length_scale(&self) -> f64 {
        self.0.length_scale()
    }

    fn each_edge(&self, each: &mut dyn FnMut(f64)) {
        self.0.each_edge(each);
    }

    fn is_stepped(&self) -> bool {
        self.0.is_stepped()
    }
}

impl<T: Structured2D> Structured2D for Expression<T> {
    fn length_scale(&self) -> f64 {
        self.0.length_scale()
    }

    fn each_edge(&self, each: &mut dyn FnMut([f64; 2], [f64; 2])) {
        self.0.each_edge(each);
    }
}

impl<T: Structured3D + ?Sized> Structured3D for Arc<T> {
    fn length_scale(&self) -> f64 {
        (**self).length_scale()
    }

    fn add_breaks(&self, origin: Point3D, direction: Vector3D, out: &mut Vec<f64>) {
        (**self).add_breaks(origin, direction, out);
    }
}

impl<T: Structured1D + ?Sized> Structured1D for Arc<T> {
    fn length_scale(&self) -> f64 {
        (**self).length_scale()
    }

    fn each_edge(&self, each: &mut dyn FnMut(f64)) {
        (**self).each_edge(each);
    }

    fn is_stepped(&self) -> bool {
        (**self).is_stepped()
    }
}

impl<T: Structured2D + ?Sized> Structured2D for Arc<T> {
    fn length_scale(&self) -> f64 {
        (**self).length_scale()
    }

    fn each_edge(&self, each: &mut dyn FnMut([f64; 2], [f64; 2])) {
        (**self).each_edge(each);
    }
}
