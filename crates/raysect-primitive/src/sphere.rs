use raysect_core::save::{SaveError, Saved, SceneWriter};
use raysect_core::{
    BoundingBox3D, BoundingSphere3D, Crossing, Departure, DirectionSample, Interval, Primitive, Ray, Scratch,
    Surface, SurfaceSampling,
};
use raysect_math::{AffineMatrix3D, Cone, Frame, MathError, Normal3D, Point3D, Vector3D};

use crate::PrimitiveError;
use crate::chord::Chord;

/// A ball about the origin.
///
/// ```
/// use raysect_primitive::Sphere;
/// assert_eq!(Sphere::default().radius(), 0.5);
/// assert!(Sphere::new(0.0).is_err());
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sphere {
    radius: f64,
}

impl Default for Sphere {
    /// Radius 0.5 m.
    fn default() -> Self {
        Self { radius: 0.5 }
    }
}

impl Sphere {
    /// Of a radius [m].
    ///
    /// # Errors
    /// [`PrimitiveError::Dimension`] unless the radius lies in 1e-100 … 1e100 m.
    pub fn new(radius: f64) -> Result<Self, PrimitiveError> {
        let admitted = (1e-100..=1e100).contains(&radius);
        MathError::check(admitted, radius, "radius", "m", "1e-100 … 1e100 m")
            .map_err(|source| PrimitiveError::Dimension { shape: "sphere", source })?;
        Ok(Self { radius })
    }

    /// The radius [m].
    pub fn radius(&self) -> f64 {
        self.radius
    }

    /// Place of closest approach to the centre along the ray, and the signed square of half the chord, in units of
    /// the direction's length.
    ///
    /// The discriminant comes from the vector of closest approach, which keeps its accuracy from any distance
    /// (E. Haines, J. Günther, T. Akenine-Möller, *Precision Improvements for Ray/Sphere Intersection*, Ray Tracing
    /// Gems, ch. 7).
    #[inline]
    fn approach(&self, ray: &Ray) -> (f64, f64) {
        let d = ray.direction;
        let squared = 1.0 / d.length_squared();
        let closest = -ray.origin.to_vector().dot(d) * squared;
        let miss = ray.point_at(closest).to_vector().length();
        (closest, (self.radius - miss) * (self.radius + miss) * squared)
    }

    /// The cone of directions to the ball from a distance to its centre, unless that is inside.
    #[inline]
    fn cone(&self, distance: f64) -> Option<Cone> {
        (distance > self.radius).then(|| Cone::of_sphere(self.radius, distance))
    }

    /// How deep a point lies within [m], negative outside: the surface is at least so far away.
    #[inline]
    pub(crate) fn depth(&self, p: Point3D) -> f64 {
        self.radius - p.to_vector().length()
    }

    /// What of a line is within.
    #[inline]
    pub(crate) fn chord(&self, ray: &Ray) -> Option<Chord> {
        let (closest, squared) = self.approach(ray);
        (squared >= 0.0).then(|| {
            let half = squared.sqrt();
            Chord { near: closest - half, far: closest + half, entry: 0, exit: 0 }
        })
    }
}

impl Primitive for Sphere {
    fn bounding_box(&self, m: &AffineMatrix3D) -> BoundingBox3D {
        // The reach of the ball along an axis of the world is its radius times the length of that row.
        let centre = m.origin();
        let mut image = BoundingBox3D { lower: centre, upper: centre };
        for axis in 0..3 {
            let reach = self.radius * Vector3D::new(m.get(axis, 0), m.get(axis, 1), m.get(axis, 2)).length();
            image.pad_axis(axis, reach + 8.0 * f64::EPSILON * (reach + centre[axis].abs()));
        }
        image
    }

    fn bounding_sphere(&self, m: &AffineMatrix3D) -> BoundingSphere3D {
        match m.similarity_scale() {
            Some(scale) => {
                BoundingSphere3D { centre: m.origin(), radius: self.radius * scale * 1.000_000_001 }
            }
            None => self.bounding_box(m).enclosing_sphere(),
        }
    }

    fn contains(&self, point: Point3D) -> bool {
        point.to_vector().length() <= self.radius
    }

