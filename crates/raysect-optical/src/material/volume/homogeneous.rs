use std::fmt;

use raysect_math::Vector3D;

use super::volume_facts;
use crate::material::{Coefficients, Facts, Material, Medium, MediumPoint, Scatter, SurfaceHit};
use crate::{Context, Path};

/// A volume whose emission is the same everywhere but may depend on the direction, by a function of the user.
///
/// The function gets the unit vector in which the light travels, in the space of the shape, and adds its emission
/// [W/m³/sr/nm] to the bins.
///
/// ```
/// use raysect_optical::HomogeneousVolumeEmitter;
/// let beamed = HomogeneousVolumeEmitter::new(|direction, _, bins| {
///     bins.iter_mut().for_each(|bin| *bin += direction.z.max(0.0));
/// });
/// ```
pub struct HomogeneousVolumeEmitter<F> {
    emission: F,
    importance: f64,
}

impl<F> fmt::Debug for HomogeneousVolumeEmitter<F> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "HomogeneousVolumeEmitter, importance {}", self.importance)
    }
}

impl<F: Fn(Vector3D, Context<'_>, &mut [f64]) + Send + Sync + 'static> HomogeneousVolumeEmitter<F> {
    /// Of a function that adds the emission, of importance 1.
    pub fn new(emission: F) -> Self {
        Self { emission, importance: 1.0 }
    }

    /// How much paths are to be aimed at it, relative to others; 0 for not at all.
    pub fn importance(self, importance: f64) -> Self {
        Self { importance, ..self }
    }
}

impl<F: Fn(Vector3D, Context<'_>, &mut [f64]) + Send + Sync + 'static> Material
    for HomogeneousVolumeEmitter<F>
{
    fn surface(&self, _: &SurfaceHit, _: &mut Path<'_>) -> Scatter {
        Scatter::PassThrough
    }

    fn medium(&self) -> Option<&dyn Medium> {
        Some(self)
    }

    fn facts(&self) -> Facts {
        Facts { name: "HomogeneousVolumeEmitter".to_owned(), ..volume_facts::<Self>(self.importance) }
    }
}

impl<F: Fn(Vector3D, Context<'_>, &mut [f64]) + Send + Sync + 'static> Medium
    for HomogeneousVolumeEmitter<F>
{
    fn coefficients(&self, at: &MediumPoint<'_>, out: &mut Coefficients<'_>) {
        (self.emission)(at.local_direction(), at.at, out.emission);
    }

    fn majorant(&self, _: Context<'_>) -> f64 {
        0.0
    }
}
