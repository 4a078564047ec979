//! Averages that a stop rule ends, of samples of which few are bright.

use raysect::observer::RadiancePipeline;
use raysect::prelude::*;

use crate::score::Averages;
use crate::seeds::each_seed;
use crate::sensors::{glimpse, lamp_at};

/// Samples of 1 / `probability`, seen with this probability: their mean is 1.
fn averages(probability: f64, seeds: u64, average: impl Fn(&World, u64) -> (Estimate, u64) + Sync) -> Averages {
    let world = lamp_at(5.0, 1.0 / probability);
    Averages::of(&each_seed(1..seeds + 1, |seed| average(&world, seed)), 1.0)
}

/// Averages of the library's rule.
fn ruled(probability: f64, error: f64, seeds: u64) -> Averages {
    averages(probability, seeds, |world, seed| {
        let mut radiance = RadiancePipeline::new();
        let observer = glimpse(probability).seed(seed);
        let report = observer.observe_until(world, &mut radiance, Stop::relative_error(error)).unwrap();
        assert!(report.convergence.is_some_and(|c| c.reached), "seed {seed}: {report}");
        (radiance.frame().pixel(0, 0), radiance.frame().samples(0))
    })
}

/// Averages of a rule that stops at the first good-looking error of the samples that it averages.
fn naive(probability: f64, error: f64, seeds: u64) -> Averages {
    averages(probability, seeds, |world, seed| {
        let mut radiance = RadiancePipeline::new();
        let observer = glimpse(probability).seed(seed).pixel_samples(32);
        loop {
            observer.observe(world, &mut radiance).unwrap();
            let estimate = radiance.frame().pixel(0, 0);
            if estimate.relative_error() <= error {
                return (estimate, radiance.frame().samples(0));
            }
        }
    })
}

#[test]
fn probe() {
    for (p, e, n) in [(0.1, 0.1, 4000), (0.1, 0.05, 1000), (0.01, 0.1, 1000), (0.001, 0.1, 1000)] {
        let t = std::time::Instant::now();
        println!("{p} {e} {} {:?}", ruled(p, e, n), t.elapsed());
    }
    println!("naive {}", naive(0.1, 0.1, 4000));
    println!("naive {}", naive(0.1, 0.1, 1000));
}
