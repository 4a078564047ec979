use super::*;
use crate::{rotate_vector, rotate_x, translate};
use proptest::prelude::*;

const I: Quaternion = Quaternion::new(1.0, 0.0, 0.0, 0.0);
const J: Quaternion = Quaternion::new(0.0, 1.0, 0.0, 0.0);
const K: Quaternion = Quaternion::new(0.0, 0.0, 1.0, 0.0);

fn axes() -> Vec<Vector3D> {
    let numbers = [-1.0, -0.3, 0.0, 0.7, 1.0];
    let all = numbers.into_iter().flat_map(|x| {
        numbers.into_iter().flat_map(move |y| numbers.into_iter().map(move |z| Vector3D::new(x, y, z)))
    });
    all.filter(|v| v.length() > 0.0).collect()
}

/// 1e-8 … 180°, in equal ratios.
fn angles() -> impl Iterator<Item = f64> {
    (0..=200).map(|i| 1e-8 * 1.8e10f64.powf(f64::from(i) / 200.0)).map(|a| a.min(180.0))
}

#[test]
fn hamiltons_rules_hold() {
    assert_eq!((I * J, J * K, K * I), (K, I, J));
    assert_eq!((J * I, I * I), (-K, -Quaternion::IDENTITY));
    let (a, b) = (Quaternion::new(1.0, 2.0, 3.0, 4.0), Quaternion::new(-2.0, 0.5, 1.0, 3.0));
    assert_eq!(a + b, Quaternion::new(-1.0, 2.5, 4.0, 7.0));
    assert_eq!(a - b, Quaternion::new(3.0, 1.5, 2.0, 1.0));
    assert_eq!((2.0 * a, a / 2.0), (a * 2.0, Quaternion::new(0.5, 1.0, 1.5, 2.0)));
    // By hand: s = 12 − (−2 + 1 + 3), v = 4 b + 3 a + a × b with a × b = (0.5, −7, 4.5).
    assert_eq!(a * b, Quaternion::new(-4.5, 1.0, 17.5, 10.0));
    assert_eq!([a[0], a[1], a[2], a[3]], <[f64; 4]>::from(a));
    assert_eq!(Quaternion::default(), Quaternion::from([0.0, 0.0, 0.0, 1.0]));
}

/// The largest relative error of the angle over all axes and angles, in ε.
fn angle_error(angle_of: impl Fn(Quaternion) -> f64) -> f64 {
    let mut worst: f64 = 0.0;
    for axis in axes() {
        for angle in angles() {
            let q = Quaternion::from_axis_angle(axis, angle).unwrap();
            worst = worst.max((angle_of(q) / angle - 1.0).abs() / f64::EPSILON);
        }
    }
    worst
}

#[test]
fn angles_come_back_to_rounding_down_to_the_smallest() {
    let worst = angle_error(|q| q.angle().unwrap());
    assert!(worst <= 4.0, "{worst} ε");
    // Negative control: the arc cosine loses small angles altogether.
    assert!(angle_error(|q| 2.0 * q.s.acos().to_degrees()) > 0.9 / f64::EPSILON);
}

#[test]
fn axes_come_back_with_their_sign() {
    for axis in axes() {
        for angle in angles() {
            let q = Quaternion::from_axis_angle(axis, angle).unwrap();
            assert!((q.axis() - axis.normalise().unwrap()).length() <= 4.0 * f64::EPSILON);
            let back = Quaternion::from_axis_angle(axis, -angle).unwrap();
            assert!((back.axis() + axis.normalise().unwrap()).length() <= 4.0 * f64::EPSILON);
            assert!(q.is_unit(4.0 * f64::EPSILON) && q.s >= 0.0);
        }
    }
    assert_eq!(Quaternion::IDENTITY.axis(), Vector3D::ZERO);
    assert_eq!(Quaternion::from_axis_angle(Vector3D::Z, 180.0).unwrap(), K);
    assert_eq!(Quaternion::from_axis_angle(Vector3D::X, 720.0).unwrap(), Quaternion::IDENTITY);
    let beyond = Quaternion::from_axis_angle(Vector3D::X, 350.0).unwrap();
    assert!((beyond.angle().unwrap() - 10.0).abs() < 1e-13 && beyond.x < 0.0);
}

/// The largest component of q − p or q + p, whichever is smaller, in ε.
fn distance(q: Quaternion, p: Quaternion) -> f64 {
    let largest = |d: Quaternion| (0..4).map(|i| d[i].abs()).fold(0.0, f64::max);
    largest(q - p).min(largest(q + p)) / f64::EPSILON
}

