use std::fmt;

use crate::material::{Context, Facts, Material, Scatter, SurfaceHit};
use crate::{Path, Slice};

/// What a user's function writes: bins, cosine to the normal, from behind or not, and the radiance of each bin.
type Emission = dyn Fn(&Slice, f64, bool, &mut [f64]) + Send + Sync;

/// A surface whose radiance depends on the angle to its normal and on the side. It reflects nothing.
///
/// ```
/// use raysect_math::{Point3D, Vector3D};
/// use raysect_optical::{AnisotropicSurfaceEmitter, Ray, WithMaterial, World};
/// use raysect_primitive::Sphere;
///
/// // A black outside that shines more strongly straight ahead, dark inside.
/// let star = AnisotropicSurfaceEmitter::new(|slice, cosine, back_face, radiance| {
///     assert_eq!(slice.bins, radiance.len());
///     radiance.fill(if back_face { 0.0 } else { 0.4 + 0.6 * cosine });
/// });
/// let mut world = World::new();
/// world.add(Sphere::new(1.0)?.material(star))?;
/// let ray = |x| Ray::new(Point3D::new(x, 0.0, -5.0), Vector3D::Z).spectrum(500.0, 501.0, 1);
/// assert!((ray(0.0).trace(&world)?.samples()[0] - 1.0).abs() < 1e-12);
/// assert!((ray(0.6).trace(&world)?.samples()[0] - 0.88).abs() < 1e-12);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct AnisotropicSurfaceEmitter {
    emission: Box<Emission>,
    importance: f64,
}

impl AnisotropicSurfaceEmitter {
    /// From a function that is given the bins, the cosine of the angle between normal and emitted light (0 … 1), and
    /// whether that is the back: the inside of a solid, the side away from its normal of a sheet. It writes the
    /// radiance [W/m²/sr/nm] of each bin.
    pub fn new(emission: impl Fn(&Slice, f64, bool, &mut [f64]) + Send + Sync + 'static) -> Self {
        Self { emission: Box::new(emission), importance: 1.0 }
    }

    /// How much paths are to be aimed at it, relative to others; 0 for not at all.
    pub fn importance(self, importance: f64) -> Self {
        Self { importance, ..self }
    }
}

impl fmt::Debug for AnisotropicSurfaceEmitter {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "AnisotropicSurfaceEmitter of importance {}", self.importance)
    }
}

impl Material for AnisotropicSurfaceEmitter {
    fn emit(&self, hit: &SurfaceHit, at: Context<'_>, out: &mut [f64]) -> bool {
        (self.emission)(at.slice, hit.cosine(), hit.is_inside(), out);
        true
    }

    fn surface(&self, _: &SurfaceHit, _: &mut Path<'_>) -> Scatter {
        Scatter::Absorbed
    }

    fn facts(&self) -> Facts {
        Facts { importance: self.importance, ..Facts::emitter("AnisotropicSurfaceEmitter").without_index() }
    }
}
