use raysect_core::save::{SaveError, Saved, SceneWriter};

use super::{Facts, Material, Scatter, SurfaceHit};
use crate::Path;

/// A perfect mirror, on both sides: nothing is lost at it.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct PerfectReflectingSurface;

impl Material for PerfectReflectingSurface {
    fn surface(&self, hit: &SurfaceHit, _: &mut Path<'_>) -> Scatter {
        Scatter::Continue { direction: hit.mirrored() }
    }

    fn facts(&self) -> Facts {
        Facts::named("PerfectReflectingSurface").without_index()
    }

    fn save(&self, _: &mut SceneWriter) -> Result<Saved, SaveError> {
        Ok(Saved::new("PerfectReflectingSurface"))
    }
}
