use std::ops::{Add, Div, Mul, Neg, Sub};

use crate::components::indexed;
use crate::transform::sin_cos;
use crate::{AffineMatrix3D, MathError, Vector3D};

/// A quaternion x i + y j + z k + s; one of unit length is a rotation.
///
/// `a * b` is Hamilton's product: of two rotations, the one that applies `b` first. `q` and `−q` are the same
/// rotation. A quotient is the product with an inverse, `a * b.inverse()?`.
///
/// ```
/// use raysect_math::{Quaternion, Vector3D};
/// let quarter = Quaternion::from_axis_angle(Vector3D::Y, 90.0)?;
/// assert!(((quarter * quarter).angle()? - 180.0).abs() < 1e-13);
/// assert!((quarter.to_matrix()? * Vector3D::Z - Vector3D::X).length() < 1e-15);
/// // The turn that leads from one attitude to another.
/// let attitude = Quaternion::from_axis_angle(Vector3D::Y, 90.0 + 1e-9)?;
/// assert!((quarter.quaternion_to(attitude)?.angle()? / 1e-9 - 1.0).abs() < 1e-4);
/// # Ok::<(), raysect_math::MathError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Quaternion {
    /// Component along i.
    pub x: f64,
    /// Component along j.
    pub y: f64,
    /// Component along k.
    pub z: f64,
    /// Scalar part.
    pub s: f64,
}

impl Default for Quaternion {
    /// No rotation.
    fn default() -> Self {
        Self::IDENTITY
    }
}

impl Quaternion {
    /// No rotation: (0, 0, 0, 1).
    pub const IDENTITY: Self = Self::new(0.0, 0.0, 0.0, 1.0);

    /// From its components, the scalar part last.
    #[inline]
    pub const fn new(x: f64, y: f64, z: f64, s: f64) -> Self {
        Self { x, y, z, s }
    }

    /// The rotation about an axis by an angle [deg], right-handed.
    ///
    /// Whole turns are taken off first, so that the scalar part is never negative: the angle of the result lies in
    /// 0 … 180.
    ///
    /// # Errors
    /// [`MathError::NoDirection`] for an axis of zero length, [`MathError::OutOfRange`] for an angle that is not finite.
    pub fn from_axis_angle(axis: Vector3D, angle: f64) -> Result<Self, MathError> {
        MathError::check(angle.is_finite(), angle, "rotation angle", "deg", "finite")?;
        let mut turn = angle % 360.0;
        if turn.abs() > 180.0 {
            turn -= 360f64.copysign(turn);
        }
        let (sin, cos) = sin_cos(0.5 * turn);
        Ok(Self::from_parts(axis.normalise()? * sin, cos))
    }

    /// The rotation that a matrix makes; its translation does not count.
    ///
    /// The largest component is found first, and the others from it without cancellation (S. W. Shepperd, *Quaternion
    /// from Rotation Matrix*, Journal of Guidance and Control 1, 1978).
    ///
    /// # Errors
    /// [`MathError::NotRotation`] if lengths or right angles are changed by more than 1e-8 or handedness is.
    pub fn from_matrix(m: &AffineMatrix3D) -> Result<Self, MathError> {
        check_rotation(m)?;
        let e = |row, column| m.get(row, column);
        let trace = e(0, 0) + e(1, 1) + e(2, 2);
        let diagonal = [e(0, 0), e(1, 1), e(2, 2), trace];
        let largest = (0..4).fold(3, |best, i| if diagonal[i] > diagonal[best] { i } else { best });
        let mut q = [0.0; 4];
        if largest == 3 {
            q = [e(2, 1) - e(1, 2), e(0, 2) - e(2, 0), e(1, 0) - e(0, 1), 1.0 + trace];
        } else {
            let [i, j, k] = [largest, (largest + 1) % 3, (largest + 2) % 3];
            q[i] = 1.0 + e(i, i) - e(j, j) - e(k, k);
            q[j] = e(j, i) + e(i, j);
            q[k] = e(k, i) + e(i, k);
            q[3] = e(k, j) - e(j, k);
        }
        let sign = if q[3] < 0.0 { -1.0 } else { 1.0 };
        Ok(Self::new(q[0], q[1], q[2], q[3]).normalise()? * sign)
    }

