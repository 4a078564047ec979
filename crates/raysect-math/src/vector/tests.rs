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

    #[test]
    fn products_follow_their_identities(
        a in prop::array::uniform3(-1.0..1.0f64), b in prop::array::uniform3(-1.0..1.0f64), k in -2.0..2.0f64,
    ) {
        let (v, w, n) = (Vector3D::from(a), Vector3D::from(b), Normal3D::from(b));
        let across = v.cross(w);
        prop_assert!(across.dot(v).abs() < 1e-15 && across.dot(w).abs() < 1e-15);
        // Lagrange: |v × w|² + (v · w)² = |v|² |w|².
        let squares = v.length_squared() * w.length_squared();
        prop_assert!((across.length_squared() + v.dot(w).powi(2) - squares).abs() < 1e-14);
        prop_assert_eq!((v.cross(n), v.dot(n), v + n, v - n), (across, v.dot(w), v + w, v - w));
        prop_assert_eq!((w.cross(v), n.cross(v), n.as_vector()), (-across, -across, w));
        prop_assert_eq!((v * k, k * v, -n), (v * k, v * k, Normal3D::from(-w)));
        prop_assert!(((v + w) / 2.0 * 2.0 - v - w).length() < 1e-15);
        let (mut sum, mut one) = (v, w);
        sum += w;
        sum -= v;
        prop_assert!((sum - w).length() < 1e-15);
        one[1] = k;
        prop_assert_eq!((one.x, one.y, one.z), (w.x, k, w.z));
        let glam = glam::DVec3::from(v);
        prop_assert_eq!((Vector3D::from(glam), Normal3D::from(glam).to_array(), v.to_array()), (v, a, a));
    }

    #[test]
    fn lengths_and_angles_are_those_of_the_plane(
        length in 1e-3..1e3f64, turn in 0.0..180.0f64, a in prop::array::uniform3(-1.0..1.0f64),
    ) {
        let v = Vector3D::from(a);
        prop_assume!(v.length() > 1e-3);
        prop_assert!((v.with_length(length).unwrap().length() / length - 1.0).abs() < 8.0 * f64::EPSILON);
        let axis = v.orthogonal().unwrap();
        let turned = crate::rotate_vector(turn, axis).unwrap() * v;
        prop_assert!((v.angle(turned).unwrap() - turn).abs() < 1e-12);
        prop_assert!((Normal3D::from(v).angle(turned).unwrap() - turn).abs() < 1e-12);
    }

    #[test]
    fn vectors_of_the_plane_are_those_of_space_with_z_zero(
        a in prop::array::uniform2(component()), b in prop::array::uniform2(-1.0..1.0f64), k in -2.0..2.0f64,
    ) {
        let (v, w) = (Vector2D::from(a), Vector2D::from(b));
        let space = |v: Vector2D| Vector3D::new(v.x, v.y, 0.0);
        prop_assume!(space(v).max_abs() > 1e-305 && w.length() > 1e-3);
        prop_assert!((v.length() / space(v).length() - 1.0).abs() < 8.0 * f64::EPSILON);
        prop_assert!((space(v.normalise().unwrap()) - space(v).normalise().unwrap()).length() < 8.0 * f64::EPSILON);
        prop_assert_eq!((w.dot(w), w.cross(-w), w.to_array()), (space(w).length_squared(), 0.0, b));
        prop_assert_eq!(space(w * k + w / 2.0 - k * w), space(w) * k + space(w) / 2.0 - k * space(w));
        let side = w.orthogonal().unwrap();
        prop_assert!(side.dot(w).abs() < 8.0 * f64::EPSILON);
        prop_assert!((w.cross(side) / w.length() - 1.0).abs() < 8.0 * f64::EPSILON);
        prop_assert!((w.with_length(3.0).unwrap().length() - 3.0).abs() < 2e-15);
        let mut other = w;
        other[0] = k;
        prop_assert_eq!((other[0], other[1]), (k, w.y));
    }
}
