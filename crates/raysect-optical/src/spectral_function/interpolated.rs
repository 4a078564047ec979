use std::path::Path;

use raysect_core::save::{SaveError, Saved, SceneWriter};

use super::SpectralFunction;
use crate::library::table;
use crate::{OpticalError, WavelengthUnit};

/// A table of values, linear between its wavelengths and constant beyond its ends.
///
/// ```
/// use raysect_optical::{InterpolatedSf, SpectralFunction};
/// let lamp = InterpolatedSf::new([400.0, 500.0, 600.0], [0.0, 8.0, 16.0])?;
/// assert_eq!(lamp.evaluate(450.0), 4.0);
/// assert_eq!(lamp.average(500.0, 700.0), 14.0);
/// # Ok::<(), raysect_optical::OpticalError>(())
/// ```
#[doc(alias = "InterpolatedSF")]
#[derive(Debug, Clone, PartialEq)]
pub struct InterpolatedSf {
    wavelengths: Vec<f64>,
    values: Vec<f64>,
    /// Integral from the first wavelength to each.
    integrals: Vec<f64>,
}

impl InterpolatedSf {
    /// From wavelengths [nm] in ascending order and the values there.
    ///
    /// # Errors
    /// [`OpticalError::TableShape`] for an empty table or different lengths, [`OpticalError::Table`] for the first
    /// entry that is not finite, not positive in wavelength, or not above its predecessor.
    pub fn new(wavelengths: impl Into<Vec<f64>>, values: impl Into<Vec<f64>>) -> Result<Self, OpticalError> {
        let (wavelengths, values) = (wavelengths.into(), values.into());
        if wavelengths.len() != values.len() || wavelengths.is_empty() {
            let what = if wavelengths.is_empty() { "it is empty" } else { "the lengths differ" };
            return Err(OpticalError::TableShape {
                wavelengths: wavelengths.len(),
                values: values.len(),
                what,
            });
        }
        for (index, (&wavelength, &value)) in wavelengths.iter().zip(&values).enumerate() {
            let wrong = |what| Err(OpticalError::Table { index, wavelength, value, what });
            if !(wavelength > 0.0 && wavelength.is_finite()) {
                return wrong("wavelengths must be positive and finite");
            }
            if !value.is_finite() {
                return wrong("values must be finite");
            }
            if index > 0 && wavelength <= wavelengths[index - 1] {
                return wrong("wavelengths must ascend without repetition");
            }
        }
        Ok(Self::of(wavelengths, values))
    }

    /// The integrals follow from wavelengths and values alone, whatever was done to get them.
    fn of(wavelengths: Vec<f64>, values: Vec<f64>) -> Self {
        let mut integrals = vec![0.0; values.len()];
        for i in 1..values.len() {
            let width = wavelengths[i] - wavelengths[i - 1];
            integrals[i] = integrals[i - 1] + 0.5 * width * (values[i] + values[i - 1]);
        }
        Self { wavelengths, values, integrals }
    }

    /// From a text file: two columns, wavelength [nm] and value, separated by a comma, semicolon or white space;
    /// lines that begin with `#` are comments.
    ///
    /// # Errors
    /// [`OpticalError::File`] if it cannot be read, [`OpticalError::Line`] for the first line that is wrong: not two
    /// numbers, or what [`new`](Self::new) refuses.
    pub fn from_csv(path: impl AsRef<Path>) -> Result<Self, OpticalError> {
        Self::from_csv_in(path, WavelengthUnit::Nanometre)
    }

    /// The same from a file whose wavelengths are in another unit.
    ///
    /// # Errors
    /// As [`from_csv`](Self::from_csv).
    pub fn from_csv_in(path: impl AsRef<Path>, unit: WavelengthUnit) -> Result<Self, OpticalError> {
        let path = path.as_ref();
        let text = std::fs::read_to_string(path)
            .map_err(|source| OpticalError::File { path: path.to_owned(), source })?;
        table::functions::<1>(path, &text, unit).map(|[function]| function)
    }

    /// The same table divided by its integral over its own range.
    ///
    /// # Errors
    /// [`OpticalError::TableShape`] if the integral is not positive.
    #[doc(alias = "normalise")]
    pub fn normalised(mut self) -> Result<Self, OpticalError> {
        let n = self.values.len();
        let total = self.integrals[n - 1];
        if total.is_nan() || total <= 0.0 {
            let what = "its integral must be positive to be normalised";
            return Err(OpticalError::TableShape { wavelengths: n, values: n, what });
        }
        self.values.iter_mut().for_each(|v| *v /= total);
        Ok(Self::of(self.wavelengths, self.values))
    }

    /// The same table with every value multiplied by a factor.
    pub fn scaled(mut self, factor: f64) -> Self {
        self.values.iter_mut().for_each(|v| *v *= factor);
        Self::of(self.wavelengths, self.values)
    }

    /// The wavelengths [nm].
    pub fn wavelengths(&self) -> &[f64] {
        &self.wavelengths
    }

    /// The values.
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// Integral from the first wavelength of the table to any other, negative below the first.
    fn primitive(&self, wavelength: f64) -> f64 {
        let (n, w) = (self.values.len(), &self.wavelengths);
        if wavelength <= w[0] {
            return (wavelength - w[0]) * self.values[0];
        }
        if wavelength >= w[n - 1] {
            return self.integrals[n - 1] + (wavelength - w[n - 1]) * self.values[n - 1];
        }
        let i = w.partition_point(|&x| x <= wavelength) - 1;
        self.integrals[i] + 0.5 * (wavelength - w[i]) * (self.values[i] + self.evaluate(wavelength))
    }
}

