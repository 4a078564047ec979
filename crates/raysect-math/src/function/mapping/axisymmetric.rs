use super::super::{Expression, Function};
use super::turned;

/// A function of (r, z) in space; made by [`axisymmetric`].
#[doc(alias = "VectorAxisymmetricMapper")]
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AxisymmetricMapper<F>(F);

/// The function of (x, y, z) that has the values of a function of (r, z) all around the z axis.
///
/// Of a vector, x is the radial part, y the toroidal one and z the vertical one, as in the half-plane φ = 0.
///
/// ```
/// use raysect_math::Vector3D;
/// use raysect_math::function::{Arg, Function, axisymmetric, components};
/// assert_eq!(axisymmetric(Arg::X + Arg::Y).evaluate((-3.0, 4.0, 2.0)), 7.0);
/// let toroidal = axisymmetric(components(0.0, 6.0 / Arg::X, 0.0));
/// assert_eq!(toroidal.evaluate((0.0, 2.0, 1.0)), Vector3D::new(-3.0, 0.0, 0.0));
/// ```
#[doc(alias = "AxisymmetricMapper")]
pub fn axisymmetric<F>(function: F) -> Expression<AxisymmetricMapper<F>> {
    Expression(AxisymmetricMapper(function))
}

impl<F> AxisymmetricMapper<F> {
    /// The function in the half-plane.
    pub(in super::super) fn plane(&self) -> &F {
        &self.0
    }
}

impl<F: Function<(f64, f64)>> Function<(f64, f64, f64)> for AxisymmetricMapper<F> {
    type Value = F::Value;
    #[inline]
    fn evaluate(&self, (x, y, z): (f64, f64, f64)) -> F::Value {
        turned(self.0.evaluate((x.hypot(y), z)), x, y)
    }
}
