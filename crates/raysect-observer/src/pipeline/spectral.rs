use std::path::PathBuf;

use raysect_core::save::{Entry, MakeError, SaveError, Saved, SceneWriter, Storable};
use raysect_optical::{Slicing, Spectrum};

use super::output::{load_name, load_preview, save_preview};
use super::{Measurement, Pipeline};
use crate::{Estimate, Frame, FrameShape, ObserverError};

/// The spectrum of each pixel, a channel a bin: power [W/nm] or radiance [W/m²/sr/nm].
///
/// The first channel of its frame, `total`, is the sum over all bins times their width [W] or [W/m²/sr], with an
/// error of its own: that of a sum over the bins cannot be told from theirs, since the bins of a sample go up and
/// down together. The bins follow in ascending order of wavelength; [`spectrum`](Self::spectrum),
/// [`errors`](Self::errors) and [`total`](Self::total) spare counting.
///
/// ```
/// use raysect_observer::{PinholeCamera, SpectralRadiancePipeline};
/// use raysect_optical::{UniformSurfaceEmitter, WithMaterial, World};
/// use raysect_primitive::Sphere;
///
/// let mut world = World::new();
/// world.add(Sphere::new(10.0)?.material(UniformSurfaceEmitter::new(1.0, 1.0)))?;
/// let camera = PinholeCamera::new((4, 4), 45.0)?.wavelengths(400.0, 500.0).spectral_bins(5).pixel_samples(3);
/// let mut radiance = SpectralRadiancePipeline::new();
/// camera.observe(&world, &mut radiance)?;
/// assert_eq!(radiance.wavelengths(), [410.0, 430.0, 450.0, 470.0, 490.0]);
/// assert_eq!(radiance.spectrum(7), [1.0; 5]);
/// assert_eq!(radiance.to_spectrum(7)?.total(), 100.0);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct SpectralPipeline<const POWER: bool> {
    pub(super) frame: Frame,
    /// The bins of what it has gathered.
    pub(super) slicing: Option<Slicing>,
    preview: Option<PathBuf>,
}

/// Spectral power [W/nm], étendue × spectral radiance; see [`SpectralPipeline`].
pub type SpectralPowerPipeline = SpectralPipeline<true>;
/// [`SpectralPowerPipeline`] by Raysect's name for a single pixel.
pub type SpectralPowerPipeline0D = SpectralPowerPipeline;
/// [`SpectralPowerPipeline`] by Raysect's name for a line of pixels.
pub type SpectralPowerPipeline1D = SpectralPowerPipeline;
/// [`SpectralPowerPipeline`] by Raysect's name for a picture.
pub type SpectralPowerPipeline2D = SpectralPowerPipeline;

/// Spectral radiance [W/m²/sr/nm]; see [`SpectralPipeline`].
pub type SpectralRadiancePipeline = SpectralPipeline<false>;
/// [`SpectralRadiancePipeline`] by Raysect's name for a single pixel.
pub type SpectralRadiancePipeline0D = SpectralRadiancePipeline;
/// [`SpectralRadiancePipeline`] by Raysect's name for a line of pixels.
pub type SpectralRadiancePipeline1D = SpectralRadiancePipeline;
/// [`SpectralRadiancePipeline`] by Raysect's name for a picture.
pub type SpectralRadiancePipeline2D = SpectralRadiancePipeline;

impl<const POWER: bool> Default for SpectralPipeline<POWER> {
    fn default() -> Self {
        Self::new()
    }
}

impl<const POWER: bool> SpectralPipeline<POWER> {
    /// Channels before those of the bins.
    pub(super) const TOTALS: usize = 1;

    /// With the bins of the observer that it will be lent to.
    pub fn new() -> Self {
        let (name, unit) =
            if POWER { ("spectral_power", "W/nm") } else { ("spectral_radiance", "W/m²/sr/nm") };
        Self { frame: Frame::new(name, unit), slicing: None, preview: None }
    }

    /// With a name of its own for reports, files and statepoints: by it pipelines of one kind are told apart.
    #[doc(alias = "name")]
    pub fn named(mut self, name: impl Into<String>) -> Self {
        self.frame.rename(name.into());
        self
    }

    /// Rewrites a file after every pass, whole at any moment, for a viewer that follows it; what kind of file is
    /// chosen as by [`save`](Self::save).
    #[doc(alias = "display_progress")]
    pub fn preview(mut self, path: impl Into<PathBuf>) -> Self {
        self.preview = Some(path.into());
        self
    }

    /// What it has gathered: the total, then the bins.
    pub fn frame(&self) -> &Frame {
        &self.frame
    }

