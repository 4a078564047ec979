use std::fmt;

use raysect_core::Ray;
use raysect_math::{MathError, Point3D};

use super::inhomogeneous::check_length;
use super::{UniformVolume, volume_facts};
use crate::material::{
    Coefficients, Facts, Material, Medium, MediumPoint, PhaseFunction, Scatter, Structure, SurfaceHit,
};
use crate::{Context, OpticalError, Path, Slice};

/// Distances along a ray at which something jumps.
type Breaks = dyn Fn(&Ray, &mut Vec<f64>) + Send + Sync;

/// A volume whose emission, absorption and scattering all follow one density: a cloud, a plume, a plasma.
///
/// Coefficients are those of a [`UniformVolume`] times a function of the place [m] in the space of the shape. Scattering
/// is by delta tracking, which needs a bound on the density.
#[doc(alias("Discrete3DMesh", "tetrahedral emission"))]
pub struct ProfileVolume<F> {
    uniform: UniformVolume,
    density: F,
    largest: f64,
    length_scale: f64,
    breaks: Option<Box<Breaks>>,
}

impl<F> fmt::Debug for ProfileVolume<F> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "ProfileVolume of {:?}, changing over {} m", self.uniform, self.length_scale)
    }
}

impl<F: Fn(Point3D) -> f64 + Send + Sync + 'static> ProfileVolume<F> {
    /// Of the coefficients at density one, a density between 0 and `largest`, and the shortest length over which it
    /// changes [m].
    ///
    /// # Errors
    /// [`MathError::OutOfRange`] unless the bound and the length are positive and finite.
    pub fn new(
        uniform: UniformVolume,
        density: F,
        largest: f64,
        length_scale: f64,
    ) -> Result<Self, OpticalError> {
        let admitted = largest > 0.0 && largest.is_finite();
        MathError::check(admitted, largest, "largest density of a volume", "", "positive and finite")?;
        check_length(length_scale, "length scale of a volume")?;
        Ok(Self { uniform, density, largest, length_scale, breaks: None })
    }

    /// With a function that adds the distances at which the density jumps along a ray in the space of the shape; see
    /// [`Medium::breakpoints`].
    pub fn breaks(self, breaks: impl Fn(&Ray, &mut Vec<f64>) + Send + Sync + 'static) -> Self {
        Self { breaks: Some(Box::new(breaks)), ..self }
    }
}

impl<F: Fn(Point3D) -> f64 + Send + Sync + 'static> Material for ProfileVolume<F> {
    fn surface(&self, _: &SurfaceHit, _: &mut Path<'_>) -> Scatter {
        Scatter::PassThrough
    }

    fn medium(&self) -> Option<&dyn Medium> {
        Some(self)
    }

    fn facts(&self) -> Facts {
        let importance = self.uniform.facts().importance;
        Facts { name: "ProfileVolume".to_owned(), ..volume_facts::<Self>(importance) }
    }

    fn check(&self, slice: &Slice) -> Result<(), OpticalError> {
        self.uniform.check(slice)
    }
}

impl<F: Fn(Point3D) -> f64 + Send + Sync + 'static> Medium for ProfileVolume<F> {
    fn structure(&self) -> Structure {
        Structure::Smooth { length_scale: self.length_scale }
    }

    fn breakpoints(&self, ray: &Ray, out: &mut Vec<f64>) {
        if let Some(breaks) = &self.breaks {
            breaks(ray, out);
        }
    }

    fn coefficients(&self, at: &MediumPoint<'_>, out: &mut Coefficients<'_>) {
        let density = (self.density)(at.local_point());
        if density != 0.0 {
            self.uniform.add(density, at, out);
        }
    }

    fn phase_function(&self) -> Option<&dyn PhaseFunction> {
        self.uniform.phase_function()
    }

    fn majorant(&self, at: Context<'_>) -> f64 {
        self.largest * self.uniform.largest_attenuation(at.slice)
    }
}
