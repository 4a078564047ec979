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
pub const BLOCK: u64 = 128;

/// What every block begins with: samples, samples that are not zero, largest absolute value.
pub(crate) const HEADER: usize = 3;

/// Folds samples into one block of plain numbers: the header, then mean and sum of squared deviations of each
/// channel (B. P. Welford, *Technometrics* 4(3), 1962).
#[inline]
pub(crate) fn add_sample(block: &mut [f64], sample: &[f64]) {
    let count = block[0] + 1.0;
    block[0] = count;
    let inverse = 1.0 / count;
    let mut largest = 0.0f64;
    for (moments, &x) in block[HEADER..].chunks_exact_mut(2).zip(sample) {
        let deviation = x - moments[0];
        moments[0] += deviation * inverse;
        moments[1] += deviation * (x - moments[0]);
        largest = largest.max(x.abs());
    }
    if largest > 0.0 {
        block[1] += 1.0;
        block[2] = block[2].max(largest);
    }
}

/// Appends one block to another (T. Chan, G. Golub, R. LeVeque, *Updating Formulae and a Pairwise Algorithm for
/// Computing Sample Variances*, STAN-CS-79-773, 1979).
pub(crate) fn merge_block(into: &mut [f64], from: &[f64]) {
    let (n, m) = (into[0], from[0]);
    if m == 0.0 {
        return;
    }
    let total = n + m;
    into[0] = total;
    into[1] += from[1];
    into[2] = into[2].max(from[2]);
    for (a, b) in into[HEADER..].chunks_exact_mut(2).zip(from[HEADER..].chunks_exact(2)) {
        let difference = b[0] - a[0];
        a[0] += difference * (m / total);
        a[1] += b[1] + difference * difference * (n * m / total);
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
            let size = shape.pixels() * (HEADER + 2 * channels.len());
            (self.shape, self.channels, self.fingerprint) = (shape, channels, fingerprint.to_owned());
            (self.closed, self.open) = (vec![0.0; size], vec![0.0; size]);
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

    pub(crate) fn stride(&self) -> usize {
        HEADER + 2 * self.channels.len()
    }

    fn range(&self, pixel: usize) -> std::ops::Range<usize> {
        pixel * self.stride()..(pixel + 1) * self.stride()
    }

    /// The block of a pixel that is still open.
    pub(crate) fn open_block(&self, pixel: usize) -> &[f64] {
        &self.open[self.range(pixel)]
    }

    /// A frame of the same shape without samples.
    pub(crate) fn emptied(&self) -> Self {
        let zeros = vec![0.0; self.closed.len()];
        Self { closed: zeros.clone(), open: zeros, ..self.clone() }
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
        let range = self.range(pixel);
        if block[0] >= BLOCK as f64 {
            merge_block(&mut self.closed[range.clone()], block);
            self.open[range].fill(0.0);
        } else {
            self.open[range].copy_from_slice(block);
        }
    }

    /// All samples of a pixel as one block.
    pub(crate) fn pixel_block(&self, pixel: usize) -> Vec<f64> {
        let mut block = self.closed[self.range(pixel)].to_vec();
        merge_block(&mut block, self.open_block(pixel));
        block
    }

    /// Samples of a pixel; none before the first observation.
    pub fn samples(&self, pixel: usize) -> u64 {
        if self.is_empty() {
            return 0;
        }
        let start = self.range(pixel).start;
        self.closed[start] as u64 + self.open[start] as u64
    }

    /// Samples of a pixel that were not zero in every channel.
    pub fn contributing(&self, pixel: usize) -> u64 {
        let start = self.range(pixel).start;
        self.closed[start + 1] as u64 + self.open[start + 1] as u64
    }

    /// The largest absolute value of any sample of a pixel.
    pub fn largest(&self, pixel: usize) -> f64 {
        let start = self.range(pixel).start;
        self.closed[start + 2].max(self.open[start + 2])
    }

    /// Mean and standard error of a pixel in a channel. One sample has an infinite error.
    pub fn pixel(&self, pixel: usize, channel: usize) -> Estimate {
        let block = self.pixel_block(pixel);
        let (n, mean, squares) = (block[0], block[HEADER + 2 * channel], block[HEADER + 2 * channel + 1]);
        let error = if n < 2.0 { f64::INFINITY } else { (squares / (n - 1.0) / n).sqrt() };
        Estimate { value: mean, error }
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

    /// The unbiased variances of the samples, \[row, column, channel\]; infinite for fewer than two samples.
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

    #[test]
    fn blocks_add_up_to_the_plain_statistics() {
        let mut rng = Rng::new(8);
        let shape = FrameShape::Image { columns: 2, rows: 1 };
        let mut frame = Frame::new("test", "1");
        frame.prepare(shape, vec!["a".into(), "b".into()], "x");
        let mut plain = Statistics::new();
        let mut block = vec![0.0; frame.stride()];
        for _ in 0..1000 {
            let x = rng.normal(1e3, 1.0);
            plain.add(x);
            add_sample(&mut block, &[x, 0.0]);
            if block[0] >= BLOCK as f64 {
                frame.put_block(1, &block);
                block.fill(0.0);
            }
        }
        frame.put_block(1, &block);
        let (mean, error) = (frame.pixel(1, 0).value, frame.pixel(1, 0).error);
        assert!((mean / plain.mean() - 1.0).abs() < 1e-14 && (error / plain.error() - 1.0).abs() < 1e-10);
        assert_eq!((frame.samples(1), frame.samples(0), frame.contributing(1)), (1000, 0, 1000));
        assert_eq!(frame.pixel(1, 1), Estimate { value: 0.0, error: 0.0 });
        assert_eq!(frame.pixel(0, 0).error, f64::INFINITY);
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
