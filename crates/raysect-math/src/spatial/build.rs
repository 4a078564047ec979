//! Where the planes of a tree are put.

use super::kdtree::{KdTree, Node};
use super::settings::Resolved;
use super::{KdItem, KdTreeSettings};

/// The stored form counts nodes in 31 bits; no memory holds so many.
const MOST_NODES: usize = 1 << 30;

pub(super) fn build<const N: usize>(items: Vec<KdItem<N>>, settings: Resolved) -> KdTree<N> {
    let (mut lower, mut upper) = ([f64::INFINITY; N], [f64::NEG_INFINITY; N]);
    for item in &items {
        for axis in 0..N {
            lower[axis] = lower[axis].min(item.lower()[axis]);
            upper[axis] = upper[axis].max(item.upper()[axis]);
        }
    }
    let root = Cell { members: items.clone(), lower, upper, depth: 0, parent: None };
    let mut builder = Builder { settings, edges: Edges::default() };
    let (nodes, entries) = builder.grow(root);
    KdTree { items, settings, lower, upper, nodes, entries }
}

/// A node to be: a box, and copies of the items that reach into it (side by side, as they are read at every level).
struct Cell<const N: usize> {
    members: Vec<KdItem<N>>,
    lower: [f64; N],
    upper: [f64; N],
    depth: i32,
    /// The branch whose upper child this is.
    parent: Option<usize>,
}

impl<const N: usize> Cell<N> {
    /// Half of the extent along an axis, which cannot overflow.
    fn half_extent(&self, axis: usize) -> f64 {
        0.5 * self.upper[axis] - 0.5 * self.lower[axis]
    }

    /// How a plane across an axis divides the surface.
    fn division(&self, axis: usize) -> Division<'_, N> {
        let longest = (0..N).map(|i| self.half_extent(i)).fold(f64::MIN_POSITIVE, f64::max);
        // Its exponent alone: a unit that costs no digits.
        let unit = f64::from_bits(longest.to_bits() & f64::INFINITY.to_bits());
        let mut division = Division { cell: self, axis, unit, inverse: 0.0, line: false };
        division.inverse = division.surface(&self.lower, &self.upper).recip();
        if !division.inverse.is_finite() {
            division.line = true;
            division.inverse = division.surface(&self.lower, &self.upper).recip();
        }
        division
    }
}

/// Surfaces of the pieces of a cell, in units in which they neither overflow nor vanish.
struct Division<'a, const N: usize> {
    cell: &'a Cell<N>,
    axis: usize,
    unit: f64,
    /// One over the surface of the cell.
    inverse: f64,
    /// True if the cell has no surface, or in a plane no area, so that lengths count.
    line: bool,
}

impl<const N: usize> Division<'_, N> {
    /// The sums and products are in the order that Raysect has them: planes of equal cost are common, and rounding
    /// tells which is taken.
    fn surface(&self, lower: &[f64; N], upper: &[f64; N]) -> f64 {
        let edge = |i: usize| (0.5 * upper[i] - 0.5 * lower[i]) / self.unit;
        match N {
            _ if self.line => edge(self.axis),
            3 => 2.0 * (edge(0) * edge(1) + edge(0) * edge(2) + edge(1) * edge(2)),
            _ => (0..N).map(edge).product(),
        }
    }

    /// Items to be tested on average for what meets the cell, if there are so many below and above the plane, times the
    /// bonus.
    fn hits(&self, at: f64, below: usize, above: usize, bonus: f64) -> f64 {
        let Cell { mut lower, mut upper, .. } = *self.cell;
        upper[self.axis] = at;
        let first = self.surface(&self.cell.lower, &upper);
        lower[self.axis] = at;
        let second = self.surface(&lower, &self.cell.upper);
        bonus * (first * below as f64 + second * above as f64) * self.inverse
    }
}

struct Split {
    axis: usize,
    at: f64,
    /// Items below and above.
    counts: [usize; 2],
}

/// The ends of boxes along an axis, ascending; kept for the next node.
#[derive(Default)]
struct Edges {
    lower: Vec<f64>,
    upper: Vec<f64>,
    flat: Vec<f64>,
}

struct Builder {
    settings: Resolved,
    edges: Edges,
}

