//! CIE 1931 colour and sRGB.
//!
//! Tristimulus values are in units of the radiance: a flat spectrum of 1 W/m²/sr/nm has X = Y = Z = 1 to within
//! 4e-4 (no factor of 683 lm/W), as in Raysect.

use std::path::Path;
use std::sync::OnceLock;

pub use crate::library::d65_white;
use crate::library::table::{columns, proven};
use crate::{InterpolatedSf, Slicing, SpectralTable, Spectrum};

/// The integral of ȳ over the visible range [nm] by which Raysect divides the colour matching functions.
const NORMALISATION: f64 = 106.8566;

/// Which table of the CIE 1931 2° observer is used.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum CieObserver {
    /// The table at 1 nm, 360 … 830 nm (ISO 11664-1).
    #[default]
    OneNanometre,
    /// The abridged table at 5 nm, linear between 375 and 785 nm, where it ends in zeros: Raysect's. Colours differ
    /// by some 5e-5.
    FiveNanometres,
}

impl CieObserver {
    /// The colour matching functions x̄, ȳ, z̄ divided by 106.8566, which is the integral of ȳ [nm]; zero outside the
    /// table.
    #[doc(alias("ciexyz_x", "ciexyz_y", "ciexyz_z"))]
    pub fn curves(self) -> &'static [SpectralTable; 3] {
        static ONE: OnceLock<[SpectralTable; 3]> = OnceLock::new();
        static FIVE: OnceLock<[SpectralTable; 3]> = OnceLock::new();
        match self {
            Self::OneNanometre => {
                ONE.get_or_init(|| matching_functions(include_str!("../data/colour/cie1931_2deg_1nm.csv")))
            }
            Self::FiveNanometres => {
                FIVE.get_or_init(|| matching_functions(include_str!("../data/colour/cie1931_2deg_5nm.csv")))
            }
        }
    }

    /// The averages of x̄, ȳ, z̄ over each bin.
    pub fn resample(self, slicing: &Slicing) -> Vec<[f64; 3]> {
        let [x, y, z] = sampled(self, slicing);
        (0..slicing.bins()).map(|i| [x[i], y[i], z[i]]).collect()
    }

    /// The tristimulus values of a spectrum.
    pub fn tristimulus(self, spectrum: &Spectrum) -> [f64; 3] {
        sampled(self, spectrum.slicing()).map(|averages| {
            averages.iter().zip(spectrum.samples()).map(|(c, s)| c * s).sum::<f64>() * spectrum.bin_width()
        })
    }
}

fn matching_functions(text: &str) -> [SpectralTable; 3] {
    let [w, x, y, z] = proven(columns(Path::new("built-in table"), text));
    // Zero beyond the ends, where the table has fallen to 1e-4 and less.
    let beyond = [w[0] - 1.0, w[w.len() - 1] + 1.0];
    let enclose = |middle: Vec<f64>, ends: [f64; 2]| -> Vec<f64> {
        [ends[0]].into_iter().chain(middle).chain([ends[1]]).collect()
    };
    let wavelengths = enclose(w, beyond);
    [x, y, z].map(|values| {
        let values = values.into_iter().map(|v| v / NORMALISATION).collect();
        proven(InterpolatedSf::new(wavelengths.clone(), enclose(values, [0.0, 0.0]))).into()
    })
}

/// The three averages of x̄, ȳ, z̄ over each bin.
fn sampled(observer: CieObserver, slicing: &Slicing) -> [Vec<f64>; 3] {
    let (min, max) = (slicing.min_wavelength(), slicing.max_wavelength());
    observer.curves().each_ref().map(|curve| curve.function().sample(min, max, slicing.bins()))
}

/// The averages of x̄, ȳ, z̄ over each bin.
pub fn resample_ciexyz(slicing: &Slicing) -> Vec<[f64; 3]> {
    CieObserver::default().resample(slicing)
}

/// The tristimulus values of a spectrum.
pub fn spectrum_to_ciexyz(spectrum: &Spectrum) -> [f64; 3] {
    CieObserver::default().tristimulus(spectrum)
}

/// Chromaticity x, y and luminance Y of tristimulus values; black has the chromaticity of equal energy, ⅓, ⅓.
pub fn ciexyz_to_ciexyy([x, y, z]: [f64; 3]) -> [f64; 3] {
    let sum = x + y + z;
    if sum == 0.0 { [1.0 / 3.0, 1.0 / 3.0, 0.0] } else { [x / sum, y / sum, y] }
}