#[test]
fn matrices_come_back_to_rounding_up_to_half_a_turn() {
    /// By the trace alone, as where the scalar part is large.
    fn by_trace(m: &AffineMatrix3D) -> Quaternion {
        let s = 0.5 * (1.0 + m.get(0, 0) + m.get(1, 1) + m.get(2, 2)).max(0.0).sqrt();
        let across = |i, j| (m.get(i, j) - m.get(j, i)) / (4.0 * s);
        Quaternion::new(across(2, 1), across(0, 2), across(1, 0), s)
    }
    let (mut worst, mut worst_by_trace): (f64, f64) = (0.0, 0.0);
    for axis in axes() {
        for angle in angles().chain([90.0, 120.0, 179.0, 179.999_999, 180.0]) {
            let q = Quaternion::from_axis_angle(axis, angle).unwrap();
            let m = q.to_matrix().unwrap();
            assert!(m.is_close(&rotate_vector(angle, axis).unwrap(), 8.0 * f64::EPSILON), "{axis:?} {angle}");
            worst = worst.max(distance(Quaternion::from_matrix(&m).unwrap(), q));
            let control = distance(by_trace(&m), q);
            worst_by_trace = worst_by_trace.max(if control.is_nan() { f64::INFINITY } else { control });
        }
    }
    assert!(worst <= 4.0, "{worst} ε");
    assert!(worst_by_trace > 1e6, "{worst_by_trace} ε");
}

#[test]
fn translation_does_not_count_and_other_maps_are_refused() {
    let m = translate(1.0, 2.0, 3.0) * rotate_x(30.0);
    let q = Quaternion::from_matrix(&m).unwrap();
    assert!(distance(q, Quaternion::from_axis_angle(Vector3D::X, 30.0).unwrap()) <= 2.0);
    let axes = |x, y, z| AffineMatrix3D::from_axes(x, y, z, crate::Point3D::ORIGIN);
    let mirror = axes(-Vector3D::X, Vector3D::Y, Vector3D::Z);
    let sheared = axes(Vector3D::X, Vector3D::new(1e-6, 1.0, 0.0), Vector3D::Z);
    let broken = axes(Vector3D::X, Vector3D::new(f64::NAN, 1.0, 0.0), Vector3D::Z);
    for m in [mirror, sheared, broken, axes(Vector3D::X * 2.0, Vector3D::Y, Vector3D::Z)] {
        assert!(matches!(Quaternion::from_matrix(&m), Err(MathError::NotRotation { .. })), "{m:?}");
    }
}

#[test]
fn null_and_infinite_quaternions_are_refused() {
    for q in [
        Quaternion::new(0.0, 0.0, 0.0, 0.0),
        Quaternion::new(0.0, f64::NAN, 0.0, 1.0),
        Quaternion::new(0.0, 0.0, f64::INFINITY, 1.0),
        Quaternion::new(0.0, 0.0, 0.0, f64::NAN),
    ] {
        assert!(
            q.normalise().is_err() && q.inverse().is_err() && q.angle().is_err() && q.to_matrix().is_err()
        );
        assert!(q.quaternion_to(I).is_err() && I.quaternion_to(q).is_err() && q.with_length(2.0).is_err());
        assert!(!q.is_unit(1e-10));
    }
    assert!(Quaternion::new(0.0, 0.0, 0.0, 1e-310).inverse().is_err());
    assert!(Quaternion::from_axis_angle(Vector3D::ZERO, 1.0).is_err());
    assert!(Quaternion::from_axis_angle(Vector3D::X, f64::NAN).is_err());
    assert!(
        I.transform(&AffineMatrix3D::from_axes(
            Vector3D::ZERO,
            Vector3D::Y,
            Vector3D::Z,
            crate::Point3D::ORIGIN
        ))
        .is_err()
    );
    let message = Quaternion::new(0.0, 0.0, 0.0, 0.0).normalise().unwrap_err().to_string();
    assert_eq!(message, "the quaternion (0, 0, 0, 0) is no rotation: its length must be positive and finite");
}

#[test]
fn a_transformed_rotation_turns_about_the_transformed_axis() {
    let q = Quaternion::from_axis_angle(Vector3D::Z, 50.0).unwrap() * 3.0;
    let turned = q.transform(&rotate_x(90.0)).unwrap();
    assert_eq!(turned.axis(), Vector3D::new(0.0, -1.0, 0.0));
    assert!((turned.angle().unwrap() - 50.0).abs() < 1e-13 && (turned.length() - 3.0).abs() < 1e-14);
    assert_eq!(Quaternion::IDENTITY.transform(&rotate_x(90.0)), Ok(Quaternion::IDENTITY));
}

#[test]
fn ten_thousand_products_stay_a_rotation() {
    let (axis, angle) = (Vector3D::new(0.3, -0.5, 0.8), 0.1234);
    let (q, m) = (Quaternion::from_axis_angle(axis, angle).unwrap(), rotate_vector(angle, axis).unwrap());
    let (mut product, mut matrix) = (Quaternion::IDENTITY, AffineMatrix3D::IDENTITY);
    for _ in 0..10_000 {
        (product, matrix) = (q * product, m * matrix);
    }
    let exact = rotate_vector(angle * 1e4, axis).unwrap();
    assert!(matrix.is_close(&exact, 1e-12) && product.to_matrix().unwrap().is_close(&exact, 1e-12));
    assert!(Quaternion::from_matrix(&matrix).unwrap().is_unit(1e-15));
    // Negative control: an angle 1e-15 off in each of them would be seen.
    assert!(!matrix.is_close(&rotate_vector(angle * 1e4 * (1.0 + 1e-12), axis).unwrap(), 1e-12));
}

