//! By how much the errors of pixels are made longer, for few samples with rare bright ones among them.

use super::Frame;
use super::neighbours::Neighbourhood;

/// Samples of a pixel that something is learnt from: fewer tell nothing about themselves.
const ENOUGH: f64 = 30.0;

/// By how much intervals are too short, in units of γ² / n with the γ that samples show, which is less than the true one
/// (the largest of n samples limits it to √n), where the variance is known from the samples of the pixel alone. It goes
/// with the variance of the variance: with the square of the weight that these have in it. Chosen so that 68 % and 95 %
/// intervals come close to what they should cover, of log-normal, exponential and gamma distributed samples and of those
/// of the Cornell box. With the true γ and alone it would be 0.2 for one error and 0.6 for 1.96 errors of log-normal
/// samples, and 0.2 and 1.3 of exponential ones.
const SHORTFALL: f64 = 1.2;

/// Where more would be needed, samples say little about anything.
const LONGEST: f64 = 1.5;

/// The factor of an error whose mean has a skewness and whose variance has so much weight of samples of its own.
fn stretch(squared_skewness_of_mean: f64, own: f64) -> f64 {
    (1.0 + SHORTFALL * own * own * squared_skewness_of_mean).min(LONGEST)
}

/// What the samples of a pixel tell, all channels together.
pub(super) struct Told {
    /// How many they are.
    pub(super) samples: f64,
    /// Variance of a sample.
    pub(super) variance: f64,
    /// Their skewness γ; none if their sums are all alike.
    skewness: Option<f64>,
    /// Of what they add up to; see [`Frame::variance_of_variance`].
    pub(super) variance_of_variance: f64,
}

impl Frame {
    /// Works out by how much the errors of its pixels are made longer, once its samples have changed.
    pub(super) fn settle(&mut self) {
        let told: Vec<Option<Told>> = (0..self.observed.len()).map(|pixel| self.told(pixel)).collect();
        let (skewness, around) = (mean_skewness(&told), Neighbourhood::of(self.shape, &told));
        let factor = |(pixel, told): (usize, &Option<Told>)| {
            let samples = told.as_ref().map_or_else(|| self.samples(pixel).max(1) as f64, |t| t.samples);
            let own = 1.0 - around.weight(samples);
            around.stretch(pixel, samples) * stretch(skewness * skewness / samples, own)
        };
        self.stretches = told.iter().enumerate().map(factor).collect();
    }

    pub(super) fn settled(mut self) -> Self {
        self.settle();
        self
    }

    /// None if they are too few.
    fn told(&self, pixel: usize) -> Option<Told> {
        if (self.contributing(pixel) as f64) < ENOUGH {
            return None;
        }
        let (samples, moments) = (self.samples(pixel) as f64, self.moments(pixel));
        let skewness = moments.third * (moments.count / moments.second).sqrt() / moments.second;
        Some(Told {
            samples,
            variance: self.squared_error(pixel) * samples,
            skewness: (moments.second > 0.0).then_some(skewness),
            variance_of_variance: moments.variance_of_variance(),
        })
    }

    /// The factor of the error of a pixel.
    pub(super) fn stretch(&self, pixel: usize) -> f64 {
        self.stretches.get(pixel).copied().unwrap_or(1.0)
    }

    /// The factor of the errors of sums over all pixels.
    pub(super) fn total_stretch(&self) -> f64 {
        let (mut second, mut third) = (0.0, 0.0);
        for moments in self.observed_pixels().map(|p| self.moments(p)) {
            let n = moments.count.max(1.0);
            second += moments.second / (n * n);
            third += moments.third / (n * n * n);
        }
        let squared = third * third / (second * second * second);
        stretch(if squared.is_finite() { squared } else { 0.0 }, 1.0)
    }
}

/// The mean of the skewness γ that the samples of each pixel show.
///
/// Pixels of one frame have samples of a similar shape, but too few each to tell it: those that tell most are those
/// that have been lucky to see a rare bright one. What counts is therefore the mean over all of them.
fn mean_skewness(told: &[Option<Told>]) -> f64 {
    let all = told.iter().flatten().filter_map(|told| told.skewness);
    let (count, sum) = all.fold((0.0, 0.0), |(count, sum), skewness| (count + 1.0, sum + skewness));
    let skewness = sum / f64::max(count, 1.0);
    if skewness.is_finite() { skewness } else { 0.0 }
}
