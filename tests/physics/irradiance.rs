//! Configuration factors of lights as seen from the upper side of a plate at the origin: irradiance over π, for a
//! radiance of one.

use std::f64::consts::PI;

use raysect::math::{AffineMatrix3D, Point3D, Vector3D};
use raysect::primitive::Cuboid;

/// Signed factor of a polygon, by Lambert's contour formula: positive if its corners run clockwise as seen from the
/// origin (D. Baum, H. Rushmeier, J. Winget, *Improving radiosity solutions through the use of analytically
/// determined form-factors*, SIGGRAPH 1989).
fn polygon_factor(corners: &[Vector3D]) -> f64 {
    let edge = |i: usize| {
        let (a, b) = (corners[i], corners[(i + 1) % corners.len()]);
        let cross = a.cross(b);
        let angle = cross.length().atan2(a.dot(b));
        angle * cross.z / cross.length()
    };
    -(0..corners.len()).map(edge).sum::<f64>() / (2.0 * PI)
}

/// The corner of a cuboid in a space of the world: bit `i` of its number chooses the upper end of axis `i`.
fn corner(shape: &Cuboid, map: &AffineMatrix3D, number: usize) -> Vector3D {
    let pick = |axis: usize| if number >> axis & 1 == 1 { shape.upper()[axis] } else { shape.lower()[axis] };
    map.transform_point(Point3D::new(pick(0), pick(1), pick(2))).to_vector()
}

/// Factor of a cuboid under a map, all of it above the horizon: the sum over the faces that look at the origin. Of
/// the two sides of a sheet one does.
pub(crate) fn box_factor(shape: &Cuboid, map: &AffineMatrix3D) -> f64 {
    let handed = map.determinant().signum();
    let face = |axis: usize, upper: usize| {
        let (a, b) = ((axis + 1) % 3, (axis + 2) % 3);
        let turn = [0, 1 << a, 1 << a | 1 << b, 1 << b];
        let corners = turn.map(|bits| corner(shape, map, bits | upper << axis));
        let outward = (corners[1] - corners[0]).cross(corners[3] - corners[0]) * handed;
        let outward = if upper == 1 { outward } else { -outward };
        if outward.dot(corners[0]) < 0.0 { polygon_factor(&corners).abs() } else { 0.0 }
    };
    (0..3).flat_map(|axis| [face(axis, 0), face(axis, 1)]).sum()
}

/// Factor of a ball of a radius at a distance, whose centre stands at an angle to the normal [rad]: also of one that
/// is cut by the horizon (J. Howell, *A Catalog of Radiation Heat Transfer Configuration Factors*, B-38).
pub(crate) fn ball_factor(radius: f64, distance: f64, angle: f64) -> f64 {
    let h = distance / radius;
    if angle.cos() >= 1.0 / h - 1e-12 {
        return angle.cos() / (h * h);
    }
    let k = (h * h - 1.0).sqrt();
    let cosine = h * angle.cos();
    0.5 - (k / (h * angle.sin())).asin() / PI
        + (angle.cos() * (-k / angle.tan()).acos() - k * (1.0 - cosine * cosine).sqrt()) / (PI * h * h)
}

#[test]
fn a_sheet_has_the_factor_of_the_catalogue() {
    let sheet = Cuboid::new(Point3D::new(0.0, 0.0, 0.5), Point3D::new(1.0, 0.6, 0.5)).unwrap();
    let (a, b): (f64, f64) = (1.0 / 0.5, 0.6 / 0.5);
    let half = |a: f64, b: f64| a / a.hypot(1.0) * (b / a.hypot(1.0)).atan();
    let expected = (half(a, b) + half(b, a)) / (2.0 * PI);
    assert!((box_factor(&sheet, &AffineMatrix3D::IDENTITY) - expected).abs() < 1e-14);
}

#[test]
fn a_box_has_the_factor_of_its_inscribed_ball_at_most() {
    let map = raysect::math::translate(0.0, 0.0, 3.0) * raysect::math::rotate(20.0, 30.0, 40.0);
    let factor = box_factor(&Cuboid::default(), &map);
    assert!(factor > ball_factor(0.5, 3.0, 0.0) && factor < ball_factor(0.75f64.sqrt(), 3.0, 0.0));
}
