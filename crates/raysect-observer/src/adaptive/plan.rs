//! From noise to numbers of samples.

use super::noise::{Noise, percentile};
use super::{AdaptiveSampling, Rule};
use crate::BLOCK;

/// Samples a pixel with which a pilot begins, at least.
const PILOT: u64 = 32;
/// Of how many samples of a pixel one is the pilot's.
const PILOT_EVERY: u64 = 16;
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

    /// How many samples the pilot is to have of a pixel that is to have so many: no fewer than of the average one, and
    /// whole blocks if there are enough.
    pub(crate) fn pilot(&self, samples: u64) -> u64 {
        let least = PILOT.min(self.sampling.samples / 4).max(2);
        least.max(samples.max(self.sampling.samples) / PILOT_EVERY / BLOCK * BLOCK)
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

#[cfg(test)]
mod tests {
    use super::*;

    /// What a rule makes of noise that does not change.
    fn planned(sampling: AdaptiveSampling, noise: &[f64]) -> Vec<u64> {
        let mut plan = SamplePlan::new(&sampling, noise.len());
        let noise = Noise(noise.to_vec());
        while plan.extend(&noise) {}
        plan.samples
    }

    #[test]
    fn products_below_the_least_are_raised_and_the_others_share_the_rest() {
        assert_eq!(factor(&[1.0, 2.0, 3.0], 0.0, 60.0), 10.0);
        // 20 for the least, 80 for weights of 2 and 3.
        assert_eq!(factor(&[1.0, 2.0, 3.0], 20.0, 100.0), 16.0);
        assert_eq!(factor(&[0.0, 0.0], 10.0, 100.0), 0.0);
        assert_eq!(factor(&[1.0, 1.0], 10.0, 20.0), 10.0);
    }

    #[test]
    fn noise_is_answered_by_variances_for_equal_errors_and_by_deviations_for_a_total() {
        let free = |sampling: AdaptiveSampling| sampling.min_samples(1).unwrap().ratio(1e3).unwrap();
        assert_eq!(planned(free(AdaptiveSampling::equal_errors(100)), &[1.0, 3.0]), [20, 180]);
        assert_eq!(planned(free(AdaptiveSampling::total(100)), &[1.0, 3.0]), [50, 150]);
        // 25 at least, and not more than twice as many as another.
        assert_eq!(planned(AdaptiveSampling::total(100), &[1.0, 9.0]), [25, 175]);
        assert_eq!(planned(AdaptiveSampling::total(300).ratio(2.0).unwrap(), &[1.0, 9.0]), [200, 400]);
    }

    #[test]
    fn the_worst_pixels_come_first() {
        let mono = AdaptiveSampling::mono(160).fraction(0.5).unwrap();
        // Passes of 10 samples, from 40 on, each for one of the two.
        assert_eq!(planned(mono, &[1.0, 9.0]), [40, 280]);
        assert_eq!(planned(mono.ratio(2.0).unwrap(), &[1.0, 9.0]), [105, 215]);
        let found = planned(mono, &[1.0, 2f64.sqrt()]);
        assert!(found[0] + found[1] == 320 && found[1].abs_diff(2 * found[0]) <= 20, "{found:?}");
        // What is alike is treated alike.
        assert_eq!(planned(mono, &[2.0; 7]), [160; 7]);
    }

    #[test]
    fn accurate_pixels_are_left_alone() {
        for sampling in [AdaptiveSampling::mono(1600), AdaptiveSampling::equal_errors(1600)] {
            let sampling = sampling.cutoff(0.1).unwrap();
            // Variances of 1 and 9 to 10 %: 100 and 900 samples, and 400 at least.
            let found = planned(sampling, &[1.0, 3.0]);
            assert!(found[0] == 400 && (900..1000).contains(&found[1]), "{found:?}");
            assert_eq!(planned(sampling, &[0.0; 3]), [400; 3]);
            let mut plan = SamplePlan::new(&sampling, 3);
            let noise = Noise(vec![1.0, 3.0, 4.0]);
            assert_eq!(plan.inaccurate(&noise), 2);
            while plan.extend(&noise) {}
            assert_eq!(plan.inaccurate(&noise), 0);
            let few = sampling.min_samples(1).unwrap();
            let mut plan = SamplePlan::new(&few, 3);
            let noise = Noise(vec![1.0, 3.0, 100.0]);
            while plan.extend(&noise) {}
            assert!(plan.inaccurate(&noise) > 0);
        }
    }

    #[test]
    fn a_pilot_takes_a_sixteenth_in_whole_blocks() {
        let plan = SamplePlan::new(&AdaptiveSampling::mono(1000), 1);
        assert_eq!([0, 1000, 1023, 1024, 2000].map(|samples| plan.pilot(samples)), [32, 32, 32, 64, 96]);
        let large = SamplePlan::new(&AdaptiveSampling::mono(2000), 1);
        assert_eq!([0, 2000, 4000].map(|samples| large.pilot(samples)), [96, 96, 224]);
        let small = SamplePlan::new(&AdaptiveSampling::mono(40), 1);
        assert_eq!(small.pilot(10), 10);
        assert_eq!(SamplePlan::new(&AdaptiveSampling::mono(1), 1).pilot(1), 2);
    }
}
