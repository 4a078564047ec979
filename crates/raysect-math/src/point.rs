use std::ops::{Add, Sub};

use crate::components::indexed;
use crate::{Normal3D, Vector2D, Vector3D};

/// A place in space [m].
///
/// Axes are right-handed: x to the left, y up, z forward.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Point3D {
    /// Coordinate along x (left) [m].
    pub x: f64,
    /// Coordinate along y (up) [m].
    pub y: f64,
    /// Coordinate along z (forward) [m].
    pub z: f64,
}

impl Point3D {
    /// (0, 0, 0).
    pub const ORIGIN: Self = Self::new(0.0, 0.0, 0.0);

    /// From its coordinates [m].
    #[inline]
    pub const fn new(x: f64, y: f64, z: f64) -> Self {
        Self { x, y, z }
    }

    /// The vector from this point to `other`.
    #[inline]
    pub fn vector_to(self, other: Self) -> Vector3D {
        Vector3D::new(other.x - self.x, other.y - self.y, other.z - self.z)
    }

    /// Euclidean distance [m].
    #[inline]
    pub fn distance_to(self, other: Self) -> f64 {
        self.vector_to(other).length()
    }

    /// The vector from the origin to this point.
    #[inline]
    pub const fn to_vector(self) -> Vector3D {
        Vector3D::new(self.x, self.y, self.z)
    }

    /// The three coordinates [m].
    #[inline]
    pub const fn to_array(self) -> [f64; 3] {
        [self.x, self.y, self.z]
    }

    /// The largest absolute coordinate [m]; NaN if one is NaN.
    #[inline]
    pub fn max_abs(self) -> f64 {
        self.to_vector().max_abs()
    }

    /// True if no coordinate is infinite or NaN.
    #[inline]
    pub fn is_finite(self) -> bool {
        self.to_vector().is_finite()
    }
}

impl From<[f64; 3]> for Point3D {
    #[inline]
    fn from([x, y, z]: [f64; 3]) -> Self {
        Self::new(x, y, z)
    }
}

impl From<Point3D> for [f64; 3] {
    #[inline]
    fn from(p: Point3D) -> Self {
        p.to_array()
    }
}

impl From<glam::DVec3> for Point3D {
    #[inline]
    fn from(v: glam::DVec3) -> Self {
        Self::new(v.x, v.y, v.z)
    }
}

impl From<Point3D> for glam::DVec3 {
    #[inline]
    fn from(p: Point3D) -> Self {
        Self::new(p.x, p.y, p.z)
    }
}

impl Add<Vector3D> for Point3D {
    type Output = Self;
    #[inline]
    fn add(self, v: Vector3D) -> Self {
        Self::new(self.x + v.x, self.y + v.y, self.z + v.z)
    }
}

impl Add<Normal3D> for Point3D {
    type Output = Self;
    #[inline]
    fn add(self, v: Normal3D) -> Self {
        self + v.as_vector()
    }
}

impl Sub<Vector3D> for Point3D {
    type Output = Self;
    #[inline]
    fn sub(self, v: Vector3D) -> Self {
        Self::new(self.x - v.x, self.y - v.y, self.z - v.z)
    }
}

impl Sub<Normal3D> for Point3D {
    type Output = Self;
    #[inline]
    fn sub(self, v: Normal3D) -> Self {
        self - v.as_vector()
    }
}

indexed!(Point3D, "a point in space", 0 => x, 1 => y, 2 => z);

/// A place in a plane [m].
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Point2D {
    /// Coordinate along x [m].
    pub x: f64,
    /// Coordinate along y [m].
    pub y: f64,
}

impl Point2D {
    /// From its coordinates [m].
    #[inline]
    pub const fn new(x: f64, y: f64) -> Self {
        Self { x, y }
    }

    /// The vector from this point to `other`.
    #[inline]
    pub fn vector_to(self, other: Self) -> Vector2D {
        Vector2D::new(other.x - self.x, other.y - self.y)
    }

    /// Euclidean distance [m].
    #[inline]
    pub fn distance_to(self, other: Self) -> f64 {
        self.vector_to(other).length()
    }

    /// Both coordinates [m].
    #[inline]
    pub const fn to_array(self) -> [f64; 2] {
        [self.x, self.y]
    }
}

impl From<[f64; 2]> for Point2D {
    #[inline]
    fn from([x, y]: [f64; 2]) -> Self {
        Self::new(x, y)
    }
}

impl From<Point2D> for [f64; 2] {
    #[inline]
    fn from(p: Point2D) -> Self {
        p.to_array()
    }
}

indexed!(Point2D, "a point in a plane", 0 => x, 1 => y);

impl Add<Vector2D> for Point2D {
    type Output = Self;
    #[inline]
    fn add(self, v: Vector2D) -> Self {
        Self::new(self.x + v.x, self.y + v.y)
    }
}

impl Sub<Vector2D> for Point2D {
    type Output = Self;
    #[inline]
    fn sub(self, v: Vector2D) -> Self {
        Self::new(self.x - v.x, self.y - v.y)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn points_move_along_vectors() {
        let p = Point3D::new(1.0, 2.0, 3.0);
        let q = p + Vector3D::new(0.0, -2.0, 1.0);
        assert_eq!(q, Point3D::new(1.0, 0.0, 4.0));
        assert_eq!(p.vector_to(q), Vector3D::new(0.0, -2.0, 1.0));
        assert_eq!(Point2D::new(0.0, 0.0).distance_to(Point2D::new(3.0, 4.0)), 5.0);
        assert_eq!([q[0], q[1], q[2]], q.to_array());
    }

    proptest! {
        #[test]
        fn a_vector_to_a_point_leads_there(p in prop::array::uniform3(-1e3..1e3f64), q in prop::array::uniform3(-1e3..1e3f64)) {
            let (a, b) = (Point3D::from(p), Point3D::from(q));
            prop_assert!((a + a.vector_to(b)).distance_to(b) < 1e-12 && (b - a.vector_to(b)).distance_to(a) < 1e-12);
            prop_assert_eq!(a + Normal3D::from(q), a + Vector3D::from(q));
            prop_assert_eq!(a - Normal3D::from(q), a - Vector3D::from(q));
            prop_assert_eq!(a.distance_to(b), b.distance_to(a));
            prop_assert_eq!(a.max_abs(), p.map(f64::abs).into_iter().fold(0.0, f64::max));
            let (a, b) = (Point2D::new(p[0], p[1]), Point2D::new(q[0], q[1]));
            prop_assert!((a + a.vector_to(b)).distance_to(b) < 1e-12 && (b - a.vector_to(b)).distance_to(a) < 1e-12);
        }

        #[test]
        fn points_are_made_of_their_coordinates(p in prop::array::uniform3(-1e3..1e3f64), axis in 0..3usize, x in -1.0..1.0f64) {
            let mut space = Point3D::from(p);
            prop_assert_eq!((space.to_array(), <[f64; 3]>::from(space)), (p, p));
            prop_assert_eq!(Point3D::from(glam::DVec3::from(space)), space);
            space[axis] = x;
            let expected = |i: usize| if i == axis { x } else { p[i] };
            prop_assert!((0..3).all(|i| space[i] == expected(i)));
            let mut plane = Point2D::from([p[0], p[1]]);
            prop_assert_eq!((plane.to_array(), <[f64; 2]>::from(plane)), ([p[0], p[1]], [p[0], p[1]]));
            plane[axis % 2] = x;
            let expected = |i: usize| if i == axis % 2 { x } else { p[i] };
            prop_assert!((0..2).all(|i| plane[i] == expected(i)));
        }
    }
}