#[test]
fn slerp_is_finite_for_equal_opposite_tiny_and_huge_quaternions() {
    let turns = [0.0, 1e-300, 1e-12, 1e-7, 1.0, 90.0, 179.999_999_9, 180.0, 270.0, 359.999_999_999];
    for turn in turns {
        let b = Quaternion::from_axis_angle(Vector3D::new(1.0, -2.0, 0.5), turn).unwrap();
        for other in [b, -b, b * 1e-300, b * 1e300] {
            for t in [0.0, 1e-9, 0.5, 1.0] {
                let q = Quaternion::IDENTITY.slerp(other, t).unwrap();
                assert!(q.is_unit(4.0 * f64::EPSILON), "{turn} {t}: {q:?}");
                let shorter = turn.min(360.0 - turn);
                let angle = q.angle().unwrap();
                assert!((angle.min(360.0 - angle) - t * shorter).abs() < 1e-12, "{turn} {t}: {angle}");
            }
        }
    }
    for t in [-0.1, 1.1, f64::NAN] {
        assert!(I.slerp(J, t).is_err());
    }
    assert!(I.slerp(Quaternion::new(0.0, 0.0, 0.0, 0.0), 0.5).is_err());
}

proptest! {
    #[test]
    fn slerp_turns_evenly_about_one_axis(
        a in prop::array::uniform4(-1.0..1.0f64), b in prop::array::uniform4(-1.0..1.0f64), t in 0.0..=1.0f64,
    ) {
        let (a, b) = (Quaternion::from(a), Quaternion::from(b));
        prop_assume!(a.length() > 1e-3 && b.length() > 1e-3);
        let shorter = |q: Quaternion| q.angle().map(|angle| angle.min(360.0 - angle)).unwrap();
        let (way, part) = (a.quaternion_to(b).unwrap(), a.quaternion_to(a.slerp(b, t).unwrap()).unwrap());
        prop_assert!((shorter(part) - t * shorter(way)).abs() < 1e-12);
        prop_assert!((shorter(way) - shorter(b.quaternion_to(a).unwrap())).abs() < 1e-12);
        // Back to front it is the same rotation.
        prop_assert!(distance(a.slerp(b, t).unwrap(), b.slerp(a, 1.0 - t).unwrap()) < 40.0);
        prop_assume!(t > 0.01 && shorter(way) > 1.0);
        prop_assert!(part.axis().cross(way.axis()).length() < 1e-10);
    }

    #[test]
    fn parts_lengths_and_sums(a in prop::array::uniform4(-1.0..1.0f64), length in 1e-3..1e3f64, i in 0..4usize) {
        let q = Quaternion::from(a);
        prop_assume!(q.length() > 1e-3);
        prop_assert!((q.with_length(length).unwrap().length() / length - 1.0).abs() < 1e-15);
        prop_assert_eq!((q.conjugate() + q) / 2.0, Quaternion::new(0.0, 0.0, 0.0, q.s));
        prop_assert!((q.dot(q) - (q * q.conjugate()).s).abs() < 1e-15);
        prop_assert_eq!(-q + q * 2.0 - 1.0 * q, Quaternion::new(0.0, 0.0, 0.0, 0.0));
        let mut other = q;
        other[i] = length;
        let expected = |k: usize| if k == i { length } else { q[k] };
        prop_assert!((0..4).all(|k| other[k] == expected(k)));
    }

    #[test]
    fn an_inverse_and_a_way_back(
        a in prop::array::uniform4(-1.0..1.0f64), b in prop::array::uniform4(-1.0..1.0f64), e in -140..140i32,
    ) {
        let (a, b) = (Quaternion::from(a), Quaternion::from(b));
        prop_assume!(a.length() > 1e-3 && b.length() > 1e-3);
        let scaled = a * 10f64.powi(e);
        prop_assert!((scaled.length() / a.length() / 10f64.powi(e) - 1.0).abs() < 1e-14);
        prop_assert!(distance(scaled * scaled.inverse().unwrap(), Quaternion::IDENTITY) < 10.0);
        let way = a.quaternion_to(b).unwrap();
        prop_assert!(distance(way * a.normalise().unwrap(), b.normalise().unwrap()) < 10.0);
    }

    #[test]
    fn products_apply_the_right_factor_first(
        a in prop::array::uniform4(-1.0..1.0f64), b in prop::array::uniform4(-1.0..1.0f64),
    ) {
        let (a, b) = (Quaternion::from(a), Quaternion::from(b));
        prop_assume!(a.length() > 1e-3 && b.length() > 1e-3);
        let product = (a * b).to_matrix().unwrap();
        prop_assert!(product.is_close(&(a.to_matrix().unwrap() * b.to_matrix().unwrap()), 1e-14));
        prop_assume!(!product.is_identity(1e-3));
        let other = b.to_matrix().unwrap() * a.to_matrix().unwrap();
        prop_assert!(!product.is_close(&other, 1e-14) || a.axis().cross(b.axis()).length() < 1e-9);
    }
}
