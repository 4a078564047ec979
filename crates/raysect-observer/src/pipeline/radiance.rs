use raysect_core::save::{Entry, MakeError, SaveError, Saved, SceneWriter, Storable};
use raysect_optical::{Slicing, SpectralTable};

use super::power::{integrate, load_filter, save_filter};
use super::{Measurement, Pipeline};
use crate::Frame;

/// The radiance of each pixel [W/m²/sr], through a filter, integrated over the wavelength.
#[derive(Debug)]
pub struct RadiancePipeline {
    filter: Option<SpectralTable>,
    frame: Frame,
}

/// [`RadiancePipeline`] for pictures, by Raysect's name.
pub type RadiancePipeline2D = RadiancePipeline;

impl Default for RadiancePipeline {
    fn default() -> Self {
        Self::new()
    }
}

impl RadiancePipeline {
    /// Without filter.
    pub fn new() -> Self {
        Self { filter: None, frame: Frame::new("radiance", "W/m²/sr") }
    }

    /// Through a filter of a transmission that depends on the wavelength.
    pub fn filter(self, filter: impl Into<SpectralTable>) -> Self {
        Self { filter: Some(filter.into()), ..self }
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
}

impl Storable for RadiancePipeline {
    const KIND: &'static str = "RadiancePipeline";

    fn save(&self, saved: Saved, writer: &mut SceneWriter) -> Result<Saved, SaveError> {
        save_filter(self.filter.as_ref(), saved, writer)
    }

    fn load(entry: &Entry<'_>) -> Result<Self, MakeError> {
        Ok(Self { filter: load_filter(entry)?, ..Self::new() })
    }
}
