//! How samples are distributed, up to the fourth power.

/// Number, mean, and sums of the second, third and fourth powers of the deviations from it (P. Pébay, *Formulas for
/// Robust, One-Pass Parallel Computation of Covariances and Arbitrary-Order Statistical Moments*, SAND2008-6212).
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Moments {
    pub(crate) count: f64,
    pub(crate) mean: f64,
    pub(crate) second: f64,
    pub(crate) third: f64,
    pub(crate) fourth: f64,
}

impl Moments {
    /// Those that a block has in its header.
    #[inline]
    pub(crate) fn read(block: &[f64]) -> Self {
        Self { count: block[0], mean: block[3], second: block[4], third: block[5], fourth: block[6] }
    }

    /// Puts them into the header of a block; the count is left to the block.
    #[inline]
    pub(crate) fn write(&self, block: &mut [f64]) {
        block[3..7].copy_from_slice(&[self.mean, self.second, self.third, self.fourth]);
    }

    /// Adds a sample.
    #[inline]
    pub(crate) fn add(&mut self, x: f64) {
        let before = self.count;
        let n = before + 1.0;
        let deviation = x - self.mean;
        let step = deviation / n;
        let (squared, term) = (step * step, deviation * step * before);
        self.count = n;
        self.mean += step;
        self.fourth +=
            term * squared * (n * n - 3.0 * n + 3.0) + 6.0 * squared * self.second - 4.0 * step * self.third;
        self.third += term * step * (n - 2.0) - 3.0 * step * self.second;
        self.second += term;
    }

    /// Of the samples of both.
    pub(crate) fn merged(&self, other: &Self) -> Self {
        if self.count == 0.0 || other.count == 0.0 {
            return if self.count == 0.0 { *other } else { *self };
        }
        let (a, b) = (self.count, other.count);
        let n = a + b;
        let d = other.mean - self.mean;
        let (share_a, share_b) = (a / n, b / n);
        let squares = d * d * a * share_b;
        Self {
            count: n,
            mean: self.mean + d * share_b,
            second: self.second + other.second + squares,
            third: self.third
                + other.third
                + squares * d * (share_a - share_b)
                + 3.0 * d * (share_a * other.second - share_b * self.second),
            fourth: self.fourth
                + other.fourth
                + squares * d * d * (share_a * share_a - share_a * share_b + share_b * share_b)
                + 6.0 * d * d * (share_a * share_a * other.second + share_b * share_b * self.second)
                + 4.0 * d * (share_a * other.third - share_b * self.third),
        }
    }

    /// Variance of the variance of the mean, relative to its square: Σ(x − x̄)⁴ / (Σ(x − x̄)²)² − 1 / n; 0 for samples
    /// that are all alike, 1 − 1/n if all of the variance is that of one sample; infinite for less than two samples.
    pub(crate) fn variance_of_variance(&self) -> f64 {
        if self.count < 2.0 {
            return f64::INFINITY;
        }
        if self.second <= 0.0 {
            return 0.0;
        }
        (self.fourth / (self.second * self.second) - 1.0 / self.count).max(0.0)
    }
}

#[cfg(test)]
mod tests {
    use raysect_math::Rng;

    use super::*;

    fn directly(samples: &[f64]) -> Moments {
        let n = samples.len() as f64;
        let mean = samples.iter().sum::<f64>() / n;
        let sum = |power: i32| samples.iter().map(|x| (x - mean).powi(power)).sum::<f64>();
        Moments { count: n, mean, second: sum(2), third: sum(3), fourth: sum(4) }
    }

    fn assert_close(a: &Moments, b: &Moments) {
        let pairs = [(a.mean, b.mean), (a.second, b.second), (a.third, b.third), (a.fourth, b.fourth)];
        assert_eq!(a.count, b.count);
        for (a, b) in pairs {
            assert!((a - b).abs() <= 1e-11 * b.abs(), "{a} {b}");
        }
    }

    #[test]
    fn moments_are_those_of_the_samples_however_they_are_split() {
        let mut rng = Rng::new(4);
        let samples: Vec<f64> = (0..777).map(|_| rng.uniform().ln().powi(2)).collect();
        let of = |part: &[f64]| {
            let mut moments = Moments::default();
            part.iter().for_each(|x| moments.add(*x));
            moments
        };
        assert_close(&of(&samples), &directly(&samples));
        for split in [0, 1, 2, 32, 700, 776, 777] {
            let (a, b) = samples.split_at(split);
            assert_close(&of(a).merged(&of(b)), &directly(&samples));
        }
    }

    #[test]
    fn one_sample_that_has_all_of_the_variance_is_told() {
        let of = |bright: usize| {
            let mut moments = Moments::default();
            (0..100).for_each(|i| moments.add(if i < bright { 1.0 } else { 0.0 }));
            moments.variance_of_variance()
        };
        assert!(of(1) > 0.9 && of(50) < 1e-12 && of(10) < 0.1, "{} {} {}", of(1), of(10), of(50));
        assert_eq!((of(0), Moments::default().variance_of_variance()), (0.0, f64::INFINITY));
    }
}
