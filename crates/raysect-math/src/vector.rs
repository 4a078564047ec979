use std::ops::{Add, AddAssign, Div, Index, Mul, Neg, Sub, SubAssign};

use crate::triple::direction_arithmetic;
use crate::{MathError, Normal3D};

/// A displacement or direction in space [m, or a pure number].
///
/// Axes are right-handed: x to the left, y up, z forward.
///
/// ```
/// use raysect_math::Vector3D;
/// let a = Vector3D::new(1.0, 0.0, 0.0);
/// let b = Vector3D::new(0.0, 2.0, 0.0);
/// assert_eq!(a.cross(b), Vector3D::new(0.0, 0.0, 2.0));
/// assert_eq!(a.angle(b), Ok(90.0));
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Vector3D {
    /// Component along x (left).
    pub x: f64,
    /// Component along y (up).
    pub y: f64,
    /// Component along z (forward).
    pub z: f64,
}

direction_arithmetic!(Vector3D, Normal3D);

impl Default for Vector3D {
    /// The z axis, as in Raysect.
    fn default() -> Self {
        Self::Z
    }
}

impl Vector3D {
    /// Unit vector along x (to the left).
    pub const X: Self = Self::new(1.0, 0.0, 0.0);
    /// Unit vector along y (up).
    pub const Y: Self = Self::new(0.0, 1.0, 0.0);
    /// Unit vector along z (forward).
    pub const Z: Self = Self::new(0.0, 0.0, 1.0);
    /// Unit vector upwards, +y.
    pub const UP: Self = Self::Y;
    /// Unit vector downwards, −y.
    pub const DOWN: Self = Self::new(0.0, -1.0, 0.0);
    /// Unit vector to the left, +x.
    pub const LEFT: Self = Self::X;
    /// Unit vector to the right, −x.
    pub const RIGHT: Self = Self::new(-1.0, 0.0, 0.0);
    /// Unit vector forwards, +z.
    pub const FORWARD: Self = Self::Z;
    /// Unit vector backwards, −z.
    pub const BACK: Self = Self::new(0.0, 0.0, -1.0);
    /// The null vector.
    pub const ZERO: Self = Self::new(0.0, 0.0, 0.0);

    /// `(1 − t) self + t other`, for `t` in 0 … 1.
    ///
    /// # Errors
    /// [`MathError::OutOfRange`] for `t` outside 0 … 1.
    pub fn lerp(self, other: Self, t: f64) -> Result<Self, MathError> {
        MathError::check((0.0..=1.0).contains(&t), t, "t", "", "0 … 1")?;
        Ok(self * (1.0 - t) + other * t)
    }

    /// The direction turned by the fraction `t` of the angle from `self` to `other` in their common plane;
    /// the length is interpolated linearly.
    ///
    /// Directions that are opposite to rounding have no common plane: the turn goes through [`orthogonal`](Self::orthogonal).
    /// (K. Shoemake, *Animating rotation with quaternion curves*, SIGGRAPH 1985.)
    ///
    /// # Errors
    /// [`MathError::OutOfRange`] for `t` outside 0 … 1, [`MathError::NoDirection`] for a zero vector.
    pub fn slerp(self, other: Self, t: f64) -> Result<Self, MathError> {
        MathError::check((0.0..=1.0).contains(&t), t, "t", "", "0 … 1")?;
        let (a, b) = (self.normalise()?, other.normalise()?);
        let length = self.length() * (1.0 - t) + other.length() * t;
        let same_side = a.dot(b) > 0.0;
        // Small where a and b lie along one line, with digits that their projections would lose.
        let between = if same_side { b - a } else { b + a };
        let side = if between.max_abs() > 8.0 * f64::EPSILON {
            // Twice is enough: nearly parallel directions leave a first remainder that is not quite upright.
            let across = (between - a * a.dot(between)).normalise()?;
            (across - a * a.dot(across)).normalise()?
        } else if same_side {
            return Ok(a * length);
        } else {
            a.orthogonal()?
        };
        let turn = t * self.angle(other)?.to_radians();
        Ok((a * turn.cos() + side * turn.sin()) * length)
    }
}

