use raysect_core::save::{SaveError, Saved, SceneWriter};

use super::{Facts, Material, Scatter, SurfaceHit};
use crate::Path;

/// A black surface: it absorbs everything and emits nothing.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct AbsorbingSurface;

impl Material for AbsorbingSurface {
    fn surface(&self, _: &SurfaceHit, _: &mut Path<'_>) -> Scatter {
        Scatter::Absorbed
    }

    fn facts(&self) -> Facts {
        Facts { absorbs: true, ..Facts::named("AbsorbingSurface").without_index() }
    }

    fn save(&self, _: &mut SceneWriter) -> Result<Saved, SaveError> {
        Ok(Saved::new("AbsorbingSurface"))
    }
}
