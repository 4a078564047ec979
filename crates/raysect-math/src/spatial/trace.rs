//! The way of a ray through a tree.

use super::item::FARTHEST;
use super::kdtree::{KdTree, Node};

/// Bounds of the quotient of a difference, which carries two roundings.
const DOWN: f64 = 1.0 - 2.0 * f64::EPSILON;
const UP: f64 = 1.0 + 2.0 * f64::EPSILON;

impl<const N: usize> KdTree<N> {
    /// Lends `visit` the items of all leaves on the way of a ray, the nearest leaf first, from its origin up to
    /// `max_distance` in lengths of its direction. Returns what is left of that: the distance of the nearest hit.
    ///
    /// `visit` is given the numbers of the items of one leaf, and the largest distance that is still of interest. It
    /// tests the items and returns the distance of the nearest hit, or the distance that it was given; leaves beyond
    /// it are not visited. A negative number ends the search.
    ///
    /// Each item whose closed box the ray meets in the interval is lent once at least, also by rays in a plane of the
    /// tree, with components of zero, or that only touch an edge; and again for each leaf that it reaches into. A hit
    /// counts wherever it lies: it may be beyond the leaf. A ray that is not finite, or begins beyond 8.98e307, meets
    /// nothing; one whose direction is zero stays in its origin. No memory is allocated.
    ///
    /// The order of the leaves and its bounds are those of *Physically Based Rendering*, 3rd ed., § 4.4.2, with the
    /// distance of a plane taken from both ends of its rounding.
    pub fn trace(
        &self,
        origin: impl Into<[f64; N]>,
        direction: impl Into<[f64; N]>,
        max_distance: f64,
        visit: impl FnMut(&[u32], f64) -> f64,
    ) -> f64 {
        let (origin, direction) = (origin.into(), direction.into());
        let mut walk = Walk { tree: self, origin, direction, limit: max_distance, visit };
        if let Some([near, far]) = walk.enter() {
            walk.node(0, near, far);
        }
        walk.limit
    }
}

struct Walk<'a, const N: usize, V> {
    tree: &'a KdTree<N>,
    origin: [f64; N],
    direction: [f64; N],
    limit: f64,
    visit: V,
}

impl<const N: usize, V: FnMut(&[u32], f64) -> f64> Walk<'_, N, V> {
    /// The part of the ray that may lie in the bounds of the tree.
    fn enter(&self) -> Option<[f64; 2]> {
        let finite =
            (0..N).all(|axis| self.origin[axis].abs() <= FARTHEST && self.direction[axis].is_finite());
        if !finite || self.tree.is_empty() {
            return None;
        }
        let (mut near, mut far) = (0.0f64, self.limit);
        for axis in 0..N {
            let (o, d) = (self.origin[axis], self.direction[axis]);
            let (lower, upper) = (self.tree.lower[axis], self.tree.upper[axis]);
            if d == 0.0 {
                if o < lower || o > upper {
                    return None;
                }
                continue;
            }
            let (first, last) = if d > 0.0 { (lower, upper) } else { (upper, lower) };
            near = near.max((first - o) / d * DOWN);
            far = far.min((last - o) / d * UP);
        }
        // A limit that is NaN fails here too: the minimum of it and a number would not show it.
        (near <= far && self.limit >= 0.0).then_some([near, far])
    }

    /// Visits the leaves below a node, of which the ray sees the part from `near` to `far`.
    fn node(&mut self, mut index: usize, mut near: f64, mut far: f64) {
        loop {
            match self.tree.nodes[index] {
                Node::Leaf { start, count } => {
                    let ids = &self.tree.entries[start..start + count as usize];
                    if !ids.is_empty() {
                        // If the answer is NaN, the limit stays.
                        self.limit = self.limit.min((self.visit)(ids, self.limit));
                    }
                    return;
                }
                Node::Branch { axis, split, upper } => {
                    let axis = usize::from(axis);
                    let (o, d) = (self.origin[axis], self.direction[axis]);
                    let (lower, upper) = (index + 1, upper as usize);
                    if d == 0.0 && o != split {
                        index = if o < split { lower } else { upper };
                        continue;
                    }
                    let (first, second) = if d >= 0.0 { (lower, upper) } else { (upper, lower) };
                    // A ray in the plane sees both sides from end to end.
                    let [leave, reach] = if d == 0.0 {
                        [far, near]
                    } else {
                        let distance = (split - o) / d;
                        [distance * UP, distance * DOWN]
                    };
                    if leave < near {
                        index = second;
                    } else if reach > far {
                        index = first;
                    } else {
                        self.node(first, near, far.min(leave));
                        near = near.max(reach);
                        far = far.min(self.limit);
                        if near > far {
                            return;
                        }
                        index = second;
                    }
                }
            }
        }
    }
}