impl AddAssign for Vector3D {
    #[inline]
    fn add_assign(&mut self, b: Self) {
        *self = *self + b;
    }
}

impl SubAssign for Vector3D {
    #[inline]
    fn sub_assign(&mut self, b: Self) {
        *self = *self - b;
    }
}

/// A displacement or direction in a plane.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Vector2D {
    /// Component along x.
    pub x: f64,
    /// Component along y.
    pub y: f64,
}

impl Default for Vector2D {
    /// The x axis, as in Raysect.
    fn default() -> Self {
        Self::new(1.0, 0.0)
    }
}

impl Vector2D {
    /// From its two components.
    #[inline]
    pub const fn new(x: f64, y: f64) -> Self {
        Self { x, y }
    }

    /// Scalar product.
    #[inline]
    pub fn dot(self, other: Self) -> f64 {
        self.x * other.x + self.y * other.y
    }

    /// The z component of the vector product, `ax by − ay bx`.
    #[inline]
    pub fn cross(self, other: Self) -> f64 {
        self.x * other.y - self.y * other.x
    }

    /// Euclidean length.
    #[inline]
    pub fn length(self) -> f64 {
        self.x.hypot(self.y)
    }

    /// The unit vector along this direction.
    ///
    /// # Errors
    /// [`MathError::NoDirection`] for a zero vector or one that is not finite.
    #[doc(alias = "normalize")]
    pub fn normalise(self) -> Result<Self, MathError> {
        let length = self.length();
        if length == 0.0 || !length.is_finite() {
            return Err(MathError::NoDirection { x: self.x, y: self.y, z: 0.0 });
        }
        // Two steps keep lengths right whose reciprocal would overflow.
        let scale = self.x.abs().max(self.y.abs());
        let (x, y) = (self.x / scale, self.y / scale);
        let unit = x.hypot(y);
        Ok(Self::new(x / unit, y / unit))
    }

    /// The unit vector perpendicular to this one, turned by +90°: `(−y, x) / length`.
    ///
    /// # Errors
    /// [`MathError::NoDirection`] for a zero vector or one that is not finite.
    pub fn orthogonal(self) -> Result<Self, MathError> {
        let n = self.normalise()?;
        Ok(Self::new(-n.y, n.x))
    }
}

impl From<Vector2D> for [f64; 2] {
    #[inline]
    fn from(v: Vector2D) -> Self {
        [v.x, v.y]
    }
}

impl Add for Vector2D {
    type Output = Self;
    #[inline]
    fn add(self, b: Self) -> Self {
        Self::new(self.x + b.x, self.y + b.y)
    }
}

impl Sub for Vector2D {
    type Output = Self;
    #[inline]
    fn sub(self, b: Self) -> Self {
        Self::new(self.x - b.x, self.y - b.y)
    }
}

impl Neg for Vector2D {
    type Output = Self;
    #[inline]
    fn neg(self) -> Self {
        Self::new(-self.x, -self.y)
    }
}

impl Mul<f64> for Vector2D {
    type Output = Self;
    #[inline]
    fn mul(self, s: f64) -> Self {
        Self::new(self.x * s, self.y * s)
    }
}

impl Mul<Vector2D> for f64 {
    type Output = Vector2D;
    #[inline]
    fn mul(self, v: Vector2D) -> Vector2D {
        v * self
    }
}

