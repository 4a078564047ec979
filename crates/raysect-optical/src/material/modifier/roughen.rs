use std::fmt;
use std::sync::Arc;

use raysect_core::save::{SaveError, Saved, SceneWriter};
use raysect_math::sampling::{hemisphere, uniforms};
use raysect_math::{MathError, Normal3D};

use crate::material::{Context, Facts, Material, Medium, Scatter, SurfaceHit};
use crate::{OpticalError, Path, Slice};

/// So often a normal is drawn again that the path would meet from behind, as in Raysect.
const TRIES: usize = 50;

/// So often a path may meet the roughened surface at one place before it is given up.
const BOUNCES: usize = 50;

/// A material whose normal is tilted at random at each hit: the normal of the surface and a diffuse direction, mixed
/// by the roughness.
///
/// A quick blur for any material, after Raysect; it is not reciprocal. A path that such a normal reflects into the
/// solid meets the surface again; one that it refracts back out ends. What the surface emits is that of the base
/// material without any tilt.
///
/// Rough metal and glass are better described by [`RoughConductor`](crate::RoughConductor) and
/// [`RoughDielectric`](crate::RoughDielectric).
#[derive(Clone)]
pub struct Roughen {
    base: Arc<dyn Material>,
    roughness: f64,
}

impl Roughen {
    /// Of a material and a roughness, 0 (none) … 1 (fully diffuse normals).
    ///
    /// # Errors
    /// [`OpticalError::Math`] for another roughness.
    pub fn new(base: Arc<dyn Material>, roughness: f64) -> Result<Self, OpticalError> {
        MathError::check((0.0..=1.0).contains(&roughness), roughness, "roughness", "", "0 … 1")?;
        Ok(Self { base, roughness })
    }

    /// The same hit with a tilted normal.
    fn tilt(&self, hit: &SurfaceHit, path: &mut Path<'_>) -> SurfaceHit {
        let frame = hit.frame();
        let incoming = frame.to_local(-hit.direction);
        for _ in 0..TRIES {
            let diffuse = hemisphere::sample_cosine(uniforms(path.rng()));
            let mut normal = diffuse * self.roughness;
            normal.z += 1.0 - self.roughness;
            if normal.dot(incoming) > 0.0 {
                let outer = if hit.is_inside() { -normal } else { normal };
                let normal = frame.to_world(outer.normalise_unchecked());
                let mut tilted = *hit;
                tilted.surface.shading_normal = Normal3D::new(normal.x, normal.y, normal.z);
                return tilted;
            }
        }
        *hit
    }
}

impl fmt::Debug for Roughen {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.facts().name)
    }
}

impl Material for Roughen {
    fn emit(&self, hit: &SurfaceHit, at: Context<'_>, out: &mut [f64]) -> bool {
        self.base.emit(hit, at, out)
    }

    fn surface(&self, hit: &SurfaceHit, path: &mut Path<'_>) -> Scatter {
        let mut arriving = *hit;
        for _ in 0..BOUNCES {
            let tilted = self.tilt(&arriving, path);
            let scatter = self.base.surface(&tilted, path);
            let Scatter::Continue { direction } = scatter else { return scatter };
            let through = hit.leads_through(direction);
            if through == (tilted.normal().dot(direction) < 0.0) {
                return scatter;
            }
            if !through {
                return Scatter::Absorbed;
            }
            arriving.direction = direction;
        }
        Scatter::Absorbed
    }

    fn medium(&self) -> Option<&dyn Medium> {
        self.base.medium()
    }

    fn facts(&self) -> Facts {
        let base = self.base.facts();
        Facts { name: format!("rough {}", base.name), ..base }
    }

    fn check(&self, slice: &Slice) -> Result<(), OpticalError> {
        self.base.check(slice)
    }

    fn save(&self, writer: &mut SceneWriter) -> Result<Saved, SaveError> {
        let saved = Saved::new("Roughen").reference("base", writer.shared_object(&self.base)?);
        Ok(saved.number("roughness", self.roughness))
    }
}
