use std::fmt;
use std::sync::Arc;

use raysect_core::Ray;
use raysect_math::function::{Function, Structured3D};
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

impl ProfileVolume<()> {
    /// Of the coefficients at density one, and a density between 0 and `largest` that knows its structure itself: a grid, a
    /// mesh of tetrahedra, what is turned around the z axis of the shape, or a profile about a point or an axis. Where the
    /// function has no value (NaN), as outside of its grid, there is nothing.
    ///
    /// ```
    /// use raysect_math::function::{Arg, Interpolation, Interpolator2DArray, axisymmetric, sample2d};
    /// use raysect_math::Point3D;
    /// use raysect_optical::{ProfileVolume, Ray, UniformVolume, WithMaterial, World};
    /// use raysect_primitive::Cuboid;
    /// // A plasma ring: its emission by (r, z) on a grid, nothing outside of it.
    /// let bell = (-((Arg::X - 2.0).pow(2.0) + Arg::Y.pow(2.0)) / 0.05).exp();
    /// let ([r, z], emission) = sample2d(&bell, (1.0, 3.0, 41), (-1.0, 1.0, 41))?;
    /// let ring = axisymmetric(Interpolator2DArray::new(&r, &z, &emission, Interpolation::Linear)?);
    /// let plasma = ProfileVolume::structured(UniformVolume::new().emission(1.0), ring, 1.0)?;
    /// let mut world = World::new();
    /// world.add(Cuboid::centred(8.0, 8.0, 2.0)?.material(plasma))?;
    /// let seen = Ray::new(Point3D::new(-5.0, 0.0, 0.0), [1.0, 0.0, 0.0].into()).trace(&world)?;
    /// // Twice the width of the ring.
    /// assert!((seen.samples()[0] - 2.0 * (0.05 * std::f64::consts::PI).sqrt()).abs() < 0.02);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// A radial profile, whose corners on a ray are known exactly:
    /// ```
    /// use raysect_math::Point3D;
    /// use raysect_math::function::{Interpolation1D, Interpolator1DArray, spherical};
    /// use raysect_optical::{ProfileVolume, UniformVolume};
    /// let profile = Interpolator1DArray::new(&[0.0, 0.4, 0.5], &[1.0, 0.8, 0.0], Interpolation1D::Linear)?;
    /// let ball = spherical(profile, Point3D::new(0.0, 0.0, 1.0));
    /// let plasma = ProfileVolume::structured(UniformVolume::new().emission(2.0), ball, 1.0)?;
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// As [`new`](ProfileVolume::new).
    pub fn structured(
        uniform: UniformVolume,
        density: impl Structured3D + 'static,
        largest: f64,
    ) -> Result<ProfileVolume<impl Fn(Point3D) -> f64 + Send + Sync + 'static>, OpticalError> {
        let density = Arc::new(density);
        let (of, length_scale) = (Arc::clone(&density), density.length_scale());
        let value = move |p: Point3D| {
            let value = of.evaluate((p.x, p.y, p.z));
            if value.is_nan() { 0.0 } else { value }
        };
        let volume = ProfileVolume::new(uniform, value, largest, length_scale)?;
        Ok(volume.breaks(move |ray, out| density.add_breaks(ray.origin, ray.direction, out)))
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