    /// The matrix of the rotation, of any length other than zero.
    ///
    /// # Errors
    /// [`MathError::NullQuaternion`] for a quaternion of zero length or one that is not finite.
    #[doc(alias = "as_matrix")]
    pub fn to_matrix(self) -> Result<AffineMatrix3D, MathError> {
        let Self { x, y, z, s } = self.normalise()?;
        let (xx, yy, zz) = (2.0 * x * x, 2.0 * y * y, 2.0 * z * z);
        let (xy, xz, yz) = (2.0 * x * y, 2.0 * x * z, 2.0 * y * z);
        let (xs, ys, zs) = (2.0 * x * s, 2.0 * y * s, 2.0 * z * s);
        Ok(AffineMatrix3D::from_axes(
            Vector3D::new(1.0 - (yy + zz), xy + zs, xz - ys),
            Vector3D::new(xy - zs, 1.0 - (xx + zz), yz + xs),
            Vector3D::new(xz + ys, yz - xs, 1.0 - (xx + yy)),
            crate::Point3D::ORIGIN,
        ))
    }

    fn from_parts(vector: Vector3D, s: f64) -> Self {
        Self::new(vector.x, vector.y, vector.z, s)
    }

    fn vector(self) -> Vector3D {
        Vector3D::new(self.x, self.y, self.z)
    }

    /// Scalar product of the four components.
    #[inline]
    pub fn dot(self, other: Self) -> f64 {
        self.vector().dot(other.vector()) + self.s * other.s
    }

    /// Euclidean length, right for every finite input.
    pub fn length(self) -> f64 {
        // Neither step can overflow before the result does.
        self.vector().length().hypot(self.s)
    }

    /// The quaternion of the same direction with length 1.
    ///
    /// # Errors
    /// [`MathError::NullQuaternion`] for a quaternion of zero length or one that is not finite.
    #[doc(alias = "normalize")]
    pub fn normalise(self) -> Result<Self, MathError> {
        let largest = self.vector().max_abs().max(self.s.abs());
        if largest == 0.0 || !(self.vector().is_finite() && self.s.is_finite()) {
            let Self { x, y, z, s } = self;
            return Err(MathError::NullQuaternion { x, y, z, s });
        }
        let scaled = self / largest;
        Ok(scaled / scaled.dot(scaled).sqrt())
    }

    /// The quaternion of the same direction with the given length.
    ///
    /// # Errors
    /// [`MathError::NullQuaternion`] for a quaternion of zero length or one that is not finite.
    pub fn with_length(self, length: f64) -> Result<Self, MathError> {
        Ok(self.normalise()? * length)
    }

    /// True if the length differs from 1 by no more than `tolerance` (Raysect's default 1e-10).
    pub fn is_unit(self, tolerance: f64) -> bool {
        (1.0 - self.length()).abs() <= tolerance
    }

    /// (−x, −y, −z, s): of a rotation, the one back.
    #[inline]
    pub fn conjugate(self) -> Self {
        Self::from_parts(-self.vector(), self.s)
    }

    /// The quaternion whose product with this one is the identity: the conjugate over the squared length.
    ///
    /// # Errors
    /// [`MathError::NullQuaternion`] for a quaternion of zero length, one that is not finite, or one whose inverse
    /// would not be.
    pub fn inverse(self) -> Result<Self, MathError> {
        let inverse = self.normalise()?.conjugate() / self.length();
        if inverse.vector().is_finite() && inverse.s.is_finite() {
            Ok(inverse)
        } else {
            let Self { x, y, z, s } = self;
            Err(MathError::NullQuaternion { x, y, z, s })
        }
    }

    /// Unit vector along the axis of the rotation; the null vector if there is no rotation, or no finite one.
    pub fn axis(self) -> Vector3D {
        self.vector().normalise().unwrap_or(Vector3D::ZERO)
    }

    /// Angle of the rotation about [`axis`](Self::axis) [deg], in 0 … 360 (beyond 180 if the scalar part is negative).
    ///
    /// `2 atan2(|v|, s)` keeps the digits of small angles, which the arc cosine of the scalar part loses
    /// (W. Kahan, *How Futile are Mindless Assessments of Roundoff*, 2006, § 12).
    ///
    /// # Errors
    /// [`MathError::NullQuaternion`] for a quaternion of zero length or one that is not finite.
    pub fn angle(self) -> Result<f64, MathError> {
        let unit = self.normalise()?;
        Ok((2.0 * unit.vector().length().atan2(unit.s)).to_degrees())
    }

    /// The rotation that takes this one to `other`: `r * self` is `other`, both taken at unit length.
    ///
    /// # Errors
    /// [`MathError::NullQuaternion`] if either has zero length or is not finite.
    pub fn quaternion_to(self, other: Self) -> Result<Self, MathError> {
        (other.normalise()? * self.normalise()?.conjugate()).normalise()
    }

