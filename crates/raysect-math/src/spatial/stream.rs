//! Trees as bytes, in the form that Raysect 0.9.1 writes and reads.

use std::io::{self, Read, Write};

use super::item::FARTHEST;
use super::kdtree::{KdTree, Node, find, in_order};
use super::settings::Resolved;
use super::{KdItem, KdTreeSettings};
use crate::MathError;

/// Stands where a branch has its axis.
const LEAF: i32 = -1;

impl<const N: usize> KdTree<N> {
    /// Writes the tree as Raysect does, everything in little-endian order: the settings (maximum depth and least items
    /// as `i32`, hit cost and bonus as `f64`), the lower and the upper corner of the bounds (`f64` each), the number of
    /// nodes (`i32`), and the nodes in preorder. A leaf is −1, the number of its items and their numbers, `i32` each; a
    /// branch is its axis (`i32`), its plane (`f64`) and the index of its upper child (`i32`), the lower child being
    /// the next node. The boxes of the items are not written.
    ///
    /// The stream should be buffered. More may precede and follow the tree. A tree without items has its lower corner
    /// at infinity and its upper at minus infinity; Raysect writes the same and does not read it.
    ///
    /// # Errors
    /// Those of the stream.
    #[doc(alias = "save")]
    pub fn write(&self, stream: &mut impl Write) -> io::Result<()> {
        let Resolved { max_depth, min_items, hit_cost, empty_bonus } = self.settings;
        stream.write_all(&max_depth.to_le_bytes())?;
        stream.write_all(&min_items.to_le_bytes())?;
        for value in [hit_cost, empty_bonus].into_iter().chain(self.lower).chain(self.upper) {
            stream.write_all(&value.to_le_bytes())?;
        }
        // Numbers of nodes and items are below 2³¹.
        stream.write_all(&(self.nodes.len() as u32).to_le_bytes())?;
        for node in &self.nodes {
            match *node {
                Node::Leaf { start, count } => {
                    stream.write_all(&LEAF.to_le_bytes())?;
                    stream.write_all(&count.to_le_bytes())?;
                    for id in &self.entries[start..start + count as usize] {
                        stream.write_all(&id.to_le_bytes())?;
                    }
                }
                Node::Branch { axis, split, upper } => {
                    stream.write_all(&u32::from(axis).to_le_bytes())?;
                    stream.write_all(&split.to_le_bytes())?;
                    stream.write_all(&upper.to_le_bytes())?;
                }
            }
        }
        Ok(())
    }

    /// Reads a tree over the given items, which are not in the stream, in the form of [`write`](Self::write). Exactly
    /// the bytes of the tree are read. The stream should be buffered.
    ///
    /// Whether the planes suit the boxes is not tested: a tree over other items, or one by Raysect, which leaves out
    /// flat boxes that lie in a plane, may miss some.
    ///
    /// # Errors
    /// [`MathError::KdTreeStream`] if the stream ends or fails, [`MathError::KdTreeFormat`] for anything that cannot
    /// stand in a tree over these items: settings or planes that are no numbers, bounds the wrong way round, an unknown
    /// axis or item, nodes that are not in preorder, or more than [`KdTreeSettings::DEEPEST`] branches above a leaf;
    /// [`MathError::DuplicateItem`] if two of the items have the same number.
    #[doc(alias = "load")]
    pub fn read(
        stream: &mut impl Read,
        items: impl IntoIterator<Item = KdItem<N>>,
    ) -> Result<Self, MathError> {
        let items = in_order(items)?;
        let mut fields = Fields { stream, offset: 0 };
        let settings = fields.settings()?;
        let start = fields.offset;
        let (lower, upper) = (fields.corner()?, fields.corner()?);
        let within = |x: f64| x.abs() <= FARTHEST;
        let ordered = (0..N).all(|i| lower[i] <= upper[i] && within(lower[i]) && within(upper[i]));
        let none = lower == [f64::INFINITY; N] && upper == [f64::NEG_INFINITY; N];
        if !(ordered || none && items.is_empty()) {
            return wrong(
                start,
                format!("the bounds {lower:?} … {upper:?} are none of {} items", items.len()),
            );
        }
        let mut tree = Self { items, settings, lower, upper, nodes: Vec::new(), entries: Vec::new() };
        tree.read_nodes(&mut fields)?;
        Ok(tree)
    }

