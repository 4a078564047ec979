//! Building by binned surface area heuristic (I. Wald, *On fast Construction of SAH-based Bounding Volume
//! Hierarchies*, IEEE Symposium on Interactive Ray Tracing 2007).

use rayon::prelude::*;

use super::{Child, LEAF_ITEMS, NO_ITEM, TreeFrame, WIDTH, WideNode, WideTree};
use crate::BoundingBox3D;

const BINS: usize = 16;
/// From so many items on the children of a node are built in parallel.
const PARALLEL: usize = 2048;
/// From so many items on the boxes are counted in parallel.
const PARALLEL_COUNT: usize = 1 << 16;
/// Above this depth nodes are split by the heuristic, below it in the middle, which ends soon.
const MAX_SAH_DEPTH: usize = 40;

/// A box in the frame of the tree, rounded outward, and its item.
#[derive(Debug, Clone, Copy)]
struct Item {
    low: [f32; 3],
    high: [f32; 3],
    number: u32,
}

/// A box that grows.
#[derive(Debug, Clone, Copy)]
struct Extent {
    low: [f32; 3],
    high: [f32; 3],
}

impl Extent {
    const EMPTY: Self = Self { low: [f32::INFINITY; 3], high: [f32::NEG_INFINITY; 3] };

    #[inline]
    fn include(&mut self, low: &[f32; 3], high: &[f32; 3]) {
        for a in 0..3 {
            self.low[a] = if low[a] < self.low[a] { low[a] } else { self.low[a] };
            self.high[a] = if high[a] > self.high[a] { high[a] } else { self.high[a] };
        }
    }

    /// Half of the surface area; 0 of nothing.
    #[inline]
    fn half_area(&self) -> f32 {
        let [x, y, z] = [0, 1, 2].map(|a| (self.high[a] - self.low[a]).max(0.0));
        x * y + y * z + z * x
    }
}

impl Item {
    /// Twice the centre.
    #[inline]
    fn centre(&self, axis: usize) -> f32 {
        self.low[axis] + self.high[axis]
    }
}

/// Boxes of the items and of their doubled centres.
#[derive(Debug, Clone, Copy)]
struct Spread {
    boxes: Extent,
    centres: Extent,
}

impl Spread {
    const EMPTY: Self = Self { boxes: Extent::EMPTY, centres: Extent::EMPTY };

    fn of(items: &[Item]) -> Self {
        let sequential = |items: &[Item]| {
            items.iter().fold(Self::EMPTY, |mut s, item| {
                s.boxes.include(&item.low, &item.high);
                let centre = [0, 1, 2].map(|a| item.centre(a));
                s.centres.include(&centre, &centre);
                s
            })
        };
        if items.len() < PARALLEL_COUNT {
            return sequential(items);
        }
        items.par_chunks(PARALLEL_COUNT / 4).map(sequential).reduce(|| Self::EMPTY, Self::with)
    }

    fn with(mut self, other: Self) -> Self {
        self.boxes.include(&other.boxes.low, &other.boxes.high);
        self.centres.include(&other.centres.low, &other.centres.high);
        self
    }
}

/// What falls into the bins of each axis.
#[derive(Clone, Copy)]
struct Histogram([[(Extent, u32); BINS]; 3]);

/// Which bin a centre falls into.
#[derive(Clone, Copy)]
struct Binning {
    low: [f32; 3],
    factor: [f32; 3],
}

impl Binning {
    fn new(centres: &Extent) -> Self {
        let factor = [0, 1, 2].map(|a| {
            let factor = BINS as f32 * (1.0 - 1e-6) / (centres.high[a] - centres.low[a]);
            if factor.is_finite() { factor } else { 0.0 }
        });
        Self { low: centres.low, factor }
    }

    #[inline]
    fn bin(&self, item: &Item, axis: usize) -> usize {
        (((item.centre(axis) - self.low[axis]) * self.factor[axis]) as usize).min(BINS - 1)
    }
}

impl Histogram {
    const EMPTY: Self = Self([[(Extent::EMPTY, 0); BINS]; 3]);

    fn of(items: &[Item], binning: Binning) -> Self {
        let sequential = |items: &[Item]| {
            let mut h = Self::EMPTY;
            for item in items {
                for axis in 0..3 {
                    let (extent, count) = &mut h.0[axis][binning.bin(item, axis)];
                    extent.include(&item.low, &item.high);
                    *count += 1;
                }
            }
            h
        };
        if items.len() < PARALLEL_COUNT {
            return sequential(items);
        }
        items.par_chunks(PARALLEL_COUNT / 4).map(sequential).reduce(|| Self::EMPTY, Self::with)
    }

