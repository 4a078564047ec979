use std::path::Path;

use super::table::{row, wrong};
use crate::{InterpolatedSf, OpticalError, Sellmeier};

/// The data sheet of a glass: dispersion formula and internal transmittance.
///
/// ```
/// use raysect_optical::SpectralFunction;
/// use raysect_optical::library::schott_sheet;
/// let sheet = schott_sheet("SF11")?;
/// assert_eq!(sheet.range(), (390.0, 2500.0));
/// assert!((sheet.index().evaluate(587.5618) - 1.78472).abs() < 1e-5);
/// # Ok::<(), raysect_optical::OpticalError>(())
/// ```
#[derive(Debug, Clone)]
pub struct GlassSheet {
    index: Sellmeier,
    range: (f64, f64),
    transmission: InterpolatedSf,
}

impl GlassSheet {
    /// From a file of the format of this library, of a glass of any maker.
    ///
    /// It has `key = value` lines for the coefficients of Sellmeier's formula, `sellmeier_b = b1, b2, b3` and
    /// `sellmeier_c_um2 = c1, c2, c3` [µm²], for the range in which the formula holds, `valid_um = low, high` [µm], and
    /// for the thickness of the sample [mm], `internal_transmittance: thickness_mm = d`; then rows of wavelength [nm]
    /// and internal transmittance (0 … 1, without the reflection of the faces). Lines that begin with `#` are comments.
    ///
    /// # Errors
    /// [`OpticalError::File`], and [`OpticalError::Line`] for the first line that is wrong.
    pub fn from_file(path: impl AsRef<Path>) -> Result<Self, OpticalError> {
        let path = path.as_ref();
        let text = std::fs::read_to_string(path)
            .map_err(|source| OpticalError::File { path: path.to_owned(), source })?;
        Self::parse(path, &text)
    }

    /// The refractive index as a function of the wavelength in vacuum or, as makers of glass measure it, in air: see the
    /// source of the sheet.
    pub fn index(&self) -> Sellmeier {
        self.index
    }

    /// The wavelengths [nm] between which the formula of the index holds. Beyond them it is an extrapolation.
    pub fn range(&self) -> (f64, f64) {
        self.range
    }

    /// The internal transmittance of one metre, linear between the measured wavelengths and constant beyond them.
    pub fn transmission(&self) -> &InterpolatedSf {
        &self.transmission
    }

    pub(super) fn parse(path: &Path, text: &str) -> Result<Self, OpticalError> {
        let mut fields = Fields::default();
        for (line, number) in text.lines().zip(1..) {
            let line = line.trim();
            if !line.is_empty() && !line.starts_with('#') {
                fields.read(line, number).map_err(|what| wrong(path, number, what))?;
            }
        }
        let missing = |what: &str| wrong(path, 1, format!("{what} missing"));
        let b = fields.b.ok_or_else(|| missing("the entry sellmeier_b is"))?;
        let c = fields.c.ok_or_else(|| missing("the entry sellmeier_c_um2 is"))?;
        let [low, high] = fields.range.ok_or_else(|| missing("the entry valid_um is"))?;
        let thickness = fields.thickness.ok_or_else(|| missing("the thickness of the sample is"))?;
        let Some(&last) = fields.lines.last() else {
            return Err(missing("the rows of the transmittance are"));
        };
        let per_metre = fields.transmittances.iter().map(|t| t.powf(1000.0 / thickness)).collect::<Vec<_>>();
        let transmission =
            InterpolatedSf::new(fields.wavelengths, per_metre).map_err(|error| match error {
                OpticalError::Table { index, what, .. } => wrong(path, fields.lines[index], what.to_owned()),
                other => wrong(path, last, other.to_string()),
            })?;
        Ok(Self { index: Sellmeier::new(b, c)?, range: (low * 1e3, high * 1e3), transmission })
    }
}

/// What the lines of a sheet have said so far.
#[derive(Default)]
struct Fields {
    b: Option<[f64; 3]>,
    c: Option<[f64; 3]>,
    range: Option<[f64; 2]>,
    /// Of the sample whose transmittance was measured [mm].
    thickness: Option<f64>,
    wavelengths: Vec<f64>,
    transmittances: Vec<f64>,
    /// The line of each row.
    lines: Vec<usize>,
}

impl Fields {
    fn read(&mut self, line: &str, number: usize) -> Result<(), String> {
        if let Some(rest) = line.strip_prefix("internal_transmittance: thickness_mm =") {
            let [thickness] = row(rest)?;
            if !(thickness > 0.0 && thickness.is_finite()) {
                return Err(format!("a thickness of {thickness} mm is not positive and finite"));
            }
            self.thickness = Some(thickness);
        } else if let Some((key, rest)) = line.split_once('=') {
            match key.trim() {
                "sellmeier_b" => self.b = Some(row(rest)?),
                "sellmeier_c_um2" => self.c = Some(row(rest)?),
                "valid_um" => self.range = Some(row(rest)?),
                other => return Err(format!("unknown entry '{other}'")),
            }
        } else {
            let [wavelength, transmittance] = row(line)?;
            if !(0.0..=1.0).contains(&transmittance) {
                return Err(format!("transmittance {transmittance} is not in 0 … 1"));
            }
            self.wavelengths.push(wavelength);
            self.transmittances.push(transmittance);
            self.lines.push(number);
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::SpectralFunction;

    const GOOD: &str = "# x\nsellmeier_b = 1,1,1\nsellmeier_c_um2 = 0,0,0\nvalid_um = 0.3, 2\n\
        internal_transmittance: thickness_mm = 500\n400, 0.5\n500, 0.9\n";

    #[test]
    fn a_sheet_says_what_its_file_says() {
        let sheet = GlassSheet::parse(Path::new("x"), GOOD).unwrap();
        assert_eq!((sheet.range(), sheet.index().evaluate(500.0)), ((300.0, 2000.0), 2.0));
        assert_eq!(
            (sheet.transmission().evaluate(300.0), sheet.transmission().evaluate(500.0)),
            (0.25, 0.81)
        );
    }

    #[test]
    fn sheets_that_are_wrong_are_refused_with_their_line() {
        let refusal = |from: &str, to: &str| {
            assert!(GOOD.contains(from));
            GlassSheet::parse(Path::new("x"), &GOOD.replace(from, to)).unwrap_err().to_string()
        };
        assert!(refusal("0.5", "1.5").contains("line 6: transmittance 1.5"));
        assert!(refusal("400, 0.5", "400, a").contains("line 6"));
        assert!(refusal("500, 0.9", "400, 0.9").contains("line 7: wavelengths must ascend"));
        assert!(refusal("sellmeier_b", "selmeier").contains("line 2: unknown entry"));
        assert!(refusal("= 500", "= 0").contains("line 5: a thickness of 0 mm"));
        assert!(refusal("valid_um = 0.3, 2\n", "").contains("valid_um is missing"));
        assert!(refusal("400, 0.5\n500, 0.9\n", "").contains("rows of the transmittance are missing"));
    }
}
