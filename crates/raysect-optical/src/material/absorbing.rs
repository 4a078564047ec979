use super::{Material, Scatter, SurfaceHit};
use crate::Path;

/// A black surface: it absorbs everything and emits nothing.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct AbsorbingSurface;

impl Material for AbsorbingSurface {
    fn surface(&self, _: &SurfaceHit, _: &mut Path<'_>) -> Scatter {
        Scatter::Absorbed
    }
}
