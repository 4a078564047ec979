use raysect_math::{Rng, Vector3D};

use crate::Context;

/// A surface that scatters into a range of directions.
///
/// Everything is in surface space: z is the normal on the side from which the path arrives, `incoming` points from
/// the surface to where the path comes from (z ≥ 0), `outgoing` to where it goes; both are unit vectors. Light
/// travels against the path: from `outgoing` to `incoming`.
#[doc(alias = "ContinuousBSDF")]
pub trait Bsdf {
    /// Draws an outgoing direction.
    fn sample(&self, incoming: Vector3D, at: Context<'_>, rng: &mut Rng) -> Vector3D;

    /// Density of [`sample`](Self::sample) [1/sr].
    fn pdf(&self, incoming: Vector3D, outgoing: Vector3D, at: Context<'_>) -> f64;

    /// Writes the scattering function times the cosine of the outgoing direction [1/sr] into `out`, one value a bin,
    /// zeros included.
    fn evaluate(&self, incoming: Vector3D, outgoing: Vector3D, at: Context<'_>, out: &mut [f64]);
}
