use std::path::{Path, PathBuf};
use std::sync::OnceLock;

use raysect_core::save::{Entry, MakeError, SaveError, Saved, SceneWriter, Storable};
use raysect_math::MathError;
use raysect_optical::{OpticalEntry, Slicing, SpectralFunction, SpectralTable, photon_energy};

use super::output::{Output, load_name};
use super::{Measurement, Pipeline};
use crate::{Frame, MonoDisplay, ObserverError};

/// Named sums over the spectrum, a channel each: bands, or any weight that depends on the wavelength.
///
/// The error of each is that of the sum itself, measured sample by sample: what the bins of a sample have in common
/// is in it, other than in a sum over the errors of a spectrum.
///
/// ```
/// use raysect_observer::FunctionalPipeline;
/// let bands = FunctionalPipeline::power().band("red", 600.0, 700.0)?.band("blue", 400.0, 500.0)?;
/// let slope = FunctionalPipeline::radiance().functional("slope", |wavelength: f64| wavelength - 550.0);
/// # Ok::<(), raysect_observer::ObserverError>(())
/// ```
#[derive(Debug)]
pub struct FunctionalPipeline {
    quantity: Quantity,
    functionals: Vec<Functional>,
    frame: Frame,
    output: Output,
}

/// What is summed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Quantity {
    Power,
    Radiance,
    Photons,
}

/// What a file calls the quantities.
const QUANTITIES: [(&str, Quantity); 3] =
    [("power", Quantity::Power), ("radiance", Quantity::Radiance), ("photons", Quantity::Photons)];

#[derive(Debug)]
struct Functional {
    name: String,
    weight: SpectralTable,
    /// The ends [nm], if it is a band.
    band: Option<[f64; 2]>,
}

/// One between two wavelengths, zero elsewhere.
struct Band([f64; 2]);

impl SpectralFunction for Band {
    fn evaluate(&self, wavelength: f64) -> f64 {
        f64::from(u8::from(wavelength >= self.0[0] && wavelength < self.0[1]))
    }

    fn integrate(&self, min: f64, max: f64) -> f64 {
        (max.min(self.0[1]) - min.max(self.0[0])).max(0.0)
    }
}

/// Photons in a joule.
fn photons() -> &'static SpectralTable {
    static TABLE: OnceLock<SpectralTable> = OnceLock::new();
    TABLE.get_or_init(|| SpectralTable::new(|wavelength| photon_energy(wavelength).map_or(0.0, f64::recip)))
}

impl FunctionalPipeline {
    fn of(quantity: Quantity) -> Self {
        let (name, unit) = match quantity {
            Quantity::Power => ("power", "W"),
            Quantity::Radiance => ("radiance", "W/m²/sr"),
            Quantity::Photons => ("photons", "1/s"),
        };
        let (functionals, output) = (Vec::new(), Output::default());
        Self { quantity, functionals, frame: Frame::new(name, unit), output }
    }

    /// Of the power of each pixel [W].
    pub fn power() -> Self {
        Self::of(Quantity::Power)
    }

    /// Of the radiance of each pixel [W/m²/sr].
    pub fn radiance() -> Self {
        Self::of(Quantity::Radiance)
    }

    /// Of the number of photons that arrive at each pixel in a second: its spectral power divided by the energy of a
    /// photon, averaged over each bin.
    pub fn photons() -> Self {
        Self::of(Quantity::Photons)
    }

    /// Adds the integral between two wavelengths [nm]; within a bin that an end cuts, the spectrum counts as
    /// constant.
    ///
    /// # Errors
    /// [`ObserverError::Math`] unless the lower end is positive and the upper one above it and finite.
    pub fn band(self, name: impl Into<String>, min: f64, max: f64) -> Result<Self, ObserverError> {
        MathError::check(
            min > 0.0 && min.is_finite(),
            min,
            "lower end of a band",
            "nm",
            "positive and finite",
        )?;
        let admitted = max > min && max.is_finite();
        MathError::check(admitted, max, "upper end of a band", "nm", "finite and above the lower end")?;
        let ends = [min, max];
        Ok(self.add(name.into(), SpectralTable::new(Band(ends)), Some(ends)))
    }

