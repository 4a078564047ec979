use std::fmt;
use std::time::Duration;

use crate::stop::CONTRIBUTING;
use crate::{Estimate, Frame, Pipeline};

/// The relative variance of the variance beyond which MCNP believes no error (X-5 Monte Carlo Team, *MCNP – Version 5*,
/// LA-UR-03-1987, ch. 2 § VI, the fifth of its ten checks). Ten equal samples among many dark ones have it, and so has a
/// single sample that makes a third of the variance. The share of the total that a sample makes tells less: of ten equal
/// samples each makes a tenth, without any error.
const UNSURE: f64 = 0.1;
/// The share of the pixels that may have a firefly: far less than the one in twenty that a 95 % interval leaves out.
const MANY: f64 = 0.01;
/// From so many samples on, one that makes half of a pixel is a firefly.
const ENOUGH: u64 = 32;
/// The share of a pixel's value that a firefly makes, at least.
const HALF: f64 = 0.5;

/// What a pipeline has gathered in all, and what tells whether its error bars can be believed.
#[derive(Debug, Clone, PartialEq)]
pub struct Reading {
    /// Name of the pipeline.
    pub pipeline: String,
    /// Name of its first channel.
    pub channel: String,
    /// Unit of the total.
    pub unit: String,
    /// The sum of the first channel over all pixels observed, of all samples that the pipeline has.
    pub total: Estimate,
    /// How fast the total becomes known, 1 / (R² t) [1/s], with its relative error R and the time t that its samples
    /// have taken (those of earlier observations at the speed of this one). It does not depend on the number of
    /// samples, and a better method has a higher one. Infinite without noise, 0 where nothing is known.
    pub figure_of_merit: f64,
    /// Samples of all pixels.
    pub samples: u64,
    /// How many of them brought any light.
    pub contributing: u64,
    /// The largest share of the total that a single sample makes, 0 … 1: the largest absolute value that any channel had
    /// in a sample of a pixel ([`Frame::largest`]), over the number of samples of that pixel, over the largest absolute
    /// total of any channel.
    pub largest_share: f64,
    /// The variance of the squared error of the total, relative to its square: Σ Vₚ eₚ⁴ / (Σ eₚ²)² over the pixels, with
    /// their errors eₚ in the first channel and [`Frame::variance_of_variance`] Vₚ. Below 0.1 the error is known to about
    /// 15 %; infinite where no error is known.
    pub variance_of_variance: f64,
    /// In how many pixels, of at least 32 samples, one sample makes more than half of the value. The error of such a
    /// pixel is large, and is right; but about as many pixels again have missed their bright sample, and their errors
    /// know nothing of it.
    pub fireflies: usize,
    /// Pixels observed.
    pub pixels: usize,
}

impl Reading {
    /// Of a pipeline, after an observation that has added samples in a time.
    pub(crate) fn of(pipeline: &dyn Pipeline, added: u64, elapsed: Duration) -> Self {
        let frame = pipeline.frame();
        let totals: Vec<Estimate> = (0..frame.channels().len()).map(|c| frame.total_of(c)).collect();
        let total = totals.first().copied().unwrap_or(Estimate { value: 0.0, error: f64::INFINITY });
        let brightest = totals.iter().map(|total| total.value.abs()).fold(0.0, f64::max);
        let samples = frame.total_samples();
        let seconds = elapsed.as_secs_f64() * samples as f64 / added as f64;
        let merit = 1.0 / (total.relative_error().powi(2) * seconds);
        let (mut largest, mut fireflies) = (0.0, 0);
        for pixel in frame.observed_pixels() {
            let count = frame.samples(pixel);
            let (sample, mean) = (frame.largest(pixel), mean(frame, pixel));
            largest = f64::max(largest, sample / count.max(1) as f64);
            fireflies += usize::from(count >= ENOUGH && sample > HALF * mean * count as f64);
        }
        Self {
            pipeline: frame.name().to_owned(),
            channel: frame.channels().first().cloned().unwrap_or_default(),
            unit: pipeline.total_unit().to_owned(),
            total,
            figure_of_merit: if merit.is_nan() { 0.0 } else { merit },
            samples,
            contributing: frame.observed_pixels().map(|pixel| frame.contributing(pixel)).sum(),
            largest_share: if brightest > 0.0 { largest / brightest } else { 0.0 },
            variance_of_variance: variance_of_variance(frame),
            fireflies,
            pixels: frame.observed_pixels().count(),
        }
    }

    /// What speaks against its error bars.
    pub(crate) fn warnings(&self) -> Vec<String> {
        let mut all = Vec::new();
        let Self { pipeline, contributing, fireflies, pixels, .. } = self;
        let noisy = self.total.relative_error() > 1e-12;
        if noisy && *contributing < CONTRIBUTING {
            all.push(format!(
                "{contributing} samples of '{pipeline}' brought light: too few to know an error by"
            ));
        } else if noisy && self.variance_of_variance > UNSURE {
            all.push(format!(
                "the variance of '{pipeline}' is itself known to {:.0} % only, with one sample that makes {:.2} % of the \
                 total: others like it may be missing, and the error does not know of them",
                100.0 * self.variance_of_variance.sqrt(),
                100.0 * self.largest_share
            ));
        }
        if *fireflies as f64 > MANY * *pixels as f64 && *pixels > 1 {
            all.push(format!(
                "in {fireflies} of {pixels} pixels of '{pipeline}' one sample makes more than half of the value: about \
                 as many have missed theirs, and their errors do not know of it"
            ));
        }
        all
    }
}

/// Of the total of the first channel.
fn variance_of_variance(frame: &Frame) -> f64 {
    let (mut fourth, mut second) = (0.0, 0.0);
    for pixel in frame.observed_pixels() {
        let variance = frame.pixel(pixel, 0).error.powi(2);
        fourth += frame.variance_of_variance(pixel) * variance * variance;
        second += variance;
    }
    let ratio = fourth / (second * second);
    match second {
        0.0 => 0.0,
        _ if ratio.is_finite() => ratio,
        _ => f64::INFINITY,
    }
}

/// The largest absolute mean of any channel of a pixel.
fn mean(frame: &Frame, pixel: usize) -> f64 {
    let channels = 0..frame.channels().len();
    channels.map(|channel| frame.pixel(pixel, channel).value.abs()).fold(0.0, f64::max)
}

impl fmt::Display for Reading {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { pipeline, channel, unit, total, .. } = self;
        let name = if pipeline == channel { String::new() } else { format!(", {channel}") };
        let light = 100.0 * self.contributing as f64 / (self.samples as f64).max(1.0);
        write!(
            f,
            "{pipeline}{name}: {total} {unit} in all, figure of merit {:.3e} 1/s; {light:.1} % of the samples brought \
             light, the largest is {:.1e} of the total",
            self.figure_of_merit, self.largest_share
        )
    }
}
