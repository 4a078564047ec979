//! The pieces of the hot path, one by one.

use criterion::{Criterion, criterion_group, criterion_main};
use raysect::core::{Interval, Primitive, Ray, Scratch};
use raysect::math::{Rng, StreamKey, solve_cubic, solve_quadratic, solve_quartic};
use raysect::optical::Path;
use raysect::prelude::*;
use std::hint::black_box;

fn shapes(c: &mut Criterion) {
    let (ball, block) = (Sphere::default(), Cuboid::default());
    let ray = Ray::new(Point3D::new(0.1, -0.2, -3.0), Vector3D::new(0.02, 0.05, 1.0));
    let mut scratch = Scratch::default();
    c.bench_function("sphere hit", |b| b.iter(|| ball.hit(black_box(&ray), Interval::AHEAD, &mut scratch)));
    c.bench_function("cuboid hit", |b| b.iter(|| block.hit(black_box(&ray), Interval::AHEAD, &mut scratch)));
}

fn random(c: &mut Criterion) {
    let mut sample = 0;
    c.bench_function("keyed stream and first number", |b| {
        b.iter(|| {
            sample += 1;
            Rng::keyed(StreamKey { sample, ..StreamKey::default() }).uniform()
        })
    });
}

fn roots(c: &mut Criterion) {
    let mut rng = Rng::new(1);
    let polynomials: Vec<[f64; 5]> = (0..1000).map(|_| [0; 5].map(|_| rng.range(-1.0, 1.0))).collect();
    let mut next = polynomials.iter().cycle();
    let mut draw = move || *next.next().unwrap_or(&[1.0, 0.0, 0.0, 0.0, -1.0]);
    c.bench_function("roots of a quadratic", |b| {
        b.iter(|| {
            let [p, q, r, ..] = draw();
            solve_quadratic(p, q, r)
        })
    });
    c.bench_function("roots of a cubic", |b| {
        b.iter(|| {
            let [p, q, r, s, _] = draw();
            solve_cubic(p, q, r, s)
        })
    });
    c.bench_function("roots of a quartic", |b| {
        b.iter(|| {
            let [p, q, r, s, t] = draw();
            solve_quartic(p, q, r, s, t)
        })
    });
}

fn scenes(c: &mut Criterion) {
    for count in [8usize, 100, 10_000] {
        let mut world = World::new();
        let mut rng = Rng::new(1);
        for _ in 0..count {
            let place = translate(rng.range(-5.0, 5.0), rng.range(-5.0, 5.0), rng.range(-5.0, 5.0));
            let size = 2.0 / (count as f64).cbrt();
            let Ok(ball) = Sphere::new(size) else { return };
            if world.add(ball.material(AbsorbingSurface).transform(place)).is_err() {
                return;
            }
        }
        let Ok(scene) = world.scene() else { return };
        let mut scratch = Scratch::default();
        c.bench_function(&format!("scene hit among {count} spheres"), |b| {
            b.iter(|| {
                let from = Point3D::new(rng.range(-5.0, 5.0), rng.range(-5.0, 5.0), -8.0);
                let to = Point3D::new(rng.range(-5.0, 5.0), rng.range(-5.0, 5.0), 8.0);
                scene.hit(&Ray::new(from, from.vector_to(to)), None, &mut scratch)
            })
        });
    }
}

fn paths(c: &mut Criterion) {
    let mut world = World::new();
    let built = Sphere::new(1.0).map(|s| world.add(s.material(Lambert::new(0.9))).is_ok());
    let slicing = raysect::optical::Slicing::new(375.0, 740.0, 15, 1);
    let (Ok(true), Ok(scene), Ok(slicing)) = (built, world.scene(), slicing) else { return };
    let (slices, settings) = (slicing.slices(), PathSettings::default());
    let mut path = Path::new(scene, &slices[0], &settings);
    let ray = Ray::default();
    let mut sample = 0;
    c.bench_function("path in a grey sphere, about 30 scatterings", |b| {
        b.iter(|| {
            sample += 1;
            path.follow(&ray, Rng::new(sample))[0]
        })
    });
}

criterion_group!(benches, shapes, random, roots, scenes, paths);
criterion_main!(benches);
