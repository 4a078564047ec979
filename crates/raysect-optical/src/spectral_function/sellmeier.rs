use raysect_core::save::{SaveError, Saved, SceneWriter};
use raysect_math::MathError;

use super::SpectralFunction;
use crate::OpticalError;

/// Refractive index by the formula of Sellmeier (1871), n² = 1 + Σ Bᵢ λ² / (λ² − Cᵢ), with λ in µm.
///
/// ```
/// use raysect_optical::{Sellmeier, SpectralFunction};
/// let bk7 = Sellmeier::new(
///     [1.03961212, 0.231792344, 1.01046945],
///     [0.00600069867, 0.0200179144, 103.560653],
/// )?;
/// assert!((bk7.evaluate(587.5618) - 1.5168000345).abs() < 1e-10);
/// # Ok::<(), raysect_optical::OpticalError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sellmeier {
    b: [f64; 3],
    c: [f64; 3],
}

impl Sellmeier {
    /// From the coefficients B (pure numbers) and C [µm²].
    ///
    /// # Errors
    /// [`MathError::OutOfRange`] for one that is not finite.
    pub fn new(b: [f64; 3], c: [f64; 3]) -> Result<Self, OpticalError> {
        for value in b {
            MathError::check(value.is_finite(), value, "Sellmeier coefficient B", "", "finite")?;
        }
        for value in c {
            MathError::check(value.is_finite(), value, "Sellmeier coefficient C", "um²", "finite")?;
        }
        Ok(Self { b, c })
    }
}

impl SpectralFunction for Sellmeier {
    /// The index at a vacuum wavelength [nm]; NaN where the formula gives no real index. A
    /// [`Dielectric`](crate::Dielectric) refuses such a range before any ray is traced.
    fn evaluate(&self, wavelength: f64) -> f64 {
        let squared = (wavelength * 1e-3).powi(2);
        (1.0 + (0..3).map(|i| self.b[i] * squared / (squared - self.c[i])).sum::<f64>()).sqrt()
    }

    fn save(&self, _: &mut SceneWriter) -> Result<Saved, SaveError> {
        Ok(Saved::new("Sellmeier").numbers("b", &self.b).numbers("c", &self.c))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn averages_follow_the_formula_and_not_a_grid() {
        let bk7 =
            Sellmeier::new([1.03961212, 0.231792344, 1.01046945], [0.00600069867, 0.0200179144, 103.560653])
                .unwrap();
        assert!((bk7.evaluate(546.1) - 1.5187206).abs() < 1e-7);
        assert!((bk7.average(375.0, 740.0) - 1.519_718_700_67).abs() < 1e-10);
        let fine =
            (0..10_000).map(|i| bk7.evaluate(375.0 + 24.0 * (i as f64 + 0.5) / 1e4)).sum::<f64>() / 1e4;
        assert!((bk7.average(375.0, 399.0) - fine).abs() < 1e-10);
        assert!(bk7.evaluate(75.0).is_nan());
        assert!(Sellmeier::new([f64::NAN, 0.0, 0.0], [0.0; 3]).is_err());
    }
}
