use super::super::check::{assert_unit, cap, extremes};
use super::*;
use crate::Rng;

/// Radius over distance, and the solid angle of the sphere [sr] from arithmetic with 60 digits.
const SPHERES: [(f64, f64); 6] = [
    (1e-8, 3.1415926535897933e-16),
    (1e-4, 3.141592661443775e-08),
    (0.5, 0.8417872144769329),
    (0.9, 3.5444083274260487),
    (1.0 - 1e-4, 6.194329869885662),
    (1.0 - 1e-8, 6.282296730591944),
];

/// Half angle [deg], and the solid angle of the cone [sr] from arithmetic with 60 digits.
const ANGLES: [(f64, f64); 6] = [
    (1e-9, 9.56983848157402e-22),
    (1e-3, 9.569838481331091e-10),
    (45.0, 1.8403023690212201),
    (90.0, TAU),
    (120.0, 1.5 * TAU),
    (180.0, 2.0 * TAU),
];

#[test]
fn solid_angles_are_right_to_rounding() {
    for (ratio, solid_angle) in SPHERES {
        for distance in [1.0, 3e-5, 7e40] {
            let error = Cone::of_sphere(ratio * distance, distance).solid_angle() / solid_angle - 1.0;
            // The product ratio · distance is itself rounded.
            let rounded = f64::EPSILON / (1.0 - ratio).sqrt();
            assert!(error.abs() <= if distance == 1.0 { 1e-15 } else { 1e-15 + rounded }, "{ratio} {error}");
        }
        let error = Cone::from_sin_squared(ratio * ratio).solid_angle() / solid_angle - 1.0;
        assert!(error.abs() <= 1e-15 + f64::EPSILON / (1.0 - ratio).sqrt(), "{ratio} {error}");
    }
    // Just outside the surface: cos² θ from the exact gap between radius and distance.
    let gap = 0.5f64.powi(40);
    let cos = (gap / 3.0 * (2.0 - gap / 3.0)).sqrt();
    assert!((Cone::of_sphere(3.0 - gap, 3.0).solid_angle() / (TAU * (1.0 - cos)) - 1.0).abs() < 1e-15);
    for (angle, solid_angle) in ANGLES {
        let cone = Cone::from_angle(angle).unwrap();
        assert!((cone.solid_angle() / solid_angle - 1.0).abs() < 1e-15, "{angle}");
        assert!((cone.angle() / angle - 1.0).abs() < 1e-7, "{angle}");
        assert!(angle > 170.0 || (cone.angle() / angle - 1.0).abs() < 2e-15, "{angle}");
    }
    assert!((ConeUniformSampler::default().solid_angle() / ANGLES[2].1 - 1.0).abs() < 1e-15);
}

#[test]
fn uniform_directions_follow_their_density_in_cones_of_every_width() {
    let spheres = SPHERES.map(|(ratio, exact)| (Cone::of_sphere(ratio, 1.0), exact));
    let angles = ANGLES.map(|(angle, exact)| (Cone::from_angle(angle).unwrap(), exact));
    for (seed, (cone, exact)) in spheres.into_iter().chain(angles).enumerate() {
        let chart = cap(exact / TAU);
        let sampler = ConeUniformSampler::from(cone);
        let directions = sampler.samples(100_000, &mut Rng::new(seed as u64));
        assert!((chart.integral(&|v| sampler.pdf(v)) - 1.0).abs() < 1e-12);
        assert!(chart.fits(&directions, &|v| sampler.pdf(v)), "{cone:?}");
        assert!(!chart.fits(&directions, &|v| if v.x > 0.0 { 0.95 } else { 1.05 } * sampler.pdf(v)));
        if exact > 0.1 {
            let cosine = |v: Vector3D| v.z.max(0.0) / PI;
            assert!(!chart.fits(&directions, &cosine), "{cone:?}");
        }
        directions.into_iter().for_each(assert_unit);
    }
}

#[test]
fn a_cone_one_per_cent_off_is_found_out() {
    for ratio in [1e-8, 0.5, 0.97] {
        let cone = Cone::of_sphere(ratio, 1.0);
        let directions = cone.samples(100_000, &mut Rng::new(9));
        let exact = ratio * ratio / (1.0 + (1.0 - ratio * ratio).sqrt());
        for other in [0.99, 1.01] {
            let wrong = Cone::of_sphere(ratio * other, 1.0);
            assert!(!cap(exact).fits(&directions, &|v| wrong.pdf(v)));
            assert!(!cap(wrong.versine).fits(&directions, &|v| wrong.pdf(v)));
        }
    }
}

