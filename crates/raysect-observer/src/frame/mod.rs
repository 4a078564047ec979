//! The statistics of every pixel and channel.

mod bytes;
mod lengthening;
#[cfg(test)]
mod lengthening_tests;
mod merge;
mod moments;
mod neighbours;
mod sums;
#[cfg(test)]
mod tests;

use std::collections::BTreeMap;

use moments::Moments;
use raysect_math::format_with_error;
pub(crate) use sums::{Sums, add_sample};

use crate::{FrameShape, ObserverError};

/// A value with its standard error; it prints as `3.127(9)`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Estimate {
    /// The value.
    pub value: f64,
    /// Its standard error; infinite if it is not known.
    pub error: f64,
}

impl Estimate {
    /// Error relative to the value; infinite for a value of zero.
    pub fn relative_error(&self) -> f64 {
        if self.value == 0.0 { f64::INFINITY } else { self.error / self.value.abs() }
    }
}

impl std::fmt::Display for Estimate {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&format_with_error(self.value, self.error))
    }
}

/// The samples of a pixel are folded in blocks of this many, at absolute places: it fixes the bits of every result,
/// whatever the number of threads and passes.
pub const BLOCK: u64 = 32;

/// Mean, variance and number of samples of every pixel and channel.
///
/// Pixels that a mask has left out have no samples: their mean is 0 with an infinite error, and sums and averages over
/// the frame leave them out. Pixels that were to be observed and have no samples make those errors infinite.
///
/// Samples of several [lanes](crate::Observer::lane) are kept apart, and put together in ascending order of the lanes
/// when a number is asked for: the order in which they came has no influence.
#[derive(Debug, Clone, PartialEq)]
pub struct Frame {
    name: String,
    unit: String,
    shape: FrameShape,
    channels: Vec<String>,
    /// What was observed, so that nothing else is added to it.
    fingerprint: String,
    /// Which pixels are to have samples.
    observed: Vec<bool>,
    lanes: BTreeMap<u64, Sums>,
    /// By how much the error of each pixel is made longer; see [`lengthening`].
    stretches: Vec<f64>,
}

impl Frame {
    /// An empty frame with a name and the unit of its values, which takes its shape from the first observation.
    pub fn new(name: impl Into<String>, unit: impl Into<String>) -> Self {
        Self {
            name: name.into(),
            unit: unit.into(),
            shape: FrameShape::Line(0),
            channels: Vec::new(),
            fingerprint: String::new(),
            observed: Vec::new(),
            lanes: BTreeMap::new(),
            stretches: Vec::new(),
        }
    }

    /// Refuses an observation that is not of the same fingerprint as what it has.
    pub(crate) fn check(
        &self,
        shape: FrameShape,
        channels: &[String],
        fingerprint: &str,
    ) -> Result<(), ObserverError> {
        if self.is_empty() {
            return Ok(());
        }
        if self.fingerprint != fingerprint || self.shape != shape || self.channels != channels {
            let (name, before, now) = (self.name.clone(), self.fingerprint.clone(), fingerprint.to_owned());
            return Err(ObserverError::OtherFrame { name, before, now });
        }
        Ok(())
    }

    /// Makes room for an observation of some pixels in a lane, unless there is already; it must have passed
    /// [`check`](Self::check).
    pub(crate) fn prepare(
        &mut self,
        shape: FrameShape,
        channels: Vec<String>,
        fingerprint: &str,
        lane: u64,
        mask: &[bool],
    ) {
        if self.is_empty() {
            self.observed = vec![false; shape.pixels()];
            (self.shape, self.channels, self.fingerprint) = (shape, channels, fingerprint.to_owned());
        }
        self.observed.iter_mut().zip(mask).for_each(|(seen, now)| *seen |= now);
        self.lanes.entry(lane).or_insert_with(|| Sums::new(shape.pixels(), self.channels.len()));
    }

    /// Forgets all samples.
    pub fn clear(&mut self) {
        self.lanes.clear();
        self.observed.clear();
        self.shape = FrameShape::Line(0);
        self.stretches.clear();
    }

    /// True before the first observation.
    pub fn is_empty(&self) -> bool {
        self.lanes.is_empty()
    }

    /// Its name.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Gives it another name.
    pub(crate) fn rename(&mut self, name: String) {
        self.name = name;
    }

    /// The unit of its values.
    pub fn unit(&self) -> &str {
        &self.unit
    }

    /// How its pixels are arranged.
    pub fn shape(&self) -> FrameShape {
        self.shape
    }

    /// The names of its channels.
    pub fn channels(&self) -> &[String] {
        &self.channels
    }

