//! Pixels that are left out change nothing of the others.

use raysect::observer::ObserverError;
use raysect::prelude::*;

use crate::bits::{CASES, COUNT, Case, PIXELS, Pictures, SAMPLES, camera, own_bits};

const CASE: Case = CASES[2];

/// Columns and rows that are looked at.
const REGION: (std::ops::Range<usize>, std::ops::Range<usize>) = (3..9, 2..7);

fn inside(pixel: usize) -> bool {
    REGION.0.contains(&(pixel % PIXELS.0)) && REGION.1.contains(&(pixel / PIXELS.0))
}

fn region(samples: u64) -> PinholeCamera {
    CASE.camera(samples).region(REGION.0, REGION.1).unwrap()
}

#[test]
fn a_region_has_the_bits_of_the_whole_and_nothing_else() {
    let world = CASE.world();
    let (mut whole, mut part) = (Pictures::default(), Pictures::default());
    whole.observe(&CASE.camera(SAMPLES), &world);
    let report = part.observe(&region(SAMPLES), &world);
    assert_eq!((report.pixels, report.samples), (30, 30 * SAMPLES));
    for pixel in 0..COUNT {
        let (ours, theirs) = (part.rgb.frame(), whole.rgb.frame());
        assert_eq!(ours.is_masked(pixel), !inside(pixel));
        if inside(pixel) {
            assert_eq!(own_bits(ours, pixel), own_bits(theirs, pixel), "pixel {pixel}");
        } else {
            assert_eq!(ours.samples(pixel), 0);
            assert_eq!(ours.pixel(pixel, 0), Estimate { value: 0.0, error: f64::INFINITY });
        }
    }
}

#[test]
fn totals_and_averages_leave_masked_pixels_out() {
    let (world, mut part) = (CASE.world(), Pictures::default());
    part.observe(&region(SAMPLES), &world);
    let frame = part.radiance.frame();
    let values: Vec<f64> = (0..COUNT).filter(|&p| inside(p)).map(|p| frame.pixel(p, 0).value).collect();
    let sum: f64 = values.iter().sum();
    assert_eq!(frame.total().value, sum);
    assert!((frame.average_of(0).value - sum / 30.0).abs() < 1e-12 * sum);
    assert!(frame.total().error.is_finite());
}

#[test]
fn regions_one_after_the_other_make_the_whole() {
    let (world, mut parts) = (CASE.world(), Pictures::default());
    let rest: Vec<bool> = (0..COUNT).map(|pixel| !inside(pixel)).collect();
    parts.observe(&region(SAMPLES), &world);
    parts.observe(&CASE.camera(SAMPLES).mask(rest).unwrap().threads(2).unwrap(), &world);
    assert!(parts.bits() == Pictures::of(&CASE.camera(SAMPLES), &world));
}

#[test]
fn stop_rules_look_at_the_region_alone() {
    let (world, mut part) = (CASE.world(), Pictures::default());
    let stop = Stop::relative_error(0.1);
    let report = region(1).observe_until(&world, &mut part.both(), stop).unwrap();
    assert!(report.convergence.is_some_and(|c| c.reached), "{report}");
    let samples = part.rgb.frame().samples(2 * PIXELS.0 + 3);
    let mut again = Pictures::default();
    again.observe(&region(samples), &world);
    assert!(samples > 0 && again.bits() == part.bits());
}

#[test]
fn impossible_regions_are_refused() {
    assert!(matches!(camera(1).region(0..13, 0..1), Err(ObserverError::Region { .. })));
    assert!(matches!(camera(1).region(0..1, 3..11), Err(ObserverError::Region { .. })));
    assert!(matches!(camera(1).region(4..4, 0..1), Err(ObserverError::NoPixels)));
    assert!(matches!(camera(1).mask(vec![true; 5]), Err(ObserverError::PixelCount { found: 5, .. })));
    assert!(matches!(camera(1).mask(vec![false; COUNT]), Err(ObserverError::NoPixels)));
}