    /// Adds the integral of the spectrum times a weight that depends on the wavelength, which may be negative.
    pub fn functional(self, name: impl Into<String>, weight: impl Into<SpectralTable>) -> Self {
        self.add(name.into(), weight.into(), None)
    }

    fn add(mut self, name: String, weight: SpectralTable, band: Option<[f64; 2]>) -> Self {
        self.functionals.push(Functional { name, weight, band });
        self
    }

    /// With a name of its own for reports, files and statepoints: by it pipelines of one kind are told apart.
    #[doc(alias = "name")]
    pub fn named(mut self, name: impl Into<String>) -> Self {
        self.frame.rename(name.into());
        self
    }

    /// With other brightness and colours of its pictures, which show the first channel.
    pub fn display(mut self, display: MonoDisplay) -> Self {
        self.output.display = display;
        self
    }

    /// Rewrites a file after every pass, whole at any moment, for a viewer that follows it; what kind of file is
    /// chosen as by [`save`](Self::save).
    pub fn preview(mut self, path: impl Into<PathBuf>) -> Self {
        self.output.preview = Some(path.into());
        self
    }

    /// What it has gathered.
    pub fn frame(&self) -> &Frame {
        &self.frame
    }

    /// Writes what it has gathered: a picture of the first channel for a name that ends in `.png`, otherwise as
    /// [`Frame::save`].
    ///
    /// # Errors
    /// [`ObserverError::EmptyFrame`], [`ObserverError::File`].
    pub fn save(&self, path: impl AsRef<Path>) -> Result<(), ObserverError> {
        self.output.save(&self.frame, path.as_ref())
    }
}

impl Pipeline for FunctionalPipeline {
    fn channels(&self, _: &Slicing) -> Vec<String> {
        self.functionals.iter().map(|f| f.name.clone()).collect()
    }

    fn measure(&self, sample: &Measurement<'_>, out: &mut [f64]) {
        let width = sample.slice.bin_width();
        let factor = if self.needs_etendue() { sample.etendue * width } else { width };
        for (out, functional) in out.iter_mut().zip(&self.functionals) {
            let weighted = sample.radiance.iter().zip(sample.slice.table(&functional.weight));
            let sum: f64 = if self.quantity == Quantity::Photons {
                weighted.zip(sample.slice.table(photons())).map(|((l, w), n)| l * w * n).sum()
            } else {
                weighted.map(|(l, w)| l * w).sum()
            };
            *out += factor * sum;
        }
    }

    fn needs_etendue(&self) -> bool {
        self.quantity != Quantity::Radiance
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

impl Storable for FunctionalPipeline {
    const KIND: &'static str = "FunctionalPipeline";

    fn save(&self, saved: Saved, writer: &mut SceneWriter) -> Result<Saved, SaveError> {
        let quantity = QUANTITIES.iter().find(|(_, q)| *q == self.quantity).map_or("", |(name, _)| name);
        let mut saved = saved.text("quantity", quantity).count("functionals", self.functionals.len() as u64);
        for (number, functional) in self.functionals.iter().enumerate() {
            saved = saved.text(&format!("name {number}"), functional.name.clone());
            saved = match functional.band {
                Some(ends) => saved.numbers(&format!("band {number}"), &ends),
                None => saved.reference(&format!("weight {number}"), writer.object(&functional.weight)?),
            };
        }
        self.output.save_settings(&self.frame, saved)
    }

    fn load(entry: &Entry<'_>) -> Result<Self, MakeError> {
        let mut pipeline = Self::of(entry.choice("quantity", &QUANTITIES)?);
        for number in 0..entry.count("functionals")? {
            let (name, band) = (entry.text(&format!("name {number}"))?, format!("band {number}"));
            pipeline = if entry.has(&band) {
                let [min, max] = entry.array(&band)?;
                pipeline.band(name, min, max)?
            } else {
                pipeline.functional(name, entry.function(&format!("weight {number}"))?)
            };
        }
        pipeline.output = Output::load_settings(entry)?;
        load_name(&mut pipeline.frame, entry)?;
        Ok(pipeline)
    }
}
