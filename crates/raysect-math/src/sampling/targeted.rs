//! Directions towards spheres.

use std::f64::consts::PI;

use super::{hemisphere, sphere, uniforms};
use crate::{Cone, Frame, MathError, Point3D, Rng, Vector3D};

/// A sphere that directions are drawn towards.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TargetSphere {
    centre: Point3D,
    radius: f64,
    weight: f64,
}

impl TargetSphere {
    /// From centre [m], radius [m] and weight: the share of the directions is the weight over the sum of all.
    ///
    /// # Errors
    /// [`MathError::OutOfRange`] for a centre beyond 1e150 m, and for a radius or weight outside 1e-150 … 1e150.
    pub fn new(centre: Point3D, radius: f64, weight: f64) -> Result<Self, MathError> {
        let farthest = centre.max_abs();
        let range = "1e-150 … 1e150";
        MathError::check(farthest <= 1e150, farthest, "coordinate of a target", "m", "-1e150 … 1e150")?;
        MathError::check((1e-150..=1e150).contains(&radius), radius, "radius of a target", "m", range)?;
        MathError::check((1e-150..=1e150).contains(&weight), weight, "weight of a target", "", range)?;
        Ok(Self { centre, radius, weight })
    }

    /// The cone in which the sphere appears from a point outside, about the z axis of the frame.
    fn cone_from(&self, point: Point3D) -> Option<(Frame, Cone)> {
        let axis = point.vector_to(self.centre);
        let distance = axis.length();
        let axis = if distance > self.radius { axis.normalise().ok()? } else { return None };
        Some((Frame::from_z(axis), Cone::of_sphere(self.radius, distance)))
    }
}

/// Density [1/sr] in a cone; its border is widened by what turning a direction into a frame and back may move it.
fn cone_density(frame: &Frame, cone: &Cone, direction: Vector3D) -> f64 {
    let v = frame.to_local(direction);
    let versine = if v.z > 0.0 { (v.x * v.x + v.y * v.y) / (1.0 + v.z) } else { 1.0 - v.z };
    let limit = cone.solid_angle() / (2.0 * PI);
    let slack = 16.0 * f64::EPSILON;
    if versine <= limit + slack * (limit + limit.sqrt() + slack) { 1.0 / cone.solid_angle() } else { 0.0 }
}

/// Weighted spheres; never empty.
#[derive(Debug, Clone, PartialEq)]
struct Targets {
    spheres: Vec<TargetSphere>,
    total: f64,
}

impl Targets {
    fn new(spheres: Vec<TargetSphere>) -> Result<Self, MathError> {
        let count = spheres.len() as f64;
        MathError::check(!spheres.is_empty(), count, "number of targets", "", "1 or more")?;
        let total = spheres.iter().map(|s| s.weight).sum();
        Ok(Self { spheres, total })
    }

    fn choose(&self, rng: &mut Rng) -> &TargetSphere {
        let mut left = rng.uniform() * self.total;
        let passed = |s: &&TargetSphere| {
            left -= s.weight;
            left < 0.0
        };
        // Rounding may leave a rest after the last.
        self.spheres.iter().find(passed).unwrap_or(&self.spheres[self.spheres.len() - 1])
    }

    fn mixture(&self, density: impl Fn(&TargetSphere) -> f64) -> f64 {
        self.spheres.iter().map(|s| s.weight / self.total * density(s)).sum()
    }
}

/// Directions towards spheres around a point, in all directions.
///
/// One of the spheres is chosen by its weight; a direction is uniform in the cone that it subtends, or in all
/// directions if the point lies inside.
///
/// ```
/// use raysect_math::{Point3D, Rng, TargetSphere, TargetedSphereSampler};
/// let sampler = TargetedSphereSampler::new(vec![
///     TargetSphere::new(Point3D::new(0.0, 0.0, 5.0), 0.5, 0.2)?,
///     TargetSphere::new(Point3D::new(3.0, 0.0, 0.0), 0.5, 0.4)?,
/// ])?;
/// let from = Point3D::ORIGIN;
/// let direction = sampler.sample(from, &mut Rng::new(1));
/// assert!(direction.x > 0.98 || direction.z > 0.98);
/// assert!(sampler.pdf(from, direction) > 0.0);
/// # Ok::<(), raysect_math::MathError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct TargetedSphereSampler {
    targets: Targets,
}

