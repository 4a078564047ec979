use super::*;
use crate::double_double::dd;
use crate::judges::{self, Subject, line};
use raysect_core::testing::some_motion;
use raysect_math::Vector3D;

fn subject(radius: f64, height: f64, judge: &mut dyn FnMut(&Subject)) {
    let shape = Parabola::new(radius, height).unwrap();
    judge(&Subject {
        shape: &shape,
        radius,
        height,
        capped: false,
        form: &move |u, v| {
            let p = dd(radius) * dd(radius) / dd(height);
            u[0] * v[0] + u[1] * v[1] - p * dd(0.5) * (u[2] * v[3] + u[3] * v[2])
        },
        volume: shape.volume(),
        area: shape.surface_area(),
    });
}

#[test]
fn impossible_dimensions_are_named() {
    for (radius, height) in
        [(0.0, 1.0), (1.0, -1.0), (f64::NAN, 1.0), (1.0, f64::INFINITY), (1e101, 1.0), (1e-60, 1.0)]
    {
        let message = Parabola::new(radius, height).unwrap_err().to_string();
        assert!(message.starts_with("parabola: ") && message.contains(" is outside "), "{message}");
    }
    assert_eq!(Parabola::default(), Parabola::new(0.5, 1.0).unwrap());
}

#[test]
fn rays_along_axis_base_and_rim_cross_once() {
    let c = Parabola::new(1.0, 1.0).unwrap();
    for tilt in [0.0, -0.0, 1e-310, -1e-170] {
        assert_eq!(line(&c, [0.0, -0.0, -1.0], [tilt, 0.0, 1.0]), [(1.0, LOWER), (2.0, SIDE)]);
        assert_eq!(line(&c, [0.5, 0.0, -1.0], [tilt, 0.0, 0.5]), [(2.0, LOWER), (3.5, SIDE)]);
        assert_eq!(line(&c, [0.0, tilt, 4.0], [0.0, 0.0, -1.0]), [(3.0, SIDE), (4.0, LOWER)]);
        assert_eq!(line(&c, [-2.0, 0.0, 0.75], [1.0, 0.0, tilt]), [(1.5, SIDE), (2.5, SIDE)]);
    }
    assert_eq!(line(&c, [-2.0, 0.0, 0.0], [1.0, 0.0, 0.0]), [(1.0, SIDE), (3.0, SIDE)]);
    assert_eq!(line(&c, [-2.0, 0.0, 1.5], [1.0, 0.0, 0.0]), []);
    assert_eq!(line(&c, [1.5, 0.0, -1.0], [0.0, 0.0, 1.0]), []);
    // In by the rim, out by the vertex; and back.
    assert_eq!(line(&c, [-2.0, 0.0, -1.0], [1.0, 0.0, 1.0]), [(1.0, SIDE), (2.0, SIDE)]);
    assert_eq!(line(&c, [1.0, 0.0, 2.0], [-0.5, 0.0, -0.5]), [(2.0, SIDE), (4.0, SIDE)]);
    let touch = line(&c, [-3.0, 0.0, 1.0], [1.0, 0.0, 0.0]);
    assert!(touch.is_empty() || touch == [(3.0, SIDE), (3.0, SIDE)], "{touch:?}");
}

#[test]
fn nearly_parallel_rays_are_as_right_as_parallel_ones() {
    // The second root of the paraboloid lies 1e9 and more below the base and must not spoil the first.
    let c = Parabola::new(1.0, 1.0).unwrap();
    for tilt in [1e-3, 1e-6, 1e-9, 1e-12, 1e-15] {
        let ray = Ray::new(Point3D::new(0.5, 0.0, 3.0), Vector3D::new(tilt, 0.0, -1.0));
        subject(1.0, 1.0, &mut |s| {
            let exact = s.exact(&ray).unwrap().0;
            let hit = c.hit(&ray, Interval::AHEAD, &mut Scratch::default()).unwrap();
            assert!((dd(hit.distance) - exact).value().abs() <= 4.0 * f64::EPSILON, "{tilt}");
        });
    }
}

#[test]
fn rays_along_the_axis_are_reflected_to_the_focus() {
    let c = Parabola::new(1.0, 0.5).unwrap();
    let focus = Point3D::new(0.0, 0.0, 0.5 - 1.0 / (4.0 * 0.5));
    for x in [1e-6, 0.1, 0.5, 0.9] {
        let ray = Ray::new(Point3D::new(x, 0.0, -3.0), Vector3D::Z);
        let hit = c.hit(&ray, Interval::new(3.0 + 1e-9, 9.0), &mut Scratch::default()).unwrap();
        let Surface { point, normal, .. } = c.surface(&ray, &hit);
        let mirrored = Vector3D::Z - normal.as_vector() * (2.0 * normal.z);
        let t = point.vector_to(focus).dot(mirrored);
        assert!((point + mirrored * t).distance_to(focus) < 1e-15, "{x}");
    }
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
    judges::nothing_is_lost(|r, h| Parabola::new(r, h).unwrap());
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
            judges::check_bounds(&Parabola::new(radius, height).unwrap(), &m, |t, phi| {
                [0.0, 1.0 - t * t]
                    .map(|f| Point3D::new(radius * phi.cos() * t, radius * phi.sin() * t, height * f))
            });
        }
    }
}
