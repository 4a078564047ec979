use raysect_core::testing::check_primitive;
use raysect_core::{BoundingBox3D, World};
use raysect_math::{MathError, Statistics, sampling};

use super::*;
use crate::PrimitiveError;

#[test]
fn keeps_the_contract() {
    for (name, body) in bodies() {
        check_primitive(&body, 3000, 7).unwrap_or_else(|what| panic!("{name}: {what}"));
    }
}

#[test]
fn leaves_are_numbered_through() {
    let drilled = drilled();
    assert_eq!((drilled.parts(), drilled.is_convex()), (5, false));
    // Through the wall beside the hole along z, then into the hole along y.
    let ray = Ray::new(Point3D::new(1.1, -9.0, 0.9), Vector3D::Y);
    let parts: Vec<_> = crossings(&drilled, &ray).iter().map(|c| c.feature.part).collect();
    assert_eq!(parts, [0, 3, 3, 0]);
    let ray = Ray::new(Point3D::new(-9.0, 1.2, 1.1), Vector3D::X);
    let parts: Vec<_> = crossings(&drilled, &ray).iter().map(|c| c.feature.part).collect();
    assert_eq!(parts, [0, 0]);
}

#[test]
fn walls_of_a_hole_face_inward() {
    let ring = subtract(&share(Sphere::new(1.0).unwrap()), &share(Sphere::new(0.5).unwrap()));
    let ray = Ray::new(Point3D::new(0.0, 0.0, -3.0), Vector3D::Z);
    let all = crossings(&ring, &ray);
    let seen: Vec<_> = all
        .iter()
        .map(|c| (c.distance, c.exiting, c.feature.part, ring.surface(&ray, c).normal.as_vector().z))
        .collect();
    assert_eq!(
        seen,
        [(2.0, false, 0, -1.0), (2.5, true, 1, 1.0), (3.5, false, 1, -1.0), (4.0, true, 0, 1.0)]
    );
}

#[test]
fn bounds_on_errors_know_the_place_of_operands() {
    let mut rng = Rng::new(10);
    for (radius, far) in [(1.0, 1e6), (1.0, 0.0), (1e-3, 1e3), (1e6, 1.0)] {
        let centre = Vector3D::new(0.6, -0.48, 0.64) * far;
        let ball = share(Sphere::new(radius).unwrap());
        let placed = share(
            Union::new(ball.placed(translate(centre.x, centre.y, centre.z)), Sphere::default()).unwrap(),
        );
        for _ in 0..1000 {
            let ray = line_through(Point3D::ORIGIN + centre, radius, &mut rng);
            for c in crossings(&*placed, &ray).iter().filter(|c| c.feature.part == 0) {
                let surface = placed.surface(&ray, c);
                let off = (surface.point - centre).to_vector().length() - radius;
                assert!(off.abs() <= surface.bound, "{off} {surface:?}");
                assert!(surface.bound <= 200.0 * f64::EPSILON * (radius + far), "{surface:?}");
            }
        }
    }
}

#[test]
fn a_body_that_is_nothing_is_never_hit() {
    let ball = share(Sphere::new(1.0).unwrap());
    let nothing = [
        subtract(&ball, &cuboid([-2.0; 3], [2.0; 3])),
        intersect(&ball, &moved(&ball, translate(5.0, 0.0, 0.0))),
        intersect(&cuboid([-1.0; 3], [1.0; 3]), &cuboid([1.0, -1.0, -1.0], [2.0, 1.0, 1.0])),
    ];
    for count in [1, 9] {
        let mut world = World::<()>::new();
        for body in nothing.iter().cycle().take(3 * count) {
            world.add(body.clone()).unwrap();
        }
        let mut rng = Rng::new(8);
        for _ in 0..1000 {
            let ray = line_through(Point3D::ORIGIN, 2.0, &mut rng);
            assert!(world.hit(&ray).unwrap().is_none());
        }
        // And as operands.
        assert!(
            crossings(&*subtract(&nothing[1], &ball), &line_through(Point3D::ORIGIN, 1.0, &mut rng))
                .is_empty()
        );
        let same = union(&nothing[1], &ball);
        assert_eq!(same.bounding_box(&shear()), ball.bounding_box(&shear()));
    }
}

#[test]
fn open_and_flattened_operands_are_refused() {
    let (sheet, ball) = (Cuboid::centred(1.0, 1.0, 0.0).unwrap(), Sphere::default());
    let open = PrimitiveError::OpenOperand { shape: "union", position: "second", operand: "Cuboid" };
    assert_eq!(Union::new(ball, sheet).unwrap_err(), open);
    assert!(Subtract::new(sheet.placed(scale(2.0)), ball).is_err());
    let flat = Intersect::new(ball, ball.placed(stretch(1.0, 0.0, 1.0))).unwrap_err();
    let source = MathError::Singular;
    assert_eq!(flat, PrimitiveError::OperandTransform { shape: "intersect", position: "second", source });
    assert!(flat.to_string().contains("second operand"), "{flat}");
}

