use raysect_core::save::{SaveError, Saved, SceneWriter};
use raysect_math::MathError;

use super::SpectralFunction;
use crate::OpticalError;

/// Constant between two wavelengths and zero outside.
///
/// ```
/// use raysect_optical::{SpectralFunction, TopHat};
/// let filter = TopHat::new(500.0, 510.0, 0.8)?;
/// assert_eq!(filter.average(505.0, 525.0), 0.2);
/// # Ok::<(), raysect_optical::OpticalError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TopHat {
    min: f64,
    max: f64,
    value: f64,
}

impl TopHat {
    /// From the ends [nm] and the value between them.
    ///
    /// # Errors
    /// [`MathError::OutOfRange`] unless 0 < min < max, and all are finite.
    pub fn new(min: f64, max: f64, value: f64) -> Result<Self, OpticalError> {
        MathError::check(min > 0.0 && min.is_finite(), min, "lower end", "nm", "positive and finite")?;
        MathError::check(
            max > min && max.is_finite(),
            max,
            "upper end",
            "nm",
            "above the lower end, and finite",
        )?;
        MathError::check(value.is_finite(), value, "value", "", "finite")?;
        Ok(Self { min, max, value })
    }

    /// From the ends [nm] and the integral.
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn of_total(min: f64, max: f64, total: f64) -> Result<Self, OpticalError> {
        Self::new(min, max, total / (max - min))
    }
}

impl SpectralFunction for TopHat {
    fn evaluate(&self, wavelength: f64) -> f64 {
        if (self.min..self.max).contains(&wavelength) { self.value } else { 0.0 }
    }

    fn integrate(&self, min: f64, max: f64) -> f64 {
        let inside = |wavelength: f64| wavelength.clamp(self.min, self.max);
        self.value * (inside(max) - inside(min))
    }

    fn resolution(&self) -> f64 {
        self.max - self.min
    }

    fn save(&self, _: &mut SceneWriter) -> Result<Saved, SaveError> {
        let saved = Saved::new("TopHat").number("min", self.min).number("max", self.max);
        Ok(saved.number("value", self.value))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_integral_is_the_overlap() {
        let hat = TopHat::of_total(500.0, 504.0, 8.0).unwrap();
        assert_eq!((hat.evaluate(499.0), hat.evaluate(500.0), hat.evaluate(504.0)), (0.0, 2.0, 0.0));
        assert_eq!(
            (hat.integrate(0.0, 1e9), hat.integrate(501.0, 502.0), hat.integrate(1.0, 400.0)),
            (8.0, 2.0, 0.0)
        );
        assert_eq!(hat.integrate(502.0, 490.0), -4.0);
    }

    #[test]
    fn impossible_ends_are_named() {
        let message = |min, max, v| TopHat::new(min, max, v).unwrap_err().to_string();
        assert!(message(-1.0, 2.0, 1.0).contains("lower end"));
        assert!(message(5.0, 5.0, 1.0).contains("upper end"));
        assert!(message(5.0, 6.0, f64::INFINITY).contains("value"));
    }
}