    /// Nodes are taken in preorder only: then each has one parent, and no walk can go on for ever.
    fn read_nodes(&mut self, fields: &mut Fields<'_, impl Read>) -> Result<(), MathError> {
        let start = fields.offset;
        let total = fields.int()?;
        if total < 1 {
            return wrong(start, format!("{total} nodes: a tree has at least one"));
        }
        let total = total as u32;
        // Branches whose lower side is being read: where the upper child is to be, its depth, and where that was said.
        let mut open: Vec<(u32, usize, u64)> = Vec::new();
        let mut depth = 0;
        for index in 0..total {
            let start = fields.offset;
            match fields.int()? {
                LEAF => {
                    self.read_leaf(fields)?;
                    match open.pop() {
                        Some((upper, below, _)) if upper == index + 1 => depth = below,
                        Some((upper, _, at)) => {
                            return wrong(at, format!("the upper child is node {upper}, not {}", index + 1));
                        }
                        None if index + 1 == total => {}
                        None => {
                            return wrong(
                                fields.offset,
                                format!("{total} nodes, but {} make a tree", index + 1),
                            );
                        }
                    }
                }
                axis if (0..N as i32).contains(&axis) => {
                    let (split, at) = self.read_branch(fields, axis, index, total)?;
                    depth += 1;
                    if depth > KdTreeSettings::DEEPEST as usize {
                        return wrong(
                            start,
                            format!("more than {} branches above a node", KdTreeSettings::DEEPEST),
                        );
                    }
                    open.push((split, depth, at));
                }
                other => return wrong(start, format!("axis {other} of {N} dimensions (a leaf is -1)")),
            }
        }
        match open.last() {
            Some((upper, _, at)) => wrong(*at, format!("the upper child is node {upper} of {total}")),
            None => Ok(()),
        }
    }

    fn read_leaf(&mut self, fields: &mut Fields<'_, impl Read>) -> Result<(), MathError> {
        let at = fields.offset;
        let count = fields.int()?;
        if count < 0 || count as usize > self.items.len() {
            return wrong(at, format!("{count} items in a leaf of a tree over {}", self.items.len()));
        }
        let start = self.entries.len();
        for _ in 0..count {
            let at = fields.offset;
            let id = fields.int()?;
            match u32::try_from(id).ok().and_then(|id| find(&self.items, id)) {
                Some(item) => self.entries.push(item.id()),
                None => return wrong(at, format!("there is no item {id} among {}", self.items.len())),
            }
        }
        self.nodes.push(Node::Leaf { start, count: count as u32 });
        Ok(())
    }

    /// The index of the upper child, and where it stands.
    fn read_branch(
        &mut self,
        fields: &mut Fields<'_, impl Read>,
        axis: i32,
        index: u32,
        total: u32,
    ) -> Result<(u32, u64), MathError> {
        let at = fields.offset;
        let split = fields.float()?;
        if split.is_nan() || split.abs() > FARTHEST {
            return wrong(at, format!("a plane at {split}"));
        }
        let at = fields.offset;
        let upper = fields.int()?;
        if upper <= index as i32 + 1 || upper >= total as i32 {
            return wrong(at, format!("the upper child of node {index} is node {upper} of {total}"));
        }
        self.nodes.push(Node::Branch { axis: axis as u8, split, upper: upper as u32 });
        Ok((upper as u32, at))
    }
}

fn wrong<T>(offset: u64, reason: String) -> Result<T, MathError> {
    Err(MathError::KdTreeFormat { offset, reason })
}

/// A stream and how far it has been read.
struct Fields<'a, R> {
    stream: &'a mut R,
    offset: u64,
}

impl<R: Read> Fields<'_, R> {
    fn bytes<const COUNT: usize>(&mut self) -> Result<[u8; COUNT], MathError> {
        let mut bytes = [0; COUNT];
        let read = self.stream.read_exact(&mut bytes);
        read.map_err(|error| MathError::KdTreeStream { offset: self.offset, kind: error.kind() })?;
        self.offset += COUNT as u64;
        Ok(bytes)
    }

    fn int(&mut self) -> Result<i32, MathError> {
        self.bytes().map(i32::from_le_bytes)
    }

    fn float(&mut self) -> Result<f64, MathError> {
        self.bytes().map(f64::from_le_bytes)
    }

    fn corner<const N: usize>(&mut self) -> Result<[f64; N], MathError> {
        let mut corner = [0.0; N];
        for x in &mut corner {
            *x = self.float()?;
        }
        Ok(corner)
    }

    /// They say how the tree was built and are only kept to be written again, so that any numbers will do.
    fn settings(&mut self) -> Result<Resolved, MathError> {
        let (max_depth, min_items) = (self.int()?, self.int()?);
        let at = self.offset;
        let (hit_cost, empty_bonus) = (self.float()?, self.float()?);
        if !hit_cost.is_finite() || !empty_bonus.is_finite() {
            return wrong(at, format!("hit cost {hit_cost} and bonus {empty_bonus}: both must be finite"));
        }
        Ok(Resolved { max_depth, min_items, hit_cost, empty_bonus })
    }
}
