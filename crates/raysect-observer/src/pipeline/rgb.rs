use std::path::{Path, PathBuf};

use raysect_core::save::{Entry, MakeError, SaveError, Saved, SceneWriter, Storable};
use raysect_math::MathError;
use raysect_optical::Slicing;
use raysect_optical::colour::{CieObserver, ciexyz_to_srgb, xyz_to_linear_srgb};

use super::output::{load_name, save_preview};
use super::{Measurement, Pipeline};
use crate::display::{check_fraction, unsaturated_value};
use crate::file::{ExrLayer, save_png_rgb8};
use crate::{Frame, ObserverError};

/// The colour of each pixel: CIE 1931 tristimulus values of its radiance, shown as sRGB.
///
/// Its frame holds X, Y and Z in units of the radiance: a flat spectrum of 1 W/m²/sr/nm has X = Y = Z = 1.
#[derive(Debug)]
#[doc(alias = "RGBPipeline2D")]
pub struct RgbPipeline2D {
    frame: Frame,
    observer: CieObserver,
    exposure: Exposure,
    preview: Option<PathBuf>,
}

/// How tristimulus values become brightness.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Exposure {
    /// White is the luminance that this share of the pixels does not exceed.
    Automatic(f64),
    /// Tristimulus values times this.
    Fixed(f64),
}

impl Default for RgbPipeline2D {
    fn default() -> Self {
        Self::new()
    }
}

impl RgbPipeline2D {
    /// With automatic exposure in which no pixel is saturated.
    pub fn new() -> Self {
        Self {
            frame: Frame::new("xyz", "W/m²/sr/nm"),
            observer: CieObserver::default(),
            exposure: Exposure::Automatic(1.0),
            preview: None,
        }
    }

    /// With another table of the CIE observer.
    pub fn observer(self, observer: CieObserver) -> Self {
        Self { observer, ..self }
    }

    /// With automatic exposure in which this share of the pixels, 0 … 1, is not saturated.
    ///
    /// # Errors
    /// [`ObserverError::Math`] for a share outside 0 … 1, or 0.
    #[doc(alias = "display_unsaturated_fraction")]
    pub fn unsaturated_fraction(mut self, fraction: f64) -> Result<Self, ObserverError> {
        self.exposure = Exposure::Automatic(check_fraction(fraction)?);
        Ok(self)
    }

    /// With a fixed exposure instead of the automatic one: tristimulus values are multiplied by this before they become sRGB.
    ///
    /// # Errors
    /// [`ObserverError::Math`] unless it is positive and finite.
    #[doc(alias("display_sensitivity", "display_auto_exposure"))]
    pub fn sensitivity(mut self, sensitivity: f64) -> Result<Self, ObserverError> {
        let admitted = sensitivity > 0.0 && sensitivity.is_finite();
        MathError::check(admitted, sensitivity, "sensitivity", "", "positive and finite")?;
        self.exposure = Exposure::Fixed(sensitivity);
        Ok(self)
    }

    /// With a name of its own for reports, files and statepoints: by it pipelines of one kind are told apart.
    #[doc(alias = "name")]
    pub fn named(mut self, name: impl Into<String>) -> Self {
        self.frame.rename(name.into());
        self
    }

    /// Rewrites a PNG picture after every pass, whole at any moment, for a viewer that follows the file.
    #[doc(alias = "display_progress")]
    pub fn preview(mut self, path: impl Into<PathBuf>) -> Self {
        self.preview = Some(path.into());
        self
    }

    /// What it has gathered.
    pub fn frame(&self) -> &Frame {
        &self.frame
    }

    fn xyz(&self) -> Vec<[f64; 3]> {
        self.frame.mean().chunks_exact(3).map(|v| [v[0], v[1], v[2]]).collect()
    }

    fn gain(&self, xyz: &[[f64; 3]]) -> f64 {
        let fraction = match self.exposure {
            Exposure::Fixed(sensitivity) => return sensitivity,
            Exposure::Automatic(fraction) => fraction,
        };
        let luminances: Vec<f64> = xyz.iter().map(|v| v[1]).collect();
        match unsaturated_value(&luminances, fraction) {
            Some(white) if white > 0.0 => 1.0 / white,
            _ => 1.0,
        }
    }

