use raysect_core::save::{SaveError, Saved, SceneWriter};
use raysect_math::sampling::uniforms;
use raysect_math::{Rng, Vector3D};

use super::ggx::{Ggx, Masking};
use crate::material::conductor::Metal;
use crate::material::{Bsdf, Context, Facts, FresnelLaw, IndexUse, Material, Scatter, SurfaceHit};
use crate::{OpticalError, Path, Slice, SpectralTable};

/// A rough metal: a surface of small mirrors in the GGX distribution, whose normals are drawn as they are seen.
///
/// Light that is reflected more than once between the facets is lost, as in Raysect: a lossless surface of roughness
/// 0.1, 0.3 and 1 returns 0.988, 0.877 and 0.307 of what arrives along its normal. For roughness → 0 it becomes a
/// [`Conductor`](crate::Conductor).
#[derive(Debug, Clone)]
pub struct RoughConductor {
    metal: Metal,
    facets: Ggx,
}

impl RoughConductor {
    /// Of a refractive index n, an extinction k, as functions of the wavelength, and a roughness above 0, at most 1:
    /// the parameter α of the distribution itself.
    ///
    /// # Errors
    /// [`OpticalError::Math`] for another roughness.
    pub fn new(
        index: impl Into<SpectralTable>,
        extinction: impl Into<SpectralTable>,
        roughness: f64,
    ) -> Result<Self, OpticalError> {
        Ok(Self { metal: Metal::new(index, extinction), facets: Ggx::new(roughness)? })
    }

    /// With another law of reflection.
    pub fn fresnel(mut self, law: FresnelLaw) -> Self {
        self.metal.law = law;
        self
    }

    /// With another masking.
    pub fn masking(mut self, masking: Masking) -> Self {
        self.facets.masking = masking;
        self
    }

    /// The refractive index n.
    pub fn index(&self) -> &SpectralTable {
        &self.metal.index
    }

    /// The extinction k.
    pub fn extinction(&self) -> &SpectralTable {
        &self.metal.extinction
    }

    /// The roughness.
    pub fn roughness(&self) -> f64 {
        self.facets.roughness()
    }
}

/// The facet that reflects one direction into another, if it is one that the first direction sees.
#[inline]
fn reflecting(incoming: Vector3D, outgoing: Vector3D) -> Option<Vector3D> {
    super::facet(incoming + outgoing).filter(|m| m.z > 0.0 && m.dot(incoming) > 0.0)
}

impl Bsdf for RoughConductor {
    #[inline]
    fn sample(&self, incoming: Vector3D, _: Context<'_>, rng: &mut Rng) -> Vector3D {
        let m = self.facets.sample_visible(incoming, uniforms(rng));
        super::mirror(incoming, m)
    }

    /// It counts the directions below the surface that facets reflect into, where nothing goes on.
    #[inline]
    fn pdf(&self, incoming: Vector3D, outgoing: Vector3D, _: Context<'_>) -> f64 {
        reflecting(incoming, outgoing)
            .map_or(0.0, |m| 0.25 * self.facets.visible(incoming) * self.facets.distribution(m))
    }

    #[inline]
    fn evaluate(&self, incoming: Vector3D, outgoing: Vector3D, at: Context<'_>, out: &mut [f64]) {
        let facet = reflecting(incoming, outgoing).filter(|_| incoming.z >= 0.0 && outgoing.z > 0.0);
        let Some(m) = facet else { return out.fill(0.0) };
        out.fill(0.25 * self.facets.distribution(m) * self.facets.reflected(incoming, outgoing));
        self.metal.reflect(m.dot(incoming).min(1.0), at, out);
    }
}

impl Material for RoughConductor {
    fn surface(&self, hit: &SurfaceHit, path: &mut Path<'_>) -> Scatter {
        path.scatter(self, hit)
    }

    fn facts(&self) -> Facts {
        Facts { index_use: IndexUse::EachBin, ..Facts::named("RoughConductor") }
    }

    fn check(&self, slice: &Slice) -> Result<(), OpticalError> {
        self.metal.check(slice)
    }

    fn save(&self, writer: &mut SceneWriter) -> Result<Saved, SaveError> {
        let saved = Saved::new("RoughConductor")
            .number("roughness", self.facets.roughness())
            .text("masking", self.facets.masking_name());
        self.metal.save(saved, writer)
    }
}
