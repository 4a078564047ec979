use std::path::Path;

use super::GlassSheet;
use crate::{Dielectric, OpticalError};

/// The files of glasses, by name.
macro_rules! catalogue {
    ($($name:literal)*) => {
        &[$(($name, include_str!(concat!("../../data/glass/schott/", $name, ".csv")))),*]
    };
}

/// Schott's glasses, in the order of their names.
const CATALOGUE: &[(&str, &str)] = catalogue![
    "BAFN6" "BK7G18" "F2" "F2G12" "F2HT" "F5" "FK3" "FK5HTi" "K10" "K5G20" "K7" "KZFS12" "KZFSN4"
    "LAFN7" "LAK9G15" "LAKL12" "LASF35" "LASFN9" "LF5" "LF5G15" "LF5G19" "LF5HTi" "LF7" "LLF1" "LLF1HTi"
    "N-BAF10" "N-BAF3" "N-BAF4" "N-BAF51" "N-BAF52" "N-BAK1" "N-BAK2" "N-BAK4" "N-BAK4HT" "N-BALF4"
    "N-BALF5" "N-BASF2" "N-BASF64" "N-BK10" "N-BK7" "N-BK7HT" "N-BK7HTi" "N-F2" "N-FK5" "N-FK51"
    "N-FK51A" "N-FK58" "N-K5" "N-KF9" "N-KZFS11" "N-KZFS2" "N-KZFS4" "N-KZFS4HT" "N-KZFS5" "N-KZFS8"
    "N-LAF2" "N-LAF21" "N-LAF3" "N-LAF32" "N-LAF33" "N-LAF34" "N-LAF35" "N-LAF36" "N-LAF7" "N-LAK10"
    "N-LAK12" "N-LAK14" "N-LAK21" "N-LAK22" "N-LAK33A" "N-LAK33B" "N-LAK34" "N-LAK7" "N-LAK8" "N-LAK9"
    "N-LASF31" "N-LASF31A" "N-LASF40" "N-LASF41" "N-LASF43" "N-LASF44" "N-LASF45" "N-LASF45HT"
    "N-LASF46" "N-LASF46A" "N-LASF46B" "N-LASF9" "N-LASF9HT" "N-PK51" "N-PK52A" "N-PSK3" "N-PSK53"
    "N-PSK53A" "N-SF1" "N-SF10" "N-SF11" "N-SF14" "N-SF15" "N-SF19" "N-SF2" "N-SF4" "N-SF5" "N-SF56"
    "N-SF57" "N-SF57HT" "N-SF57HTultra" "N-SF6" "N-SF64" "N-SF66" "N-SF6HT" "N-SF6HTultra" "N-SF8"
    "N-SK10" "N-SK11" "N-SK14" "N-SK15" "N-SK16" "N-SK2" "N-SK2HT" "N-SK4" "N-SK5" "N-SSK2" "N-SSK5"
    "N-SSK8" "N-ZK7" "N-ZK7A" "P-BK7" "P-LAF37" "P-LAK35" "P-LASF47" "P-LASF50" "P-LASF51" "P-PK53"
    "P-SF67" "P-SF68" "P-SF69" "P-SF8" "P-SK57" "P-SK57Q1" "P-SK58A" "P-SK60" "SF1" "SF10" "SF11" "SF14"
    "SF15" "SF2" "SF4" "SF5" "SF56A" "SF57" "SF57HTultra" "SF6" "SF66" "SF6G05" "SFL57" "SFL6"
];

/// A glass of Schott's catalogue, by its name.
///
/// The index follows the Sellmeier formula of the data sheet; the internal transmittance of the measured thickness
/// is taken to one metre, linear between the measured wavelengths and constant beyond them. A blank of the catalogue
/// at the ultraviolet end means opaque: there the transmittance falls to zero.
///
/// As Schott measures it, the index is that relative to air at 20 °C, at wavelengths in air; both are used as if of
/// vacuum, which shifts wavelengths by 0.03 %.
///
/// The formula holds within [`GlassSheet::range`]. Beyond it the index is extrapolated, as far as it stays real and
/// positive; where it does not, the glass refuses the wavelengths before any ray is traced.
///
/// These are the 157 glasses of the catalogue of 2017 (and LF7) for which there are free data. Of the 106 that
/// Raysect has from the year 2000, 13 are not among them: F4, KZFSN5, LAKN13, N-FK56, N-LAK33, N-LF5, N-LLF1, N-LLF6,
/// N-PK52, N-PSK57, N-PSK58, N-SK18 and SK51. [`GlassSheet::from_file`] reads such a one from a file.
///
/// ```
/// use raysect_optical::library::schott;
/// assert!(schott("N-BK7").is_ok());
/// assert!(schott("N-BK8").unwrap_err().to_string().contains("N-BK8"));
/// ```
///
/// # Errors
/// [`OpticalError::Unknown`], which lists the names there are.
pub fn schott(name: &str) -> Result<Dielectric, OpticalError> {
    let sheet = schott_sheet(name)?;
    Ok(Dielectric::new(sheet.index(), sheet.transmission().clone())?.named(name))
}