    /// The picture as 8-bit sRGB values, \[row, column, channel\].
    pub fn to_srgb(&self) -> Vec<u8> {
        let xyz = self.xyz();
        let gain = self.gain(&xyz);
        let shown = xyz.iter().flat_map(|v| ciexyz_to_srgb(v.map(|x| x * gain)));
        shown.map(|v| (255.0 * v).round() as u8).collect()
    }

    /// Writes the picture: sRGB for a name that ends in `.png`; OpenEXR with linear sRGB in front and the layers
    /// `mean`, `error` and `samples` of the tristimulus values for `.exr`; a NumPy archive with `xyz_mean`,
    /// `xyz_error` and `samples` for `.npz`; a table for `.csv`.
    ///
    /// # Errors
    /// [`ObserverError::EmptyFrame`], [`ObserverError::File`].
    pub fn save(&self, path: impl AsRef<Path>) -> Result<(), ObserverError> {
        let extension = path.as_ref().extension().map(|e| e.to_ascii_lowercase()).unwrap_or_default();
        if self.frame.is_empty() {
            return Err(ObserverError::EmptyFrame(self.frame.name().to_owned()));
        }
        match extension.to_str() {
            Some("npz") => self.frame.save_npz(path),
            Some("csv") => self.frame.save_csv(path),
            Some("exr") => {
                let linear: Vec<[f64; 3]> = self.xyz().into_iter().map(xyz_to_linear_srgb).collect();
                let plane = |c: usize| linear.iter().map(|v| v[c]).collect::<Vec<_>>();
                let channels = [("R", 0), ("G", 1), ("B", 2)].map(|(name, c)| (name.to_owned(), plane(c)));
                self.frame.save_exr_showing(path, ExrLayer { name: String::new(), channels: channels.into() })
            }
            _ => {
                let shape = self.frame.shape();
                Ok(save_png_rgb8(path, shape.columns(), shape.rows(), &self.to_srgb())?)
            }
        }
    }
}

impl Pipeline for RgbPipeline2D {
    fn channels(&self, _: &Slicing) -> Vec<String> {
        ["X", "Y", "Z"].map(str::to_owned).into()
    }

    fn measure(&self, sample: &Measurement<'_>, out: &mut [f64]) {
        let width = sample.slice.bin_width();
        for (out, curve) in out.iter_mut().zip(self.observer.curves()) {
            let sum: f64 = sample.radiance.iter().zip(sample.slice.table(curve)).map(|(l, c)| l * c).sum();
            *out += width * sum;
        }
    }

    fn frame(&self) -> &Frame {
        &self.frame
    }

    fn frame_mut(&mut self) -> &mut Frame {
        &mut self.frame
    }

    fn pass_finished(&mut self) -> Result<(), ObserverError> {
        match &self.preview {
            Some(path) => self.save(path.clone()),
            None => Ok(()),
        }
    }
}

/// What a file calls the tables of the CIE observer.
const OBSERVERS: [(&str, CieObserver); 2] =
    [("1 nm", CieObserver::OneNanometre), ("5 nm", CieObserver::FiveNanometres)];

impl Storable for RgbPipeline2D {
    const KIND: &'static str = "RgbPipeline2D";

    fn save(&self, saved: Saved, _: &mut SceneWriter) -> Result<Saved, SaveError> {
        let table = OBSERVERS.iter().find(|(_, o)| *o == self.observer).map_or("", |(name, _)| name);
        let mut saved = saved.text("observer", table);
        saved = match self.exposure {
            Exposure::Automatic(fraction) => saved.number("unsaturated_fraction", fraction),
            Exposure::Fixed(sensitivity) => saved.number("sensitivity", sensitivity),
        };
        save_preview(self.preview.as_deref(), saved.text("name", self.frame.name()))
    }

    fn load(entry: &Entry<'_>) -> Result<Self, MakeError> {
        let mut pipeline = Self::new().observer(entry.choice("observer", &OBSERVERS)?);
        pipeline = if entry.has("sensitivity") {
            pipeline.sensitivity(entry.number("sensitivity")?)?
        } else {
            pipeline.unsaturated_fraction(entry.number("unsaturated_fraction")?)?
        };
        load_name(&mut pipeline.frame, entry)?;
        Ok(if entry.has("preview") { pipeline.preview(entry.text("preview")?) } else { pipeline })
    }
}
