use super::super::{Expression, Function};
use crate::{MathError, Point3D, Vector3D};

/// A function of the distance to an axis; made by [`coaxial`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CoaxialMapper<F> {
    function: F,
    point: Point3D,
    axis: Vector3D,
}

/// The function of (x, y, z) that has the values of a function of the distance to the axis through a point along a
/// vector: a profile whose surfaces are cylinders.
///
/// Of a profile that knows its [structure](crate::function::Structured1D), a table or [shells](crate::function::Shells), it knows the cylinders
/// at which it changes.
///
/// ```
/// use raysect_math::{Point3D, Vector3D};
/// use raysect_math::function::{Arg, Function, coaxial};
/// let f = coaxial(2.0 * Arg::X, Point3D::new(1.0, 0.0, 7.0), Vector3D::Z)?;
/// assert_eq!(f.evaluate((4.0, 4.0, 0.0)), 10.0);
/// # Ok::<(), raysect_math::MathError>(())
/// ```
///
/// # Errors
/// [`MathError::NoDirection`] for an axis whose length is zero or not finite.
pub fn coaxial<F>(
    function: F,
    point: Point3D,
    axis: Vector3D,
) -> Result<Expression<CoaxialMapper<F>>, MathError> {
    Ok(Expression(CoaxialMapper { function, point, axis: axis.normalise()? }))
}

impl<F> CoaxialMapper<F> {
    /// The function of the distance.
    pub(in super::super) fn profile(&self) -> &F {
        &self.function
    }

    pub(in super::super) fn point(&self) -> Point3D {
        self.point
    }

    /// What of a vector is perpendicular to the axis.
    #[inline]
    pub(in super::super) fn across(&self, v: Vector3D) -> Vector3D {
        v - self.axis * self.axis.dot(v)
    }
}

impl<F: Function<f64, Value = f64>> Function<(f64, f64, f64)> for CoaxialMapper<F> {
    type Value = f64;
    #[inline]
    fn evaluate(&self, (x, y, z): (f64, f64, f64)) -> f64 {
        self.function.evaluate(self.across(self.point.vector_to(Point3D::new(x, y, z))).length())
    }
}
