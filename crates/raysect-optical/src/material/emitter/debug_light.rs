use raysect_core::save::{SaveError, Saved, SceneWriter};
use raysect_math::{MathError, Vector3D};

use crate::material::{Context, Facts, Material, Scatter, SurfaceHit};
use crate::{OpticalError, Path, SpectralTable, colour};

/// Shades a shape as a matt body under a distant light without shadows: for looking at shapes, not for physics.
///
/// Its radiance is intensity × spectrum × max(0, −d·n), for light that travels along d on a surface of normal n, on
/// the outer side alone; it reflects nothing.
#[doc(alias = "Light")]
#[derive(Debug, Clone)]
pub struct DebugLight {
    /// As it was given, and of unit length.
    given: Vector3D,
    direction: Vector3D,
    intensity: f64,
    spectrum: SpectralTable,
}

impl DebugLight {
    /// From the direction in which the light travels, of any length, in D65 white of intensity 1.
    ///
    /// # Errors
    /// [`OpticalError::Math`] for a direction without a length.
    pub fn new(direction: Vector3D) -> Result<Self, OpticalError> {
        let spectrum = SpectralTable::new(colour::d65_white());
        Ok(Self { given: direction, direction: direction.normalise()?, intensity: 1.0, spectrum })
    }

    /// With another intensity, a factor of the spectrum.
    ///
    /// # Errors
    /// [`OpticalError::Math`] unless it is finite and not negative.
    pub fn intensity(self, intensity: f64) -> Result<Self, OpticalError> {
        let admitted = intensity >= 0.0 && intensity.is_finite();
        MathError::check(admitted, intensity, "intensity", "", "finite and not negative")?;
        Ok(Self { intensity, ..self })
    }

    /// With another spectrum [W/m²/sr/nm].
    pub fn spectrum(self, spectrum: impl Into<SpectralTable>) -> Self {
        Self { spectrum: spectrum.into(), ..self }
    }
}

impl Material for DebugLight {
    fn emit(&self, hit: &SurfaceHit, at: Context<'_>, out: &mut [f64]) -> bool {
        let cosine = -hit.surface.shading_normal.dot(self.direction);
        if hit.is_inside() || cosine <= 0.0 {
            return false;
        }
        for (out, radiance) in out.iter_mut().zip(at.slice.table(&self.spectrum)) {
            *out = radiance * self.intensity * cosine;
        }
        true
    }

    fn surface(&self, _: &SurfaceHit, _: &mut Path<'_>) -> Scatter {
        Scatter::Absorbed
    }

    fn facts(&self) -> Facts {
        Facts::emitter("DebugLight").without_index()
    }

    fn save(&self, writer: &mut SceneWriter) -> Result<Saved, SaveError> {
        Ok(Saved::new("DebugLight")
            .numbers("direction", &self.given.to_array())
            .number("intensity", self.intensity)
            .reference("spectrum", writer.object(&self.spectrum)?))
    }
}
