use std::fmt;

use raysect_core::Ray;
use raysect_math::{MathError, Point3D, Vector3D};

use super::volume_facts;
use crate::material::{Coefficients, Facts, Material, Medium, MediumPoint, Scatter, Structure, SurfaceHit};
use crate::{Context, OpticalError, Path};

/// Distances along a ray at which something jumps.
type Breaks = dyn Fn(&Ray, &mut Vec<f64>) + Send + Sync;

/// A volume whose emission depends on the place, the direction and the wavelength, by a function of the user.
///
/// The function gets the place [m] and the unit vector in which the light travels, both in the space of the shape, and
/// adds its emission [W/m³/sr/nm] to the bins. What cannot be seen from outside is declared: over which lengths it
/// changes ([`length_scale`](Self::length_scale)), or that nothing is known ([`jittered`](Self::jittered)).
///
/// ```
/// use raysect_math::{Point3D, Vector3D};
/// use raysect_optical::{InhomogeneousVolumeEmitter, Ray, WithMaterial, World};
/// # use raysect_primitive::Sphere;
/// // A Gaussian of 5 cm at the centre of a ball of 1 m.
/// let glow = InhomogeneousVolumeEmitter::length_scale(0.05, |p, _, _, bins| {
///     let squared = p.x * p.x + p.y * p.y + p.z * p.z;
///     bins.iter_mut().for_each(|bin| *bin += (-0.5 * squared / 0.0025).exp());
/// })?;
/// let mut world = World::new();
/// world.add(Sphere::new(1.0)?.material(glow))?;
/// let ray = Ray::new(Point3D::new(0.0, 0.0, -5.0), Vector3D::Z).spectrum(500.0, 501.0, 1);
/// let expected = 0.05 * std::f64::consts::TAU.sqrt();
/// assert!((ray.trace(&world)?.samples()[0] / expected - 1.0).abs() < 1e-6);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[doc(alias("NumericalIntegrator", "VolumeIntegrator"))]
pub struct InhomogeneousVolumeEmitter<F> {
    emission: F,
    structure: Structure,
    breaks: Option<Box<Breaks>>,
    importance: f64,
}

impl<F> fmt::Debug for InhomogeneousVolumeEmitter<F> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "InhomogeneousVolumeEmitter, {:?}", self.structure)
    }
}

impl<F: Fn(Point3D, Vector3D, Context<'_>, &mut [f64]) + Send + Sync + 'static>
    InhomogeneousVolumeEmitter<F>
{
    fn of(structure: Structure, emission: F) -> Self {
        Self { emission, structure, breaks: None, importance: 1.0 }
    }

    /// Of a function that changes over lengths no shorter than `length_scale` [m] of the shape's own space, a width of a
    /// step or the standard deviation of a Gaussian: integrated to
    /// [`PathSettings::line_tolerance`](crate::PathSettings::line_tolerance). A narrower feature can be missed.
    ///
    /// # Errors
    /// [`MathError::OutOfRange`] unless the length is positive and finite.
    pub fn length_scale(length_scale: f64, emission: F) -> Result<Self, OpticalError> {
        check_length(length_scale, "length scale of a volume")?;
        Ok(Self::of(Structure::Smooth { length_scale }, emission))
    }

    /// Of a function of which nothing is known: one random point in each `step` [m]. Features that are narrower than the
    /// step show as noise, not as a fault.
    ///
    /// # Errors
    /// [`MathError::OutOfRange`] unless the length is positive and finite.
    pub fn jittered(step: f64, emission: F) -> Result<Self, OpticalError> {
        check_length(step, "step in a volume")?;
        Ok(Self::of(Structure::Unknown { step }, emission))
    }

    /// By the trapezium rule with steps of at most `step` [m] and at least `points` points: Raysect's `NumericalIntegrator`
    /// (0.01 m and 5 by default there). Its error is not known to anyone.
    ///
    /// # Errors
    /// [`MathError::OutOfRange`] unless the length is positive and finite, and there are 2 points or more.
    pub fn trapezium(step: f64, points: u32, emission: F) -> Result<Self, OpticalError> {
        check_length(step, "step in a volume")?;
        MathError::check(points >= 2, points.into(), "points of the trapezium rule", "", "2 or more")?;
        Ok(Self::of(Structure::Trapezium { step, points }, emission))
    }

    /// With a function that adds the distances at which the emission jumps along a ray in the space of the shape; see
    /// [`Medium::breakpoints`].
    pub fn breaks(self, breaks: impl Fn(&Ray, &mut Vec<f64>) + Send + Sync + 'static) -> Self {
        Self { breaks: Some(Box::new(breaks)), ..self }
    }

    /// How much paths are to be aimed at it, relative to others; 0 for not at all.
    pub fn importance(self, importance: f64) -> Self {
        Self { importance, ..self }
    }
}

pub(super) fn check_length(length: f64, name: &'static str) -> Result<(), OpticalError> {
    MathError::check(length > 0.0 && length.is_finite(), length, name, "m", "positive and finite")?;
    Ok(())
}

impl<F: Fn(Point3D, Vector3D, Context<'_>, &mut [f64]) + Send + Sync + 'static> Material
    for InhomogeneousVolumeEmitter<F>
{
    fn surface(&self, _: &SurfaceHit, _: &mut Path<'_>) -> Scatter {
        Scatter::PassThrough
    }

    fn medium(&self) -> Option<&dyn Medium> {
        Some(self)
    }

    fn facts(&self) -> Facts {
        Facts { name: "InhomogeneousVolumeEmitter".to_owned(), ..volume_facts::<Self>(self.importance) }
    }
}

impl<F: Fn(Point3D, Vector3D, Context<'_>, &mut [f64]) + Send + Sync + 'static> Medium
    for InhomogeneousVolumeEmitter<F>
{
    fn structure(&self) -> Structure {
        self.structure
    }

    fn breakpoints(&self, ray: &Ray, out: &mut Vec<f64>) {
        if let Some(breaks) = &self.breaks {
            breaks(ray, out);
        }
    }

    fn coefficients(&self, at: &MediumPoint<'_>, out: &mut Coefficients<'_>) {
        (self.emission)(at.local_point(), at.local_direction(), at.at, out.emission);
    }

    fn majorant(&self, _: Context<'_>) -> f64 {
        0.0
    }
}
