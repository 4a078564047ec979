//! What must not change: under motions, scales and units, in another order, as a composite of itself, in pieces, as a mesh,
//! as an instance.

use std::sync::Arc;

use raysect::core::{Crossing, Node, Primitive, Ray, Scratch, World};
use raysect::math::{AffineMatrix3D, Point3D, Rng, SphereSampler, Vector3D, rotate, translate};
use raysect::primitive::{Cuboid, Cylinder, Intersect, Mesh, MeshData, Place, Sphere, Subtract, Union};

use super::bodies::{self, Body, Shape, map};
use super::wrong::{Fault, Wrong};
use super::{Cell, Tally};

/// Two descriptions of one thing, and lines for each: the second distance times `unit` must be the first.
struct Twins {
    first: Shape,
    second: Shape,
    /// From the space of the first to that of the second.
    between: AffineMatrix3D,
    unit: f64,
    /// Greatest coordinate that enters, in sizes.
    reach: f64,
}

pub(crate) fn cells() -> Vec<Cell> {
    let mut cells = Vec::new();
    for name in bodies::all(1.0).iter().map(|b| b.name) {
        let body = bodies::named(name, 1.0);
        let shape = body.shape.clone();
        let whole = |second: Shape| Twins {
            first: shape.clone(),
            second,
            between: AffineMatrix3D::IDENTITY,
            unit: 1.0,
            reach: 4.0,
        };
        let far = Sphere::new(0.5).unwrap().placed(translate(30.0, 0.0, 0.0));
        let scaled = |s: f64| map([s, 0.0, 0.0], [0.0, s, 0.0], [0.0, 0.0, s]);
        let sized = |s: f64| Twins {
            second: bodies::named(name, s).shape,
            between: scaled(s),
            unit: 1.0,
            ..whole(shape.clone())
        };
        let pair = |title: &str, twins: Twins| cell(format!("{name}: {title} [64 ε reach]"), &body, twins);
        cells.push(pair("A ∪ A", whole(Arc::new(Union::new(shape.clone(), shape.clone()).unwrap()))));
        cells.push(pair("A ∩ A", whole(Arc::new(Intersect::new(shape.clone(), shape.clone()).unwrap()))));
        cells.push(pair(
            "A without what is elsewhere",
            whole(Arc::new(Subtract::new(shape.clone(), far).unwrap())),
        ));
        cells.push(pair("twice as large", sized(2.0)));
        cells.push(pair("2⁴⁰ times as large", sized(2f64.powi(40))));
        cells.push(pair("2⁻⁴⁰ times as large", sized(2f64.powi(-40))));
        cells.push(pair("in millimetres", sized(1e3)));
        cells.push(pair("in kilometres", sized(1e-3)));
        let motion = translate(3.0, -2.0, 1.0) * rotate(12.0, 34.0, 56.0);
        cells.push(pair("moved and turned", moved(whole(shape.clone()), &shape, motion)));
        let shift = translate(1e6, 2e6, -5e5);
        let shifted = Twins { reach: 4e6, ..moved(whole(shape.clone()), &shape, shift) };
        cells.push(pair("shifted by 2000 km", shifted));
        cells.push(bits(format!("{name}: twice as large, bit by bit"), &body, 2.0));
    }
    cells.extend(pieces(|s| s));
    cells.push(order());
    cells.push(ball_and_mesh(0.0));
    cells.extend(instances());
    cells
}

pub(crate) fn controls() -> Vec<Cell> {
    let body = bodies::named("cylinder", 1.0);
    let other: Shape = Arc::new(Wrong(body.shape.clone(), Fault::Stretches(1e-12)));
    let twins = Twins {
        first: body.shape.clone(),
        second: other,
        between: AffineMatrix3D::IDENTITY,
        unit: 1.0,
        reach: 4.0,
    };
    let missing = Twins {
        second: Arc::new(Wrong(body.shape.clone(), Fault::Misses(100))),
        first: body.shape.clone(),
        ..twins_of(&body)
    };
    let mut cells = vec![
        cell("stretched by 1e-12".to_owned(), &body, twins),
        cell("one line in 100 missed".to_owned(), &body, missing),
        ball_and_mesh(1e-2),
        bits("three times as large, bit by bit".to_owned(), &body, 3.0),
    ];
    cells.extend(pieces(|s| Arc::new(Wrong(s, Fault::Stretches(1e-12)))));
    cells
}

