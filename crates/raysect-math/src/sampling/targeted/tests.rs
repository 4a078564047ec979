use super::super::check::{Chart, assert_unit, cap};
use super::*;
use std::f64::consts::TAU;

const FROM: Point3D = Point3D::new(0.3, -0.2, 0.1);

fn target([x, y, z]: [f64; 3], radius: f64, weight: f64) -> TargetSphere {
    TargetSphere::new(FROM + Vector3D::new(x, y, z), radius, weight).unwrap()
}

/// Directions in and around the cone of a sphere.
fn around(target: &TargetSphere, wider: f64) -> Chart<Vector3D> {
    let (frame, cone) = target.cone_from(FROM).unwrap();
    let Chart { low, high, bins, place, coordinates, jacobian } = cap(wider * cone.solid_angle() / TAU);
    Chart {
        low,
        high,
        bins,
        place: Box::new(move |at| frame.to_world(place(at))),
        coordinates: Box::new(move |v| coordinates(frame.to_local(v))),
        jacobian,
    }
}

/// Integral over the whole sphere, by the midpoint rule in height and φ about an axis towards nothing.
fn integral(pdf: impl Fn(Vector3D) -> f64) -> f64 {
    const N: usize = 1200;
    let frame = Frame::from_z(Vector3D::new(0.48, -0.64, 0.6));
    let mut sum = 0.0;
    for i in 0..N {
        for j in 0..N {
            let u = [(i as f64 + 0.5) / N as f64, (j as f64 + 0.5) / N as f64];
            sum += pdf(frame.to_world(sphere::sample(u)));
        }
    }
    sum * 4.0 * PI / (N * N) as f64
}

/// High, low above the plane, through the plane, below it, around the point.
fn targets() -> Vec<TargetSphere> {
    vec![
        target([0.0, 0.3, 2.0], 0.5, 0.2),
        target([2.0, 0.0, 0.45], 0.4, 0.4),
        target([-2.0, -1.0, 0.1], 0.4, 0.1),
        target([0.5, 0.5, -3.0], 0.7, 0.15),
        target([0.1, 0.0, 0.0], 0.2, 0.05),
    ]
}

#[test]
fn densities_integrate_to_one() {
    let sphere = TargetedSphereSampler::new(targets()).unwrap();
    let hemisphere = TargetedHemisphereSampler::new(targets()).unwrap();
    // What the midpoint rule loses at the borders of the cones.
    let sphere = integral(|v| sphere.pdf(FROM, v));
    assert!((sphere - 1.0).abs() < 1e-3, "{sphere}");
    let hemisphere = integral(|v| hemisphere.pdf(FROM, v));
    assert!((hemisphere - 1.0).abs() < 1e-3, "{hemisphere}");
}

#[test]
fn the_elevation_of_the_direction_in_place_of_the_spheres_is_found_out() {
    // A sphere of angular radius 10° whose centre stands at 12° and 8° above the plane, and at 90°.
    let radius = 10f64.to_radians();
    for (elevation, is_above) in [(90f64, true), (12.0, true), (8.0, false)] {
        let (sin, cos) = elevation.to_radians().sin_cos();
        let ball = target([cos, 0.0, sin], radius.sin(), 0.7);
        let sampler = TargetedHemisphereSampler::new(vec![ball]).unwrap();
        assert_eq!(TargetedHemisphereSampler::cone_above(&ball, FROM).is_some(), is_above);
        let right = integral(|v| sampler.pdf(FROM, v));
        assert!((right - 1.0).abs() < 2e-3, "{elevation} {right}");
        let (frame, cone) = ball.cone_from(FROM).unwrap();
        let mistaken = integral(|v| match v.z {
            z if z <= 0.0 => 0.0,
            z if radius < z.asin() => cone_density(&frame, &cone, v),
            _ => hemisphere::pdf_cosine(v),
        });
        assert!((mistaken - 1.0).abs() > 0.02, "{elevation} {mistaken}");
    }
}

#[test]
fn directions_follow_their_densities() {
    let all = targets();
    let sphere = TargetedSphereSampler::new(all.clone()).unwrap();
    let hemisphere = TargetedHemisphereSampler::new(all.clone()).unwrap();
    let (mut first, mut second) = (Rng::new(1), Rng::new(2));
    let n = 200_000;
    let everywhere: Vec<Vector3D> = (0..n).map(|_| sphere.sample(FROM, &mut first)).collect();
    let above: Vec<Vector3D> = (0..n).map(|_| hemisphere.sample(FROM, &mut second)).collect();
    everywhere.iter().chain(&above).copied().for_each(assert_unit);
    assert!(everywhere.iter().all(|&v| sphere.pdf(FROM, v) > 0.0));
    assert!(above.iter().all(|&v| v.z > 0.0 && hemisphere.pdf(FROM, v) > 0.0));
    // The rest of the directions has one bin of its own in each.
    for ball in &all[..4] {
        assert!(around(ball, 1.0).fits(&everywhere, &|v| sphere.pdf(FROM, v)), "{ball:?}");
    }
    for ball in &all[..2] {
        assert!(around(ball, 1.0).fits(&above, &|v| hemisphere.pdf(FROM, v)), "{ball:?}");
        // Negative control: weights slightly other.
        let mut other = all.clone();
        (other[0].weight, other[1].weight) = (0.22, 0.38);
        let other = TargetedHemisphereSampler::new(other).unwrap();
        assert!(!around(ball, 1.0).fits(&above, &|v| other.pdf(FROM, v)));
    }
    // And directions of the other sampler.
    assert!(!around(&all[0], 1.0).fits(&everywhere, &|v| hemisphere.pdf(FROM, v)));
}

