use raysect_core::save::{SaveError, Saved, SceneWriter};

use crate::Path;
use crate::material::{Context, Facts, Material, Scatter, SurfaceHit};

/// A surface of radiance one [W/m²/sr/nm] in every bin, from every point, in every direction, on both sides: for
/// furnaces, form factors and calibrations. It reflects nothing.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct UnitySurfaceEmitter {
    importance: f64,
}

impl UnitySurfaceEmitter {
    /// That no path is aimed at, as in Raysect.
    pub fn new() -> Self {
        Self::default()
    }

    /// How much paths are to be aimed at it, relative to others; 0 for not at all.
    pub fn importance(self, importance: f64) -> Self {
        Self { importance }
    }
}

impl Material for UnitySurfaceEmitter {
    fn emit(&self, _: &SurfaceHit, _: Context<'_>, out: &mut [f64]) -> bool {
        out.fill(1.0);
        true
    }

    fn surface(&self, _: &SurfaceHit, _: &mut Path<'_>) -> Scatter {
        Scatter::Absorbed
    }

    fn facts(&self) -> Facts {
        Facts { importance: self.importance, ..Facts::emitter("UnitySurfaceEmitter").without_index() }
    }

    fn save(&self, _: &mut SceneWriter) -> Result<Saved, SaveError> {
        Ok(Saved::new("UnitySurfaceEmitter").number("importance", self.importance))
    }
}
