//! What the skewness of samples does to the errors of their means.

use super::Frame;

/// Samples of a pixel that its skewness is taken from: of fewer there is nothing to be learnt.
const ENOUGH: f64 = 30.0;

/// By how much intervals are too short, in units of γ² / n with the γ that samples show, which is less than the true one
/// (the largest of n samples limits it to √n): chosen so that 68 % and 95 % intervals of log-normal samples and of those
/// of the Cornell box both come close to what they should cover. With the true γ it would be 0.2 for one error and 0.6
/// for 1.96 errors of log-normal samples, and 0.2 and 1.3 of exponential ones.
const SHORTFALL: f64 = 1.2;

/// Where more would be needed, samples say little about anything.
const LONGEST: f64 = 1.5;

/// The factor of an error whose mean has a skewness.
fn stretch(squared_skewness_of_mean: f64) -> f64 {
    (1.0 + SHORTFALL * squared_skewness_of_mean).min(LONGEST)
}

impl Frame {
    /// Works out the skewness of its samples, once they have changed.
    ///
    /// Pixels of one frame have samples of a similar shape, but too few each to tell it: those that tell most are those
    /// that have been lucky to see a rare bright one. What counts is therefore the mean over all of them.
    pub(super) fn settle(&mut self) {
        let (mut count, mut sum) = (0.0, 0.0);
        for pixel in self.observed_pixels() {
            let moments = self.moments(pixel);
            if self.contributing(pixel) as f64 >= ENOUGH && moments.second > 0.0 {
                count += 1.0;
                sum += moments.third * (moments.count / moments.second).sqrt() / moments.second;
            }
        }
        let skewness = sum / f64::max(count, 1.0);
        self.squared_skewness = if skewness.is_finite() { skewness * skewness } else { 0.0 };
    }

    pub(super) fn settled(mut self) -> Self {
        self.settle();
        self
    }

    /// The factor of the error of a pixel.
    pub(super) fn stretch(&self, pixel: usize) -> f64 {
        stretch(self.squared_skewness / self.samples(pixel).max(1) as f64)
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
        stretch(if squared.is_finite() { squared } else { 0.0 })
    }
}
