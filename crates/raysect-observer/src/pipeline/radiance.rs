use std::path::{Path, PathBuf};

use raysect_core::save::{Entry, MakeError, SaveError, Saved, SceneWriter, Storable};
use raysect_optical::{Slicing, SpectralTable};

use super::output::{Output, load_name};
use super::power::{integrate, load_filter, save_filter};
use super::{Measurement, Pipeline};
use crate::{Frame, MonoDisplay, ObserverError};

/// The radiance of each pixel [W/m²/sr], through a filter, integrated over the wavelength.
///
/// It takes the shape of the sensor: the same pipeline serves a single pixel, a line, and a picture.
#[derive(Debug)]
pub struct RadiancePipeline {
    filter: Option<SpectralTable>,
    frame: Frame,
    output: Output,
}

/// [`RadiancePipeline`] by Raysect's name for a single pixel.
pub type RadiancePipeline0D = RadiancePipeline;

/// [`RadiancePipeline`] by Raysect's name for a line of pixels.
pub type RadiancePipeline1D = RadiancePipeline;

/// [`RadiancePipeline`] by Raysect's name for a picture.
pub type RadiancePipeline2D = RadiancePipeline;

impl Default for RadiancePipeline {
    fn default() -> Self {
        Self::new()
    }
}

impl RadiancePipeline {
    /// Without filter.
    pub fn new() -> Self {
        Self { filter: None, frame: Frame::new("radiance", "W/m²/sr"), output: Output::default() }
    }

    /// Through a filter of a transmission that depends on the wavelength.
    pub fn filter(self, filter: impl Into<SpectralTable>) -> Self {
        Self { filter: Some(filter.into()), ..self }
    }

    /// With a name of its own for reports, files and statepoints: by it pipelines of one kind are told apart.
    #[doc(alias = "name")]
    pub fn named(mut self, name: impl Into<String>) -> Self {
        self.frame.rename(name.into());
        self
    }

    /// With other brightness and colours of its pictures.
    pub fn display(mut self, display: MonoDisplay) -> Self {
        self.output.display = display;
        self
    }

    /// Rewrites a file after every pass, whole at any moment, for a viewer that follows it; what kind of file is
    /// chosen as by [`save`](Self::save).
    #[doc(alias = "display_progress")]
    pub fn preview(mut self, path: impl Into<PathBuf>) -> Self {
        self.output.preview = Some(path.into());
        self
    }

    /// Writes what it has gathered: a picture for a name that ends in `.png`, otherwise as [`Frame::save`].
    ///
    /// # Errors
    /// [`ObserverError::EmptyFrame`], [`ObserverError::File`].
    pub fn save(&self, path: impl AsRef<Path>) -> Result<(), ObserverError> {
        self.output.save(&self.frame, path.as_ref())
    }

    /// What it has gathered.
    pub fn frame(&self) -> &Frame {
        &self.frame
    }
}

impl Pipeline for RadiancePipeline {
    fn channels(&self, _: &Slicing) -> Vec<String> {
        vec!["radiance".to_owned()]
    }

    fn measure(&self, sample: &Measurement<'_>, out: &mut [f64]) {
        out[0] += integrate(sample, self.filter.as_ref());
    }

    fn frame(&self) -> &Frame {
        &self.frame
    }

    fn frame_mut(&mut self) -> &mut Frame {
        &mut self.frame
    }

    fn pass_finished(&mut self) -> Result<(), ObserverError> {
        self.output.rewrite(&self.frame)
    }
}

impl Storable for RadiancePipeline {
    const KIND: &'static str = "RadiancePipeline";

    fn save(&self, saved: Saved, writer: &mut SceneWriter) -> Result<Saved, SaveError> {
        self.output.save_settings(&self.frame, save_filter(self.filter.as_ref(), saved, writer)?)
    }

    fn load(entry: &Entry<'_>) -> Result<Self, MakeError> {
        let output = Output::load_settings(entry)?;
        let mut pipeline = Self { filter: load_filter(entry)?, output, ..Self::new() };
        load_name(&mut pipeline.frame, entry)?;
        Ok(pipeline)
    }
}