    /// Range and number of its bins; none before the first observation.
    pub fn slicing(&self) -> Option<&Slicing> {
        self.slicing.as_ref()
    }

    /// Centre of each bin [nm]; none before the first observation.
    pub fn wavelengths(&self) -> Vec<f64> {
        self.slicing.map_or_else(Vec::new, |slicing| slicing.wavelengths())
    }

    /// The mean in a bin of a pixel, with its standard error, in the unit of its frame.
    ///
    /// # Panics
    /// If there is no such pixel or bin.
    pub fn bin(&self, pixel: usize, bin: usize) -> Estimate {
        self.frame.pixel(pixel, Self::TOTALS + bin)
    }

    /// The mean in each bin of a pixel.
    ///
    /// # Panics
    /// If there is no such pixel.
    pub fn spectrum(&self, pixel: usize) -> Vec<f64> {
        (0..self.bins()).map(|bin| self.bin(pixel, bin).value).collect()
    }

    /// The standard error in each bin of a pixel; infinite after one sample.
    ///
    /// # Panics
    /// If there is no such pixel.
    pub fn errors(&self, pixel: usize) -> Vec<f64> {
        (0..self.bins()).map(|bin| self.bin(pixel, bin).error).collect()
    }

    /// The integral over the wavelength of a pixel [W] or [W/m²/sr], with an error that was measured sample by
    /// sample.
    ///
    /// # Panics
    /// If there is no such pixel.
    pub fn total(&self, pixel: usize) -> Estimate {
        self.frame.pixel(pixel, 0)
    }

    /// The means of a pixel as a spectrum.
    ///
    /// # Errors
    /// [`ObserverError::EmptyFrame`] before the first observation.
    ///
    /// # Panics
    /// If there is no such pixel.
    pub fn to_spectrum(&self, pixel: usize) -> Result<Spectrum, ObserverError> {
        let slicing = self.gathered()?;
        let (min, max) = (slicing.min_wavelength(), slicing.max_wavelength());
        Ok(Spectrum::from_samples(min, max, self.spectrum(pixel))?)
    }

    /// The bins, if there are samples.
    pub(crate) fn gathered(&self) -> Result<Slicing, ObserverError> {
        self.frame.check_samples()?;
        self.slicing.ok_or_else(|| ObserverError::EmptyFrame(self.frame.name().to_owned()))
    }

    fn bins(&self) -> usize {
        if self.frame.is_empty() { 0 } else { self.frame.channels().len() - Self::TOTALS }
    }
}

impl<const POWER: bool> Pipeline for SpectralPipeline<POWER> {
    fn channels(&self, slicing: &Slicing) -> Vec<String> {
        let bins = slicing.wavelengths().into_iter().map(|wavelength| format!("{wavelength} nm"));
        std::iter::once("total".to_owned()).chain(bins).collect()
    }

    fn begin(&mut self, _: FrameShape, slicing: &Slicing) {
        self.slicing = Some(*slicing);
    }

    fn measure(&self, sample: &Measurement<'_>, out: &mut [f64]) {
        let factor = if POWER { sample.etendue } else { 1.0 };
        let first = Self::TOTALS + sample.slice.offset;
        let mut sum = 0.0;
        for (out, radiance) in out[first..].iter_mut().zip(sample.radiance) {
            *out = factor * radiance;
            sum += radiance;
        }
        out[0] += factor * sum * sample.slice.bin_width();
    }

    fn needs_etendue(&self) -> bool {
        POWER
    }

    fn frame(&self) -> &Frame {
        &self.frame
    }

    fn frame_mut(&mut self) -> &mut Frame {
        &mut self.frame
    }

    fn total_unit(&self) -> &str {
        if POWER { "W" } else { "W/m²/sr" }
    }

    fn pass_finished(&mut self) -> Result<(), ObserverError> {
        self.preview.as_ref().map_or(Ok(()), |path| self.save(path))
    }
}

impl<const POWER: bool> Storable for SpectralPipeline<POWER> {
    const KIND: &'static str = if POWER { "SpectralPowerPipeline" } else { "SpectralRadiancePipeline" };

    fn save(&self, saved: Saved, _: &mut SceneWriter) -> Result<Saved, SaveError> {
        save_preview(self.preview.as_deref(), saved.text("name", self.frame.name()))
    }

    fn load(entry: &Entry<'_>) -> Result<Self, MakeError> {
        let mut pipeline = Self { preview: load_preview(entry)?, ..Self::new() };
        load_name(&mut pipeline.frame, entry)?;
        Ok(pipeline)
    }
}

#[cfg(test)]
#[path = "spectral_tests.rs"]
mod tests;
