use raysect_core::save::{SaveError, Saved, SceneWriter};

use crate::{OpticalError, Slicing, SpectralFunction};

mod arithmetic;

/// Spectral radiance in equal bins [W/m²/sr/nm], or any other quantity per nanometre.
///
/// As a [`SpectralFunction`] it is constant in each bin and zero outside its range, so that a measured or computed
/// spectrum can be the spectrum of an emitter.
///
/// Operators between spectra panic if these have different bins; [`combine`](Self::combine) returns an error instead.
///
/// ```
/// use raysect_optical::{SpectralFunction, Spectrum};
/// let mut s = Spectrum::new(400.0, 500.0, 4)?;
/// s.samples_mut()[1] = 2.0;
/// assert_eq!((s.bin_width(), s.total(), s.wavelengths()[1]), (25.0, 50.0, 437.5));
/// assert_eq!((s.evaluate(430.0), s.average(425.0, 475.0)), (2.0, 1.0));
/// let doubled = s.clone() + &s;
/// assert_eq!((&doubled - &s) / 2.0, s * 0.5);
/// # Ok::<(), raysect_optical::OpticalError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Spectrum {
    slicing: Slicing,
    samples: Vec<f64>,
}

impl Spectrum {
    /// Of zeros, between two wavelengths [nm].
    ///
    /// # Errors
    /// [`OpticalError::Slicing`] for an impossible range or no bins.
    pub fn new(min: f64, max: f64, bins: usize) -> Result<Self, OpticalError> {
        Ok(Self { slicing: Slicing::new(min, max, bins, 1)?, samples: vec![0.0; bins] })
    }

    /// From the averages over the bins.
    ///
    /// # Errors
    /// [`OpticalError::Slicing`] for an impossible range or no samples.
    pub fn from_samples(min: f64, max: f64, samples: Vec<f64>) -> Result<Self, OpticalError> {
        Ok(Self { slicing: Slicing::new(min, max, samples.len(), 1)?, samples })
    }

    /// The averages of a function over bins between two wavelengths [nm].
    ///
    /// # Errors
    /// [`OpticalError::Slicing`] for an impossible range or no bins.
    pub fn of(
        function: &dyn SpectralFunction,
        min: f64,
        max: f64,
        bins: usize,
    ) -> Result<Self, OpticalError> {
        Ok(Self { slicing: Slicing::new(min, max, bins, 1)?, samples: function.sample(min, max, bins) })
    }

    /// Zeros in the same bins.
    #[doc(alias = "new_spectrum")]
    pub fn zeroed(&self) -> Self {
        Self { slicing: self.slicing, samples: vec![0.0; self.samples.len()] }
    }

    /// The averages over the bins.
    pub fn samples(&self) -> &[f64] {
        &self.samples
    }

    /// The averages over the bins, to be changed.
    pub fn samples_mut(&mut self) -> &mut [f64] {
        &mut self.samples
    }

    /// Sets every bin to zero.
    pub fn clear(&mut self) {
        self.samples.fill(0.0);
    }

    /// The bins.
    pub(crate) fn slicing(&self) -> &Slicing {
        &self.slicing
    }

    /// Number of bins.
    pub fn bins(&self) -> usize {
        self.samples.len()
    }

    /// Lower end [nm].
    pub fn min_wavelength(&self) -> f64 {
        self.slicing.min_wavelength()
    }

    /// Upper end [nm].
    pub fn max_wavelength(&self) -> f64 {
        self.slicing.max_wavelength()
    }

    /// Width of a bin [nm].
    #[doc(alias = "delta_wavelength")]
    pub fn bin_width(&self) -> f64 {
        self.slicing.bin_width()
    }

    /// Centre of each bin [nm].
    pub fn wavelengths(&self) -> Vec<f64> {
        self.slicing.wavelengths()
    }

    /// The integral over the whole range.
    pub fn total(&self) -> f64 {
        self.samples.iter().sum::<f64>() * self.bin_width()
    }

    /// The integral between two wavelengths [nm], constant in each bin and zero outside the range.
    pub fn integrate(&self, min: f64, max: f64) -> f64 {
        if max < min {
            return -self.integrate(max, min);
        }
        let width = self.bin_width();
        let overlap = |i: usize| {
            let low = self.min_wavelength() + width * i as f64;
            (max.min(low + width) - min.max(low)).max(0.0)
        };
        self.samples.iter().enumerate().map(|(i, s)| s * overlap(i)).sum()
    }

