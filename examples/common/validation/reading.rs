use super::Case;

/// What has been measured.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Reading {
    pub(crate) mean: f64,
    /// Standard error; zero where nothing is left to chance.
    pub(crate) error: f64,
}

impl Reading {
    /// A number that has no noise.
    pub(crate) fn exact(mean: f64) -> Self {
        Self { mean, error: 0.0 }
    }

    /// Mean and standard error of samples; an error of nothing but rounding counts as none.
    pub(crate) fn of(mean: f64, error: f64) -> Self {
        Self { mean, error: if error <= ROUNDING * mean.abs() { 0.0 } else { error } }
    }

    /// The same in another unit.
    pub(crate) fn times(self, factor: f64) -> Self {
        Self { mean: self.mean * factor, error: self.error * factor }
    }

    /// Standard errors off; none where nothing is left to chance.
    pub(crate) fn z(&self, expected: f64) -> Option<f64> {
        (self.error > 0.0).then(|| (self.mean - expected) / self.error)
    }
}

const ROUNDING: f64 = 1e-12;

/// The relative standard error at which a mean says something.
pub(crate) const NOISE: f64 = 2e-3;

/// Standard errors by which a mean may lie off.
const SIGMAS: f64 = 4.0;

/// What is said of a reading.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Verdict {
    Passed,
    /// It is off, or not a number.
    Failed,
    /// Its standard error is too large for a verdict.
    Noisy,
}

/// Judges a reading: without noise by the tolerance of the case, with noise by its own standard error.
pub(crate) fn judge(case: &Case, reading: &Reading) -> Verdict {
    let off = (reading.mean - case.expected).abs();
    if !(off.is_finite() && reading.error.is_finite()) {
        return Verdict::Failed;
    }
    let scale = if case.expected == 0.0 { 1.0 } else { case.expected.abs() };
    if reading.error == 0.0 {
        return if off <= case.tolerance * scale { Verdict::Passed } else { Verdict::Failed };
    }
    if reading.error > NOISE * scale {
        return Verdict::Noisy;
    }
    // The digits of the expected value end somewhere, too.
    let allowed = SIGMAS * reading.error + case.tolerance.min(1e-4 * NOISE) * scale;
    if off <= allowed { Verdict::Passed } else { Verdict::Failed }
}
