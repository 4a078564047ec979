//! The statistics of every pixel and channel.

use raysect_math::format_with_error;

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

/// What every block begins with: samples, samples that are not zero, largest absolute value.
const HEADER: usize = 3;

/// Numbers of each channel in a block that is still open: mean, sum of squared deviations from it, sum of squared
/// differences within pairs, first value of a pair.
const OPEN: usize = 4;

/// Numbers of each channel in the complete blocks: the first three of these.
const CLOSED: usize = 3;

/// Folds a sample into an open block (B. P. Welford, *Technometrics* 4(3), 1962).
#[inline]
pub(crate) fn add_sample(block: &mut [f64], sample: &[f64]) {
    let second = block[0] as u32 % 2 == 1;
    let count = block[0] + 1.0;
    block[0] = count;
    let inverse = 1.0 / count;
    let mut largest = 0.0f64;
    for (moments, &x) in block[HEADER..].chunks_exact_mut(OPEN).zip(sample) {
        let deviation = x - moments[0];
        moments[0] += deviation * inverse;
        moments[1] += deviation * (x - moments[0]);
        if second {
            moments[2] += (x - moments[3]) * (x - moments[3]);
        }
        moments[3] = x;
        largest = largest.max(x.abs());
    }
    if largest > 0.0 {
        block[1] += 1.0;
        block[2] = block[2].max(largest);
    }
}

/// Appends a complete block to those before it (T. Chan, G. Golub, R. LeVeque, *Updating Formulae and a Pairwise
/// Algorithm for Computing Sample Variances*, STAN-CS-79-773, 1979).
fn close_block(into: &mut [f64], from: &[f64]) {
    let (n, m) = (into[0], from[0]);
    let total = n + m;
    into[0] = total;
    into[1] += from[1];
    into[2] = into[2].max(from[2]);
    for (a, b) in into[HEADER..].chunks_exact_mut(CLOSED).zip(from[HEADER..].chunks_exact(OPEN)) {
        let difference = b[0] - a[0];
        a[0] += difference * (m / total);
        a[1] += b[1] + difference * difference * (n * m / total);
        a[2] += b[2];
    }
}

/// Mean, variance and number of samples of every pixel and channel.
#[derive(Debug, Clone, PartialEq)]
pub struct Frame {
    name: String,
    unit: String,
    shape: FrameShape,
    channels: Vec<String>,
    /// What was observed, so that nothing else is added to it.
    fingerprint: String,
    /// Complete blocks, merged in order; and the block that is still open. Pixel by pixel.
    closed: Vec<f64>,
    open: Vec<f64>,
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
            closed: Vec::new(),
            open: Vec::new(),
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

    /// Makes room for an observation, unless there is already; it must have passed [`check`](Self::check).
    pub(crate) fn prepare(&mut self, shape: FrameShape, channels: Vec<String>, fingerprint: &str) {
        if self.is_empty() {
            let room = |numbers: usize| vec![0.0; shape.pixels() * (HEADER + numbers * channels.len())];
            (self.closed, self.open) = (room(CLOSED), room(OPEN));
            (self.shape, self.channels, self.fingerprint) = (shape, channels, fingerprint.to_owned());
        }
    }

    /// Forgets all samples.
    pub fn clear(&mut self) {
        self.closed.clear();
        self.open.clear();
        self.shape = FrameShape::Line(0);
    }

    /// True before the first observation.
    pub fn is_empty(&self) -> bool {
        self.closed.is_empty()
    }

