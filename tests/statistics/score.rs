//! The judges: of error bars, and of averages.

use std::fmt;

use raysect::math::Statistics;
use raysect::prelude::*;

/// Differences from the truth in units of the error bars.
#[derive(Debug, Clone, Default)]
pub(crate) struct Scores(Vec<f64>);

/// How many of the intervals cover the truth.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Coverage {
    /// Share of the intervals of one error to each side.
    pub(crate) one: f64,
    /// Share of the intervals of 1.96 errors to each side.
    pub(crate) two: f64,
    /// Number of intervals.
    pub(crate) count: usize,
}

impl Scores {
    /// Adds an estimate of a known value.
    pub(crate) fn add(&mut self, estimate: Estimate, truth: f64) {
        assert!(estimate.error > 0.0 && estimate.error.is_finite(), "{estimate:?} of {truth}");
        self.0.push((estimate.value - truth) / estimate.error);
    }

    /// Adds others.
    pub(crate) fn extend(&mut self, others: Self) {
        self.0.extend(others.0);
    }

    /// What the intervals cover if all error bars are multiplied by a factor.
    pub(crate) fn coverage(&self, factor: f64) -> Coverage {
        let share = |width: f64| {
            let inside = self.0.iter().filter(|z| z.abs() <= width * factor).count();
            inside as f64 / self.0.len() as f64
        };
        Coverage { one: share(1.0), two: share(1.96), count: self.0.len() }
    }

    /// The same, of values that are off by a share of their error bars.
    pub(crate) fn shifted(&self, share: f64) -> Self {
        Self(self.0.iter().map(|z| z + share).collect())
    }
}

impl Coverage {
    /// Errors are right if 68 ± 3 % and 95 ± 1.5 % of the intervals cover the truth.
    pub(crate) fn holds(&self) -> bool {
        (self.one - 0.68).abs() <= 0.03 && (self.two - 0.95).abs() <= 0.015
    }
}

impl fmt::Display for Coverage {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:.2} % and {:.2} % of {}", 100.0 * self.one, 100.0 * self.two, self.count)
    }
}

/// Squares of differences from the truth and of error bars, in units of what they should be in the mean.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Scatter {
    differences: f64,
    errors: f64,
    count: f64,
}

impl Scatter {
    /// Adds an estimate of a known value and variance.
    pub(crate) fn add(&mut self, estimate: Estimate, truth: f64, variance: f64) {
        self.differences += (estimate.value - truth).powi(2) / variance;
        self.errors += estimate.error * estimate.error / variance;
        self.count += 1.0;
    }

    /// Adds others.
    pub(crate) fn extend(&mut self, others: Self) {
        self.differences += others.differences;
        self.errors += others.errors;
        self.count += others.count;
    }

    /// As if all error bars had been multiplied by a factor.
    pub(crate) fn with_errors_times(self, factor: f64) -> Self {
        Self { errors: self.errors * factor * factor, ..self }
    }

    /// Both mean squares, which should be 1.
    fn means(&self) -> (f64, f64) {
        (self.differences / self.count, self.errors / self.count)
    }

    /// Errors are right in the mean square if both are 1 within 5 %.
    pub(crate) fn holds(&self) -> bool {
        let (differences, errors) = self.means();
        (differences - 1.0).abs() < 0.05 && (errors - 1.0).abs() < 0.05
    }
}

impl fmt::Display for Scatter {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (differences, errors) = self.means();
        write!(f, "mean squares: of differences {differences:.3}, of errors {errors:.3}")
    }
}

/// Many averages of the same quantity, each from a seed of its own.
#[derive(Debug, Clone)]
pub(crate) struct Averages {
    /// Of the averages.
    pub(crate) mean: Statistics,
    /// Of the numbers of samples behind them.
    pub(crate) samples: Statistics,
    /// In units of their own errors.
    pub(crate) scores: Scores,
    truth: f64,
}

impl Averages {
    /// Of estimates with their numbers of samples.
    pub(crate) fn of(all: &[(Estimate, u64)], truth: f64) -> Self {
        let mut averages =
            Self { mean: Statistics::new(), samples: Statistics::new(), scores: Scores::default(), truth };
        for (estimate, samples) in all {
            averages.mean.add(estimate.value);
            averages.samples.add(*samples as f64);
            averages.scores.add(*estimate, truth);
        }
        averages
    }

    /// How far the mean of the averages lies from the truth, in its standard errors.
    pub(crate) fn z(&self) -> f64 {
        (self.mean.mean() - self.truth) / self.mean.error()
    }

    /// Averages are right if they have no bias of 4 standard errors, and 93 … 97 % of their 95 % intervals cover the
    /// truth.
    pub(crate) fn holds(&self) -> bool {
        self.z().abs() < 4.0 && (0.93..=0.97).contains(&self.scores.coverage(1.0).two)
    }
}

impl fmt::Display for Averages {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let bias = 100.0 * (self.mean.mean() / self.truth - 1.0);
        let error = 100.0 * self.mean.error() / self.truth;
        let (z, samples) = (self.z(), self.samples.mean());
        write!(f, "bias {bias:+.3} ± {error:.3} %, z {z:+.2}, {}, ", self.scores.coverage(1.0))?;
        write!(f, "{samples:.0} samples")
    }
}
