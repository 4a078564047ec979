//! Stretched, sheared and mirrored shapes: nothing is culled, places and normals are right, at every scale and for every
//! length of the direction.

use std::sync::Arc;

use raysect::core::{Interval, Node, Ray, Scratch, World};
use raysect::math::{AffineMatrix3D, Rng, SphereSampler, Vector3D, rotate, sampling, translate};

use super::bodies::{self, Body, map};
use super::double_double::dd;
use super::exact::{Line, Plain, Triple};
use super::wrong::{Fault, Wrong};
use super::{Cell, Tally};

/// Error of a normal, whose expected value is a difference over 1e-5 sizes.
const NORMAL: f64 = 1e-7;

fn maps() -> Vec<(&'static str, AffineMatrix3D)> {
    vec![
        ("twice as large", map([2.0, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0, 0.0, 2.0])),
        ("stretched by 3", map([1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 3.0])),
        ("mirrored", map([-1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0])),
        ("sheared", map([1.0, 0.25, -0.25], [0.5, 1.5, 0.125], [-0.25, 0.25, 0.75])),
        ("sheared and mirrored", map([1.0, 0.25, -0.25], [-0.5, -1.5, 0.5], [-0.25, 0.25, 0.75])),
        ("flattened to 1/1000", map([1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 0.0009765625])),
        (
            "turned and stretched",
            rotate(30.0, 40.0, 50.0) * map([1.0, 0.0, 0.0], [0.0, 4.0, 0.0], [0.0, 0.0, 0.5]),
        ),
        (
            "moved and sheared",
            translate(1.5, -2.0, 0.75) * map([1.0, 0.5, 0.0], [0.0, 1.0, 0.5], [0.5, 0.0, 1.0]),
        ),
    ]
}

pub(crate) fn cells() -> Vec<Cell> {
    let mut cells = Vec::new();
    for (name, m) in maps() {
        for (kind, plain) in Plain::all(1.0) {
            let share = if kind == "torus" { 0.03 } else { 0.3 };
            cells.push(places(format!("{kind} {name} [32 ε reach]"), plain, plain.shape(), m).share(share));
        }
        for body in bodies::all(1.0) {
            let title = format!("normals of {} {name} [1e-7]", body.name);
            cells.push(normals(title, body, m).share(0.1));
        }
    }
    for exponent in [-150, -100, -12, -6, -3, 3, 6, 12, 100, 150] {
        cells.push(inverse(exponent));
    }
    for exponent in [-12, -6, -3, 3, 6, 12] {
        let s = 10f64.powi(exponent);
        let m = map([s, 0.0, 0.0], [0.0, s, 0.0], [0.0, 0.0, s]);
        for (kind, plain) in Plain::all(1.0) {
            let share = if kind == "torus" { 0.03 } else { 0.3 };
            let name = format!("{kind} scaled by 1e{exponent} [32 ε reach]");
            cells.push(places(name, plain, plain.shape(), m).share(share).core(exponent.abs() == 6));
        }
    }
    cells.push(singular());
    for body in bodies::all(1.0) {
        let name = format!("{}, directions of lengths 1e-6 … 1e6 [64 ε reach]", body.name);
        cells.push(lengths(name, body).share(0.3));
    }
    cells
}

pub(crate) fn controls() -> Vec<Cell> {
    let (m, ball) = (maps()[1].1, Plain::Sphere(1.0));
    let shape = |fault: Fault| Arc::new(Wrong(ball.shape(), fault));
    let tilted = bodies::named("sphere", 1.0);
    let tilted = tilted.with_shape(Wrong(tilted.shape.clone(), Fault::Tilts(1e-6)));
    let missing = bodies::named("torus", 1.0);
    let missing = missing.with_shape(Wrong(missing.shape.clone(), Fault::Misses(100)));
    vec![
        places("bounds without the scale".to_owned(), ball, shape(Fault::Culls(0.8)), m),
        places("distances off by 1e-13".to_owned(), ball, shape(Fault::Stretches(1e-13)), m),
        normals("normals off by 1e-6".to_owned(), tilted, m),
        Cell::new("normals turned like vectors", NORMAL, move |rays, tally| {
            // Mᵀ n is along the normal in the space of the shape.
            let columns = [0, 1, 2].map(|i| m.axis(i));
            let like_vector =
                |n: Vector3D| (m * Vector3D::from(columns.map(|c| c.dot(n)))).normalise_unchecked();
            judge_normals(&bodies::named("cone", 1.0), &m, rays, tally, like_vector);
        }),
        lengths("one ray in 100 missed".to_owned(), missing),
    ]
}

