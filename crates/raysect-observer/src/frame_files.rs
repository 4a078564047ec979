//! Frames as files.

use std::collections::BTreeMap;
use std::path::Path;

use crate::file::{ExrAttribute, ExrLayer, NpyArray, NpyData, save_exr, save_npz};
use crate::{Frame, ObserverError};

impl Frame {
    fn check_samples(&self) -> Result<(), ObserverError> {
        if self.is_empty() || self.total_samples() == 0 {
            return Err(ObserverError::EmptyFrame(self.name().to_owned()));
        }
        Ok(())
    }

    fn sample_counts(&self) -> Vec<u64> {
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

    /// Writes the frame as an OpenEXR file with the layers `mean`, `error` and `samples` (32-bit numbers), or, if
    /// the name ends in `.npz`, as a NumPy archive in double precision.
    ///
    /// # Errors
    /// [`ObserverError::EmptyFrame`], [`ObserverError::File`].
    pub fn save(&self, path: impl AsRef<Path>) -> Result<(), ObserverError> {
        if path.as_ref().extension().is_some_and(|e| e.eq_ignore_ascii_case("npz")) {
            return self.save_npz(path);
        }
        let first = self.mean().iter().step_by(self.channels().len().max(1)).copied().collect();
        self.save_exr_showing(path, ExrLayer { name: String::new(), channels: vec![("Y".to_owned(), first)] })
    }
}
