use fearless_simd::{Simd, f32x8, prelude::*};

use super::{Child, NO_ITEM, TreeRay, WIDTH, WideTree};

/// What is to be done in the leaves that a ray meets.
pub trait LeafTest<S: Simd> {
    /// Tests the items of a leaf; answers with the limit beyond which nothing is wanted any more, as
    /// [`TreeRay::limit`] counts it; negative infinity ends the walk.
    fn leaf(&mut self, simd: S, leaf: u32, limit: f32) -> f32;
}

/// A child that waits for its turn, and the distance at which its box is met.
#[derive(Debug, Clone, Copy, Default)]
struct Waiting(Child, f32);

/// So many children wait in place, which is enough for a tree of nine levels.
const IN_PLACE: usize = 64;

/// Room for one walk, reused or made anew: it takes from the heap for trees deeper than usual only.
#[derive(Debug)]
pub struct TraversalStack {
    near: [Waiting; IN_PLACE],
    far: Vec<Waiting>,
}

impl Default for TraversalStack {
    fn default() -> Self {
        Self { near: [Waiting::default(); IN_PLACE], far: Vec::new() }
    }
}

impl TraversalStack {
    /// Room for so many children.
    #[inline(always)]
    fn room(&mut self, size: usize) -> &mut [Waiting] {
        if size <= IN_PLACE {
            return &mut self.near;
        }
        if self.far.len() < size {
            self.far.resize(size, Waiting::default());
        }
        &mut self.far
    }
}

/// A ray in every lane.
struct Lanes<S: Simd> {
    inverse: [f32x8<S>; 3],
    near: [f32x8<S>; 3],
    far: [f32x8<S>; 3],
    min: f32x8<S>,
}

/// A number in every lane, for each axis. Written out: closures would be compiled without the vector instructions.
#[inline(always)]
fn splat<S: Simd>(simd: S, v: [f32; 3]) -> [f32x8<S>; 3] {
    [f32x8::splat(simd, v[0]), f32x8::splat(simd, v[1]), f32x8::splat(simd, v[2])]
}

impl<S: Simd> Lanes<S> {
    #[inline(always)]
    fn new(simd: S, ray: &TreeRay) -> Self {
        Self {
            inverse: splat(simd, ray.inverse),
            near: splat(simd, ray.near),
            far: splat(simd, ray.far),
            min: f32x8::splat(simd, ray.min),
        }
    }
}

impl WideTree {
    /// Shows `test` every leaf that may hold what a ray meets, nearer ones first as far as their boxes tell.
    #[inline(always)]
    pub fn walk<S: Simd, T: LeafTest<S>>(
        &self,
        simd: S,
        ray: &TreeRay,
        mut limit: f32,
        stack: &mut TraversalStack,
        test: &mut T,
    ) {
        // Every level leaves all children but one behind.
        let stack = stack.room((WIDTH - 1) * self.depth + 1);
        let lanes = Lanes::new(simd, ray);
        let mut height = 0;
        let mut child = self.root;
        'next: loop {
            if let Some(leaf) = child.as_leaf() {
                limit = test.leaf(simd, leaf, limit);
            } else if let Some(node) = self.nodes.get(child.0 as usize) {
                // The boxes of all children at once; NaN does not occur, since every inverse is finite.
                let (mut first, mut last) = (lanes.min, f32x8::splat(simd, limit));
                for a in 0..3 {
                    let plane = |far: bool| {
                        f32x8::from_slice(simd, &node.planes[usize::from(ray.backward[a] != far)][a])
                    };
                    first = first.max(plane(false) * lanes.inverse[a] + lanes.near[a]);
                    last = last.min(plane(true) * lanes.inverse[a] + lanes.far[a]);
                }
                let mut met = first.simd_le(last).to_bitmask();
                if met != 0 {
                    let first: [f32; WIDTH] = first.into();
                    let base = height;
                    let mut nearest = met.trailing_zeros() as usize % WIDTH;
                    met &= met - 1;
                    while met != 0 {
                        let mut lane = met.trailing_zeros() as usize % WIDTH;
                        met &= met - 1;
                        if first[lane] < first[nearest] {
                            std::mem::swap(&mut lane, &mut nearest);
                        }
                        // The others wait in order, the nearest on top.
                        let mut at = height;
                        while at > base && stack[at - 1].1 < first[lane] {
                            stack[at] = stack[at - 1];
                            at -= 1;
                        }
                        stack[at] = Waiting(node.children[lane], first[lane]);
                        height += 1;
                    }
                    child = node.children[nearest];
                    continue 'next;
                }
            }
            loop {
                if height == 0 {
                    return;
                }
                height -= 1;
                let Waiting(waiting, near) = stack[height];
                if near <= limit {
                    child = waiting;
                    continue 'next;
                }
            }
        }
    }

    /// Calls `found` with every item in whose box a point may lie.
    pub(in crate::accel) fn around(&self, point: [f64; 3], mut found: impl FnMut(u32)) {
        let p = [0, 1, 2].map(|a| self.frame.map(point[a], a));
        let mut waiting = vec![self.root];
        while let Some(child) = waiting.pop() {
            if let Some(leaf) = child.as_leaf() {
                self.leaves[leaf as usize].iter().filter(|&&i| i != NO_ITEM).for_each(|&i| found(i));
                continue;
            }
            let Some(node) = self.nodes.get(child.0 as usize) else { continue };
            let holds = |lane: usize| {
                (0..3).all(|a| {
                    let within = |side: usize| f64::from(node.planes[side][a][lane]);
                    p[a] >= within(0) && p[a] <= within(1)
                })
            };
            waiting.extend((0..WIDTH).filter(|&lane| holds(lane)).map(|lane| node.children[lane]));
        }
    }
}