    /// True if a mask or a region of interest has left a pixel out of every observation.
    pub fn is_masked(&self, pixel: usize) -> bool {
        !self.observed.get(pixel).is_some_and(|seen| *seen)
    }

    /// The pixels that no mask has left out.
    pub fn observed_pixels(&self) -> impl Iterator<Item = usize> {
        self.observed.iter().enumerate().filter(|(_, seen)| **seen).map(|(pixel, _)| pixel)
    }

    /// The lanes that it has samples of, in ascending order.
    pub fn lanes(&self) -> impl Iterator<Item = u64> {
        self.lanes.keys().copied()
    }

    /// A frame of the same kind without samples, for some of the pixels in one lane.
    pub(crate) fn emptied(&self, lane: u64, mask: &[bool]) -> Self {
        let lanes = BTreeMap::from([(lane, Sums::new(self.shape.pixels(), self.channels.len()))]);
        self.with(mask, lanes)
    }

    /// What it has of some of the pixels in one lane.
    pub(crate) fn part(&self, lane: u64, mask: &[bool]) -> Self {
        let lanes = self.lanes.get_key_value(&lane).map(|(lane, sums)| (*lane, sums.clone()));
        self.with(mask, lanes.into_iter().collect())
    }

    fn with(&self, mask: &[bool], lanes: BTreeMap<u64, Sums>) -> Self {
        Self {
            name: self.name.clone(),
            unit: self.unit.clone(),
            shape: self.shape,
            channels: self.channels.clone(),
            fingerprint: self.fingerprint.clone(),
            observed: mask.to_vec(),
            lanes,
            stretches: Vec::new(),
        }
        .settled()
    }

    /// The sums of a lane, to be worked on; they are given back by [`put_lane`](Self::put_lane).
    pub(crate) fn take_lane(&mut self, lane: u64) -> Sums {
        let empty = || Sums::new(self.shape.pixels(), self.channels.len());
        self.lanes.remove(&lane).unwrap_or_else(empty)
    }

    pub(crate) fn put_lane(&mut self, lane: u64, sums: Sums) {
        self.lanes.insert(lane, sums);
        self.settle();
    }

    /// Samples of a pixel in one lane.
    pub(crate) fn lane_samples(&self, lane: u64, pixel: usize) -> u64 {
        self.lanes.get(&lane).map_or(0, |sums| sums.samples(pixel))
    }

    /// Samples of a pixel; none before the first observation.
    pub fn samples(&self, pixel: usize) -> u64 {
        self.lanes.values().map(|sums| sums.samples(pixel)).sum()
    }

    /// Samples of a pixel that were not zero in every channel.
    pub fn contributing(&self, pixel: usize) -> u64 {
        self.lanes.values().map(|sums| sums.contributing(pixel)).sum()
    }

    /// The largest absolute value of any sample of a pixel.
    pub fn largest(&self, pixel: usize) -> f64 {
        self.lanes.values().map(|sums| sums.largest(pixel)).fold(0.0, f64::max)
    }

    /// Mean and standard error of a pixel in a channel. One sample has an infinite error, and so has none.
    ///
    /// The samples of a complete block are stratified: two lie in each part of the pixel, and their difference tells
    /// the variance there (W. G. Cochran, *Sampling Techniques*, § 5A.12). A few pairs that happen to be equal do not
    /// make an error of zero: the variance that the samples would have without strata is added, divided by the square
    /// of the number of pairs. Samples of a block that is not yet complete count as
    /// independent ones of the whole pixel, which is never too small either. Lanes are independent of each other:
    /// their means are weighted by their numbers of samples.
    ///
    /// Few samples with rare bright ones among them know their own variance badly, and those that have not seen a bright
    /// one think it too small. Errors are therefore made longer in two ways, of which nothing is left once there are many
    /// samples; [`variance`](Self::variance) does without both.
    ///
    /// - Where its neighbours (those that touch it, one or two in a row of pixels) have a larger variance, that of a pixel
    ///   is raised by a share *w* of the way to their geometric mean: the share of the scatter of variances among
    ///   neighbours that their own uncertainty explains (B. Efron, C. Morris, JASA 68, 1973, for logarithms of variances).
    ///   It is never lowered, and raised at most as that of a pixel ten times as quiet as its neighbours: one that is
    ///   quieter still is likely another kind of pixel.
    /// - Intervals of means of skewed samples cover less than they should, to the first order by a term in γ² / n, with
    ///   the skewness γ of the samples (P. Hall, *The Bootstrap and Edgeworth Expansion*, 1992, § 2.6). The factor is
    ///   1 + 1.2 (1 − w)² γ² / n, at most 1.5, where γ is the mean of the skewness that the samples of each pixel of the
    ///   frame show: without neighbours 1.1 for 64 samples of γ = 2.3.
    pub fn pixel(&self, pixel: usize, channel: usize) -> Estimate {
        let estimate = self.normal(pixel, channel);
        Estimate { error: estimate.error * self.stretch(pixel), ..estimate }
    }

