use super::super::check::{Chart, assert_unit, extremes};
use super::*;
use crate::{Frame, Rng, integrate};

/// The corners as places in the plane z = 1, turned and moved with their observer.
fn triangle(corners: [[f64; 2]; 3]) -> (SphericalTriangleSampler, Chart<Vector3D>) {
    let frame = Frame::from_z(Vector3D::new(0.36, -0.48, 0.8));
    let observer = Point3D::new(1.0, -2.0, 0.5);
    let places = corners.map(|[x, y]| observer + frame.to_world(Vector3D::new(x, y, 1.0)));
    let sampler = SphericalTriangleSampler::new(observer, places).unwrap();
    let [a, b, c] = corners;
    let (e, f) = ([b[0] - a[0], b[1] - a[1]], [c[0] - a[0], c[1] - a[1]]);
    let area = e[0] * f[1] - e[1] * f[0];
    let plane = move |[s, g]: [f64; 2]| {
        [a[0] + s * (e[0] + g * (f[0] - e[0])), a[1] + s * (e[1] + g * (f[1] - e[1]))]
    };
    // s = β + γ and γ / s of the barycentric coordinates.
    let chart = Chart {
        low: [0.0, 0.0],
        high: [1.0, 1.0],
        bins: [8, 8],
        place: Box::new(move |at| {
            let [x, y] = plane(at);
            frame.to_world(Vector3D::new(x, y, 1.0)).normalise().unwrap()
        }),
        coordinates: Box::new(move |v| {
            let v = frame.to_local(v);
            let w = [v.x / v.z - a[0], v.y / v.z - a[1]];
            let beta = (w[0] * f[1] - w[1] * f[0]) / area;
            let gamma = (e[0] * w[1] - e[1] * w[0]) / area;
            [beta + gamma, gamma / (beta + gamma)]
        }),
        jacobian: Box::new(move |at| {
            let [x, y] = plane(at);
            at[0] * area.abs() * (1.0 + x * x + y * y).powf(-1.5)
        }),
    };
    (sampler, chart)
}

/// Around the foot of the observer, beside it, clockwise and slender, small.
const SHAPES: [[[f64; 2]; 3]; 4] = [
    [[-0.5, -0.7], [1.0, -0.4], [0.1, 0.8]],
    [[1.0, 1.0], [2.0, 1.5], [1.2, 2.5]],
    [[0.0, 1.0], [2.0, 1.3], [1.9, 1.2]],
    [[0.5, 0.7], [0.501, 0.7], [0.5003, 0.7015]],
];

#[test]
fn directions_follow_their_density() {
    for (seed, corners) in SHAPES.into_iter().enumerate() {
        let (sampler, chart) = triangle(corners);
        let directions = sampler.samples(100_000, &mut Rng::new(seed as u64));
        let pdf = |v| sampler.pdf(v);
        // The midpoint rule of the chart has an error of its own.
        assert!((chart.integral(&pdf) - 1.0).abs() < 2e-3, "{corners:?} {}", chart.integral(&pdf));
        assert!(chart.fits(&directions, &pdf), "{corners:?}");
        directions.iter().copied().for_each(assert_unit);
        assert!(directions.into_iter().all(|v| sampler.pdf(v) > 0.0));
    }
}

#[test]
fn points_uniform_in_area_are_found_out() {
    let corners = SHAPES[0];
    let (sampler, chart) = triangle(corners);
    let mut rng = Rng::new(9);
    let place = |rng: &mut Rng| (chart.place)([rng.uniform().sqrt(), rng.uniform()]);
    let mistaken: Vec<Vector3D> = (0..100_000).map(|_| place(&mut rng)).collect();
    assert!(!chart.fits(&mistaken, &|v| sampler.pdf(v)));
    let right = sampler.samples(100_000, &mut rng);
    assert!(!chart.fits(&right, &|v| sampler.pdf(v) * 1.03));
    let mut other = corners;
    other[2][0] += 0.05;
    let (wrong, _) = triangle(other);
    assert!(!chart.fits(&right, &|v| wrong.pdf(v)));
}

