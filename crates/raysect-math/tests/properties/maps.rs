//! Maps of space and units.

use proptest::prelude::*;
use raysect_math::{
    AffineMatrix3D, Normal3D, Point3D, Vector3D, extract_rotation, extract_rotation_z_up,
    extract_translation, rotate, rotate_basis, rotate_vector, rotate_x, rotate_y, rotate_z, translate, units,
};

fn vector() -> impl Strategy<Value = Vector3D> {
    prop::array::uniform3(-1.0..1.0f64)
        .prop_map(Vector3D::from)
        .prop_filter("too short", |v| v.length() > 1e-2)
}

fn map() -> impl Strategy<Value = AffineMatrix3D> {
    let three = || prop::array::uniform3(-1.0..1.0f64).prop_map(Vector3D::from);
    (three(), three(), three(), prop::array::uniform3(-9.0..9.0f64))
        .prop_map(|(x, y, z, o)| AffineMatrix3D::from_axes(x, y, z, Point3D::from(o)))
        .prop_filter("nearly singular", |m| m.determinant().abs() > 1e-2)
}

proptest! {
    #[test]
    fn elements_come_back_in_every_form(m in map(), row in 0..4usize, column in 0..4usize) {
        let rows = m.to_rows();
        prop_assert_eq!(m.get(row, column), rows[row][column]);
        prop_assert_eq!(AffineMatrix3D::from_rows(rows), Ok(m));
        let flat: Vec<f64> = rows.concat();
        prop_assert_eq!(AffineMatrix3D::from_row_major(flat.try_into().unwrap()), Ok(m));
        prop_assert_eq!(AffineMatrix3D::from_axes(m.axis(0), m.axis(1), m.axis(2), m.origin()), m);
        prop_assert_eq!((extract_translation(&m), m.is_finite()), (m.origin().to_vector(), true));
        prop_assert_eq!(m.to_glam().transform_point3(glam::DVec3::ZERO), glam::DVec3::from(m.origin()));
        prop_assert!(m.is_close(&m, 1e-300) && !m.is_close(&m, 0.0) && !(m * translate(1.0, 0.0, 0.0)).is_close(&m, 1e-3));
    }

    #[test]
    fn products_apply_the_right_factor_first(m in map(), n in map(), v in vector()) {
        let p = Point3D::from(v.to_array());
        prop_assert!(((m * n) * p).distance_to(m * (n * p)) < 1e-13);
        prop_assert!(((m * n) * v - m * (n * v)).length() < 1e-14);
        prop_assert!(((m * n).determinant() - m.determinant() * n.determinant()).abs() < 1e-13);
        prop_assert!((m * m.inverse().unwrap()).is_identity(1e-10));
        prop_assert_eq!((m.transform_point(p), m.transform_vector(v)), (m * p, m * v));
    }

    #[test]
    fn normals_stay_at_right_angles(m in map(), v in vector()) {
        let (along, normal) = (v.orthogonal().unwrap(), Normal3D::from(v));
        let moved = m.transform_normal(normal).unwrap();
        prop_assert!(moved.dot(m * along).abs() < 1e-11 * moved.length());
        prop_assert_eq!(m.inverse().unwrap().transform_normal_with_inverse(normal), moved);
    }

    #[test]
    fn turns_add_up(a in -360.0..360.0f64, b in -360.0..360.0f64, axis in vector(), v in vector()) {
        for turn in [rotate_x, rotate_y, rotate_z] {
            prop_assert!((turn(a) * turn(b)).is_close(&turn(a + b), 1e-14));
            prop_assert!(((turn(a) * v).length() - v.length()).abs() < 1e-15);
        }
        prop_assert!((rotate_vector(a, axis).unwrap() * rotate_vector(b, axis).unwrap())
            .is_close(&rotate_vector(a + b, axis).unwrap(), 1e-14));
        for (turn, unit) in [(rotate_x(a), Vector3D::X), (rotate_y(a), Vector3D::Y), (rotate_z(a), Vector3D::Z)] {
            prop_assert!(turn.is_close(&rotate_vector(a, unit).unwrap(), 1e-15));
        }
        prop_assert!((translate(a, b, 1.0) * translate(-a, -b, -1.0)).is_identity(1e-300));
        prop_assert!((rotate_x(a) * rotate_y(b)).similarity_scale().is_some_and(|s| (s - 1.0).abs() < 1e-14));
    }

    #[test]
    fn a_basis_looks_forward_with_up_in_its_plane(forward in vector(), up in vector()) {
        let angle = forward.angle(up).unwrap();
        prop_assume!((1.0..179.0).contains(&angle));
        let m = rotate_basis(forward, up).unwrap();
        prop_assert!((m * Vector3D::Z).angle(forward).unwrap() < 1e-13);
        prop_assert!((m * Vector3D::X).dot(up).abs() < 1e-13 && (m * Vector3D::Y).dot(up) > 0.0);
        prop_assert!((m.determinant() - 1.0).abs() < 1e-13);
    }

    #[test]
    fn angles_of_rotations_come_back_at_the_poles_too(
        yaw in -180.0..180.0f64, roll in -180.0..180.0f64, pitch in -90.0..90.0f64, pole in 0..4usize,
    ) {
        let pitch = [90.0, -90.0, pitch, pitch.signum() * (90.0 - 1e-9)][pole];
        let m = rotate(yaw, pitch, roll);
        let (y, p, r) = extract_rotation(&m);
        prop_assert!(rotate(y, p, r).is_close(&m, 1e-13));
        let m = rotate_z(-yaw) * rotate_y(-pitch) * rotate_x(roll);
        let (y, p, r) = extract_rotation_z_up(&m);
        prop_assert!((rotate_z(-y) * rotate_y(-p) * rotate_x(r)).is_close(&m, 1e-13));
        prop_assert!((-90.0..=90.0).contains(&p));
    }

    #[test]
    fn units_are_in_their_ratios(x in -1e6..1e6f64) {
        use units::*;
        let close = |a: f64, b: f64| (a - b).abs() <= 4.0 * f64::EPSILON * b.abs();
        for (ours, expected) in [
            (km(x), 1e3 * x), (cm(x), x / 100.0), (mm(x), x / 1e3), (um(x), x / 1e6), (nm(x), x / 1e9),
            (yard(x), foot(3.0 * x)), (foot(x), inch(12.0 * x)), (mil(1e3 * x), inch(x)), (mile(x), yard(1760.0 * x)),
            (inch(x), cm(2.54 * x)), (radian(x).to_radians(), x),
        ] {
            prop_assert!(close(ours, expected), "{ours} {expected}");
        }
    }
}