#[test]
fn without_a_sphere_above_the_plane_the_cosine_is_left() {
    let low = targets().split_off(2);
    let sampler = TargetedHemisphereSampler::new(low).unwrap();
    let mut rng = Rng::new(4);
    let directions: Vec<Vector3D> = (0..100_000).map(|_| sampler.sample(FROM, &mut rng)).collect();
    assert!(cap(1.0).fits(&directions, &|v| sampler.pdf(FROM, v)));
    assert!(!cap(1.0).fits(&directions, &|v| hemisphere::pdf_uniform(v)));
}

#[test]
fn overlapping_spheres_add_up() {
    let pair = vec![target([0.0, 0.0, 3.0], 1.0, 1.0), target([0.4, 0.0, 3.0], 0.5, 1.0)];
    let sampler = TargetedSphereSampler::new(pair.clone()).unwrap();
    let both = sampler.pdf(FROM, Vector3D::new(0.4, 0.0, 3.0).normalise().unwrap());
    let [wide, narrow] = [0, 1].map(|i| 0.5 / pair[i].cone_from(FROM).unwrap().1.solid_angle());
    assert!((both - (wide + narrow)).abs() < 1e-12 * both);
    let mut rng = Rng::new(5);
    let directions: Vec<Vector3D> = (0..100_000).map(|_| sampler.sample(FROM, &mut rng)).collect();
    let chart = around(&pair[1], 1.0);
    assert!(chart.fits(&directions, &|v| sampler.pdf(FROM, v)));
    assert!(!chart.fits(&directions, &|v| if sampler.pdf(FROM, v) > 0.0 { narrow } else { 0.0 }));
}

#[test]
fn weights_below_one_and_far_apart_are_kept() {
    // Raysect runs past the end of its table if the weights sum to less than 1.
    for weights in [[0.2, 0.2], [1e-9, 2e-9], [1e9, 1.0]] {
        let pair = [[0.0, 0.0, 3.0], [0.0, 3.0, 0.0]];
        let sampler = TargetedSphereSampler::new([0, 1].map(|i| target(pair[i], 0.5, weights[i]))).unwrap();
        let mut rng = Rng::new(6);
        let n = 20_000;
        let count = (0..n).filter(|_| sampler.sample(FROM, &mut rng).z > 0.5).count() as f64;
        let p = weights[0] / (weights[0] + weights[1]);
        assert!((count / n as f64 - p).abs() <= 4.0 * (p * (1.0 - p) / n as f64).sqrt() + 1e-8);
    }
}

#[test]
fn tiny_and_touching_spheres_have_finite_densities() {
    let mut rng = Rng::new(8);
    for ball in [
        target([1e3, 2e3, 5e2], 1e-9, 1.0),
        target([0.0, 0.0, 1.0], 1.0 - 1e-12, 1.0),
        target([1.0, 0.0, 0.1 + 1e-15], 0.1, 1.0),
        target([1e140, 1.0, 1e140], 1.0, 1.0),
    ] {
        let sphere = TargetedSphereSampler::new(vec![ball]).unwrap();
        let hemisphere = TargetedHemisphereSampler::new(vec![ball]).unwrap();
        for _ in 0..10_000 {
            let (v, w) = (sphere.sample(FROM, &mut rng), hemisphere.sample(FROM, &mut rng));
            assert_unit(v);
            let densities = [sphere.pdf(FROM, v), hemisphere.pdf(FROM, w)];
            assert!(w.z > 0.0 && densities.iter().all(|p| p.is_finite() && *p > 0.0), "{ball:?} {v:?} {w:?}");
        }
    }
}

#[test]
fn impossible_targets_are_refused() {
    let p = Point3D::ORIGIN;
    for (centre, radius, weight) in [
        (p, 0.0, 1.0),
        (p, -1.0, 1.0),
        (p, 1.0, 0.0),
        (p, 1.0, f64::NAN),
        (p, f64::INFINITY, 1.0),
        (Point3D::new(f64::NAN, 0.0, 0.0), 1.0, 1.0),
    ] {
        assert!(matches!(TargetSphere::new(centre, radius, weight), Err(MathError::OutOfRange { .. })));
    }
    let message = TargetedHemisphereSampler::new(vec![]).unwrap_err().to_string();
    assert_eq!(message, "number of targets = 0 is outside its range 1 or more");
    assert!(TargetedSphereSampler::new(vec![]).is_err());
}