/// The data sheet of a glass of Schott's catalogue, by its name. Only its own file is read.
///
/// # Errors
/// As [`schott`].
pub fn schott_sheet(name: &str) -> Result<GlassSheet, OpticalError> {
    match CATALOGUE.iter().find(|(known, _)| *known == name) {
        Some((_, text)) => GlassSheet::parse(Path::new(name), text),
        None => Err(OpticalError::unknown("Schott glass", name, schott_list())),
    }
}

/// The names of the glasses that [`schott`] knows.
#[doc(alias = "list")]
pub fn schott_list() -> impl Iterator<Item = &'static str> {
    CATALOGUE.iter().map(|(name, _)| *name)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::SpectralFunction;

    #[test]
    fn every_glass_of_the_catalogue_can_be_read() {
        for name in schott_list() {
            let sheet = schott_sheet(name).unwrap_or_else(|e| panic!("{e}"));
            let (low, high) = sheet.range();
            assert!(low < 550.0 && high > 650.0, "{name} {low} {high}");
            for wavelength in [low, 550.0, high] {
                let index = sheet.index().evaluate(wavelength);
                assert!((1.4..2.4).contains(&index), "{name} {wavelength} {index}");
            }
            assert!(sheet.index().evaluate(450.0) > sheet.index().evaluate(650.0), "{name}");
            assert!((0.0..=1.0).contains(&sheet.transmission().evaluate(550.0)), "{name}");
            assert!(sheet.transmission().evaluate(200.0) < 1e-10, "{name} lets ultraviolet through");
        }
    }

    #[test]
    fn every_file_of_the_folder_is_in_the_catalogue() {
        let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/data/glass/schott");
        let mut files: Vec<String> = std::fs::read_dir(folder)
            .unwrap()
            .map(|entry| entry.unwrap().path().file_stem().unwrap().to_str().unwrap().to_owned())
            .collect();
        files.sort();
        assert_eq!(schott_list().collect::<Vec<_>>(), files);
    }

    #[test]
    fn glasses_have_the_figures_of_their_sheets() {
        let glass = schott("N-BK7").unwrap();
        assert!((glass.index().function().evaluate(546.1) - 1.5187206).abs() < 1e-7);
        assert!((glass.transmission().function().evaluate(500.0) - 0.786059).abs() < 1e-5);
        assert!((schott("SF11").unwrap().index().function().evaluate(546.1) - 1.791_893_9).abs() < 1e-7);
        // The index at 587.5618 nm to five decimals and the Abbe number to two, as the maker prints them.
        for (name, n_d, v_d) in [
            ("N-BK7", 1.51680, 64.17),
            ("SF11", 1.78472, 25.76),
            ("F2", 1.62004, 36.37),
            ("N-SF6", 1.80518, 25.36),
            ("N-LASF9", 1.85025, 32.17),
            ("N-FK51A", 1.48656, 84.47),
            ("N-BAK4", 1.56883, 55.98),
        ] {
            let index = schott_sheet(name).unwrap().index();
            let [d, f, c] = [587.5618, 486.1327, 656.2725].map(|w| index.evaluate(w));
            assert!((d - n_d).abs() < 6e-6, "{name} {d}");
            assert!(((d - 1.0) / (f - c) - v_d).abs() < 6e-3, "{name} {}", (d - 1.0) / (f - c));
        }
    }

    #[test]
    fn a_glass_that_is_not_there_is_named_with_those_that_are() {
        let message = schott("SK51").unwrap_err().to_string();
        assert!(message.contains("no Schott glass 'SK51'") && message.contains("N-BK7, "), "{message}");
    }
}
