//! Means with their standard errors, gathered sample by sample and merged in any order.

mod array;
mod block;
mod format;

pub use array::StatisticsArray;
pub use block::BlockStatistics;
pub use format::format_with_error;

use std::fmt;

use crate::MathError;

/// Count, mean and variance of the samples of one quantity.
///
/// Samples are added by Welford's update (B. P. Welford, *Note on a method for calculating corrected sums of
/// squares and products*, Technometrics 4, 1962) and sets of samples merged by the update of T. Chan, G.
/// Golub, R. LeVeque, *Updating formulae and a pairwise algorithm for computing sample variances*, Stanford
/// STAN-CS-79-773, 1979. Both keep the variance right when it is small beside the mean squared.
///
/// ```
/// use raysect_math::Statistics;
/// let (mut a, mut b) = (Statistics::new(), Statistics::new());
/// [1.0, 2.0].iter().for_each(|&x| a.add(x));
/// [3.0, 4.0].iter().for_each(|&x| b.add(x));
/// a.merge(&b);
/// assert_eq!((a.count(), a.mean(), a.variance()), (4, 2.5, 5.0 / 3.0));
/// assert_eq!(a.to_string(), "2.5(6)");
/// ```
#[doc(alias = "StatsBin")]
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Statistics {
    count: u64,
    mean: f64,
    /// Sum of the squared deviations from the mean.
    m2: f64,
}

impl Statistics {
    /// No samples yet.
    pub const fn new() -> Self {
        Self { count: 0, mean: 0.0, m2: 0.0 }
    }

    /// From the count, mean and unbiased variance of a set of samples.
    ///
    /// The variance of fewer than two samples is unknown: any that is not negative may stand for it, infinity
    /// included. Without samples the mean is not kept.
    ///
    /// # Errors
    /// [`MathError::OutOfRange`] for a mean that is not finite, a variance that is negative or NaN, or an
    /// infinite variance of two or more samples.
    pub fn from_parts(count: u64, mean: f64, variance: f64) -> Result<Self, MathError> {
        MathError::check(mean.is_finite(), mean, "mean", "", "finite")?;
        if count < 2 {
            MathError::check(variance >= 0.0, variance, "variance", "", "0 or more")?;
            return Ok(if count == 0 { Self::new() } else { Self { count, mean, m2: 0.0 } });
        }
        let admitted = (0.0..f64::INFINITY).contains(&variance);
        MathError::check(admitted, variance, "variance", "", "0 or more and finite")?;
        Ok(Self { count, mean, m2: variance * (count - 1) as f64 })
    }

    /// Adds one sample.
    #[doc(alias = "add_sample")]
    #[inline]
    pub fn add(&mut self, x: f64) {
        self.count = self.count.saturating_add(1);
        let delta = x - self.mean;
        self.mean += delta / self.count as f64;
        self.m2 += delta * (x - self.mean);
    }

    /// Adds the samples of another set.
    #[doc(alias = "combine_samples")]
    #[inline]
    pub fn merge(&mut self, other: &Self) {
        if other.count == 0 {
            return;
        }
        if self.count == 0 {
            *self = *other;
            return;
        }
        let (a, b) = (self.count as f64, other.count as f64);
        let delta = other.mean - self.mean;
        let share = b / (a + b);
        self.count = self.count.saturating_add(other.count);
        self.mean += delta * share;
        self.m2 += other.m2 + delta * delta * (a * share);
    }

    /// Forgets all samples.
    pub fn clear(&mut self) {
        *self = Self::new();
    }

    /// Number of samples.
    #[doc(alias = "samples")]
    #[inline]
    pub const fn count(&self) -> u64 {
        self.count
    }

    /// Mean of the samples [their unit]; 0 without samples.
    #[inline]
    pub const fn mean(&self) -> f64 {
        self.mean
    }

    /// Unbiased estimate of the variance of one sample [their unit squared]; infinite for fewer than two
    /// samples.
    #[inline]
    pub fn variance(&self) -> f64 {
        if self.count < 2 { f64::INFINITY } else { self.m2 / (self.count - 1) as f64 }
    }

    /// Standard error of the mean, √(variance / count) [unit of the samples]; infinite for fewer than two
    /// samples.
    #[inline]
    pub fn error(&self) -> f64 {
        if self.count < 2 { f64::INFINITY } else { (self.variance() / self.count as f64).sqrt() }
    }
}

impl fmt::Display for Statistics {
    /// The mean with its standard error, as [`format_with_error`] writes them.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&format_with_error(self.mean(), self.error()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Rng;
    use proptest::prelude::*;

