use std::path::Path;

use super::table;
use crate::{Conductor, InterpolatedSf, OpticalError, RoughConductor, WavelengthUnit};

/// The files of metals, by name.
macro_rules! metals {
    ($($name:literal)*) => {
        &[$(($name, include_str!(concat!("../../data/metal/", $name, ".csv")))),*]
    };
}

const METALS: &[(&str, &str)] = metals![
    "Aluminium" "Beryllium" "Cobalt" "Copper" "Gold" "Iron" "Lithium" "Magnesium" "Manganese" "Mercury" "Nickel"
    "Palladium" "Platinum" "Silicon" "Silver" "Sodium" "Titanium" "Tungsten"
];

/// The refractive index n and the extinction coefficient k of a metal (or of silicon), of the complex index n + i k.
///
/// Both are linear between the measured wavelengths and constant beyond them. The source of each table is named in its
/// file; all reach over 326 … 840 nm.
///
/// ```
/// use raysect_optical::SpectralFunction;
/// use raysect_optical::library::metal_index;
/// let (n, k) = metal_index("Gold")?;
/// assert!((n.evaluate(500.0) - 0.8654).abs() < 1e-4 && (k.evaluate(500.0) - 1.8504).abs() < 1e-4);
/// # Ok::<(), raysect_optical::OpticalError>(())
/// ```
///
/// # Errors
/// [`OpticalError::Unknown`], which lists the names there are.
pub fn metal_index(name: &str) -> Result<(InterpolatedSf, InterpolatedSf), OpticalError> {
    match METALS.iter().find(|(known, _)| *known == name) {
        Some((_, text)) => read(Path::new(name), text, WavelengthUnit::Nanometre),
        None => Err(OpticalError::unknown("metal", name, metal_list())),
    }
}

/// A smooth surface of a metal, by its name.
///
/// # Errors
/// As [`metal_index`].
#[doc(alias("Aluminium", "Copper", "Gold", "Silver", "Titanium", "Tungsten"))]
pub fn metal(name: &str) -> Result<Conductor, OpticalError> {
    let (n, k) = metal_index(name)?;
    Ok(Conductor::new(n, k))
}

/// A rough surface of a metal, by its name and its roughness, 0 … 1 without 0.
///
/// # Errors
/// As [`metal_index`] and [`RoughConductor::new`].
#[doc(alias("RoughAluminium", "RoughCopper", "RoughGold", "RoughSilver", "RoughTitanium", "RoughTungsten"))]
pub fn rough_metal(name: &str, roughness: f64) -> Result<RoughConductor, OpticalError> {
    let (n, k) = metal_index(name)?;
    RoughConductor::new(n, k, roughness)
}

/// The names that [`metal_index`] knows.
pub fn metal_list() -> impl Iterator<Item = &'static str> {
    METALS.iter().map(|(name, _)| *name)
}

/// The refractive index n and the extinction coefficient k of a text file: three columns, wavelength in the given unit,
/// n and k, separated by a comma, semicolon or white space; lines that begin with `#` are comments.
///
/// # Errors
/// [`OpticalError::File`] if it cannot be read, [`OpticalError::Line`] for the first line that is wrong.
pub fn complex_index_from_csv(
    path: impl AsRef<Path>,
    unit: WavelengthUnit,
) -> Result<(InterpolatedSf, InterpolatedSf), OpticalError> {
    let path = path.as_ref();
    let text = std::fs::read_to_string(path)
        .map_err(|source| OpticalError::File { path: path.to_owned(), source })?;
    read(path, &text, unit)
}

fn read(
    path: &Path,
    text: &str,
    unit: WavelengthUnit,
) -> Result<(InterpolatedSf, InterpolatedSf), OpticalError> {
    table::functions::<2>(path, text, unit).map(|[n, k]| (n, k))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::SpectralFunction;

    /// Reflectance at normal incidence.
    fn reflectance(name: &str, wavelength: f64) -> f64 {
        let (n, k) = metal_index(name).unwrap();
        let (n, k) = (n.evaluate(wavelength), k.evaluate(wavelength));
        ((n - 1.0).powi(2) + k * k) / ((n + 1.0).powi(2) + k * k)
    }

    #[test]
    fn every_metal_can_be_read_and_spans_the_visible() {
        assert_eq!(metal_list().count(), 18);
        for name in metal_list() {
            let (n, k) = metal_index(name).unwrap_or_else(|e| panic!("{e}"));
            let ends = (n.wavelengths()[0], n.wavelengths()[n.wavelengths().len() - 1]);
            assert!(ends.0 <= 326.0 && ends.1 >= 840.0, "{name} {ends:?}");
            assert!(n.values().iter().chain(k.values()).all(|v| *v >= 0.0), "{name}");
            let r = reflectance(name, 600.0);
            assert!((0.3..1.0).contains(&r), "{name} {r}");
        }
    }

    #[test]
    fn every_file_of_the_folder_is_a_metal() {
        let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/data/metal");
        let mut files: Vec<String> = std::fs::read_dir(folder)
            .unwrap()
            .map(|entry| entry.unwrap().path().file_stem().unwrap().to_str().unwrap().to_owned())
            .collect();
        files.sort();
        assert_eq!(metal_list().collect::<Vec<_>>(), files);
    }

    #[test]
    fn metals_have_their_colours() {
        assert!(reflectance("Gold", 450.0) < 0.45 && reflectance("Gold", 650.0) > 0.9);
        assert!(reflectance("Copper", 500.0) < 0.7 && reflectance("Copper", 650.0) > 0.85);
        assert!(reflectance("Silver", 450.0) > 0.92 && reflectance("Aluminium", 450.0) > 0.88);
        assert!(
            metal_index("Cobolt")
                .unwrap_err()
                .to_string()
                .contains("no metal 'Cobolt' in the library; it has Alum")
        );
    }

    #[test]
    fn files_of_users_are_read_in_their_unit() {
        let path = std::env::temp_dir().join(format!("raysect-metal-{}.csv", std::process::id()));
        std::fs::write(&path, "# wl n k\n0.4 1.5 3\n0.5 1.6 4\n").unwrap();
        let (n, k) = complex_index_from_csv(&path, WavelengthUnit::Micrometre).unwrap();
        assert_eq!((n.evaluate(400.0), k.evaluate(450.0)), (1.5, 3.5));
        std::fs::write(&path, "0.4 1.5\n").unwrap();
        assert!(
            complex_index_from_csv(&path, WavelengthUnit::Nanometre)
                .unwrap_err()
                .to_string()
                .contains("line 1")
        );
        std::fs::remove_file(&path).unwrap();
    }
}
