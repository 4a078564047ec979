//! How an observation is divided has no influence.

use raysect::prelude::*;

use crate::bits::{CASES, COUNT, Case, Pictures, SAMPLES, counts};

/// The bits of a case observed in parts.
fn in_parts(case: Case, parts: &[u64], threads: usize) -> Vec<u64> {
    let (world, mut pictures) = (case.world(), Pictures::default());
    for &samples in parts {
        let camera = case.camera(samples).threads(threads).unwrap();
        assert_eq!(pictures.observe(&camera, &world).samples, samples * COUNT as u64);
    }
    assert_eq!(counts(pictures.rgb.frame()), [parts.iter().sum::<u64>(); COUNT]);
    pictures.bits()
}

/// The same number of samples in one observation, and in parts that respect no boundary of blocks.
const SPLITS: [&[u64]; 5] = [&[100; 2], &[10; 20], &[1, 63, 64, 72], &[127, 1, 1, 71], &[3, 190, 7]];

#[test]
fn parts_give_the_bits_of_the_whole() {
    for case in CASES {
        let whole = in_parts(case, &[SAMPLES], 2);
        for parts in SPLITS {
            assert_eq!(parts.iter().sum::<u64>(), SAMPLES);
            assert!(in_parts(case, parts, 2) == whole, "{case:?} in {parts:?}");
        }
    }
}

#[test]
fn many_blocks_give_the_bits_of_the_whole() {
    let case = CASES[2];
    let whole = in_parts(case, &[1000], 2);
    assert!(in_parts(case, &[1, 300, 333, 366], 7) == whole);
}

/// What `observe_until` makes of a rule, in several observations.
fn until(case: Case, stops: &[Stop]) -> Pictures {
    let (world, mut pictures) = (case.world(), Pictures::default());
    for &stop in stops {
        case.camera(1).observe_until(&world, &mut pictures.both(), stop).unwrap();
    }
    pictures
}

#[test]
fn a_number_of_samples_is_a_rule_like_any_other() {
    for case in CASES {
        let whole = Pictures::of(&case.camera(SAMPLES), &case.world());
        assert!(until(case, &[Stop::samples(SAMPLES)]).bits() == whole, "{case:?}");
        let stops = [Stop::samples(77), Stop::samples(SAMPLES), Stop::samples(130)];
        assert!(until(case, &stops).bits() == whole, "{case:?}, continued");
    }
}

#[test]
fn what_a_rule_decides_is_a_number_of_samples() {
    let case = CASES[2];
    let pictures = until(case, &[Stop::relative_error(0.05)]);
    let samples = pictures.rgb.frame().samples(0);
    assert!(samples > 1);
    assert!(pictures.bits() == Pictures::of(&case.camera(samples), &case.world()), "{samples} samples");
}

#[test]
fn rules_decide_the_same_on_any_engine() {
    let case = CASES[2];
    let of = |threads: usize| {
        let (world, mut pictures) = (case.world(), Pictures::default());
        let camera = case.camera(1).threads(threads).unwrap();
        let stop = Stop::relative_error(0.3).scope(Scope::Pixels(0.9));
        let report = camera.observe_until(&world, &mut pictures.both(), stop).unwrap();
        (pictures.bits(), report.convergence)
    };
    assert!(of(1) == of(7));
}
