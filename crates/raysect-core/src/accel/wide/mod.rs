//! A tree with eight children to a node, tested side by side in single precision.
//!
//! Culling never loses a hit: boxes are rounded outward, the ray is brought to where its line enters the root box and
//! into a frame in which the boxes fit into −1 … 1, and what single precision does to it there is added to every box.
//! What lies in the leaves is tested by others, in double precision.

mod build;
mod ray;
mod walk;

pub use ray::TreeRay;
pub use walk::{LeafTest, TraversalStack};

use crate::BoundingBox3D;

/// Children of a node.
pub const WIDTH: usize = 8;
/// Items in a leaf at most: as many as are tested side by side in double precision.
pub const LEAF_ITEMS: usize = 4;
/// Stands where a leaf has no more items.
pub const NO_ITEM: u32 = u32::MAX;

/// The boxes of the children of a node, axis by axis, and where they are; four lines of the cache.
#[derive(Debug, Clone, Copy)]
#[repr(align(64))]
struct WideNode {
    /// Lower and upper coordinates in the frame of the tree.
    planes: [[[f32; WIDTH]; 3]; 2],
    children: [Child; WIDTH],
}

/// A node or, with the highest bit, a leaf.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
struct Child(u32);

const LEAF_BIT: u32 = 1 << 31;

impl Child {
    /// Fills the places that a node does not need; its box is met by nothing.
    const NONE: Self = Self(LEAF_BIT - 1);

    fn leaf(index: u32) -> Self {
        Self(index | LEAF_BIT)
    }

    #[inline(always)]
    fn as_leaf(self) -> Option<u32> {
        (self.0 & LEAF_BIT != 0).then_some(self.0 & !LEAF_BIT)
    }
}

/// Maps the root box into −1 … 1 by a shift and a power of two.
#[derive(Debug, Clone, Copy)]
struct TreeFrame {
    centre: [f64; 3],
    scale: f64,
}

/// A hierarchy of boxes, built by the surface area heuristic in parallel and laid out for vector instructions
/// (I. Wald, C. Benthin, S. Boulos, *Getting Rid of Packets*, IEEE Symposium on Interactive Ray Tracing 2008).
///
/// Which items a ray is tested with depends neither on the number of threads that built the tree nor on the vector
/// instructions that walk it.
#[derive(Debug, Clone)]
pub struct WideTree {
    bounds: BoundingBox3D,
    frame: TreeFrame,
    nodes: Vec<WideNode>,
    leaves: Vec<[u32; LEAF_ITEMS]>,
    root: Child,
    /// Nodes on the longest way from the root to a leaf.
    depth: usize,
}

impl WideTree {
    /// The items of every leaf, filled up with [`NO_ITEM`].
    pub fn leaves(&self) -> &[[u32; LEAF_ITEMS]] {
        &self.leaves
    }

    /// The box around everything [m].
    pub fn bounds(&self) -> BoundingBox3D {
        self.bounds
    }

    /// Bytes that it takes.
    pub fn bytes(&self) -> usize {
        size_of_val(self.nodes.as_slice()) + size_of_val(self.leaves.as_slice())
    }

    /// How many nodes it has.
    pub fn node_count(&self) -> usize {
        self.nodes.len()
    }
}

#[cfg(test)]
mod tests;
