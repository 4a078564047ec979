use std::fmt;
use std::sync::Arc;

use raysect_core::Ray;
use raysect_core::save::{SaveError, Saved, SceneWriter};
use raysect_math::AffineMatrix3D;

use super::mixture::is_divided;
use crate::material::{
    Coefficients, Context, Facts, Material, Medium, MediumPoint, PhaseFunction, Refraction, Scatter,
    Structure, SurfaceHit, scatters,
};
use crate::{OpticalError, Path, Slice};

/// A material whose volume is moved, turned or stretched within its shape; the surface stays as it is.
///
/// What the volume of the base has at a point p is found at `transform` p. Coefficients stay per metre of the world.
#[derive(Clone)]
pub struct VolumeTransform {
    base: Arc<dyn Material>,
    transform: AffineMatrix3D,
    inverse: AffineMatrix3D,
}

impl fmt::Debug for VolumeTransform {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "VolumeTransform of {}", self.base.facts().name)
    }
}

impl VolumeTransform {
    /// Of a material and a map in the space of the shape.
    ///
    /// # Errors
    /// [`OpticalError::Math`] for a map that has no inverse.
    pub fn new(base: Arc<dyn Material>, transform: AffineMatrix3D) -> Result<Self, OpticalError> {
        Ok(Self { base, transform, inverse: transform.inverse()? })
    }

    /// The map.
    pub fn transform(&self) -> &AffineMatrix3D {
        &self.transform
    }
}

impl Material for VolumeTransform {
    fn emit(&self, hit: &SurfaceHit, at: Context<'_>, out: &mut [f64]) -> bool {
        self.base.emit(hit, at, out)
    }

    fn surface(&self, hit: &SurfaceHit, path: &mut Path<'_>) -> Scatter {
        self.base.surface(hit, path)
    }

    fn medium(&self) -> Option<&dyn Medium> {
        self.base.medium().is_some().then_some(self)
    }

    fn facts(&self) -> Facts {
        self.base.facts()
    }

    fn check(&self, slice: &Slice) -> Result<(), OpticalError> {
        if let Some(medium) = self.base.medium() {
            if scatters(medium) && medium.phase_function().is_none() {
                return Err(OpticalError::Modifier {
                    what: "a scattering mixture cannot be moved; move its parts",
                });
            }
            if is_divided(medium) {
                return Err(OpticalError::Modifier {
                    what: "a mixture of volumes that are integrated by different rules cannot be moved; move its parts",
                });
            }
        }
        self.base.check(slice)
    }

    fn save(&self, writer: &mut SceneWriter) -> Result<Saved, SaveError> {
        let saved = Saved::new("VolumeTransform").reference("base", writer.shared_object(&self.base)?);
        Ok(saved.transform("transform", &self.transform))
    }
}

/// Asked for only where the base has a medium.
impl Medium for VolumeTransform {
    fn refraction(&self) -> Option<&Refraction> {
        self.base.medium()?.refraction()
    }

    fn structure(&self) -> Structure {
        self.base.medium().map(|m| scaled(m.structure(), self.stretch())).unwrap_or_default()
    }

    fn breakpoints(&self, ray: &Ray, out: &mut Vec<f64>) {
        if let Some(medium) = self.base.medium() {
            let origin = self.inverse.transform_point(ray.origin);
            let direction = self.inverse.transform_vector(ray.direction);
            medium.breakpoints(&Ray::new(origin, direction).with_max_distance(ray.max_distance), out);
        }
    }

    fn coefficients(&self, at: &MediumPoint<'_>, out: &mut Coefficients<'_>) {
        if let Some(medium) = self.base.medium() {
            let to_local = self.inverse * *at.to_local;
            medium.coefficients(&MediumPoint { to_local: &to_local, ..*at }, out);
        }
    }

    fn phase_function(&self) -> Option<&dyn PhaseFunction> {
        self.base.medium()?.phase_function()
    }

    fn majorant(&self, at: Context<'_>) -> f64 {
        self.base.medium().map_or(0.0, |m| m.majorant(at))
    }
}

impl VolumeTransform {
    /// By how much lengths shrink at most: a bound by the lengths of the rows of the inverse.
    fn stretch(&self) -> f64 {
        let rows = self.inverse.to_rows();
        let squares: f64 = rows[..3].iter().flat_map(|row| &row[..3]).map(|x| x * x).sum();
        if self.inverse.similarity_scale().is_some() {
            (squares / 3.0).sqrt().recip()
        } else {
            squares.sqrt().recip()
        }
    }
}

/// A structure in a space whose lengths are this many times longer.
fn scaled(structure: Structure, factor: f64) -> Structure {
    match structure {
        Structure::Homogeneous => Structure::Homogeneous,
        Structure::Smooth { length_scale } => Structure::Smooth { length_scale: length_scale * factor },
        Structure::Unknown { step } => Structure::Unknown { step: step * factor },
        Structure::Trapezium { step, points } => Structure::Trapezium { step: step * factor, points },
    }
}