    /// The rotation that has done the fraction `t` of the way from this one to `other`, by the shorter way; a unit
    /// quaternion.
    ///
    /// The angle comes from `2 atan2(|a − b|, |a + b|)`, so that nothing is lost or undefined where the rotations are
    /// alike; for opposite turns by 180° the way leads through a fixed one of the many. (K. Shoemake, *Animating rotation
    /// with quaternion curves*, SIGGRAPH 1985.)
    ///
    /// ```
    /// use raysect_math::{Quaternion, Vector3D};
    /// let quarter = Quaternion::from_axis_angle(Vector3D::Z, 90.0)?;
    /// let third = Quaternion::IDENTITY.slerp(quarter, 1.0 / 3.0)?;
    /// assert!((third.angle()? - 30.0).abs() < 1e-13 && third.axis() == Vector3D::Z);
    /// # Ok::<(), raysect_math::MathError>(())
    /// ```
    ///
    /// # Errors
    /// [`MathError::OutOfRange`] for `t` outside 0 … 1, [`MathError::NullQuaternion`] if either has zero length or is not
    /// finite.
    pub fn slerp(self, other: Self, t: f64) -> Result<Self, MathError> {
        MathError::check((0.0..=1.0).contains(&t), t, "t", "", "0 … 1")?;
        let (a, b) = (self.normalise()?, other.normalise()?);
        // q and −q are the same rotation: the half sphere of the first has the nearer one.
        let b = if a.dot(b) < 0.0 { -b } else { b };
        let (apart, together) = ((b - a).length(), (b + a).length());
        let angle = 2.0 * apart.atan2(together);
        let sine = angle.sin();
        if sine == 0.0 {
            return Ok(a);
        }
        (a * ((1.0 - t) * angle).sin() + b * (t * angle).sin()).with_length(1.0)
    }

    /// The rotation by the same angle about the axis that the map makes of this axis; the length is kept.
    ///
    /// # Errors
    /// [`MathError::NoDirection`] if the map takes the axis to nothing or beyond all numbers.
    pub fn transform(self, m: &AffineMatrix3D) -> Result<Self, MathError> {
        let axis = self.axis();
        if axis == Vector3D::ZERO {
            return Ok(self);
        }
        let turned = m.transform_vector(axis).normalise()?;
        Ok(Self::from_parts(turned * self.vector().length(), self.s))
    }
}

/// `Ok` if the three axes are unit vectors at right angles, right-handed.
fn check_rotation(m: &AffineMatrix3D) -> Result<(), MathError> {
    let axes = [m.axis(0), m.axis(1), m.axis(2)];
    let mut deviation: f64 = 0.0;
    for i in 0..3 {
        for j in 0..=i {
            let error = (axes[i].dot(axes[j]) - if i == j { 1.0 } else { 0.0 }).abs();
            // `max` would drop a NaN.
            deviation = if error.is_nan() { f64::INFINITY } else { deviation.max(error) };
        }
    }
    let determinant = m.determinant();
    if deviation <= 1e-8 && determinant > 0.0 {
        Ok(())
    } else {
        Err(MathError::NotRotation { deviation, determinant })
    }
}

indexed!(Quaternion, "a quaternion", 0 => x, 1 => y, 2 => z, 3 => s);

impl From<[f64; 4]> for Quaternion {
    #[inline]
    fn from([x, y, z, s]: [f64; 4]) -> Self {
        Self::new(x, y, z, s)
    }
}

impl From<Quaternion> for [f64; 4] {
    #[inline]
    fn from(q: Quaternion) -> Self {
        [q.x, q.y, q.z, q.s]
    }
}

impl Add for Quaternion {
    type Output = Self;
    #[inline]
    fn add(self, b: Self) -> Self {
        Self::from_parts(self.vector() + b.vector(), self.s + b.s)
    }
}

impl Sub for Quaternion {
    type Output = Self;
    #[inline]
    fn sub(self, b: Self) -> Self {
        Self::from_parts(self.vector() - b.vector(), self.s - b.s)
    }
}

impl Neg for Quaternion {
    type Output = Self;
    #[inline]
    fn neg(self) -> Self {
        Self::from_parts(-self.vector(), -self.s)
    }
}

impl Mul<f64> for Quaternion {
    type Output = Self;
    #[inline]
    fn mul(self, k: f64) -> Self {
        Self::from_parts(self.vector() * k, self.s * k)
    }
}

impl Mul<Quaternion> for f64 {
    type Output = Quaternion;
    #[inline]
    fn mul(self, q: Quaternion) -> Quaternion {
        q * self
    }
}

impl Div<f64> for Quaternion {
    type Output = Self;
    #[inline]
    fn div(self, k: f64) -> Self {
        Self::from_parts(self.vector() / k, self.s / k)
    }
}

impl Mul for Quaternion {
    type Output = Self;
    #[inline]
    fn mul(self, b: Self) -> Self {
        let (v, w) = (self.vector(), b.vector());
        Self::from_parts(w * self.s + v * b.s + v.cross(w), self.s * b.s - v.dot(w))
    }
}

#[cfg(test)]
mod tests;