/// Tristimulus values of a chromaticity x, y and luminance Y; black for y = 0, which no colour has.
pub fn ciexyy_to_ciexyz([x, y, luminance]: [f64; 3]) -> [f64; 3] {
    if y == 0.0 { [0.0; 3] } else { [luminance / y * x, luminance, luminance / y * (1.0 - x - y)] }
}

/// The matrices of IEC 61966-2-1 for the primaries of sRGB under D65.
const TO_RGB: [[f64; 3]; 3] = [
    [3.2404542, -1.5371385, -0.4985314],
    [-0.969266, 1.8760108, 0.041556],
    [0.0556434, -0.2040259, 1.0572252],
];
const TO_XYZ: [[f64; 3]; 3] =
    [[0.4124564, 0.3575761, 0.1804375], [0.2126729, 0.7151522, 0.072175], [0.0193339, 0.119192, 0.9503041]];

fn apply(matrix: &[[f64; 3]; 3], v: [f64; 3]) -> [f64; 3] {
    matrix.map(|row| row[0] * v[0] + row[1] * v[1] + row[2] * v[2])
}

/// Linear sRGB values of tristimulus values, before the transfer curve; out of gamut is negative or above 1.
pub fn xyz_to_linear_srgb(xyz: [f64; 3]) -> [f64; 3] {
    apply(&TO_RGB, xyz)
}

/// sRGB values in 0 … 1 of tristimulus values with white at Y = 1; out of gamut is clipped.
pub fn ciexyz_to_srgb(xyz: [f64; 3]) -> [f64; 3] {
    apply(&TO_RGB, xyz).map(|v| {
        let encoded = if v <= 0.0031308 { 12.92 * v } else { 1.055 * v.powf(1.0 / 2.4) - 0.055 };
        encoded.clamp(0.0, 1.0)
    })
}

/// Tristimulus values of sRGB values.
pub fn srgb_to_ciexyz(rgb: [f64; 3]) -> [f64; 3] {
    apply(&TO_XYZ, rgb.map(|v| if v <= 0.04045 { v / 12.92 } else { ((v + 0.055) / 1.055).powf(2.4) }))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::SpectralFunction;

    #[test]
    fn a_flat_spectrum_is_one_in_every_channel() {
        let flat = Spectrum::from_samples(360.0, 830.0, vec![1.0; 470]).unwrap();
        for v in spectrum_to_ciexyz(&flat) {
            assert!((v - 1.0).abs() < 4e-4, "{v}");
        }
    }

    #[test]
    fn the_abridged_observer_is_that_of_raysect() {
        let flat = |observer: CieObserver| {
            observer.curves().each_ref().map(|c| c.function().integrate(375.0, 785.0))
        };
        let five = flat(CieObserver::FiveNanometres);
        for (v, expected) in five.iter().zip([1.0000095, 1.0000003, 1.0000103]) {
            assert!((v - expected).abs() < 1e-7, "{v}");
        }
        assert!(flat(CieObserver::OneNanometre).iter().zip(five).all(|(a, b)| (a - b).abs() < 5e-4));
    }

    #[test]
    fn d65_is_white() {
        let d65 = d65_white();
        assert!((d65.average(375.0, 785.0) - 1.0).abs() < 1e-6);
        let s = Spectrum::from_samples(375.0, 785.0, d65.sample(375.0, 785.0, 410)).unwrap();
        let xyz = spectrum_to_ciexyz(&s);
        let [x, y, luminance] = ciexyz_to_ciexyy(xyz);
        assert!((x - 0.31272).abs() < 1e-4 && (y - 0.32903).abs() < 1e-4, "{x} {y}");
        assert!((luminance - 1.13407).abs() < 2e-3);
        for v in ciexyz_to_srgb(xyz.map(|v| v / luminance)) {
            assert!((v - 1.0).abs() < 5e-4, "{v}");
        }
    }

    #[test]
    fn colours_come_back() {
        for rgb in [[0.2, 0.5, 0.9], [0.01, 0.02, 0.0], [1.0, 1.0, 1.0]] {
            let back = ciexyz_to_srgb(srgb_to_ciexyz(rgb));
            assert!(rgb.iter().zip(back).all(|(a, b)| (a - b).abs() < 1e-5), "{rgb:?} {back:?}");
        }
        let xyz = ciexyy_to_ciexyz([0.3, 0.4, 2.0]);
        assert!(ciexyz_to_ciexyy(xyz).iter().zip([0.3, 0.4, 2.0]).all(|(a, b)| (a - b).abs() < 1e-15));
        assert_eq!((ciexyz_to_srgb([-1.0, 0.0, 9.0])[2], ciexyy_to_ciexyz([0.3, 0.0, 1.0])), (1.0, [0.0; 3]));
    }
}