#[test]
fn boxes_are_tight() {
    let a = Cuboid::centred(2.0, 2.0, 2.0).unwrap();
    let m = rotate(25.0, 40.0, -10.0);
    let near = |b: BoundingBox3D, c: BoundingBox3D| {
        (0..3).all(|i| {
            (b.lower[i] - c.lower[i]).abs() < 1e-11
                && (b.upper[i] - c.upper[i]).abs() < 1e-11
                && b.lower[i] <= c.lower[i]
                && b.upper[i] >= c.upper[i]
        })
    };
    let common = Cuboid::new([0.4, 0.2, -1.0].into(), [1.0, 1.0, 0.7].into()).unwrap();
    let other = Cuboid::new([0.4, 0.2, -3.0].into(), [4.0, 4.0, 0.7].into()).unwrap();
    let corner = Intersect::new(a, other).unwrap();
    for m in [AffineMatrix3D::IDENTITY, m, shear()] {
        assert!(near(corner.bounding_box(&m), common.bounding_box(&m)), "{m:?}");
        let without = Subtract::new(a, other).unwrap();
        assert_eq!(without.bounding_box(&m), a.bounding_box(&m));
        let both = Union::new(a, other).unwrap().bounding_box(&m);
        assert_eq!(both, a.bounding_box(&m).union(&other.bounding_box(&m)));
    }
    let nothing = Intersect::new(a, a.placed(translate(5.0, 0.0, 0.0))).unwrap();
    assert!(nothing.bounding_box(&m).is_empty());
    let ball = Sphere::new(2.0).unwrap();
    let sphere = Subtract::new(ball, a).unwrap().bounding_sphere(&m);
    assert!((sphere.radius - 2.0).abs() < 1e-8);
    let corners = Intersect::new(a, ball).unwrap().bounding_sphere(&AffineMatrix3D::IDENTITY);
    assert!((corners.radius - 3f64.sqrt()).abs() < 1e-5);
}

/// Mean chord of an isotropic, uniform field of lines through a ball around the body, in standard errors from 4 V/S
/// (A. Cauchy 1841; a chord of a body that is not convex is the whole length of the line inside it, and the surface
/// counts each pair of crossings: lines that cross 2 n times count n times).
fn chord_score(body: &Shape, radius: f64, volume: f64, area: f64) -> f64 {
    let mut rng = Rng::new(3);
    let (mut length, mut pairs) = (Statistics::new(), Statistics::new());
    let mut ratio = Statistics::new();
    for _ in 0..200 {
        let (mut inside, mut crossed) = (0.0, 0.0);
        for _ in 0..1000 {
            let axis = SphereSampler.sample(&mut rng);
            let x = axis.orthogonal().unwrap();
            let p = sampling::disk::sample(sampling::uniforms(&mut rng));
            let start = Point3D::ORIGIN + (x * p.x + axis.cross(x) * p.y) * radius - axis * (3.0 * radius);
            let all = crossings(body, &Ray::new(start, axis));
            inside += all.chunks(2).map(|pair| pair[1].distance - pair[0].distance).sum::<f64>();
            crossed += all.len() as f64 / 2.0;
        }
        length.add(inside);
        pairs.add(crossed);
        ratio.add(inside / crossed - 4.0 * volume / area);
    }
    ratio.mean() / ratio.error()
}

#[test]
fn mean_chords_are_four_volumes_over_the_surface() {
    use std::f64::consts::PI;
    let ball = |r: f64| share(Sphere::new(r).unwrap());
    let (r, h) = (0.4, 1.0);
    let hollow = subtract(&cuboid([-0.5; 3], [0.5; 3]), &ball(r));
    let (volume, area) = (1.0 - 4.0 / 3.0 * PI * r.powi(3), 6.0 + 4.0 * PI * r * r);
    let score = chord_score(&hollow, 0.9, volume, area);
    assert!(score.abs() < 4.0, "{score}");
    assert!(chord_score(&hollow, 0.9, volume, 1.03 * area).abs() > 4.0);
    // A cube with a hole drilled through, and two balls that have a lens in common.
    let rod = share(Cylinder::new(r, 2.0).unwrap());
    let drilled = subtract(&cuboid([-0.5; 3], [0.5; 3]), &moved(&rod, translate(0.0, 0.0, -1.0)));
    let (volume, area) = (1.0 - PI * r * r * h, 6.0 - 2.0 * PI * r * r + 2.0 * PI * r * h);
    assert!(chord_score(&drilled, 0.9, volume, area).abs() < 4.0);
    let sag = 0.3;
    let (cap, rim) = (PI * sag * sag * (3.0 - sag) / 3.0, 2.0 * PI * sag);
    let pair = [translate(0.0, 0.0, sag - 1.0), translate(0.0, 0.0, 1.0 - sag)].map(|m| moved(&ball(1.0), m));
    assert!(chord_score(&intersect(&pair[0], &pair[1]), 1.0, 2.0 * cap, 2.0 * rim).abs() < 4.0);
    let volume = 2.0 * (4.0 / 3.0 * PI - cap);
    assert!(chord_score(&union(&pair[0], &pair[1]), 1.8, volume, 2.0 * (4.0 * PI - rim)).abs() < 4.0);
}