    /// The same as the samples of the pixel alone have it.
    fn normal(&self, pixel: usize, channel: usize) -> Estimate {
        let lanes = self.lanes.values().filter(|sums| sums.samples(pixel) > 0);
        let estimates = lanes.map(|sums| (sums.samples(pixel) as f64, sums.estimate(pixel, channel)));
        let together = estimates.reduce(|(n, a), (m, b)| {
            let total = n + m;
            let value = a.value + (b.value - a.value) * (m / total);
            (total, Estimate { value, error: (n * a.error).hypot(m * b.error) / total })
        });
        together.map_or(Estimate { value: 0.0, error: f64::INFINITY }, |(_, estimate)| estimate)
    }

    /// Sum over all channels of the squared error of a pixel, as its samples alone have it.
    fn squared_error(&self, pixel: usize) -> f64 {
        let lanes = self.lanes.values().filter(|sums| sums.samples(pixel) > 0);
        let (n, sum) = lanes.fold((0.0, 0.0), |(n, sum), sums| {
            (n + sums.samples(pixel) as f64, sum + sums.squared_errors_of_sums(pixel))
        });
        sum / (n * n)
    }

    /// Moments of what the channels of each sample of a pixel add up to.
    fn moments(&self, pixel: usize) -> Moments {
        self.lanes.values().fold(Moments::default(), |moments, sums| moments.merged(&sums.moments(pixel)))
    }

    /// Variance of the squared error of a pixel, relative to its square, of what its channels add up to: how much the
    /// error itself is to be believed. Σ(x − x̄)⁴ / (Σ(x − x̄)²)² − 1/n; 1 − 1/n if all of the variance is that of one
    /// sample; 0 for samples that are all alike, infinite for less than two. Below 0.1 errors are known to about 15 %
    /// (X-5 Monte Carlo Team, *MCNP – Version 5*, LA-UR-03-1987, ch. 2 § VI.E).
    pub fn variance_of_variance(&self, pixel: usize) -> f64 {
        self.moments(pixel).variance_of_variance()
    }

    fn each(&self, of: impl Fn(usize, usize) -> f64) -> Vec<f64> {
        let channels = self.channels.len();
        let places = (0..self.shape.pixels()).flat_map(|p| (0..channels).map(move |c| (p, c)));
        places.map(|(p, c)| of(p, c)).collect()
    }

    /// The means, \[row, column, channel\].
    pub fn mean(&self) -> Vec<f64> {
        self.each(|p, c| self.normal(p, c).value)
    }

    /// The standard errors of the means, \[row, column, channel\].
    #[doc(alias = "errors")]
    pub fn error(&self) -> Vec<f64> {
        self.each(|p, c| self.pixel(p, c).error)
    }

    /// Number of samples times the squared standard error that is not made longer, \[row, column, channel\]: the
    /// variance of independent samples that would do as well; infinite for fewer than two samples.
    pub fn variance(&self) -> Vec<f64> {
        self.each(|p, c| self.pixel_variance(p, c))
    }

    /// That of a pixel in a channel.
    pub(crate) fn pixel_variance(&self, pixel: usize, channel: usize) -> f64 {
        self.normal(pixel, channel).error.powi(2) * self.samples(pixel).max(1) as f64
    }

    /// Sum of a channel over all pixels but those that a mask has left out. Pixels are independent, so their variances
    /// add; and so do their third moments, which tell how skewed the sum is.
    pub fn total_of(&self, channel: usize) -> Estimate {
        let all = self.observed_pixels().map(|p| self.normal(p, channel));
        let (value, variance) = all.fold((0.0, 0.0), |(v, e), x| (v + x.value, e + x.error * x.error));
        Estimate { value, error: variance.sqrt() * self.total_stretch() }
    }

    /// Sum of the first channel over all pixels but those that a mask has left out.
    pub fn total(&self) -> Estimate {
        self.total_of(0)
    }

    /// Mean of a channel over all pixels but those that a mask has left out.
    pub fn average_of(&self, channel: usize) -> Estimate {
        let (total, pixels) = (self.total_of(channel), self.observed_pixels().count() as f64);
        Estimate { value: total.value / pixels, error: total.error / pixels }
    }

    /// Samples of all pixels together.
    pub fn total_samples(&self) -> u64 {
        (0..self.shape.pixels()).map(|p| self.samples(p)).sum()
    }
}
