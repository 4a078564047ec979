//! The transforms that place things: translations and rotations in degrees, cylindrical coordinates.

use crate::{AffineMatrix3D, MathError, Point3D, Vector3D};

/// Moves by (x, y, z) [m].
pub fn translate(x: f64, y: f64, z: f64) -> AffineMatrix3D {
    AffineMatrix3D::from_axes(Vector3D::X, Vector3D::Y, Vector3D::Z, Point3D::new(x, y, z))
}

/// Sine and cosine of an angle in degrees, exact at multiples of 90°.
pub(crate) fn sin_cos(degrees: f64) -> (f64, f64) {
    let turn = degrees % 360.0;
    let quarter = (turn / 90.0).round();
    let (s, c) = (turn - 90.0 * quarter).to_radians().sin_cos();
    match quarter.rem_euclid(4.0) as i32 {
        0 => (s, c),
        1 => (c, -s),
        2 => (-s, -c),
        _ => (-c, s),
    }
}

/// Rotates about the x axis [deg], right-handed: `rotate_x(90)` takes +z to −y.
pub fn rotate_x(angle: f64) -> AffineMatrix3D {
    let (s, c) = sin_cos(angle);
    AffineMatrix3D::from_axes(
        Vector3D::X,
        Vector3D::new(0.0, c, s),
        Vector3D::new(0.0, -s, c),
        Point3D::ORIGIN,
    )
}

/// Rotates about the y axis [deg], right-handed: `rotate_y(90)` takes +z to +x.
pub fn rotate_y(angle: f64) -> AffineMatrix3D {
    let (s, c) = sin_cos(angle);
    AffineMatrix3D::from_axes(
        Vector3D::new(c, 0.0, -s),
        Vector3D::Y,
        Vector3D::new(s, 0.0, c),
        Point3D::ORIGIN,
    )
}

/// Rotates about the z axis [deg], right-handed: `rotate_z(90)` takes +x to +y.
pub fn rotate_z(angle: f64) -> AffineMatrix3D {
    let (s, c) = sin_cos(angle);
    AffineMatrix3D::from_axes(
        Vector3D::new(c, s, 0.0),
        Vector3D::new(-s, c, 0.0),
        Vector3D::Z,
        Point3D::ORIGIN,
    )
}

/// Rotates by intrinsic yaw, pitch and roll [deg] for a body that looks along z with x to its left and y up:
/// `rotate_y(−yaw) · rotate_x(−pitch) · rotate_z(roll)`.
pub fn rotate(yaw: f64, pitch: f64, roll: f64) -> AffineMatrix3D {
    rotate_y(-yaw) * rotate_x(-pitch) * rotate_z(roll)
}

/// Rotates about an axis [deg], right-handed (Rodrigues' formula).
///
/// # Errors
/// [`MathError::NoDirection`] for an axis of zero length.
pub fn rotate_vector(angle: f64, axis: Vector3D) -> Result<AffineMatrix3D, MathError> {
    let n = axis.normalise()?;
    let (s, c) = sin_cos(angle);
    let image = |v: Vector3D| v * c + n.cross(v) * s + n * (n.dot(v) * (1.0 - c));
    Ok(AffineMatrix3D::from_axes(image(Vector3D::X), image(Vector3D::Y), image(Vector3D::Z), Point3D::ORIGIN))
}

/// Rotates so that z points along `forward` and y as nearly as possible along `up`.
///
/// # Errors
/// [`MathError::NoDirection`] for a zero vector, [`MathError::Parallel`] if `up` lies along `forward`
/// to within 1e-7 degrees.
pub fn rotate_basis(forward: Vector3D, up: Vector3D) -> Result<AffineMatrix3D, MathError> {
    let z = forward.normalise()?;
    let angle = z.angle(up)?;
    if !(1e-7..=180.0 - 1e-7).contains(&angle) {
        return Err(MathError::Parallel { angle });
    }
    let x = up.normalise()?.cross(z).normalise()?;
    Ok(AffineMatrix3D::from_axes(x, z.cross(x), z, Point3D::ORIGIN))
}

/// Cylindrical coordinates (r [m], z [m], φ [deg] in (−180, 180]) of a point about the z axis.
pub fn to_cylindrical(point: Point3D) -> (f64, f64, f64) {
    // A negative zero in y would turn the half-plane φ = 180° into −180°.
    (point.x.hypot(point.y), point.z, (point.y + 0.0).atan2(point.x).to_degrees())
}

/// The point with cylindrical coordinates r [m], z [m], φ [deg] about the z axis.
///
/// # Errors
/// [`MathError::OutOfRange`] for a negative or NaN radius.
pub fn from_cylindrical(r: f64, z: f64, phi: f64) -> Result<Point3D, MathError> {
    MathError::check(r >= 0.0, r, "radius", "m", "0 or more")?;
    let (s, c) = sin_cos(phi);
    Ok(Point3D::new(r * c, r * s, z))
}