    fn gather(values: &[f64]) -> Statistics {
        let mut statistics = Statistics::new();
        values.iter().for_each(|&x| statistics.add(x));
        statistics
    }

    /// Asserts agreement to 1e-12 for samples of size up to `scale`; for the variance σ², relative to its
    /// condition number 1 + scale / σ (T. Chan, G. Golub, R. LeVeque, *Algorithms for computing the sample
    /// variance*, 1983).
    fn assert_close(a: &Statistics, mean: f64, variance: f64, scale: f64) {
        assert!((a.mean() - mean).abs() <= 1e-12 * scale, "{a:?} {mean}");
        if a.count() > 1 {
            let tolerance = 1e-12 * (variance + scale * variance.sqrt() + 1e-12 * scale * scale);
            assert!((a.variance() - variance).abs() <= tolerance, "{a:?} {variance}");
        }
    }

    /// Mean and unbiased variance in two passes, with the deviations summed about the mean.
    fn two_passes(x: &[f64]) -> (f64, f64) {
        let n = x.len() as f64;
        let shift = x[0];
        let mean = shift + x.iter().map(|v| v - shift).sum::<f64>() / n;
        let residue = x.iter().map(|v| v - mean).sum::<f64>();
        let squares = x.iter().map(|v| (v - mean) * (v - mean)).sum::<f64>();
        (mean + residue / n, (squares - residue * residue / n) / (n - 1.0))
    }

    #[test]
    fn fewer_than_two_samples_have_no_known_error() {
        let mut statistics = Statistics::new();
        assert_eq!((statistics.mean(), statistics.variance()), (0.0, f64::INFINITY));
        statistics.add(5.0);
        assert_eq!((statistics.count(), statistics.mean()), (1, 5.0));
        assert_eq!((statistics.variance(), statistics.error()), (f64::INFINITY, f64::INFINITY));
        assert_eq!(statistics.to_string(), "5 ± inf");
        statistics.add(7.0);
        assert_eq!((statistics.variance(), statistics.error()), (2.0, 1.0));
        assert_eq!(statistics.to_string(), "6.0(10)");
        statistics.add(f64::INFINITY);
        statistics.merge(&Statistics::new());
        assert_eq!((statistics.count(), statistics.mean()), (3, f64::INFINITY));
        statistics.clear();
        assert_eq!(statistics, Statistics::default());
    }

    #[test]
    fn a_small_variance_survives_a_large_mean() {
        let mut rng = Rng::new(7);
        let x: Vec<f64> = (0..1_000_000).map(|_| rng.normal(1e8, 1.0)).collect();
        let (mean, variance) = two_passes(&x);
        assert!((variance - 1.0).abs() < 0.01);
        let mut halves = gather(&x[..500_000]);
        halves.merge(&gather(&x[500_000..]));
        for statistics in [halves, gather(&x)] {
            assert!((statistics.variance() / variance - 1.0).abs() < 1e-9, "{statistics:?}");
            assert!((statistics.mean() / mean - 1.0).abs() < 1e-13);
        }
        // The mean of the squares less the square of the mean has lost every digit.
        let n = x.len() as f64;
        let naive = x.iter().map(|v| v * v).sum::<f64>() / n - (x.iter().sum::<f64>() / n).powi(2);
        assert!((naive / variance - 1.0).abs() > 1e-3);
    }

    #[test]
    fn a_thousand_million_samples_of_one_tenth_keep_their_mean() {
        let block = gather(&[0.1; 1000]);
        let mut total = Statistics::new();
        (0..1_000_000).for_each(|_| total.merge(&block));
        assert_eq!(total.count(), 1_000_000_000);
        assert!((total.mean() - 0.1).abs() <= 1e-14);
        assert!(total.error() <= 1e-14);
        // A hundredth of the samples in a plain sum are worse by far.
        let sum = (0..10_000_000).fold(0.0, |sum, _| sum + 0.1);
        assert!((sum / 1e7f64 - 0.1).abs() > 1e-12);
    }

    #[test]
    fn blocks_of_unequal_means_keep_mean_and_variance() {
        // Deviations ±0.05 and ±0.15 about 0.1, each half of the time: variance 0.0125 n / (n − 1).
        let blocks = [gather(&[0.05, 0.25]), gather(&[0.15, -0.05])];
        let mut total = Statistics::new();
        (0..1_000_000).for_each(|i| total.merge(&blocks[i % 2]));
        let n = 2e6;
        assert!((total.mean() - 0.1).abs() <= 1e-13, "{total:?}");
        assert!((total.variance() / (0.0125 * n / (n - 1.0)) - 1.0).abs() < 1e-11, "{total:?}");
    }

