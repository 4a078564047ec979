//! What the samples of one lane add up to.

use super::moments::Moments;
use super::{BLOCK, Estimate};

/// What every block begins with: samples, samples that are not zero, largest absolute value; then the moments of what
/// the channels of each sample add up to.
const HEADER: usize = 7;

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
    let inverse = 1.0 / count;
    let (mut largest, mut sum) = (0.0f64, 0.0);
    for (moments, &x) in block[HEADER..].chunks_exact_mut(OPEN).zip(sample) {
        let deviation = x - moments[0];
        moments[0] += deviation * inverse;
        moments[1] += deviation * (x - moments[0]);
        if second {
            moments[2] += (x - moments[3]) * (x - moments[3]);
        }
        moments[3] = x;
        largest = largest.max(x.abs());
        sum += x;
    }
    let mut moments = Moments::read(block);
    moments.add(sum);
    moments.write(block);
    block[0] = count;
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
    Moments::read(into).merged(&Moments::read(from)).write(into);
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

/// The sums of one lane: for each pixel its complete blocks, merged in order, and the block that is still open.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Sums {
    channels: usize,
    pub(crate) closed: Vec<f64>,
    pub(crate) open: Vec<f64>,
}

impl Sums {
    /// Without samples.
    pub(crate) fn new(pixels: usize, channels: usize) -> Self {
        let room = |numbers: usize| vec![0.0; pixels * (HEADER + numbers * channels)];
        Self { channels, closed: room(CLOSED), open: room(OPEN) }
    }

    /// From what was kept of it; none if that is not of the right size.
    pub(crate) fn from_parts(
        pixels: usize,
        channels: usize,
        closed: Vec<f64>,
        open: Vec<f64>,
    ) -> Option<Self> {
        let size = |numbers: usize| {
            let stride = numbers.checked_mul(channels)?.checked_add(HEADER)?;
            stride.checked_mul(pixels)
        };
        let fits = size(CLOSED) == Some(closed.len()) && size(OPEN) == Some(open.len());
        fits.then_some(Self { channels, closed, open })
    }

    /// Numbers that a sample has.
    pub(crate) fn channels(&self) -> usize {
        self.channels
    }

    /// Numbers of a pixel in the block that is still open.
    pub(crate) fn open_stride(&self) -> usize {
        HEADER + OPEN * self.channels
    }

    fn closed_stride(&self) -> usize {
        HEADER + CLOSED * self.channels
    }

    /// The complete blocks of a pixel.
    fn closed_blocks(&self, pixel: usize) -> &[f64] {
        let stride = self.closed_stride();
        &self.closed[pixel * stride..(pixel + 1) * stride]
    }

    /// The block of a pixel that is still open.
    pub(crate) fn open_block(&self, pixel: usize) -> &[f64] {
        let stride = self.open_stride();
        &self.open[pixel * stride..(pixel + 1) * stride]
    }

    /// A copy that has the open blocks only.
    pub(crate) fn open_part(&self) -> Self {
        Self { channels: self.channels, closed: Vec::new(), open: self.open.clone() }
    }

    /// Takes the next block of a pixel: the open one carried on, or a new one.
    pub(crate) fn put_block(&mut self, pixel: usize, block: &[f64]) {
        let (open, closed) = (self.open_stride(), self.closed_stride());
        let place = &mut self.open[pixel * open..(pixel + 1) * open];
        if block[0] >= BLOCK as f64 {
            close_block(&mut self.closed[pixel * closed..(pixel + 1) * closed], block);
            place.fill(0.0);
        } else {
            place.copy_from_slice(block);
        }
    }

    /// Takes over all that another has of a pixel, instead of what it has itself.
    pub(crate) fn copy_pixel(&mut self, pixel: usize, other: &Self) {
        let (open, closed) = (self.open_stride(), self.closed_stride());
        self.open[pixel * open..(pixel + 1) * open].copy_from_slice(other.open_block(pixel));
        self.closed[pixel * closed..(pixel + 1) * closed].copy_from_slice(other.closed_blocks(pixel));
    }

    /// Samples of a pixel.
    pub(crate) fn samples(&self, pixel: usize) -> u64 {
        self.closed_blocks(pixel)[0] as u64 + self.open_block(pixel)[0] as u64
    }

    /// Samples of a pixel that were not zero in every channel.
    pub(crate) fn contributing(&self, pixel: usize) -> u64 {
        self.closed_blocks(pixel)[1] as u64 + self.open_block(pixel)[1] as u64
    }

    /// The largest absolute value of any sample of a pixel.
    pub(crate) fn largest(&self, pixel: usize) -> f64 {
        self.closed_blocks(pixel)[2].max(self.open_block(pixel)[2])
    }

    /// Moments of what the channels of each sample of a pixel add up to.
    pub(crate) fn moments(&self, pixel: usize) -> Moments {
        Moments::read(self.closed_blocks(pixel)).merged(&Moments::read(self.open_block(pixel)))
    }

    /// Mean and standard error of a pixel in a channel, not made longer; see [`Frame::pixel`](super::Frame::pixel).
    pub(crate) fn estimate(&self, pixel: usize, channel: usize) -> Estimate {
        let (closed, open) = (self.closed_blocks(pixel), self.open_block(pixel));
        let total = closed[0] + open[0];
        let (mean, rest_mean) = (closed[HEADER + CLOSED * channel], open[HEADER + OPEN * channel]);
        let value = if closed[0] == 0.0 { rest_mean } else { mean + (rest_mean - mean) * (open[0] / total) };
        Estimate { value, error: squared_error_of_sum(closed, open, channel).sqrt() / total }
    }

    /// Sum over all channels of the squared standard errors of the sum of all samples of a pixel.
    pub(crate) fn squared_errors_of_sums(&self, pixel: usize) -> f64 {
        let (closed, open) = (self.closed_blocks(pixel), self.open_block(pixel));
        (0..self.channels).map(|channel| squared_error_of_sum(closed, open, channel)).sum()
    }
}

/// Squared standard error of the sum of all samples in the blocks of a pixel, in a channel.
#[inline]
fn squared_error_of_sum(closed: &[f64], open: &[f64], channel: usize) -> f64 {
    let (n, rest) = (closed[0], open[0]);
    let (at, rest_at) = (HEADER + CLOSED * channel, HEADER + OPEN * channel);
    let (mean, squares, pairs) = (closed[at], closed[at + 1], closed[at + 2]);
    let (rest_mean, rest_squares) = (open[rest_at], open[rest_at + 1]);
    if n == 0.0 {
        return if rest < 2.0 { f64::INFINITY } else { rest_squares / (rest - 1.0) * rest };
    }
    let variance = pairs + squares * (n / (n - 1.0)) * (4.0 / (n * n));
    // Squares about a mean of n samples that are independent of them are too large by 1 + 1/n.
    let difference = rest_mean - mean;
    let rest_variance = (rest_squares + rest * difference * difference) * (n / (n + 1.0));
    variance + rest_variance
}
