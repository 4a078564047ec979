use raysect_core::save::{SaveError, Saved, SceneWriter, short_name};

use super::{Facts, Material, Scatter, SurfaceHit};
use crate::Path;

/// No material at all: rays go straight on, and nothing fills the volume.
#[doc(alias("NullSurface", "NullVolume"))]
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct NullMaterial;

impl Material for NullMaterial {
    fn surface(&self, _: &SurfaceHit, _: &mut Path<'_>) -> Scatter {
        Scatter::PassThrough
    }

    fn facts(&self) -> Facts {
        Facts { transparent: true, ..Facts::named(short_name(std::any::type_name::<Self>())).without_index() }
    }

    fn save(&self, _: &mut SceneWriter) -> Result<Saved, SaveError> {
        Ok(Saved::new("NullMaterial"))
    }
}
