use std::path::PathBuf;

use raysect_core::CoreError;
use raysect_math::MathError;
use thiserror::Error;

/// What can go wrong with spectra, materials and paths.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum OpticalError {
    /// The scene or a ray is wrong.
    #[error(transparent)]
    Core(#[from] CoreError),
    /// A parameter lies outside its range.
    #[error(transparent)]
    Math(#[from] MathError),
    /// A table of wavelengths and values is not usable.
    #[error("spectral table, entry {index} ({wavelength} nm, {value}): {what}")]
    Table {
        /// Number of the entry, counted from 0.
        index: usize,
        /// Its wavelength [nm].
        wavelength: f64,
        /// Its value.
        value: f64,
        /// What is wrong.
        what: &'static str,
    },
    /// A table has too few entries or columns of different lengths.
    #[error("a spectral table of {wavelengths} wavelengths and {values} values: {what}")]
    TableShape {
        /// How many wavelengths.
        wavelengths: usize,
        /// How many values.
        values: usize,
        /// What is wrong.
        what: &'static str,
    },
    /// A file of data cannot be read.
    #[error("{}: {source}", path.display())]
    File {
        /// The file.
        path: PathBuf,
        /// Why.
        source: std::io::Error,
    },
    /// A line of a data file is not what it should be.
    #[error("{}, line {line}: {what}", path.display())]
    Line {
        /// The file, or the name of the built-in table.
        path: PathBuf,
        /// Line, counted from 1.
        line: usize,
        /// What is wrong.
        what: String,
    },
    /// The wavelength range or its division is impossible.
    #[error("{bins} bins in {slices} slices over {min} … {max} nm: {what}")]
    Slicing {
        /// Number of bins.
        bins: usize,
        /// Number of slices.
        slices: usize,
        /// Lower limit [nm].
        min: f64,
        /// Upper limit [nm].
        max: f64,
        /// What is wrong.
        what: &'static str,
    },
    /// A refractive index that no medium has.
    #[error(
        "the refractive index of {material} is {value} between {min} and {max} nm: it must be positive and finite there"
    )]
    Index {
        /// The material.
        material: String,
        /// The index found.
        value: f64,
        /// Lower end of the bin [nm].
        min: f64,
        /// Upper end of the bin [nm].
        max: f64,
    },
    /// A material that fills a volume on a shape that has none.
    #[error(
        "{material} fills a volume, but {shape} encloses none: give the shape a thickness, or a surface material"
    )]
    NoVolume {
        /// The material.
        material: String,
        /// The shape.
        shape: String,
    },
    /// A sum or blend of materials that contradicts itself.
    #[error("a material made of two: {what}")]
    Modifier {
        /// What is wrong.
        what: &'static str,
    },
    /// Something that the library does not have.
    #[error("no {what} '{name}' in the library; it has {known}")]
    Unknown {
        /// What was looked for: a Schott glass, a metal, a coloured spectrum.
        what: &'static str,
        /// The name that was asked for.
        name: String,
        /// The names there are.
        known: String,
    },
    /// Spectra of different ranges or bins, which cannot be combined.
    #[error(
        "a spectrum of {bins} bins over {min} … {max} nm and one of {other_bins} bins over {other_min} … {other_max} nm \
         cannot be combined"
    )]
    Incompatible {
        /// Bins of the first.
        bins: usize,
        /// Lower end of the first [nm].
        min: f64,
        /// Upper end of the first [nm].
        max: f64,
        /// Bins of the second.
        other_bins: usize,
        /// Lower end of the second [nm].
        other_min: f64,
        /// Upper end of the second [nm].
        other_max: f64,
    },
    /// A number of samples that differs from the number of bins.
    #[error("{samples} samples do not belong to {bins} bins")]
    SampleCount {
        /// How many samples.
        samples: usize,
        /// How many bins.
        bins: usize,
    },
}

impl OpticalError {
    pub(crate) fn unknown(what: &'static str, name: &str, known: impl Iterator<Item = &'static str>) -> Self {
        Self::Unknown { what, name: name.to_owned(), known: known.collect::<Vec<_>>().join(", ") }
    }
}
