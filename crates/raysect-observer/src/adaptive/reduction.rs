use raysect_math::MathError;

use super::noise::percentile;
use crate::ObserverError;

/// What the relative errors of a pixel's bins are put together to. Bins without light are left out.
#[derive(Debug, Clone, Copy, PartialEq)]
#[doc(alias = "reduction_method")]
pub enum SpectralReduction {
    /// The sum of the errors over the sum of the means.
    Weighted,
    /// The mean of the relative errors.
    Mean,
    /// The relative error that this percentage of the bins, 0 … 100, does not exceed: 100 is the worst bin.
    Percentile(f64),
    /// The worst relative error of the brightest bins, this percentage of all, 0 … 100.
    PowerPercentile(f64),
}

impl Default for SpectralReduction {
    /// The worst bin.
    fn default() -> Self {
        Self::Percentile(100.0)
    }
}

impl SpectralReduction {
    pub(super) fn check(self) -> Result<(), ObserverError> {
        if let Self::Percentile(share) | Self::PowerPercentile(share) = self {
            MathError::check((0.0..=100.0).contains(&share), share, "percentile", "%", "0 … 100 %")?;
        }
        Ok(())
    }

    /// Of the means and relative errors of some bins; none without bins.
    pub(super) fn of(self, bins: &[(f64, f64)]) -> Option<f64> {
        if bins.is_empty() {
            return None;
        }
        let relative = || bins.iter().map(|(_, relative)| *relative);
        Some(match self {
            Self::Weighted => {
                let means: f64 = bins.iter().map(|(mean, _)| mean).sum();
                bins.iter().map(|(mean, relative)| mean * relative).sum::<f64>() / means
            }
            Self::Mean => relative().sum::<f64>() / bins.len() as f64,
            Self::Percentile(share) => percentile(&mut relative().collect::<Vec<_>>(), share),
            Self::PowerPercentile(share) => {
                let level =
                    percentile(&mut bins.iter().map(|(mean, _)| *mean).collect::<Vec<_>>(), 100.0 - share);
                let bright = bins.iter().filter(|(mean, _)| *mean >= level);
                bright.map(|(_, relative)| *relative).fold(0.0, f64::max)
            }
        })
    }
}

#[cfg(test)]
mod tests {
    use super::SpectralReduction::*;

    #[test]
    fn reductions_are_those_written_down_by_hand() {
        let bins = [(1.0, 0.5), (4.0, 0.1), (3.0, 0.2), (2.0, 0.4)];
        for (reduction, expected) in [
            (Weighted, (0.5 + 0.4 + 0.6 + 0.8) / 10.0),
            (Mean, 1.2 / 4.0),
            (Percentile(100.0), 0.5),
            (Percentile(0.0), 0.1),
            // Between the second and the third of 0.1, 0.2, 0.4, 0.5.
            (Percentile(50.0), 0.3),
            (PowerPercentile(100.0), 0.5),
            // Means of at least 2.5.
            (PowerPercentile(50.0), 0.2),
            (PowerPercentile(0.0), 0.1),
        ] {
            let found = reduction.of(&bins).unwrap();
            assert!((found - expected).abs() < 1e-15, "{reduction:?}: {found} instead of {expected}");
        }
        assert_eq!(Mean.of(&[]), None);
        assert!(Percentile(100.1).check().is_err() && PowerPercentile(f64::NAN).check().is_err());
    }
}
