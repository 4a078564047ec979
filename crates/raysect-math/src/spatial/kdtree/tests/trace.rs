//! Rays.

use std::collections::HashSet;

use super::*;

type Ray<const N: usize> = ([f64; N], [f64; N]);

/// Where a ray enters a closed box, 0 if it begins there.
fn enter<const N: usize>(item: &KdItem<N>, (origin, direction): Ray<N>) -> Option<f64> {
    let (mut near, mut far) = (0.0f64, f64::INFINITY);
    for axis in 0..N {
        let (o, d) = (origin[axis], direction[axis]);
        let ends = [item.lower()[axis], item.upper()[axis]];
        if d == 0.0 {
            if o < ends[0] || o > ends[1] {
                return None;
            }
        } else {
            let [a, b] = ends.map(|x| (x - o) / d);
            (near, far) = (near.max(a.min(b)), far.min(a.max(b)));
        }
    }
    (near <= far).then_some(near)
}

/// Where a ray enters the largest ball in a box, or leaves it if it begins there.
fn enter_ball<const N: usize>(item: &KdItem<N>, (origin, direction): Ray<N>) -> Option<f64> {
    let dot = |a: [f64; N], b: [f64; N]| (0..N).map(|i| a[i] * b[i]).sum::<f64>();
    let extent = |i: usize| item.upper()[i] - item.lower()[i];
    let radius = (0..N).map(extent).fold(f64::INFINITY, f64::min) / 2.0;
    let from_centre = std::array::from_fn(|i| origin[i] - item.lower()[i] - 0.5 * extent(i));
    let (a, b) = (dot(direction, direction), dot(from_centre, direction));
    let root = (b * b - a * (dot(from_centre, from_centre) - radius * radius)).sqrt();
    [(-b - root) / a, (-b + root) / a].into_iter().find(|&t| t >= 0.0)
}

type Shape<const N: usize> = fn(&KdItem<N>, Ray<N>) -> Option<f64>;

/// The nearest distance at which the ray meets something in the tree.
fn nearest<const N: usize>(tree: &KdTree<N>, ray: Ray<N>, max_distance: f64, shape: Shape<N>) -> Option<f64> {
    let mut found = None;
    let left = tree.trace(ray.0, ray.1, max_distance, |ids, mut limit| {
        for t in ids.iter().filter_map(|&id| shape(tree.item(id).unwrap(), ray)) {
            if t <= limit {
                (found, limit) = (Some(t), t);
            }
        }
        limit
    });
    assert_eq!(left, found.unwrap_or(max_distance));
    found
}

fn brute<const N: usize>(
    items: &[KdItem<N>],
    ray: Ray<N>,
    max_distance: f64,
    shape: Shape<N>,
) -> Option<f64> {
    let hits = items.iter().filter_map(|item| shape(item, ray)).filter(|&t| t <= max_distance);
    hits.min_by(f64::total_cmp)
}

/// Rays of all kinds: from inside and outside, along axes, in edges and planes, with zeros of both signs. Coordinates
/// are multiples of a quarter and directions are of small whole numbers if `grid`, so that distances of different
/// planes are equal or differ by far more than rounding.
fn random_ray<const N: usize>(rng: &mut Rng, grid: bool) -> Ray<N> {
    let origin = std::array::from_fn(|_| {
        let x = rng.range(-2.0, 8.0);
        if grid { (4.0 * x).round() / 4.0 } else { x }
    });
    let direction = std::array::from_fn(|_| {
        let x = rng.range(-3.5, 3.5);
        match (rng.uniform() * 6.0) as u32 {
            0 => 0.0,
            1 => -0.0,
            _ if grid => x.round(),
            _ => x,
        }
    });
    (origin, direction)
}

fn check<const N: usize>(shape: Shape<N>) {
    let mut rng = Rng::new(17 + N as u64);
    for (count, grid) in [(2, true), (300, true), (300, false)] {
        let items: Vec<KdItem<N>> = random_items(&mut rng, count, grid);
        let tree = KdTree::new(items.clone()).unwrap();
        let lacking = KdTree::new(items[items.len().div_ceil(10)..].to_vec()).unwrap();
        let (mut hits, mut missed) = (0, 0);
        for i in 0..15_000 {
            let ray = random_ray(&mut rng, grid);
            let max_distance = if i % 3 == 0 { rng.uniform() } else { f64::INFINITY };
            let expected = brute(&items, ray, max_distance, shape);
            assert_eq!(nearest(&tree, ray, max_distance, shape), expected, "{ray:?} up to {max_distance}");
            hits += u32::from(expected.is_some());
            missed += u32::from(nearest(&lacking, ray, max_distance, shape) != expected);
        }
        // Negative control: a tree that lacks some of the items is found out.
        let shown = hits > 500 && missed > 0;
        assert!(count < 300 || shown, "{hits} hits, {missed} of them with items that the other tree lacks");
    }
}

