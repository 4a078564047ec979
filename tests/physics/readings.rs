//! What sensors read, and the one judge of it.

use std::fmt;

use raysect::core::NodeId;
use raysect::math::AffineMatrix3D;
use raysect::observer::{Estimate, Observer, PowerPipeline2D, RadiancePipeline2D, Sensor};
use raysect::optical::World;
use raysect::prelude::Serial;

use crate::check::Demand;

/// Radiance and power of a pixel in a band of 1 nm.
#[derive(Debug, Clone, Copy)]
pub(crate) struct PixelReading {
    pub(crate) radiance: Estimate,
    pub(crate) power: Estimate,
}

/// Where an observer stands.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Place {
    pub(crate) parent: Option<NodeId>,
    pub(crate) transform: AffineMatrix3D,
}

/// All pixels of a sensor with an étendue, after so many samples of each.
pub(crate) fn read<S: Sensor>(
    observer: Observer<S>,
    world: &World,
    place: Place,
    samples: u64,
) -> Vec<PixelReading> {
    let mut observer = observer
        .transform(place.transform)
        .wavelengths(500.0, 501.0)
        .spectral_bins(1)
        .pixel_samples(samples)
        .seed(17)
        .engine(Serial)
        .quiet(true);
    if let Some(parent) = place.parent {
        observer = observer.parent(parent);
    }
    let (mut radiance, mut power) = (RadiancePipeline2D::new(), PowerPipeline2D::new());
    let report = observer.observe(world, &mut (&mut radiance, &mut power)).unwrap();
    assert_eq!(report.invalid, 0);
    let pixel = |p| PixelReading { radiance: radiance.frame().pixel(p, 0), power: power.frame().pixel(p, 0) };
    (0..observer.sensor().shape().pixels()).map(pixel).collect()
}

/// The radiance of all pixels of a sensor without an étendue.
pub(crate) fn read_radiance<S: Sensor>(observer: Observer<S>, world: &World, samples: u64) -> Vec<Estimate> {
    let observer = observer.wavelengths(500.0, 501.0).spectral_bins(1).pixel_samples(samples);
    let observer = observer.engine(Serial).quiet(true);
    let mut radiance = RadiancePipeline2D::new();
    observer.observe(world, &mut radiance).unwrap();
    (0..observer.sensor().shape().pixels()).map(|p| radiance.frame().pixel(p, 0)).collect()
}

/// Judges an estimate as paths are judged: within 4 standard errors, at 0.3 % at most; or without any variance.
pub(crate) fn judge(expected: f64, demand: Demand, found: Estimate) -> Result<(), String> {
    let (off, error) = ((found.value - expected).abs(), found.error);
    let rounding = 1e-12 * expected.abs();
    match demand {
        _ if !(off.is_finite() && error.is_finite()) => Err(format!("not finite: {found:?}")),
        Demand::Exact if off > rounding || error > rounding => Err(format!("not exact: {found:?}")),
        Demand::Mean if error > 0.003 * expected.abs() => Err(format!("too noisy: {found:?}")),
        Demand::Mean if off > 4.0 * error + rounding => {
            Err(format!("off by {:.1} standard errors: {found:?}", (found.value - expected) / error))
        }
        _ => Ok(()),
    }
}

/// Asserts that an estimate passes, and writes a line of the report that `--nocapture` shows.
#[track_caller]
pub(crate) fn accept_estimate(case: impl fmt::Display, expected: f64, demand: Demand, found: Estimate) {
    let z = if found.error > 1e-12 * expected { (found.value - expected) / found.error } else { 0.0 };
    let relative = 100.0 * found.error / expected;
    println!("{case:<44} {expected:<14.9e} {:<14.9e} ({relative:.2e} %)  z {z:+.2}", found.value);
    if let Err(why) = judge(expected, demand, found) {
        panic!("{case}: expected {expected}: {why}");
    }
}
