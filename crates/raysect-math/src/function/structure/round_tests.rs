use super::super::{
    Extrapolation1D, Function, Interpolation1D, Interpolator1DArray, Shells, coaxial, spherical,
};
use super::tests::{Secret, assert_smooth_between_breaks};
use super::*;
use crate::Rng;

const CENTRE: Point3D = Point3D::new(0.2, -0.3, 0.1);
const AXIS: Vector3D = Vector3D::new(1.0, -2.0, 3.0);

/// Layers about the origin, a gap and a hole among them.
fn layers() -> Shells {
    Shells::new(&[0.2, 0.5, 0.7, 0.8, 1.3], &[1.0, 0.0, 3.0, 2.0]).unwrap()
}

#[test]
fn layers_are_constant_between_their_breaks() {
    assert!(assert_smooth_between_breaks(&spherical(layers(), CENTRE), 1) > 1000);
    assert!(assert_smooth_between_breaks(&coaxial(layers(), CENTRE, AXIS).unwrap(), 2) > 1000);
}

#[test]
#[should_panic(expected = "Point3D")]
fn spheres_that_are_kept_secret_are_missed() {
    assert_smooth_between_breaks(&Secret(spherical(layers(), CENTRE)), 1);
}

#[test]
#[should_panic(expected = "Point3D")]
fn cylinders_that_are_kept_secret_are_missed() {
    assert_smooth_between_breaks(&Secret(coaxial(layers(), CENTRE, AXIS).unwrap()), 2);
}

/// The integral over a line of a function that is constant between its breaks, and 0 before and after them.
fn integral(function: &dyn Structured3D, origin: Point3D, direction: Vector3D) -> f64 {
    let mut breaks = Vec::new();
    function.add_breaks(origin, direction, &mut breaks);
    breaks.sort_by(f64::total_cmp);
    let middle = |w: &[f64]| {
        let p = origin + direction * (0.5 * (w[0] + w[1]));
        (w[1] - w[0]) * function.evaluate((p.x, p.y, p.z))
    };
    direction.length() * breaks.windows(2).map(middle).sum::<f64>()
}

#[test]
fn the_line_integral_through_a_shell_is_its_chord() {
    let mut rng = Rng::new(3);
    for size in [1e-6, 1.0, 1e6] {
        let (inner, outer) = (0.4 * size, 0.9 * size);
        let shell = Shells::new(&[inner, outer], &[2.5]).unwrap();
        let centre = Point3D::new(0.2 * size, -0.3 * size, 0.1 * size);
        let (ball, tube) = (spherical(shell.clone(), centre), coaxial(shell, centre, AXIS).unwrap());
        let mut met = 0;
        for _ in 0..1000 {
            let mut vector =
                || Vector3D::new(rng.range(-1.0, 1.0), rng.range(-1.0, 1.0), rng.range(-1.0, 1.0));
            let (away, direction) = (vector() * (50.0 * size), vector().normalise().unwrap());
            let at = centre + vector() * size;
            // The place of nearest approach of the line through a place by the centre, and the way through a ball there.
            let chord = |radius: f64, least: f64, sine: f64| {
                2.0 * (radius * radius - least * least).max(0.0).sqrt() / sine
            };
            let along = |least: f64, sine: f64| 2.5 * (chord(outer, least, sine) - chord(inner, least, sine));
            let from = centre.vector_to(at);
            let origin = at - direction * away.length();
            let found = integral(&ball, origin, direction * (3.0 * size));
            let expected = along(from.cross(direction).length(), 1.0);
            assert!((found - expected).abs() < 1e-9 * size, "{size}: {found} {expected}");
            let (axis, sine) =
                (AXIS.normalise().unwrap(), AXIS.normalise().unwrap().cross(direction).length());
            if sine < 0.2 {
                continue;
            }
            let found = integral(&tube, origin, direction * (3.0 * size));
            let least = from.dot(axis.cross(direction)).abs() / sine;
            let expected = along(least, sine);
            assert!((found - expected).abs() < 1e-9 * size, "{size}: {found} {expected}");
            met += u32::from(expected > 0.0);
        }
        assert!(met > 300, "{met}");
    }
}

#[test]
fn lines_that_go_nowhere_or_along_the_axis_have_no_breaks() {
    let mut breaks = Vec::new();
    spherical(layers(), CENTRE).add_breaks(Point3D::ORIGIN, Vector3D::new(0.0, 0.0, 0.0), &mut breaks);
    let tube = coaxial(layers(), CENTRE, Vector3D::Z).unwrap();
    tube.add_breaks(Point3D::ORIGIN, Vector3D::Z, &mut breaks);
    assert!(breaks.is_empty(), "{breaks:?}");
    assert!(coaxial(layers(), CENTRE, Vector3D::new(0.0, 0.0, 0.0)).is_err());
}

#[test]
fn lines_through_the_centre_and_tangents_are_told() {
    let ball = spherical(Shells::new(&[0.0, 1.0, 2.0], &[1.0, 2.0]).unwrap(), Point3D::ORIGIN);
    let found = |height: f64| {
        let mut breaks = Vec::new();
        ball.add_breaks(Point3D::new(-4.0, height, 0.0), Vector3D::X * 2.0, &mut breaks);
        breaks.sort_by(f64::total_cmp);
        breaks
    };
    assert_eq!(found(0.0), [1.0, 1.5, 2.0, 2.0, 2.5, 3.0]);
    assert_eq!(found(2.0), [2.0, 2.0]);
    assert!(found(2.0f64.next_up()).is_empty());
}

#[test]
fn tables_have_corners_at_their_knots_and_bend_where_they_are_nearest() {
    let table =
        Interpolator1DArray::new(&[0.5, 1.0, 1.5], &[3.0, 1.0, 2.0], Interpolation1D::Linear).unwrap();
    assert_eq!((table.length_scale(), table.is_stepped()), (0.5, false));
    let edges = |table: &Interpolator1DArray| {
        let mut all = Vec::new();
        table.each_edge(&mut |edge| all.push(edge));
        all
    };
    assert_eq!(edges(&table), [0.5, 1.0, 1.5]);
    let mut breaks = Vec::new();
    spherical(table.clone(), Point3D::ORIGIN).add_breaks(
        Point3D::new(-2.0, 0.0, 0.0),
        Vector3D::X,
        &mut breaks,
    );
    breaks.sort_by(f64::total_cmp);
    assert_eq!(
        (breaks[..3].to_vec(), breaks[breaks.len() - 3..].to_vec()),
        (vec![0.5, 1.0, 1.5], vec![2.5, 3.0, 3.5])
    );
    assert!(breaks.contains(&2.0) && breaks.len() > 20, "{breaks:?}");
    let far = table.extrapolate(Extrapolation1D::Nearest, 0.25).unwrap();
    assert_eq!(edges(&far), [0.5, 1.0, 1.5, 0.25, 1.75]);
    let of = std::sync::Arc::new(super::super::function(far.clone()));
    assert_eq!((of.length_scale(), of.is_stepped()), (0.5, false));
    assert_eq!(spherical(of, CENTRE).evaluate((0.2, 0.7, 0.1)), far.evaluate(1.0));
}
