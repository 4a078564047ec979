//! Points.

use super::*;

fn brute<const N: usize>(items: &[KdItem<N>], point: [f64; N]) -> Vec<u32> {
    let mut ids: Vec<u32> = items.iter().filter(|item| item.contains(point)).map(KdItem::id).collect();
    ids.sort_unstable();
    ids
}

/// A corner, or a place on an edge of some box, or any.
fn awkward_point<const N: usize>(rng: &mut Rng, items: &[KdItem<N>]) -> [f64; N] {
    std::array::from_fn(|axis| {
        let item = items[(rng.uniform() * items.len() as f64) as usize];
        match (rng.uniform() * 4.0) as u32 {
            0 => item.lower()[axis],
            1 => item.upper()[axis],
            2 => 0.5 * item.lower()[axis] + 0.5 * item.upper()[axis],
            _ => rng.range(-0.5, 6.5),
        }
    })
}

/// How many of the points the tree and a look at all items disagree about.
fn disagreements<const N: usize>(tree: &KdTree<N>, items: &[KdItem<N>], points: u32, rng: &mut Rng) -> u32 {
    (0..points)
        .map(|_| {
            let point = awkward_point(rng, items);
            u32::from(tree.items_containing(point) != brute(items, point))
        })
        .sum()
}

fn check<const N: usize>() {
    let mut rng = Rng::new(N as u64);
    for (count, grid) in [(1, false), (2, true), (300, false), (300, true)] {
        let items: Vec<KdItem<N>> = random_items(&mut rng, count, grid);
        let tree = KdTree::new(items.clone()).unwrap();
        assert_eq!(disagreements(&tree, &items, 25_000, &mut rng), 0);
        // Negative control: a tree that lacks a few of the items is found out.
        let lacking = KdTree::new(items[items.len().div_ceil(30)..].to_vec()).unwrap();
        assert!(disagreements(&lacking, &items, 25_000, &mut rng) > 0);
    }
}

#[test]
fn all_boxes_around_a_point_are_found_and_no_others() {
    check::<1>();
    check::<2>();
    check::<3>();
}

/// Cells side by side: every edge is one of a neighbour too, and every plane of the tree lies in edges.
fn cells() -> Vec<KdItem<2>> {
    let cell = |i: u32| {
        let [x, y] = [f64::from(i % 100) * 0.1, f64::from(i / 100) * 0.3];
        KdItem::new(i, [x, y], [f64::from(i % 100 + 1) * 0.1, f64::from(i / 100 + 1) * 0.3]).unwrap()
    };
    (0..10_000).map(cell).collect()
}

#[test]
fn no_point_on_an_edge_is_lost() {
    let items = cells();
    let tree = KdTree2D::new(items.clone()).unwrap();
    let mut rng = Rng::new(8);
    for _ in 0..100_000 {
        let (i, j) = ((rng.uniform() * 101.0).floor(), rng.range(0.0, 30.0));
        let (x, y) = if rng.uniform() < 0.5 { (i * 0.1, j) } else { (j / 3.0, i * 0.3) };
        assert!(tree.is_contained([x, y], |_| true), "({x}, {y})");
    }
    for item in &items {
        for corner in [item.lower(), item.upper(), [item.lower()[0], item.upper()[1]]] {
            assert!(tree.items_containing(corner).contains(&item.id()));
        }
    }
}

#[test]
fn one_side_of_a_plane_would_lose_points() {
    // Negative control: what the two sides are asked for.
    let tree = KdTree2D::new(cells()).unwrap();
    let one_sided = |point: [f64; 2], id: u32| {
        let mut index = 0;
        loop {
            match tree.nodes[index] {
                Node::Branch { axis, split, upper } => {
                    index = if point[usize::from(axis)] < split { index + 1 } else { upper as usize };
                }
                Node::Leaf { start, count } => {
                    return tree.entries[start..start + count as usize].contains(&id);
                }
            }
        }
    };
    assert!(tree.items.iter().any(|item| !one_sided(item.upper(), item.id())));
}

#[test]
fn flat_boxes_in_a_plane_of_the_tree_lie_on_both_sides() {
    let mut items: Vec<_> =
        (0..8).map(|i| KdItem::new(i, [f64::from(i), 0.0], [f64::from(i + 1), 1.0]).unwrap()).collect();
    items.extend((0..8).map(|i| KdItem::new(10 + i, [f64::from(i), 0.0], [f64::from(i), 1.0]).unwrap()));
    let tree = KdTree2D::new(items).unwrap();
    let Node::Branch { axis: 0, split, .. } = tree.nodes[0] else {
        panic!("{:?} is no plane across x", tree.nodes[0])
    };
    let id = 10 + split as u32;
    assert!(tree.entries.iter().filter(|&&entry| entry == id).count() >= 2);
    assert!(tree.items_containing([split, 0.5]).contains(&id));
}

#[test]
fn the_test_decides_and_ends_the_search() {
    let items = (0..10).map(|i| KdItem::new(i, [0.0, 0.0], [1.0, 1.0 + f64::from(i)]).unwrap());
    let tree = KdTree2D::new(items).unwrap();
    let mut asked = Vec::new();
    let first = tree.first_containing([0.5, 5.5], |id| {
        asked.push(id);
        id >= 7
    });
    assert_eq!(first, Some(7));
    assert!(asked.iter().all(|&id| id >= 5), "boxes that do not contain the point were asked for: {asked:?}");
    assert_eq!(asked.last(), Some(&7));
    assert!(!tree.is_contained([0.5, 5.5], |_| false));
    assert!(tree.is_contained(crate::Point2D::new(0.5, 5.5), |id| id == 9));
    assert!(!tree.is_contained([0.5, 5.5], |id| id == 4));
}

#[test]
fn points_that_are_nowhere_are_in_nothing() {
    let items: Vec<KdItem<3>> = random_items(&mut Rng::new(1), 100, true);
    let tree = KdTree3D::new(items).unwrap();
    for x in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, -1e-300] {
        for axis in 0..3 {
            let mut point = [2.0; 3];
            point[axis] = x;
            assert!(tree.items_containing(point).is_empty(), "{point:?}");
        }
    }
}
