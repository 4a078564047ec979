//! The report says when error bars are not to be believed, and not otherwise.

use raysect::observer::RadiancePipeline;
use raysect::prelude::*;

use crate::cornell::{self, Variant};
use crate::sensors::{glimpse, lamp_at};

/// A picture of the Cornell box after 100 samples a pixel.
fn picture(variant: Variant) -> (RenderReport, RgbPipeline2D, RadiancePipeline2D) {
    let (mut rgb, mut radiance) = (RgbPipeline2D::new(), RadiancePipeline2D::new());
    let camera = cornell::camera((48, 48)).unwrap().pixel_samples(100).quiet(true);
    let report =
        camera.observe(&cornell::cornell_box(variant).unwrap(), &mut (&mut rgb, &mut radiance)).unwrap();
    (report, rgb, radiance)
}

#[test]
fn an_ordinary_picture_is_believed() {
    for variant in [Variant::Diffuse, Variant::Glass] {
        let (report, rgb, radiance) = picture(variant);
        println!("{report}");
        report.readings.iter().for_each(|reading| println!("{reading:?}"));
        assert!(report.warnings().is_empty(), "{report}");
        let l = &report.ledger;
        assert_eq!(l.absorbed + l.escaped + l.killed + l.truncated + l.lost, l.paths);
        let absorbed = 100.0 * l.absorbed as f64 / l.paths as f64;
        assert!(
            report.to_string().contains(&format!("{} ({absorbed:.3} %) absorbed", l.absorbed)),
            "{report}"
        );
        let [colours, light] = &report.readings[..] else { panic!("{report}") };
        assert_eq!((colours.total, light.total), (rgb.frame().total(), radiance.frame().total()));
        let seconds = report.elapsed.as_secs_f64();
        let merit = 1.0 / (light.total.relative_error().powi(2) * seconds);
        assert!((light.figure_of_merit / merit - 1.0).abs() < 1e-12);
        assert_eq!(report.figures_of_merit()[1], light.figure_of_merit);
    }
}

/// A grey room with a small lamp inside a ball of glass, which no path can aim at.
fn bulb() -> World {
    let mut world = World::new();
    let room = Cuboid::new(Point3D::new(-1.0, -1.0, -1.0), Point3D::new(1.0, 1.0, 1.0)).unwrap();
    world.add(room.material(Lambert::new(0.5))).unwrap();
    let place = translate(0.0, 0.5, 0.0);
    world.add(Sphere::new(0.1).unwrap().material(schott("N-BK7").unwrap()).transform(place)).unwrap();
    let lamp = Sphere::new(0.01).unwrap().material(UniformSurfaceEmitter::new(1.0, 1.0));
    world.add(lamp.transform(place)).unwrap();
    world
}

#[test]
fn a_picture_full_of_fireflies_is_not() {
    let camera = PinholeCamera::new((48, 48), 45.0).unwrap().transform(translate(0.0, -0.5, -0.9));
    let camera = camera.spectral_bins(1).pixel_samples(100).quiet(true);
    let mut radiance = RadiancePipeline::new();
    let report = camera.observe(&bulb(), &mut radiance).unwrap();
    println!("{report}");
    let warnings = report.warnings();
    assert!(warnings.iter().any(|warning| warning.contains("more than half of the value")), "{report}");
    let reading = &report.readings[0];
    let bright = |pixel: &usize| {
        let frame = radiance.frame();
        frame.largest(*pixel) > 0.5 * 100.0 * frame.pixel(*pixel, 0).value
    };
    assert_eq!(reading.fireflies, (0..reading.pixels).filter(bright).count());
}

/// The report after some samples that are bright with a probability.
fn report(probability: f64, samples: u64) -> RenderReport {
    let mut radiance = RadiancePipeline::new();
    let observer = glimpse(probability).pixel_samples(samples);
    observer.observe(&lamp_at(5.0, 1.0), &mut radiance).unwrap()
}

#[test]
fn few_bright_samples_are_too_few() {
    for (samples, believed) in [(1000, false), (100_000, true)] {
        let report = report(0.001, samples);
        let reading = &report.readings[0];
        assert_eq!(report.warnings().is_empty(), believed, "{report}");
        // Each bright sample is as bright as any other.
        let share = 1.0 / reading.contributing as f64;
        assert!((reading.largest_share / share - 1.0).abs() < 1e-12, "{reading:?}");
        assert!((reading.variance_of_variance / share - 1.0).abs() < 0.05, "{reading:?}");
    }
    // Without noise, or with little of it, a few samples are enough.
    for probability in [1.0, 0.5] {
        assert!(report(probability, 100).warnings().is_empty());
    }
    assert!(report(1.0, 3).warnings().is_empty());
}

#[test]
fn one_sample_that_makes_the_error_is_found() {
    // Light in every sample, and a thousand times as much in one of a thousand.
    let mut world = lamp_at(5.0, 1000.0);
    let dim = Sphere::new(0.1).unwrap().material(UniformSurfaceEmitter::new(1.0, 1.0));
    world.add(dim.transform(translate(0.0, 0.0, -5.0))).unwrap();
    let report = |samples: u64| {
        let observer = glimpse(0.001).pixel_samples(samples);
        observer.observe(&world, &mut RadiancePipeline::new()).unwrap()
    };
    let early = report(1000);
    assert!(early.warnings().iter().any(|warning| warning.contains("itself known")), "{early}");
    let reading = &early.readings[0];
    assert!(reading.contributing == 1000 && reading.variance_of_variance > 0.3, "{reading:?}");
    let late = report(100_000);
    assert!(late.warnings().is_empty() && late.readings[0].variance_of_variance < 0.02, "{late}");
}

/// Two balls of glass that overlap, the second one with a priority, in front of a camera inside a lamp.
fn overlapping(priority: i32) -> RenderReport {
    let mut world = World::new();
    let glass = |priority| Dielectric::new(1.5, 1.0).unwrap().named("crown").priority(priority);
    let ball =
        |z, priority| Sphere::new(1.0).unwrap().material(glass(priority)).transform(translate(0.0, 0.0, z));
    world.add(ball(3.0, 0).name("left")).unwrap();
    world.add(ball(4.0, priority)).unwrap();
    world.add(Sphere::new(50.0).unwrap().material(UniformSurfaceEmitter::new(1.0, 1.0))).unwrap();
    let camera = PinholeCamera::new((8, 8), 30.0).unwrap().spectral_bins(1).pixel_samples(100).quiet(true);
    let plan = camera.plan(&world).unwrap().to_string();
    assert_eq!(plan.contains("equal priority"), priority == 0, "{plan}");
    camera.observe(&world, &mut RadiancePipeline::new()).unwrap()
}

#[test]
fn overlapping_glass_of_equal_priority_is_named() {
    let equal = overlapping(0);
    let warnings = equal.warnings();
    let about = warnings.iter().find(|warning| warning.contains("equal priority")).expect("a warning");
    assert!(about.contains("left (crown) and Sphere (crown)"), "{about}");
    assert!(equal.ledger.contested > 1000 && about.starts_with(&equal.ledger.contested.to_string()));
    let settled = overlapping(1);
    assert!(!settled.warnings().iter().any(|warning| warning.contains("priority")), "{settled}");
}
