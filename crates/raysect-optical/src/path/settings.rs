use raysect_core::save::{Entry, MakeError, SaveError, Saved, SceneWriter, Storable};
use raysect_math::MathError;

use super::Dispersion;
use crate::OpticalError;

/// How paths look for light.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum LightSampling {
    /// At each scattering surface a light is sampled by its shape, and combined with the direction in which the
    /// path goes on by multiple importance sampling; other important things are aimed at.
    #[default]
    Lights,
    /// Raysect's way: some of the directions in which paths go on are aimed at the bounding spheres of everything
    /// important, lights included.
    BoundingSpheres,
    /// Not at all: paths follow the surfaces alone (Raysect's `ray_importance_sampling = False`).
    Off,
}

/// How far paths are followed, and how they look for light.
#[derive(Debug, Clone, PartialEq)]
pub struct PathSettings {
    pub(crate) max_depth: u32,
    pub(crate) roulette_threshold: f64,
    pub(crate) light_sampling: LightSampling,
    pub(crate) important_path_weight: f64,
    pub(crate) dispersion: Dispersion,
    pub(crate) line_tolerance: f64,
}

impl Default for PathSettings {
    /// Depth 500; roulette below a throughput of 20 % where a direction has been chosen; lights sampled; 20 % of the
    /// paths aimed at what else is important; wavelengths sampled where something disperses; line integrals to 1e-6.
    fn default() -> Self {
        Self {
            max_depth: 500,
            roulette_threshold: 0.2,
            light_sampling: LightSampling::Lights,
            important_path_weight: 0.2,
            dispersion: Dispersion::Sampled,
            line_tolerance: 1e-6,
        }
    }
}

impl PathSettings {
    /// A path ends after this many scatterings, and its remaining throughput is reported.
    #[doc(alias = "ray_max_depth")]
    pub fn max_depth(self, max_depth: u32) -> Self {
        Self { max_depth, ..self }
    }

    /// Paths play roulette once their throughput has fallen below this; 0 for never.
    ///
    /// # Errors
    /// [`OpticalError::Math`] unless it lies in 0 … 1.
    #[doc(alias("ray_extinction_prob", "ray_extinction_min_depth"))]
    pub fn roulette_threshold(self, threshold: f64) -> Result<Self, OpticalError> {
        MathError::check((0.0..=1.0).contains(&threshold), threshold, "roulette threshold", "", "0 … 1")?;
        Ok(Self { roulette_threshold: threshold, ..self })
    }

    /// How paths look for light, as set.
    pub fn sampling(&self) -> LightSampling {
        self.light_sampling
    }

    /// How paths look for light.
    #[doc(alias = "ray_importance_sampling")]
    pub fn light_sampling(self, light_sampling: LightSampling) -> Self {
        Self { light_sampling, ..self }
    }

    /// The share of scattered paths that is aimed at what is important; it costs nothing where nothing is.
    ///
    /// # Errors
    /// [`OpticalError::Math`] unless it lies in 0 … 1 without 1 itself, which would leave out all other directions.
    #[doc(alias = "ray_important_path_weight")]
    pub fn important_path_weight(self, weight: f64) -> Result<Self, OpticalError> {
        let admitted = (0.0..1.0).contains(&weight);
        MathError::check(admitted, weight, "important path weight", "", "0 … 1, without 1")?;
        Ok(Self { important_path_weight: weight, ..self })
    }

    /// How paths are refracted where the index depends on the wavelength.
    pub fn dispersion(self, dispersion: Dispersion) -> Self {
        Self { dispersion, ..self }
    }

    /// How paths are refracted where the index depends on the wavelength, as set.
    pub fn chosen_dispersion(&self) -> Dispersion {
        self.dispersion
    }

    /// Relative error of the integrals along rays through media whose structure is declared, of each piece of a path.
    ///
    /// # Errors
    /// [`OpticalError::Math`] unless it lies in 1e-12 … 0.1.
    pub fn line_tolerance(self, tolerance: f64) -> Result<Self, OpticalError> {
        let admitted = (1e-12..=0.1).contains(&tolerance);
        MathError::check(admitted, tolerance, "tolerance of line integrals", "", "1e-12 … 0.1")?;
        Ok(Self { line_tolerance: tolerance, ..self })
    }
}

/// What a file calls the ways of looking for light.
const SAMPLINGS: [(&str, LightSampling); 3] = [
    ("lights", LightSampling::Lights),
    ("bounding spheres", LightSampling::BoundingSpheres),
    ("off", LightSampling::Off),
];

/// What a file calls the ways of dispersing.
const DISPERSIONS: [(&str, Dispersion); 2] = [("sampled", Dispersion::Sampled), ("mean", Dispersion::Mean)];

impl Storable for PathSettings {
    const KIND: &'static str = "PathSettings";

    fn save(&self, saved: Saved, _: &mut SceneWriter) -> Result<Saved, SaveError> {
        let sampling = SAMPLINGS.iter().find(|(_, s)| *s == self.light_sampling).map_or("", |(name, _)| name);
        let dispersion = DISPERSIONS.iter().find(|(_, d)| *d == self.dispersion).map_or("", |(name, _)| name);
        Ok(saved
            .text("dispersion", dispersion)
            .number("line_tolerance", self.line_tolerance)
            .count("max_depth", self.max_depth.into())
            .number("roulette_threshold", self.roulette_threshold)
            .text("light_sampling", sampling)
            .number("important_path_weight", self.important_path_weight))
    }

    fn load(entry: &Entry<'_>) -> Result<Self, MakeError> {
        let sampling = entry.choice("light_sampling", &SAMPLINGS)?;
        Ok(Self::default()
            .max_depth(entry.integer("max_depth")?)
            .roulette_threshold(entry.number("roulette_threshold")?)?
            .light_sampling(sampling)
            .dispersion(entry.choice("dispersion", &DISPERSIONS)?)
            .line_tolerance(entry.number("line_tolerance")?)?
            .important_path_weight(entry.number("important_path_weight")?)?)
    }
}

impl std::fmt::Display for PathSettings {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "at most {} scatterings; ", self.max_depth)?;
        if self.roulette_threshold > 0.0 {
            write!(f, "roulette below a throughput of {}", self.roulette_threshold)
        } else {
            write!(f, "no roulette")
        }
    }
}
