//! Functions in space from functions of cylindrical coordinates about the z axis, or of the distance to a point or an
//! axis.
//!
//! Vectors of such functions are given by their parts in the half-plane of the place: x is the radial part, y the
//! toroidal one (along growing φ), z the vertical one.

mod axisymmetric;
mod coaxial;
mod cylindrical;
mod sectors;
mod spherical;
#[cfg(test)]
mod tests;

pub use axisymmetric::{AxisymmetricMapper, axisymmetric};
pub use coaxial::{CoaxialMapper, coaxial};
pub use cylindrical::{CylindricalTransform, cylindrical};
pub use sectors::{PeriodicSectors, periodic_sectors};
pub use spherical::{SphericalMapper, spherical};

use super::Value;

/// A value of the half-plane of (x, y) in space; on the axis that of φ = 0.
#[inline]
fn turned<V: Value>(value: V, x: f64, y: f64) -> V {
    let r = x.hypot(y);
    if r == 0.0 { value } else { value.turned(x / r, y / r) }
}
