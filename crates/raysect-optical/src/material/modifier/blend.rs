use std::fmt;
use std::sync::Arc;

use raysect_core::save::{SaveError, Saved, SceneWriter};
use raysect_math::MathError;

use super::parts::Parts;
use crate::material::{Context, Facts, Material, Medium, Scatter, SurfaceHit};
use crate::{OpticalError, Path, Slice};

/// A mixture of two materials, as of fine specks: the weighted mean of both.
///
/// What the surfaces emit is averaged; of two that scatter a path follows either, with a probability that is its
/// share.
///
/// ```
/// use std::sync::Arc;
/// use raysect_optical::{Blend, Lambert, PerfectReflectingSurface};
/// // A polished white: a tenth of it is a mirror.
/// let polished = Blend::new(Arc::new(Lambert::new(0.8)), Arc::new(PerfectReflectingSurface), 0.1)?;
/// # Ok::<(), raysect_optical::OpticalError>(())
/// ```
#[derive(Clone)]
pub struct Blend {
    parts: Parts,
    ratio: f64,
}

impl Blend {
    /// Of two materials and the share of the second one, between 0 and 1 and neither.
    ///
    /// # Errors
    /// [`OpticalError::Math`] for another ratio.
    pub fn new(
        first: Arc<dyn Material>,
        second: Arc<dyn Material>,
        ratio: f64,
    ) -> Result<Self, OpticalError> {
        MathError::check(ratio > 0.0 && ratio < 1.0, ratio, "ratio of a blend", "", "between 0 and 1")?;
        Ok(Self { parts: Parts::new(first, second, [1.0 - ratio, ratio]), ratio })
    }

    /// With only the surfaces blended; the volume is that of the first one.
    ///
    /// # Errors
    /// [`OpticalError::Modifier`] with [`volume_only`](Self::volume_only) as well.
    pub fn surface_only(self) -> Result<Self, OpticalError> {
        Ok(Self { parts: self.parts.surface_only()?, ..self })
    }

    /// With only the volumes blended; the surface is that of the first one.
    ///
    /// # Errors
    /// [`OpticalError::Modifier`] with [`surface_only`](Self::surface_only) as well.
    pub fn volume_only(self) -> Result<Self, OpticalError> {
        Ok(Self { parts: self.parts.volume_only()?, ..self })
    }

    /// The share of the second material.
    pub fn ratio(&self) -> f64 {
        self.ratio
    }
}

impl fmt::Debug for Blend {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.facts().name)
    }
}

impl Material for Blend {
    fn emit(&self, hit: &SurfaceHit, at: Context<'_>, out: &mut [f64]) -> bool {
        self.parts.emit([1.0 - self.ratio, self.ratio], hit, at, out)
    }

    fn surface(&self, hit: &SurfaceHit, path: &mut Path<'_>) -> Scatter {
        let parts = &self.parts;
        let Some([first, second]) = parts.surfaces() else { return parts.first.surface(hit, path) };
        // Beside a black part the other one is followed always, with its share as its weight.
        if second.absorbs {
            path.scale(1.0 - self.ratio);
            return parts.first.surface(hit, path);
        }
        if first.absorbs {
            path.scale(self.ratio);
            return parts.second.surface(hit, path);
        }
        let chosen = if path.rng().probability(self.ratio) { &parts.second } else { &parts.first };
        chosen.surface(hit, path)
    }

    fn medium(&self) -> Option<&dyn Medium> {
        self.parts.medium()
    }

    fn facts(&self) -> Facts {
        let ratio = self.ratio;
        self.parts.facts(|first, second| format!("({first}, {ratio} of it {second})"))
    }

    fn check(&self, slice: &Slice) -> Result<(), OpticalError> {
        self.parts.check(slice)
    }

    fn save(&self, writer: &mut SceneWriter) -> Result<Saved, SaveError> {
        self.parts.save(Saved::new("Blend").number("ratio", self.ratio), writer)
    }
}
