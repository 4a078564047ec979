//! What vectors and normals have in common, written once.

/// Implements the arithmetic that [`Vector3D`](crate::Vector3D) and [`Normal3D`](crate::Normal3D) share.
///
/// The result of `a + b` has the type of the left operand, as in Raysect.
macro_rules! direction_arithmetic {
    ($name:ident, $other:ident) => {
        impl $name {
            /// From its three components [m, or a pure number].
            #[inline]
            pub const fn new(x: f64, y: f64, z: f64) -> Self {
                Self { x, y, z }
            }

            /// Scalar product with a vector.
            // From z to x: compilers then load x and y as a pair, as they store them. Pairs of y and z, which they choose
            // otherwise, would lie across two stores and have to wait for both.
            #[inline]
            pub fn dot(self, other: impl Into<Vector3D>) -> f64 {
                let b: Vector3D = other.into();
                self.z * b.z + self.y * b.y + self.x * b.x
            }

            /// Vector product, right-handed.
            #[inline]
            pub fn cross(self, other: impl Into<Vector3D>) -> Vector3D {
                let b: Vector3D = other.into();
                Vector3D::new(
                    self.y * b.z - self.z * b.y,
                    self.z * b.x - self.x * b.z,
                    self.x * b.y - self.y * b.x,
                )
            }

            /// Sum of the squared components; may overflow or vanish for components beyond 1e±154.
            // In the order of the scalar product.
            #[inline]
            pub fn length_squared(self) -> f64 {
                self.z * self.z + self.y * self.y + self.x * self.x
            }

            /// Euclidean length, right for every finite input: no overflow, no loss of tiny components.
            #[inline]
            pub fn length(self) -> f64 {
                let squared = self.length_squared();
                if (1e-280..1e280).contains(&squared) {
                    return squared.sqrt();
                }
                let largest = self.max_abs();
                if largest == 0.0 || !largest.is_finite() {
                    return largest;
                }
                let (x, y, z) = (self.x / largest, self.y / largest, self.z / largest);
                largest * (x * x + y * y + z * z).sqrt()
            }

            /// The largest absolute component; NaN if one is NaN.
            #[inline]
            pub fn max_abs(self) -> f64 {
                let [x, y, z] = [self.x.abs(), self.y.abs(), self.z.abs()];
                let larger = if x > y { x } else { y };
                let largest = if larger > z { larger } else { z };
                // The sum of magnitudes is a NaN only if one of them is.
                if (x + y + z).is_nan() { f64::NAN } else { largest }
            }

            /// True if no component is infinite or NaN.
            #[inline]
            pub fn is_finite(self) -> bool {
                self.x.is_finite() && self.y.is_finite() && self.z.is_finite()
            }

            /// The unit vector along this direction.
            ///
            /// # Errors
            /// [`MathError::NoDirection`] for a zero vector or one that is not finite.
            #[doc(alias = "normalize")]
            pub fn normalise(self) -> Result<Self, MathError> {
                let length = self.length();
                if length == 0.0 || !length.is_finite() {
                    return Err(MathError::NoDirection { x: self.x, y: self.y, z: self.z });
                }
                // Two steps keep components right whose reciprocal length would overflow.
                let scale = self.max_abs();
                let Self { x, y, z } = self / scale;
                Ok(Self::new(x, y, z) * (1.0 / (x * x + y * y + z * z).sqrt()))
            }

            /// The unit vector along this direction, for a length known to lie in 1e-140 … 1e140.
            #[inline]
            pub fn normalise_unchecked(self) -> Self {
                self * (1.0 / self.length_squared().sqrt())
            }

            /// A vector of the same direction with the given length [same unit as the components].
            ///
            /// # Errors
            /// [`MathError::NoDirection`] for a zero vector or one that is not finite.
            pub fn with_length(self, length: f64) -> Result<Self, MathError> {
                Ok(self.normalise()? * length)
            }

            /// A unit vector perpendicular to this one (Raysect's rule: the x axis made orthogonal,
            /// or the y axis where the direction is within 60° of the x axis).
            ///
            /// # Errors
            /// [`MathError::NoDirection`] for a zero vector or one that is not finite.
            pub fn orthogonal(self) -> Result<Vector3D, MathError> {
                let n: Vector3D = self.normalise()?.into();
                let axis = if n.x.abs() <= 0.5 { Vector3D::X } else { Vector3D::Y };
                (axis - n * n.dot(axis)).normalise()
            }

            /// Angle to another direction [deg], in 0 … 180; never NaN for finite, non-zero vectors.
            ///
            /// `2 atan2(|a/|a| − b/|b||, |a/|a| + b/|b||)` is exact to rounding for every angle
            /// (W. Kahan, *How Futile are Mindless Assessments of Roundoff*, 2006, § 12).
            ///
            /// # Errors
            /// [`MathError::NoDirection`] if either vector has none.
            pub fn angle(self, other: impl Into<Vector3D>) -> Result<f64, MathError> {
                let a: Vector3D = self.normalise()?.into();
                let b: Vector3D = Into::<Vector3D>::into(other).normalise()?;
                Ok((2.0 * (a - b).length().atan2((a + b).length())).to_degrees())
            }

            /// The three components.
            #[inline]
            pub const fn to_array(self) -> [f64; 3] {
                [self.x, self.y, self.z]
            }
        }

        impl From<[f64; 3]> for $name {
            #[inline]
            fn from([x, y, z]: [f64; 3]) -> Self {
                Self::new(x, y, z)
            }
        }
        impl From<$name> for [f64; 3] {
            #[inline]
            fn from(v: $name) -> Self {
                v.to_array()
            }
        }

        impl From<glam::DVec3> for $name {
            #[inline]
            fn from(v: glam::DVec3) -> Self {
                Self::new(v.x, v.y, v.z)
            }
        }
        impl From<$name> for glam::DVec3 {
            #[inline]
            fn from(v: $name) -> Self {
                Self::new(v.x, v.y, v.z)
            }
        }
        impl From<$other> for $name {
            #[inline]
            fn from(v: $other) -> Self {
                Self::new(v.x, v.y, v.z)
            }
        }
        direction_arithmetic!(@binary $name, $name);
        direction_arithmetic!(@binary $name, $other);
        impl Neg for $name {
            type Output = Self;
            #[inline]
            fn neg(self) -> Self {
                Self::new(-self.x, -self.y, -self.z)
            }
        }
        impl Mul<f64> for $name {
            type Output = Self;
            #[inline]
            fn mul(self, s: f64) -> Self {
                Self::new(self.x * s, self.y * s, self.z * s)
            }
        }
        impl Mul<$name> for f64 {
            type Output = $name;
            #[inline]
            fn mul(self, v: $name) -> $name {
                v * self
            }
        }
        impl Div<f64> for $name {
            type Output = Self;
            #[inline]
            fn div(self, s: f64) -> Self {
                Self::new(self.x / s, self.y / s, self.z / s)
            }
        }
        indexed!($name, "a three-dimensional vector", 0 => x, 1 => y, 2 => z);
    };
    (@binary $name:ident, $other:ident) => {
        impl Add<$other> for $name {
            type Output = $name;
            #[inline]
            fn add(self, b: $other) -> $name {
                $name::new(self.x + b.x, self.y + b.y, self.z + b.z)
            }
        }
        impl Sub<$other> for $name {
            type Output = $name;
            #[inline]
            fn sub(self, b: $other) -> $name {
                $name::new(self.x - b.x, self.y - b.y, self.z - b.z)
            }
        }
    };
}
pub(crate) use direction_arithmetic;