impl Builder {
    /// Nodes in preorder and the entries of the leaves.
    fn grow<const N: usize>(&mut self, root: Cell<N>) -> (Vec<Node>, Vec<u32>) {
        let (mut nodes, mut entries): (Vec<Node>, Vec<u32>) = (Vec::new(), Vec::new());
        let mut open = vec![root];
        while let Some(cell) = open.pop() {
            let index = nodes.len();
            if let Some(parent) = cell.parent
                && let Node::Branch { upper, .. } = &mut nodes[parent]
            {
                *upper = index as u32;
            }
            let split = if index < MOST_NODES { self.best_split(&cell) } else { None };
            if let Some(split) = split {
                nodes.push(Node::Branch { axis: split.axis as u8, split: split.at, upper: 0 });
                let [below, above] = divide(cell, &split, index);
                open.extend([above, below]);
            } else {
                nodes.push(Node::Leaf { start: entries.len(), count: cell.members.len() as u32 });
                entries.extend(cell.members.iter().map(KdItem::id));
            }
        }
        (nodes, entries)
    }

    /// The best plane along the longest axis, or along the next if there is none; none if a leaf is cheaper.
    fn best_split<const N: usize>(&mut self, cell: &Cell<N>) -> Option<Split> {
        let deepest = self.settings.max_depth.min(KdTreeSettings::DEEPEST as i32);
        if cell.depth >= deepest || cell.members.len() <= self.settings.min_items as usize {
            return None;
        }
        let longest = (1..N)
            .fold(0, |best, axis| if cell.half_extent(axis) > cell.half_extent(best) { axis } else { best });
        (0..N).find_map(|next| {
            let axis = (longest + next) % N;
            self.best_along(cell, axis)
        })
    }

    /// The plane across an axis that costs least, if it costs less than a leaf.
    ///
    /// The costs are 1 + h (Aₗ nₗ + Aᵤ nᵤ) / A against h n for hit cost h, numbers of items n and areas A, with h smaller
    /// by the bonus if one side is empty. Planes are those through edges of boxes inside the cell: between them the
    /// costs are linear.
    fn best_along<const N: usize>(&mut self, cell: &Cell<N>, axis: usize) -> Option<Split> {
        let (low, high) = (cell.lower[axis], cell.upper[axis]);
        self.edges.sort(&cell.members, axis);
        let Edges { lower, upper, flat } = &self.edges;
        let Resolved { hit_cost, empty_bonus, .. } = self.settings;
        let division = cell.division(axis);
        let count = cell.members.len();
        let mut least = hit_cost * count as f64;
        let mut best = None;
        // Boxes that begin below the plane, that end at or below it, and flat ones below it.
        let (mut begun, mut ended, mut passed) = (0, 0, 0);
        while ended < count {
            let at = if begun < count { lower[begun].min(upper[ended]) } else { upper[ended] };
            if at >= high {
                break;
            }
            ended += upper[ended..].iter().take_while(|&&x| x <= at).count();
            passed += flat[passed..].iter().take_while(|&&x| x < at).count();
            let in_plane = flat[passed..].iter().take_while(|&&x| x <= at).count();
            let (below, above) = (begun + in_plane, count - ended + in_plane);
            begun += lower[begun..].iter().take_while(|&&x| x <= at).count();
            if at <= low {
                continue;
            }
            let bonus = if below == 0 || above == 0 { 1.0 - empty_bonus } else { 1.0 };
            let cost = 1.0 + division.hits(at, below, above, bonus) * hit_cost;
            if cost < least {
                least = cost;
                best = Some(Split { axis, at, counts: [below, above] });
            }
        }
        best
    }
}

/// The cells below and above a plane. A box that ends at the plane stays on its side; one that lies in it goes to both.
fn divide<const N: usize>(cell: Cell<N>, split: &Split, parent: usize) -> [Cell<N>; 2] {
    let Split { axis, at, counts } = *split;
    let [mut below, mut above] = counts.map(Vec::with_capacity);
    for item in cell.members {
        let (low, high) = (item.lower()[axis], item.upper()[axis]);
        let in_plane = low == at && high == at;
        if low < at || in_plane {
            below.push(item);
        }
        if high > at || in_plane {
            above.push(item);
        }
    }
    let (mut lower, mut upper) = (cell.lower, cell.upper);
    (lower[axis], upper[axis]) = (at, at);
    let depth = cell.depth + 1;
    [
        Cell { members: below, lower: cell.lower, upper, depth, parent: None },
        Cell { members: above, lower, upper: cell.upper, depth, parent: Some(parent) },
    ]
}

impl Edges {
    fn sort<const N: usize>(&mut self, members: &[KdItem<N>], axis: usize) {
        let Self { lower, upper, flat } = self;
        lower.clear();
        upper.clear();
        flat.clear();
        for item in members {
            let (low, high) = (item.lower()[axis], item.upper()[axis]);
            lower.push(low);
            upper.push(high);
            if low == high {
                flat.push(low);
            }
        }
        for list in [lower, upper, flat] {
            list.sort_unstable_by(f64::total_cmp);
        }
    }
}
