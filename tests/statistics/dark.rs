//! What no light has reached is not said to be known.

use std::time::{Duration, Instant};

use raysect::observer::{Convergence, FrameShape, RadiancePipeline};
use raysect::prelude::*;

use crate::sensors::{Bins, glimpse, glimpses, lamp_at};
use crate::truth::{self, BINS};

/// What a rule says of an observer that never sees the lamp, and after how many samples.
fn in_the_dark(shape: FrameShape, stop: Stop) -> (Convergence, u64) {
    let (world, mut radiance) = (lamp_at(5.0, 1.0), RadiancePipeline::new());
    let report = glimpses(0.0, shape).observe_until(&world, &mut radiance, stop).unwrap();
    assert!(!report.warnings().is_empty(), "{report}");
    (report.convergence.unwrap(), radiance.frame().samples(0))
}

#[test]
fn darkness_ends_by_the_number_of_samples() {
    let rules = [Stop::relative_error(0.1), Stop::absolute_error(1e-3)];
    for stop in rules.map(|stop| stop.or_samples(5000)) {
        let (convergence, samples) = in_the_dark(FrameShape::Single, stop);
        assert!(!convergence.reached, "{stop:?} after {samples} samples: {convergence:?}");
        assert_eq!((convergence.unconverged, convergence.elements, samples), (1, 1, 5000), "{stop:?}");
        let stop = stop.scope(Scope::Pixels(0.5));
        let (convergence, samples) = in_the_dark(FrameShape::Line(3), stop);
        assert!(!convergence.reached, "{stop:?} after {samples} samples: {convergence:?}");
        assert_eq!((convergence.unconverged, convergence.elements, samples), (3, 3, 5000), "{stop:?}");
    }
}

#[test]
fn darkness_ends_by_the_clock() {
    let started = Instant::now();
    let (convergence, samples) =
        in_the_dark(FrameShape::Single, Stop::relative_error(0.1).or_after(seconds(0.2)));
    assert!(!convergence.reached, "after {samples} samples: {convergence:?}");
    assert!(started.elapsed() >= Duration::from_millis(200), "{:?}", started.elapsed());
    assert!(started.elapsed() < Duration::from_secs(5), "{:?}", started.elapsed());
}

#[test]
fn too_few_samples_do_not_reach_an_error() {
    let (world, mut radiance) = (lamp_at(5.0, 1.0), RadiancePipeline::new());
    let stop = Stop::relative_error(0.01).or_samples(1000);
    let report = glimpse(0.1).observe_until(&world, &mut radiance, stop).unwrap();
    assert!(!report.convergence.unwrap().reached && radiance.frame().samples(0) == 1000, "{report}");
}

/// Two pixels: one sees the lamp in every sample, the other never does.
struct Halved;

impl Sensor for Halved {
    fn shape(&self) -> FrameShape {
        FrameShape::Line(2)
    }
    fn sample_ray(&self, pixel: usize, _: &mut raysect::math::Rng) -> raysect::core::Ray {
        raysect::core::Ray::new(Point3D::ORIGIN, if pixel == 0 { Vector3D::Z } else { -Vector3D::Z })
    }
    fn pdf(&self, _: usize, _: Point3D, _: Vector3D) -> Option<f64> {
        None
    }
    fn etendue(&self, _: usize) -> Option<f64> {
        None
    }
}

#[test]
fn a_dark_pixel_is_believed_once_it_cannot_matter() {
    let (world, mut radiance) = (lamp_at(5.0, 1.0), RadiancePipeline::new());
    let observer = Observer::with_sensor(Halved).wavelengths(500.0, 501.0).spectral_bins(1).engine(Serial);
    let stop = Stop::relative_error(0.01).scope(Scope::Pixels(1.0)).or_samples(100_000);
    let report = observer.quiet(true).observe_until(&world, &mut radiance, stop).unwrap();
    // At 95 % confidence fewer than 3 in n samples of 1 can hide, where 1 % of the mean of 0.5 is asked for.
    let samples = radiance.frame().samples(1);
    assert!(report.convergence.unwrap().reached && (600..5000).contains(&samples), "{report}");
}

#[test]
fn a_dark_bin_does_not_hold_up_the_others() {
    let mut bins = Bins::new(0..BINS);
    let camera = truth::camera(2).engine(Serial);
    let stop = Stop::relative_error(0.1).or_samples(20_000);
    let report = camera.observe_until(&truth::world(), &mut bins, stop).unwrap();
    let (samples, totals) = (bins.frame().samples(0), (0..BINS).map(|bin| bins.frame().total_of(bin)));
    assert!(report.convergence.unwrap().reached && samples < 5000, "{samples} samples: {report}");
    let dark = totals.filter(|total| total.value == 0.0).count();
    assert_eq!(dark, 1, "the lamp is dark below 400 nm");
}
