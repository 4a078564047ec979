//! Measures as precisely as a verdict needs, along single rays and with sensors.

use raysect::observer::Target;
use raysect::optical::PathSettings;
use raysect::prelude::*;

use super::reading::{NOISE, Reading};
use super::scenes::{Bench, wrong};

/// Samples that say how many are needed; they do not count.
const PILOT: u64 = 4096;

/// The most that are taken, however noisy the case is.
const MOST: u64 = 20_000_000;

/// Samples aim at this part of the noise that a verdict allows.
const AIM: f64 = 0.75;

/// Where the bin of all cases lies [nm], unless one says otherwise.
pub(super) const BAND: (f64, f64) = (500.0, 501.0);

/// The radiance that arrives at a point from a direction, in a bin of 1 nm.
pub(super) fn along(
    bench: Bench,
    world: &World,
    origin: [f64; 3],
    direction: [f64; 3],
) -> Result<Reading, String> {
    with_settings(bench, world, origin, direction, PathSettings::default())
}

/// The same with settings of one's own.
pub(super) fn with_settings(
    bench: Bench,
    world: &World,
    origin: [f64; 3],
    direction: [f64; 3],
    settings: PathSettings,
) -> Result<Reading, String> {
    let ray = Ray::new(Point3D::from(origin), Vector3D::from(direction));
    sample(bench, world, &ray.spectrum(BAND.0, BAND.1, 1).settings(settings))
}

/// The mean of the first bin of a ray, by as many paths as it needs.
pub(super) fn sample(bench: Bench, world: &World, ray: &Ray) -> Result<Reading, String> {
    let read = |seed: u64, count: u64| {
        let found = ray.clone().seed(seed).sample(world, count).map_err(wrong)?;
        Ok::<_, String>(Reading::of(found.mean.samples()[0], found.error[0]))
    };
    let pilot = read(bench.seed.wrapping_add(1 << 40), PILOT)?;
    read(bench.seed, needed(pilot.error / pilot.mean.abs().max(f64::MIN_POSITIVE)))
}

/// How many samples are needed, from the relative error of a pilot.
fn needed(pilot_noise: f64) -> u64 {
    let ratio = pilot_noise / (AIM * NOISE);
    ((PILOT as f64 * ratio * ratio).ceil() as u64).clamp(PILOT, MOST)
}

/// What a sensor is to report.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Quantity {
    /// [W/m²/sr], of the bin of 1 nm.
    Radiance,
    /// [W].
    Power,
}

/// The reading of every pixel that a sensor observes, in a bin of 1 nm.
pub(super) fn pixels<S: Sensor>(
    bench: Bench,
    world: &World,
    observer: Observer<S>,
    quantity: Quantity,
) -> Result<Vec<Reading>, String> {
    let observer = observer.wavelengths(BAND.0, BAND.1).spectral_bins(1).engine(Serial).quiet(true);
    let pilot = observer.pixel_samples(PILOT).seed(bench.seed.wrapping_add(1 << 40));
    let noise = |r: &Reading| if r.error > 0.0 { r.error / r.mean.abs().max(f64::MIN_POSITIVE) } else { 0.0 };
    let worst = readings(world, &pilot, quantity)?.iter().map(noise).fold(0.0, f64::max);
    readings(world, &pilot.pixel_samples(needed(worst)).seed(bench.seed), quantity)
}

fn readings<S: Sensor>(
    world: &World,
    observer: &Observer<S>,
    quantity: Quantity,
) -> Result<Vec<Reading>, String> {
    let frame = match quantity {
        Quantity::Radiance => {
            let mut pipeline = RadiancePipeline2D::new();
            observer.observe(world, &mut pipeline).map_err(wrong)?;
            pipeline.frame().clone()
        }
        Quantity::Power => {
            let mut pipeline = PowerPipeline2D::new();
            observer.observe(world, &mut pipeline).map_err(wrong)?;
            pipeline.frame().clone()
        }
    };
    let pixel = |p| {
        let found = frame.pixel(p, 0);
        Reading::of(found.value, found.error)
    };
    Ok(frame.observed_pixels().map(pixel).collect())
}

/// The irradiance [W/m²] at the origin of a space, on a plane that faces its z axis, from what lies within a target.
/// The plane is a pixel so small that its size does not matter.
pub(super) fn irradiance(
    bench: Bench,
    world: &World,
    place: AffineMatrix3D,
    target: Target,
    scale: f64,
) -> Result<Reading, String> {
    let side = 1e-8 * scale;
    let pixel = Pixel::new(side, side).map_err(wrong)?.targets([target], 0.9).map_err(wrong)?;
    let found = pixels(bench, world, pixel.transform(place), Quantity::Radiance)?;
    Ok(found[0].times(std::f64::consts::PI))
}
