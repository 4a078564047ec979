use super::super::check::{Chart, assert_unit, extremes};
use super::*;
use crate::{Rng, integrate};
use std::f64::consts::{PI, TAU};

/// A rectangle in the plane z = 1 with the given lower corner and widths, turned and moved with its observer.
fn rectangle(low: [f64; 2], size: [f64; 2]) -> (SphericalRectangleSampler, Chart<Vector3D>) {
    let frame = Frame::from_z(Vector3D::new(0.36, -0.48, 0.8));
    let observer = Point3D::new(1.0, -2.0, 0.5);
    let corner = observer + frame.to_world(Vector3D::new(low[0], low[1], 1.0));
    let edges = [frame.x * size[0], frame.y * size[1]];
    let sampler = SphericalRectangleSampler::new(observer, corner, edges).unwrap();
    let chart = Chart {
        low,
        high: [low[0] + size[0], low[1] + size[1]],
        bins: [10, 10],
        place: Box::new(move |[x, y]| frame.to_world(Vector3D::new(x, y, 1.0)).normalise().unwrap()),
        coordinates: Box::new(move |v| {
            let v = frame.to_local(v);
            [v.x / v.z, v.y / v.z]
        }),
        jacobian: Box::new(|[x, y]| (1.0 + x * x + y * y).powf(-1.5)),
    };
    (sampler, chart)
}

/// Around the foot of the observer, beside it, far to the side, a long strip.
const SHAPES: [([f64; 2], [f64; 2]); 5] = [
    ([-0.5, -0.7], [1.0, 1.2]),
    ([0.3, -1.0], [1.5, 0.8]),
    ([-4.0, 2.0], [1.0, 2.0]),
    ([1.0, -2.0], [0.05, 4.0]),
    ([0.5, 0.7], [1e-3, 2e-3]),
];

#[test]
fn directions_follow_their_density() {
    for (seed, (low, size)) in SHAPES.into_iter().enumerate() {
        let (sampler, chart) = rectangle(low, size);
        let directions = sampler.samples(100_000, &mut Rng::new(seed as u64));
        let pdf = |v| sampler.pdf(v);
        // The midpoint rule of the chart has an error of its own.
        assert!((chart.integral(&pdf) - 1.0).abs() < 2e-3, "{low:?} {}", chart.integral(&pdf));
        assert!(chart.fits(&directions, &pdf), "{low:?}");
        directions.iter().copied().for_each(assert_unit);
        assert!(directions.into_iter().all(|v| sampler.pdf(v) > 0.0));
    }
}

#[test]
fn points_uniform_in_area_are_found_out() {
    let ([x, y], [w, h]) = SHAPES[0];
    let (sampler, chart) = rectangle([x, y], [w, h]);
    let mut rng = Rng::new(7);
    let place = |rng: &mut Rng| [x + w * rng.uniform(), y + h * rng.uniform()];
    let mistaken: Vec<Vector3D> = (0..100_000).map(|_| (chart.place)(place(&mut rng))).collect();
    assert!(!chart.fits(&mistaken, &|v| sampler.pdf(v)));
    let right = sampler.samples(100_000, &mut rng);
    assert!(!chart.fits(&right, &|v| sampler.pdf(v) * 1.03));
}

#[test]
fn solid_angles_are_right_at_every_size() {
    for (low, size) in SHAPES {
        let (sampler, chart) = rectangle(low, size);
        let (x, y) = ([chart.low[0], chart.high[0]], [chart.low[1], chart.high[1]]);
        let strip = |x: f64| integrate(&|y| (chart.jacobian)([x, y]), y[0], y[1], 1.0, 1e-13).0;
        let exact = integrate(&strip, x[0], x[1], 1.0, 1e-12).0;
        assert!((sampler.solid_angle() / exact - 1.0).abs() < 1e-11, "{low:?}");
    }
    // The whole half space but for a rim, and ever smaller pieces seen aslant: z w h / r³ to second order.
    let (half, _) = rectangle([-1e9, -1e9], [2e9, 2e9]);
    assert!((half.solid_angle() / (TAU - 4.0 * 2f64.sqrt() * 1e-9) - 1.0).abs() < 1e-15);
    for size in [1e-8, 1e-12, 1e-100] {
        for [x, y] in [[0.0, 0.0], [3.0, -4.0], [1e3, 2e3]] {
            let exact = size * (2.0 * size) / Vector3D::new(x, y, 1.0).length().powi(3);
            let ours = solid_angle([x - 0.5 * size, size], [y - size, 2.0 * size], 1.0);
            assert!((ours / exact - 1.0).abs() < 1e-14, "{size} {x} {}", ours / exact - 1.0);
        }
    }
    // Negative control: four arc tangents cancel, as does the sum of the paper's four angles.
    let f = |x: f64, y: f64| (x * y).atan2((1.0 + x * x + y * y).sqrt());
    let s = 1e-8;
    let cancelling = f(3.0 + s, 4.0 + s) - f(3.0, 4.0 + s) - f(3.0 + s, 4.0) + f(3.0, 4.0);
    assert!((cancelling / (s * s / 26f64.powf(1.5)) - 1.0).abs() > 1e-3);
}

