use raysect_core::save::{SaveError, Saved, SceneWriter};

use crate::material::{Context, Facts, Material, Scatter, SurfaceHit};
use crate::{Path, SpectralTable};

/// A surface of uniform radiance: the same from every point, in every direction, on both sides. It reflects nothing.
#[derive(Debug, Clone)]
pub struct UniformSurfaceEmitter {
    spectrum: SpectralTable,
    scale: f64,
    importance: f64,
}

impl UniformSurfaceEmitter {
    /// Of a spectrum [W/m²/sr/nm] times a scale.
    pub fn new(spectrum: impl Into<SpectralTable>, scale: f64) -> Self {
        Self { spectrum: spectrum.into(), scale, importance: 1.0 }
    }

    /// How much paths are to be aimed at it, relative to others; 0 for not at all.
    pub fn importance(self, importance: f64) -> Self {
        Self { importance, ..self }
    }
}

impl Material for UniformSurfaceEmitter {
    fn emit(&self, _: &SurfaceHit, at: Context<'_>, out: &mut [f64]) -> bool {
        for (out, radiance) in out.iter_mut().zip(at.slice.table(&self.spectrum)) {
            *out = radiance * self.scale;
        }
        true
    }

    fn surface(&self, _: &SurfaceHit, _: &mut Path<'_>) -> Scatter {
        Scatter::Absorbed
    }

    fn facts(&self) -> Facts {
        Facts { importance: self.importance, ..Facts::emitter("UniformSurfaceEmitter").without_index() }
    }

    fn save(&self, writer: &mut SceneWriter) -> Result<Saved, SaveError> {
        let saved = Saved::new("UniformSurfaceEmitter").reference("spectrum", writer.object(&self.spectrum)?);
        Ok(saved.number("scale", self.scale).number("importance", self.importance))
    }
}
