use std::fmt;
use std::sync::Arc;

use raysect_core::save::{SaveError, Saved, SceneWriter};
use raysect_math::MathError;

use super::volume_facts;
use crate::material::{
    Coefficients, Facts, Material, Medium, MediumPoint, PhaseFunction, Scatter, SurfaceHit,
};
use crate::{Context, OpticalError, Path, Slice, SpectralTable};

/// A volume of constant emission, absorption and scattering, behind a surface that lets everything pass.
///
/// What is not given is not there and costs nothing. Emission and attenuation along a ray are exact; scattering is by
/// random free flights.
///
/// ```
/// use raysect_math::{Point3D, Vector3D};
/// use raysect_optical::{Ray, UniformVolume, WithMaterial, World};
/// # use raysect_primitive::Sphere;
/// let mut world = World::new();
/// world.add(Sphere::new(1.0)?.material(UniformVolume::emitter(3.0).absorption(0.5)))?;
/// let ray = Ray::new(Point3D::new(0.0, 0.0, -5.0), Vector3D::Z).spectrum(500.0, 501.0, 1);
/// // j (1 − exp(−α s)) / α over the 2 m of the diameter.
/// let expected = 3.0 * (1.0 - (-1.0f64).exp()) / 0.5;
/// assert!((ray.trace(&world)?.samples()[0] - expected).abs() < 1e-12);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[doc(alias("UniformVolumeEmitter", "UnityVolumeEmitter"))]
#[derive(Clone)]
pub struct UniformVolume {
    emission: Option<SpectralTable>,
    absorption: Option<SpectralTable>,
    scattering: Option<(SpectralTable, Arc<dyn PhaseFunction>)>,
    importance: f64,
}

impl fmt::Debug for UniformVolume {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let scattering = self.scattering.as_ref().map(|s| &s.0);
        write!(f, "UniformVolume {:?} {:?} {scattering:?}", self.emission, self.absorption)
    }
}

impl UniformVolume {
    /// An empty volume.
    pub fn new() -> Self {
        Self { emission: None, absorption: None, scattering: None, importance: 0.0 }
    }

    /// A volume that emits [W/m³/sr/nm], of importance 1. With an emission of 1 it is Raysect's `UnityVolumeEmitter`.
    pub fn emitter(emission: impl Into<SpectralTable>) -> Self {
        Self { importance: 1.0, ..Self::new() }.emission(emission)
    }

    /// With an emission [W/m³/sr/nm].
    pub fn emission(self, emission: impl Into<SpectralTable>) -> Self {
        Self { emission: Some(emission.into()), ..self }
    }

    /// With an absorption coefficient [1/m].
    pub fn absorption(self, absorption: impl Into<SpectralTable>) -> Self {
        Self { absorption: Some(absorption.into()), ..self }
    }

    /// With a scattering coefficient [1/m], and how the scattered light is distributed.
    pub fn scattering(
        self,
        scattering: impl Into<SpectralTable>,
        phase: impl PhaseFunction + 'static,
    ) -> Self {
        self.shared_scattering(scattering.into(), Arc::new(phase))
    }

    pub(crate) fn shared_scattering(self, scattering: SpectralTable, phase: Arc<dyn PhaseFunction>) -> Self {
        Self { scattering: Some((scattering, phase)), ..self }
    }

    /// How much paths are to be aimed at it, relative to others; 0 for not at all.
    pub fn importance(self, importance: f64) -> Self {
        Self { importance, ..self }
    }

    /// Adds its coefficients times a factor.
    pub(super) fn add(&self, factor: f64, at: &MediumPoint<'_>, out: &mut Coefficients<'_>) {
        let slice = at.at.slice;
        let add = |out: &mut [f64], table: &SpectralTable| {
            out.iter_mut().zip(slice.table(table)).for_each(|(o, t)| *o += factor * t);
        };
        if let Some(emission) = &self.emission {
            add(out.emission, emission);
        }
        if let Some(absorption) = &self.absorption {
            add(out.attenuation, absorption);
        }
        if let Some((scattering, _)) = &self.scattering {
            add(out.scattering, scattering);
            add(out.attenuation, scattering);
        }
    }

    /// The largest attenuation of any bin [1/m].
    pub(super) fn largest_attenuation(&self, slice: &Slice) -> f64 {
        let of = |table: Option<&SpectralTable>, i: usize| table.map_or(0.0, |t| slice.table(t)[i]);
        let scattering = self.scattering.as_ref().map(|s| &s.0);
        (0..slice.bins).map(|i| of(self.absorption.as_ref(), i) + of(scattering, i)).fold(0.0, f64::max)
    }
}

impl Default for UniformVolume {
    fn default() -> Self {
        Self::new()
    }
}

impl Material for UniformVolume {
    fn surface(&self, _: &SurfaceHit, _: &mut Path<'_>) -> Scatter {
        Scatter::PassThrough
    }

    fn medium(&self) -> Option<&dyn Medium> {
        Some(self)
    }

    fn facts(&self) -> Facts {
        volume_facts::<Self>(self.importance)
    }

    fn check(&self, slice: &Slice) -> Result<(), OpticalError> {
        let scattering = self.scattering.as_ref().map(|s| &s.0);
        let known = [(&self.absorption.as_ref(), "absorption"), (&scattering, "scattering")];
        for (table, name) in known {
            for &value in table.map(|t| slice.table(t)).unwrap_or_default() {
                MathError::check(value >= 0.0, value, name, "1/m", "0 or more")?;
            }
        }
        for &value in self.emission.as_ref().map(|t| slice.table(t)).unwrap_or_default() {
            MathError::check(value.is_finite(), value, "emission", "W/m³/sr/nm", "finite")?;
        }
        Ok(())
    }

    fn save(&self, writer: &mut SceneWriter) -> Result<Saved, SaveError> {
        let mut saved = Saved::new("UniformVolume").number("importance", self.importance);
        for (name, table) in [("emission", &self.emission), ("absorption", &self.absorption)] {
            if let Some(table) = table {
                saved = saved.reference(name, writer.object(table)?);
            }
        }
        if let Some((scattering, phase)) = &self.scattering {
            saved = saved.reference("scattering", writer.object(scattering)?);
            saved = saved.reference("phase", writer.shared_object(phase)?);
        }
        Ok(saved)
    }
}

impl Medium for UniformVolume {
    fn coefficients(&self, at: &MediumPoint<'_>, out: &mut Coefficients<'_>) {
        self.add(1.0, at, out);
    }

    fn phase_function(&self) -> Option<&dyn PhaseFunction> {
        self.scattering.as_ref().map(|(_, phase)| &**phase)
    }

    fn majorant(&self, at: Context<'_>) -> f64 {
        self.largest_attenuation(at.slice)
    }
}