/// The inverse of the linear part times a vector, and the ray in the space of the shape, in 32 digits: by Cramer's rule.
fn solve(m: &AffineMatrix3D, v: Triple) -> Triple {
    let column = |i: usize| m.axis(i).to_array().map(dd);
    let [x, y, z] = [0, 1, 2].map(column);
    let det = |a: Triple, b: Triple, c: Triple| {
        a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0])
            + a[2] * (b[0] * c[1] - b[1] * c[0])
    };
    let whole = det(x, y, z);
    [det(v, y, z) / whole, det(x, v, z) / whole, det(x, y, v) / whole]
}

/// Hits and crossings in a world against 32 digits in the space of the shape.
fn places(name: String, plain: Plain, shape: bodies::Shape, m: AffineMatrix3D) -> Cell {
    Cell::new(name, 1.0, move |rays, tally| {
        let mut world = World::<()>::new();
        world.add(Node::of(shape.clone(), ()).transform(m)).unwrap();
        // Others far away, for one or two shapes are tested without their boxes.
        for far in [-1e9, 1e9, 2e9] {
            let reach = far * norm(&m).max(1.0) * plain.size();
            world
                .add(Node::of(Plain::Sphere(plain.size()).shape(), ()).transform(translate(reach, 0.0, 0.0)))
                .unwrap();
        }
        let scene = world.scene().unwrap();
        let (mut rng, mut scratch) = (Rng::new(51), Scratch::default());
        for _ in 0..rays {
            // A line at the shape, then brought to the world and rounded there.
            let ideal = plain.aimed(3.0, &mut rng);
            let ray = Ray::new(m * ideal.origin, m * ideal.direction);
            let from = [0, 1, 2].map(|i| dd(ray.origin[i]) - dd(m.origin()[i]));
            let along = solve(&m, ray.direction.to_array().map(dd));
            let local = Line { from: solve(&m, from), along };
            tally.ray();
            let exact = plain.crossings_of(&local);
            let found = scene.crossings(&ray, &mut scratch);
            let ahead = exact.iter().filter(|t| **t >= dd(0.0)).count();
            let reach = 4.0 * plain.size() + m.origin().max_abs() / smallest(&m);
            if ahead != found.len() {
                let clear = !plain.is_near_limb(&ideal, 64.0 * f64::EPSILON * reach * condition(&m));
                tally.check(!clear, || format!("{} crossings, not {ahead}: {ray:?}", found.len()));
                continue;
            }
            let first = scene.hit(&ray, None, &mut scratch);
            tally.check(first == found.first().copied(), || format!("{first:?}, not {found:?}: {ray:?}"));
            for (hit, t) in found.iter().zip(exact.iter().filter(|t| **t >= dd(0.0))) {
                let cosine = plain.normal(&local, *t).dot(ideal.direction).abs();
                let off = (dd(hit.crossing.distance) - *t).value().abs() * cosine;
                let unit = 32.0 * f64::EPSILON * reach * condition(&m).max(1.0);
                tally.error(off / unit, || format!("{off:e} off at {hit:?}: {ray:?}"));
            }
        }
    })
}

fn norm(m: &AffineMatrix3D) -> f64 {
    (0..3).map(|i| (0..3).map(|j| m.get(i, j).abs()).sum::<f64>()).fold(0.0, f64::max)
}

fn smallest(m: &AffineMatrix3D) -> f64 {
    1.0 / norm(&m.inverse().unwrap())
}

fn condition(m: &AffineMatrix3D) -> f64 {
    norm(m) / smallest(m)
}

/// Normals in a world against differences of the depth on either side of the surface there.
fn normals(name: String, body: Body, m: AffineMatrix3D) -> Cell {
    Cell::new(name, NORMAL, move |rays, tally| judge_normals(&body, &m, rays, tally, |n| n))
}

fn judge_normals(
    body: &Body,
    m: &AffineMatrix3D,
    rays: u64,
    tally: &mut Tally,
    spoil: impl Fn(Vector3D) -> Vector3D,
) {
    let mut world = World::<()>::new();
    world.add(Node::of(body.shape.clone(), ()).transform(*m)).unwrap();
    let scene = world.scene().unwrap();
    let (mut rng, mut scratch) = (Rng::new(52), Scratch::default());
    let inverse = m.inverse().unwrap();
    let mut edges = 0;
    for _ in 0..rays {
        let axis = SphereSampler.sample(&mut rng);
        let p = sampling::disk::sample(sampling::uniforms(&mut rng));
        let x = axis.orthogonal().unwrap();
        let target = body.inside + (x * p.x + axis.cross(x) * p.y) * (0.8 * body.size);
        let ray = Ray::new(*m * (target - axis * (4.0 * body.size)), *m * axis);
        for hit in scene.crossings(&ray, &mut scratch) {
            let surface = scene.finish(&ray, &hit);
            tally.ray();
            let Some(local) = body.outward(inverse * surface.point) else {
                edges += 1;
                continue;
            };
            // Outward along the gradient of depth(M⁻¹ p): its components are slopes along the axes of the world.
            let gradient = [Vector3D::X, Vector3D::Y, Vector3D::Z].map(|e| local.dot(inverse * e));
            let expected = Vector3D::from(gradient).normalise_unchecked();
            let normal = spoil(surface.normal.as_vector());
            let exiting = normal.dot(ray.direction) > 0.0;
            tally.error((normal - expected).length(), || format!("{normal:?}, not {expected:?}: {ray:?}"));
            tally.check(surface.exiting == exiting, || format!("wrong kind {surface:?}: {ray:?}"));
        }
    }
    // Edges are lines: hardly anything lies on them.
    let rays = tally.rays;
    tally.check(20 * edges <= rays.max(200), || format!("{edges} of {rays} near edges"));
}

