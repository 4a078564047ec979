use std::path::{Path, PathBuf};

use raysect_core::save::{Entry, MakeError, SaveError, Saved, SceneWriter, Storable};
use raysect_optical::{OpticalEntry, Slicing, SpectralTable};

use super::output::{Output, load_name};
use super::power::integrate;
use super::{Measurement, Pipeline};
use crate::{Frame, FrameShape, MonoDisplay, ObserverError};

/// The power of each pixel [W] behind a mosaic of colour filters (B. E. Bayer, US patent 3971065, 1976).
///
/// Counted from 0 at the upper left corner, pixels of an even row and an even column have the red filter, those of an
/// odd row and an odd column the blue one, and all others the green one. Its frame is monochrome, as that of a raw
/// picture of a colour camera.
///
/// ```
/// use raysect_observer::BayerPipeline2D;
/// use raysect_optical::InterpolatedSf;
/// let bell = |centre| InterpolatedSf::new([centre - 50.0, centre, centre + 50.0], [0.0, 1.0, 0.0]);
/// let bayer = BayerPipeline2D::new(bell(600.0)?, bell(540.0)?, bell(450.0)?);
/// # Ok::<(), raysect_optical::OpticalError>(())
/// ```
#[derive(Debug)]
pub struct BayerPipeline2D {
    /// Red, green, blue.
    filters: [SpectralTable; 3],
    columns: usize,
    frame: Frame,
    output: Output,
}

/// What a file calls the filters.
const FILTERS: [&str; 3] = ["red", "green", "blue"];

impl BayerPipeline2D {
    /// With the transmission of the red, the green and the blue filter, which depend on the wavelength.
    pub fn new(
        red: impl Into<SpectralTable>,
        green: impl Into<SpectralTable>,
        blue: impl Into<SpectralTable>,
    ) -> Self {
        Self {
            filters: [red.into(), green.into(), blue.into()],
            columns: 1,
            frame: Frame::new("bayer", "W"),
            output: Output::default(),
        }
    }

    /// The number of the filter of a pixel: red 0, green 1, blue 2.
    fn filter_of(&self, pixel: usize) -> usize {
        let (row, column) = (pixel / self.columns, pixel % self.columns);
        row % 2 + column % 2
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

    /// What it has gathered.
    pub fn frame(&self) -> &Frame {
        &self.frame
    }

    /// Writes what it has gathered: a picture for a name that ends in `.png`, otherwise as [`Frame::save`].
    ///
    /// # Errors
    /// [`ObserverError::EmptyFrame`], [`ObserverError::File`].
    pub fn save(&self, path: impl AsRef<Path>) -> Result<(), ObserverError> {
        self.output.save(&self.frame, path.as_ref())
    }
}

impl Pipeline for BayerPipeline2D {
    fn channels(&self, _: &Slicing) -> Vec<String> {
        vec!["bayer".to_owned()]
    }

    fn begin(&mut self, shape: FrameShape, _: &Slicing) {
        self.columns = shape.columns().max(1);
    }

    fn measure(&self, sample: &Measurement<'_>, out: &mut [f64]) {
        let filter = &self.filters[self.filter_of(sample.pixel)];
        out[0] += sample.etendue * integrate(sample, Some(filter));
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

    fn pass_finished(&mut self) -> Result<(), ObserverError> {
        self.output.rewrite(&self.frame)
    }
}

impl Storable for BayerPipeline2D {
    const KIND: &'static str = "BayerPipeline2D";

    fn save(&self, mut saved: Saved, writer: &mut SceneWriter) -> Result<Saved, SaveError> {
        for (name, filter) in FILTERS.iter().zip(&self.filters) {
            saved = saved.reference(name, writer.object(filter)?);
        }
        self.output.save_settings(&self.frame, saved)
    }

    fn load(entry: &Entry<'_>) -> Result<Self, MakeError> {
        let [red, green, blue] = FILTERS.map(|name| entry.function(name));
        let output = Output::load_settings(entry)?;
        let mut pipeline = Self { output, ..Self::new(red?, green?, blue?) };
        load_name(&mut pipeline.frame, entry)?;
        Ok(pipeline)
    }
}
