use std::path::Path;

use super::table::{functions, proven};
use crate::{InterpolatedSf, SpectralFunction, WavelengthUnit};

/// The CIE standard illuminant A (ISO 11664-2), an incandescent lamp of 2856 K, 300 … 830 nm at 5 nm, scaled to an
/// average of 1 over 375 … 785 nm.
///
/// Its chromaticity is x = 0.44758, y = 0.40745.
pub fn illuminant_a() -> InterpolatedSf {
    let table = illuminant(include_str!("../../data/illuminant/a_5nm.csv"));
    let average = table.average(375.0, 785.0);
    table.scaled(1.0 / average)
}

/// The equal-energy illuminant E of the CIE: 1 at every wavelength.
///
/// Its chromaticity is x = y = ⅓.
pub fn illuminant_e() -> f64 {
    1.0
}

/// The CIE standard illuminant D65 (ISO 11664-2), average daylight, 300 … 830 nm at 5 nm, scaled to an average of 1 over
/// 375 … 785 nm.
///
/// Its luminance is therefore Y = 1.134, not 1; its chromaticity x = 0.31272, y = 0.32903.
pub fn d65_white() -> InterpolatedSf {
    illuminant(include_str!("../../data/illuminant/d65_5nm.csv")).scaled(1.0 / 87.1971)
}

fn illuminant(text: &str) -> InterpolatedSf {
    let [table] = proven(functions(Path::new("built-in table"), text, WavelengthUnit::Nanometre));
    table
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::colour::{ciexyz_to_ciexyy, spectrum_to_ciexyz};
    use crate::{BlackBody, Spectrum};

    /// Chromaticity over 375 … 785 nm in bins of 1 nm.
    fn chromaticity(illuminant: &dyn SpectralFunction) -> [f64; 2] {
        let samples = illuminant.sample(375.0, 785.0, 410);
        let [x, y, _] =
            ciexyz_to_ciexyy(spectrum_to_ciexyz(&Spectrum::from_samples(375.0, 785.0, samples).unwrap()));
        [x, y]
    }

    #[test]
    fn illuminants_have_their_chromaticities() {
        // CIE 15:2004, table T.3.
        let all: [(&dyn SpectralFunction, [f64; 2]); 3] = [
            (&illuminant_a(), [0.44758, 0.40745]),
            (&d65_white(), [0.31272, 0.32903]),
            (&illuminant_e(), [1.0 / 3.0, 1.0 / 3.0]),
        ];
        for (illuminant, expected) in all {
            let found = chromaticity(illuminant);
            assert!(found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 5e-5), "{found:?} {expected:?}");
            assert!((illuminant.average(375.0, 785.0) - 1.0).abs() < 1e-6);
        }
    }

    #[test]
    fn a_is_a_black_body() {
        // Of c₂ = 1.435e-2 m K and 2848 K; with today's constant it is 2856 K.
        let temperature = 2848.0 * 1.438_776_877 / 1.435;
        let (a, body) = (illuminant_a(), BlackBody::new(temperature).unwrap());
        let ratio = |wavelength: f64| a.evaluate(wavelength) / body.evaluate(wavelength);
        for wavelength in [300.0, 450.0, 700.0, 780.0, 785.0, 830.0] {
            assert!((ratio(wavelength) / ratio(560.0) - 1.0).abs() < 1e-5, "{wavelength}");
        }
    }
}
