//! From noise to numbers of samples.

use super::noise::{Noise, percentile};
use super::{AdaptiveSampling, Rule};

/// Samples a pixel with which a pilot begins.
const PILOT: u64 = 32;
/// Of how many samples of a pixel one is the pilot's.
const PILOT_EVERY: u64 = 8;
/// In how many passes the average number of samples would be reached if all pixels took part.
const PASSES: u64 = 16;

/// How many samples each pixel is to have, as far as that is decided.
#[derive(Debug, Clone)]
pub(crate) struct SamplePlan {
    sampling: AdaptiveSampling,
    /// Of the pixels that are observed, in their order.
    samples: Vec<u64>,
    /// How many all pixels together were to have by now.
    due: u64,
}

impl SamplePlan {
    /// As many for every pixel as it has in any case.
    pub(crate) fn new(sampling: &AdaptiveSampling, pixels: usize) -> Self {
        let samples = vec![sampling.least(); pixels];
        Self { sampling: *sampling, due: samples.iter().sum(), samples }
    }

    /// Of the pixels that are observed, in their order.
    pub(crate) fn samples(&self) -> &[u64] {
        &self.samples
    }

    /// How many samples the pilot is to have of a pixel, before anything more is decided about it: whole blocks, once it
    /// has more than those that it begins with.
    pub(crate) fn pilot(&self, samples: u64) -> u64 {
        let first = PILOT.min(self.sampling.samples / 4).max(2);
        first.max(samples / PILOT_EVERY / crate::BLOCK * crate::BLOCK)
    }

    fn allowed(&self) -> u64 {
        self.sampling.samples.saturating_mul(self.samples.len() as u64)
    }

    /// Decides about some more samples; false if there is nothing more to decide.
    pub(crate) fn extend(&mut self, noise: &Noise) -> bool {
        match self.sampling.rule {
            Rule::Worst => self.add_to_worst(noise),
            Rule::Equal => {
                let variances: Vec<f64> = noise.0.iter().map(|r| r * r).collect();
                self.share_out(&variances, self.sampling.target().map(|error| error.powi(-2)))
            }
            Rule::Total => self.share_out(&noise.0, None),
        }
    }

    /// How many pixels are to have a larger relative error than is asked of them.
    pub(crate) fn inaccurate(&self, noise: &Noise) -> usize {
        let cutoff = self.sampling.cutoff;
        self.errors(noise).filter(|error| *error > cutoff * (1.0 + 1e-12)).count()
    }

    fn errors(&self, noise: &Noise) -> impl Iterator<Item = f64> {
        noise.0.iter().zip(&self.samples).map(|(spread, &samples)| spread / (samples as f64).sqrt())
    }

    /// A pass over the pixels of the largest errors, and those that have too few samples.
    fn add_to_worst(&mut self, noise: &Noise) -> bool {
        let AdaptiveSampling { samples, fraction, ratio, cutoff, .. } = self.sampling;
        let errors: Vec<f64> = self.errors(noise).collect();
        let level = percentile(&mut errors.clone(), 100.0 * (1.0 - fraction));
        let most = self.samples.iter().copied().max().unwrap_or(0);
        let least = (most as f64 / ratio) as u64;
        let chosen: Vec<usize> = (0..errors.len())
            .filter(|&i| self.samples[i] < least || (errors[i] > cutoff && errors[i] >= level))
            .collect();
        let left = self.allowed().saturating_sub(self.samples.iter().sum());
        let each = samples.div_ceil(PASSES).min(left / (chosen.len() as u64).max(1));
        chosen.iter().for_each(|&i| self.samples[i] += each);
        each > 0 && !chosen.is_empty()
    }

    /// Twice as many samples as before, as far as they are allowed, in proportion to weights, but no more than `most`
    /// times them.
    fn share_out(&mut self, weights: &[f64], most: Option<f64>) -> bool {
        if self.due >= self.allowed() {
            return false;
        }
        self.due = self.allowed().min(self.due.saturating_mul(2));
        let largest = weights.iter().copied().fold(0.0, f64::max);
        let weights: Vec<f64> = weights.iter().map(|w| w.max(largest / self.sampling.ratio)).collect();
        let least = self.sampling.least() as f64;
        let factor = factor(&weights, least, self.due as f64);
        for (samples, weight) in self.samples.iter_mut().zip(&weights) {
            let share = match most {
                Some(most) if most < factor => (most * weight).ceil(),
                _ => factor * weight,
            };
            *samples = share.max(least) as u64;
        }
        true
    }
}

/// By what weights must be multiplied so that the products, raised to `least` where they are below it, add up to a
/// total; zero if that is impossible.
fn factor(weights: &[f64], least: f64, total: f64) -> f64 {
    let mut sorted = weights.to_vec();
    sorted.sort_by(|a, b| b.total_cmp(a));
    let (mut sum, mut factor) = (0.0, 0.0);
    for (index, weight) in sorted.iter().enumerate() {
        // With the others at the least.
        let rest = least * (sorted.len() - index - 1) as f64;
        sum += weight;
        let next = (total - rest) / sum;
        if !next.is_finite() || next * weight < least {
            break;
        }
        factor = next;
    }
    factor
}