#[test]
fn the_nearest_box_is_that_of_a_look_at_all() {
    check::<2>(enter);
    check::<3>(enter);
}

#[test]
fn the_nearest_ball_is_that_of_a_look_at_all() {
    check::<2>(enter_ball);
    check::<3>(enter_ball);
}

#[test]
fn every_box_that_a_ray_touches_is_visited() {
    let mut rng = Rng::new(4);
    let items: Vec<KdItem<3>> = random_items(&mut rng, 400, true);
    let tree = KdTree3D::new(items.clone()).unwrap();
    let mut lent_at_all = 0;
    for _ in 0..10_000 {
        let ray = random_ray(&mut rng, true);
        let mut lent = HashSet::new();
        tree.trace(ray.0, ray.1, f64::INFINITY, |ids, limit| {
            lent.extend(ids.iter().copied());
            limit
        });
        for item in items.iter().filter(|item| enter(item, ray).is_some()) {
            assert!(lent.contains(&item.id()), "{item:?} on the way of {ray:?}");
        }
        lent_at_all += lent.len();
    }
    // A tree that lent everything would pass.
    assert!(lent_at_all < 10_000 * items.len() / 10, "{lent_at_all} items lent");
}

/// A row of cubes from 0 to 100 along x.
fn row() -> KdTree3D {
    KdTree3D::new(
        (0..100).map(|i| KdItem::new(i, [f64::from(i), 0.0, 0.0], [f64::from(i + 1), 1.0, 1.0]).unwrap()),
    )
    .unwrap()
}

#[test]
fn leaves_come_in_order_and_end_at_a_hit() {
    let tree = row();
    for (origin, direction, first) in [(-5.0, 2.0, 0), (105.0, -2.0, 99), (50.5, 1.0, 50), (50.5, -1.0, 50)] {
        let mut lent = Vec::new();
        tree.trace([origin, 0.5, 0.5], [direction, 0.0, -0.0], f64::INFINITY, |ids, limit| {
            lent.extend_from_slice(ids);
            limit
        });
        assert_eq!(lent[0], first);
        lent.dedup();
        assert!(if direction > 0.0 { lent.is_sorted() } else { lent.iter().rev().is_sorted() }, "{lent:?}");
        let mut leaves = 0;
        tree.trace([origin, 0.5, 0.5], [direction, 0.0, 0.0], f64::INFINITY, |_, _| {
            leaves += 1;
            -1.0
        });
        assert_eq!(leaves, 1);
    }
}

#[test]
fn the_largest_distance_bounds_the_search() {
    let tree = row();
    let lent = |max_distance: f64| {
        let mut most = None;
        tree.trace([-5.0, 0.5, 0.5], [2.0, 0.0, 0.0], max_distance, |ids, limit| {
            most = most.max(ids.iter().copied().max());
            limit
        });
        most
    };
    assert_eq!([lent(2.4), lent(f64::NAN), lent(-1.0), lent(f64::NEG_INFINITY)], [None; 4]);
    assert!(lent(2.5).is_some_and(|id| id <= 2));
    // 25 lengths of 2 m from -5 m.
    assert!(lent(25.0).is_some_and(|id| (44..48).contains(&id)));
    // An answer that is no number changes nothing.
    let mut leaves = 0;
    let left = tree.trace([-5.0, 0.5, 0.5], [2.0, 0.0, 0.0], 100.0, |_, _| {
        leaves += 1;
        f64::NAN
    });
    assert_eq!(left, 100.0);
    assert!(leaves > 30);
}

#[test]
fn rays_that_are_no_rays_meet_nothing_or_stay() {
    let tree = row();
    let met = |origin: [f64; 3], direction: [f64; 3]| {
        let mut met = false;
        tree.trace(origin, direction, f64::INFINITY, |_, limit| {
            met = true;
            limit
        });
        met
    };
    let inside = [50.5, 0.5, 0.5];
    for x in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        assert!(!met([x, 0.5, 0.5], [1.0, 0.0, 0.0]));
        assert!(!met(inside, [x, 0.0, 0.0]));
    }
    assert!(!met([-f64::MAX, 0.5, 0.5], [1.0, 0.0, 0.0]));
    assert!(met(inside, [0.0; 3]));
    assert!(!met([-1.0, 0.5, 0.5], [-0.0; 3]));
    // Extremes that are rays.
    assert!(met([-8e307, 0.5, 0.5], [1e-300, 0.0, 0.0]));
    assert!(met([-1.0, 0.5, 0.5], [f64::MAX, 0.0, 0.0]));
    assert!(met(inside, [5e-324, -5e-324, 0.0]));
}
