use std::fmt;
use std::sync::Arc;

use raysect_core::{Interval, Primitive, Ray, Scratch, SurfaceSampling};
use raysect_math::{AffineMatrix3D, MathError, Point3D, Rng, Vector3D};

/// A convex shape in its place, aimed at as lamps are: by the samples that the shape itself draws.
///
/// The place is a similarity, so that solid angles are the same in the space of the shape and in that of the sensor.
#[derive(Clone)]
pub(crate) struct PlacedShape {
    pub(crate) shape: Arc<dyn Primitive>,
    pub(crate) to_sensor: AffineMatrix3D,
    to_local: AffineMatrix3D,
}

impl PlacedShape {
    /// None for a shape that cannot be sampled exactly there: it draws no samples, is not convex, so that parts of it may
    /// hide others, or is distorted.
    ///
    /// # Errors
    /// [`MathError`] for a place without inverse.
    pub(crate) fn new(
        shape: &Arc<dyn Primitive>,
        to_sensor: AffineMatrix3D,
    ) -> Result<Option<Self>, MathError> {
        let drawn = shape.is_convex() && shape.surface_sampling() != SurfaceSampling::None;
        if !drawn || to_sensor.similarity_scale().is_none() {
            return Ok(None);
        }
        Ok(Some(Self { shape: shape.clone(), to_sensor, to_local: to_sensor.inverse()? }))
    }

    /// A direction towards the shape; none from where nothing of it is to be seen: from inside, or in the plane of a
    /// sheet.
    pub(crate) fn sample(&self, from: Point3D, rng: &mut Rng) -> Option<Vector3D> {
        let from = self.to_local.transform_point(from);
        if self.shape.contains(from) {
            return None;
        }
        let direction = self.draw(from, [rng.uniform(), rng.uniform(), rng.uniform()])?;
        self.to_sensor.transform_vector(direction).normalise().ok()
    }

    /// In the space of the shape, and of any length.
    fn draw(&self, from: Point3D, u: [f64; 3]) -> Option<Vector3D> {
        match self.shape.surface_sampling() {
            SurfaceSampling::SolidAngle => Some(self.shape.sample_direction(from, [u[0], u[1]])?.direction),
            _ => {
                let drawn = self.shape.sample_surface(from, u)?;
                let direction = from.vector_to(drawn.point);
                // A point of a surface seen edge-on.
                let seen = drawn.density.is_finite() && drawn.normal.dot(direction) != 0.0;
                seen.then_some(direction)
            }
        }
    }

    /// Density of [`sample`](Self::sample) [1/sr]; none where that draws nothing.
    pub(crate) fn pdf(&self, from: Point3D, direction: Vector3D) -> Option<f64> {
        let from = self.to_local.transform_point(from);
        if self.shape.contains(from) {
            return None;
        }
        let direction = self.to_local.transform_vector(direction).normalise_unchecked();
        let density = match self.shape.surface_sampling() {
            SurfaceSampling::SolidAngle => self.shape.direction_density(from, direction),
            _ => self.density_by_area(from, direction),
        };
        // Whether a convex shape is seen from a point does not depend on the numbers that draw.
        (density > 0.0 || self.draw(from, [0.5; 3]).is_some()).then_some(density)
    }

    fn density_by_area(&self, from: Point3D, direction: Vector3D) -> f64 {
        let ray = Ray::new(from, direction);
        let Some(hit) = self.shape.hit(&ray, Interval::AHEAD, &mut Scratch::default()) else { return 0.0 };
        let surface = self.shape.surface(&ray, &hit);
        let cosine = surface.normal.dot(direction).abs();
        if cosine == 0.0 {
            return 0.0;
        }
        let per_area = self.shape.surface_density(from, surface.point, hit.feature);
        per_area * from.vector_to(surface.point).length_squared() / cosine
    }

    /// Numbers that tell it from others.
    pub(crate) fn numbers(&self) -> Vec<f64> {
        let bounds = self.shape.bounding_box(&AffineMatrix3D::IDENTITY);
        let place = self.to_sensor.to_rows();
        let kind = self.shape.kind().bytes().map(f64::from);
        let bounds = bounds.lower.to_array().into_iter().chain(bounds.upper.to_array());
        kind.chain(bounds).chain(place.into_iter().flatten()).collect()
    }
}

impl fmt::Debug for PlacedShape {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} at {:?}", self.shape.kind(), self.to_sensor.to_rows())
    }
}

impl PartialEq for PlacedShape {
    /// The same shape in the same place.
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.shape, &other.shape) && self.to_sensor == other.to_sensor
    }
}
