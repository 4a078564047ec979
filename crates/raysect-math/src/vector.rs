use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub, SubAssign};

use crate::components::indexed;
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

    /// A vector of the same direction with the given length [same unit as the components].
    ///
    /// # Errors
    /// [`MathError::NoDirection`] for a zero vector or one that is not finite.
    pub fn with_length(self, length: f64) -> Result<Self, MathError> {
        Ok(self.normalise()? * length)
    }

    /// Both components.
    #[inline]
    pub const fn to_array(self) -> [f64; 2] {
        [self.x, self.y]
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

impl From<[f64; 2]> for Vector2D {
    #[inline]
    fn from([x, y]: [f64; 2]) -> Self {
        Self::new(x, y)
    }
}

impl From<Vector2D> for [f64; 2] {
    #[inline]
    fn from(v: Vector2D) -> Self {
        v.to_array()
    }
}

indexed!(Vector2D, "a vector in a plane", 0 => x, 1 => y);

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
mod tests;
