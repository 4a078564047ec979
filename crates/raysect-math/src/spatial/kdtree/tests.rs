//! Trees against a look at every item.

mod contain;
mod stream;
mod trace;

use super::*;
use crate::Rng;

/// Boxes whose corners have all digits, or lie on a grid of a quarter so that edges, planes and points coincide; one
/// in five is flat.
fn random_items<const N: usize>(rng: &mut Rng, count: u32, grid: bool) -> Vec<KdItem<N>> {
    let snap = |x: f64| if grid { (4.0 * x).round() / 4.0 } else { x };
    (0..count)
        .map(|i| {
            let lower: [f64; N] = std::array::from_fn(|_| snap(rng.range(0.0, 5.0)));
            let mut upper = lower.map(|x| x + snap(rng.range(0.0, 1.0)));
            if i % 5 == 0 {
                let axis = i as usize / 5 % N;
                upper[axis] = lower[axis];
            }
            // Numbers with gaps, in no order.
            KdItem::new((7 * i) % (count + 1 + count % 7) * 3 + 1, lower, upper).unwrap()
        })
        .filter({
            let mut seen = std::collections::HashSet::new();
            move |item| seen.insert(item.id())
        })
        .collect()
}

/// Items in each of the leaves.
fn leaves<const N: usize>(tree: &KdTree<N>) -> Vec<usize> {
    let count = |node: &Node| match *node {
        Node::Leaf { count, .. } => Some(count as usize),
        Node::Branch { .. } => None,
    };
    tree.nodes.iter().filter_map(count).collect()
}

#[test]
fn a_tree_without_items_finds_nothing() {
    let tree = KdTree3D::new([]).unwrap();
    assert!(tree.is_empty() && tree.bounds().is_none() && tree.item(0).is_none());
    assert!(tree.items_containing([0.0; 3]).is_empty());
    assert!(!tree.is_contained([0.0; 3], |_| true));
    let left = tree.trace([0.0; 3], [1.0, 0.0, 0.0], 5.0, |_, _| panic!("there is nothing to visit"));
    assert_eq!(left, 5.0);
}

#[test]
fn items_keep_their_numbers() {
    let boxes = [(9, 0.0), (2, 4.0), (1_000_000, 8.0)];
    let items = boxes.map(|(id, x)| KdItem::new(id, [x, 0.0], [x + 1.0, 1.0]).unwrap());
    let tree = KdTree2D::new(items).unwrap();
    assert_eq!((tree.len(), tree.bounds()), (3, Some(([0.0, 0.0], [9.0, 1.0]))));
    for (item, (id, x)) in items.iter().zip(boxes) {
        assert_eq!(tree.items_containing([x + 0.5, 0.5]), [id]);
        assert_eq!(tree.item(id), Some(item));
    }
    assert_eq!((tree.item(0), tree.item(3)), (None, None));
    let twice = KdTree2D::new([items[0], items[1], items[0]]);
    assert_eq!(twice, Err(MathError::DuplicateItem { id: 9 }));
}

#[test]
fn equal_and_flat_boxes_make_no_bottomless_tree() {
    let deep = KdTreeSettings { max_depth: u32::MAX, ..KdTreeSettings::default() };
    for upper in [[1.0, 1.0, 1.0], [1.0, 1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 0.0]] {
        let items = (0..500).map(|i| KdItem::new(i, [0.0; 3], upper).unwrap());
        let tree = KdTree3D::with_settings(items, &deep).unwrap();
        assert_eq!(leaves(&tree), [500]);
        assert_eq!(tree.items_containing([0.0; 3]).len(), 500);
        assert_eq!(tree.items_containing(upper).len(), 500);
    }
}

#[test]
fn separate_items_are_told_apart_at_any_scale_and_on_a_line() {
    // The scales reach to where squares overflow or vanish. Along a diagonal three planes halve a node once.
    let deep = KdTreeSettings { max_depth: 64, ..KdTreeSettings::default() };
    for scale in [1.0, 1e-300, f64::MIN_POSITIVE / 1024.0, 1e300] {
        for flat in [[1.0, 1.0, 1.0], [1.0, 1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1e-200, 1.0]] {
            let corner = |i: u32, add: f64| flat.map(|f| f * scale * (f64::from(2 * i) + add));
            let items = (0..300).map(|i| KdItem::new(i, corner(i, 0.0), corner(i, 1.0)).unwrap());
            let tree = KdTree3D::with_settings(items, &deep).unwrap();
            let most = leaves(&tree).into_iter().max().unwrap();
            assert!(most <= 2, "{most} items in a leaf at scale {scale}, {flat:?}");
            for i in 0..300 {
                assert_eq!(tree.items_containing(corner(i, 1.0)), [i]);
            }
        }
    }
    let row =
        (0..300).map(|i| KdItem::new(i, [0.0, 2.0 * f64::from(i)], [0.0, 2.0 * f64::from(i) + 1.0]).unwrap());
    assert!(leaves(&KdTree2D::new(row).unwrap()).into_iter().all(|count| count <= 2));
}

#[test]
fn no_tree_is_deeper_than_the_limit() {
    // Each box holds all that follow: planes cut off few at a time.
    let size = |i: i32| [0.7f64.powi(i); 2];
    let items: Vec<_> = (0..1900).map(|i| KdItem::new(i as u32, [0.0; 2], size(i)).unwrap()).collect();
    // 8 + 1.3 ln 1900 = 17.8
    for (max_depth, limit) in [(u32::MAX, 256), (40, 40), (3, 3), (0, 18)] {
        let settings = KdTreeSettings { max_depth, hit_cost: 1e6, ..KdTreeSettings::default() };
        let tree = KdTree2D::with_settings(items.clone(), &settings).unwrap();
        let mut depths = vec![0; tree.nodes.len()];
        for (index, node) in tree.nodes.iter().enumerate() {
            if let Node::Branch { upper, .. } = *node {
                depths[index + 1] = depths[index] + 1;
                depths[upper as usize] = depths[index] + 1;
            }
        }
        assert_eq!(depths.into_iter().max(), Some(limit), "{max_depth}");
        assert_eq!(tree.items_containing(items[300].upper()).len(), 301);
    }
}

#[test]
fn settings_shape_the_tree() {
    let items: Vec<KdItem<3>> = random_items(&mut Rng::new(3), 400, false);
    let with = |settings| KdTree::with_settings(items.clone(), &settings).unwrap();
    let usual = KdTreeSettings::default();
    let default = with(usual);
    assert_eq!(with(KdTreeSettings { min_items: 1000, ..usual }).nodes.len(), 1);
    assert!(with(KdTreeSettings { hit_cost: 1.0, ..usual }).nodes.len() < default.nodes.len());
    let empty = |tree: &KdTree<3>| leaves(tree).into_iter().filter(|&count| count == 0).count();
    assert!(empty(&with(KdTreeSettings { empty_bonus: 0.0, ..usual })) < empty(&default));
    assert!(KdTree::with_settings(items.clone(), &KdTreeSettings { empty_bonus: 2.0, ..usual }).is_err());
}