impl SpectralFunction for InterpolatedSf {
    fn evaluate(&self, wavelength: f64) -> f64 {
        let (n, w, v) = (self.values.len(), &self.wavelengths, &self.values);
        if wavelength <= w[0] {
            return v[0];
        }
        if wavelength >= w[n - 1] {
            return v[n - 1];
        }
        let i = w.partition_point(|&x| x <= wavelength) - 1;
        let t = (wavelength - w[i]) / (w[i + 1] - w[i]);
        v[i] * (1.0 - t) + v[i + 1] * t
    }

    fn integrate(&self, min: f64, max: f64) -> f64 {
        // Within one cell the difference of two long integrals would lose digits that the trapezium has.
        let cell = |x: f64| self.wavelengths.partition_point(|&w| w <= x);
        if cell(min) == cell(max) {
            return 0.5 * (max - min) * (self.evaluate(min) + self.evaluate(max));
        }
        self.primitive(max) - self.primitive(min)
    }

    fn is_constant(&self) -> bool {
        self.values.windows(2).all(|v| v[0] == v[1])
    }
    fn knots(&self) -> &[f64] {
        &self.wavelengths
    }

    fn resolution(&self) -> f64 {
        self.wavelengths.windows(2).map(|w| w[1] - w[0]).fold(f64::INFINITY, f64::min)
    }

    fn save(&self, _: &mut SceneWriter) -> Result<Saved, SaveError> {
        let saved = Saved::new("InterpolatedSf").numbers("wavelengths", &self.wavelengths);
        Ok(saved.numbers("values", &self.values))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn errors_name_the_entry() {
        let message = |w: &[f64], v: &[f64]| InterpolatedSf::new(w, v).unwrap_err().to_string();
        assert!(message(&[400.0, 400.0], &[1.0, 2.0]).contains("entry 1 (400 nm, 2)"));
        assert!(message(&[400.0, 500.0], &[1.0, f64::NAN]).contains("entry 1"));
        assert!(message(&[400.0, 500.0], &[1.0]).contains("lengths differ"));
        assert!(InterpolatedSf::new([0.0], [1.0]).is_err() && InterpolatedSf::new([], []).is_err());
    }

    #[test]
    fn files_are_read_in_their_unit_and_their_faults_have_a_line() {
        let path = std::env::temp_dir().join(format!("raysect-interpolated-{}.csv", std::process::id()));
        let read = |text: &str, unit| {
            std::fs::write(&path, text).unwrap();
            InterpolatedSf::from_csv_in(&path, unit)
        };
        let expected = InterpolatedSf::new([400.0, 546.1], [0.25, 0.5]).unwrap();
        assert_eq!(read("# nm\n400, 0.25\n546.1, 0.5\n", WavelengthUnit::Nanometre).unwrap(), expected);
        assert_eq!(read("0.4 0.25\n0.5461 0.5\n", WavelengthUnit::Micrometre).unwrap(), expected);
        assert_eq!(read("4000;0.25\n5461;0.5\n", WavelengthUnit::Angstrom).unwrap(), expected);
        let message = |text| read(text, WavelengthUnit::Micrometre).unwrap_err().to_string();
        let repeated = message("# um\n0.4, 1\n\n0.4, 2\n");
        assert!(
            repeated.contains("csv, line 4: wavelengths must ascend") && repeated.contains("400 nm"),
            "{repeated}"
        );
        assert!(message("0.4, 1\n0.5, nan\n").contains("line 2: values must be finite"));
        assert!(message("0.4, 1\n0.5\n").contains("line 2: 1 fields"));
        assert!(message("# nothing\n").contains("no rows"));
        std::fs::remove_file(&path).unwrap();
        assert!(message_of_missing(&path).contains("raysect-interpolated"));
    }

    fn message_of_missing(path: &Path) -> String {
        InterpolatedSf::from_csv(path).unwrap_err().to_string()
    }

    #[test]
    fn a_table_is_its_wavelengths_and_values_whatever_was_done_to_it() {
        let table = InterpolatedSf::new([400.0, 511.0, 633.0, 700.0], [0.1, 0.7, 0.3, 0.9]).unwrap();
        for changed in [table.clone().scaled(1.0 / 87.1971), table.normalised().unwrap()] {
            let again = InterpolatedSf::new(changed.wavelengths(), changed.values()).unwrap();
            assert_eq!(changed, again);
        }
    }

    #[test]
    fn integrals_are_exact_at_any_bin_width() {
        let line = InterpolatedSf::new([499.999, 500.0, 500.001], [0.0, 1000.0, 0.0]).unwrap();
        for bins in [1, 7, 1000] {
            let width = 365.0 / bins as f64;
            let total: f64 = line.sample(375.0, 740.0, bins).iter().map(|s| s * width).sum();
            assert!((total - 1.0).abs() < 1e-9, "{bins}");
        }
        let flat = InterpolatedSf::new([500.0], [3.0]).unwrap();
        assert_eq!((flat.integrate(100.0, 900.0), flat.average(1.0, 2.0)), (2400.0, 3.0));
        assert!((line.normalised().unwrap().integrate(400.0, 600.0) - 1.0).abs() < 1e-12);
    }
}
