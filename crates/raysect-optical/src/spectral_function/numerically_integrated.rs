use raysect_math::MathError;

use super::SpectralFunction;
use crate::OpticalError;

/// A closure of the wavelength [nm] that says how narrow its structure is.
///
/// A plain closure is taken to show none below 1 nm. Adaptive quadrature begins with cells of the width given here, so
/// that nothing which is at least that wide is overlooked, and refines them to 1e-10 of the integral.
///
/// ```
/// use raysect_optical::{NumericallyIntegratedSf, SpectralFunction};
/// let lorentzian = |wavelength: f64| 0.01 / ((wavelength - 500.0).powi(2) + 0.01f64.powi(2));
/// let line = NumericallyIntegratedSf::new(lorentzian, 0.01)?;
/// let exact = 2.0 * (50.0f64 / 0.01).atan();
/// assert!((line.integrate(450.0, 550.0) / exact - 1.0).abs() < 1e-9);
/// # Ok::<(), raysect_optical::OpticalError>(())
/// ```
#[doc(alias = "NumericallyIntegratedSF")]
pub struct NumericallyIntegratedSf {
    function: Box<dyn Fn(f64) -> f64 + Send + Sync>,
    resolution: f64,
}

impl NumericallyIntegratedSf {
    /// From a closure and the width of its narrowest structure [nm].
    ///
    /// # Errors
    /// [`MathError::OutOfRange`] unless the width is positive and finite.
    #[doc(alias = "sample_resolution")]
    pub fn new(
        function: impl Fn(f64) -> f64 + Send + Sync + 'static,
        resolution: f64,
    ) -> Result<Self, OpticalError> {
        let admitted = resolution > 0.0 && resolution.is_finite();
        MathError::check(
            admitted,
            resolution,
            "resolution of a spectral function",
            "nm",
            "positive and finite",
        )?;
        Ok(Self { function: Box::new(function), resolution })
    }
}

impl std::fmt::Debug for NumericallyIntegratedSf {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "NumericallyIntegratedSf(resolution {} nm)", self.resolution)
    }
}

impl SpectralFunction for NumericallyIntegratedSf {
    fn evaluate(&self, wavelength: f64) -> f64 {
        (self.function)(wavelength)
    }

    fn resolution(&self) -> f64 {
        self.resolution
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn structure_of_the_stated_width_is_not_overlooked() {
        let line = |wavelength: f64| (-0.5 * ((wavelength - 500.36) / 0.002).powi(2)).exp();
        let exact = 0.002 * std::f64::consts::TAU.sqrt();
        let stated = NumericallyIntegratedSf::new(line, 0.002).unwrap();
        for bins in [1, 2, 15] {
            let width = 365.0 / bins as f64;
            let total: f64 = stated.sample(375.0, 740.0, bins).iter().map(|s| s * width).sum();
            assert!((total / exact - 1.0).abs() < 1e-8, "{bins} {total}");
        }
        // A plain closure, whose structure is taken to be 1 nm wide, loses one that is much narrower.
        let narrower = |wavelength: f64| (-0.5 * ((wavelength - 500.36) / 2e-4).powi(2)).exp();
        assert_eq!(narrower.integrate(375.0, 740.0), 0.0);
    }

    #[test]
    fn an_impossible_resolution_is_refused() {
        for resolution in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            assert!(NumericallyIntegratedSf::new(|_| 1.0, resolution).is_err(), "{resolution}");
        }
    }
}