impl Div<f64> for Vector2D {
    type Output = Self;
    #[inline]
    fn div(self, s: f64) -> Self {
        Self::new(self.x / s, self.y / s)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn component() -> impl Strategy<Value = f64> {
        (-1.0..1.0f64, -300..300i32).prop_map(|(m, e)| m * 10f64.powi(e))
    }

    #[test]
    fn opposite_and_equal_directions_have_exact_angles() {
        let v = Vector3D::new(0.1, -0.7, 0.3);
        assert_eq!(v.angle(v).unwrap(), 0.0);
        assert_eq!(v.angle(-v).unwrap(), 180.0);
        assert!(Vector3D::ZERO.angle(v).is_err());
    }

    #[test]
    fn slerp_turns_by_the_fraction_of_the_angle() {
        let (a, b) = (Vector3D::X, Vector3D::new(0.0, 3.0, 0.0));
        let half = a.slerp(b, 0.5).unwrap();
        assert!((half.length() - 2.0).abs() < 1e-15);
        assert!((half.angle(a).unwrap() - 45.0).abs() < 1e-13);
        let opposite = a.slerp(-a, 0.5).unwrap();
        assert!((opposite.angle(a).unwrap() - 90.0).abs() < 1e-13);
        assert!(a.slerp(b, 1.5).is_err());
    }

    #[test]
    fn a_plane_vector_turns_left() {
        assert_eq!(Vector2D::new(2.0, 0.0).orthogonal().unwrap(), Vector2D::new(0.0, 1.0));
        assert_eq!(Vector2D::new(1.0, 2.0).cross(Vector2D::new(3.0, 5.0)), -1.0);
    }

    #[test]
    fn slerp_is_finite_for_parallel_opposite_tiny_and_huge_vectors() {
        for a in [Vector3D::X, Vector3D::new(0.1, -0.7, 0.3), Vector3D::new(1.0, 1.0, 1.0)] {
            let o = a.orthogonal().unwrap();
            for shift in [0.0, 1e-300, 1e-17, 1e-16, 1e-15, 1e-12, 1e-8, 1e-3] {
                for (sign, scale) in [(1.0, 1.0), (-1.0, 1.0), (1.0, 1e-300), (-1.0, 1e300)] {
                    let b = (a * sign + o * shift) * scale;
                    let angle = a.angle(b).unwrap();
                    for t in [0.0, 1e-9, 0.5, 1.0] {
                        let v = a.slerp(b, t).unwrap();
                        assert!(v.is_finite(), "{a:?} {b:?} {t}");
                        assert!((v.angle(a).unwrap() - t * angle).abs() < 1e-13, "{a:?} {b:?} {t}");
                        assert!(a.lerp(b, t).unwrap().is_finite());
                    }
                }
            }
        }
        for t in [-0.1, 1.1, f64::NAN] {
            assert!(Vector3D::X.slerp(Vector3D::Y, t).is_err() && Vector3D::X.lerp(Vector3D::Y, t).is_err());
        }
        assert!(Vector3D::X.slerp(Vector3D::ZERO, 0.5).is_err());
    }

    proptest! {
        #[test]
        fn unit_vectors_have_unit_length_at_every_scale(x in component(), y in component(), z in component()) {
            let v = Vector3D::new(x, y, z);
            prop_assume!(v.max_abs() > 1e-305);
            let n = v.normalise().unwrap();
            prop_assert!((n.length() - 1.0).abs() <= 4.0 * f64::EPSILON);
            prop_assert!(n.dot(v) >= 0.0);
            let o = v.orthogonal().unwrap();
            prop_assert!(o.dot(n).abs() <= 4.0 * f64::EPSILON);
        }

        #[test]
        fn slerp_is_finite_and_keeps_lengths(
            a in prop::array::uniform3(-1.0..1.0f64), b in prop::array::uniform3(-1.0..1.0f64), t in 0.0..=1.0f64,
        ) {
            let (a, b) = (Vector3D::from(a), Vector3D::from(b));
            prop_assume!(a.length() > 1e-3 && b.length() > 1e-3);
            let v = a.slerp(b, t).unwrap();
            prop_assert!((v.length() - ((1.0 - t) * a.length() + t * b.length())).abs() < 1e-14);
        }
    }
}
