use fearless_simd::{Level, Simd, dispatch};
use raysect_math::{Point3D, Rng, Vector3D};

use super::*;
use crate::accel::{TraversalRay, slabs};
use crate::{Interval, Ray};

/// Notes all items of the leaves that it is shown.
#[derive(Default)]
struct Collector<'a> {
    tree: Option<&'a WideTree>,
    found: Vec<u32>,
}

impl<S: Simd> LeafTest<S> for Collector<'_> {
    fn leaf(&mut self, _: S, leaf: u32, limit: f32) -> f32 {
        let items = self.tree.map_or([NO_ITEM; LEAF_ITEMS], |t| t.leaves()[leaf as usize]);
        self.found.extend(items.into_iter().filter(|&i| i != NO_ITEM));
        limit
    }
}

fn walk(tree: &WideTree, ray: &Ray, within: Interval, level: Level) -> Vec<u32> {
    let mut collector = Collector { tree: Some(tree), found: Vec::new() };
    let mut stack = TraversalStack::default();
    if let Some(prepared) = tree.prepare(ray, within) {
        let limit = prepared.limit(within.max);
        dispatch!(level, simd => tree.walk(simd, &prepared, limit, &mut stack, &mut collector));
    }
    collector.found
}

/// Boxes of very different sizes, some flat, about a place far away or near.
fn boxes(count: usize, size: f64, shift: f64, rng: &mut Rng) -> Vec<BoundingBox3D> {
    (0..count)
        .map(|_| {
            let extent = size * 10f64.powf(rng.range(-4.0, -0.5));
            let corner = [0, 1, 2].map(|_| shift + rng.range(-size, size));
            let far = corner.map(|x| if rng.probability(0.2) { x } else { x + extent * rng.uniform() });
            BoundingBox3D { lower: corner.into(), upper: far.into() }
        })
        .collect()
}

/// A ray that passes near one of the boxes, from `away` sizes off; often along an axis or with a zero of either sign.
fn ray(b: &BoundingBox3D, away: f64, size: f64, rng: &mut Rng) -> Ray {
    let mut d = [0, 1, 2].map(|_| rng.range(-1.0, 1.0));
    for x in &mut d {
        if rng.probability(0.15) {
            *x = if rng.probability(0.5) { 0.0 } else { -0.0 };
        }
    }
    if d == [0.0; 3] {
        d[0] = 1.0;
    }
    let direction = Vector3D::from(d).normalise_unchecked();
    let target = [0, 1, 2].map(|a| match (rng.uniform() * 3.0) as u32 {
        0 => b.lower[a],
        1 => b.upper[a],
        _ => rng.range(b.lower[a], b.upper[a].next_up()),
    });
    Ray::new(Point3D::from(target) - direction * (away * size), direction * 10f64.powf(rng.range(-2.0, 2.0)))
}

#[test]
fn no_box_is_missed_on_any_level() {
    let mut rng = Rng::new(17);
    let mut met = 0;
    for (size, shift) in [(1.0, 0.0), (1e-9, 0.0), (1e9, 0.0), (1e-3, 5.0), (1.0, 1e6)] {
        for count in [1, 3, 5, 40, 3000] {
            let all = boxes(count, size, shift, &mut rng);
            let tree = WideTree::new(&all);
            for away in [0.0, 0.3, 3.0, 1e3, 1e7] {
                for _ in 0..200 {
                    let chosen = (rng.uniform() * count as f64) as usize;
                    let ray = ray(&all[chosen], away, size, &mut rng);
                    let length = size * away * 2.0 / ray.direction.length();
                    let within =
                        Interval::new(0.0, if rng.probability(0.5) { f64::INFINITY } else { length });
                    let exact = TraversalRay::new(&ray, 0.0);
                    let expected: Vec<u32> = (0..count as u32)
                        .filter(|&i| exact.enter(&slabs(&all[i as usize]), within.max).is_some())
                        .collect();
                    met += expected.len();
                    for level in [Level::new(), Level::baseline()] {
                        let mut found = walk(&tree, &ray, within, level);
                        found.sort_unstable();
                        let missed = expected.iter().find(|i| found.binary_search(i).is_err());
                        assert_eq!(missed, None, "{ray:?} from {away} sizes of {size} m");
                    }
                }
            }
        }
    }
    assert!(met > 10_000, "{met}");
}

#[test]
fn few_boxes_are_visited() {
    let mut rng = Rng::new(4);
    let all = boxes(20_000, 1.0, 0.0, &mut rng);
    let tree = WideTree::new(&all);
    let (mut visited, mut met) = (0, 0);
    for _ in 0..1000 {
        let ray = ray(&all[(rng.uniform() * 2e4) as usize], 2.0, 1.0, &mut rng);
        visited += walk(&tree, &ray, Interval::AHEAD, Level::new()).len();
        let exact = TraversalRay::new(&ray, 0.0);
        met += all.iter().filter(|b| exact.enter(&slabs(b), f64::INFINITY).is_some()).count();
    }
    assert!(visited < 12 * met, "{visited} visited for {met} met");
}

#[test]
fn every_item_has_its_place_once() {
    let mut rng = Rng::new(5);
    for count in [0, 1, 4, 5, 100, 10_000] {
        let mut all = boxes(count, 1.0, 0.0, &mut rng);
        if count > 4 {
            all[2] = BoundingBox3D::EMPTY;
        }
        let tree = WideTree::new(&all);
        let mut items: Vec<u32> = tree.leaves().iter().flatten().copied().filter(|&i| i != NO_ITEM).collect();
        items.sort_unstable();
        let expected: Vec<u32> = (0..count as u32).filter(|&i| !all[i as usize].is_empty()).collect();
        assert_eq!(items, expected);
    }
}

#[test]
fn boxes_that_cannot_be_told_apart_are_split_all_the_same() {
    let one = BoundingBox3D { lower: Point3D::new(1.0, 2.0, 3.0), upper: Point3D::new(1.5, 2.0, 3.5) };
    let tree = WideTree::new(&vec![one; 1000]);
    let ray = Ray::new(Point3D::new(1.2, 0.0, 3.2), Vector3D::Y);
    assert_eq!(walk(&tree, &ray, Interval::AHEAD, Level::new()).len(), 1000);
    assert_eq!(walk(&tree, &ray, Interval::new(0.0, 1.9), Level::new()).len(), 0);
}

#[test]
fn the_tree_is_the_same_on_any_number_of_threads() {
    let all = boxes(100_000, 1.0, 0.0, &mut Rng::new(6));
    let built = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| WideTree::new(&all))
    };
    let (one, three) = (built(1), built(3));
    assert_eq!(one.leaves(), three.leaves());
    assert!(
        one.nodes.iter().zip(&three.nodes).all(|(a, b)| a.planes == b.planes && a.children == b.children)
    );
}
