//! Judges of lenses: the contract, the composite of spheres and cylinder that each one is, integral geometry, restarts.

use std::sync::Arc;

use raysect_core::testing::check_primitive;
use raysect_core::{BoundingBox3D, Crossing, Departure, Leaving, Node, Primitive, Ray, Scratch, World};
use raysect_math::{
    AffineMatrix3D, Point3D, Rng, SphereSampler, Statistics, Vector3D, rotate, sampling, translate,
};

use super::*;
use crate::{Cylinder, Intersect, Place, PrimitiveError, Sphere, Subtract, Union};

type Shape = Arc<dyn Primitive>;

/// A lens with what it must be: composed of balls and a cylinder, its volume and area in textbook form.
struct Subject {
    name: &'static str,
    lens: Shape,
    composite: Shape,
    volume: f64,
    area: f64,
    /// Its own.
    claimed: [f64; 2],
}

/// Of `scale` metres diameter: strong and weak, with sharp edges, and hemispheres.
fn subjects(scale: f64) -> Vec<Subject> {
    use std::f64::consts::PI;
    let (d, h) = (scale, 0.5 * scale);
    let sag = |r: f64| r - (r * r - h * h).sqrt();
    let cap = |s: f64| PI * s * s * (3.0 * (s * s + h * h) / (2.0 * s) - s) / 3.0;
    let skin = |r: f64| 2.0 * PI * r * sag(r);
    let ball = |r: f64, z: f64| Sphere::new(r).unwrap().placed(translate(0.0, 0.0, z));
    let rod = |low: f64, high: f64| Cylinder::new(h, high - low).unwrap().placed(translate(0.0, 0.0, low));
    let disc = PI * h * h;
    let mut all: Vec<Subject> = Vec::new();
    let mut add = |name, lens: Shape, composite: Shape, [volume, area]: [f64; 2], claimed| {
        all.push(Subject { name, lens, composite, volume, area, claimed });
    };
    for (name, t, f, b) in
        [("biconvex", 0.5, 0.9, 0.7), ("sharp", sag(0.9 * d) / d + sag(0.7 * d) / d, 0.9, 0.7)]
    {
        let (t, f, b) = (t * d, f * d, b * d);
        let lens = BiConvex::new(d, t, f, b).unwrap();
        let composite = Intersect::new(Intersect::new(ball(f, t - f), ball(b, b)).unwrap(), rod(-t, 2.0 * t));
        let edge = t - sag(f) - sag(b);
        assert!((lens.edge_thickness() - edge).abs() < 1e-15 * d);
        assert_eq!((lens.front_curvature(), lens.back_curvature()), (f, b));
        let exact = [disc * edge + cap(sag(f)) + cap(sag(b)), 2.0 * PI * h * edge + skin(f) + skin(b)];
        let claimed = [lens.volume(), lens.surface_area()];
        add(name, Arc::new(lens), Arc::new(composite.unwrap()), exact, claimed);
    }
    let (t, f, b) = (0.1 * d, 0.9 * d, 0.7 * d);
    let lens = BiConcave::new(d, t, f, b).unwrap();
    let blank = Subtract::new(rod(-sag(b), t + sag(f)), ball(f, t + f)).unwrap();
    let edge = t + sag(f) + sag(b);
    let exact = [disc * edge - cap(sag(f)) - cap(sag(b)), 2.0 * PI * h * edge + skin(f) + skin(b)];
    let claimed = [lens.volume(), lens.surface_area()];
    assert!((lens.back_thickness() - sag(b)).abs() < 1e-15 * d && lens.diameter() == d);
    add("biconcave", Arc::new(lens), Arc::new(Subtract::new(blank, ball(b, -b)).unwrap()), exact, claimed);
    for (name, t, r) in [("planoconvex", 0.4, 0.6), ("dome", 0.7, 0.5)] {
        let (t, r) = (t * d, r * d);
        let lens = PlanoConvex::new(d, t, r).unwrap();
        let edge = t - sag(r);
        // The ball alone would not reach the back of a thick lens.
        let inside: Shape = if t > r {
            Arc::new(Union::new(ball(r, t - r), rod(0.0, t - r)).unwrap())
        } else {
            Arc::new(Intersect::new(ball(r, t - r), rod(-d, 2.0 * d)).unwrap())
        };
        let composite = Intersect::new(inside, rod(0.0, 2.0 * t)).unwrap();
        let exact = [disc * edge + cap(sag(r)), 2.0 * PI * h * edge + skin(r) + disc];
        let claimed = [lens.volume(), lens.surface_area()];
        assert!((lens.curve_thickness() - sag(r)).abs() < 1e-15 * d && lens.centre_thickness() == t);
        add(name, Arc::new(lens), Arc::new(composite), exact, claimed);
    }
    let (t, r) = (0.2 * d, 0.8 * d);
    let lens = PlanoConcave::new(d, t, r).unwrap();
    let edge = t + sag(r);
    let composite = Subtract::new(rod(0.0, edge), ball(r, t + r)).unwrap();
    let exact = [disc * edge - cap(sag(r)), 2.0 * PI * h * edge + skin(r) + disc];
    let claimed = [lens.volume(), lens.surface_area()];
    add("planoconcave", Arc::new(lens), Arc::new(composite), exact, claimed);
    let pointed = sag(0.6 * d) / d - sag(0.9 * d) / d;
    for (name, t, f, b) in
        [("meniscus", 0.2, 0.9, 0.6), ("positive", 0.2, 0.6, 0.9), ("crescent", pointed, 0.6, 0.9)]
    {
        let (t, f, b) = (t * d, f * d, b * d);
        let lens = Meniscus::new(d, t, f, b).unwrap();
        let edge = t - sag(f) + sag(b);
        let blank = Intersect::new(ball(f, t - f), rod(-sag(b), 2.0 * t)).unwrap();
        let composite = Subtract::new(blank, ball(b, -b)).unwrap();
        let exact = [disc * edge + cap(sag(f)) - cap(sag(b)), 2.0 * PI * h * edge + skin(f) + skin(b)];
        let claimed = [lens.volume(), lens.surface_area()];
        add(name, Arc::new(lens), Arc::new(composite), exact, claimed);
    }
    all
}