fn twins_of(body: &Body) -> Twins {
    let (first, second) = (body.shape.clone(), body.shape.clone());
    Twins { first, second, between: AffineMatrix3D::IDENTITY, unit: 1.0, reach: 4.0 }
}

/// The second is the same shape, placed as an operand by a motion.
fn moved(twins: Twins, shape: &Shape, m: AffineMatrix3D) -> Twins {
    let placed = shape.clone().placed(m);
    Twins { second: Arc::new(Union::new(placed.clone(), placed).unwrap()), between: m, reach: 16.0, ..twins }
}

fn line(body: &Body, rng: &mut Rng) -> Ray {
    let direction = SphereSampler.sample(rng);
    let shift = Vector3D::from([0, 1, 2].map(|_| rng.range(-0.8, 0.8) * body.size));
    Ray::new(body.inside + shift - direction * (3.0 * body.size), direction)
}

fn all(shape: &dyn Primitive, ray: &Ray, scratch: &mut Scratch) -> Vec<Crossing> {
    let mut out = Vec::new();
    shape.crossings(ray, scratch, &mut out);
    out
}

fn cell(name: String, body: &Body, twins: Twins) -> Cell {
    let body = body.clone();
    Cell::new(name, 1.0, move |rays, tally| {
        let (mut rng, mut scratch) = (Rng::new(61), Scratch::default());
        for _ in 0..rays {
            let ray = line(&body, &mut rng);
            let other = Ray::new(twins.between * ray.origin, twins.between * ray.direction);
            let a = all(&*twins.first, &ray, &mut scratch);
            let b = all(&*twins.second, &other, &mut scratch);
            tally.ray();
            compare(&body, &ray, &a, &b, twins.unit, twins.reach, tally);
        }
    })
    .share(0.2)
}

/// Compares two lists of crossings of a line, whose second has distances in another unit.
fn compare(body: &Body, ray: &Ray, a: &[Crossing], b: &[Crossing], unit: f64, reach: f64, tally: &mut Tally) {
    let rounding = 64.0 * f64::EPSILON * reach * body.size;
    if a.len() != b.len() {
        let (more, unit) = if a.len() > b.len() { (a, 1.0) } else { (b, unit) };
        let slight = more.windows(2).any(|w| {
            let middle = ray.point_at(0.5 * (w[0].distance + w[1].distance) * unit);
            body.depth(middle).abs() < rounding
        });
        tally.check(slight, || format!("{a:?} and {b:?}: {ray:?}"));
        return;
    }
    for (x, y) in a.iter().zip(b) {
        let place = ray.point_at(x.distance);
        // At an edge either face may be meant.
        let Some(normal) = body.outward(place) else { continue };
        let cosine = normal.dot(ray.direction).abs();
        let error = (x.distance - y.distance * unit).abs() * cosine / rounding;
        tally.error(error, || format!("{x:?} and {y:?}: {ray:?}"));
        tally.check(x.exiting == y.exiting || cosine < 1e-6, || format!("{x:?} and {y:?}: {ray:?}"));
    }
}

/// A shape of other dimensions and a ray in that unit: all arithmetic is the same, so are the bits.
fn bits(name: String, body: &Body, scale: f64) -> Cell {
    let (body, other) = (body.clone(), bodies::named(body.name, scale));
    Cell::new(name, 0.0, move |rays, tally| {
        let (mut rng, mut scratch) = (Rng::new(62), Scratch::default());
        for _ in 0..rays {
            let ray = line(&body, &mut rng);
            let large = Ray::new(Point3D::from(ray.origin.to_array().map(|x| x * scale)), ray.direction);
            let a = all(&*body.shape, &ray, &mut scratch);
            let b = all(&*other.shape, &large, &mut scratch);
            tally.ray();
            let same = a.len() == b.len()
                && a.iter().zip(&b).all(|(x, y)| x.distance * scale == y.distance && x.exiting == y.exiting);
            tally.check(same, || format!("{a:?} and {b:?}: {ray:?}"));
        }
    })
    .share(0.1)
}