    #[test]
    fn counts_past_thirty_one_bits_are_kept() {
        let mut total = Statistics::from_parts(3_000_000_000, 1.0, 4.0).unwrap();
        total.merge(&Statistics::from_parts(3_000_000_000, 3.0, 4.0).unwrap());
        total.add(2.0);
        assert_eq!((total.count(), total.mean()), (6_000_000_001, 2.0));
        assert!((total.variance() - 5.0).abs() < 1e-8);
        assert!((total.error() / (5.0f64 / 6e9).sqrt() - 1.0).abs() < 1e-9);
    }

    #[test]
    fn counts_near_fifty_three_bits_are_kept() {
        let half = (1u64 << 52) - 1;
        let mut total = Statistics::from_parts(half, -1.0, 0.25).unwrap();
        total.merge(&Statistics::from_parts(half, 2.0, 0.25).unwrap());
        total.add(0.5);
        assert_eq!((total.count(), total.mean()), ((1 << 53) - 1, 0.5));
        assert!((total.variance() - 2.5).abs() < 1e-14);
        let full = Statistics::from_parts(u64::MAX, 1.0, 1.0).unwrap();
        total.merge(&full);
        total.add(1.0);
        assert_eq!(total.count(), u64::MAX);
        assert!(total.mean().is_finite() && total.variance().is_finite());
    }

    #[test]
    fn parts_come_back_and_bad_parts_are_refused() {
        for values in [&[][..], &[3.0], &[3.0, 4.5, -1.0]] {
            let s = gather(values);
            assert_eq!(Statistics::from_parts(s.count(), s.mean(), s.variance()), Ok(s));
        }
        for (count, mean, variance) in [
            (5, 1.0, -1e-300),
            (5, 1.0, f64::NAN),
            (5, 1.0, f64::INFINITY),
            (5, f64::INFINITY, 1.0),
            (1, f64::NAN, 0.0),
            (1, 1.0, f64::NAN),
            (0, 0.0, -1.0),
        ] {
            assert!(Statistics::from_parts(count, mean, variance).is_err(), "{count} {mean} {variance}");
        }
        let message = Statistics::from_parts(2, 0.0, -1.0).unwrap_err().to_string();
        assert!(
            message.starts_with("variance = -1 ") && message.ends_with("0 or more and finite"),
            "{message}"
        );
    }

    proptest! {
        #[test]
        fn any_split_gives_the_sequential_result(
            x in prop::collection::vec(-1e3..1e3f64, 2..200), offset in -1e4..1e4f64,
            cuts in prop::collection::vec(any::<prop::sample::Index>(), 0..6),
        ) {
            let x: Vec<f64> = x.iter().map(|v| v + offset).collect();
            let mut cuts: Vec<usize> = cuts.iter().map(|c| c.index(x.len() + 1)).collect();
            cuts.extend([0, x.len()]);
            cuts.sort_unstable();
            let mut merged = Statistics::new();
            cuts.windows(2).for_each(|w| merged.merge(&gather(&x[w[0]..w[1]])));
            let sequential = gather(&x);
            prop_assert_eq!(merged.count(), sequential.count());
            assert_close(&merged, sequential.mean(), sequential.variance(), 1.1e4);
            let (mean, variance) = two_passes(&x);
            assert_close(&merged, mean, variance, 1.1e4);
        }

        #[test]
        fn the_order_of_merging_does_not_matter(
            sets in prop::collection::vec(prop::collection::vec(-1e2..1e2f64, 0..20), 1..12),
            order in any::<u64>(),
        ) {
            let parts: Vec<Statistics> = sets.iter().map(|s| gather(s)).collect();
            let merge = |parts: &[Statistics]| {
                parts.iter().fold(Statistics::new(), |mut total, part| { total.merge(part); total })
            };
            let mut shuffled = parts.clone();
            let mut rng = Rng::new(order);
            for i in (1..shuffled.len()).rev() {
                shuffled.swap(i, (rng.uniform() * (i + 1) as f64) as usize);
            }
            let expected = merge(&parts);
            let shuffled = merge(&shuffled);
            prop_assert_eq!(shuffled.count(), expected.count());
            assert_close(&shuffled, expected.mean(), expected.variance(), 1e2);
            // Pairs of pairs, as threads hand their results on.
            let mut tree = parts.clone();
            while tree.len() > 1 {
                tree = tree.chunks(2).map(merge).collect();
            }
            prop_assert_eq!(tree[0].count(), expected.count());
            assert_close(&tree[0], expected.mean(), expected.variance(), 1e2);
        }
    }
}
