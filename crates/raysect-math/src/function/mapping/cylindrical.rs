use super::super::{Expression, Function};
use super::turned;
use crate::{Point3D, to_cylindrical};

/// A function of cylindrical coordinates in space; made by [`cylindrical`].
#[doc(alias = "VectorCylindricalTransform")]
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CylindricalTransform<F>(F);

/// The function of (x, y, z) that has the values of a function of r [m], z [m] and φ [deg], with φ in (−180, 180] as from
/// [`to_cylindrical`].
///
/// Of a vector, x is the radial part, y the toroidal one and z the vertical one.
///
/// ```
/// use raysect_math::function::{Function, cylindrical};
/// let f = cylindrical(|r: f64, z: f64, phi: f64| r + z + phi);
/// assert_eq!(f.evaluate((0.0, -2.0, 1.0)), -87.0);
/// ```
#[doc(alias = "CylindricalTransform")]
pub fn cylindrical<F>(function: F) -> Expression<CylindricalTransform<F>> {
    Expression(CylindricalTransform(function))
}

impl<F: Function<(f64, f64, f64)>> Function<(f64, f64, f64)> for CylindricalTransform<F> {
    type Value = F::Value;
    fn evaluate(&self, (x, y, z): (f64, f64, f64)) -> F::Value {
        turned(self.0.evaluate(to_cylindrical(Point3D::new(x, y, z))), x, y)
    }
}
