//! Frames as files.

use std::collections::BTreeMap;
use std::path::Path;

use crate::file::{ExrAttribute, ExrLayer, NpyArray, NpyData, save_csv, save_exr, save_npz, save_png_rgb8};
use crate::{Frame, MonoDisplay, ObserverError};

/// Which number of each pixel a picture shows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Shown {
    /// The mean.
    Mean,
    /// Its standard error, in the unit of the mean; unknown after one sample.
    Error,
    /// The standard error relative to the mean; unknown where the mean is zero.
    RelativeError,
}

impl Frame {
    pub(crate) fn check_samples(&self) -> Result<(), ObserverError> {
        if self.is_empty() || self.total_samples() == 0 {
            return Err(ObserverError::EmptyFrame(self.name().to_owned()));
        }
        Ok(())
    }

    pub(crate) fn sample_counts(&self) -> Vec<u64> {
        (0..self.shape().pixels()).map(|p| self.samples(p)).collect()
    }

    /// Writes `<name>_mean`, `<name>_error` and `samples`, each as an array \[row, column, channel\] of a NumPy
    /// archive, and the names of the channels.
    ///
    /// # Errors
    /// [`ObserverError::EmptyFrame`], [`ObserverError::File`].
    pub fn save_npz(&self, path: impl AsRef<Path>) -> Result<(), ObserverError> {
        self.check_samples()?;
        let channels = self.channels().len();
        let shape = vec![self.shape().rows(), self.shape().columns(), channels];
        let counts = self.sample_counts().iter().flat_map(|&n| vec![n as i64; channels]).collect();
        let array = |data| NpyArray { shape: shape.clone(), data };
        let names = NpyArray { shape: vec![channels], data: NpyData::Text(self.channels().to_vec()) };
        let arrays = [
            (format!("{}_mean", self.name()), array(NpyData::F64(self.mean()))),
            (format!("{}_error", self.name()), array(NpyData::F64(self.error()))),
            ("samples".to_owned(), array(NpyData::I64(counts))),
            ("channels".to_owned(), names),
            ("unit".to_owned(), NpyArray::text(self.unit())),
        ];
        Ok(save_npz(path, &arrays)?)
    }

    /// Writes the layers `mean`, `error` and `samples` of an OpenEXR file, with `shown` as the layer that viewers
    /// show first.
    pub(crate) fn save_exr_showing(
        &self,
        path: impl AsRef<Path>,
        shown: ExrLayer,
    ) -> Result<(), ObserverError> {
        self.check_samples()?;
        let channels = self.channels().len();
        let split = |values: Vec<f64>, name: &str| ExrLayer {
            name: name.to_owned(),
            channels: (0..channels)
                .map(|c| {
                    (self.channels()[c].clone(), values.iter().skip(c).step_by(channels).copied().collect())
                })
                .collect(),
        };
        let counts = self.sample_counts().iter().map(|&n| n as f64).collect();
        let layers = [
            shown,
            split(self.mean(), "mean"),
            split(self.error(), "error"),
            ExrLayer { name: "samples".to_owned(), channels: vec![("N".to_owned(), counts)] },
        ];
        let unit = ExrAttribute::Text(self.unit().to_owned());
        let attributes = BTreeMap::from([("raysect:unit".to_owned(), unit)]);
        Ok(save_exr(path, self.shape().columns(), self.shape().rows(), &layers, &attributes)?)
    }

    /// Mean, error or relative error of a channel, a number a pixel, row by row; NaN where it is not known.
    pub fn values(&self, channel: usize, shown: Shown) -> Vec<f64> {
        let known = |value: f64| if value.is_finite() { value } else { f64::NAN };
        let of = |pixel: usize| {
            let estimate = self.pixel(pixel, channel);
            match shown {
                Shown::Mean => estimate.value,
                Shown::Error => known(estimate.error),
                Shown::RelativeError => known(estimate.relative_error()),
            }
        };
        (0..self.shape().pixels()).map(of).collect()
    }

    /// Writes a PNG picture of a channel: its means, or a map of its errors. Pixels in which they are not known are
    /// middle grey.
    ///
    /// # Errors
    /// [`ObserverError::EmptyFrame`], [`ObserverError::File`].
    #[doc(alias = "display")]
    pub fn save_map(
        &self,
        path: impl AsRef<Path>,
        channel: usize,
        shown: Shown,
        display: &MonoDisplay,
    ) -> Result<(), ObserverError> {
        self.check_samples()?;
        let picture = display.to_srgb(&self.values(channel, shown));
        Ok(save_png_rgb8(path, self.shape().columns(), self.shape().rows(), &picture)?)
    }

    /// Writes a table with a line for each pixel: its row and column, then mean and standard error of each channel,
    /// with their unit in the title, and the number of samples.
    ///
    /// # Errors
    /// [`ObserverError::EmptyFrame`], [`ObserverError::File`].
    pub fn save_csv(&self, path: impl AsRef<Path>) -> Result<(), ObserverError> {
        self.check_samples()?;
        let mut titles = vec!["row".to_owned(), "column".to_owned()];
        for channel in self.channels() {
            titles.push(format!("{channel} [{}]", self.unit()));
            titles.push(format!("error of {channel} [{}]", self.unit()));
        }
        titles.push("samples".to_owned());
        let columns = self.shape().columns();
        let line = |pixel: usize| {
            let place = [(pixel / columns) as f64, (pixel % columns) as f64];
            let estimates = (0..self.channels().len()).map(|channel| self.pixel(pixel, channel));
            let numbers = estimates.flat_map(|estimate| [estimate.value, estimate.error]);
            place.into_iter().chain(numbers).chain([self.samples(pixel) as f64]).collect()
        };
        let rows: Vec<Vec<f64>> = (0..self.shape().pixels()).map(line).collect();
        Ok(save_csv(path, &titles, &rows)?)
    }

    /// Writes the frame as an OpenEXR file with the layers `mean`, `error` and `samples` (32-bit numbers), or, if
    /// the name ends in `.npz`, as a NumPy archive in double precision, or, if it ends in `.csv`, as a table.
    ///
    /// # Errors
    /// [`ObserverError::EmptyFrame`], [`ObserverError::File`].
    pub fn save(&self, path: impl AsRef<Path>) -> Result<(), ObserverError> {
        let has_ending = |letters| path.as_ref().extension().is_some_and(|e| e.eq_ignore_ascii_case(letters));
        if has_ending("npz") {
            return self.save_npz(path);
        }
        if has_ending("csv") {
            return self.save_csv(path);
        }
        let first = self.mean().iter().step_by(self.channels().len().max(1)).copied().collect();
        self.save_exr_showing(path, ExrLayer { name: String::new(), channels: vec![("Y".to_owned(), first)] })
    }
}
