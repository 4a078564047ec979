//! Functions of the wavelength.

mod black_body;
mod gaussian_line;
mod interpolated;
mod numerically_integrated;
mod sellmeier;
mod top_hat;
mod wavelength_unit;

use std::sync::Arc;

pub use black_body::BlackBody;
pub use gaussian_line::GaussianLine;
pub use interpolated::InterpolatedSf;
pub use numerically_integrated::NumericallyIntegratedSf;
use raysect_core::save::{SaveError, Saved, SceneWriter, short_name};
use raysect_math::integrate;
pub use sellmeier::Sellmeier;
pub use top_hat::TopHat;
pub use wavelength_unit::WavelengthUnit;

/// A function of the vacuum wavelength [nm].
///
/// A plain `f64` is the constant function (Raysect's `ConstantSF`), and so is any closure `|wavelength| …` one.
/// Spectra are never sampled at points: a bin holds the average of the function over the bin.
///
/// ```
/// use raysect_optical::SpectralFunction;
/// assert_eq!(0.7.average(400.0, 500.0), 0.7);
/// let slope = |wavelength: f64| wavelength / 100.0;
/// assert!((slope.integrate(400.0, 500.0) - 450.0).abs() < 1e-9);
/// ```
#[doc(alias = "ConstantSF")]
pub trait SpectralFunction: Send + Sync + 'static {
    /// The value at a wavelength [nm].
    fn evaluate(&self, wavelength: f64) -> f64;

    /// The integral between two wavelengths [nm].
    ///
    /// By default adaptive Gauss-Kronrod quadrature to 1e-10, begun with cells as wide as the
    /// [resolution](Self::resolution): structure narrower than a tenth of it can hide between the nodes.
    fn integrate(&self, min: f64, max: f64) -> f64 {
        numerical_integral(&|wavelength| self.evaluate(wavelength), min, max, self.resolution())
    }

    /// The width of the narrowest structure [nm], infinite for a constant; 1 nm by default.
    /// [`NumericallyIntegratedSf`] states another one for a closure.
    #[doc(alias = "sample_resolution")]
    fn resolution(&self) -> f64 {
        1.0
    }

    /// The average between two wavelengths [nm]; the value itself if they are equal.
    fn average(&self, min: f64, max: f64) -> f64 {
        if min == max { self.evaluate(min) } else { self.integrate(min, max) / (max - min) }
    }

    /// The averages over equal bins from `min` to `max` [nm].
    fn sample(&self, min: f64, max: f64, bins: usize) -> Vec<f64> {
        let edge = |i: usize| min + (max - min) * (i as f64 / bins as f64);
        (0..bins).map(|i| self.average(edge(i), edge(i + 1))).collect()
    }

    /// True if it is known to have the same value at all wavelengths.
    fn is_constant(&self) -> bool {
        false
    }
    /// Wavelengths [nm] in ascending order where it has a kink: a table's own. None by default.
    fn knots(&self) -> &[f64] {
        &[]
    }

    /// What a file needs to know to make it again; see [`raysect_core::save`]. Closures cannot be saved.
    ///
    /// # Errors
    /// [`SaveError::NotSaved`] by default.
    fn save(&self, _writer: &mut SceneWriter) -> Result<Saved, SaveError> {
        let kind = short_name(std::any::type_name::<Self>()).to_owned();
        Err(SaveError::NotSaved { role: "spectral function", kind })
    }
}

/// Adaptive quadrature to 1e-10 that begins with cells of a width, however many there are.
fn numerical_integral(f: &dyn Fn(f64) -> f64, min: f64, max: f64, cell: f64) -> f64 {
    // Few enough that each can still be refined.
    let parts = ((max - min).abs() / (500.0 * cell)).ceil().max(1.0) as usize;
    let edge = |i: usize| min + (max - min) * (i as f64 / parts as f64);
    (0..parts).map(|i| integrate(f, edge(i), edge(i + 1), cell, 1e-10).0).sum()
}

impl SpectralFunction for f64 {
    fn evaluate(&self, _: f64) -> f64 {
        *self
    }
    fn resolution(&self) -> f64 {
        f64::INFINITY
    }
    fn integrate(&self, min: f64, max: f64) -> f64 {
        self * (max - min)
    }
    fn average(&self, _: f64, _: f64) -> f64 {
        *self
    }
    fn is_constant(&self) -> bool {
        true
    }
    fn save(&self, _: &mut SceneWriter) -> Result<Saved, SaveError> {
        Ok(Saved::new("Constant").number("value", *self))
    }
}

impl<F: Fn(f64) -> f64 + Send + Sync + 'static> SpectralFunction for F {
    fn evaluate(&self, wavelength: f64) -> f64 {
        self(wavelength)
    }
}

impl SpectralFunction for Arc<dyn SpectralFunction> {
    fn evaluate(&self, wavelength: f64) -> f64 {
        (**self).evaluate(wavelength)
    }
    fn integrate(&self, min: f64, max: f64) -> f64 {
        (**self).integrate(min, max)
    }
    fn average(&self, min: f64, max: f64) -> f64 {
        (**self).average(min, max)
    }
    fn is_constant(&self) -> bool {
        (**self).is_constant()
    }
    fn sample(&self, min: f64, max: f64, bins: usize) -> Vec<f64> {
        (**self).sample(min, max, bins)
    }
    fn resolution(&self) -> f64 {
        (**self).resolution()
    }
    fn knots(&self) -> &[f64] {
        (**self).knots()
    }
    fn save(&self, writer: &mut SceneWriter) -> Result<Saved, SaveError> {
        writer.shared(self, |function, writer| function.save(writer))
    }
}

#[cfg(test)]
mod tests;
