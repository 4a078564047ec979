//! Whole worlds of nested, transformed shapes: first hits, all crossings and what contains a point, against a list over all
//! shapes without boxes.

use raysect::core::{Acceleration, Interval, Node, NodeId, Ray, Scratch, World};
use raysect::math::{AffineMatrix3D, Point3D, Rng, SphereSampler, Vector3D, rotate, translate};

use super::bodies::{self, Body, Shape, map};
use super::wrong::{Fault, Wrong};
use super::{Cell, Tally};

const ACCELERATIONS: [Acceleration; 3] = [Acceleration::List, Acceleration::Tree, Acceleration::Automatic];

pub(crate) fn cells() -> Vec<Cell> {
    let mut cells = Vec::new();
    for acceleration in ACCELERATIONS {
        for (size, count) in [(1.0, 5), (1.0, 60), (1e-6, 60), (1e6, 60), (1.0, 400)] {
            for offset in [0.0, 1e6] {
                let name = format!("{count} shapes of {size:e} m, {offset:e} sizes off, {acceleration:?}");
                let share = if count > 100 { 0.05 } else { 0.2 };
                let core = size == 1.0 && (count < 100 || offset > 0.0);
                cells.push(
                    cell(name, acceleration.clone(), size, count, offset, |s| s).share(share).core(core),
                );
            }
        }
    }
    cells
}

pub(crate) fn controls() -> Vec<Cell> {
    let cells = ACCELERATIONS.map(|a| {
        let name = format!("bounds too small, {a:?}");
        cell(name, a, 1.0, 60, 0.0, |s| std::sync::Arc::new(Wrong(s, Fault::Culls(0.8)))).share(0.2)
    });
    cells.into_iter().collect()
}

/// The shapes of a world with their maps, from the nodes.
struct Reference {
    shapes: Vec<(NodeId, Shape, AffineMatrix3D)>,
}

impl Reference {
    fn local(ray: &Ray, to_local: &AffineMatrix3D) -> Ray {
        Ray {
            origin: *to_local * ray.origin,
            direction: *to_local * ray.direction,
            max_distance: ray.max_distance,
        }
    }

    fn crossings(&self, ray: &Ray, scratch: &mut Scratch) -> Vec<(f64, NodeId, bool)> {
        let (mut all, mut list) = (Vec::new(), Vec::new());
        for (node, shape, to_local) in &self.shapes {
            list.clear();
            shape.crossings(&Self::local(ray, to_local), scratch, &mut list);
            let ahead = list.iter().filter(|c| c.distance >= 0.0 && c.distance <= ray.max_distance);
            all.extend(ahead.map(|c| (c.distance, *node, c.exiting)));
        }
        all.sort_by(|a, b| a.0.total_cmp(&b.0));
        all
    }

    fn hit(&self, ray: &Ray, scratch: &mut Scratch) -> Option<f64> {
        let within = Interval::new(0.0, ray.max_distance);
        let each = self.shapes.iter().filter_map(|(_, shape, to_local)| {
            shape.hit(&Self::local(ray, to_local), within, scratch).map(|c| c.distance)
        });
        each.min_by(f64::total_cmp)
    }

    fn containing(&self, point: Point3D) -> Vec<NodeId> {
        let inside = self.shapes.iter().filter(|(_, shape, to_local)| shape.contains(*to_local * point));
        inside.map(|(node, ..)| *node).collect()
    }
}

