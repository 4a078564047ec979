use raysect_core::save::{SaveError, Saved, SceneWriter};
use raysect_math::MathError;

use super::{Context, FresnelLaw, Material, Scatter, SurfaceHit};
use crate::{OpticalError, Path, Slice, SpectralTable};

/// The complex index n + ik of a metal, and the law by which it reflects.
#[derive(Debug, Clone)]
pub(super) struct Metal {
    pub(super) index: SpectralTable,
    pub(super) extinction: SpectralTable,
    pub(super) law: FresnelLaw,
}

/// The laws by the names that files have for them.
pub(crate) const LAWS: [(&str, FresnelLaw); 2] =
    [("exact", FresnelLaw::Exact), ("large index", FresnelLaw::LargeIndex)];

impl Metal {
    pub(super) fn new(index: impl Into<SpectralTable>, extinction: impl Into<SpectralTable>) -> Self {
        Self { index: index.into(), extinction: extinction.into(), law: FresnelLaw::default() }
    }

    /// Multiplies each bin by its reflectance, seen from a medium of index `at.index_in`.
    #[inline]
    pub(super) fn reflect(&self, cosine: f64, at: Context<'_>, bins: &mut [f64]) {
        let tables = at.slice.table(&self.index).iter().zip(at.slice.table(&self.extinction));
        for (bin, (n, k)) in bins.iter_mut().zip(tables) {
            *bin *= self.law.reflectance(cosine, at.index_in, *n, *k);
        }
    }

    pub(super) fn check(&self, slice: &Slice) -> Result<(), OpticalError> {
        let tables = slice.table(&self.index).iter().zip(slice.table(&self.extinction));
        for (&n, &k) in tables {
            let admitted = |x: f64| x >= 0.0 && x.is_finite();
            MathError::check(admitted(n), n, "refractive index of a metal", "", "finite and not negative")?;
            MathError::check(admitted(k), k, "extinction of a metal", "", "finite and not negative")?;
            MathError::check(
                n + k > 0.0,
                n,
                "refractive index of a metal",
                "",
                "above 0 where its extinction is 0",
            )?;
        }
        Ok(())
    }

    pub(super) fn save(&self, saved: Saved, writer: &mut SceneWriter) -> Result<Saved, SaveError> {
        let law = if self.law == LAWS[0].1 { LAWS[0].0 } else { LAWS[1].0 };
        Ok(saved
            .reference("index", writer.object(&self.index)?)
            .reference("extinction", writer.object(&self.extinction)?)
            .text("fresnel", law))
    }
}

/// A smooth opaque metal: a mirror whose reflectance follows from its complex index n + ik, bin by bin.
///
/// ```
/// use raysect_math::{Point3D, Vector3D};
/// use raysect_optical::{Conductor, Ray, UnitySurfaceEmitter, WithMaterial, World};
/// use raysect_primitive::Sphere;
///
/// let mut world = World::new();
/// world.add(Sphere::new(60.0)?.material(UnitySurfaceEmitter::new()))?;
/// world.add(Sphere::new(1.0)?.material(Conductor::new(0.2, 3.3)))?;
/// let ray = Ray::new(Point3D::new(0.0, 0.0, -5.0), Vector3D::Z).spectrum(500.0, 501.0, 1);
/// assert!((ray.trace(&world)?.samples()[0] - 0.935117599351176).abs() < 1e-12);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct Conductor(Metal);

impl Conductor {
    /// Of a refractive index n and an extinction k, as functions of the wavelength. Where they are negative or both
    /// zero they are refused when they are observed.
    pub fn new(index: impl Into<SpectralTable>, extinction: impl Into<SpectralTable>) -> Self {
        Self(Metal::new(index, extinction))
    }

    /// With another law of reflection.
    pub fn fresnel(mut self, law: FresnelLaw) -> Self {
        self.0.law = law;
        self
    }

    /// The refractive index n.
    pub fn index(&self) -> &SpectralTable {
        &self.0.index
    }

    /// The extinction k.
    pub fn extinction(&self) -> &SpectralTable {
        &self.0.extinction
    }
}

impl Material for Conductor {
    fn surface(&self, hit: &SurfaceHit, path: &mut Path<'_>) -> Scatter {
        let at = path.context();
        self.0.reflect(hit.cosine(), at, path.throughput());
        Scatter::Continue { direction: hit.mirrored() }
    }

    fn check(&self, slice: &Slice) -> Result<(), OpticalError> {
        self.0.check(slice)
    }

    fn save(&self, writer: &mut SceneWriter) -> Result<Saved, SaveError> {
        self.0.save(Saved::new("Conductor"), writer)
    }
}
