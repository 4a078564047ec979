use crate::Vector3D;

/// Three perpendicular unit vectors, right-handed: `x × y = z`.
///
/// It turns directions sampled about the local z axis into the world and back.
///
/// ```
/// use raysect_math::{Frame, Vector3D};
/// let frame = Frame::from_z(Vector3D::Y);
/// assert_eq!(frame.to_world(Vector3D::Z), Vector3D::Y);
/// assert_eq!(frame.to_local(Vector3D::Y), Vector3D::Z);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Frame {
    /// First axis, of unit length.
    pub x: Vector3D,
    /// Second axis, of unit length.
    pub y: Vector3D,
    /// Third axis, of unit length: the normal or the axis of a cone.
    pub z: Vector3D,
}

impl Frame {
    /// The frame whose z axis is the given unit vector, orthonormal to rounding for every direction, −z
    /// included; the turn about z is arbitrary but fixed.
    ///
    /// T. Duff et al., *Building an Orthonormal Basis, Revisited*, Journal of Computer Graphics Techniques
    /// 6(1), 2017.
    #[inline]
    pub fn from_z(unit: Vector3D) -> Self {
        let Vector3D { x, y, z } = unit;
        let sign = 1f64.copysign(z);
        let a = -1.0 / (sign + z);
        let b = x * y * a;
        Self {
            x: Vector3D::new(1.0 + sign * x * x * a, sign * b, -sign * x),
            y: Vector3D::new(b, sign + y * y * a, -y),
            z: unit,
        }
    }

    /// The world vector with the given components along x, y and z of this frame.
    #[inline]
    pub fn to_world(&self, v: Vector3D) -> Vector3D {
        self.x * v.x + self.y * v.y + self.z * v.z
    }

    /// The components of a world vector along x, y and z of this frame.
    #[inline]
    pub fn to_local(&self, v: Vector3D) -> Vector3D {
        Vector3D::new(self.x.dot(v), self.y.dot(v), self.z.dot(v))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn assert_orthonormal(frame: &Frame) {
        let tolerance = 8.0 * f64::EPSILON;
        for axis in [frame.x, frame.y, frame.z] {
            assert!((axis.length() - 1.0).abs() <= tolerance, "{frame:?}");
        }
        assert!((frame.x.cross(frame.y) - frame.z).length() <= tolerance, "{frame:?}");
        assert!((frame.y.cross(frame.z) - frame.x).length() <= tolerance, "{frame:?}");
    }

    #[test]
    fn the_poles_and_the_equator_have_frames() {
        let (up, down) = (Frame::from_z(Vector3D::Z), Frame::from_z(-Vector3D::Z));
        assert_eq!((up.x, up.y), (Vector3D::X, Vector3D::Y));
        assert_eq!((down.x, down.y), (Vector3D::X, -Vector3D::Y));
        for zero in [0.0, -0.0] {
            for (x, y) in [(1.0, 0.0), (0.0, 1.0), (-0.6, 0.8)] {
                assert_orthonormal(&Frame::from_z(Vector3D::new(x, y, zero)));
            }
        }
    }

    proptest! {
        #[test]
        fn frames_are_orthonormal_at_any_distance_from_the_poles(
            exponent in -320.0..0.0f64, turn in 0.0..std::f64::consts::TAU, below in any::<bool>(),
        ) {
            let r = 10f64.powf(exponent);
            let z = ((1.0 - r) * (1.0 + r)).sqrt();
            assert_orthonormal(&Frame::from_z(Vector3D::new(
                r * turn.cos(), r * turn.sin(), if below { -z } else { z },
            )));
        }

        #[test]
        fn vectors_come_back(n in prop::array::uniform3(-1.0..1.0f64), v in prop::array::uniform3(-1e3..1e3f64)) {
            prop_assume!(Vector3D::from(n).length() > 1e-3);
            let (frame, v) = (Frame::from_z(Vector3D::from(n).normalise().unwrap()), Vector3D::from(v));
            prop_assert!((frame.to_local(frame.to_world(v)) - v).length() <= 1e-14 * v.length());
            prop_assert!((frame.to_world(v).dot(frame.z) - v.z).abs() <= 1e-14 * v.length());
        }
    }
}
