//! Which values a rule looks at, and what it asks of each.

use raysect::core::Ray;
use raysect::math::Rng;
use raysect::observer::{FrameShape, RadiancePipeline};
use raysect::optical::{AnisotropicSurfaceEmitter, WithMaterial};
use raysect::prelude::*;

/// Three pixels: the lamp in half of the samples, in one of a hundred, and never.
struct Shares;

impl Sensor for Shares {
    fn shape(&self) -> FrameShape {
        FrameShape::Line(3)
    }
    fn sample_ray(&self, pixel: usize, rng: &mut Rng) -> Ray {
        let sees = rng.probability([0.5, 0.01, 0.0][pixel]);
        Ray::new(Point3D::ORIGIN, if sees { Vector3D::Z } else { -Vector3D::Z })
    }
    fn pdf(&self, _: usize, _: Point3D, _: Vector3D) -> Option<f64> {
        None
    }
    fn etendue(&self, _: usize) -> Option<f64> {
        None
    }
}

/// A lamp of 10 W/m²/sr in the direction of the z axis.
fn world() -> World {
    let mut world = World::new();
    let lamp = AnisotropicSurfaceEmitter::new(|_, _, _, out| out.fill(10.0));
    world.add(Sphere::new(1.0).unwrap().material(lamp).transform(translate(0.0, 0.0, 5.0))).unwrap();
    world
}

/// What a rule comes to: the samples of a pixel, and the report.
fn until(stop: Stop) -> (u64, RenderReport, RadiancePipeline) {
    let mut radiance = RadiancePipeline::new();
    let observer = Observer::with_sensor(Shares).wavelengths(500.0, 501.0).spectral_bins(1).quiet(true);
    let report = observer.observe_until(&world(), &mut radiance, stop).unwrap();
    (radiance.frame().samples(0), report, radiance)
}

#[test]
fn pixels_below_a_level_do_not_hold_up_those_above() {
    let rule = Stop::relative_error(0.05).or_samples(2_000_000);
    let above = |level: f64| until(rule.scope(Scope::Above { level, share: 1.0 }));
    let (bright, report, radiance) = above(1.0);
    let convergence = report.convergence.unwrap();
    assert!(convergence.reached && convergence.elements == 1, "{report}");
    assert!(
        radiance.frame().pixel(0, 0).relative_error() <= 0.05 && (100..4000).contains(&bright),
        "{report}"
    );
    // The rare one is above this level, and takes a hundred times as many.
    let (rare, report, radiance) = above(0.01);
    assert!(report.convergence.unwrap().reached && rare > 20 * bright, "{bright} {rare}: {report}");
    assert!(radiance.frame().pixel(1, 0).relative_error() <= 0.05, "{report}");
    let (all, report, _) = until(rule.scope(Scope::Pixels(1.0)));
    assert!(all > 20 * bright, "{all}: {report}");
    // Nothing is as bright as this.
    let (none, report, _) = above(1e6);
    assert!(report.convergence.unwrap().reached && none < 200, "{none}: {report}");
}

#[test]
fn a_value_needs_one_of_two_errors() {
    let rule = Stop::relative_error(0.05).scope(Scope::Pixels(1.0)).or_samples(2_000_000);
    let (relative, ..) = until(rule);
    let (both, report, radiance) = until(rule.or_absolute_error(0.1));
    assert!(report.convergence.unwrap().reached && 4 * both < relative, "{both} {relative}: {report}");
    for pixel in 0..3 {
        let found = radiance.frame().pixel(pixel, 0);
        assert!(found.error <= (0.05 * found.value).max(0.1), "{pixel}: {found}");
    }
    let (other, ..) = until(Stop::absolute_error(0.1).or_relative_error(0.05).scope(Scope::Pixels(1.0)));
    assert_eq!(both, other);
}

#[test]
fn impossible_scopes_are_refused() {
    let observer = || Observer::with_sensor(Shares).wavelengths(500.0, 501.0).spectral_bins(1).quiet(true);
    let wrong = [(0.0, 1.0), (-1.0, 1.0), (f64::NAN, 1.0), (f64::INFINITY, 1.0), (1.0, 0.0), (1.0, 1.1)];
    for (level, share) in wrong {
        let stop = Stop::relative_error(0.1).scope(Scope::Above { level, share });
        let refused = observer().observe_until(&world(), &mut RadiancePipeline::new(), stop);
        assert!(refused.is_err(), "{level} {share}");
    }
}

#[test]
fn progress_knows_what_a_resumed_observation_has_left() {
    use std::sync::{Arc, Mutex};
    let seen = Arc::new(Mutex::new(Vec::new()));
    let keep = seen.clone();
    let observer = Observer::with_sensor(Shares).wavelengths(500.0, 501.0).spectral_bins(1).quiet(true);
    let observer = observer.on_progress(move |p| keep.lock().unwrap().push((p.samples, p.total)));
    let mut radiance = RadiancePipeline::new();
    observer.observe_until(&world(), &mut radiance, Stop::samples(1000)).unwrap();
    assert_eq!(seen.lock().unwrap().last(), Some(&(3000, 3000)));
    observer.observe_until(&world(), &mut radiance, Stop::samples(1500)).unwrap();
    assert_eq!(seen.lock().unwrap().last(), Some(&(1500, 1500)));
    seen.lock().unwrap().clear();
    // Time is foreseen by the rate so far: neither none nor without end.
    observer.observe_until(&world(), &mut radiance, Stop::time(seconds(0.7))).unwrap();
    let told = seen.lock().unwrap().clone();
    assert!(!told.is_empty() && told.len() < 10, "{} times", told.len());
    assert!(told.iter().all(|(samples, total)| total >= samples && *total < 1000 * samples), "{told:?}");
}

#[test]
fn numbers_of_samples_are_one_for_each_pixel() {
    let observer = Observer::with_sensor(Shares).wavelengths(500.0, 501.0).spectral_bins(1).quiet(true);
    let observer = observer.mask(vec![true, true, false]).unwrap();
    let (world, mut radiance) = (world(), RadiancePipeline::new());
    assert!(observer.observe_samples(&world, &mut radiance, &[1, 2]).is_err());
    for _ in 0..2 {
        observer.observe_samples(&world, &mut radiance, &[100, 7, 1000]).unwrap();
    }
    assert_eq!([0, 1, 2].map(|pixel| radiance.frame().samples(pixel)), [200, 14, 0]);
    // The same bits as those of one call.
    let mut once = RadiancePipeline::new();
    observer.observe_samples(&world, &mut once, &[200, 14, 0]).unwrap();
    assert_eq!(once.frame().mean(), radiance.frame().mean());
}
