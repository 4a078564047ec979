//! How a sample of a pixel begins: the same for an observation and for a replay.

use raysect_core::Ray;
use raysect_math::{AffineMatrix3D, Rng, Stratum, StreamKey};
use raysect_optical::Slice;

use crate::sensor::radiance_weight;
use crate::{Observer, Sensor};

/// The beginning of a path.
pub(super) struct Drawn {
    /// Where it begins and goes, in world space.
    pub(super) ray: Ray,
    /// By how much its radiance counts.
    pub(super) weight: f64,
    /// The random numbers that are left for it.
    pub(super) rng: Rng,
}

/// Draws the path of a sample of a pixel that carries a slice of the spectrum.
#[inline]
pub(super) fn draw<S: Sensor>(
    observer: &Observer<S>,
    to_world: &AffineMatrix3D,
    slice: &Slice,
    (lane, pixel, sample): (u64, usize, u64),
    stratum: Stratum,
) -> Drawn {
    let sensor = observer.sensor();
    let mut rng = Rng::keyed(StreamKey {
        seed: observer.seed_value(),
        lane,
        slice: slice.index as u64,
        pixel: pixel as u64,
        sample,
    })
    .confined_to(stratum);
    // The numbers of the sensor come first; they alone are stratified.
    let ray = sensor.sample_ray(pixel, &mut rng);
    let weight = radiance_weight(sensor, pixel, &ray);
    let ray = Ray {
        origin: to_world.transform_point(ray.origin),
        direction: to_world.transform_vector(ray.direction),
        max_distance: ray.max_distance,
    };
    Drawn { ray, weight, rng }
}
