//! 68 % of the intervals of one error, and 95 % of those of 1.96 errors, must cover the truth.

use raysect::prelude::*;

use crate::score::Scores;
use crate::seeds::each_seed;
use crate::sensors::Bins;
use crate::truth::{self, BINS, SIDE, Truth};

/// Samples of a pixel after which errors are tested.
const STAGES: [u64; 3] = [64, 256, 1024];
/// The bin that is tested by itself.
const BIN: usize = 7;
/// Where the truth has the whole spectrum.
const ALL: usize = BINS;

/// What a picture is tested for, after each stage.
#[derive(Debug, Clone, Default)]
struct Stage {
    pixel: Scores,
    bin: Scores,
    bins: Scores,
    total: Scores,
    bin_total: Scores,
}

impl Stage {
    /// Each kind of number with its name.
    fn kinds(&self) -> [(&'static str, &Scores); 5] {
        [
            ("pixel", &self.pixel),
            ("pixel in a bin", &self.bin),
            ("pixel in every bin", &self.bins),
            ("total", &self.total),
            ("total in a bin", &self.bin_total),
        ]
    }

    /// Adds another picture of the same stage.
    fn extend(&mut self, other: Self) {
        self.pixel.extend(other.pixel);
        self.bin.extend(other.bin);
        self.bins.extend(other.bins);
        self.total.extend(other.total);
        self.bin_total.extend(other.bin_total);
    }
}

/// Three pipelines that see the same rays.
struct Picture {
    radiance: RadiancePipeline2D,
    one: Bins,
    every: Bins,
}

impl Picture {
    fn new() -> Self {
        Self { radiance: RadiancePipeline2D::new(), one: Bins::new(BIN..BIN + 1), every: Bins::new(0..BINS) }
    }

    /// Goes on to a number of samples a pixel.
    fn continue_to(&mut self, samples: u64, camera: &PinholeCamera, world: &World) {
        let mut all = (&mut self.radiance, &mut self.one, &mut self.every);
        camera.observe_until(world, &mut all, Stop::samples(samples)).unwrap();
    }

    /// Compares with the truth.
    fn scores(&self, truth: &Truth) -> Stage {
        let mut stage = Stage::default();
        let total = |channel: usize| truth.iter().map(|t| t[channel].value).sum();
        for (pixel, truth) in truth.iter().enumerate() {
            stage.pixel.add(self.radiance.frame().pixel(pixel, 0), truth[ALL].value);
            stage.bin.add(self.one.frame().pixel(pixel, 0), truth[BIN].value);
            // The lamp is dark in the first bin, where there is nothing to be wrong about.
            for (bin, truth) in truth[..BINS].iter().enumerate().skip(1) {
                stage.bins.add(self.every.frame().pixel(pixel, bin), truth.value);
            }
        }
        stage.total.add(self.radiance.frame().total_of(0), total(ALL));
        stage.bin_total.add(self.one.frame().total_of(0), total(BIN));
        stage
    }
}

/// Scores of pictures of so many pixels to a side, after each of the stages; `seeds` says how many seeds reach it.
fn observe(side: usize, stages: &[u64], seeds: &[u64]) -> Vec<Stage> {
    let (world, truth) = (truth::world(), coarse(&truth::load(), side));
    let each = each_seed(1..seeds[0] + 1, |seed| {
        let camera = truth::camera(side).engine(Serial).seed(seed);
        let mut picture = Picture::new();
        let reached = stages.iter().zip(seeds).filter(|(_, last)| seed <= **last);
        let scores = reached.map(|(&samples, _)| {
            picture.continue_to(samples, &camera, &world);
            picture.scores(&truth)
        });
        scores.collect::<Vec<_>>()
    });
    let mut all = vec![Stage::default(); stages.len()];
    for scores in each {
        all.iter_mut().zip(scores).for_each(|(all, stage)| all.extend(stage));
    }
    all
}

/// The truth of fewer and larger pixels: their averages.
fn coarse(truth: &Truth, side: usize) -> Truth {
    let each = SIDE / side;
    let average = |row: usize, column: usize, channel: usize| {
        let (rows, columns) = (row * each..(row + 1) * each, column * each..(column + 1) * each);
        let inside = rows.flat_map(|r| columns.clone().map(move |c| truth[r * SIDE + c][channel].value));
        inside.sum::<f64>() / (each * each) as f64
    };
    let pixel = |p: usize| {
        let channels = 0..=BINS;
        channels.map(|c| Estimate { value: average(p / side, p % side, c), error: 0.0 }).collect()
    };
    (0..side * side).map(pixel).collect()
}

#[test]
fn probe() {
    let t = std::time::Instant::now();
    for (side, stages, seeds) in [(8, &STAGES[..], &[200u64, 200, 100][..]), (2, &STAGES[..], &[1500, 1500, 1500])] {
        for (s, stage) in stages.iter().zip(observe(side, stages, seeds)) {
            for (kind, scores) in stage.kinds() {
                println!("{side} {s:5} {kind:20} {} | {}", scores.coverage(1.0), scores.coverage(0.9));
            }
        }
        println!("{:?}", t.elapsed());
    }
}
#[test]
fn probe_pixels() {
    let stages = observe(8, &[64], &[200]);
    for pixel in 0..64 {
        let mut s = Scores::default();
        s.0.extend(stages[0].pixel.0.iter().skip(pixel).step_by(64));
        let low = s.0.iter().filter(|z| **z < -1.96).count();
        let high = s.0.iter().filter(|z| **z > 1.96).count();
        print!("{:.3}/{:.3}({low},{high})  ", s.coverage(1.0).one, s.coverage(1.0).two);
        if pixel % 8 == 7 { println!() }
    }
    let low = stages[0].pixel.0.iter().filter(|z| **z < -1.96).count();
    println!("{low}");
}
