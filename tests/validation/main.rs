//! Problems with answers in closed form, and mistakes that they must find.

mod sensors;

// It has readers for other programs, too.
#[allow(dead_code)]
#[path = "../../examples/common/json.rs"]
mod json;
#[path = "../../examples/common/validation/mod.rs"]
mod validation;

use clap::ValueEnum;
use rayon::prelude::*;
use validation::{Case, Fault, Reading, Verdict, judge, measure, read_cases};

const CASES: &str = include_str!("../data/cases.json");

/// By how much answers are moved: less than this is not asked to be told.
const MOVED: f64 = 0.01;

fn cases() -> Vec<Case> {
    read_cases(CASES).unwrap()
}

/// The readings of cases, with a fault or without.
fn read(cases: Vec<Case>, seed: u64, fault: Option<Fault>) -> Vec<(Case, Result<Reading, String>)> {
    let one = |case: Case| {
        let reading = measure(&case, seed, fault).unwrap_or_else(|| Err("an unknown kind".into()));
        (case, reading)
    };
    cases.into_par_iter().map(one).collect()
}

/// Asserts that cases pass, and fail with their answers moved.
fn have_their_answers_and_no_others(cases: Vec<Case>) {
    for (case, reading) in read(cases, 7, None) {
        let reading = reading.unwrap_or_else(|why| panic!("{}: {why}", case.id));
        assert_eq!(judge(&case, &reading), Verdict::Passed, "{}: {} {reading:?}", case.id, case.expected);
        for shift in [-MOVED, MOVED] {
            let mut moved = case.clone();
            moved.expected += if case.expected == 0.0 { shift } else { shift * case.expected };
            assert_eq!(
                judge(&moved, &reading),
                Verdict::Failed,
                "{}: {} {reading:?}",
                case.id,
                moved.expected
            );
        }
    }
}

#[test]
fn every_case_has_its_answer_and_no_other() {
    have_their_answers_and_no_others(cases());
}

/// Cases that a mistake in a material must fail: of each, one that is quickly read.
fn told_by(fault: Fault) -> &'static [&'static str] {
    match fault {
        Fault::Cosine | Fault::Pi | Fault::Roulette => &["lambert_plate", "null_box_plate"],
        // Light that comes from all around is found by the surface alone: the density counts.
        Fault::Density => &["furnace_lambert"],
        Fault::Fresnel => &["dielectric_R", "slab_T"],
    }
}

#[test]
fn materials_with_a_mistake_fail() {
    for &fault in Fault::value_variants() {
        let kinds = told_by(fault);
        let told = cases().into_iter().filter(|case| kinds.contains(&case.kind.as_str())).collect();
        let all = read(told, 7, Some(fault));
        assert!(!all.is_empty(), "{fault:?}");
        for (case, reading) in all {
            let reading = reading.unwrap_or_else(|why| panic!("{}: {why}", case.id));
            println!(
                "{fault:?}: {} {} {reading:?}, z {:?}",
                case.id,
                case.expected,
                reading.z(case.expected)
            );
            assert_ne!(judge(&case, &reading), Verdict::Passed, "{fault:?}: {} {reading:?}", case.id);
        }
    }
}

#[test]
fn what_is_not_known_is_not_read() {
    let text = CASES.replacen("furnace_lambert", "furnace_of_tomorrow", 1);
    let case = &read_cases(&text).unwrap()[0];
    assert!(measure(case, 1, None).is_none());
}
