use super::*;
use crate::double_double::dd;
use crate::judges::{self, Subject, line};
use raysect_core::testing::some_motion;
use raysect_math::Vector3D;

fn subject(radius: f64, height: f64, judge: &mut dyn FnMut(&Subject)) {
    let shape = Cylinder::new(radius, height).unwrap();
    judge(&Subject {
        shape: &shape,
        radius,
        height,
        capped: true,
        form: &move |u, v| u[0] * v[0] + u[1] * v[1] - dd(radius) * dd(radius) * u[3] * v[3],
        volume: shape.volume(),
        area: shape.surface_area(),
    });
}

#[test]
fn impossible_dimensions_are_named() {
    for (radius, height) in [(0.0, 1.0), (1.0, -1.0), (f64::NAN, 1.0), (1.0, f64::INFINITY), (1e101, 1.0)] {
        let message = Cylinder::new(radius, height).unwrap_err().to_string();
        assert!(message.starts_with("cylinder: ") && message.contains(" is outside "), "{message}");
    }
    assert_eq!(Cylinder::default(), Cylinder::new(0.5, 1.0).unwrap());
}

#[test]
fn rays_along_axis_faces_and_rims_cross_once() {
    let c = Cylinder::new(1.0, 2.0).unwrap();
    let ends = [(1.0, LOWER), (3.0, UPPER)];
    for x in [0.0, 0.3, -0.0] {
        for tilt in [0.0, -0.0, 1e-310, 1e-170, -1e-20] {
            assert_eq!(line(&c, [x, 0.0, -1.0], [tilt, 0.0, 1.0]), ends, "{x} {tilt}");
        }
    }
    for tilt in [0.0, -0.0, -1e-310, -1e-170, -1e-20] {
        assert_eq!(line(&c, [1.0, 0.0, -1.0], [tilt, 0.0, 1.0]), ends, "{tilt}");
    }
    assert_eq!(line(&c, [-3.0, 0.0, 0.0], [1.0, 0.0, 0.0]), [(2.0, SIDE), (4.0, SIDE)]);
    assert_eq!(line(&c, [-3.0, 0.0, 2.0], [0.5, 0.0, -0.0]), [(4.0, SIDE), (8.0, SIDE)]);
    // In through the rim below, out through the one above.
    assert_eq!(line(&c, [-2.0, 0.0, -1.0], [1.0, 0.0, 1.0]), [(1.0, SIDE), (3.0, SIDE)]);
    // Past the rims, above and beside.
    assert_eq!(line(&c, [-3.0, 0.0, 2.5], [1.0, 0.0, 0.0]), []);
    assert_eq!(line(&c, [1.1, 0.0, -1.0], [0.0, 0.0, 1.0]), []);
    assert_eq!(line(&c, [1.1, 0.0, -1.0], [-1e-170, 0.0, 1.0]), []);
    let touch = line(&c, [1.0, -3.0, 1.0], [0.0, 1.0, 0.0]);
    assert!(touch.is_empty() || touch == [(3.0, SIDE), (3.0, SIDE)], "{touch:?}");
}

#[test]
fn slow_drift_to_the_side_is_seen() {
    let c = Cylinder::new(1.0, 1.0).unwrap();
    let found = line(&c, [0.75, 0.0, 0.0], [0.25 * 2.0, 0.0, 1.0]);
    assert_eq!(found, [(0.0, LOWER), (0.5, SIDE)]);
    let start = 1.0 - 2f64.powi(-30);
    let found = line(&c, [start, 0.0, -1.0], [2f64.powi(-31), 0.0, 0.5]);
    assert_eq!(found, [(2.0, LOWER), (2.0, SIDE)]);
}

#[test]
fn keeps_the_contract_at_every_size() {
    judges::keeps_the_contract(&subject);
}

#[test]
fn crossings_are_right_to_rounding_from_any_distance() {
    judges::distances_are_right(&subject);
}

#[test]
fn surface_points_keep_their_bound() {
    judges::points_keep_their_bound(&subject);
}

#[test]
fn mean_chord_is_four_volumes_over_surface() {
    judges::chords_agree_with_cauchy(&subject);
}

#[test]
fn rays_that_start_again_leave_where_they_must() {
    judges::restarts_are_right(&subject);
    judges::nothing_is_lost(|r, h| Cylinder::new(r, h).unwrap());
}

#[test]
fn the_ends_of_the_admitted_sizes_work() {
    judges::extremes_are_finite(&subject);
}

#[test]
fn light_sampling_draws_what_it_says() {
    judges::light_sampling_is_right(&subject);
}

#[test]
fn bounds_are_tight_around_sheared_images() {
    let sheared = AffineMatrix3D::from_axes(
        Vector3D::new(3.0, 0.4, 0.0),
        Vector3D::new(0.5, 0.2, 0.1),
        Vector3D::new(-1.0, 0.3, 2.0),
        Point3D::new(5.0, 6.0, 7.0),
    );
    for m in [sheared, some_motion()] {
        for (radius, height) in [(0.7, 1.3), (1.3, 0.7)] {
            judges::check_bounds(&Cylinder::new(radius, height).unwrap(), &m, |t, phi| {
                [0.0, 1.0].map(|z| Point3D::new(radius * phi.cos() * t, radius * phi.sin() * t, height * z))
            });
        }
    }
}
