use std::ops::{Add, Div, Mul, Neg, Sub};

use crate::components::indexed;
use crate::triple::direction_arithmetic;
use crate::{MathError, Vector3D};

/// A direction perpendicular to a surface.
///
/// It holds the same numbers as a [`Vector3D`] but is transformed by the inverse transpose of a matrix
/// ([`AffineMatrix3D::transform_normal`](crate::AffineMatrix3D::transform_normal)), so that it stays
/// perpendicular to the surface under shear and unequal scales.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Normal3D {
    /// Component along x (left).
    pub x: f64,
    /// Component along y (up).
    pub y: f64,
    /// Component along z (forward).
    pub z: f64,
}

direction_arithmetic!(Normal3D, Vector3D);

impl Default for Normal3D {
    /// The z axis, as in Raysect.
    fn default() -> Self {
        Self::new(0.0, 0.0, 1.0)
    }
}

impl Normal3D {
    /// The same components as a vector.
    #[inline]
    pub fn as_vector(self) -> Vector3D {
        self.into()
    }
}