/// Bodies cut into two that touch.
fn pieces(spoil: fn(Shape) -> Shape) -> Vec<Cell> {
    let cuboid = bodies::named("cuboid", 1.0);
    let [low, high] = [Point3D::new(-0.7, -0.5, -0.6), Point3D::new(0.6, 0.8, 0.5)];
    let cut = 0.1;
    let lower = Cuboid::new(low, Point3D::new(cut, high.y, high.z)).unwrap();
    let upper = Cuboid::new(Point3D::new(cut, low.y, low.z), high).unwrap();
    let halves: Shape = Arc::new(Union::new(lower, upper).unwrap());
    let rod = bodies::named("cylinder", 1.0);
    let piece = Cylinder::new(0.5, 0.6).unwrap();
    let rods: Shape = Arc::new(Union::new(piece, piece.placed(translate(0.0, 0.0, 0.6))).unwrap());
    let sphere = bodies::named("sphere", 1.0);
    let half = |sign: f64| {
        let block = Cuboid::centred(4.0, 4.0, 4.0).unwrap().placed(translate(0.0, 0.0, 2.0 * sign));
        Intersect::new(Sphere::new(1.0).unwrap(), block).unwrap()
    };
    let balls: Shape = Arc::new(Union::new(half(1.0), half(-1.0)).unwrap());
    [(cuboid, halves), (rod, rods), (sphere, balls)]
        .into_iter()
        .map(|(body, second)| {
            let name = format!("{}: cut in two that touch [64 ε reach]", body.name);
            let twins = Twins { second: spoil(second), ..twins_of(&body) };
            cell(name, &body, twins)
        })
        .collect()
}

/// The same shapes in another order: the same places and kinds, bit by bit.
fn order() -> Cell {
    Cell::new("order of the shapes in a world", 0.0, |rays, tally| {
        let mut rng = Rng::new(63);
        let places: Vec<_> = (0..30)
            .map(|_| {
                let [x, y, z] = [0, 1, 2].map(|_| rng.range(-3.0, 3.0));
                translate(x, y, z) * rotate(rng.range(0.0, 360.0), rng.range(-90.0, 90.0), 0.0)
            })
            .collect();
        let kinds = bodies::all(1.0);
        let make = |order: &mut dyn Iterator<Item = usize>| {
            let mut world = World::<()>::new();
            for i in order {
                let shape = kinds[i % kinds.len()].shape.clone();
                world.add(Node::of(shape, ()).transform(places[i])).unwrap();
            }
            world
        };
        let (forward, backward) = (make(&mut (0..30)), make(&mut (0..30).rev()));
        for _ in 0..rays.min(100_000) {
            let start = Point3D::from([0, 1, 2].map(|_| rng.range(-6.0, 6.0)));
            let ray = Ray::new(start, SphereSampler.sample(&mut rng));
            tally.ray();
            let list = |w: &World<()>| -> Vec<(u64, bool)> {
                let all = w.crossings(&ray).unwrap();
                let mut all: Vec<_> = all.iter().map(|h| (h.distance().to_bits(), h.exiting())).collect();
                all.sort_unstable();
                all
            };
            tally.check(list(&forward) == list(&backward), || format!("crossings differ: {ray:?}"));
            let first = |w: &World<()>| w.hit(&ray).unwrap().map(|h| h.distance().to_bits());
            tally.check(first(&forward) == first(&backward), || format!("hits differ: {ray:?}"));
            tally.check(
                forward.contains(start).unwrap().len() == backward.contains(start).unwrap().len(),
                || format!("containers differ: {start:?}"),
            );
        }
    })
    .share(0.3)
}