    /// True if every bin is zero.
    pub fn is_zero(&self) -> bool {
        self.samples.iter().all(|s| *s == 0.0)
    }

    /// True if the other spectrum has the same range and bins.
    pub fn is_compatible(&self, other: &Self) -> bool {
        self.slicing == other.slicing
    }

    /// The number of photons instead of the energy in each bin [1/s/m²/sr/nm], by the photon's energy at the centre.
    pub fn to_photons(&self) -> Vec<f64> {
        self.samples.iter().zip(self.wavelengths()).map(|(s, w)| s / photon_energy_unchecked(w)).collect()
    }
}

impl SpectralFunction for Spectrum {
    fn evaluate(&self, wavelength: f64) -> f64 {
        let place = (wavelength - self.min_wavelength()) / self.bin_width();
        // The upper end belongs to the last bin.
        if !(place >= 0.0 && wavelength <= self.max_wavelength()) {
            return 0.0;
        }
        self.samples[(place as usize).min(self.samples.len() - 1)]
    }

    fn integrate(&self, min: f64, max: f64) -> f64 {
        Self::integrate(self, min, max)
    }

    fn resolution(&self) -> f64 {
        self.bin_width()
    }

    fn save(&self, _: &mut SceneWriter) -> Result<Saved, SaveError> {
        let saved = Saved::new("Spectrum").number("min", self.min_wavelength());
        Ok(saved.number("max", self.max_wavelength()).numbers("samples", &self.samples))
    }
}

/// Planck's constant times the speed of light [J nm], exact since the SI of 2019.
const HC: f64 = 6.626_070_15e-34 * 299_792_458.0 * 1e9;

fn photon_energy_unchecked(wavelength: f64) -> f64 {
    HC / wavelength
}

/// Energy of a photon [J] of a vacuum wavelength [nm].
///
/// # Errors
/// [`OpticalError::Math`] unless the wavelength is positive and finite.
pub fn photon_energy(wavelength: f64) -> Result<f64, OpticalError> {
    let admitted = wavelength > 0.0 && wavelength.is_finite();
    raysect_math::MathError::check(admitted, wavelength, "wavelength", "nm", "positive and finite")?;
    Ok(photon_energy_unchecked(wavelength))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn integrals_cut_bins() {
        let s = Spectrum::from_samples(400.0, 500.0, vec![1.0, 2.0, 3.0, 4.0]).unwrap();
        assert_eq!((s.total(), s.integrate(0.0, 1e4), s.integrate(412.5, 437.5)), (250.0, 250.0, 37.5));
        assert_eq!(s.integrate(437.5, 412.5), -37.5);
        assert!(Spectrum::new(400.0, 500.0, 0).is_err());
    }

    #[test]
    fn a_spectrum_is_its_bins_and_nothing_outside() {
        let s = Spectrum::from_samples(400.0, 500.0, vec![1.0, 2.0, 3.0, 4.0]).unwrap();
        let values = [399.9, 400.0, 424.9, 425.0, 499.0, 500.0, 500.1].map(|w| s.evaluate(w));
        assert_eq!(values, [0.0, 1.0, 1.0, 2.0, 4.0, 4.0, 0.0]);
        assert_eq!(s.evaluate(f64::NAN), 0.0);
        assert_eq!(s.sample(400.0, 500.0, 4), s.samples());
        assert_eq!(s.sample(400.0, 500.0, 2), [1.5, 3.5]);
        assert_eq!(Spectrum::of(&s, 350.0, 450.0, 2).unwrap().samples(), [0.0, 1.5]);
    }

    #[test]
    fn zeros_are_zero() {
        let mut s = Spectrum::from_samples(400.0, 500.0, vec![1.0, 0.0]).unwrap();
        assert!(!s.is_zero() && s.zeroed().is_zero() && s.is_compatible(&s.zeroed()));
        s.clear();
        assert_eq!(s, s.zeroed());
    }

    #[test]
    fn photons_have_their_energy() {
        assert!((photon_energy(500.0).unwrap() / 3.972_891_714_297_8e-19 - 1.0).abs() < 1e-12);
        assert!(photon_energy(0.0).is_err());
        let s = Spectrum::from_samples(499.0, 501.0, vec![1.0]).unwrap();
        assert!((s.to_photons()[0] * 3.972_891_714_297_8e-19 - 1.0).abs() < 1e-12);
    }
}
