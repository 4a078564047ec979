use raysect_core::save::{SaveError, Saved, SceneWriter};

use super::{Material, Scatter, SurfaceHit};
use crate::Path;

/// A perfect mirror, on both sides: nothing is lost at it.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct PerfectReflectingSurface;

impl Material for PerfectReflectingSurface {
    fn surface(&self, hit: &SurfaceHit, _: &mut Path<'_>) -> Scatter {
        reflect(hit)
    }

    fn save(&self, _: &mut SceneWriter) -> Result<Saved, SaveError> {
        Ok(Saved::new("PerfectReflectingSurface"))
    }
}

/// Along the mirror direction of an opaque surface. A smoothed normal may turn that into the solid, where nothing
/// goes on.
pub(super) fn reflect(hit: &SurfaceHit) -> Scatter {
    let direction = hit.mirrored();
    if hit.leads_through(direction) { Scatter::Absorbed } else { Scatter::Continue { direction } }
}
