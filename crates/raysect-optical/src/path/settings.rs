use raysect_math::MathError;

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
}

impl Default for PathSettings {
    /// Depth 500; roulette below a throughput of 10 %; lights sampled; 20 % of the paths aimed at what else is
    /// important.
    fn default() -> Self {
        Self {
            max_depth: 500,
            roulette_threshold: 0.1,
            light_sampling: LightSampling::Lights,
            important_path_weight: 0.2,
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
