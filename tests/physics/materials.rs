//! Materials that a user might write, for what the library has no ready one.

use raysect::optical::{
    Coefficients, Context, Dielectric, Facts, Lambert, Material, Medium, MediumPoint, Path, Refraction,
    Scatter, SurfaceHit,
};

/// A Lambert surface that emits a radiance of one as well.
pub(crate) struct GlowingLambert(pub(crate) Lambert);

impl Material for GlowingLambert {
    fn emit(&self, _: &SurfaceHit, _: Context<'_>, out: &mut [f64]) -> bool {
        out.fill(1.0);
        true
    }
    fn surface(&self, hit: &SurfaceHit, path: &mut Path<'_>) -> Scatter {
        path.scatter(&self.0, hit)
    }
    fn facts(&self) -> Facts {
        Facts { emits: true, importance: 1.0, ..Facts::named("glowing Lambert") }
    }
}

/// A volume that emits [W/m³/sr/nm] and attenuates [1/m] behind a surface that does nothing.
pub(crate) struct Fog {
    pub(crate) emission: f64,
    pub(crate) attenuation: f64,
}

impl Fog {
    /// That emits one and lets everything through.
    pub(crate) fn bright() -> Self {
        Self { emission: 1.0, attenuation: 0.0 }
    }

    /// Dark, of a transmission per metre.
    pub(crate) fn dark(transmission: f64) -> Self {
        Self { emission: 0.0, attenuation: -transmission.ln() }
    }
}

impl Material for Fog {
    fn surface(&self, _: &SurfaceHit, _: &mut Path<'_>) -> Scatter {
        Scatter::PassThrough
    }
    fn medium(&self) -> Option<&dyn Medium> {
        Some(self)
    }
    fn facts(&self) -> Facts {
        let importance = if self.emission > 0.0 { 1.0 } else { 0.0 };
        Facts { transparent: true, importance, ..Facts::named("fog") }
    }
}

impl Medium for Fog {
    fn coefficients(&self, _: &MediumPoint<'_>, out: &mut Coefficients<'_>) {
        out.emission.iter_mut().for_each(|e| *e += self.emission);
        out.attenuation.iter_mut().for_each(|a| *a += self.attenuation);
    }
}

/// Lossless glass of index 1.5 that emits one in its volume.
pub(crate) struct GlowingGlass(pub(crate) Dielectric);

impl GlowingGlass {
    pub(crate) fn new() -> Self {
        Self(Dielectric::new(1.5, 1.0).unwrap())
    }
}

impl Material for GlowingGlass {
    fn surface(&self, hit: &SurfaceHit, path: &mut Path<'_>) -> Scatter {
        self.0.surface(hit, path)
    }
    fn medium(&self) -> Option<&dyn Medium> {
        Some(self)
    }
}

impl Medium for GlowingGlass {
    fn refraction(&self) -> Option<&Refraction> {
        self.0.refraction()
    }
    fn coefficients(&self, _: &MediumPoint<'_>, out: &mut Coefficients<'_>) {
        out.emission.iter_mut().for_each(|e| *e += 1.0);
    }
}

/// A screen with fine holes: lets a share of the rays pass straight on and absorbs the others.
pub(crate) struct Screen(pub(crate) f64);

impl Material for Screen {
    fn surface(&self, _: &SurfaceHit, path: &mut Path<'_>) -> Scatter {
        if path.rng().probability(self.0) { Scatter::PassThrough } else { Scatter::Absorbed }
    }
}