/// A ball and an icosphere with corners on it: apart by no more than the sagitta of a face.
fn ball_and_mesh(excess: f64) -> Cell {
    Cell::new("sphere and icosphere of 20480 faces [sagitta]", 1.0, move |rays, tally| {
        let data = MeshData::icosphere(5, 1.0 + excess).unwrap();
        // The flattest face lies nearest to the middle.
        let sagitta = (0..data.triangle_count())
            .map(|t| {
                let [a, b, c] = data.corners(t);
                let normal = a.vector_to(b).cross(a.vector_to(c)).normalise_unchecked();
                1.0 + excess - normal.dot(a.to_vector())
            })
            .fold(0.0, f64::max);
        let (mesh, ball) = (Mesh::new(data).unwrap(), Sphere::new(1.0).unwrap());
        let (mut rng, mut scratch) = (Rng::new(64), Scratch::default());
        let body = bodies::named("sphere", 1.0);
        for _ in 0..rays {
            let ray = line(&body, &mut rng);
            let (a, b) = (all(&ball, &ray, &mut scratch), all(&mesh, &ray, &mut scratch));
            tally.ray();
            // Between the sphere within and the sphere around.
            let inner = Sphere::new(1.0 - sagitta).unwrap();
            let c = all(&inner, &ray, &mut scratch);
            let counted = match (c.len(), b.len()) {
                (2, n) => n == 2,
                (_, n) => n <= a.len().max(2) && (n == 0 || a.len() == 2),
            };
            tally.check(counted, || format!("{a:?} and {b:?}: {ray:?}"));
            for (x, y) in b.iter().zip(&a) {
                let radius = ray.point_at(x.distance).to_vector().length();
                let depth = (1.0 - radius) / sagitta;
                tally.check(depth > -1e-9, || format!("{radius} outside: {x:?} and {y:?}"));
                tally.error(depth.abs() - 1e-9, || format!("{radius}: {x:?} and {y:?}"));
            }
        }
    })
    .share(0.3)
}

/// A mesh under a node's map, and a mesh whose vertices were mapped.
fn instances() -> Vec<Cell> {
    let m = translate(1.0, 2.0, -0.5)
        * rotate(20.0, 30.0, 40.0)
        * map([2.0, 0.0, 0.0], [0.0, 0.5, 0.0], [0.0, 0.0, 1.0]);
    [("icosphere", MeshData::icosphere(3, 1.0).unwrap()), ("bracket", bodies::bracket(1.0))]
        .into_iter()
        .map(|(name, data)| {
            Cell::new(format!("{name}: instance and copy [64 ε reach]"), 1.0, move |rays, tally| {
                let world_of = |mesh: Mesh, m: AffineMatrix3D| {
                    let mut world = World::<()>::new();
                    world.add(Node::of(mesh, ()).transform(m)).unwrap();
                    world
                };
                let instance = world_of(Mesh::new(data.clone()).unwrap(), m);
                let copy = data.clone().transformed(&m).unwrap();
                let copy = world_of(Mesh::new(copy).unwrap(), AffineMatrix3D::IDENTITY);
                let (mut rng, mut scratch) = (Rng::new(65), Scratch::default());
                for _ in 0..rays {
                    let inside = Point3D::from([0, 1, 2].map(|_| rng.range(0.05, 0.3)));
                    let direction = SphereSampler.sample(&mut rng);
                    let ray = Ray::new(m * (inside - direction * 3.0), m * direction);
                    let (a, b) = (instance.scene().unwrap(), copy.scene().unwrap());
                    let (x, y) = (a.crossings(&ray, &mut scratch), b.crossings(&ray, &mut scratch));
                    tally.ray();
                    if x.len() != y.len() {
                        let lengths = |l: &[raysect::core::Candidate]| -> f64 {
                            l.chunks(2)
                                .map(|p| p[p.len() - 1].crossing.distance - p[0].crossing.distance)
                                .sum()
                        };
                        // An edge that is grazed.
                        let same = (lengths(&x) - lengths(&y)).abs() < 1e-12;
                        tally.check(same, || format!("{x:?} and {y:?}: {ray:?}"));
                        continue;
                    }
                    for (p, q) in x.iter().zip(&y) {
                        let cosine = a.finish(&ray, p).normal.dot(ray.direction.normalise_unchecked()).abs();
                        let off = (p.crossing.distance - q.crossing.distance).abs() * cosine;
                        let unit = 64.0 * f64::EPSILON * 16.0;
                        tally.error(off / unit, || format!("{p:?} and {q:?}: {ray:?}"));
                    }
                }
            })
        })
        .collect()
}
