use super::super::{Expression, Function};
use crate::Point3D;

/// A function of the distance to a point; made by [`spherical`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SphericalMapper<F> {
    function: F,
    centre: Point3D,
}

/// The function of (x, y, z) that has the values of a function of the distance to a point: a profile whose surfaces are
/// spheres.
///
/// Of a profile that knows its [structure](crate::function::Structured1D), a table or [shells](crate::function::Shells), it knows the spheres
/// at which it changes.
///
/// ```
/// use raysect_math::Point3D;
/// use raysect_math::function::{Arg, Function, spherical};
/// let f = spherical(2.0 * Arg::X, Point3D::new(1.0, 0.0, 0.0));
/// assert_eq!(f.evaluate((4.0, 4.0, 0.0)), 10.0);
/// ```
pub fn spherical<F>(function: F, centre: Point3D) -> Expression<SphericalMapper<F>> {
    Expression(SphericalMapper { function, centre })
}

impl<F> SphericalMapper<F> {
    /// The function of the distance.
    pub(in super::super) fn profile(&self) -> &F {
        &self.function
    }

    pub(in super::super) fn centre(&self) -> Point3D {
        self.centre
    }
}

impl<F: Function<f64, Value = f64>> Function<(f64, f64, f64)> for SphericalMapper<F> {
    type Value = f64;
    #[inline]
    fn evaluate(&self, (x, y, z): (f64, f64, f64)) -> f64 {
        self.function.evaluate(self.centre.distance_to(Point3D::new(x, y, z)))
    }
}