/// A world of groups within groups, and what is in it.
fn world(
    acceleration: Acceleration,
    size: f64,
    count: usize,
    offset: f64,
    spoil: fn(Shape) -> Shape,
    rng: &mut Rng,
) -> (World<()>, Reference) {
    let mut world = World::<()>::new();
    world.set_acceleration(acceleration);
    let kinds: Vec<Body> = bodies::all(size);
    let room = size * (count as f64).cbrt();
    let place = |reach: f64, rng: &mut Rng| {
        let [x, y, z] = [0, 1, 2].map(|_| reach * rng.range(-1.0, 1.0));
        translate(x, y, z) * rotate(rng.range(0.0, 360.0), rng.range(-90.0, 90.0), rng.range(0.0, 360.0))
    };
    let far = offset * size;
    let top = world.add(Node::group().transform(translate(far, -0.5 * far, 0.25 * far))).unwrap();
    let mut groups = vec![top];
    for _ in 0..count.isqrt() {
        let parent = groups[(rng.uniform() * groups.len() as f64) as usize];
        groups.push(world.add(Node::group().transform(place(0.3 * room, rng)).parent(parent)).unwrap());
    }
    let mut nodes = Vec::new();
    for i in 0..count {
        let parent = groups[(rng.uniform() * groups.len() as f64) as usize];
        let s = [0, 1, 2].map(|_| rng.range(0.3, 1.5) * if rng.uniform() < 0.2 { -1.0 } else { 1.0 });
        let stretch = map([s[0], 0.0, 0.2], [0.0, s[1], 0.0], [0.1, 0.0, s[2]]);
        let m = if i % 2 == 0 { place(room, rng) } else { place(room, rng) * stretch };
        let shape = kinds[i % kinds.len()].shape.clone();
        let node = world.add(Node::of(spoil(shape.clone()), ()).transform(m).parent(parent)).unwrap();
        nodes.push((node, shape));
    }
    let shapes =
        nodes.into_iter().map(|(node, shape)| (node, shape, world.to_local(node).unwrap())).collect();
    (world, Reference { shapes })
}

fn cell(
    name: String,
    acceleration: Acceleration,
    size: f64,
    count: usize,
    offset: f64,
    spoil: fn(Shape) -> Shape,
) -> Cell {
    Cell::new(name, 0.0, move |rays, tally| {
        let mut rng = Rng::new(81);
        // A new world now and then.
        for _ in 0..rays.div_ceil(1000) {
            let (world, reference) = world(acceleration.clone(), size, count, offset, spoil, &mut rng);
            let far = Vector3D::new(1.0, -0.5, 0.25) * (offset * size);
            let room = size * (count as f64).cbrt();
            for _ in 0..rays.min(1000) {
                let start = [0, 1, 2].map(|_| 2.0 * room * rng.range(-1.0, 1.0));
                let mut ray = Ray::new(Point3D::from(start) + far, SphereSampler.sample(&mut rng));
                if rng.uniform() < 0.2 {
                    ray = ray.with_max_distance(room * rng.uniform());
                }
                judge(&world, &reference, &ray, tally);
            }
        }
    })
}

fn judge(world: &World<()>, reference: &Reference, ray: &Ray, tally: &mut Tally) {
    let mut scratch = Scratch::default();
    tally.ray();
    let first = world.hit(ray).unwrap().map(|h| h.distance());
    let expected = reference.hit(ray, &mut scratch);
    tally.check(first.map(f64::to_bits) == expected.map(f64::to_bits), || {
        format!("first hit {first:?}, not {expected:?}: {ray:?}")
    });
    let all = world.crossings(ray).unwrap();
    let mut found: Vec<_> = all.iter().map(|h| (h.distance(), h.node, h.exiting())).collect();
    let mut listed = reference.crossings(ray, &mut scratch);
    let ordered = found.windows(2).all(|w| w[0].0 <= w[1].0);
    // Among equal distances any order is right.
    let key = |c: &(f64, NodeId, bool)| (c.0.to_bits(), format!("{:?}", c.1), c.2);
    found.sort_by_cached_key(key);
    listed.sort_by_cached_key(key);
    tally.check(ordered && found == listed, || format!("{found:?}, not {listed:?}: {ray:?}"));
    let mut around = world.contains(ray.origin).unwrap();
    let mut within = reference.containing(ray.origin);
    around.sort_by_cached_key(|n| format!("{n:?}"));
    within.sort_by_cached_key(|n| format!("{n:?}"));
    tally.check(around == within, || format!("in {around:?}, not {within:?}: {:?}", ray.origin));
}
