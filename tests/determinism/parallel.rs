//! The engine has no influence.

use raysect::core::Engine;
use raysect::prelude::*;

use crate::bits::{CASES, Case, Pictures, SAMPLES, camera, pixel_bits};
use crate::cornell::{self, Variant};
use crate::engines::Reversed;

/// The bits of a case on an engine.
fn on(case: Case, engine: impl Engine + 'static) -> Vec<u64> {
    Pictures::of(&case.camera(SAMPLES).engine(engine), &case.world())
}

/// Multicore with so many threads.
fn threads(count: usize) -> Multicore {
    Multicore::with_threads(count).unwrap()
}

#[test]
fn every_engine_gives_the_same_bits() {
    for case in CASES {
        let reference = on(case, Serial);
        for count in [1, 2, 7] {
            assert!(on(case, threads(count)) == reference, "{case:?} on {count} threads");
        }
        assert!(on(case, Reversed) == reference, "{case:?} in reverse order");
    }
}

#[test]
fn one_pixel_is_shared_by_threads() {
    let world = cornell::cornell_box(Variant::Glass).unwrap();
    let camera = cornell::camera((1, 1)).unwrap().pixel_samples(5000).quiet(true);
    let bits = |camera: PinholeCamera| {
        let mut rgb = RgbPipeline2D::new();
        let report = camera.observe(&world, &mut rgb).unwrap();
        assert_eq!((report.samples, rgb.frame().samples(0)), (5000, 5000));
        pixel_bits(rgb.frame(), 0)
    };
    let reference = bits(camera.clone().engine(Serial));
    for count in [2, 7] {
        assert_eq!(bits(camera.clone().threads(count).unwrap()), reference, "{count} threads");
    }
    assert_eq!(bits(camera.engine(Reversed)), reference);
}

#[test]
fn the_report_does_not_depend_on_the_engine() {
    let case = CASES[1];
    let ledger = |camera: PinholeCamera| {
        let report = Pictures::default().observe(&camera, &case.world());
        let mut numbers = report.ledger;
        // A sum of fractions, whose order is that of the items.
        let truncated = std::mem::take(&mut numbers.truncated_throughput);
        (report.samples, report.invalid, numbers, truncated)
    };
    let (serial, parallel) = (ledger(case.camera(20)), ledger(case.camera(20).threads(2).unwrap()));
    assert_eq!((serial.0, serial.1, serial.2), (parallel.0, parallel.1, parallel.2));
    assert!((serial.3 - parallel.3).abs() <= 1e-12 * serial.3);
}

#[test]
fn company_has_no_influence() {
    let world = CASES[0].world();
    let mut together = Pictures::default();
    together.observe(&camera(20), &world);
    let (mut rgb, mut radiance) = (RgbPipeline2D::new(), RadiancePipeline2D::new());
    camera(20).observe(&world, &mut rgb).unwrap();
    camera(20).observe(&world, &mut radiance).unwrap();
    assert!(Pictures { rgb, radiance }.bits() == together.bits());
}

#[test]
fn other_seeds_give_other_bits() {
    let world = CASES[2].world();
    let of = |seed| {
        let mut pictures = Pictures::default();
        pictures.observe(&camera(20).seed(seed), &world);
        pictures.rgb.frame().clone()
    };
    let (one, two, again) = (of(1), of(2), of(1));
    let pairs = one.mean().into_iter().zip(two.mean()).zip(one.error());
    let same = pairs.filter(|((a, b), error)| a == b && *error > 0.0).count();
    assert_eq!(same, 0, "values with noise");
    assert_eq!(one, again);
}

#[test]
fn seeds_and_pixels_share_no_samples() {
    let world = CASES[2].world();
    let samples = |seed| {
        let mut radiance = RadiancePipeline2D::new();
        camera(1).seed(seed).observe(&world, &mut radiance).unwrap();
        radiance.frame().mean()
    };
    let mut all: Vec<u64> = (0..20).flat_map(samples).filter(|&x| x > 0.0).map(f64::to_bits).collect();
    all.sort_unstable();
    let mut repeated: Vec<u64> = all.windows(2).filter(|w| w[0] == w[1]).map(|w| w[0]).collect();
    repeated.dedup();
    assert!(repeated.len() <= 1, "besides the lamp itself: {repeated:?}");
}
