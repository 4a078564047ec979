use raysect_math::{MathError, Point3D};

use crate::{CoreError, Interval, Ray};

/// A sphere around something, surface included.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BoundingSphere3D {
    /// Centre [m].
    pub centre: Point3D,
    /// Radius [m].
    pub radius: f64,
}

impl BoundingSphere3D {
    /// From centre [m] and radius [m].
    ///
    /// # Errors
    /// [`MathError::OutOfRange`] unless the radius is positive and finite.
    pub fn new(centre: Point3D, radius: f64) -> Result<Self, CoreError> {
        MathError::check(radius > 0.0 && radius.is_finite(), radius, "radius", "m", "positive and finite")?;
        Ok(Self { centre, radius })
    }

    /// True for points inside and on the surface.
    #[inline]
    pub fn contains(&self, p: Point3D) -> bool {
        self.centre.distance_to(p) <= self.radius
    }

    /// True if the ray, from its origin on, meets the sphere.
    pub fn hit(&self, ray: &Ray) -> bool {
        self.full_intersection(ray).is_some()
    }

    /// Where the line of the ray enters and leaves, if the ray meets the sphere from its origin on.
    ///
    /// The roots are taken about the point of closest approach (E. Haines et al., *Precision Improvements for
    /// Ray/Sphere Intersection*, Ray Tracing Gems, ch. 7), in units of the direction's length.
    pub fn full_intersection(&self, ray: &Ray) -> Option<Interval> {
        let d = ray.direction;
        let to_centre = ray.origin.vector_to(self.centre);
        let closest = to_centre.dot(d) / d.length_squared();
        let miss = (to_centre - d * closest).length_squared();
        let squared = self.radius * self.radius - miss;
        if squared < 0.0 {
            return None;
        }
        let half = (squared / d.length_squared()).sqrt();
        (closest + half >= 0.0).then_some(Interval::new(closest - half, closest + half))
    }

    /// The smallest sphere around two.
    #[must_use]
    pub fn union(&self, other: &Self) -> Self {
        let between = self.centre.vector_to(other.centre);
        let distance = between.length();
        if distance + other.radius <= self.radius {
            return *self;
        }
        if distance + self.radius <= other.radius {
            return *other;
        }
        let radius = 0.5 * (distance + self.radius + other.radius);
        Self { centre: self.centre + between * ((radius - self.radius) / distance), radius }
    }

    /// Grows about its centre to include `point` with `padding` [m] around it.
    pub fn extend(&mut self, point: Point3D, padding: f64) {
        self.radius = self.radius.max(self.centre.distance_to(point) + padding);
    }

    /// Increases the radius by `padding` [m].
    pub fn pad(&mut self, padding: f64) {
        self.radius += padding;
    }

    /// Area of the surface [m²].
    pub fn surface_area(&self) -> f64 {
        4.0 * std::f64::consts::PI * self.radius * self.radius
    }

    /// Volume [m³].
    pub fn volume(&self) -> f64 {
        self.surface_area() * self.radius / 3.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use raysect_math::Vector3D;

    #[test]
    fn unions_touch_both_ends() {
        let a = BoundingSphere3D::new(Point3D::ORIGIN, 1.0).unwrap();
        let b = BoundingSphere3D::new(Point3D::new(4.0, 0.0, 0.0), 2.0).unwrap();
        let u = a.union(&b);
        assert_eq!((u.centre.x, u.radius), (2.5, 3.5));
        assert_eq!(u.union(&a), u);
        assert!(BoundingSphere3D::new(Point3D::ORIGIN, 0.0).is_err());
    }

    #[test]
    fn a_distant_ray_meets_it_where_it_should() {
        let s = BoundingSphere3D::new(Point3D::ORIGIN, 1.0).unwrap();
        let far = Ray::new(Point3D::new(0.5, 0.0, -1e7), Vector3D::Z * 2.0);
        let at = s.full_intersection(&far).unwrap();
        assert!((at.min * 2.0 - (1e7 - 0.75f64.sqrt())).abs() < 1e-8);
        let mut grown = s;
        grown.extend(Point3D::new(0.0, 3.0, 0.0), 0.5);
        assert_eq!(grown.radius, 3.5);
    }
}