    fn crossings(&self, ray: &Ray, _: &mut Scratch, out: &mut Vec<Crossing>) {
        out.extend(self.chord(ray).iter().flat_map(Chord::crossings));
    }

    #[inline]
    fn hit(&self, ray: &Ray, within: Interval, _: &mut Scratch) -> Option<Crossing> {
        self.chord(ray)?.first(within)
    }

    fn hit_after(&self, ray: &Ray, left: &Departure, max_distance: f64, _: &mut Scratch) -> Option<Crossing> {
        if !left.inward {
            return None;
        }
        let (closest, squared) = self.approach(ray);
        let far = (closest + squared.max(0.0).sqrt()).max(0.0);
        (far <= max_distance).then(|| Chord::crossing(far, 0, true))
    }

    #[inline]
    fn surface(&self, ray: &Ray, crossing: &Crossing) -> Surface {
        let normal = Normal3D::from(ray.point_at(crossing.distance).to_vector() * (1.0 / self.radius));
        let normal = normal.normalise_unchecked();
        Surface {
            point: Point3D::ORIGIN + normal * self.radius,
            normal,
            shading_normal: normal,
            bound: 4.0 * f64::EPSILON * self.radius,
        }
    }

    fn save(&self, _: &mut SceneWriter) -> Result<Saved, SaveError> {
        Ok(Saved::new("Sphere").number("radius", self.radius))
    }

    fn is_convex(&self) -> bool {
        true
    }

    fn surface_sampling(&self) -> SurfaceSampling {
        SurfaceSampling::SolidAngle
    }

    fn sample_direction(&self, from: Point3D, u: [f64; 2]) -> Option<DirectionSample> {
        let towards = from.vector_to(Point3D::ORIGIN);
        let cone = self.cone(towards.length())?;
        let direction = Frame::from_z(towards.normalise_unchecked()).to_world(cone.sample_at(u));
        Some(DirectionSample { direction, density: 1.0 / cone.solid_angle() })
    }

    fn direction_density(&self, from: Point3D, direction: Vector3D) -> f64 {
        let (closest, squared) = self.approach(&Ray::new(from, direction));
        let meets = squared >= 0.0 && closest > 0.0;
        match self.cone(from.to_vector().length()) {
            Some(cone) if meets => 1.0 / cone.solid_angle(),
            _ => 0.0,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use raysect_core::testing::check_primitive;

    #[test]
    fn keeps_the_contract_at_every_size() {
        for radius in [1e-9, 0.5, 3.0, 1e9] {
            check_primitive(&Sphere::new(radius).unwrap(), 4000, 1).unwrap();
        }
    }

    #[test]
    fn impossible_radii_are_named() {
        for radius in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            let message = Sphere::new(radius).unwrap_err().to_string();
            assert!(
                message.contains("sphere") && message.contains(&format!("radius = {radius} m")),
                "{message}"
            );
        }
    }

    #[test]
    fn boxes_hold_sheared_balls() {
        let m = AffineMatrix3D::from_axes(
            Vector3D::new(3.0, 0.0, 0.0),
            Vector3D::new(0.5, 0.2, 0.0),
            Vector3D::new(-1.0, 0.3, 2.0),
            Point3D::new(5.0, 6.0, 7.0),
        );
        let ball = Sphere::new(2.0).unwrap();
        let image = ball.bounding_box(&m);
        let mut rng = raysect_math::Rng::new(4);
        for _ in 0..10_000 {
            let u = [rng.uniform(), rng.uniform()];
            let p = m * (Point3D::ORIGIN + raysect_math::SphereSampler.sample_at(u) * 2.0);
            assert!(image.contains(p));
        }
    }

    #[test]
    fn distant_rays_hit_to_rounding() {
        let ball = Sphere::new(1.0).unwrap();
        for k in [1e3, 1e5, 1e7] {
            let ray = Ray::new(Point3D::new(0.6, 0.0, -k), Vector3D::Z);
            let t = ball.hit(&ray, Interval::AHEAD, &mut Scratch::default()).unwrap().distance;
            assert!((t - (k - 0.8)).abs() <= 4.0 * k * 1.1e-16, "{k}");
        }
    }
}
