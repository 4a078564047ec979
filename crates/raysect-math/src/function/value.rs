use crate::Vector3D;

/// What a function yields: a number or a vector.
pub trait Value: Copy + Send + Sync + 'static {
    /// The number, or the components of the vector.
    fn components(self) -> Vec<f64>;

    /// True if no component is infinite or NaN.
    fn is_finite(self) -> bool;

    /// The passage from `self` at `t` = 0 to `other` at `t` = 1: linear for numbers; directions of vectors turn.
    fn blend(self, other: Self, t: f64) -> Self;

    /// Turned about the z axis by the angle with the given cosine and sine; numbers have no direction and stay.
    fn turned(self, cosine: f64, sine: f64) -> Self;
}

impl Value for f64 {
    fn components(self) -> Vec<f64> {
        vec![self]
    }

    #[inline]
    fn is_finite(self) -> bool {
        f64::is_finite(self)
    }

    #[inline]
    fn blend(self, other: Self, t: f64) -> Self {
        self * (1.0 - t) + other * t
    }

    #[inline]
    fn turned(self, _: f64, _: f64) -> Self {
        self
    }
}

impl Value for Vector3D {
    fn components(self) -> Vec<f64> {
        vec![self.x, self.y, self.z]
    }

    #[inline]
    fn is_finite(self) -> bool {
        Vector3D::is_finite(self)
    }

    /// By [`Vector3D::slerp`]. A null vector has no direction to turn from: the linear passage is its limit.
    fn blend(self, other: Self, t: f64) -> Self {
        self.slerp(other, t).unwrap_or(self * (1.0 - t) + other * t)
    }

    #[inline]
    fn turned(self, cosine: f64, sine: f64) -> Self {
        Self::new(self.x * cosine - self.y * sine, self.x * sine + self.y * cosine, self.z)
    }
}
