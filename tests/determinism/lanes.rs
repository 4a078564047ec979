//! Lanes computed apart, and put together in any order.

use raysect::observer::{BLOCK, ObserverError, Statepoint};
use raysect::prelude::*;

use crate::bits::{CASES, COUNT, Case, Pictures, camera};

const CASE: Case = CASES[2];
const LANES: u64 = 4;
/// Samples of a pixel in a lane: complete blocks of statistics and an open one.
const SAMPLES: u64 = 2 * BLOCK + 7;

fn lane(lane: u64, samples: u64) -> PinholeCamera {
    CASE.camera(samples).lane(lane, LANES).unwrap()
}

/// What a machine has after its lanes.
fn machine(world: &World, lanes: &[u64], threads: usize) -> Statepoint {
    let mut pictures = Pictures::default();
    for &number in lanes {
        pictures.observe(&lane(number, SAMPLES).threads(threads).unwrap(), world);
    }
    Statepoint::of(&lane(0, 1), world, &mut pictures.both()).unwrap()
}

#[test]
fn lanes_of_any_split_and_order_have_the_bits_of_the_undivided_run() {
    let world = CASE.world();
    let whole = machine(&world, &[0, 1, 2, 3], 1);
    assert_eq!(whole.frames()[0].samples(0), LANES * SAMPLES);
    let splits: [&[&[u64]]; 3] = [&[&[3], &[1], &[0], &[2]], &[&[2, 0], &[3, 1]], &[&[1, 3, 2], &[0]]];
    for split in splits {
        let mut merged = machine(&world, split[0], 2);
        for lanes in &split[1..] {
            merged.merge(&machine(&world, lanes, 2)).unwrap();
        }
        assert!(merged == whole, "{split:?}");
        let mut pictures = Pictures::default();
        merged.restore(&lane(0, 1), &world, &mut pictures.both()).unwrap();
        let mut expected = Pictures::default();
        whole.clone().restore(&lane(0, 1), &world, &mut expected.both()).unwrap();
        assert!(pictures.bits() == expected.bits(), "{split:?}");
    }
}

#[test]
fn lanes_are_independent_and_only_the_first_is_the_default() {
    let world = CASE.world();
    let single = Pictures::of(&CASE.camera(50), &world);
    assert!(Pictures::of(&CASE.camera(50).lane(0, 1).unwrap(), &world) == single);
    assert!(Pictures::of(&lane(1, 50), &world) != single);
    let of = |lanes: &[u64]| {
        let mut pictures = Pictures::default();
        lanes.iter().for_each(|&number| {
            pictures.observe(&lane(number, SAMPLES), &world);
        });
        pictures.radiance.frame().total()
    };
    let (one, two) = (of(&[0]), of(&[1]));
    assert!((one.value - two.value).abs() < 4.0 * one.error.hypot(two.error));
    let ratio = of(&[0, 1, 2, 3]).error / one.error;
    assert!((ratio - 0.5).abs() < 0.1, "{ratio}");
}

#[test]
fn what_would_count_twice_is_refused() {
    let world = CASE.world();
    let mut merged = machine(&world, &[0, 1], 1);
    let before = merged.clone();
    let refusal = merged.merge(&machine(&world, &[1], 1));
    assert!(matches!(refusal, Err(ObserverError::Overlap { lane: 1, pixel: 0, .. })), "{refusal:?}");
    assert!(merged == before);
    let mut other = Pictures::default();
    other.observe(&CASE.camera(5).lane(2, LANES + 1).unwrap(), &world);
    let other = Statepoint::of(&lane(0, 1), &world, &mut other.both()).unwrap();
    assert!(matches!(merged.merge(&other), Err(ObserverError::OtherFrame { .. })));
    assert!(merged == before);
}

#[test]
fn regions_of_one_lane_are_merged_too() {
    let world = CASE.world();
    let part = |rows: std::ops::Range<usize>| {
        let mut pictures = Pictures::default();
        let camera = CASE.camera(SAMPLES).region(0..12, rows).unwrap();
        pictures.observe(&camera, &world);
        Statepoint::of(&camera, &world, &mut pictures.both()).unwrap()
    };
    let mut all = part(4..10);
    all.merge(&part(0..4)).unwrap();
    let mut pictures = Pictures::default();
    all.restore(&camera(1).spectral_rays(CASE.1), &world, &mut pictures.both()).unwrap();
    assert!(pictures.bits() == Pictures::of(&CASE.camera(SAMPLES), &world));
    assert_eq!(pictures.rgb.frame().total_samples(), SAMPLES * COUNT as u64);
}

#[test]
fn a_lane_that_does_not_exist_is_refused() {
    assert!(matches!(camera(1).lane(4, 4), Err(ObserverError::Lane { lane: 4, of: 4 })));
    assert!(matches!(camera(1).lane(0, 0), Err(ObserverError::Lane { lane: 0, of: 0 })));
}
