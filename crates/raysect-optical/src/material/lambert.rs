use std::f64::consts::FRAC_1_PI;

use raysect_core::save::{SaveError, Saved, SceneWriter};
use raysect_math::sampling::{hemisphere, uniforms};
use raysect_math::{Rng, Vector3D};

use super::{Bsdf, Context, Facts, Material, Scatter, SurfaceHit, check_shares};
use crate::{OpticalError, Path, Slice, SpectralTable};

/// An ideal diffuse reflector, on both sides: f = ρ/π (J. H. Lambert, *Photometria*, 1760).
#[derive(Debug, Clone)]
pub struct Lambert {
    reflectivity: SpectralTable,
}

impl Default for Lambert {
    /// Reflectivity 0.5 at every wavelength.
    fn default() -> Self {
        Self::new(0.5)
    }
}

impl Lambert {
    /// Of a reflectivity ρ, 0 … 1, as a function of the wavelength. Where it lies outside it is refused when it is
    /// observed.
    pub fn new(reflectivity: impl Into<SpectralTable>) -> Self {
        Self { reflectivity: reflectivity.into() }
    }

    /// The reflectivity.
    pub fn reflectivity(&self) -> &SpectralTable {
        &self.reflectivity
    }
}

impl Bsdf for Lambert {
    #[inline(always)]
    fn sample(&self, _: Vector3D, _: Context<'_>, rng: &mut Rng) -> Vector3D {
        hemisphere::sample_cosine(uniforms(rng))
    }

    #[inline]
    fn pdf(&self, _: Vector3D, outgoing: Vector3D, _: Context<'_>) -> f64 {
        outgoing.z.max(0.0) * FRAC_1_PI
    }

    #[inline]
    fn evaluate(&self, _: Vector3D, outgoing: Vector3D, at: Context<'_>, out: &mut [f64]) {
        let cosine = outgoing.z.max(0.0) * FRAC_1_PI;
        for (out, reflectivity) in out.iter_mut().zip(at.slice.table(&self.reflectivity)) {
            *out = reflectivity * cosine;
        }
    }
}

impl Material for Lambert {
    fn surface(&self, hit: &SurfaceHit, path: &mut Path<'_>) -> Scatter {
        path.scatter(self, hit)
    }

    fn facts(&self) -> Facts {
        Facts::named("Lambert").without_index()
    }

    fn check(&self, slice: &Slice) -> Result<(), OpticalError> {
        check_shares(slice, &self.reflectivity, "reflectivity of a diffuse surface")
    }

    fn save(&self, writer: &mut SceneWriter) -> Result<Saved, SaveError> {
        Ok(Saved::new("Lambert").reference("reflectivity", writer.object(&self.reflectivity)?))
    }
}
