//! Materials that are wrong on purpose: whoever judges must find them.

use std::f64::consts::{FRAC_1_PI, PI, TAU};

use clap::ValueEnum;
use raysect::math::sampling::{hemisphere, uniforms};
use raysect::math::{Rng, Vector3D};
use raysect::optical::{Bsdf, Context, Dielectric, Material, Medium, Path, Scatter, SurfaceHit};

/// What may be wrong.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum Fault {
    /// Diffuse surfaces forget the cosine of the outgoing direction.
    Cosine,
    /// Diffuse surfaces scatter ρ instead of ρ/π.
    Pi,
    /// Diffuse surfaces claim the density of uniform directions.
    Density,
    /// Diffuse surfaces end a tenth of the paths, and the others do not carry their share.
    Roulette,
    /// Glass reflects the square of Fresnel's reflectance.
    Fresnel,
}

/// A diffuse surface with a mistake.
#[derive(Debug)]
pub(super) struct WrongDiffuse {
    pub(super) reflectivity: f64,
    pub(super) fault: Fault,
}

impl Bsdf for WrongDiffuse {
    fn sample(&self, _: Vector3D, _: Context<'_>, rng: &mut Rng) -> Vector3D {
        hemisphere::sample_cosine(uniforms(rng))
    }

    fn pdf(&self, _: Vector3D, outgoing: Vector3D, _: Context<'_>) -> f64 {
        match self.fault {
            Fault::Density if outgoing.z > 0.0 => 1.0 / TAU,
            _ => outgoing.z.max(0.0) * FRAC_1_PI,
        }
    }

    fn evaluate(&self, _: Vector3D, outgoing: Vector3D, _: Context<'_>, out: &mut [f64]) {
        let right = self.reflectivity * FRAC_1_PI * outgoing.z.max(0.0);
        out.fill(match self.fault {
            Fault::Cosine if outgoing.z > 0.0 => self.reflectivity * FRAC_1_PI,
            Fault::Pi => right * PI,
            _ => right,
        });
    }
}

impl Material for WrongDiffuse {
    fn surface(&self, hit: &SurfaceHit, path: &mut Path<'_>) -> Scatter {
        if self.fault == Fault::Roulette && path.rng().probability(0.1) {
            return Scatter::Absorbed;
        }
        path.scatter(self, hit)
    }
}

/// Glass that reflects the square of what it should.
#[derive(Debug)]
pub(super) struct WrongGlass(pub(super) Dielectric);

impl Material for WrongGlass {
    fn surface(&self, hit: &SurfaceHit, path: &mut Path<'_>) -> Scatter {
        let (near, far) = (path.context().index_in, path.context().index_out);
        let (ratio, cosine) = (near / far, hit.cosine());
        let squared = 1.0 - ratio * ratio * (1.0 - cosine * cosine);
        if squared <= 0.0 {
            return Scatter::Continue { direction: hit.mirrored() };
        }
        let refracted = squared.sqrt();
        let s = (near * cosine - far * refracted) / (near * cosine + far * refracted);
        let p = (far * cosine - near * refracted) / (far * cosine + near * refracted);
        let reflectance = 0.5 * (s * s + p * p);
        if path.rng().probability(reflectance * reflectance) {
            return Scatter::Continue { direction: hit.mirrored() };
        }
        path.scale(ratio * ratio);
        let direction = hit.direction * ratio + hit.normal().as_vector() * (ratio * cosine - refracted);
        Scatter::Continue { direction: direction.normalise().unwrap_or(hit.direction) }
    }

    fn medium(&self) -> Option<&dyn Medium> {
        self.0.medium()
    }
}
