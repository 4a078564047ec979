use raysect_core::save::{SaveError, Saved, SceneWriter};
use raysect_core::{
    BoundingBox3D, BoundingSphere3D, Crossing, Departure, DirectionSample, Interval, Primitive, Ray, Scratch,
    Surface, SurfaceSampling,
};
use raysect_math::{AffineMatrix3D, Cone, Frame, MathError, Normal3D, Point3D, Vector3D};

use crate::PrimitiveError;
use crate::chord::Chord;
use crate::unit;

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
    /// One over the radius [1/m].
    inverse: f64,
}

impl Default for Sphere {
    /// Radius 0.5 m.
    fn default() -> Self {
        Self::of(0.5)
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
        Ok(Self::of(radius))
    }

    fn of(radius: f64) -> Self {
        Self { radius, inverse: 1.0 / radius }
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
    /// Gems, ch. 7). The difference of the squares is as good as the product of sum and difference with the length of
    /// that vector: a root halves the relative error of the square, and the product doubles it again.
    #[inline]
    fn approach(&self, ray: &Ray) -> (f64, f64) {
        let d = ray.direction;
        let squared = 1.0 / d.length_squared();
        let closest = -ray.origin.to_vector().dot(d) * squared;
        let miss = ray.point_at(closest).to_vector().length_squared();
        (closest, (self.radius * self.radius - miss) * squared)
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
        let p = ray.point_at(crossing.distance).to_vector();
        let rough = Normal3D::from(p * self.inverse);
        let stretch = unit::to_unit(rough.length_squared());
        let normal = rough * stretch;
        Surface {
            point: Point3D::ORIGIN + p * stretch,
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
    use crate::double_double::{Dd, dd};
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

    /// Square of half the chord of a line through a ball, from the ray and the radius.
    type Form = fn(&Ray, f64) -> f64;

    /// The greatest error of that square for lines that nearly touch, begun `k` radii away, in units of ε (1 + k) times
    /// the square of the radius, by 32 digits.
    fn worst_square(form: Form, radius: f64, k: f64) -> f64 {
        let mut rng = raysect_math::Rng::new(5);
        let mut direction = || raysect_math::SphereSampler.sample_at([rng.uniform(), rng.uniform()]);
        let errors = (0..4000).map(|number| {
            let along = direction();
            let aside = along.cross(direction()).normalise_unchecked();
            let gap = 10f64.powi(-1 - number % 16) * if number % 2 == 0 { 1.0 } else { -1.0 };
            let origin = Point3D::ORIGIN + aside * (radius * (1.0 + gap)) - along * (k * radius);
            let ray = Ray::new(origin, along * [1.0, 1e-3, 37.0][(number % 3) as usize]);
            let o = origin.to_array().map(dd);
            let d = ray.direction.to_array().map(dd);
            let dot = |a: [Dd; 3], b: [Dd; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
            let closest = -(dot(o, d) / dot(d, d));
            let miss = [0, 1, 2].map(|i| o[i] + d[i] * closest);
            let exact = (dd(radius) * dd(radius) - dot(miss, miss)) / dot(d, d);
            let error = (dd(form(&ray, radius)) - exact) * dot(d, d);
            (error / (dd(radius) * dd(radius))).value().abs() / (f64::EPSILON * (1.0 + k))
        });
        errors.fold(0.0, f64::max)
    }

    #[test]
    fn the_difference_of_squares_is_as_good_as_the_product() {
        let difference: Form = |ray, radius| Sphere::new(radius).unwrap().approach(ray).1;
        let product: Form = |ray, radius| {
            let squared = 1.0 / ray.direction.length_squared();
            let closest = -ray.origin.to_vector().dot(ray.direction) * squared;
            let miss = ray.point_at(closest).to_vector().length();
            (radius - miss) * (radius + miss) * squared
        };
        let textbook: Form = |ray, radius| {
            let (o, d) = (ray.origin.to_vector(), ray.direction);
            let (a, b) = (d.length_squared(), o.dot(d));
            (b * b - a * (o.length_squared() - radius * radius)) / (a * a)
        };
        for radius in [1e-100, 1e-9, 0.5, 1e9, 1e100] {
            for k in [0.0, 1.0, 1e3, 1e8] {
                let [found, other] = [difference, product].map(|form| worst_square(form, radius, k));
                assert!(found <= 2.0 && found <= 1.01 * other, "{radius} from {k}: {found} and {other}");
            }
            assert!(worst_square(textbook, radius, 1e3) > 100.0);
        }
    }
}
