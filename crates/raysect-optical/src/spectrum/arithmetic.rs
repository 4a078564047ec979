//! Sums, differences, products and quotients of spectra, bin by bin.

use std::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Sub, SubAssign};

use super::Spectrum;
use crate::OpticalError;

impl Spectrum {
    /// Replaces each sample by a function of itself and of that of another spectrum.
    ///
    /// ```
    /// use raysect_optical::Spectrum;
    /// let mut sum = Spectrum::from_samples(400.0, 500.0, vec![1.0, 2.0])?;
    /// let other = Spectrum::from_samples(400.0, 500.0, vec![10.0, 20.0])?;
    /// sum.combine(&other, |a, b| a + 0.5 * b)?;
    /// assert_eq!(sum.samples(), [6.0, 12.0]);
    /// assert!(sum.combine(&Spectrum::new(400.0, 500.0, 3)?, |a, b| a + b).is_err());
    /// # Ok::<(), raysect_optical::OpticalError>(())
    /// ```
    ///
    /// # Errors
    /// [`OpticalError::Incompatible`] if they have different bins; nothing is changed then.
    pub fn combine(&mut self, other: &Self, f: impl Fn(f64, f64) -> f64) -> Result<(), OpticalError> {
        if !self.is_compatible(other) {
            return Err(OpticalError::Incompatible {
                bins: self.bins(),
                min: self.min_wavelength(),
                max: self.max_wavelength(),
                other_bins: other.bins(),
                other_min: other.min_wavelength(),
                other_max: other.max_wavelength(),
            });
        }
        self.combine_samples(&other.samples, f)
    }

    /// Replaces each sample by a function of itself and of one of as many numbers.
    ///
    /// # Errors
    /// [`OpticalError::SampleCount`] if there are more or fewer than bins; nothing is changed then.
    pub fn combine_samples(
        &mut self,
        others: &[f64],
        f: impl Fn(f64, f64) -> f64,
    ) -> Result<(), OpticalError> {
        if others.len() != self.bins() {
            return Err(OpticalError::SampleCount { samples: others.len(), bins: self.bins() });
        }
        self.samples.iter_mut().zip(others).for_each(|(a, b)| *a = f(*a, *b));
        Ok(())
    }

    /// Adds a multiple of another spectrum.
    ///
    /// # Errors
    /// [`OpticalError::Incompatible`] if they have different bins.
    #[doc(alias = "mad_scalar")]
    pub fn multiply_add(&mut self, factor: f64, other: &Self) -> Result<(), OpticalError> {
        self.combine(other, |a, b| a + factor * b)
    }

    /// Adds the product of two spectra.
    ///
    /// # Errors
    /// [`OpticalError::Incompatible`] if they have different bins.
    #[doc(alias = "mad_array")]
    pub fn product_add(&mut self, first: &Self, second: &Self) -> Result<(), OpticalError> {
        let mut product = first.clone();
        product.combine(second, |a, b| a * b)?;
        self.combine(&product, |a, b| a + b)
    }
}

/// The operators between spectra and with numbers: assigning ones, and those of owned and borrowed spectra.
macro_rules! operator {
    ($trait:ident $method:ident $assign_trait:ident $assign:ident $f:expr) => {
        /// # Panics
        /// If the spectra have different bins.
        impl $assign_trait<&Spectrum> for Spectrum {
            #[track_caller]
            fn $assign(&mut self, other: &Spectrum) {
                if let Err(error) = self.combine(other, $f) {
                    panic!("{error}");
                }
            }
        }

        /// # Panics
        /// If there are more or fewer numbers than bins.
        impl $assign_trait<&[f64]> for Spectrum {
            #[track_caller]
            fn $assign(&mut self, others: &[f64]) {
                if let Err(error) = self.combine_samples(others, $f) {
                    panic!("{error}");
                }
            }
        }

        impl $assign_trait<f64> for Spectrum {
            fn $assign(&mut self, number: f64) {
                self.samples.iter_mut().for_each(|s| *s = $f(*s, number));
            }
        }

        impl<T> $trait<T> for Spectrum
        where
            Spectrum: $assign_trait<T>,
        {
            type Output = Spectrum;
            #[track_caller]
            fn $method(mut self, other: T) -> Spectrum {
                self.$assign(other);
                self
            }
        }

        impl<T> $trait<T> for &Spectrum
        where
            Spectrum: $assign_trait<T>,
        {
            type Output = Spectrum;
            #[track_caller]
            fn $method(self, other: T) -> Spectrum {
                self.clone().$method(other)
            }
        }
    };
}