    fn with(mut self, other: Self) -> Self {
        for (mine, its) in self.0.iter_mut().flatten().zip(other.0.iter().flatten()) {
            mine.0.include(&its.0.low, &its.0.high);
            mine.1 += its.1;
        }
        self
    }

    /// Axis and first bin of the upper part of the cheapest split: the one with the least sum of area times groups of
    /// items that are tested together.
    fn best(&self) -> Option<(usize, usize)> {
        let mut best: Option<(f32, usize, usize)> = None;
        for (axis, bins) in self.0.iter().enumerate() {
            let mut above = [(0.0f32, 0u32); BINS];
            let (mut extent, mut count) = (Extent::EMPTY, 0);
            for at in (1..BINS).rev() {
                extent.include(&bins[at].0.low, &bins[at].0.high);
                count += bins[at].1;
                above[at] = (extent.half_area(), count);
            }
            let (mut extent, mut count) = (Extent::EMPTY, 0);
            for at in 1..BINS {
                extent.include(&bins[at - 1].0.low, &bins[at - 1].0.high);
                count += bins[at - 1].1;
                let groups = |n: u32| n.div_ceil(LEAF_ITEMS as u32) as f32;
                let cost = extent.half_area() * groups(count) + above[at].0 * groups(above[at].1);
                if count > 0 && above[at].1 > 0 && best.is_none_or(|(c, _, _)| cost < c) {
                    best = Some((cost, axis, at));
                }
            }
        }
        best.map(|(_, axis, at)| (axis, at))
    }
}

/// Moves the items that belong below to the front; answers with their number. Keeps their order.
fn split(items: &mut [Item], spread: &Spread, depth: usize) -> usize {
    let binning = Binning::new(&spread.centres);
    let best = (depth < MAX_SAH_DEPTH).then(|| Histogram::of(items, binning).best()).flatten();
    let Some((axis, at)) = best else { return items.len() / 2 };
    let (below, above): (Vec<Item>, Vec<Item>) =
        items.iter().copied().partition(|item| binning.bin(item, axis) < at);
    items[..below.len()].copy_from_slice(&below);
    items[below.len()..].copy_from_slice(&above);
    below.len()
}

/// A part of the tree with numbers of its own.
#[derive(Default)]
struct Arena {
    nodes: Vec<WideNode>,
    leaves: Vec<[u32; LEAF_ITEMS]>,
}

impl Arena {
    fn leaf(&mut self, items: &[Item]) -> Child {
        let leaf = std::array::from_fn(|i| items.get(i).map_or(NO_ITEM, |item| item.number));
        self.leaves.push(leaf);
        Child::leaf((self.leaves.len() - 1) as u32)
    }

    /// Takes over another part; answers with what its child is called here.
    fn append(&mut self, part: Self, child: Child) -> Child {
        let (nodes, leaves) = (self.nodes.len() as u32, self.leaves.len() as u32);
        let renamed = |c: Child| match c.as_leaf() {
            Some(leaf) => Child::leaf(leaf + leaves),
            None if c == Child::NONE => c,
            None => Child(c.0 + nodes),
        };
        self.nodes.extend(part.nodes.into_iter().map(|mut node| {
            node.children.iter_mut().for_each(|c| *c = renamed(*c));
            node
        }));
        self.leaves.extend(part.leaves);
        renamed(child)
    }

    fn build(&mut self, items: &mut [Item], spread: Spread, depth: usize) -> Child {
        if items.len() <= LEAF_ITEMS {
            return self.leaf(items);
        }
        let parts = children(items, spread, depth);
        let index = self.nodes.len();
        self.nodes.push(WideNode::new(&parts));
        let found: Vec<Child> = if items.len() < PARALLEL {
            let mut rest = items;
            let mut found = Vec::with_capacity(WIDTH);
            for part in &parts {
                let (mine, after) = rest.split_at_mut(part.count);
                found.push(self.build(mine, part.spread, depth + 1));
                rest = after;
            }
            found
        } else {
            let mut slices = Vec::with_capacity(WIDTH);
            let mut rest = items;
            for part in &parts {
                let (mine, after) = rest.split_at_mut(part.count);
                slices.push((mine, part.spread));
                rest = after;
            }
            let built: Vec<(Self, Child)> = slices
                .into_par_iter()
                .map(|(items, spread)| {
                    let mut arena = Self::default();
                    let child = arena.build(items, spread, depth + 1);
                    (arena, child)
                })
                .collect();
            built.into_iter().map(|(arena, child)| self.append(arena, child)).collect()
        };
        self.nodes[index].children[..found.len()].copy_from_slice(&found);
        Child(index as u32)
    }
}

/// Consecutive items that become one child.
#[derive(Clone, Copy)]
struct Part {
    count: usize,
    spread: Spread,
}

