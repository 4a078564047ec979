//! Frames and spectra as plots.

use std::path::Path;

use super::{ImagePlot, LinePlot};
use crate::{Frame, MonoDisplay, ObserverError, Shown, SpectralPipeline};

impl Frame {
    /// Writes a channel as a picture with a colour bar, SVG: its means, or a map of its errors.
    ///
    /// # Errors
    /// [`ObserverError::EmptyFrame`], [`ObserverError::File`].
    pub fn save_plot(
        &self,
        path: impl AsRef<Path>,
        channel: usize,
        shown: Shown,
        display: &MonoDisplay,
    ) -> Result<(), ObserverError> {
        self.check_samples()?;
        let (name, unit) = (&self.channels()[channel], self.unit());
        let (title, label) = match shown {
            Shown::Mean => (name.clone(), format!("{name} [{unit}]")),
            Shown::Error => (format!("Standard error of {name}"), format!("error [{unit}]")),
            Shown::RelativeError => (format!("Relative error of {name}"), "relative error".to_owned()),
        };
        let size = (self.shape().columns(), self.shape().rows());
        ImagePlot::new(title, label, size, self.values(channel, shown), *display)?.save(path)
    }
}

impl<const POWER: bool> SpectralPipeline<POWER> {
    /// The spectra of some pixels with bands of ± one standard error, over all of the bins: from the lower edge of the first
    /// to the upper edge of the last.
    ///
    /// # Errors
    /// [`ObserverError::EmptyFrame`] before the first observation.
    ///
    /// # Panics
    /// If there is no such pixel.
    #[doc(alias = "display_pixel")]
    pub fn plot(&self, pixels: &[usize]) -> Result<LinePlot, ObserverError> {
        let (slicing, columns) = (self.gathered()?, self.frame().shape().columns());
        let quantity = if POWER { "spectral power" } else { "spectral radiance" };
        let place = |pixel: usize| match self.frame().shape() {
            crate::FrameShape::Image { .. } => format!("row {}, column {}", pixel / columns, pixel % columns),
            _ => format!("pixel {pixel}"),
        };
        let title = match pixels {
            [pixel] if self.frame().shape().pixels() > 1 => format!("Spectrum of {}", place(*pixel)),
            _ => "Spectrum".to_owned(),
        };
        let label = format!("{quantity} [{}]", self.frame().unit());
        let wavelengths = slicing.wavelengths();
        let edges = (slicing.min_wavelength(), slicing.max_wavelength());
        let plot = LinePlot::new(title, "wavelength [nm]", label).x_range(edges.0, edges.1);
        Ok(pixels.iter().fold(plot, |plot, &pixel| {
            plot.curve(place(pixel), &wavelengths, &self.spectrum(pixel), Some(&self.errors(pixel)))
        }))
    }

    /// Writes the spectra of some pixels with bands of ± one standard error, SVG.
    ///
    /// # Errors
    /// [`ObserverError::EmptyFrame`], [`ObserverError::File`].
    ///
    /// # Panics
    /// If there is no such pixel.
    pub fn save_plot(&self, path: impl AsRef<Path>, pixels: &[usize]) -> Result<(), ObserverError> {
        self.plot(pixels)?.save(path)
    }
}