fn crossings(shape: &dyn Primitive, ray: &Ray) -> Vec<Crossing> {
    let mut out = Vec::new();
    shape.crossings(ray, &mut Scratch::default(), &mut out);
    out
}

fn line(scale: f64, rng: &mut Rng) -> Ray {
    let aim = SphereSampler.sample(rng) * (0.7 * scale * rng.uniform().cbrt());
    let direction = SphereSampler.sample(rng);
    let start = Point3D::new(0.0, 0.0, 0.1 * scale) + aim - direction * (scale * rng.range(1.0, 10.0));
    Ray::new(start, direction * 10f64.powf(rng.range(-2.0, 2.0)))
}

#[test]
fn keeps_the_contract() {
    for scale in [1e-9, 0.05, 1.0, 1e9] {
        for s in subjects(scale) {
            check_primitive(&s.lens, 3000, 1).unwrap_or_else(|what| panic!("{} of {scale}: {what}", s.name));
        }
    }
    // All but flat.
    let weak = [
        Arc::new(BiConvex::new(1.0, 0.2, 1e9, 1e30).unwrap()) as Shape,
        Arc::new(Meniscus::new(1.0, 0.2, 1e5, 1e99).unwrap()),
        Arc::new(BiConcave::new(1.0, 0.2, 1e7, 1e13).unwrap()),
    ];
    for lens in weak {
        check_primitive(&lens, 3000, 2).unwrap();
    }
}

/// How many lines cross a lens otherwise than a composite, of so many that hit.
fn differences(lens: &Shape, composite: &Shape, scale: f64, rng: &mut Rng) -> (usize, usize) {
    let (mut different, mut hits) = (0, 0);
    for _ in 0..10_000 {
        let ray = line(scale, rng);
        let (a, b) = (crossings(lens, &ray), crossings(composite, &ray));
        let alike = |(x, y): (&Crossing, &Crossing)| {
            let (p, q) = (lens.surface(&ray, x), composite.surface(&ray, y));
            let cosine = p.normal.dot(ray.direction).abs().min(q.normal.dot(ray.direction).abs());
            let across = (x.distance - y.distance).abs() * cosine;
            let turned = (p.normal.as_vector() - q.normal.as_vector()).length();
            x.exiting == y.exiting
                && across <= 1e-14 * 20.0 * scale
                && turned * cosine < 1e-12 * ray.direction.length()
        };
        different += usize::from(a.len() != b.len() || !a.iter().zip(&b).all(alike));
        hits += usize::from(!a.is_empty());
        let p = ray.point_at(rng.range(0.0, 12.0) * scale / ray.direction.length());
        assert_eq!(lens.contains(p), composite.contains(p), "{p:?}");
    }
    (different, hits)
}

#[test]
fn lenses_are_balls_and_cylinders() {
    let mut rng = Rng::new(2);
    for scale in [1e-6, 0.05, 1e3] {
        for s in subjects(scale) {
            let (different, hits) = differences(&s.lens, &s.composite, scale, &mut rng);
            assert!(different == 0 && hits > 1000, "{} of {scale}: {different} of {hits}", s.name);
        }
    }
    let all = subjects(1.0);
    let grown: Shape = Arc::new(BiConvex::new(1.0, 0.5, 0.9 * (1.0 + 1e-11), 0.7).unwrap());
    assert!(differences(&grown, &all[0].composite, 1.0, &mut rng).0 > 100);
}

