//! Many pictures of the same scene, compared with the truth.

use raysect::prelude::*;

use crate::score::{Scatter, Scores};
use crate::seeds::each_seed;
use crate::sensors::Bins;
use crate::truth::{self, BINS, Known, SIDE, Truth};

/// The bin that is looked at by itself.
const BIN: usize = 7;
/// Where the truth has the whole spectrum.
const WHOLE: usize = BINS;

/// Everything that a number of samples is judged by.
#[derive(Debug, Clone, Default)]
pub(crate) struct Stage {
    /// Each pixel, over the whole spectrum.
    pub(crate) pixel: Kind,
    /// Each pixel in one bin.
    pub(crate) bin: Kind,
    /// Each pixel in every bin.
    pub(crate) bins: Kind,
    /// The sum over all pixels, over the whole spectrum and in one bin.
    pub(crate) total: Scores,
    pub(crate) bin_total: Scores,
}

/// What is found about one kind of element.
#[derive(Debug, Clone, Default)]
pub(crate) struct Kind {
    /// All of them.
    pub(crate) all: Scores,
    /// Those whose means are normally distributed after so many samples.
    pub(crate) normal: Scores,
    /// The squares of differences and errors of all of them.
    pub(crate) scatter: Scatter,
}

impl Kind {
    /// Adds an estimate of a known element, and the variance that was found, after so many samples.
    fn add(&mut self, (estimate, variance): (Estimate, f64), known: &Known, samples: u64) {
        if known.is_dark() {
            // There is nothing to be wrong about.
            assert_eq!(estimate, Estimate { value: 0.0, error: 0.0 });
            return;
        }
        self.all.add(estimate, known.value);
        if known.is_normal_after(samples) {
            self.normal.add(estimate, known.value);
        }
        // The mean square of errors is that of differences before they are made longer for skewed samples.
        let error = (variance / samples as f64).sqrt();
        self.scatter.add(Estimate { error, ..estimate }, known.value, known.variance() / samples as f64);
    }

    /// Adds what others have found.
    fn extend(&mut self, other: Self) {
        self.all.extend(other.all);
        self.normal.extend(other.normal);
        self.scatter.extend(other.scatter);
    }
}

impl Stage {
    /// The kinds of elements of a pixel, with their names.
    pub(crate) fn kinds(&self) -> [(&'static str, &Kind); 3] {
        [("pixel", &self.pixel), ("pixel in bin 7", &self.bin), ("pixel in every bin", &self.bins)]
    }

    /// Adds what other pictures have shown.
    fn extend(&mut self, other: Self) {
        self.pixel.extend(other.pixel);
        self.bin.extend(other.bin);
        self.bins.extend(other.bins);
        self.total.extend(other.total);
        self.bin_total.extend(other.bin_total);
    }
}

/// A frame and its variances, which take a while.
struct Found<'a> {
    frame: &'a Frame,
    variances: Vec<f64>,
}

impl<'a> Found<'a> {
    fn new(frame: &'a Frame) -> Self {
        Self { frame, variances: frame.variance() }
    }

    /// An element, and the variance of its samples.
    fn at(&self, pixel: usize, channel: usize) -> (Estimate, f64) {
        let place = pixel * self.frame.channels().len() + channel;
        (self.frame.pixel(pixel, channel), self.variances[place])
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

    /// Compares with the truth; element by element if it is known of elements.
    fn judge(&self, truth: &Truth, samples: u64) -> Stage {
        let mut stage = Stage::default();
        let frames = [self.radiance.frame(), self.one.frame(), self.every.frame()];
        let [whole, one, every] = frames.map(Found::new);
        if truth.len() == SIDE * SIDE {
            for (pixel, known) in truth.iter().enumerate() {
                stage.pixel.add(whole.at(pixel, 0), &known[WHOLE], samples);
                stage.bin.add(one.at(pixel, 0), &known[BIN], samples);
                for (bin, known) in known[..BINS].iter().enumerate() {
                    stage.bins.add(every.at(pixel, bin), known, samples);
                }
            }
        }
        let total = |channel: usize| truth.iter().map(|known| known[channel].value).sum();
        stage.total.add(self.radiance.frame().total(), total(WHOLE));
        stage.bin_total.add(self.one.frame().total(), total(BIN));
        stage
    }
}

/// What is found after numbers of samples, each reached by the seeds from 1 to its own last one, by pictures of so
/// many pixels to a side.
pub(crate) fn observe<const N: usize>(side: usize, stages: [(u64, u64); N]) -> [Stage; N] {
    let (world, truth) = (truth::world(), truth::coarse(truth::load(), side));
    let last = stages.iter().map(|(_, last)| *last).max().unwrap_or(0);
    let found = each_seed(1..last + 1, |seed| {
        let camera = truth::camera(side).engine(Serial).seed(seed);
        let mut picture = Picture::new();
        stages.map(|(samples, last)| {
            (seed <= last).then(|| {
                picture.continue_to(samples, &camera, &world);
                picture.judge(&truth, samples)
            })
        })
    });
    let mut all = [const { None::<Stage> }; N].map(Option::unwrap_or_default);
    for stages in found {
        for (all, stage) in all.iter_mut().zip(stages) {
            if let Some(stage) = stage {
                all.extend(stage);
            }
        }
    }
    all
}
