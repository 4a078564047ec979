use std::path::Path;

use super::table::{row, wrong};
use crate::{Dielectric, InterpolatedSf, OpticalError, Sellmeier};

/// The files of the catalogue by the names of the glasses.
const CATALOGUE: [(&str, &str); 2] = [
    ("N-BK7", include_str!("../../data/glass/schott/N-BK7.csv")),
    ("SF11", include_str!("../../data/glass/schott/SF11.csv")),
];

/// A glass of Schott's catalogue, by its name.
///
/// The index follows the Sellmeier formula of the data sheet; the internal transmittance of the measured thickness
/// is taken to one metre, linear between the measured wavelengths and constant beyond them.
///
/// ```
/// use raysect_optical::library::schott;
/// assert!(schott("N-BK7").is_ok());
/// assert!(schott("N-BK8").unwrap_err().to_string().contains("N-BK8"));
/// ```
///
/// # Errors
/// [`OpticalError::UnknownGlass`], which lists the names there are.
pub fn schott(name: &str) -> Result<Dielectric, OpticalError> {
    let Some((_, text)) = CATALOGUE.iter().find(|(known, _)| *known == name) else {
        let known = schott_list().collect::<Vec<_>>().join(", ");
        return Err(OpticalError::UnknownGlass { name: name.to_owned(), known });
    };
    let sheet = DataSheet::parse(Path::new(name), text)?;
    let per_metre = 1000.0 / sheet.thickness;
    let transmission: Vec<f64> = sheet.transmittances.iter().map(|t| t.powf(per_metre)).collect();
    let transmission = InterpolatedSf::new(sheet.wavelengths, transmission)?;
    Ok(Dielectric::new(Sellmeier::new(sheet.b, sheet.c)?, transmission)?.named(name))
}

/// The names of the glasses that [`schott`] knows.
#[doc(alias = "list")]
pub fn schott_list() -> impl Iterator<Item = &'static str> {
    CATALOGUE.iter().map(|(name, _)| *name)
}

/// What the file of a glass says.
struct DataSheet {
    b: [f64; 3],
    c: [f64; 3],
    /// Of the sample whose transmittance was measured [mm].
    thickness: f64,
    wavelengths: Vec<f64>,
    transmittances: Vec<f64>,
}

impl DataSheet {
    fn parse(path: &Path, text: &str) -> Result<Self, OpticalError> {
        let (mut b, mut c, mut thickness) = (None, None, None);
        let (mut wavelengths, mut transmittances) = (Vec::new(), Vec::new());
        for (number, line) in text.lines().enumerate() {
            let at = |what| wrong(path, number + 1, what);
            let line = line.trim();
            if line.is_empty() || line.starts_with('#') {
                continue;
            }
            if let Some(rest) = line.strip_prefix("internal_transmittance: thickness_mm =") {
                thickness = Some(row::<1>(rest).map_err(at)?[0]);
            } else if let Some((key, rest)) = line.split_once('=') {
                match key.trim() {
                    "sellmeier_b" => b = Some(row::<3>(rest).map_err(at)?),
                    "sellmeier_c_um2" => c = Some(row::<3>(rest).map_err(at)?),
                    "valid_um" => drop(row::<2>(rest).map_err(at)?),
                    other => return Err(at(format!("unknown entry '{other}'"))),
                }
            } else {
                let [wavelength, transmittance] = row::<2>(line).map_err(at)?;
                if !(0.0..=1.0).contains(&transmittance) {
                    return Err(at(format!("transmittance {transmittance} is not in 0 … 1")));
                }
                wavelengths.push(wavelength);
                transmittances.push(transmittance);
            }
        }
        match (b, c, thickness) {
            (Some(b), Some(c), Some(thickness)) if thickness > 0.0 => {
                Ok(Self { b, c, thickness, wavelengths, transmittances })
            }
            _ => Err(wrong(path, 1, "Sellmeier coefficients and a positive thickness are needed".to_owned())),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_glass_of_the_catalogue_can_be_read() {
        for name in schott_list() {
            let index = schott(name).unwrap_or_else(|e| panic!("{e}")).index().function().evaluate(550.0);
            assert!((1.4..2.2).contains(&index), "{name} {index}");
        }
    }

    #[test]
    fn glasses_have_the_figures_of_their_sheets() {
        let glass = schott("N-BK7").unwrap();
        assert!((glass.index().function().evaluate(546.1) - 1.5187206).abs() < 1e-7);
        assert!((glass.transmission().function().evaluate(500.0) - 0.786059).abs() < 1e-5);
        assert!((schott("SF11").unwrap().index().function().evaluate(546.1) - 1.791_893_9).abs() < 1e-7);
    }

    #[test]
    fn sheets_that_are_wrong_are_refused_with_their_line() {
        let parse = |text: &str| DataSheet::parse(Path::new("x"), text).err().map(|e| e.to_string());
        let good = "sellmeier_b = 1,1,1\nsellmeier_c_um2 = 0,0,0\ninternal_transmittance: thickness_mm = 25\n400, 0.5\n";
        assert_eq!(parse(good), None);
        assert!(parse(&good.replace("0.5", "1.5")).unwrap().contains("line 4"));
        assert!(parse(&good.replace("400, 0.5", "400, a")).unwrap().contains("line 4"));
        assert!(parse(&good.replace("sellmeier_b", "selmeier")).unwrap().contains("unknown entry"));
        assert!(parse("400, 0.5").unwrap().contains("needed"));
    }
}