#[test]
fn faces_are_named() {
    let lens = BiConcave::new(2.0, 0.4, 2.0, 3.0).unwrap();
    let faces = |lens: &BiConcave, from: [f64; 3], towards: [f64; 3]| -> Vec<_> {
        let all = crossings(lens, &Ray::new(from.into(), towards.into()));
        all.iter().map(|c| LensFace::of(&c.feature).unwrap()).collect()
    };
    use LensFace::{Back, Barrel, Front};
    assert_eq!(faces(&lens, [0.1, 0.2, 3.0], [0.0, 0.0, -1.0]), [Front, Back]);
    assert_eq!(faces(&lens, [-3.0, 0.1, 0.2], [1.0, 0.0, 0.0]), [Barrel, Barrel]);
    assert_eq!(faces(&lens, [-3.0, 0.1, 0.5], [1.0, 0.0, 0.0]), [Barrel, Front, Front, Barrel]);
    let lens = BiConcave::new(2.0, 0.01, 2.0, 3.0).unwrap();
    let wavy = [-3.0, 0.0, -0.36];
    assert_eq!(faces(&lens, wavy, [1.0, 0.0, 0.12]), [Barrel, Back, Back, Front, Front, Barrel]);
    assert_eq!(LensFace::of(&raysect_core::Feature { face: 3, ..Default::default() }), None);
}

/// Volume over area from the mean chord of an isotropic, uniform field of lines, in standard errors (A. Cauchy 1841).
fn chord_score(shape: &Shape, volume: f64, area: f64) -> f64 {
    let mut rng = Rng::new(3);
    let mut ratio = Statistics::new();
    for _ in 0..200 {
        let (mut inside, mut pairs) = (0.0, 0.0);
        for _ in 0..1000 {
            let axis = SphereSampler.sample(&mut rng);
            let x = axis.orthogonal().unwrap();
            let p = sampling::disk::sample(sampling::uniforms(&mut rng));
            let start = Point3D::new(0.0, 0.0, 0.2) + (x * p.x + axis.cross(x) * p.y) * 0.8 - axis * 3.0;
            let all = crossings(shape, &Ray::new(start, axis));
            inside += all.chunks(2).map(|pair| pair[1].distance - pair[0].distance).sum::<f64>();
            pairs += all.len() as f64 / 2.0;
        }
        ratio.add(inside / pairs - 4.0 * volume / area);
    }
    ratio.mean() / ratio.error()
}

#[test]
fn volumes_and_areas_are_right() {
    for s in subjects(1.0) {
        for (claimed, exact) in s.claimed.into_iter().zip([s.volume, s.area]) {
            assert!((claimed / exact - 1.0).abs() < 1e-13, "{}: {claimed} {exact}", s.name);
        }
        let score = chord_score(&s.lens, s.volume, s.area);
        assert!(score.abs() < 4.0, "{}: {score}", s.name);
        assert!(chord_score(&s.lens, s.volume, 1.05 * s.area).abs() > 4.0, "{}", s.name);
    }
}

#[test]
fn bounds_are_tight_around_sheared_images() {
    let shear = AffineMatrix3D::from_axes(
        Vector3D::new(3.0, 0.0, 0.4),
        Vector3D::new(0.5, 0.2, 0.0),
        Vector3D::new(-1.0, 0.3, 2.0),
        Point3D::new(5.0, 6.0, 7.0),
    );
    for m in [AffineMatrix3D::IDENTITY, rotate(20.0, 70.0, 10.0), shear, rotate(0.0, 0.0, 33.0) * shear] {
        for s in subjects(1.0) {
            let (image, ball) = (s.lens.bounding_box(&m), s.lens.bounding_sphere(&m));
            let mut least = BoundingBox3D::EMPTY;
            let mut rng = Rng::new(4);
            let back = m.inverse().unwrap();
            for index in 0..60_000 {
                let mut ray = line(1.0, &mut rng);
                if index % 2 == 0 {
                    // Down the axis onto the vertices, and across onto the rims.
                    let (x, y) = (rng.range(-0.5, 0.5), rng.range(-0.5, 0.5));
                    ray = Ray::new(Point3D::new(x, y, 4.0), -Vector3D::Z);
                }
                for c in crossings(&s.lens, &ray) {
                    let p = m * s.lens.surface(&ray, &c).point;
                    assert!(image.contains(p) && ball.contains(p), "{}: {p:?}", s.name);
                    least.extend(p, 0.0);
                }
            }
            // Points of greatest reach, by search from the best of random ones: along the image of each axis.
            for axis in 0..3 {
                let span = image.extent(axis);
                let loose =
                    (least.lower[axis] - image.lower[axis]).max(image.upper[axis] - least.upper[axis]);
                assert!(loose <= 0.02 * span, "{}: axis {axis} is loose by {}", s.name, loose / span);
            }
            assert!((back * ball.centre).is_finite());
        }
    }
}

