//! Lengths of chords, from the smallest balls to the largest, from the middle to the limb.

use raysect::core::{Leaving, Node, Ray, Scratch, World};
use raysect::math::{Point3D, Rng, SphereSampler, Vector3D};
use raysect::primitive::Sphere;

use super::Cell;
use super::bodies::{self, Body, Shape};
use super::double_double::dd;
use super::exact::Plain;
use super::wrong::{Fault, Wrong};

/// Relative error of an ordinary chord.
const LIMIT: f64 = 1e-12;
/// How near to the limb, and the relative error there: a chord √(1 − b²) takes its rounding over 1 − b.
const GRAZING: [(f64, f64); 3] = [(1e-6, 1e-9), (1e-9, 1e-6), (1e-12, 1e-3)];

pub(crate) fn cells() -> Vec<Cell> {
    let mut cells = Vec::new();
    for exponent in -9..=0 {
        let radius = 10f64.powi(exponent);
        let name = format!("sphere 1e{exponent} m [relative]");
        cells.push(chord(name, sphere(radius), radius, 0.0..0.9, LIMIT));
        for (gap, limit) in GRAZING {
            let name = format!("sphere 1e{exponent} m, 1 − {gap:e} radii off [relative]");
            let core = exponent % 3 == 0;
            cells.push(chord(name, sphere(radius), radius, 1.0 - gap..1.0 - gap, limit).core(core));
        }
    }
    for size in [1e-9, 1e-6, 1e-3, 1.0] {
        for body in bodies::all(size) {
            let name = format!("{} {size:e} m, in two halves [ε size]", body.name);
            cells.push(halves(name, body).share(0.3).core(size == 1e-9));
        }
    }
    cells
}

pub(crate) fn controls() -> Vec<Cell> {
    // A start that is moved by 1 nm leaves this out of a ball of 1 mm.
    let radius = 1e-3;
    let shape: Shape = std::sync::Arc::new(Sphere::new(radius * (1.0 + 1e-9 / radius)).unwrap());
    let other = chord("sphere 1 nm larger".to_owned(), shape, radius, 0.0..0.9, LIMIT);
    let body = bodies::named("torus", 1.0);
    let wrong = body.with_shape(Wrong(body.shape.clone(), Fault::Shifts(1e-12)));
    let shape: Shape = std::sync::Arc::new(Sphere::new(radius * (1.0 + 1e-10)).unwrap());
    let (gap, limit) = GRAZING[0];
    let grazing =
        chord("sphere larger by 1e-10, grazing".to_owned(), shape, radius, 1.0 - gap..1.0 - gap, limit);
    vec![other, grazing, halves("torus 1e-12 off as seen from inside".to_owned(), wrong)]
}

fn sphere(radius: f64) -> Shape {
    Plain::Sphere(radius).shape()
}

/// From the entry to the exit, without a step off the surface.
fn chord(name: String, shape: Shape, radius: f64, offs: std::ops::Range<f64>, limit: f64) -> Cell {
    Cell::new(name, limit, move |rays, tally| {
        let mut world = World::<()>::new();
        world.add(Node::of(shape.clone(), ())).unwrap();
        let scene = world.scene().unwrap();
        let (mut rng, mut scratch) = (Rng::new(31), Scratch::default());
        for _ in 0..rays {
            let direction = SphereSampler.sample(&mut rng);
            let aside = direction.orthogonal().unwrap();
            let off = if offs.is_empty() { offs.start } else { rng.range(offs.start, offs.end) };
            let origin = Point3D::ORIGIN + aside * (off * radius) - direction * (2.0 * radius);
            let ray = Ray::new(origin, direction);
            tally.ray();
            let Some(entry) = scene.hit(&ray, None, &mut scratch) else {
                tally.fail(|| format!("missed: {ray:?}"));
                continue;
            };
            let surface = scene.finish(&ray, &entry);
            let leaving = Leaving::new(&surface, direction, direction, None);
            let onward = Ray::new(surface.point, direction);
            let Some(exit) = scene.hit(&onward, Some(&leaving), &mut scratch) else {
                tally.fail(|| format!("lost: {ray:?}"));
                continue;
            };
            let exact = Plain::Sphere(radius).crossings(&ray);
            let Some(length) = exact.get(1).map(|far| (*far - exact[0]).value()) else { continue };
            let error = (exit.crossing.distance / length - 1.0).abs();
            tally.error(error, || format!("{} m, not {length}: {ray:?}", exit.crossing.distance));
        }
    })
}

/// A chord seen from a point of it: what lies before and what lies behind make the whole that is seen from outside.
fn halves(name: String, body: Body) -> Cell {
    Cell::new(name, 64.0, move |rays, tally| {
        let mut rng = Rng::new(32);
        let (mut scratch, mut whole, mut part) = (Scratch::default(), Vec::new(), Vec::new());
        for _ in 0..rays {
            let direction = SphereSampler.sample(&mut rng);
            let shift = [0, 1, 2].map(|_| rng.range(-0.1, 0.1) * body.size);
            let middle = body.inside + Vector3D::from(shift);
            let outer = Ray::new(middle - direction * (3.0 * body.size), direction);
            whole.clear();
            part.clear();
            body.shape.crossings(&outer, &mut scratch, &mut whole);
            body.shape.crossings(&Ray::new(middle, direction), &mut scratch, &mut part);
            tally.ray();
            if whole.len() != part.len() {
                // Near a limb rounding decides; the restarts judge whether that is consistent.
                let grazes = whole.iter().chain(&part).any(|c| !is_clear(&body, &outer, c.distance));
                tally.check(grazes, || format!("{} and {} crossings: {outer:?}", whole.len(), part.len()));
                continue;
            }
            for (a, b) in whole.chunks(2).zip(part.chunks(2)) {
                let lengths = [a, b].map(|c| (dd(c[1].distance) - dd(c[0].distance)).value());
                let cosine = [&a[0], &a[1]]
                    .map(|c| body.shape.surface(&outer, c).normal.dot(direction).abs())
                    .into_iter()
                    .fold(1.0, f64::min);
                let error = (lengths[0] - lengths[1]).abs() * cosine / (f64::EPSILON * body.size);
                tally.error(error, || format!("{lengths:?} m: {outer:?}"));
            }
        }
    })
}

fn is_clear(body: &Body, ray: &Ray, t: f64) -> bool {
    body.outward(ray.point_at(t)).is_some_and(|n| n.dot(ray.direction).abs() > 1e-6)
}
