//! Trees that Raysect 0.9.1 has saved.

use raysect_math::spatial::{KdItem, KdTree, KdTree2D, KdTree3D, KdTreeSettings};

const SAVED_3D: &[u8] = include_bytes!("data/kdtree_raysect_3d.bin");
const SAVED_2D: &[u8] = include_bytes!("data/kdtree_raysect_2d.bin");

/// The generator of D. E. Knuth and H. W. Lewis (*Numerical Recipes*, 2nd ed., § 7.1), simple enough to be the same in
/// any language.
struct Congruential(u32);

impl Congruential {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        f64::from(self.0) / 4_294_967_296.0
    }

    fn item<const N: usize>(&mut self, id: u32) -> KdItem<N> {
        let lower: [f64; N] = std::array::from_fn(|_| 10.0 * self.next());
        KdItem::new(id, lower, lower.map(|x| x + 2.0 * self.next())).unwrap()
    }
}

/// The boxes of the two files.
fn items() -> (Vec<KdItem<3>>, Vec<KdItem<2>>) {
    let mut numbers = Congruential(2026);
    let space = (0..40).map(|i| numbers.item(i)).collect();
    (space, (0..60).map(|i| numbers.item(10 * i)).collect())
}

fn written<const N: usize>(tree: &KdTree<N>) -> Vec<u8> {
    let mut bytes = Vec::new();
    tree.write(&mut bytes).unwrap();
    bytes
}

#[test]
fn trees_of_raysect_are_read_and_written_again() {
    let (space, plane) = items();
    assert_eq!(written(&KdTree3D::read(&mut &*SAVED_3D, space).unwrap()), SAVED_3D);
    assert_eq!(written(&KdTree2D::read(&mut &*SAVED_2D, plane).unwrap()), SAVED_2D);
}

#[test]
fn the_same_boxes_give_the_same_tree_as_in_raysect() {
    let (space, plane) = items();
    assert_eq!(written(&KdTree3D::new(space).unwrap()), SAVED_3D);
    let settings = KdTreeSettings { max_depth: 20, min_items: 2, hit_cost: 5.0, empty_bonus: 0.3 };
    assert_eq!(written(&KdTree2D::with_settings(plane.clone(), &settings).unwrap()), SAVED_2D);
    // Negative control: other settings make another tree.
    let other = KdTreeSettings { hit_cost: 3.0, ..settings };
    assert_ne!(written(&KdTree2D::with_settings(plane, &other).unwrap())[16..], SAVED_2D[16..]);
}

#[test]
fn a_tree_read_in_the_middle_of_a_stream_leaves_the_rest() {
    let (space, _) = items();
    let bytes = [SAVED_3D, b"next"].concat();
    let mut stream = &bytes[..];
    let tree = KdTree3D::read(&mut stream, space.clone()).unwrap();
    assert_eq!(stream, b"next");
    for item in &space {
        assert!(tree.items_containing(item.lower()).contains(&item.id()));
    }
}