operator!(Add add AddAssign add_assign |a: f64, b: f64| a + b);
operator!(Sub sub SubAssign sub_assign |a: f64, b: f64| a - b);
operator!(Mul mul MulAssign mul_assign |a: f64, b: f64| a * b);
operator!(Div div DivAssign div_assign |a: f64, b: f64| a / b);

impl Neg for Spectrum {
    type Output = Self;
    fn neg(mut self) -> Self {
        self.samples.iter_mut().for_each(|s| *s = -*s);
        self
    }
}

impl Mul<Spectrum> for f64 {
    type Output = Spectrum;
    fn mul(self, spectrum: Spectrum) -> Spectrum {
        spectrum * self
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pair() -> (Spectrum, Spectrum) {
        let of = |samples: [f64; 2]| Spectrum::from_samples(400.0, 500.0, samples.to_vec()).unwrap();
        (of([6.0, 8.0]), of([3.0, 2.0]))
    }

    #[test]
    fn arithmetic_is_by_bin() {
        let (a, b) = pair();
        assert_eq!((&a + &b).samples(), [9.0, 10.0]);
        assert_eq!((&a - &b).samples(), [3.0, 6.0]);
        assert_eq!((&a * &b).samples(), [18.0, 16.0]);
        assert_eq!((&a / &b).samples(), [2.0, 4.0]);
        assert_eq!((a.clone() + 1.0).samples(), [7.0, 9.0]);
        assert_eq!((a.clone() - 1.0).samples(), [5.0, 7.0]);
        assert_eq!((2.0 * a.clone()).samples(), (&a * 2.0).samples());
        assert_eq!((-a.clone() / 2.0).samples(), [-3.0, -4.0]);
        assert_eq!((&a * [0.5, 0.25].as_slice()).samples(), [3.0, 2.0]);
        let mut c = a.clone();
        c += &b;
        c -= &a;
        c *= &b;
        c /= 2.0;
        assert_eq!(c.samples(), [4.5, 2.0]);
    }

    #[test]
    fn products_are_accumulated() {
        let (mut a, b) = pair();
        a.multiply_add(10.0, &b).unwrap();
        assert_eq!(a.samples(), [36.0, 28.0]);
        a.product_add(&b, &b).unwrap();
        assert_eq!(a.samples(), [45.0, 32.0]);
    }

    #[test]
    fn other_bins_are_refused_and_nothing_is_changed() {
        let (mut a, _) = pair();
        let before = a.clone();
        let wide = Spectrum::new(400.0, 501.0, 2).unwrap();
        let message = a.multiply_add(1.0, &wide).unwrap_err().to_string();
        assert!(
            message.contains("2 bins over 400 … 500 nm") && message.contains("400 … 501 nm"),
            "{message}"
        );
        assert!(a.product_add(&before, &wide).is_err() && a.product_add(&wide, &wide).is_err());
        let message = a.combine_samples(&[1.0], |a, b| a + b).unwrap_err().to_string();
        assert_eq!(message, "1 samples do not belong to 2 bins");
        assert_eq!(a, before);
    }

    #[test]
    #[should_panic(expected = "cannot be combined")]
    fn operators_panic_for_other_bins() {
        let (mut a, _) = pair();
        a += &Spectrum::new(400.0, 500.0, 3).unwrap();
    }
}
