//! Spectra as files.

use std::collections::BTreeMap;
use std::path::Path;

use raysect_optical::Slicing;
use raysect_optical::colour::{resample_ciexyz, xyz_to_linear_srgb};

use super::SpectralPipeline;
use super::output::has_ending;
use crate::file::{ExrAttribute, ExrLayer, FileError, NpyArray, NpyData, save_csv, save_exr, save_npz};
use crate::{Estimate, ObserverError, Pipeline};

impl<const POWER: bool> SpectralPipeline<POWER> {
    /// Writes what it has gathered, by the ending of the name: `.csv` as [`save_csv`](Self::save_csv), `.npz` as
    /// [`save_npz`](Self::save_npz), `.exr` as [`save_exr`](Self::save_exr), and, with the feature `plot`, `.svg` as
    /// a plot of the spectra of the first pixels, eight at most.
    ///
    /// # Errors
    /// [`ObserverError::EmptyFrame`], [`ObserverError::File`], also for any other ending.
    pub fn save(&self, path: impl AsRef<Path>) -> Result<(), ObserverError> {
        let path = path.as_ref();
        #[cfg(feature = "plot")]
        if has_ending(path, "svg") {
            let pixels: Vec<usize> = (0..self.frame.shape().pixels().min(8)).collect();
            return self.save_plot(path, &pixels);
        }
        match path {
            path if has_ending(path, "csv") => self.save_csv(path),
            path if has_ending(path, "npz") => self.save_npz(path),
            path if has_ending(path, "exr") => self.save_exr(path),
            _ => {
                let plot =
                    if cfg!(feature = "plot") { " or .svg" } else { ", or .svg with the feature 'plot'" };
                let what = format!("spectra are written as .csv, .npz, .exr{plot}");
                Err(FileError::Encode { path: path.to_owned(), what }.into())
            }
        }
    }

    /// Writes a table with a line for each bin of each pixel: row and column of the pixel (not for a single pixel),
    /// the wavelength, mean and standard error, with their units in the titles.
    ///
    /// # Errors
    /// [`ObserverError::EmptyFrame`], [`ObserverError::File`].
    pub fn save_csv(&self, path: impl AsRef<Path>) -> Result<(), ObserverError> {
        let wavelengths = self.gathered()?.wavelengths();
        let (shape, unit) = (self.frame.shape(), self.frame.unit());
        let place: &[&str] = if shape.pixels() > 1 { &["row", "column"] } else { &[] };
        let numbers = ["wavelength [nm]".to_owned(), format!("mean [{unit}]"), format!("error [{unit}]")];
        let titles: Vec<String> = place.iter().map(|&title| title.to_owned()).chain(numbers).collect();
        let mut rows = Vec::with_capacity(shape.pixels() * wavelengths.len());
        for pixel in 0..shape.pixels() {
            let place = [pixel / shape.columns(), pixel % shape.columns()].map(|number| number as f64);
            for (bin, &wavelength) in wavelengths.iter().enumerate() {
                let Estimate { value, error } = self.bin(pixel, bin);
                let mut row = if shape.pixels() > 1 { place.to_vec() } else { Vec::new() };
                row.extend([wavelength, value, error]);
                rows.push(row);
            }
        }
        Ok(save_csv(path, &titles, &rows)?)
    }

    /// Writes a NumPy archive: `<name>_mean` and `<name>_error` as arrays \[row, column, bin\], `total_mean`,
    /// `total_error` and `samples` as \[row, column\], `wavelengths` (the centres of the bins) and `bin_edges` [nm],
    /// `unit` and `total_unit`.
    ///
    /// # Errors
    /// [`ObserverError::EmptyFrame`], [`ObserverError::File`].
    pub fn save_npz(&self, path: impl AsRef<Path>) -> Result<(), ObserverError> {
        let slicing = self.gathered()?;
        let (shape, bins) = (self.frame.shape(), slicing.bins());
        let edge = |i: usize| slicing.min_wavelength() + slicing.bin_width() * i as f64;
        let numbers =
            |shape: &[usize], values| NpyArray { shape: shape.to_vec(), data: NpyData::F64(values) };
        let each = |of: fn(Estimate) -> f64| {
            let places = (0..shape.pixels()).flat_map(|pixel| (0..bins).map(move |bin| (pixel, bin)));
            places.map(|(pixel, bin)| of(self.bin(pixel, bin))).collect::<Vec<f64>>()
        };
        let totals = |of: fn(Estimate) -> f64| (0..shape.pixels()).map(|p| of(self.total(p))).collect();
        let (image, cube) = ([shape.rows(), shape.columns()], [shape.rows(), shape.columns(), bins]);
        let counts = NpyData::I64(self.frame.sample_counts().iter().map(|&n| n as i64).collect());
        let arrays = [
            (format!("{}_mean", self.frame.name()), numbers(&cube, each(|e| e.value))),
            (format!("{}_error", self.frame.name()), numbers(&cube, each(|e| e.error))),
            ("total_mean".to_owned(), numbers(&image, totals(|e| e.value))),
            ("total_error".to_owned(), numbers(&image, totals(|e| e.error))),
            ("samples".to_owned(), NpyArray { shape: image.to_vec(), data: counts }),
            ("wavelengths".to_owned(), numbers(&[bins], slicing.wavelengths())),
            ("bin_edges".to_owned(), numbers(&[bins + 1], (0..=bins).map(edge).collect())),
            ("unit".to_owned(), NpyArray::text(self.frame.unit())),
            ("total_unit".to_owned(), NpyArray::text(self.total_unit())),
        ];
        Ok(save_npz(path, &arrays)?)
    }

