//! Averages that a stop rule ends, of samples of which few are bright.

use raysect::math::Statistics;
use raysect::observer::RadiancePipeline;
use raysect::prelude::*;

use crate::score::Averages;
use crate::seeds::each_seed;
use crate::sensors::{glimpse, lamp_at};

/// Probability of a bright sample, relative error to be reached, and number of seeds. Of the cheapest case there are
/// more, since the bias of a naive rule is hardly seen in a thousand.
const CASES: [(f64, f64, u64); 4] =
    [(0.1, 0.1, 4000), (0.1, 0.05, 1000), (0.01, 0.1, 1000), (0.001, 0.1, 1000)];

/// Averages of samples of 1 / `probability` with this probability, and 0 otherwise: their mean is 1.
fn averages(probability: f64, seeds: u64, average: impl Fn(&World, u64) -> Frame + Sync) -> Averages {
    let world = lamp_at(5.0, 1.0 / probability);
    let all = each_seed(1..seeds + 1, |seed| {
        let frame = average(&world, seed);
        (frame.pixel(0, 0), frame.samples(0))
    });
    Averages::of(&all, 1.0)
}

/// Averages that the library's rule ends.
fn ruled(probability: f64, error: f64, seeds: u64) -> Averages {
    averages(probability, seeds, |world, seed| {
        let mut radiance = RadiancePipeline::new();
        let observer = glimpse(probability).seed(seed);
        let report = observer.observe_until(world, &mut radiance, Stop::relative_error(error)).unwrap();
        assert!(report.convergence.is_some_and(|c| c.reached), "seed {seed}: {report}");
        assert!(radiance.frame().pixel(0, 0).relative_error() <= error);
        radiance.frame().clone()
    })
}

/// Averages that end as soon as their own error looks good.
fn naive(probability: f64, error: f64, seeds: u64) -> Averages {
    averages(probability, seeds, |world, seed| {
        let mut radiance = RadiancePipeline::new();
        let observer = glimpse(probability).seed(seed).pixel_samples(32);
        while radiance.frame().is_empty() || radiance.frame().pixel(0, 0).relative_error() > error {
            observer.observe(world, &mut radiance).unwrap();
        }
        radiance.frame().clone()
    })
}

#[test]
fn averages_ended_by_a_rule_are_right() {
    for (probability, error, seeds) in CASES {
        let averages = ruled(probability, error, seeds);
        println!("one in {:<5} to {:>3} %: {averages}", 1.0 / probability, 100.0 * error);
        assert!(averages.holds(), "one in {} to {error}: {averages}", 1.0 / probability);
    }
}

#[test]
fn averages_ended_by_a_naive_rule_are_not() {
    let (probability, error, seeds) = CASES[0];
    let averages = naive(probability, error, seeds);
    println!("one in {:<5} to {:>3} %, naive: {averages}", 1.0 / probability, 100.0 * error);
    assert!(!averages.holds(), "{averages}");
}

#[test]
fn averages_with_short_error_bars_are_not() {
    let (probability, error, seeds) = CASES[1];
    let world = lamp_at(5.0, 1.0 / probability);
    let all = each_seed(1..seeds + 1, |seed| {
        let mut radiance = RadiancePipeline::new();
        let observer = glimpse(probability).seed(seed);
        observer.observe_until(&world, &mut radiance, Stop::relative_error(error)).unwrap();
        let estimate = radiance.frame().pixel(0, 0);
        (Estimate { error: 0.8 * estimate.error, ..estimate }, radiance.frame().samples(0))
    });
    let averages = Averages::of(&all, 1.0);
    assert!(!averages.holds(), "{averages}");
}

#[test]
fn rare_dark_samples_are_not_overlooked() {
    // A pilot of 32 samples sees no dark one among them in 3 % and 72 % of all seeds.
    for (probability, seeds) in [(0.9, 200), (0.99, 400)] {
        let world = lamp_at(5.0, 1.0 / probability);
        let found = each_seed(1..seeds + 1, |seed| {
            let mut radiance = RadiancePipeline::new();
            let observer = glimpse(probability).seed(seed);
            let report = observer.observe_until(&world, &mut radiance, Stop::relative_error(0.003)).unwrap();
            assert!(report.convergence.is_some_and(|c| c.reached), "seed {seed}: {report}");
            radiance.frame().pixel(0, 0)
        });
        let mut mean = Statistics::new();
        found.iter().for_each(|estimate| mean.add(estimate.value));
        let off = |e: &Estimate| (e.value - 1.0).abs() > 1.96 * e.error;
        let missed = found.iter().filter(|e| off(e)).count() as f64 / seeds as f64;
        println!("one in {:<5} dark, to 0.3 %: {mean:?}, {missed} missed", 1.0 / (1.0 - probability));
        assert!((mean.mean() - 1.0).abs() < 4.0 * mean.error(), "{mean:?}");
        assert!(missed < 0.1, "{missed}");
    }
}

#[test]
fn samples_that_are_all_alike_are_believed_once_there_are_enough() {
    for (error, samples) in [(0.003, 578), (0.001, 1733)] {
        let mut radiance = RadiancePipeline::new();
        let report = glimpse(1.0)
            .observe_until(&lamp_at(5.0, 1.0), &mut radiance, Stop::relative_error(error))
            .unwrap();
        assert!(report.convergence.is_some_and(|c| c.reached), "{report}");
        let found = radiance.frame().samples(0);
        assert!((samples..2 * samples).contains(&found), "{error}: {found}");
    }
}
