//! Samplers for all uniform numbers, and the generator of these.

use proptest::prelude::*;
use raysect_math::sampling::{disk, hemisphere, sphere, square, triangle};
use raysect_math::{
    Cone, ConeCosineSampler, ConeUniformSampler, DiskSampler3D, HemisphereCosineSampler,
    HemisphereUniformSampler, Point3D, RectangleSampler3D, Rng, SphereSampler, SphericalDiskSampler,
    SphericalRectangleSampler, SphericalTriangleSampler, Stratum, StreamKey, TargetSphere,
    TargetedHemisphereSampler, TargetedSphereSampler, TriangleSampler3D, Vector3D,
};

fn uniforms() -> impl Strategy<Value = [f64; 2]> {
    let edge = 1.0 / (1u64 << 53) as f64;
    prop::array::uniform2(prop_oneof![8 => edge..1.0 - edge, 1 => Just(edge), 1 => Just(1.0 - edge)])
}

fn point() -> impl Strategy<Value = Point3D> {
    prop::array::uniform3(-3.0..3.0f64).prop_map(Point3D::from)
}

fn is_unit(v: Vector3D) -> bool {
    (v.length() - 1.0).abs() < 8.0 * f64::EPSILON
}

proptest! {
    #[test]
    fn points_lie_where_their_density_is_not_zero(u in uniforms(), size in prop::array::uniform2(1e-6..1e6f64)) {
        prop_assert!(disk::pdf(disk::sample(u)) > 0.0 && square::pdf(square::sample(u)) > 0.0);
        let shares = triangle::sample(u);
        prop_assert!(triangle::pdf(shares) > 0.0 && (shares.iter().sum::<f64>() - 1.0).abs() < 4.0 * f64::EPSILON);
        let round = DiskSampler3D::new(size[0]).unwrap();
        prop_assert!((round.pdf(round.sample_at(u)) * round.area() - 1.0).abs() < 4.0 * f64::EPSILON);
        prop_assert_eq!(round.radius(), size[0]);
        let oblong = RectangleSampler3D::new(size[0], size[1]).unwrap();
        prop_assert!((oblong.pdf(oblong.sample_at(u)) * oblong.area() - 1.0).abs() < 4.0 * f64::EPSILON);
        prop_assert_eq!((oblong.width(), oblong.height()), (size[0], size[1]));
    }

    #[test]
    fn directions_lie_where_their_density_is_not_zero(u in uniforms(), angle in 1e-6..90.0f64) {
        let (uniform, cosine) = (ConeUniformSampler::new(angle).unwrap(), ConeCosineSampler::new(angle).unwrap());
        let all = [
            (sphere::sample(u), sphere::pdf(sphere::sample(u))),
            (SphereSampler.sample_at(u), SphereSampler.pdf(SphereSampler.sample_at(u))),
            (hemisphere::sample_uniform(u), hemisphere::pdf_uniform(hemisphere::sample_uniform(u))),
            (hemisphere::sample_cosine(u), hemisphere::pdf_cosine(hemisphere::sample_cosine(u))),
            (uniform.sample_at(u), uniform.pdf(uniform.sample_at(u))),
            (cosine.sample_at(u), cosine.pdf(cosine.sample_at(u))),
        ];
        for (v, pdf) in all {
            prop_assert!(is_unit(v) && pdf > 0.0 && pdf.is_finite(), "{v:?} {pdf}");
        }
        prop_assert_eq!(HemisphereUniformSampler.sample_at(u), hemisphere::sample_uniform(u));
        prop_assert_eq!(HemisphereCosineSampler.sample_at(u), hemisphere::sample_cosine(u));
        prop_assert!((uniform.cone().angle() / angle - 1.0).abs() < 1e-14);
        let ball = Cone::of_sphere(angle.to_radians().sin(), 1.0);
        prop_assert!((ball.solid_angle() / uniform.solid_angle() - 1.0).abs() < 1e-6 || angle > 89.0);
        prop_assert_eq!(cosine.solid_angle(), uniform.cone().solid_angle().min(std::f64::consts::TAU));
    }

    #[test]
    fn directions_meet_what_they_were_drawn_towards(
        from in point(), a in point(), b in point(), c in point(), radius in 0.01..2.0f64, u in uniforms(),
    ) {
        let height = |normal: Vector3D| normal.dot(a.vector_to(from)).abs();
        // Where the ray meets the plane of a.
        let meet = |v: Vector3D, normal: Vector3D| from + v * (from.vector_to(a).dot(normal) / v.dot(normal));
        let normal = a.vector_to(b).cross(a.vector_to(c));
        prop_assume!(normal.length() > 0.1 && a.distance_to(b) > 0.1);
        let normal = normal.normalise().unwrap();
        prop_assume!(height(normal) > 0.05);
        let triangle = SphericalTriangleSampler::new(from, [a, b, c]).unwrap();
        let v = triangle.sample_at(u);
        prop_assert!(is_unit(v) && triangle.pdf(v) == 1.0 / triangle.solid_angle());
        let flat = TriangleSampler3D::new(a, b, c).unwrap();
        prop_assert_eq!((flat.vertices(), flat.pdf(flat.sample_at(u)) > 0.0), ([a, b, c], true));
        let disk = SphericalDiskSampler::new(from, a, normal, radius).unwrap();
        let v = disk.sample_at(u);
        prop_assert!(is_unit(v) && disk.pdf(v) == 1.0 / disk.solid_angle());
        prop_assert!(meet(v, normal).distance_to(a) <= radius * (1.0 + 1e-10));
        let edges = [a.vector_to(b), normal.cross(a.vector_to(b))];
        let rectangle = SphericalRectangleSampler::new(from, a, edges).unwrap();
        let v = rectangle.sample_at(u);
        prop_assert!(is_unit(v) && rectangle.pdf(v) == 1.0 / rectangle.solid_angle());
        let across = a.vector_to(meet(v, normal));
        for edge in edges {
            let part = across.dot(edge) / edge.length_squared();
            prop_assert!((-1e-9..=1.0 + 1e-9).contains(&part), "{part}");
        }
    }

    #[test]
    fn targeted_directions_have_a_density(
        from in point(), centres in prop::array::uniform2(point()), radii in prop::array::uniform2(0.01..2.0f64), seed in any::<u64>(),
    ) {
        let target = |i: usize| TargetSphere::new(centres[i], radii[i], radii[1 - i]).unwrap();
        let targets = [target(0), target(1)];
        let (all, above) =
            (TargetedSphereSampler::new(targets).unwrap(), TargetedHemisphereSampler::new(targets).unwrap());
        let mut rng = Rng::new(seed);
        let (v, w) = (all.sample(from, &mut rng), above.sample(from, &mut rng));
        prop_assert!(is_unit(v) && all.pdf(from, v) > 0.0 && all.pdf(from, v).is_finite());
        prop_assert!(is_unit(w) && w.z > 0.0 && above.pdf(from, w) > 0.0 && above.pdf(from, -w) == 0.0);
    }

    #[test]
    fn generators_repeat_themselves_and_keep_their_bounds(
        seed in any::<u64>(), sample in any::<u64>(), index in any::<u32>(), low in -9.0..9.0f64, width in 0.0..9.0f64,
    ) {
        let key = StreamKey { seed, sample, ..StreamKey::default() };
        for make in [&(|| Rng::new(seed)) as &dyn Fn() -> Rng, &|| Rng::keyed(key), &|| Rng::sobol(key, index)] {
            let (mut a, mut b) = (make(), make());
            for _ in 0..5 {
                let u = a.uniform();
                prop_assert!(u > 0.0 && u < 1.0 && u == b.uniform());
            }
            prop_assert_eq!((a.clone().bits(), a == b), (b.clone().bits(), true));
            let x = a.range(low, low + width);
            prop_assert!(x >= low && x <= low + width && x == low + (low + width - low) * b.uniform());
            let (mut c, mut d) = (a.clone(), a.clone());
            prop_assert!((c.normal(low, width) - (low + width * d.normal(0.0, 1.0))).abs() < 1e-13);
            let (mut c, mut d) = (a.clone(), a.clone());
            prop_assert_eq!(c.probability(0.3), d.uniform() < 0.3);
            prop_assert!(a.probability(1.0) && !a.probability(0.0));
        }
        let stratum = Stratum { cell: [(seed % 8) as u8, (sample % 4) as u8], bits: [3, 2] };
        let mut rng = Rng::keyed(key).confined_to(stratum);
        prop_assert_eq!((rng.uniform() * 8.0) as u8, stratum.cell[0]);
        prop_assert_eq!((rng.uniform() * 4.0) as u8, stratum.cell[1]);
    }
}