    /// Its name.
    pub fn name(&self) -> &str {
        &self.name
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

    pub(crate) fn open_stride(&self) -> usize {
        HEADER + OPEN * self.channels.len()
    }

    /// The complete blocks of a pixel.
    fn closed_blocks(&self, pixel: usize) -> &[f64] {
        let stride = HEADER + CLOSED * self.channels.len();
        &self.closed[pixel * stride..(pixel + 1) * stride]
    }

    /// The block of a pixel that is still open.
    pub(crate) fn open_block(&self, pixel: usize) -> &[f64] {
        &self.open[pixel * self.open_stride()..(pixel + 1) * self.open_stride()]
    }

    /// A frame of the same shape without samples.
    pub(crate) fn emptied(&self) -> Self {
        Self { closed: vec![0.0; self.closed.len()], open: vec![0.0; self.open.len()], ..self.clone() }
    }

    /// A copy that has the open blocks only.
    pub(crate) fn open_part(&self) -> Self {
        Self {
            name: self.name.clone(),
            unit: self.unit.clone(),
            shape: self.shape,
            channels: self.channels.clone(),
            fingerprint: String::new(),
            closed: Vec::new(),
            open: self.open.clone(),
        }
    }

    /// Takes the next block of a pixel: the open one carried on, or a new one.
    pub(crate) fn put_block(&mut self, pixel: usize, block: &[f64]) {
        let (open, closed) = (self.open_stride(), HEADER + CLOSED * self.channels.len());
        let place = &mut self.open[pixel * open..(pixel + 1) * open];
        if block[0] >= BLOCK as f64 {
            close_block(&mut self.closed[pixel * closed..(pixel + 1) * closed], block);
            place.fill(0.0);
        } else {
            place.copy_from_slice(block);
        }
    }

    /// Samples of a pixel; none before the first observation.
    pub fn samples(&self, pixel: usize) -> u64 {
        if self.is_empty() {
            return 0;
        }
        self.closed_blocks(pixel)[0] as u64 + self.open_block(pixel)[0] as u64
    }

    /// Samples of a pixel that were not zero in every channel.
    pub fn contributing(&self, pixel: usize) -> u64 {
        self.closed_blocks(pixel)[1] as u64 + self.open_block(pixel)[1] as u64
    }

    /// The largest absolute value of any sample of a pixel.
    pub fn largest(&self, pixel: usize) -> f64 {
        self.closed_blocks(pixel)[2].max(self.open_block(pixel)[2])
    }

    /// Mean and standard error of a pixel in a channel. One sample has an infinite error.
    ///
    /// The samples of a complete block are stratified: two lie in each part of the pixel, and their difference tells
    /// the variance there (W. G. Cochran, *Sampling Techniques*, § 5A.12). A few pairs that happen to be equal do not
    /// make an error of zero: the variance that the samples would have without strata is added, divided by the square
    /// of the number of pairs. Samples of a block that is not yet complete count as
    /// independent ones of the whole pixel, which is never too small either.
    pub fn pixel(&self, pixel: usize, channel: usize) -> Estimate {
        let (closed, open) = (self.closed_blocks(pixel), self.open_block(pixel));
        let (n, rest) = (closed[0], open[0]);
        let (at, rest_at) = (HEADER + CLOSED * channel, HEADER + OPEN * channel);
        let (mean, squares, pairs) = (closed[at], closed[at + 1], closed[at + 2]);
        let (rest_mean, rest_squares) = (open[rest_at], open[rest_at + 1]);
        if n == 0.0 {
            let error = if rest < 2.0 { f64::INFINITY } else { (rest_squares / (rest - 1.0) / rest).sqrt() };
            return Estimate { value: rest_mean, error };
        }
        let variance = pairs + squares * (n / (n - 1.0)) * (4.0 / (n * n));
        // Squares about a mean of n samples that are independent of them are too large by 1 + 1/n.
        let difference = rest_mean - mean;
        let rest_variance = (rest_squares + rest * difference * difference) * (n / (n + 1.0));
        let total = n + rest;
        Estimate {
            value: mean + difference * (rest / total),
            error: (variance + rest_variance).sqrt() / total,
        }
    }

    fn each(&self, of: impl Fn(Estimate) -> f64) -> Vec<f64> {
        let channels = self.channels.len();
        let places = (0..self.shape.pixels()).flat_map(|p| (0..channels).map(move |c| (p, c)));
        places.map(|(p, c)| of(self.pixel(p, c))).collect()
    }

    /// The means, \[row, column, channel\].
    pub fn mean(&self) -> Vec<f64> {
        self.each(|e| e.value)
    }

    /// The standard errors of the means, \[row, column, channel\].
    #[doc(alias = "errors")]
    pub fn error(&self) -> Vec<f64> {
        self.each(|e| e.error)
    }

    /// Squared standard error times number of samples, \[row, column, channel\]: the variance of independent samples
    /// that would do as well; infinite for fewer than two samples.
    pub fn variance(&self) -> Vec<f64> {
        let channels = self.channels.len();
        let scale = |p: usize| self.samples(p) as f64;
        let errors = self.error();
        errors.iter().enumerate().map(|(i, e)| e * e * scale(i / channels)).collect()
    }

    /// Sum over all pixels of a channel. Pixels are independent, so their variances add.
    pub fn total_of(&self, channel: usize) -> Estimate {
        let all = (0..self.shape.pixels()).map(|p| self.pixel(p, channel));
        let (value, variance) = all.fold((0.0, 0.0), |(v, e), x| (v + x.value, e + x.error * x.error));
        Estimate { value, error: variance.sqrt() }
    }

    /// Sum over all pixels of the first channel.
    pub fn total(&self) -> Estimate {
        self.total_of(0)
    }

    /// Mean over all pixels of a channel.
    pub fn average_of(&self, channel: usize) -> Estimate {
        let (total, pixels) = (self.total_of(channel), self.shape.pixels() as f64);
        Estimate { value: total.value / pixels, error: total.error / pixels }
    }

    /// Samples of all pixels together.
    pub fn total_samples(&self) -> u64 {
        (0..self.shape.pixels()).map(|p| self.samples(p)).sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use raysect_math::{Rng, Statistics};

    /// A frame of one pixel with these samples.
    fn frame_of(samples: &[f64]) -> Frame {
        let mut frame = Frame::new("test", "1");
        frame.prepare(FrameShape::Single, vec!["a".into(), "dark".into()], "x");
        let mut block = vec![0.0; frame.open_stride()];
        for (number, &x) in samples.iter().enumerate() {
            add_sample(&mut block, &[x, 0.0]);
            if (number as u64 + 1).is_multiple_of(BLOCK) {
                frame.put_block(0, &block);
                block.fill(0.0);
            }
        }
        if !(samples.len() as u64).is_multiple_of(BLOCK) {
            frame.put_block(0, &block);
        }
        frame
    }

    /// The standard error, written down once more: pairs of complete blocks, deviations of the rest.
    fn expected_error(samples: &[f64]) -> f64 {
        let n = samples.len();
        let whole = n / BLOCK as usize * BLOCK as usize;
        let mean = samples[..whole].iter().sum::<f64>() / whole as f64;
        let squares = |of: &[f64]| of.iter().map(|x| (x - mean).powi(2)).sum::<f64>();
        let pairs: f64 = samples[..whole].chunks(2).map(|p| (p[0] - p[1]).powi(2)).sum();
        let count = whole as f64;
        let within = pairs + squares(&samples[..whole]) * count / (count - 1.0) * 4.0 / (count * count);
        (within + squares(&samples[whole..]) * count / (count + 1.0)).sqrt() / n as f64
    }

    #[test]
    fn fewer_samples_than_a_block_have_the_plain_statistics() {
        let mut rng = Rng::new(8);
        let samples: Vec<f64> = (1..BLOCK).map(|_| rng.normal(1e3, 1.0)).collect();
        let mut plain = Statistics::new();
        samples.iter().for_each(|x| plain.add(*x));
        let found = frame_of(&samples).pixel(0, 0);
        assert!((found.value / plain.mean() - 1.0).abs() < 1e-14);
        assert!((found.error / plain.error() - 1.0).abs() < 1e-10);
        assert_eq!(frame_of(&samples[..1]).pixel(0, 0).error, f64::INFINITY);
        assert_eq!(frame_of(&[]).pixel(0, 0).error, f64::INFINITY);
    }

    #[test]
    fn complete_blocks_are_judged_by_their_pairs() {
        let mut rng = Rng::new(9);
        let samples: Vec<f64> = (0..1000).map(|_| rng.normal(1e3, 1.0)).collect();
        for count in [BLOCK as usize, BLOCK as usize + 1, 5 * BLOCK as usize, 1000] {
            let (frame, part) = (frame_of(&samples[..count]), &samples[..count]);
            let found = frame.pixel(0, 0);
            let mean = part.iter().sum::<f64>() / count as f64;
            assert!((found.value / mean - 1.0).abs() < 1e-14, "{count}");
            assert!((found.error / expected_error(part) - 1.0).abs() < 1e-9, "{count}: {}", found.error);
            assert_eq!((frame.samples(0), frame.contributing(0)), (count as u64, count as u64));
            assert_eq!(frame.pixel(0, 1), Estimate { value: 0.0, error: 0.0 });
        }
    }

    /// Mean square of the differences from the truth, and of the errors, of many averages of a pixel that is bright
    /// on one side of an edge.
    fn edge(count: u64, stratified: bool) -> (f64, f64) {
        let (mut differences, mut errors) = (0.0, 0.0);
        for seed in 0..4000 {
            let mut strata = crate::strata::Strata::default();
            let samples: Vec<f64> = (0..count)
                .map(|s| {
                    let rng = Rng::new(seed * count + s);
                    let mut rng = if stratified { rng.confined_to(strata.of(seed, 0, 0, s)) } else { rng };
                    let (x, y) = (rng.uniform(), rng.uniform());
                    f64::from(0.7 * x + y < 0.8)
                })
                .collect();
            let found = frame_of(&samples).pixel(0, 0);
            // The area below a line of slope −0.7 from (0, 0.8) to (1, 0.1).
            differences += (found.value - 0.45).powi(2) / 4000.0;
            errors += found.error * found.error / 4000.0;
        }
        (differences, errors)
    }

    #[test]
    fn equal_pairs_do_not_make_an_error_of_zero() {
        let samples: Vec<f64> = (0..BLOCK).map(|s| if s / 2 == 5 { 10.0 } else { 0.0 }).collect();
        let found = frame_of(&samples).pixel(0, 0);
        assert!(found.error > 0.01 * found.value, "{found:?}");
        assert_eq!(frame_of(&[3.0; BLOCK as usize]).pixel(0, 0), Estimate { value: 3.0, error: 0.0 });
    }

    #[test]
    fn strata_reduce_the_error_and_the_error_bar_knows() {
        for blocks in [1, 4, 16] {
            let count = blocks * BLOCK;
            let (plain, _) = edge(count, false);
            let (differences, errors) = edge(count, true);
            assert!((plain * count as f64 / (0.45 * 0.55) - 1.0).abs() < 0.1);
            assert!(differences < 0.4 * plain, "{differences} {plain}");
            assert!((errors / differences - 1.0).abs() < 0.1, "{errors} {differences}");
        }
        // Where the last block is not complete the error bar may be too long, but never too short.
        let (differences, errors) = edge(2 * BLOCK + BLOCK / 2, true);
        assert!(errors > 0.95 * differences, "{errors} {differences}");
    }

    #[test]
    fn a_frame_takes_nothing_else() {
        let mut frame = Frame::new("test", "1");
        let shape = FrameShape::Single;
        let channels = ["a".to_owned()];
        frame.prepare(shape, channels.to_vec(), "one range");
        assert!(frame.check(shape, &channels, "one range").is_ok());
        assert!(frame.check(shape, &channels, "another range").is_err());
        frame.clear();
        assert!(frame.check(shape, &channels, "another range").is_ok());
    }
}