    /// Writes a spectral OpenEXR file (A. Fichet, R. Pacanowski, A. Wilkie, *An OpenEXR Layout for Spectral Images*,
    /// JCGT 10(3), 2021): a channel `S0.<wavelength>nm` for each bin, with a comma in the wavelength; linear sRGB
    /// in front for viewers; besides, the standard errors in the layer `error`, the totals in `total`, and the
    /// number of samples in `samples`.
    ///
    /// # Errors
    /// [`ObserverError::EmptyFrame`], [`ObserverError::File`].
    pub fn save_exr(&self, path: impl AsRef<Path>) -> Result<(), ObserverError> {
        let slicing = self.gathered()?;
        let (shape, pixels) = (self.frame.shape(), 0..self.frame.shape().pixels());
        let plane = |of: &dyn Fn(usize) -> f64| pixels.clone().map(of).collect::<Vec<f64>>();
        let spectral = |of: fn(Estimate) -> f64| -> Vec<(String, Vec<f64>)> {
            let named = slicing.wavelengths().into_iter().map(channel_name).enumerate();
            named.map(|(bin, name)| (name, plane(&|p| of(self.bin(p, bin))))).collect()
        };
        let total = |name: &str, of: fn(Estimate) -> f64| (name.to_owned(), plane(&|p| of(self.total(p))));
        let mut shown = self.linear_srgb(&slicing);
        shown.extend(spectral(|e| e.value));
        let layers = [
            ExrLayer { name: String::new(), channels: shown },
            ExrLayer { name: "error".to_owned(), channels: spectral(|e| e.error) },
            ExrLayer {
                name: "total".to_owned(),
                channels: vec![total("mean", |e| e.value), total("error", |e| e.error)],
            },
            ExrLayer {
                name: "samples".to_owned(),
                channels: vec![("N".to_owned(), plane(&|p| self.frame.samples(p) as f64))],
            },
        ];
        let text = |text: &str| ExrAttribute::Text(text.to_owned());
        let attributes = BTreeMap::from([
            ("spectralLayoutVersion".to_owned(), text("1.0")),
            // The convention names the unit without the wavelength.
            ("emissiveUnits".to_owned(), text(if POWER { "W" } else { "W.m^-2.sr^-1" })),
            ("raysect:unit".to_owned(), text(self.frame.unit())),
            ("raysect:bin_width_nm".to_owned(), ExrAttribute::Number(slicing.bin_width())),
        ]);
        Ok(save_exr(path, shape.columns(), shape.rows(), &layers, &attributes)?)
    }

    fn linear_srgb(&self, slicing: &Slicing) -> Vec<(String, Vec<f64>)> {
        let (curves, width) = (resample_ciexyz(slicing), slicing.bin_width());
        let colour = |pixel: usize| {
            let mut xyz = [0.0; 3];
            for (curve, value) in curves.iter().zip(self.spectrum(pixel)) {
                (0..3).for_each(|c| xyz[c] += curve[c] * value * width);
            }
            xyz_to_linear_srgb(xyz)
        };
        let colours: Vec<[f64; 3]> = (0..self.frame.shape().pixels()).map(colour).collect();
        let plane = |c: usize| colours.iter().map(|v| v[c]).collect();
        [("R", 0), ("G", 1), ("B", 2)].map(|(name, c)| (name.to_owned(), plane(c))).into()
    }
}

/// The channel of a wavelength [nm] by the convention: a point would begin a layer.
fn channel_name(wavelength: f64) -> String {
    format!("S0.{}nm", wavelength.to_string().replace('.', ","))
}
