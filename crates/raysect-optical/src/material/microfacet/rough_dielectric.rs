use raysect_core::save::{SaveError, Saved, SceneWriter};
use raysect_math::sampling::uniforms;
use raysect_math::{Rng, Vector3D};

use super::ggx::{Ggx, Masking};
use crate::material::dielectric::fresnel;
use crate::material::{Bsdf, Context, Dielectric, Facts, IndexUse, Material, Medium, Scatter, SurfaceHit};
use crate::{OpticalError, Path, Slice, SpectralTable};

/// A transparent solid with a rough surface, like ground glass: facets in the GGX distribution that reflect and
/// refract (B. Walter et al., *Microfacet Models for Refraction through Rough Surfaces*, EGSR 2007).
///
/// Inside it is a [`Dielectric`], with the same rules for overlapping solids, and radiance changes by the square of
/// the ratio of the indices. Light that meets more than one facet at once is lost. For roughness → 0 it becomes a
/// [`Dielectric`]. Where its index depends on the wavelength paths carry all their bins through it, each with the index
/// of its own wavelength (see [`Dispersion`](crate::Dispersion)).
#[derive(Debug, Clone)]
pub struct RoughDielectric {
    smooth: Dielectric,
    facets: Ggx,
}

impl RoughDielectric {
    /// Of a refractive index and a transmission per metre (0 … 1), as functions of the wavelength, and a roughness
    /// above 0, at most 1: the parameter α of the distribution. No path is aimed at it.
    ///
    /// # Errors
    /// [`OpticalError::Math`] for another roughness; a range in which the index is not positive is refused when it
    /// is observed.
    pub fn new(
        index: impl Into<SpectralTable>,
        transmission: impl Into<SpectralTable>,
        roughness: f64,
    ) -> Result<Self, OpticalError> {
        let smooth = Dielectric::new(index, transmission)?.named("RoughDielectric").importance(0.0);
        Self::of(smooth, roughness)
    }

    /// A dielectric with its surface roughened; index outside, priority and importance are its own. Importance above 0
    /// makes paths noisier that scatter at the rough surface itself, since a share of them is aimed back into the solid.
    ///
    /// ```
    /// use raysect_optical::{RoughDielectric, library::schott};
    /// let ground = RoughDielectric::of(schott("N-BK7")?, 0.2)?;
    /// assert_eq!(ground.roughness(), 0.2);
    /// # Ok::<(), raysect_optical::OpticalError>(())
    /// ```
    ///
    /// What meets the surface is reflected or refracted: [`transmission_only`](Dielectric::transmission_only) has no
    /// effect.
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn of(smooth: Dielectric, roughness: f64) -> Result<Self, OpticalError> {
        Ok(Self { smooth, facets: Ggx::new(roughness)? })
    }

    /// With another masking of what is reflected.
    pub fn masking(mut self, masking: Masking) -> Self {
        self.facets.masking = masking;
        self
    }

    /// What it is made of.
    pub fn smooth(&self) -> &Dielectric {
        &self.smooth
    }

    /// The roughness.
    pub fn roughness(&self) -> f64 {
        self.facets.roughness()
    }
}

/// Reflectance of a facet and the cosine of refraction, which is 0 for total reflection.
#[inline]
fn split(cosine: f64, at: Context<'_>) -> (f64, f64) {
    fresnel(cosine.min(1.0), at.index_in, at.index_out).unwrap_or((1.0, 0.0))
}

/// The facet that reflects one direction into another, with the cosine to it.
#[inline]
fn reflecting(incoming: Vector3D, outgoing: Vector3D) -> Option<(Vector3D, f64)> {
    let m = super::facet(incoming + outgoing)?;
    let cosine = m.dot(incoming);
    (m.z > 0.0 && cosine > 0.0).then_some((m, cosine))
}

/// The facet that refracts one direction into another, with the cosine to it and the density of outgoing directions
/// for one of facets: the Jacobian of Walter et al. 2007, eq. 17.
#[inline]
fn refracting(incoming: Vector3D, outgoing: Vector3D, at: Context<'_>) -> Option<(Vector3D, f64, f64)> {
    let m = super::facet(incoming * at.index_in + outgoing * at.index_out)?;
    let m = if m.z < 0.0 { -m } else { m };
    let (near, far) = (m.dot(incoming), m.dot(outgoing));
    if near <= 0.0 || far >= 0.0 {
        return None;
    }
    let sum = at.index_in * near + at.index_out * far;
    let jacobian = at.index_out * at.index_out * -far / (sum * sum);
    Some((m, near, jacobian))
}

impl Bsdf for RoughDielectric {
    #[inline]
    fn sample(&self, incoming: Vector3D, at: Context<'_>, rng: &mut Rng) -> Vector3D {
        let m = self.facets.sample_visible(incoming, uniforms(rng));
        let cosine = incoming.dot(m);
        let (reflectance, refracted) = split(cosine, at);
        if rng.probability(reflectance) {
            return super::mirror(incoming, m);
        }
        let ratio = at.index_in / at.index_out;
        (m * (ratio * cosine - refracted) - incoming * ratio).normalise_unchecked()
    }

    /// It counts the directions on the wrong side that facets reflect or refract into, where nothing goes on.
    fn pdf(&self, incoming: Vector3D, outgoing: Vector3D, at: Context<'_>) -> f64 {
        let mut sum = 0.0;
        if let Some((m, cosine)) = reflecting(incoming, outgoing) {
            sum += 0.25 * self.facets.distribution(m) * split(cosine, at).0;
        }
        if let Some((m, cosine, jacobian)) = refracting(incoming, outgoing, at) {
            sum += self.facets.distribution(m) * (1.0 - split(cosine, at).0) * cosine * jacobian;
        }
        sum * self.facets.visible(incoming)
    }

    fn evaluate(&self, incoming: Vector3D, outgoing: Vector3D, at: Context<'_>, out: &mut [f64]) {
        let value = if incoming.z < 0.0 {
            0.0
        } else if outgoing.z > 0.0 {
            reflecting(incoming, outgoing).map_or(0.0, |(m, cosine)| {
                let masking = self.facets.reflected(incoming, outgoing);
                0.25 * self.facets.distribution(m) * split(cosine, at).0 * masking
            })
        } else {
            refracting(incoming, outgoing, at).map_or(0.0, |(m, cosine, jacobian)| {
                let ratio = at.index_in / at.index_out;
                let through = (1.0 - split(cosine, at).0) * ratio * ratio;
                let masking = self.facets.product(incoming, outgoing);
                self.facets.distribution(m) * through * cosine * jacobian * masking
            })
        };
        out.fill(value);
    }
}

impl Material for RoughDielectric {
    fn surface(&self, hit: &SurfaceHit, path: &mut Path<'_>) -> Scatter {
        let at = path.context();
        // Between equal indices there is no surface, and no facet could be told from the directions.
        if at.index_in == at.index_out { Scatter::PassThrough } else { path.scatter(self, hit) }
    }

    fn medium(&self) -> Option<&dyn Medium> {
        self.smooth.medium()
    }

    fn facts(&self) -> Facts {
        Facts { index_use: IndexUse::EachBin, ..self.smooth.facts() }
    }

    fn check(&self, slice: &Slice) -> Result<(), OpticalError> {
        self.smooth.check(slice)
    }

    fn save(&self, writer: &mut SceneWriter) -> Result<Saved, SaveError> {
        let saved = Saved::new("RoughDielectric")
            .number("roughness", self.facets.roughness())
            .text("masking", self.facets.masking_name());
        self.smooth.save_into(saved, writer)
    }
}