#[test]
fn solid_angles_are_right_at_every_size() {
    for (corners, chart) in SHAPES.map(|corners| (corners, triangle(corners).1)) {
        let strip = |s: f64| integrate(&|g| (chart.jacobian)([s, g]), 0.0, 1.0, 1.0, 1e-13).0;
        let exact = integrate(&strip, 0.0, 1.0, 1.0, 1e-12).0;
        assert!((triangle(corners).0.solid_angle() / exact - 1.0).abs() < 1e-10, "{corners:?}");
    }
    // Ever smaller, seen aslant: area · cos / r² to second order; corners are exact binary numbers.
    for exponent in [-27, -30, -40] {
        let size = 2f64.powi(exponent);
        let at = |x: f64, y: f64| Point3D::new(3.0 + size * x, 4.0 + size * y, 1.0);
        let corners = [at(-1.0, -1.0), at(2.0, -1.0), at(-1.0, 2.0)];
        let sampler = SphericalTriangleSampler::new(Point3D::ORIGIN, corners).unwrap();
        let exact = 4.5 * size * size / 26f64.powf(1.5);
        assert!((sampler.solid_angle() / exact - 1.0).abs() < 1e-14, "{exponent}");
        // Negative control: the sum of the angles less π has no digit left.
        let [a, b, c] = corners.map(|p| p.to_vector().normalise().unwrap());
        let angle =
            |a: Vector3D, b: Vector3D, c: Vector3D| a.cross(b).angle(a.cross(c)).unwrap().to_radians();
        let excess = angle(a, b, c) + angle(b, c, a) + angle(c, a, b) - std::f64::consts::PI;
        assert!((excess / exact - 1.0).abs() > 0.01);
    }
}

#[test]
fn small_triangles_are_filled_evenly() {
    let size = 2f64.powi(-23);
    let at = |x: f64, y: f64| Point3D::new(3.0 + size * x, 4.0 + size * y, 1.0);
    let corners = [at(0.0, 0.0), at(1.0, 0.0), at(0.0, 1.0)];
    let sampler = SphericalTriangleSampler::new(Point3D::ORIGIN, corners).unwrap();
    let directions = sampler.samples(100_000, &mut Rng::new(3));
    let chart = Chart {
        low: [0.0, 0.0],
        high: [1.0, 1.0],
        bins: [8, 8],
        place: Box::new(|[s, g]| [s * (1.0 - g), s * g]),
        coordinates: Box::new(|[beta, gamma]: [f64; 2]| [beta + gamma, gamma / (beta + gamma)]),
        jacobian: Box::new(|[s, _]| s),
    };
    let places: Vec<[f64; 2]> =
        directions.iter().map(|v| [(v.x / v.z - 3.0) / size, (v.y / v.z - 4.0) / size]).collect();
    assert!(chart.fits(&places, &|_| 2.0));
    assert!(!chart.fits(&places, &|[beta, _]| 2.0 + 0.5 * (beta - 1.0 / 3.0)));
}

#[test]
fn the_ends_of_the_uniforms_stay_in_the_triangle() {
    let odd = [
        [[-1e6, -1e6], [1e6, -1e6], [0.0, 1e6]],
        [[0.0, 0.0], [1e-9, 0.0], [0.0, 1e-9]],
        [[0.0, 0.0], [1.0, 0.0], [0.5, 1e-9]],
        [[1.0, 0.0], [1.0, 1e-7], [5.0, 1e-3]],
    ];
    for corners in SHAPES.into_iter().chain(odd) {
        for [i, j, k] in [[0, 1, 2], [2, 1, 0], [1, 2, 0]] {
            let (sampler, _) = triangle([corners[i], corners[j], corners[k]]);
            for u in extremes() {
                let v = sampler.sample_at(u);
                assert_unit(v);
                assert!(sampler.pdf(v) > 0.0 && sampler.pdf(v).is_finite(), "{corners:?} {u:?}");
            }
        }
    }
}

#[test]
fn outside_the_triangle_the_density_is_zero() {
    let (sampler, chart) = triangle(SHAPES[0]);
    for at in [[1.0 + 1e-9, 0.5], [0.5, -1e-9], [0.5, 1.0 + 1e-9]] {
        assert_eq!(sampler.pdf((chart.place)(at)), 0.0, "{at:?}");
    }
    let v = (chart.place)([0.5, 0.5]);
    assert!(sampler.pdf(v) > 0.0);
    assert_eq!(sampler.pdf(-v), 0.0);
}

#[test]
fn observers_in_the_plane_and_flat_triangles_are_refused() {
    let p = Point3D::new;
    let corners = [p(0.0, 0.0, 1.0), p(1.0, 0.0, 1.0), p(0.0, 1.0, 1.0)];
    for observer in
        [p(5.0, 5.0, 1.0), corners[0], corners[2], p(f64::NAN, 0.0, 0.0), p(0.0, f64::INFINITY, 0.0)]
    {
        assert!(SphericalTriangleSampler::new(observer, corners).is_err(), "{observer:?}");
    }
    let flat = [corners[0], corners[1], p(2.0, 0.0, 1.0)];
    let message = SphericalTriangleSampler::new(Point3D::ORIGIN, flat).unwrap_err().to_string();
    assert!(message.contains("volume between observer and triangle"), "{message}");
}
