//! Rough surfaces of many small mirrors or refracting facets.

mod ggx;
mod rough_conductor;
mod rough_dielectric;

pub(crate) use ggx::MASKINGS;
pub use ggx::Masking;
pub use rough_conductor::RoughConductor;
pub use rough_dielectric::RoughDielectric;

use raysect_math::Vector3D;

/// The unit vector along the sum of two directions, if they have one.
#[inline]
fn facet(sum: Vector3D) -> Option<Vector3D> {
    let squared = sum.dot(sum);
    // Below this the sum is nothing but rounding: the directions are opposite.
    let least = f64::EPSILON * f64::EPSILON;
    (squared > least).then(|| sum * (1.0 / squared.sqrt()))
}

/// The direction into which a facet of normal `m` reflects `incoming`, both pointing away from it.
#[inline]
fn mirror(incoming: Vector3D, m: Vector3D) -> Vector3D {
    (m * (2.0 * incoming.dot(m)) - incoming).normalise_unchecked()
}