impl TargetedSphereSampler {
    /// Towards the given spheres.
    ///
    /// # Errors
    /// [`MathError::OutOfRange`] if there is none.
    pub fn new(targets: impl Into<Vec<TargetSphere>>) -> Result<Self, MathError> {
        Ok(Self { targets: Targets::new(targets.into())? })
    }

    /// A unit vector from the given point [m].
    pub fn sample(&self, from: Point3D, rng: &mut Rng) -> Vector3D {
        match self.targets.choose(rng).cone_from(from) {
            Some((frame, cone)) => frame.to_world(cone.sample(rng)),
            None => sphere::sample(uniforms(rng)),
        }
    }

    /// Density [1/sr] of [`sample`](Self::sample) from the given point [m] at any unit vector.
    pub fn pdf(&self, from: Point3D, direction: Vector3D) -> f64 {
        self.targets.mixture(|target| match target.cone_from(from) {
            Some((frame, cone)) => cone_density(&frame, &cone, direction),
            None => sphere::pdf(direction),
        })
    }
}

/// Directions towards spheres above the plane through a point at right angles to z.
///
/// One of the spheres is chosen by its weight. If it lies wholly above the plane, a direction is uniform in the cone
/// that it subtends; otherwise directions are weighted by the cosine to z over the hemisphere. The density asks the
/// same question of the sphere. (Raysect's asks it of the direction, and its integral is not one.)
///
/// ```
/// use raysect_math::{Point3D, Rng, TargetSphere, TargetedHemisphereSampler, Vector3D};
/// let target = TargetSphere::new(Point3D::new(0.0, 0.0, 5.0), 0.5, 1.0)?;
/// let sampler = TargetedHemisphereSampler::new(vec![target])?;
/// assert!(sampler.sample(Point3D::ORIGIN, &mut Rng::new(1)).z > 0.99);
/// assert_eq!(sampler.pdf(Point3D::ORIGIN, Vector3D::X), 0.0);
/// # Ok::<(), raysect_math::MathError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct TargetedHemisphereSampler {
    targets: Targets,
}

impl TargetedHemisphereSampler {
    /// Towards the given spheres.
    ///
    /// # Errors
    /// [`MathError::OutOfRange`] if there is none.
    pub fn new(targets: impl Into<Vec<TargetSphere>>) -> Result<Self, MathError> {
        Ok(Self { targets: Targets::new(targets.into())? })
    }

    /// The cone of a sphere that lies wholly above the plane.
    fn cone_above(target: &TargetSphere, from: Point3D) -> Option<(Frame, Cone)> {
        if target.centre.z - from.z > target.radius { target.cone_from(from) } else { None }
    }

    /// A unit vector with z > 0 from the given point [m].
    pub fn sample(&self, from: Point3D, rng: &mut Rng) -> Vector3D {
        match Self::cone_above(self.targets.choose(rng), from) {
            Some((frame, cone)) => {
                let v = frame.to_world(cone.sample(rng));
                // A cone that touches the plane may cross it by rounding.
                Vector3D::new(v.x, v.y, v.z.max(f64::MIN_POSITIVE))
            }
            None => hemisphere::sample_cosine(uniforms(rng)),
        }
    }

    /// Density [1/sr] of [`sample`](Self::sample) from the given point [m] at any unit vector: 0 for z ≤ 0.
    pub fn pdf(&self, from: Point3D, direction: Vector3D) -> f64 {
        if direction.z <= 0.0 {
            return 0.0;
        }
        self.targets.mixture(|target| match Self::cone_above(target, from) {
            Some((frame, cone)) => cone_density(&frame, &cone, direction),
            None => hemisphere::pdf_cosine(direction),
        })
    }
}

#[cfg(test)]
mod tests;
