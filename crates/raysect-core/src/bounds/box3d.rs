use raysect_math::{AffineMatrix3D, Point3D};

use super::BoundingSphere3D;
use crate::{CoreError, Interval, Ray};

/// An axis-aligned box, faces included; the default is the empty box.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BoundingBox3D {
    /// Corner of least coordinates [m].
    pub lower: Point3D,
    /// Corner of greatest coordinates [m].
    pub upper: Point3D,
}

impl Default for BoundingBox3D {
    fn default() -> Self {
        Self::EMPTY
    }
}

impl BoundingBox3D {
    /// The box that contains nothing and vanishes in unions.
    pub const EMPTY: Self = Self {
        lower: Point3D::new(f64::INFINITY, f64::INFINITY, f64::INFINITY),
        upper: Point3D::new(f64::NEG_INFINITY, f64::NEG_INFINITY, f64::NEG_INFINITY),
    };

    /// From its corners [m].
    ///
    /// # Errors
    /// [`CoreError::InvertedBox`] if `lower` exceeds `upper` (or is NaN) along an axis.
    pub fn new(lower: Point3D, upper: Point3D) -> Result<Self, CoreError> {
        for axis in 0..3 {
            let (low, high) = (lower[axis], upper[axis]);
            if low > high || low.is_nan() || high.is_nan() {
                return Err(CoreError::InvertedBox { axis, lower: low, upper: high });
            }
        }
        Ok(Self { lower, upper })
    }

    /// The smallest box around points.
    pub fn around(points: impl IntoIterator<Item = Point3D>) -> Self {
        points.into_iter().fold(Self::EMPTY, |mut b, p| {
            b.extend(p, 0.0);
            b
        })
    }

    /// True if it contains no point.
    #[inline]
    pub fn is_empty(&self) -> bool {
        (0..3).any(|a| self.lower[a] > self.upper[a])
    }

    /// True for points inside and on the faces.
    #[inline]
    pub fn contains(&self, p: Point3D) -> bool {
        (0..3).all(|a| p[a] >= self.lower[a] && p[a] <= self.upper[a])
    }

    /// The smallest box around both.
    #[must_use]
    pub fn union(&self, other: &Self) -> Self {
        let pick = |f: fn(f64, f64) -> f64, a: Point3D, b: Point3D| {
            Point3D::new(f(a.x, b.x), f(a.y, b.y), f(a.z, b.z))
        };
        Self {
            lower: pick(f64::min, self.lower, other.lower),
            upper: pick(f64::max, self.upper, other.upper),
        }
    }

    /// The box of the points in both; empty if they do not meet.
    #[must_use]
    pub fn intersection(&self, other: &Self) -> Self {
        let pick = |f: fn(f64, f64) -> f64, a: Point3D, b: Point3D| {
            Point3D::new(f(a.x, b.x), f(a.y, b.y), f(a.z, b.z))
        };
        let common = Self {
            lower: pick(f64::max, self.lower, other.lower),
            upper: pick(f64::min, self.upper, other.upper),
        };
        if common.is_empty() { Self::EMPTY } else { common }
    }

    /// Grows to include `point` with `padding` [m] around it.
    pub fn extend(&mut self, point: Point3D, padding: f64) {
        for a in 0..3 {
            self.lower[a] = self.lower[a].min(point[a] - padding);
            self.upper[a] = self.upper[a].max(point[a] + padding);
        }
    }

    /// Moves every face outward by `padding` [m].
    pub fn pad(&mut self, padding: f64) {
        for axis in 0..3 {
            self.pad_axis(axis, padding);
        }
    }

    /// Moves the two faces across `axis` (0, 1, 2) outward by `padding` [m].
    pub fn pad_axis(&mut self, axis: usize, padding: f64) {
        self.lower[axis] -= padding;
        self.upper[axis] += padding;
    }

    /// Size along `axis` (0, 1, 2) [m]; 0 for an empty box.
    #[inline]
    pub fn extent(&self, axis: usize) -> f64 {
        (self.upper[axis] - self.lower[axis]).max(0.0)
    }

    /// The axis of the greatest extent, the lower one of equals.
    pub fn largest_axis(&self) -> usize {
        (1..3).fold(0, |best, a| if self.extent(a) > self.extent(best) { a } else { best })
    }

    /// The greatest extent [m].
    pub fn largest_extent(&self) -> f64 {
        self.extent(self.largest_axis())
    }

    /// Area of the six faces [m²].
    pub fn surface_area(&self) -> f64 {
        let [x, y, z] = [self.extent(0), self.extent(1), self.extent(2)];
        2.0 * (x * y + y * z + z * x)
    }

    /// Volume [m³].
    pub fn volume(&self) -> f64 {
        self.extent(0) * self.extent(1) * self.extent(2)
    }

    /// Centre [m]; (0, 0, 0) for an empty box.
    pub fn centre(&self) -> Point3D {
        if self.is_empty() {
            return Point3D::ORIGIN;
        }
        let middle = |a: usize| 0.5 * self.lower[a] + 0.5 * self.upper[a];
        Point3D::new(middle(0), middle(1), middle(2))
    }