/// A scale and a rotation, there and back, to four roundings.
fn inverse(exponent: i32) -> Cell {
    Cell::new(format!("inverse of a scale of 1e{exponent} [4 ε]"), 1.0, move |_, tally| {
        let mut rng = Rng::new(53);
        for _ in 0..100 {
            let s = 10f64.powi(exponent) * rng.range(0.5, 2.0);
            let stretched = map([s, 0.0, 0.0], [0.0, s, 0.0], [0.0, 0.0, s]);
            tally.ray();
            let Ok(back) = stretched.inverse() else {
                tally.fail(|| format!("{s:e} has no inverse"));
                continue;
            };
            let product = stretched * back;
            let error = (0..3)
                .flat_map(|i| (0..3).map(move |j| (i, j)))
                .map(|(i, j)| (product.get(i, j) - if i == j { 1.0 } else { 0.0 }).abs())
                .fold(0.0, f64::max);
            tally.error(error / (4.0 * f64::EPSILON), || format!("{s:e}: {product:?}"));
        }
    })
}

/// Maps of rank 2 are refused at every scale.
fn singular() -> Cell {
    Cell::new("maps without inverse are refused", 0.0, |_, tally| {
        for s in [1e-150, 1e-12, 1.0, 1e12, 1e150] {
            for flat in [
                map([s, 0.0, 0.0], [0.0, s, 0.0], [0.0; 3]),
                map([s, s, 0.0], [2.0 * s, 2.0 * s, 0.0], [0.0, 0.0, s]),
                map([s, 2.0 * s, 3.0 * s], [4.0 * s, 5.0 * s, 6.0 * s], [7.0 * s, 8.0 * s, 9.0 * s]),
            ] {
                tally.ray();
                tally.check(flat.inverse().is_err(), || format!("{flat:?} has an inverse"));
            }
        }
    })
}

/// Places do not depend on the length of the direction.
fn lengths(name: String, body: Body) -> Cell {
    Cell::new(name, 1.0, move |rays, tally| {
        let (mut rng, mut scratch) = (Rng::new(54), Scratch::default());
        let (mut unit, mut long) = (Vec::new(), Vec::new());
        for _ in 0..rays {
            let direction = SphereSampler.sample(&mut rng);
            let shift = Vector3D::from([0, 1, 2].map(|_| rng.range(-0.6, 0.6) * body.size));
            let ray = Ray::new(body.inside + shift - direction * (3.0 * body.size), direction);
            let factor = 10f64.powf(rng.range(-6.0, 6.0));
            let other = Ray::new(ray.origin, direction * factor);
            unit.clear();
            long.clear();
            body.shape.crossings(&ray, &mut scratch, &mut unit);
            body.shape.crossings(&other, &mut scratch, &mut long);
            tally.ray();
            // The true shape tells by its depth whether the difference is one of a graze.
            if unit.len() != long.len() {
                let more = if unit.len() > long.len() { (&unit, 1.0) } else { (&long, factor) };
                let close = more.0.windows(2).any(|w| {
                    let middle = ray.point_at(0.5 * (w[0].distance + w[1].distance) * more.1);
                    body.depth(middle).abs() < 64.0 * f64::EPSILON * 4.0 * body.size
                });
                tally.check(close, || format!("{unit:?} and {long:?}: {ray:?} × {factor}"));
                continue;
            }
            for (a, b) in unit.iter().zip(&long) {
                let cosine = body.shape.surface(&ray, a).normal.dot(direction).abs();
                let off = (a.distance - b.distance * factor).abs() * cosine;
                let limit = 64.0 * f64::EPSILON * 4.0 * body.size;
                tally.error(off / limit, || format!("{a:?} and {b:?}: {ray:?} × {factor}"));
            }
            let hit = body.shape.hit(&other, Interval::AHEAD, &mut scratch);
            let first = long.iter().find(|c| c.distance >= 0.0);
            tally.check(hit.map(|c| c.distance) == first.map(|c| c.distance), || {
                format!("{hit:?}: {other:?}")
            });
        }
    })
}