#[test]
fn impossible_lenses_are_named() {
    let message = |result: Result<(), PrimitiveError>| result.unwrap_err().to_string();
    for bad in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert!(message(BiConvex::new(bad, 0.1, 9.0, 9.0).map(|_| ())).contains("diameter"));
        assert!(message(BiConcave::new(1.0, bad, 9.0, 9.0).map(|_| ())).contains("centre thickness"));
        assert!(message(Meniscus::new(1.0, 0.1, bad, 9.0).map(|_| ())).contains("front curvature"));
        assert!(message(Meniscus::new(1.0, 0.1, 9.0, bad).map(|_| ())).contains("back curvature"));
        assert!(PlanoConvex::new(1.0, 0.1, bad).is_err() && PlanoConcave::new(1.0, 0.1, bad).is_err());
    }
    assert!(message(PlanoConcave::new(2.0, 0.1, 0.99).map(|_| ())).contains("half the diameter"));
    assert!(PlanoConcave::new(2.0, 0.1, 1.0).is_ok());
    let sharp = message(BiConvex::new(2.0, 0.9, 1.0, 2.0).map(|_| ()));
    assert!(sharp.contains("edge thickness = -0.36"), "{sharp}");
    assert!(PlanoConvex::new(2.0, 0.9, 1.0).is_err() && PlanoConvex::new(2.0, 1.0, 1.0).is_ok());
    assert!(Meniscus::new(2.0, 0.5, 1.0, 3.0).is_err());
}

/// How many of so many rays that wander in a lens in a world, reflected at its faces, are lost.
fn lost(lens: &Shape, size: f64, rng: &mut Rng) -> usize {
    let mut world = World::<()>::new();
    let place = translate(2.0 * size, -size, 3.0 * size) * rotate(31.0, -64.0, 12.0);
    world.add(Node::of(lens.clone(), ()).transform(place)).unwrap();
    let scene = world.scene().unwrap();
    let mut scratch = Scratch::default();
    let (mut lost, mut done) = (0, 0);
    while done < 10_000 {
        let local = line(size, rng);
        let mut ray = Ray::new(place * local.origin, (place * local.direction).normalise().unwrap());
        let Some(hit) = scene.hit(&ray, None, &mut scratch) else { continue };
        let mut surface = scene.finish(&ray, &hit);
        let mut leaving = None;
        for _ in 0..20 {
            done += 1;
            let inward = SphereSampler.sample(rng) * (1.0 - 1e-6) - surface.normal.as_vector();
            let towards = inward.normalise().unwrap();
            let next = Leaving::new(&surface, ray.direction, towards, leaving.as_ref());
            ray = Ray::new(surface.point, towards);
            let Some(hit) = scene.hit(&ray, Some(&next), &mut scratch) else {
                lost += 1;
                break;
            };
            surface = scene.finish(&ray, &hit);
            leaving = Some(next);
            let off = ray.point_at(hit.crossing.distance).distance_to(surface.point);
            let cosine = surface.normal.dot(ray.direction).abs().max(1e-3);
            lost += usize::from(!surface.exiting || off > (surface.bound + 1e-13 * size) / cosine);
        }
    }
    lost
}

#[test]
fn rays_that_are_reflected_inside_lose_nothing() {
    let mut rng = Rng::new(5);
    for size in [1e-9, 1e-3, 1.0, 1e3, 1e9] {
        for s in subjects(size) {
            assert_eq!(lost(&s.lens, size, &mut rng), 0, "{} of {size}", s.name);
        }
    }
}

#[test]
fn a_ray_in_the_edge_of_a_crescent_leaves_at_once() {
    let subject = subjects(1.0).pop().unwrap();
    let (lens, mut rng) = (subject.lens, Rng::new(6));
    for _ in 0..2000 {
        // A point of the front surface nearer to the edge than rounding knows.
        let rho = 0.5 * (1.0 - 10f64.powf(rng.range(-18.0, -13.0)));
        let z = lens.bounding_box(&AffineMatrix3D::IDENTITY).lower.z;
        let start = Ray::new(Point3D::new(rho, 0.0, z), Vector3D::new(rng.range(-0.3, 0.0), 0.0, -1.0));
        let departure = Departure { inward: true, bound: 1e-13, feature: Default::default() };
        let next = lens.hit_after(&start, &departure, f64::INFINITY, &mut Scratch::default());
        assert!(next.is_some_and(|n| n.exiting && n.distance <= 1e-12), "{start:?} {next:?}");
    }
}