    /// The eight corners, z varying fastest and x slowest.
    pub fn vertices(&self) -> [Point3D; 8] {
        let pick = |axis: usize, upper: bool| if upper { self.upper[axis] } else { self.lower[axis] };
        std::array::from_fn(|i| Point3D::new(pick(0, i & 4 != 0), pick(1, i & 2 != 0), pick(2, i & 1 != 0)))
    }

    /// A sphere about the centre that touches the corners, enlarged by a millionth as in Raysect.
    pub fn enclosing_sphere(&self) -> BoundingSphere3D {
        let centre = self.centre();
        let radius = if self.is_empty() { 0.0 } else { centre.distance_to(self.upper) * 1.000001 };
        BoundingSphere3D { centre, radius }
    }

    /// A box around the image of this one, rounded outward.
    ///
    /// Exact for the eight corners; looser than needed for a round body inside.
    pub fn transformed(&self, m: &AffineMatrix3D) -> Self {
        if self.is_empty() {
            return Self::EMPTY;
        }
        let mut image = Self::around(self.vertices().map(|p| *m * p));
        let reach = self.lower.max_abs().max(self.upper.max_abs());
        let size =
            |row: usize| (0..3).map(|c| m.get(row, c).abs()).sum::<f64>() * reach + m.get(row, 3).abs();
        for axis in 0..3 {
            image.pad_axis(axis, 8.0 * f64::EPSILON * size(axis));
        }
        image
    }

    /// True if the ray, from its origin on, meets the box. `max_distance` is not looked at.
    pub fn hit(&self, ray: &Ray) -> bool {
        self.full_intersection(ray).is_some()
    }

    /// Where the line of the ray enters and leaves the box, if the ray meets it from its origin on.
    pub fn full_intersection(&self, ray: &Ray) -> Option<Interval> {
        let mut within = Interval::new(f64::NEG_INFINITY, f64::INFINITY);
        for axis in 0..3 {
            let (o, d) = (ray.origin[axis], ray.direction[axis]);
            if d == 0.0 {
                if o < self.lower[axis] || o > self.upper[axis] {
                    return None;
                }
                continue;
            }
            let (a, b) = ((self.lower[axis] - o) / d, (self.upper[axis] - o) / d);
            within.min = within.min.max(a.min(b));
            within.max = within.max.min(a.max(b));
        }
        (within.max >= 0.0 && within.min <= within.max).then_some(within)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use raysect_math::{Vector3D, rotate, translate};

    fn unit() -> BoundingBox3D {
        BoundingBox3D::new(Point3D::ORIGIN, Point3D::new(1.0, 2.0, 3.0)).unwrap()
    }

    #[test]
    fn measures() {
        let b = unit();
        assert_eq!((b.volume(), b.surface_area(), b.largest_axis()), (6.0, 22.0, 2));
        assert_eq!(b.vertices()[1], Point3D::new(0.0, 0.0, 3.0));
        assert_eq!(b.vertices()[4], Point3D::new(1.0, 0.0, 0.0));
        assert!(b.contains(b.upper) && !b.contains(Point3D::new(0.5, 0.5, 3.1)));
        let sphere = b.enclosing_sphere();
        assert!(b.vertices().iter().all(|&p| sphere.contains(p)));
    }

    #[test]
    fn empty_boxes_vanish() {
        let e = BoundingBox3D::EMPTY;
        assert_eq!(e.union(&unit()), unit());
        assert_eq!((e.volume(), e.surface_area(), e.is_empty()), (0.0, 0.0, true));
        let far = BoundingBox3D::around([Point3D::new(5.0, 5.0, 5.0)]);
        assert!(unit().intersection(&far).is_empty());
        assert!(BoundingBox3D::new(Point3D::new(1.0, 0.0, 0.0), Point3D::ORIGIN).is_err());
    }

    #[test]
    fn rays_in_a_face_meet_the_box() {
        let along = Ray::new(Point3D::new(0.0, 0.0, -1.0), Vector3D::Z);
        assert_eq!(unit().full_intersection(&along), Some(Interval::new(1.0, 4.0)));
        let negative_zero = Ray::new(Point3D::new(1.0, 2.0, -1.0), Vector3D::new(-0.0, 0.0, 1.0));
        assert!(unit().hit(&negative_zero));
        assert!(!unit().hit(&Ray::new(Point3D::new(1.1, 0.0, -1.0), Vector3D::Z)));
        assert!(!unit().hit(&Ray::new(Point3D::new(0.5, 0.5, 4.0), Vector3D::Z)));
    }

    #[test]
    fn images_enclose_the_image() {
        let m = translate(10.0, -3.0, 2.0) * rotate(20.0, 40.0, 60.0);
        let image = unit().transformed(&m);
        assert!(unit().vertices().iter().all(|&p| image.contains(m * p)));
        assert!(BoundingBox3D::EMPTY.transformed(&m).is_empty());
    }
}