/// Splits items into the children of a node: the largest part again and again.
fn children(items: &mut [Item], spread: Spread, depth: usize) -> Vec<Part> {
    let mut parts = Vec::with_capacity(WIDTH);
    parts.push(Part { count: items.len(), spread });
    while parts.len() < WIDTH {
        let divisible = parts.iter().enumerate().filter(|(_, p)| p.count > LEAF_ITEMS);
        let largest = divisible
            .max_by(|a, b| a.1.spread.boxes.half_area().total_cmp(&b.1.spread.boxes.half_area()))
            .map(|(i, _)| i);
        let Some(chosen) = largest else { break };
        let start: usize = parts[..chosen].iter().map(|p| p.count).sum();
        let Part { count, spread } = parts[chosen];
        let mine = &mut items[start..start + count];
        let middle = split(mine, &spread, depth);
        let (below, above) = mine.split_at(middle);
        parts[chosen] = Part { count: middle, spread: Spread::of(below) };
        parts.insert(chosen + 1, Part { count: count - middle, spread: Spread::of(above) });
    }
    parts
}

impl WideNode {
    fn new(parts: &[Part]) -> Self {
        let mut planes = [[[f32::INFINITY; WIDTH]; 3], [[f32::NEG_INFINITY; WIDTH]; 3]];
        for (lane, part) in parts.iter().enumerate() {
            for axis in 0..3 {
                planes[0][axis][lane] = part.spread.boxes.low[axis];
                planes[1][axis][lane] = part.spread.boxes.high[axis];
            }
        }
        Self { planes, children: [Child::NONE; WIDTH] }
    }
}

impl TreeFrame {
    fn of(bounds: &BoundingBox3D) -> Self {
        let centre = bounds.centre().to_array();
        let half = 0.5 * bounds.largest_extent();
        // The next power of two above half the extent; a tree of points has a frame as well.
        let exponent = if half > 0.0 { half.log2().floor() as i32 + 1 } else { 0 };
        let scale = 2f64.powi(-exponent.clamp(-1000, 1000));
        Self { centre, scale }
    }

    /// A coordinate in the frame.
    pub(super) fn map(&self, x: f64, axis: usize) -> f64 {
        (x - self.centre[axis]) * self.scale
    }

    fn item(&self, number: usize, b: &BoundingBox3D) -> Item {
        let (low, high) = (b.lower.to_array(), b.upper.to_array());
        Item {
            low: [0, 1, 2].map(|a| round_down(self.map(low[a], a))),
            high: [0, 1, 2].map(|a| round_up(self.map(high[a], a))),
            number: number as u32,
        }
    }
}

/// The largest single-precision number that is not above `x`.
pub(super) fn round_down(x: f64) -> f32 {
    let near = x as f32;
    if f64::from(near) > x { near.next_down() } else { near }
}

/// The smallest single-precision number that is not below `x`.
pub(super) fn round_up(x: f64) -> f32 {
    -round_down(-x)
}

/// Nodes on the longest way down. Children come after their parents, so that one pass from the back tells.
fn depth(nodes: &[WideNode], root: Child) -> usize {
    let mut below = vec![1usize; nodes.len()];
    for (index, node) in nodes.iter().enumerate().rev() {
        let inner = node.children.iter().filter(|c| c.as_leaf().is_none() && **c != Child::NONE);
        below[index] = 1 + inner.map(|c| below[c.0 as usize]).max().unwrap_or(0);
    }
    if root.as_leaf().is_some() { 0 } else { below.get(root.0 as usize).copied().unwrap_or(0) }
}

impl WideTree {
    /// Over the boxes of up to 2³¹ items [m]; empty boxes are left out.
    pub fn new(boxes: &[BoundingBox3D]) -> Self {
        let bounds = if boxes.len() < PARALLEL_COUNT {
            boxes.iter().fold(BoundingBox3D::EMPTY, |all, b| all.union(b))
        } else {
            boxes.par_iter().copied().reduce(|| BoundingBox3D::EMPTY, |a, b| a.union(&b))
        };
        let frame = TreeFrame::of(&if bounds.is_empty() { BoundingBox3D::default() } else { bounds });
        let mut items: Vec<Item> = boxes
            .par_iter()
            .with_min_len(PARALLEL)
            .enumerate()
            .filter(|(_, b)| !b.is_empty())
            .map(|(number, b)| frame.item(number, b))
            .collect();
        let mut arena = Arena::default();
        let spread = Spread::of(&items);
        let root = arena.build(&mut items, spread, 0);
        let depth = depth(&arena.nodes, root);
        Self { bounds, frame, nodes: arena.nodes, leaves: arena.leaves, root, depth }
    }
}
