use super::super::check::{Chart, assert_unit, cap, extremes};
use super::*;
use crate::{ConeUniformSampler, Rng, integrate};
use std::f64::consts::{PI, TAU};

/// A disk in the plane z = 1 with its centre on the x axis, turned and moved with its observer; the chart has the squared
/// share of the radius and the angle around the centre.
fn disk(foot: f64, radius: f64) -> (SphericalDiskSampler, Chart<Vector3D>) {
    let frame = Frame::from_z(Vector3D::new(0.36, -0.48, 0.8));
    let observer = Point3D::new(1.0, -2.0, 0.5);
    let centre = observer + frame.to_world(Vector3D::new(foot, 0.0, 1.0));
    let sampler = SphericalDiskSampler::new(observer, centre, frame.z, radius).unwrap();
    let plane = move |[q, phi]: [f64; 2]| {
        let r = radius * q.sqrt();
        [foot + r * phi.cos(), r * phi.sin()]
    };
    let chart = Chart {
        low: [0.0, -PI],
        high: [1.0, PI],
        bins: [8, 12],
        place: Box::new(move |at| {
            let [x, y] = plane(at);
            frame.to_world(Vector3D::new(x, y, 1.0)).normalise().unwrap()
        }),
        coordinates: Box::new(move |v| {
            let v = frame.to_local(v);
            let (x, y) = (v.x / v.z - foot, v.y / v.z);
            [(x * x + y * y) / (radius * radius), y.atan2(x)]
        }),
        jacobian: Box::new(move |at| {
            let [x, y] = plane(at);
            0.5 * radius * radius * (1.0 + x * x + y * y).powf(-1.5)
        }),
    };
    (sampler, chart)
}

/// From the axis, beside it, from below the rim, from far outside, wide, small.
const SHAPES: [[f64; 2]; 6] = [[0.0, 1.0], [0.5, 1.2], [1.0, 1.0], [4.0, 1.5], [2.0, 5.0], [0.8, 1e-3]];

#[test]
fn directions_follow_their_density() {
    for (seed, [foot, radius]) in SHAPES.into_iter().enumerate() {
        let (sampler, chart) = disk(foot, radius);
        let directions = sampler.samples(60_000, &mut Rng::new(seed as u64));
        let pdf = |v| sampler.pdf(v);
        // The midpoint rule of the chart has an error of its own.
        assert!((chart.integral(&pdf) - 1.0).abs() < 1e-2, "{foot} {radius} {}", chart.integral(&pdf));
        assert!(chart.fits(&directions, &pdf), "{foot} {radius}");
        directions.iter().copied().for_each(assert_unit);
        assert!(directions.into_iter().all(|v| sampler.pdf(v) > 0.0));
    }
}

#[test]
fn points_uniform_in_area_are_found_out() {
    let (sampler, chart) = disk(0.5, 1.2);
    let mut rng = Rng::new(9);
    let mistaken: Vec<Vector3D> =
        (0..60_000).map(|_| (chart.place)([rng.uniform(), rng.range(-PI, PI)])).collect();
    assert!(!chart.fits(&mistaken, &|v| sampler.pdf(v)));
    let right = sampler.samples(60_000, &mut rng);
    assert!(!chart.fits(&right, &|v| sampler.pdf(v) * 1.05));
    let (wrong, _) = disk(0.53, 1.2);
    assert!(!chart.fits(&right, &|v| wrong.pdf(v)));
    // The angle taken evenly along the rim is close, and told.
    let evenly: Vec<Vector3D> = (0..60_000)
        .map(|_| {
            let even = SphericalDiskSampler { cosines: [sampler.cosines[0]; 2], ..sampler };
            let t = sampler.parameter(even.share(rng.uniform() * FRAC_PI_2) / even.quarter);
            sampler.sample_at([t / TAU, rng.uniform()])
        })
        .collect();
    assert!(!chart.fits(&evenly, &|v| sampler.pdf(v)));
}

/// The solid angle by quadrature over the disk.
fn exact(foot: f64, radius: f64) -> f64 {
    let ring = |r: f64| {
        let spoke = |phi: f64| {
            let (x, y) = (foot + r * phi.cos(), r * phi.sin());
            r * (1.0 + x * x + y * y).powf(-1.5)
        };
        2.0 * integrate(&spoke, 0.0, PI, 1.0, 1e-14).0
    };
    integrate(&ring, 0.0, radius, 1.0, 1e-13).0
}

