//! What a ray looks for in the leaves of the tree of a mesh.

use fearless_simd::Simd;
use raysect_core::accel::wide::{LEAF_ITEMS, LeafTest, TreeRay, WideTree};
use raysect_core::{Crossing, Feature, Interval};

use super::block::{RayLanes, Triangles};
use super::triangle::{Meeting, ShearedRay};

/// A triangle of a leaf that a ray meets.
#[derive(Debug, Clone, Copy)]
pub(super) struct Found {
    pub(super) distance: f64,
    pub(super) leaf: u32,
    pub(super) lane: u32,
    /// Number of the triangle in the mesh.
    pub(super) triangle: u32,
}

/// The triangles, leaf by leaf, and a ray.
pub(super) struct Search<'a, T, S: Simd> {
    pub(super) tree: &'a WideTree,
    pub(super) blocks: &'a [T],
    pub(super) ray: &'a ShearedRay,
    pub(super) lanes: RayLanes<S>,
}

impl<T: Triangles, S: Simd> Search<'_, T, S> {
    /// Calls `found` for every triangle of a leaf that the line of the ray meets.
    #[inline(always)]
    fn leaf(&self, leaf: u32, mut found: impl FnMut(Found)) {
        let block = &self.blocks[leaf as usize];
        let (distances, mut met, mut doubtful) = self.lanes.meet(block);
        let triangles = &self.tree.leaves()[leaf as usize];
        while met != 0 {
            let lane = met.trailing_zeros() as usize % LEAF_ITEMS;
            met &= met - 1;
            let (distance, triangle) = (distances[lane], triangles[lane]);
            found(Found { distance, leaf, lane: lane as u32, triangle });
        }
        while doubtful != 0 {
            let lane = doubtful.trailing_zeros() as usize % LEAF_ITEMS;
            doubtful &= doubtful - 1;
            if let Some(meeting) = self.meet_exactly(block, lane) {
                let (distance, triangle) = (meeting.distance, triangles[lane]);
                found(Found { distance, leaf, lane: lane as u32, triangle });
            }
        }
    }

    #[cold]
    fn meet_exactly(&self, block: &T, lane: usize) -> Option<Meeting> {
        self.ray.meet(block.corners(lane))
    }
}

/// The crossing at a triangle that has been found.
pub(super) fn crossing<T: Triangles>(ray: &ShearedRay, blocks: &[T], found: &Found) -> Option<Crossing> {
    let meeting = ray.meet(blocks[found.leaf as usize].corners(found.lane as usize))?;
    let feature = Feature { part: 0, face: found.triangle, uv: meeting.uv };
    Some(Crossing { distance: meeting.distance, feature, exiting: meeting.from_behind })
}

/// True if a triangle comes before another: by its number where they are equally near, so that the answer does not
/// depend on the tree.
#[inline(always)]
fn comes_before(a: &Found, b: &Option<Found>) -> bool {
    b.as_ref()
        .is_none_or(|b| a.distance < b.distance || (a.distance == b.distance && a.triangle < b.triangle))
}

/// Looks for the nearest triangle within an interval.
pub(super) struct Nearest<'a, T, S: Simd> {
    pub(super) search: Search<'a, T, S>,
    pub(super) tree_ray: &'a TreeRay,
    pub(super) within: Interval,
    pub(super) best: Option<Found>,
}

impl<T: Triangles, S: Simd> LeafTest<S> for Nearest<'_, T, S> {
    #[inline(always)]
    fn leaf(&mut self, _: S, leaf: u32, limit: f32) -> f32 {
        let (within, best) = (self.within, &mut self.best);
        let mut closer = false;
        self.search.leaf(leaf, |found| {
            if within.contains(found.distance) && comes_before(&found, best) {
                *best = Some(found);
                closer = true;
            }
        });
        match best {
            Some(best) if closer => self.tree_ray.limit(best.distance),
            _ => limit,
        }
    }
}

/// Looks for all triangles within ± a bound, and for the nearest beyond.
pub(super) struct After<'a, T, S: Simd> {
    pub(super) search: Search<'a, T, S>,
    pub(super) tree_ray: &'a TreeRay,
    pub(super) bound: f64,
    pub(super) max: f64,
    pub(super) near: &'a mut Vec<Crossing>,
    pub(super) best: Option<Found>,
}

impl<T: Triangles, S: Simd> LeafTest<S> for After<'_, T, S> {
    #[inline(always)]
    fn leaf(&mut self, _: S, leaf: u32, limit: f32) -> f32 {
        let Self { search, bound, max, near, best, .. } = self;
        let mut closer = false;
        search.leaf(leaf, |found| {
            if found.distance.abs() <= *bound {
                near.extend(crossing(search.ray, search.blocks, &found));
            } else if found.distance > 0.0 && found.distance <= *max && comes_before(&found, best) {
                *best = Some(found);
                closer = true;
            }
        });
        match best {
            Some(best) if closer => self.tree_ray.limit(best.distance),
            _ => limit,
        }
    }
}

/// Looks for all triangles.
pub(super) struct All<'a, T, S: Simd> {
    pub(super) search: Search<'a, T, S>,
    pub(super) out: &'a mut Vec<Crossing>,
}

impl<T: Triangles, S: Simd> LeafTest<S> for All<'_, T, S> {
    #[inline(always)]
    fn leaf(&mut self, _: S, leaf: u32, limit: f32) -> f32 {
        let (search, out) = (&self.search, &mut *self.out);
        search.leaf(leaf, |found| out.extend(crossing(search.ray, search.blocks, &found)));
        limit
    }
}
