use std::f64::consts::{LN_2, SQRT_2, TAU};

use raysect_core::save::{SaveError, Saved, SceneWriter};
use raysect_math::{MathError, integrate};

use super::SpectralFunction;
use crate::OpticalError;

/// A spectral line of Gaussian shape.
///
/// Averages over bins are exact to rounding, whether a bin is much wider or much narrower than the line: a line is
/// never lost between sampling points.
///
/// ```
/// use raysect_optical::{GaussianLine, SpectralFunction};
/// let sodium = GaussianLine::new(588.995, 0.002, 3.0)?;               // 2 pm wide
/// assert!((sodium.integrate(588.0, 590.0) - 3.0).abs() < 1e-14);
/// assert!((sodium.average(500.0, 600.0) - 0.03).abs() < 1e-16);
/// # Ok::<(), raysect_optical::OpticalError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GaussianLine {
    centre: f64,
    sigma: f64,
    total: f64,
}

impl GaussianLine {
    /// From the centre [nm], the standard deviation [nm] and the integral over all wavelengths, for a radiance
    /// [W/m²/sr].
    ///
    /// # Errors
    /// [`MathError::OutOfRange`] unless centre and width are positive and all three finite.
    pub fn new(centre: f64, sigma: f64, total: f64) -> Result<Self, OpticalError> {
        let positive = |value: f64| value > 0.0 && value.is_finite();
        MathError::check(positive(centre), centre, "centre of a line", "nm", "positive and finite")?;
        MathError::check(
            positive(sigma),
            sigma,
            "standard deviation of a line",
            "nm",
            "positive and finite",
        )?;
        MathError::check(total.is_finite(), total, "integral of a line", "", "finite")?;
        Ok(Self { centre, sigma, total })
    }

    /// From the centre [nm], the full width at half maximum [nm], which is √(8 ln 2) ≈ 2.355 standard deviations,
    /// and the integral.
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn from_fwhm(centre: f64, fwhm: f64, total: f64) -> Result<Self, OpticalError> {
        Self::new(centre, fwhm / (8.0 * LN_2).sqrt(), total)
    }

    /// The centre [nm].
    pub fn centre(&self) -> f64 {
        self.centre
    }

    /// The standard deviation [nm].
    pub fn sigma(&self) -> f64 {
        self.sigma
    }

    /// The integral over all wavelengths.
    pub fn total(&self) -> f64 {
        self.total
    }
}

fn density(z: f64) -> f64 {
    (-0.5 * z * z).exp() / TAU.sqrt()
}

/// The probability of the standard normal distribution between `low` and `low + width`, to rounding of the
/// probability itself, in the tails too.
fn probability(low: f64, width: f64) -> f64 {
    let high = low + width;
    if width < 1.0 {
        // The difference of two error functions would lose the digits that a short interval has.
        return integrate(&|s| density(low + s), 0.0, width, 1.0, 1e-13).0;
    }
    let beyond = |z: f64| 0.5 * libm::erfc(z / SQRT_2);
    if low > 0.0 {
        beyond(low) - beyond(high)
    } else if high < 0.0 {
        beyond(-high) - beyond(-low)
    } else {
        0.5 * (libm::erf(high / SQRT_2) - libm::erf(low / SQRT_2))
    }
}

impl SpectralFunction for GaussianLine {
    fn evaluate(&self, wavelength: f64) -> f64 {
        self.total / self.sigma * density((wavelength - self.centre) / self.sigma)
    }

    fn integrate(&self, min: f64, max: f64) -> f64 {
        if max < min {
            return -self.integrate(max, min);
        }
        self.total * probability((min - self.centre) / self.sigma, (max - min) / self.sigma)
    }

    fn resolution(&self) -> f64 {
        self.sigma
    }

    fn save(&self, _: &mut SceneWriter) -> Result<Saved, SaveError> {
        let saved = Saved::new("GaussianLine").number("centre", self.centre).number("sigma", self.sigma);
        Ok(saved.number("total", self.total))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_probabilities_of_the_textbook() {
        // Abramowitz and Stegun, Handbook of Mathematical Functions, table 26.1 and 26.2.
        let within = |z: f64| probability(-z, 2.0 * z);
        for (z, expected) in
            [(0.3, 0.235_822_844_377_905), (1.0, 0.682_689_492_137_086), (3.0, 0.997_300_203_936_74)]
        {
            assert!((within(z) - expected).abs() < 2e-13, "{z} {}", within(z));
        }
        // Upper tail at 10 standard deviations: 7.619 853 024 160 527e-24.
        assert!((probability(10.0, 1e6) / 7.619_853_024_160_527e-24 - 1.0).abs() < 1e-12);
        assert_eq!(probability(-1e9 - 10.0, 1e9), probability(10.0, 1e9));
        assert_eq!(probability(50.0, 1e9), 0.0);
    }

    #[test]
    fn both_ways_of_integration_agree_where_they_meet() {
        for low in [-3.0, -0.5, 0.0, 2.0, 8.0] {
            let (below, above) = (probability(low, 1.0 - 1e-15), probability(low, 1.0));
            assert!((below / above - 1.0).abs() < 2e-14, "{low} {below} {above}");
        }
    }

    #[test]
    fn a_line_far_narrower_than_a_bin_loses_nothing() {
        for sigma in [1e-9, 1e-5, 0.01, 0.3, 20.0] {
            let line = GaussianLine::new(577.3, sigma, 5.0).unwrap();
            for bins in [1, 2, 15, 1000] {
                let width = 1000.0 / bins as f64;
                let total: f64 = line.sample(100.0, 1100.0, bins).iter().map(|s| s * width).sum();
                assert!((total - 5.0).abs() < 1e-11, "{sigma} {bins} {total}");
            }
        }
    }

    #[test]
    fn half_the_maximum_is_reached_at_half_the_full_width() {
        let line = GaussianLine::from_fwhm(500.0, 2.0, 1.0).unwrap();
        assert!((line.evaluate(501.0) / line.evaluate(500.0) - 0.5).abs() < 1e-14);
        assert_eq!(line.integrate(501.0, 499.0), -line.integrate(499.0, 501.0));
    }

    #[test]
    fn impossible_lines_are_named() {
        let message = |c, s, t| GaussianLine::new(c, s, t).unwrap_err().to_string();
        assert!(message(0.0, 1.0, 1.0).contains("centre"));
        assert!(message(500.0, 0.0, 1.0).contains("standard deviation"));
        assert!(message(500.0, 1.0, f64::NAN).contains("integral"));
    }
}
