use raysect_core::save::{Entry, MakeError, SaveError, Saved, SceneWriter, Storable};
use raysect_optical::{OpticalEntry, Slicing, SpectralTable};

use super::{Measurement, Pipeline};
use crate::Frame;

/// The power of each pixel [W]: étendue × radiance, through a filter, integrated over the wavelength.
#[derive(Debug)]
pub struct PowerPipeline {
    filter: Option<SpectralTable>,
    frame: Frame,
}

/// [`PowerPipeline`] for pictures, by Raysect's name.
pub type PowerPipeline2D = PowerPipeline;

impl Default for PowerPipeline {
    fn default() -> Self {
        Self::new()
    }
}

impl PowerPipeline {
    /// Without filter.
    pub fn new() -> Self {
        Self { filter: None, frame: Frame::new("power", "W") }
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

/// ∫ L f dλ over a slice.
pub(super) fn integrate(sample: &Measurement<'_>, filter: Option<&SpectralTable>) -> f64 {
    let sum = match filter {
        None => sample.radiance.iter().sum::<f64>(),
        Some(filter) => sample.radiance.iter().zip(sample.slice.table(filter)).map(|(l, f)| l * f).sum(),
    };
    sum * sample.slice.bin_width()
}

/// A filter as a field, if there is one.
pub(super) fn save_filter(
    filter: Option<&SpectralTable>,
    saved: Saved,
    writer: &mut SceneWriter,
) -> Result<Saved, SaveError> {
    match filter {
        Some(filter) => Ok(saved.reference("filter", writer.object(filter)?)),
        None => Ok(saved),
    }
}

pub(super) fn load_filter(entry: &Entry<'_>) -> Result<Option<SpectralTable>, SaveError> {
    entry.has("filter").then(|| entry.function("filter")).transpose()
}

impl Pipeline for PowerPipeline {
    fn channels(&self, _: &Slicing) -> Vec<String> {
        vec!["power".to_owned()]
    }

    fn measure(&self, sample: &Measurement<'_>, out: &mut [f64]) {
        out[0] += sample.etendue * integrate(sample, self.filter.as_ref());
    }

    fn needs_etendue(&self) -> bool {
        true
    }

    fn frame(&self) -> &Frame {
        &self.frame
    }

    fn frame_mut(&mut self) -> &mut Frame {
        &mut self.frame
    }
}

impl Storable for PowerPipeline {
    const KIND: &'static str = "PowerPipeline";

    fn save(&self, saved: Saved, writer: &mut SceneWriter) -> Result<Saved, SaveError> {
        save_filter(self.filter.as_ref(), saved, writer)
    }

    fn load(entry: &Entry<'_>) -> Result<Self, MakeError> {
        Ok(Self { filter: load_filter(entry)?, ..Self::new() })
    }
}
