use super::settings::Resolved;
use super::{KdItem, KdTreeSettings, build};
use crate::MathError;

/// Boxes in N dimensions, divided by planes across the axes (J. L. Bentley, *Multidimensional Binary Search Trees Used
/// for Associative Searching*, 1975; with boxes as in M. Pharr, W. Jakob, G. Humphreys, *Physically Based Rendering*,
/// 3rd ed., § 4.4).
///
/// Boxes are closed: what touches an edge or a plane of the tree is found. (Raysect asks one side only of such a plane,
/// and loses the items that end there.)
#[doc(alias("KDTree2DCore", "KDTree3DCore", "KDTree2D", "KDTree3D"))]
#[derive(Debug, Clone, PartialEq)]
pub struct KdTree<const N: usize> {
    /// Ascending by their numbers, which differ.
    pub(super) items: Vec<KdItem<N>>,
    pub(super) settings: Resolved,
    /// Around all items; lower above upper if there is none.
    pub(super) lower: [f64; N],
    pub(super) upper: [f64; N],
    /// In preorder, never empty; at most `KdTreeSettings::DEEPEST` branches above each.
    pub(super) nodes: Vec<Node>,
    /// Numbers of the items of all leaves.
    pub(super) entries: Vec<u32>,
}

/// A tree over items in a plane.
pub type KdTree2D = KdTree<2>;
/// A tree over items in space.
pub type KdTree3D = KdTree<3>;

#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Node {
    /// Holds `entries[start..start + count]`.
    Leaf { start: usize, count: u32 },
    /// The lower child, at and below the split, is the next node.
    Branch { axis: u8, split: f64, upper: u32 },
}

impl<const N: usize> KdTree<N> {
    /// Over the given items, with the default settings.
    ///
    /// # Errors
    /// [`MathError::DuplicateItem`] if two items have the same number.
    pub fn new(items: impl IntoIterator<Item = KdItem<N>>) -> Result<Self, MathError> {
        Self::with_settings(items, &KdTreeSettings::default())
    }

    /// Over the given items.
    ///
    /// Planes are put where the surface area heuristic expects the least work (J. D. MacDonald, K. S. Booth,
    /// *Heuristics for Ray Tracing Using Space Subdivision*, 1990), along the longest axis of a node, or along another
    /// if no plane is worth it there. In two dimensions areas take the place of surface areas: points are looked up,
    /// not rays. The effort is about n log² n of n items.
    ///
    /// # Errors
    /// [`MathError::OutOfRange`] for settings that are not finite or a bonus outside 0 … 1,
    /// [`MathError::DuplicateItem`] if two items have the same number.
    pub fn with_settings(
        items: impl IntoIterator<Item = KdItem<N>>,
        settings: &KdTreeSettings,
    ) -> Result<Self, MathError> {
        let items = in_order(items)?;
        let settings = settings.resolve(items.len())?;
        Ok(build::build(items, settings))
    }

    /// Number of items.
    #[inline]
    pub fn len(&self) -> usize {
        self.items.len()
    }

    /// True if there are no items.
    #[inline]
    pub fn is_empty(&self) -> bool {
        self.items.is_empty()
    }

    /// Least and greatest coordinates of all items; none without items.
    pub fn bounds(&self) -> Option<([f64; N], [f64; N])> {
        (!self.is_empty()).then_some((self.lower, self.upper))
    }

    /// The item of the given number.
    #[inline]
    pub fn item(&self, id: u32) -> Option<&KdItem<N>> {
        find(&self.items, id)
    }

    /// Numbers of all items whose closed box contains the point, ascending.
    ///
    /// Every such item is named, and no other; whether the point lies in what is in the box is for the caller to test.
    /// (Of a tree that was read from a stream, those are named that its leaves hold too.)
    pub fn items_containing(&self, point: impl Into<[f64; N]>) -> Vec<u32> {
        let mut found = Vec::new();
        self.first_containing(point, |id| {
            found.push(id);
            false
        });
        // On a plane of the tree both sides are asked, and may know the same item.
        found.sort_unstable();
        found.dedup();
        found
    }

    /// The first item found whose closed box contains the point and that passes the test, the test being asked for
    /// these only. No memory is allocated.
    ///
    /// Which one is first is the same for equal trees and points. On a plane of the tree an item may be tested twice.
    #[inline]
    pub fn first_containing(
        &self,
        point: impl Into<[f64; N]>,
        mut test: impl FnMut(u32) -> bool,
    ) -> Option<u32> {
        let point = point.into();
        let inside = (0..N).all(|axis| self.lower[axis] <= point[axis] && point[axis] <= self.upper[axis]);
        if inside { self.search(0, &point, &mut test) } else { None }
    }

    /// True if an item whose closed box contains the point passes the test; see
    /// [`first_containing`](Self::first_containing).
    #[inline]
    pub fn is_contained(&self, point: impl Into<[f64; N]>, test: impl FnMut(u32) -> bool) -> bool {
        self.first_containing(point, test).is_some()
    }

    fn search(&self, mut index: usize, point: &[f64; N], test: &mut impl FnMut(u32) -> bool) -> Option<u32> {
        loop {
            match self.nodes[index] {
                Node::Branch { axis, split, upper } => {
                    let x = point[usize::from(axis)];
                    if x == split
                        && let Some(found) = self.search(index + 1, point, test)
                    {
                        return Some(found);
                    }
                    index = if x < split { index + 1 } else { upper as usize };
                }
                Node::Leaf { start, count } => {
                    let ids = &self.entries[start..start + count as usize];
                    return ids
                        .iter()
                        .copied()
                        .find(|&id| self.item(id).is_some_and(|item| item.contains(*point)) && test(id));
                }
            }
        }
    }
}

/// The items by their numbers.
pub(super) fn in_order<const N: usize>(
    items: impl IntoIterator<Item = KdItem<N>>,
) -> Result<Vec<KdItem<N>>, MathError> {
    let mut items: Vec<KdItem<N>> = items.into_iter().collect();
    items.sort_by_key(KdItem::id);
    match items.windows(2).find(|pair| pair[0].id() == pair[1].id()) {
        Some(pair) => Err(MathError::DuplicateItem { id: pair[0].id() }),
        None => Ok(items),
    }
}

/// The item of a number; at once if the numbers count the items.
#[inline]
pub(super) fn find<const N: usize>(items: &[KdItem<N>], id: u32) -> Option<&KdItem<N>> {
    match items.get(id as usize) {
        Some(item) if item.id() == id => Some(item),
        _ => items.binary_search_by_key(&id, KdItem::id).ok().map(|at| &items[at]),
    }
}

#[cfg(test)]
mod tests;
