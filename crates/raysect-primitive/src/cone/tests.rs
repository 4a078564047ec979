use super::*;
use crate::double_double::dd;
use crate::judges::{self, Subject, line};
use raysect_core::testing::some_motion;
use raysect_math::Vector3D;

fn subject(radius: f64, height: f64, judge: &mut dyn FnMut(&Subject)) {
    let shape = Cone::new(radius, height).unwrap();
    judge(&Subject {
        shape: &shape,
        radius,
        height,
        capped: false,
        form: &move |u, v| {
            let k = dd(radius) / dd(height);
            u[0] * v[0] + u[1] * v[1] - k * k * u[2] * v[2]
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
        let message = Cone::new(radius, height).unwrap_err().to_string();
        assert!(message.starts_with("cone: ") && message.contains(" is outside "), "{message}");
    }
    assert_eq!(Cone::default(), Cone::new(0.5, 1.0).unwrap());
}

#[test]
fn rays_along_axis_base_generators_and_rim_cross_once() {
    let c = Cone::new(1.0, 1.0).unwrap();
    for tilt in [0.0, -0.0, 1e-310, -1e-170] {
        assert_eq!(line(&c, [0.0, -0.0, -1.0], [tilt, 0.0, 1.0]), [(1.0, LOWER), (2.0, SIDE)]);
        assert_eq!(line(&c, [0.25, 0.0, -1.0], [tilt, 0.0, 0.5]), [(2.0, LOWER), (3.5, SIDE)]);
        assert_eq!(line(&c, [0.0, tilt, 4.0], [0.0, 0.0, -1.0]), [(3.0, SIDE), (4.0, LOWER)]);
        assert_eq!(line(&c, [-2.0, 0.0, 0.25], [1.0, 0.0, tilt]), [(1.25, SIDE), (2.75, SIDE)]);
    }
    assert_eq!(line(&c, [-2.0, 0.0, 0.0], [1.0, 0.0, 0.0]), [(1.0, SIDE), (3.0, SIDE)]);
    // Parallel to a generator: in by the opposite side and out by the base, or the other way round.
    assert_eq!(line(&c, [-1.0, 0.0, 1.5], [1.0, 0.0, -1.0]), [(0.75, SIDE), (1.5, LOWER)]);
    assert_eq!(line(&c, [0.5, 0.0, 0.0], [-1.0, 0.0, 1.0]), [(0.0, LOWER), (0.75, SIDE)]);
    // In by the rim, and out by it.
    let found = line(&c, [-2.0, 0.0, -0.5], [1.0, 0.0, 0.5]);
    assert!(
        found.len() == 2 && found[0] == (1.0, SIDE) && (found[1].0 - 7.0 / 3.0).abs() < 1e-15,
        "{found:?}"
    );
    let found = line(&c, [2.0, 0.0, -0.5], [1.0, 0.0, -0.5]);
    assert!(found.len() == 2 && found[1].0 == -1.0 && (found[0].0 + 7.0 / 3.0).abs() < 1e-15, "{found:?}");
    // Above the apex there is nothing: the other half of the double cone is no part of the shape.
    for z in [1.5, 1.0 + 1e-9] {
        for dz in [0.0, 1e-3, 0.1] {
            assert_eq!(line(&c, [-2.0, 0.0, z], [1.0, 0.0, dz]), [], "{z} {dz}");
            assert_eq!(line(&c, [0.0, 0.0, z], [1.0, 0.3, dz]), [], "{z} {dz}");
        }
    }
}

#[test]
fn rays_through_the_apex_have_normals() {
    let c = Cone::new(0.5, 1.0).unwrap();
    let mut rng = raysect_math::Rng::new(5);
    for _ in 0..20_000 {
        let d = raysect_math::SphereSampler.sample(&mut rng);
        let from = Point3D::new(0.0, 0.0, 1.0) - d * rng.range(0.0, 10.0);
        let ray = Ray::new(from, d);
        let mut all = Vec::new();
        c.crossings(&ray, &mut Scratch::default(), &mut all);
        let inside = d.z.abs() > c.cosine * (1.0 + 1e-9);
        assert!(all.len() == 2 || (all.is_empty() && !inside), "{ray:?} {all:?}");
        for crossing in &all {
            let normal = c.surface(&ray, crossing).normal;
            assert!((normal.length() - 1.0).abs() < 1e-15);
            assert!(
                normal.dot(d) * if crossing.exiting { 1.0 } else { -1.0 } > -1e-7,
                "{ray:?} {crossing:?}"
            );
        }
    }
    let down = Ray::new(Point3D::new(0.0, 0.0, 2.0), -Vector3D::Z);
    let hit = c.hit(&down, Interval::AHEAD, &mut Scratch::default()).unwrap();
    assert_eq!(c.surface(&down, &hit).normal, Normal3D::new(0.0, 0.0, 1.0));
    assert_eq!(c.surface(&down, &hit).point, Point3D::new(0.0, 0.0, 1.0));
}

#[test]
fn rays_in_the_plane_of_the_axis_have_normals() {
    let c = Cone::default();
    let mut rng = raysect_math::Rng::new(6);
    for _ in 0..100_000 {
        let from = [0.0, rng.range(-2.0, 2.0), rng.range(-2.0, 2.0)];
        line(&c, from, [0.0, rng.range(-1.0, 1.0), rng.range(-1.0, 1.0)]);
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
    judges::nothing_is_lost(|r, h| Cone::new(r, h).unwrap());
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
            judges::check_bounds(&Cone::new(radius, height).unwrap(), &m, |t, phi| {
                [0.0, 1.0 - t]
                    .map(|f| Point3D::new(radius * phi.cos() * t, radius * phi.sin() * t, height * f))
            });
        }
    }
}
