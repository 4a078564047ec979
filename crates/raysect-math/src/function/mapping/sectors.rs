use super::super::{Expression, Function};
use super::turned;
use crate::{MathError, Point3D, to_cylindrical};

/// A function of cylindrical coordinates in one sector, repeated all around; made by [`periodic_sectors`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PeriodicSectors<F> {
    function: F,
    /// Angle of a sector [deg].
    width: f64,
}

/// The function of (x, y, z) that has, in each of `count` equal sectors about the z axis, the values of a function of r [m],
/// z [m] and φ [deg], where φ is counted from the beginning of the sector: 0 ≤ φ < 360 / `count`.
///
/// The first sector begins at φ = 0. Of a vector, x is the radial part, y the toroidal one and z the vertical one.
///
/// ```
/// use raysect_math::function::{Arg, Function, periodic_sectors};
/// let f = periodic_sectors(Arg::Z, 8)?;
/// assert!((f.evaluate((0.0, 1.0, 0.0)), f.evaluate((-1.0, 1.0, 0.0))) == (0.0, 0.0));
/// assert!((f.evaluate((1.0, -0.1, 0.0)) - (45.0 - 0.1f64.atan().to_degrees())).abs() < 1e-12);
/// # Ok::<(), raysect_math::MathError>(())
/// ```
///
/// # Errors
/// [`MathError::OutOfRange`] for no sectors.
#[doc(alias = "PeriodicTransform3D")]
#[doc(alias = "VectorPeriodicTransform3D")]
pub fn periodic_sectors<F>(function: F, count: u32) -> Result<Expression<PeriodicSectors<F>>, MathError> {
    let count = MathError::check(count > 0, f64::from(count), "number of sectors", "", "1 or more")?;
    Ok(Expression(PeriodicSectors { function, width: 360.0 / count }))
}

impl<F: Function<(f64, f64, f64)>> Function<(f64, f64, f64)> for PeriodicSectors<F> {
    type Value = F::Value;
    fn evaluate(&self, (x, y, z): (f64, f64, f64)) -> F::Value {
        let (r, z, phi) = to_cylindrical(Point3D::new(x, y, z));
        let turn = if phi < 0.0 { phi + 360.0 } else { phi };
        // A remainder is exact and less than the divisor: the function is never asked outside its sector.
        turned(self.function.evaluate((r, z, turn % self.width)), x, y)
    }
}
