//! Materials with a mistake each, that the judge has to find; without one they are right.

use std::f64::consts::{FRAC_1_PI, PI, TAU};

use raysect::math::sampling::{hemisphere, uniforms};
use raysect::math::{Rng, Vector3D};
use raysect::optical::{
    Bsdf, Coefficients, Context, Material, Medium, MediumPoint, Path, Refraction, Scatter, SurfaceHit,
};

/// What may be wrong with a diffuse surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum DiffuseFault {
    None,
    /// The cosine of the outgoing direction is forgotten.
    NoCosine,
    /// ρ instead of ρ/π.
    NoPi,
    /// It reflects everything.
    NoReflectivity,
    /// The density of another way of sampling is claimed.
    UniformDensity,
    /// Directions are sampled uniformly, but the density of the cosine is claimed.
    UniformSamples,
}

/// A diffuse surface, possibly wrong.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Diffuse {
    pub(crate) reflectivity: f64,
    pub(crate) fault: DiffuseFault,
}

impl Bsdf for Diffuse {
    fn sample(&self, _: Vector3D, _: Context<'_>, rng: &mut Rng) -> Vector3D {
        let u = uniforms(rng);
        match self.fault {
            DiffuseFault::UniformSamples => hemisphere::sample_uniform(u),
            _ => hemisphere::sample_cosine(u),
        }
    }

    fn pdf(&self, _: Vector3D, outgoing: Vector3D, _: Context<'_>) -> f64 {
        match self.fault {
            DiffuseFault::UniformDensity if outgoing.z > 0.0 => 1.0 / TAU,
            _ => outgoing.z.max(0.0) * FRAC_1_PI,
        }
    }

    fn evaluate(&self, _: Vector3D, outgoing: Vector3D, _: Context<'_>, out: &mut [f64]) {
        let right = self.reflectivity * FRAC_1_PI * outgoing.z.max(0.0);
        out.fill(match self.fault {
            DiffuseFault::NoCosine if outgoing.z > 0.0 => right / outgoing.z,
            DiffuseFault::NoPi => right * PI,
            DiffuseFault::NoReflectivity => right / self.reflectivity,
            _ => right,
        });
    }
}

impl Material for Diffuse {
    fn surface(&self, hit: &SurfaceHit, path: &mut Path<'_>) -> Scatter {
        path.scatter(self, hit)
    }
}

/// What may be wrong with glass.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum GlassFault {
    None,
    /// Radiance is kept at refraction, instead of L/n².
    NoSquaredIndex,
    /// The square of the reflectance.
    SquaredReflectance,
    /// The reflectance for normal incidence at every angle.
    NormalReflectance,
    /// No attenuation inside.
    NoAttenuation,
}

/// Glass of index 1.5 with emission [W/m³/sr/nm] and attenuation [1/m], possibly wrong.
#[derive(Debug)]
pub(crate) struct Glass {
    refraction: Refraction,
    emission: f64,
    attenuation: f64,
    fault: GlassFault,
}

impl Glass {
    /// From emission, transmission per metre, and what is wrong with it.
    pub(crate) fn new(emission: f64, transmission: f64, fault: GlassFault) -> Self {
        let refraction = Refraction { index: 1.5.into(), external_index: 1.0.into(), priority: 0 };
        Self { refraction, emission, attenuation: -transmission.ln(), fault }
    }

    /// Unpolarised reflectance from the cosines on both sides, by Fresnel's amplitudes.
    fn reflectance(&self, near: (f64, f64), far: (f64, f64)) -> f64 {
        let (near, far) = match self.fault {
            GlassFault::NormalReflectance => ((near.0, 1.0), (far.0, 1.0)),
            _ => (near, far),
        };
        let s = (near.0 * near.1 - far.0 * far.1) / (near.0 * near.1 + far.0 * far.1);
        let p = (far.0 * near.1 - near.0 * far.1) / (far.0 * near.1 + near.0 * far.1);
        let reflectance = 0.5 * (s * s + p * p);
        if self.fault == GlassFault::SquaredReflectance { reflectance * reflectance } else { reflectance }
    }
}

impl Material for Glass {
    fn surface(&self, hit: &SurfaceHit, path: &mut Path<'_>) -> Scatter {
        let (near, far) = (path.context().index_in, path.context().index_out);
        let (ratio, cosine) = (near / far, hit.cosine());
        let squared = 1.0 - ratio * ratio * (1.0 - cosine * cosine);
        if squared <= 0.0 {
            return Scatter::Continue { direction: hit.mirrored() };
        }
        let refracted = squared.sqrt();
        let reflectance = self.reflectance((near, cosine), (far, refracted));
        if path.rng().probability(reflectance) {
            return Scatter::Continue { direction: hit.mirrored() };
        }
        if self.fault != GlassFault::NoSquaredIndex {
            path.scale(ratio * ratio);
        }
        let normal = hit.normal().as_vector();
        let direction = hit.direction * ratio + normal * (ratio * cosine - refracted);
        Scatter::Continue { direction: direction.normalise().unwrap() }
    }

    fn medium(&self) -> Option<&dyn Medium> {
        Some(self)
    }
}

impl Medium for Glass {
    fn refraction(&self) -> Option<&Refraction> {
        Some(&self.refraction)
    }

    fn coefficients(&self, _: &MediumPoint<'_>, out: &mut Coefficients<'_>) {
        out.emission.iter_mut().for_each(|e| *e += self.emission);
        if self.fault != GlassFault::NoAttenuation {
            out.attenuation.iter_mut().for_each(|a| *a += self.attenuation);
        }
    }
}