#[test]
fn cosine_weighted_directions_follow_their_density() {
    for (seed, angle) in [1e-6, 5.0, 45.0, 80.0, 90.0].into_iter().enumerate() {
        let sampler = ConeCosineSampler::new(angle).unwrap();
        let half = (0.5f64 * angle).to_radians().sin();
        let chart = cap(2.0 * half * half);
        let directions = sampler.samples(200_000, &mut Rng::new(seed as u64));
        assert!((chart.integral(&|v| sampler.pdf(v)) - 1.0).abs() < 1e-12);
        assert!(chart.fits(&directions, &|v| sampler.pdf(v)), "{angle}");
        if angle > 20.0 {
            let uniform = ConeUniformSampler::new(angle).unwrap();
            assert!(!chart.fits(&directions, &|v| uniform.pdf(v)));
            let mistaken = uniform.samples(200_000, &mut Rng::new(seed as u64));
            assert!(!chart.fits(&mistaken, &|v| sampler.pdf(v)));
        }
        directions.into_iter().for_each(assert_unit);
    }
}

#[test]
fn a_disk_of_radius_asin_in_place_of_sin_is_found_out() {
    let angle = 45f64.to_radians();
    let mut rng = Rng::new(5);
    let mistaken: Vec<Vector3D> = (0..200_000)
        .map(|_| {
            let (r, phi) = (angle.asin() * rng.uniform().sqrt(), TAU * rng.uniform());
            Vector3D::new(r * phi.cos(), r * phi.sin(), (1.0 - r * r).sqrt())
        })
        .collect();
    let sampler = ConeCosineSampler::default();
    assert!(!cap(1.0 - angle.cos()).fits(&mistaken, &|v| sampler.pdf(v)));
    assert!(!cap(1.0).fits(&mistaken, &|v| sampler.pdf(v)));
    let right = sampler.samples(200_000, &mut rng);
    let claimed = angle.asin().powi(2);
    assert!(!cap(1.0 - angle.cos()).fits(&right, &|v| v.z / (PI * claimed)));
}

#[test]
fn the_ends_of_the_uniforms_give_unit_vectors_in_the_cone() {
    let spheres = SPHERES.map(|(ratio, _)| Cone::of_sphere(ratio, 1.0));
    let angles = [1e-140, 1e-9, 1.0, 89.999_999, 90.0, 135.0, 180.0].map(|a| Cone::from_angle(a).unwrap());
    for cone in spheres.into_iter().chain(angles) {
        let cosine = ConeCosineSampler::within(cone);
        for u in extremes() {
            let (v, w) = (cone.sample_at(u), cosine.sample_at(u));
            assert_unit(v);
            assert_unit(w);
            assert!(cone.contains(v) && cone.pdf(v).is_finite() && cone.pdf(v) > 0.0, "{cone:?} {u:?}");
            assert!(w.z > 0.0 && cosine.pdf(w) > 0.0 && cosine.pdf(w).is_finite(), "{cone:?} {u:?}");
        }
    }
}

#[test]
fn outside_the_cone_the_density_is_zero() {
    let narrow = Cone::of_sphere(1e-8, 1.0);
    assert!(narrow.pdf(Vector3D::new(0.0, 0.999_999e-8, 1.0)) > 0.0);
    assert_eq!(narrow.pdf(Vector3D::new(0.0, 1.000_001e-8, 1.0)), 0.0);
    assert_eq!(narrow.pdf(-Vector3D::Z), 0.0);
    let wide = Cone::from_angle(120.0).unwrap();
    let at = |angle: f64| Vector3D::new(angle.to_radians().sin(), 0.0, angle.to_radians().cos());
    assert!(wide.contains(at(119.999_999)) && !wide.contains(at(120.000_001)));
    let cosine = ConeCosineSampler::within(wide);
    assert_eq!((cosine.solid_angle(), cosine.pdf(at(90.000_001))), (TAU, 0.0));
    assert!(cosine.pdf(at(89.999_999)) > 0.0);
    assert_eq!(cosine.pdf(Vector3D::new(1.0, 0.0, -1e-16)), 0.0);
}

#[test]
fn a_sphere_around_the_apex_gives_the_half_space() {
    for (radius, distance) in [(1.0, 1.0), (2.0, 1.0), (1.0, 0.0)] {
        assert_eq!(Cone::of_sphere(radius, distance).solid_angle(), TAU);
    }
    assert_eq!(Cone::from_sin_squared(1.5), Cone::from_sin_squared(1.0));
    assert!(Cone::from_sin_squared(0.0).pdf(Vector3D::Z).is_finite());
    assert!(Cone::of_sphere(0.0, 1.0).pdf(Vector3D::Z).is_finite());
    assert!(Cone::of_sphere(f64::NAN, 1.0).solid_angle().is_nan());
}

#[test]
fn angles_out_of_range_are_refused() {
    for angle in [0.0, -1.0, 180.1, f64::NAN, f64::INFINITY] {
        assert!(Cone::from_angle(angle).is_err() && ConeUniformSampler::new(angle).is_err());
        assert!(ConeCosineSampler::new(angle).is_err());
    }
    let message = ConeCosineSampler::new(91.0).unwrap_err().to_string();
    assert_eq!(message, "cone angle = 91 deg is outside its range 1e-140 … 90");
}
