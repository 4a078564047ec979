use std::fmt;
use std::sync::Arc;

use raysect_core::save::{SaveError, Saved, SceneWriter};

use super::parts::Parts;
use crate::material::{Context, Facts, Material, Medium, Scatter, SurfaceHit};
use crate::{OpticalError, Path, Slice};

/// The sum of two materials: of what their surfaces emit and scatter, and of what fills their volumes.
///
/// Of two surfaces that scatter a path follows either, with equal probability and twice the weight: the sum of both
/// on average. Of two null surfaces the sum is one. Nobody checks that the sum reflects no more than arrives.
///
/// A hot metal that also shines:
/// ```
/// use std::sync::Arc;
/// use raysect_optical::{Add, Conductor, Material, UniformSurfaceEmitter};
/// let metal = Arc::new(Conductor::new(2.9, 3.0));
/// let hot = Add::new(metal, Arc::new(UniformSurfaceEmitter::new(1.0, 0.4))).surface_only()?;
/// assert!(hot.facts().emits && hot.facts().importance == 1.0);
/// # Ok::<(), raysect_optical::OpticalError>(())
/// ```
#[derive(Clone)]
pub struct Add(Parts);

impl Add {
    /// Of two materials, which may be sums themselves.
    pub fn new(first: Arc<dyn Material>, second: Arc<dyn Material>) -> Self {
        Self(Parts::new(first, second, [1.0, 1.0]))
    }

    /// With only the surfaces added; the volume is that of the first one.
    ///
    /// # Errors
    /// [`OpticalError::Modifier`] with [`volume_only`](Self::volume_only) as well.
    pub fn surface_only(self) -> Result<Self, OpticalError> {
        Ok(Self(self.0.surface_only()?))
    }

    /// With only the volumes added; the surface is that of the first one.
    ///
    /// # Errors
    /// [`OpticalError::Modifier`] with [`surface_only`](Self::surface_only) as well.
    pub fn volume_only(self) -> Result<Self, OpticalError> {
        Ok(Self(self.0.volume_only()?))
    }
}

impl fmt::Debug for Add {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.facts().name)
    }
}

impl Material for Add {
    fn emit(&self, hit: &SurfaceHit, at: Context<'_>, out: &mut [f64]) -> bool {
        self.0.emit([1.0, 1.0], hit, at, out)
    }

    fn surface(&self, hit: &SurfaceHit, path: &mut Path<'_>) -> Scatter {
        let Some([first, second]) = self.0.surfaces() else { return self.0.first.surface(hit, path) };
        if second.absorbs || (first.transparent && second.transparent) {
            return self.0.first.surface(hit, path);
        }
        if first.absorbs {
            return self.0.second.surface(hit, path);
        }
        path.scale(2.0);
        let chosen = if path.rng().probability(0.5) { &self.0.second } else { &self.0.first };
        chosen.surface(hit, path)
    }

    fn medium(&self) -> Option<&dyn Medium> {
        self.0.medium()
    }

    fn facts(&self) -> Facts {
        self.0.facts(|first, second| format!("({first} + {second})"))
    }

    fn check(&self, slice: &Slice) -> Result<(), OpticalError> {
        self.0.check(slice)
    }

    fn save(&self, writer: &mut SceneWriter) -> Result<Saved, SaveError> {
        self.0.save(Saved::new("Add"), writer)
    }
}