/// Yaw, pitch and roll [deg] of a rotation, the inverse of [`rotate`].
///
/// When it looks straight up or down (pitch ±90°, gimbal lock) only one angle is left of yaw and roll:
/// roll is then reported as 0.
pub fn extract_rotation(m: &AffineMatrix3D) -> (f64, f64, f64) {
    let [x, y, z] = [m.axis(0), m.axis(1), m.axis(2)];
    let pitch = z.y.atan2(z.x.hypot(z.z)).to_degrees();
    if z.x.hypot(z.z) <= 1e-12 * z.y.abs() {
        return (x.z.atan2(x.x).to_degrees(), pitch, 0.0);
    }
    (-z.x.atan2(z.z).to_degrees(), pitch, x.y.atan2(y.y).to_degrees())
}

/// Yaw, pitch and roll [deg] for a body whose own z axis points up and x axis forward
/// (Raysect's `extract_rotation(m, z_up=True)`).
#[doc(alias = "extract_rotation")]
pub fn extract_rotation_z_up(m: &AffineMatrix3D) -> (f64, f64, f64) {
    let [x, y, z] = [m.axis(0), m.axis(1), m.axis(2)];
    let pitch = x.z.atan2(x.x.hypot(x.y)).to_degrees();
    if x.x.hypot(x.y) <= 1e-12 * x.z.abs() {
        return (y.x.atan2(y.y).to_degrees(), pitch, 0.0);
    }
    (-x.y.atan2(x.x).to_degrees(), pitch, y.z.atan2(z.z).to_degrees())
}

/// The translation of a map [m].
pub fn extract_translation(m: &AffineMatrix3D) -> Vector3D {
    m.origin().to_vector()
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn right_angles_are_exact() {
        assert_eq!(rotate_x(90.0) * Vector3D::Z, Vector3D::new(0.0, -1.0, 0.0));
        assert_eq!(rotate_y(90.0) * Vector3D::Z, Vector3D::X);
        assert_eq!(rotate_z(-270.0) * Vector3D::X, Vector3D::Y);
        assert_eq!(rotate_z(720.0) * Vector3D::X, Vector3D::X);
    }

    #[test]
    fn a_basis_looks_forward_with_up_above() {
        let m = rotate_basis(Vector3D::new(1.0, 1.0, 0.0), Vector3D::Y).unwrap();
        let h = 0.5f64.sqrt();
        assert!((m * Vector3D::Z).angle(Vector3D::new(h, h, 0.0)).unwrap() < 1e-12);
        assert!((m * Vector3D::Y).angle(Vector3D::new(-h, h, 0.0)).unwrap() < 1e-12);
        assert!((m.determinant() - 1.0).abs() < 1e-14);
        assert!(rotate_basis(Vector3D::Y, Vector3D::new(0.0, -3.0, 0.0)).is_err());
    }

    #[test]
    fn looking_straight_up_keeps_the_rotation() {
        for pitch in [90.0, -90.0] {
            let m = rotate(35.0, pitch, 20.0);
            let (yaw, pitch, roll) = extract_rotation(&m);
            assert!(rotate(yaw, pitch, roll).is_close(&m, 1e-12));
        }
    }

    #[test]
    fn a_body_with_z_up_keeps_its_rotation() {
        let compose = |yaw: f64, pitch: f64, roll: f64| rotate_z(-yaw) * rotate_y(-pitch) * rotate_x(roll);
        for (yaw, pitch, roll) in
            [(20.0, 35.0, -50.0), (-170.0, -80.0, 10.0), (40.0, 90.0, 15.0), (40.0, -90.0, 15.0)]
        {
            let m = compose(yaw, pitch, roll);
            let (y, p, r) = extract_rotation_z_up(&m);
            assert!(compose(y, p, r).is_close(&m, 1e-12), "{yaw} {pitch} {roll}");
        }
    }

    proptest! {
        #[test]
        fn angles_come_back(yaw in -179.9..179.9f64, pitch in -89.9..89.9f64, roll in -179.9..179.9f64) {
            let (y, p, r) = extract_rotation(&rotate(yaw, pitch, roll));
            prop_assert!((y - yaw).abs() < 1e-10 && (p - pitch).abs() < 1e-10 && (r - roll).abs() < 1e-10);
        }

        #[test]
        fn cylindrical_coordinates_come_back(r in 1e-9..1e9f64, z in -1e9..1e9f64, phi in -179.99..180.0f64) {
            let (r2, z2, phi2) = to_cylindrical(from_cylindrical(r, z, phi).unwrap());
            prop_assert!((r2 / r - 1.0).abs() < 1e-15 * 4.0 && z2 == z && (phi2 - phi).abs() < 1e-12);
        }

        #[test]
        fn a_turn_about_an_axis_keeps_it(angle in -360.0..360.0f64, a in prop::array::uniform3(-1.0..1.0f64)) {
            let axis = Vector3D::from(a);
            prop_assume!(axis.length() > 1e-3);
            let m = rotate_vector(angle, axis).unwrap();
            prop_assert!((m * axis - axis).length() < 1e-14);
            prop_assert!((m.determinant() - 1.0).abs() < 1e-14);
        }
    }
}
