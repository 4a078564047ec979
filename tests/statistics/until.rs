//! Averages that a stop rule ends, of samples of which few are bright.

use raysect::math::Statistics;
use raysect::observer::{FrameShape, RadiancePipeline};
use raysect::prelude::*;

use crate::score::Averages;
use crate::seeds::each_seed;
use crate::sensors::{glimpse, glimpses, lamp_at};

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

/// Averages that end as soon as their own error, by some measure of it, looks good.
fn naive(probability: f64, error: f64, seeds: u64, measure: impl Fn(Estimate) -> f64 + Sync) -> Averages {
    averages(probability, seeds, |world, seed| {
        let mut radiance = RadiancePipeline::new();
        let observer = glimpse(probability).seed(seed).pixel_samples(32);
        let bright = |frame: &Frame| frame.pixel(0, 0).value > 0.0;
        while !bright(radiance.frame()) || measure(radiance.frame().pixel(0, 0)) > error {
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
    let relative = naive(probability, error, seeds, |estimate| estimate.relative_error());
    let absolute = naive(probability, error, seeds, |estimate| estimate.error);
    for (name, averages) in [("relative", relative), ("absolute", absolute)] {
        println!("one in {:<5} to {:>3} %, naive, {name}: {averages}", 1.0 / probability, 100.0 * error);
        assert!(!averages.holds(), "{name}: {averages}");
    }
}

/// What ends an observation.
#[derive(Debug, Clone, Copy, PartialEq)]
enum End {
    /// The error that was asked for.
    Error,
    /// So many samples a pixel.
    Samples(u64),
    /// The clock.
    Time,
}

/// Pixels of one picture.
const PIXELS: u64 = 4;

/// Averages of several pixels that a rule ends: their mean where the rule looks at the total, and each by itself
/// where it looks at pixels.
fn ruled_pixels(probability: f64, stop: Stop, scope: Scope, end: End, seeds: u64) -> Averages {
    let world = lamp_at(5.0, 1.0 / probability);
    let stop = stop.scope(scope);
    let all = each_seed(1..seeds + 1, |seed| {
        let mut radiance = RadiancePipeline::new();
        let observer = glimpses(probability, FrameShape::Line(PIXELS as usize)).seed(seed);
        let report = observer.observe_until(&world, &mut radiance, stop).unwrap();
        let (frame, reached) = (radiance.frame(), report.convergence.map(|c| c.reached));
        let samples = frame.samples(0);
        match end {
            End::Error => assert_eq!(reached, Some(true), "seed {seed}: {report}"),
            End::Samples(limit) => {
                assert!(reached != Some(true) && samples == limit, "seed {seed}: {report}")
            }
            End::Time => {
                assert!(reached != Some(true) && report.elapsed < seconds(5.0), "seed {seed}: {report}");
            }
        }
        match scope {
            // How many samples the clock leaves has nothing to do with their values.
            _ if samples < 1000 && end == End::Time => vec![],
            Scope::Total => vec![(frame.average_of(0), samples)],
            Scope::Pixels(_) | Scope::Above { .. } => {
                (0..PIXELS as usize).map(|p| (frame.pixel(p, 0), samples)).collect()
            }
        }
    });
    Averages::of(&all.concat(), 1.0)
}

#[test]
fn averages_ended_by_any_rule_are_right() {
    let (total, all, half) = (Scope::Total, Scope::Pixels(1.0), Scope::Pixels(0.5));
    let above = Scope::Above { level: 0.5, share: 1.0 };
    let (relative, absolute) = (Stop::relative_error, Stop::absolute_error);
    // The error asked for of a total is that of the sum of the pixels.
    let summed = absolute(0.1 * PIXELS as f64);
    let cases = [
        ("relative, total", 0.1, relative(0.1), total, End::Error, 4000),
        ("absolute, total", 0.1, summed, total, End::Error, 4000),
        ("relative, all pixels", 0.1, relative(0.1), all, End::Error, 1000),
        ("absolute, all pixels", 0.1, absolute(0.1), all, End::Error, 1000),
        ("relative, pixels above a level", 0.1, relative(0.1), above, End::Error, 1000),
        ("relative or absolute", 0.1, relative(0.01).or_absolute_error(0.1), all, End::Error, 1000),
        ("absolute or relative", 0.1, absolute(0.01).or_relative_error(0.1), half, End::Error, 1000),
        ("relative, half of the pixels", 0.1, relative(0.1), half, End::Error, 1000),
        ("absolute, half of the pixels", 0.1, absolute(0.1), half, End::Error, 1000),
        ("relative, all pixels", 0.01, relative(0.1), all, End::Error, 250),
        ("absolute, half of the pixels", 0.01, absolute(0.1), half, End::Error, 250),
        ("samples", 0.1, Stop::samples(1000), total, End::Samples(1000), 2000),
        (
            "relative or samples that come first",
            0.1,
            relative(0.01).or_samples(1000),
            all,
            End::Samples(1000),
            1000,
        ),
        (
            "absolute or samples that come first",
            0.1,
            absolute(0.01).or_samples(1000),
            total,
            End::Samples(1000),
            2000,
        ),
        (
            "relative or samples that come later",
            0.1,
            relative(0.1).or_samples(100_000),
            total,
            End::Error,
            2000,
        ),
        (
            "absolute or time that comes later",
            0.1,
            absolute(0.1).or_after(minutes(5.0)),
            half,
            End::Error,
            1000,
        ),
    ];
    for (name, probability, stop, scope, end, seeds) in cases {
        let averages = ruled_pixels(probability, stop, scope, end, seeds);
        println!("{name:<36} one in {:<3}: {averages}", 1.0 / probability);
        assert!(averages.holds(), "{name}, one in {}: {averages}", 1.0 / probability);
    }
}

#[test]
fn averages_ended_by_the_clock_are_right() {
    let time = seconds(0.02);
    let cases = [
        ("time", Stop::time(time), Scope::Total),
        ("relative or time that comes first", Stop::relative_error(1e-6).or_after(time), Scope::Pixels(1.0)),
        ("absolute or time that comes first", Stop::absolute_error(1e-6).or_after(time), Scope::Total),
    ];
    for (name, stop, scope) in cases {
        // How many samples there are is the machine's affair, and with it all that follows but the mean.
        let averages = ruled_pixels(0.1, stop, scope, End::Time, 100);
        println!("{name:<36}: {averages}");
        assert!(averages.z().abs() < 4.0, "{name}: {averages}");
        assert!(averages.mean.count() >= 20 && averages.mean.error() < 0.02, "{name}: {averages}");
    }
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