#[test]
fn the_closed_form_and_the_strips_agree() {
    for (low, size) in &SHAPES[..4] {
        let (sampler, _) = rectangle(*low, *size);
        for u in [0.01, 0.3, 0.5, 0.9, 0.999] {
            let t = sampler.polish(0.5 * sampler.size[0], u);
            assert!((sampler.offset(u) - t).abs() < 1e-12 * sampler.size[0], "{low:?} {u}");
            assert!((sampler.strip(t) / sampler.solid_angle() - u).abs() < 1e-15, "{low:?} {u}");
            assert!((sampler.closed_form(u) - sampler.low[0] - t).abs() < 1e-11 * sampler.size[0], "{low:?}");
        }
    }
}

#[test]
fn small_rectangles_are_filled_evenly() {
    // Seen under 1e-7 × 1e-7 rad: the solid angle of 1e-14 sr is beyond a sum of angles.
    let (sampler, _) = rectangle([3.0, 1.0], [1e-6, 1e-6]);
    let expected = sampler.size[0];
    for u in [0.125, 0.25, 0.5, 0.75] {
        assert!((sampler.offset(u) / expected - u).abs() < 1e-6);
        assert!((sampler.closed_form(u) - sampler.low[0]) / expected - u != 0.0);
    }
}

#[test]
fn the_ends_of_the_uniforms_stay_in_the_rectangle() {
    let odd = [
        ([-1e9, -1e9], [2e9, 2e9]),
        ([0.0, 0.0], [1e-9, 1e-9]),
        ([1e3, 1e3], [1e-6, 1.0]),
        ([-1.0, 5.0], [1e-3, 1e6]),
    ];
    for (low, size) in SHAPES.into_iter().chain(odd) {
        let (sampler, _) = rectangle(low, size);
        for u in extremes() {
            let v = sampler.sample_at(u);
            assert_unit(v);
            assert!(sampler.pdf(v) > 0.0 && sampler.pdf(v).is_finite(), "{low:?} {size:?} {u:?}");
        }
    }
}

#[test]
fn an_observer_on_the_other_side_or_close_to_the_plane_sees_it_too() {
    let corner = Point3D::new(-1.0, -0.5, 2.0);
    let edges = [Vector3D::new(3.0, 0.0, 0.0), Vector3D::new(0.0, 1.0, 0.0)];
    let at = |z| SphericalRectangleSampler::new(Point3D::new(0.0, 0.0, z), corner, edges).unwrap();
    let (front, back) = (at(1.0), at(3.0));
    assert!((front.solid_angle() - back.solid_angle()).abs() < 1e-15);
    for u in extremes() {
        assert!(front.sample_at(u).z > 0.0 && back.sample_at(u).z < 0.0);
    }
    assert!(back.pdf(Vector3D::new(0.0, 0.0, -1.0)) > 0.0);
    assert_eq!((back.pdf(Vector3D::Z), front.pdf(-Vector3D::Z), front.pdf(Vector3D::X)), (0.0, 0.0, 0.0));
    assert_eq!(front.pdf(Vector3D::new(0.0, 0.51, 1.0).normalise().unwrap()), 0.0);
    let near = at(2.0 - 1e-12);
    assert!((near.solid_angle() - TAU).abs() < 1e-11);
    near.samples(1000, &mut Rng::new(1)).into_iter().for_each(|v| assert!(near.pdf(v) > 0.0));
    assert!(front.solid_angle() < 4.0 * PI);
}

#[test]
fn impossible_rectangles_are_refused() {
    let new = |edges| SphericalRectangleSampler::new(Point3D::ORIGIN, Point3D::new(0.0, 0.0, 1.0), edges);
    assert!(matches!(new([Vector3D::ZERO, Vector3D::Y]), Err(MathError::NoDirection { .. })));
    for edges in [[Vector3D::X, Vector3D::new(1e-3, 1.0, 0.0)], [Vector3D::X, Vector3D::Z]] {
        assert!(matches!(new(edges), Err(MathError::OutOfRange { .. })), "{edges:?}");
    }
    let nan = Point3D::new(f64::NAN, 0.0, 1.0);
    assert!(SphericalRectangleSampler::new(Point3D::ORIGIN, nan, [Vector3D::X, Vector3D::Y]).is_err());
}