#[test]
fn solid_angles_are_right_at_every_size() {
    for [foot, radius] in SHAPES.into_iter().chain([[30.0, 20.0], [15.0, 20.0], [10.0, 10.0]]) {
        let ours = disk(foot, radius).0.solid_angle();
        assert!((ours / exact(foot, radius) - 1.0).abs() < 1e-12, "{foot} {radius} {ours}");
    }
    for angle in [1e-6, 0.3, 45.0, 89.0, 89.999_999] {
        let cone = ConeUniformSampler::new(angle).unwrap().solid_angle();
        let ours = disk(0.0, angle.to_radians().tan()).0.solid_angle();
        assert!((ours / cone - 1.0).abs() < 1e-13, "{angle}");
    }
    // Ever smaller, seen aslant: area · cos / r² to second order.
    for size in [1e-8, 1e-12, 1e-100] {
        let cone = EllipticCone::of_disk(1.0, 3.0, size);
        let product = [cone.along, cone.across].map(|tangent| tangent.atan().sin());
        let ours = PI * product[0] * product[1];
        assert!((ours / (PI * size * size / 10f64.powf(1.5)) - 1.0).abs() < 1e-14, "{size}");
        let at = Point3D::new(3.0, 0.0, 1.0);
        let sampler = SphericalDiskSampler::new(Point3D::ORIGIN, at, Vector3D::Z, size).unwrap();
        assert!((sampler.solid_angle() / ours - 1.0).abs() < 1e-14, "{size}");
    }
    // From just above the inner part it is all of the half space, from just above the outer plane next to nothing.
    let near = |foot: f64| {
        let at = Point3D::new(foot, 0.0, 1e-12);
        SphericalDiskSampler::new(Point3D::ORIGIN, at, Vector3D::Z, 1.0).unwrap().solid_angle()
    };
    assert!((near(0.5) - TAU).abs() < 1e-11 && near(2.0) > 0.0 && near(2.0) < 1e-11);
}

#[test]
fn shares_and_parameters_undo_each_other() {
    for [foot, radius] in SHAPES.into_iter().chain([[1e3, 999.0], [999.0, 1e3], [1.0, 1e6]]) {
        let (sampler, _) = disk(foot, radius);
        for u in [1e-9, 0.01, 0.3, 0.5, 0.9, 0.999] {
            let t = sampler.parameter(u);
            assert!((sampler.share(t) / sampler.quarter / u - 1.0).abs() < 1e-15, "{foot} {radius} {u}");
            let halves: f64 = integrate(&|t| 1.0 / (1.0 + sampler.rim(t)), 0.0, t, 0.5, 1e-14).0;
            assert!((halves / sampler.share(t) - 1.0).abs() < 1e-13, "{foot} {radius} {u}");
        }
    }
}

#[test]
fn the_ends_of_the_uniforms_stay_in_the_disk() {
    let odd = [[0.0, 1e9], [0.0, 1e-9], [1e6, 1.0], [1e3, 1e3], [1e6, 1e6 - 1.0], [0.3, 1e-12]];
    for [foot, radius] in SHAPES.into_iter().chain(odd) {
        let (sampler, _) = disk(foot, radius);
        for u in extremes() {
            let v = sampler.sample_at(u);
            assert_unit(v);
            assert!(sampler.pdf(v) > 0.0 && sampler.pdf(v).is_finite(), "{foot} {radius} {u:?}");
        }
    }
}

#[test]
fn either_side_is_seen_and_neighbours_stay_neighbours() {
    let at = |z: f64| {
        SphericalDiskSampler::new(Point3D::new(0.2, 0.1, z), Point3D::ORIGIN, Vector3D::Z, 0.7).unwrap()
    };
    let (front, back) = (at(-0.5), at(0.5));
    assert!((front.solid_angle() - back.solid_angle()).abs() < 1e-15);
    for u in extremes() {
        assert!(front.sample_at(u).z > 0.0 && back.sample_at(u).z < 0.0);
    }
    assert_eq!((front.pdf(-Vector3D::Z), back.pdf(Vector3D::Z), front.pdf(Vector3D::X)), (0.0, 0.0, 0.0));
    for i in 0..400 {
        let u = f64::from(i) / 400.0;
        let (v, w) = (front.sample_at([u, 0.8]), front.sample_at([(u + 0.0025) % 1.0, 0.8]));
        assert!(v.angle(w).unwrap() < 2.0, "{u}");
    }
    // Seen from the axis it is the cone.
    let round = SphericalDiskSampler::new(Point3D::ORIGIN, Point3D::new(0.0, 0.0, 2.0), Vector3D::Z, 1.0);
    let (round, versine) = (round.unwrap(), 1.0 - 2.0 / 5f64.sqrt());
    assert!(cap(versine).fits(&round.samples(60_000, &mut Rng::new(2)), &|v| round.pdf(v)));
}

#[test]
fn impossible_disks_are_refused() {
    let new = |z: f64, normal, radius| {
        SphericalDiskSampler::new(Point3D::ORIGIN, Point3D::new(1.0, 0.0, z), normal, radius)
    };
    assert!(matches!(new(1.0, Vector3D::ZERO, 1.0), Err(MathError::NoDirection { .. })));
    for radius in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert!(matches!(new(1.0, Vector3D::Z, radius), Err(MathError::OutOfRange { .. })));
    }
    let message = new(0.0, Vector3D::Z, 1.0).unwrap_err().to_string();
    assert!(message.starts_with("distance of the observer from the plane = 0 m"), "{message}");
    assert!(new(f64::NAN, Vector3D::Z, 1.0).is_err() && new(1.0, Vector3D::Z, 1e-200).is_err());
}
