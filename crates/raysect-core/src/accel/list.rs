use fearless_simd::{Level, Select, Simd, dispatch, f64x4, prelude::*};
use raysect_math::Point3D;

use super::{Accelerator, TraversalRay, Visitor};
use crate::BoundingBox3D;

/// Tests the box of every instance: the fastest structure for a handful of them.
#[derive(Debug)]
#[doc(alias = "Unaccelerated")]
pub struct List {
    boxes: Vec<BoundingBox3D>,
    groups: Vec<Group>,
    level: Level,
}

/// So few instances are tested without their boxes: any superset of what is met gives the same answer.
const UNTESTED: usize = 2;

/// Boxes that are tested side by side.
const LANES: usize = 4;

/// The lower and the upper coordinates of several boxes, axis by axis.
#[derive(Debug, Clone, Copy)]
struct Group([[[f64; LANES]; 3]; 2]);

impl Group {
    fn new(boxes: &[BoundingBox3D]) -> Self {
        let of = |lane: usize| boxes.get(lane).copied().unwrap_or(BoundingBox3D::EMPTY);
        let plane =
            |pick: fn(&BoundingBox3D) -> Point3D, axis: usize| std::array::from_fn(|l| pick(&of(l))[axis]);
        let side = |pick: fn(&BoundingBox3D) -> Point3D| [plane(pick, 0), plane(pick, 1), plane(pick, 2)];
        Self([side(|b| b.lower), side(|b| b.upper)])
    }

    /// Distances at which the ray enters each box, and one bit for each box that it meets up to `limit`: the same
    /// test as [`TraversalRay::enter`], to the bit. Comparisons with a NaN are false, which drops the NaN.
    #[inline(always)]
    fn enter<S: Simd>(&self, simd: S, ray: &PreparedRay<S>, limit: f64) -> ([f64; LANES], u64) {
        const GROW: f64 = 1.0 + 8.0 * f64::EPSILON;
        let (mut first, mut last) = (ray.min, f64x4::splat(simd, f64::INFINITY));
        for axis in 0..3 {
            let distance = |side: bool| {
                (f64x4::from_slice(simd, &self.0[usize::from(side)][axis]) - ray.origin[axis])
                    * ray.inverse[axis]
            };
            let (near, far) = (distance(ray.backward[axis]), distance(!ray.backward[axis]));
            first = near.simd_gt(first).select(near, first);
            last = far.simd_lt(last).select(far, last);
        }
        let grown = last * GROW;
        last = grown.simd_gt(last).select(grown, last);
        let met = first.simd_le(last) & first.simd_le(f64x4::splat(simd, limit));
        (first.into(), met.to_bitmask())
    }
}

/// A ray in every lane.
struct PreparedRay<S: Simd> {
    origin: [f64x4<S>; 3],
    inverse: [f64x4<S>; 3],
    min: f64x4<S>,
    backward: [bool; 3],
}

impl<S: Simd> PreparedRay<S> {
    #[inline(always)]
    fn new(simd: S, ray: &TraversalRay) -> Self {
        let each =
            |v: [f64; 3]| [f64x4::splat(simd, v[0]), f64x4::splat(simd, v[1]), f64x4::splat(simd, v[2])];
        Self {
            origin: each(ray.origin.to_array()),
            inverse: each(ray.inverse.to_array()),
            min: f64x4::splat(simd, ray.min),
            backward: ray.backward,
        }
    }
}

/// So many groups are tested before any of their boxes is visited: while one is, no vector can stay in a register.
const AT_ONCE: usize = 4;

#[inline(always)]
fn walk<S: Simd>(simd: S, groups: &[Group], ray: &TraversalRay, mut limit: f64, visitor: &mut Visitor<'_>) {
    for (number, groups) in groups.chunks(AT_ONCE).enumerate() {
        let (entries, mut met) = meet(simd, groups, ray, limit);
        while met != 0 {
            let lane = met.trailing_zeros() as usize;
            met &= met - 1;
            if entries[lane / LANES % AT_ONCE][lane % LANES] <= limit {
                limit = visitor((number * AT_ONCE * LANES + lane) as u32, limit);
                if limit < ray.min {
                    return;
                }
            }
        }
    }
}

/// Where the ray enters the boxes of a few groups, and one bit for each box that it meets up to `limit`.
#[inline(always)]
fn meet<S: Simd>(
    simd: S,
    groups: &[Group],
    ray: &TraversalRay,
    limit: f64,
) -> ([[f64; LANES]; AT_ONCE], u64) {
    let prepared = PreparedRay::new(simd, ray);
    let (mut entries, mut met) = ([[0.0; LANES]; AT_ONCE], 0);
    for (place, group) in groups.iter().take(AT_ONCE).enumerate() {
        let (first, bits) = group.enter(simd, &prepared, limit);
        entries[place] = first;
        met |= bits << (place * LANES);
    }
    (entries, met)
}

impl List {
    /// Over boxes [m].
    pub fn new(boxes: &[BoundingBox3D]) -> Self {
        let groups = boxes.chunks(LANES).map(Group::new).collect();
        Self { boxes: boxes.to_vec(), groups, level: Level::new() }
    }
}

impl Accelerator for List {
    fn visit(&self, ray: &TraversalRay, mut limit: f64, visitor: &mut Visitor<'_>) {
        if self.boxes.len() <= UNTESTED {
            for (index, b) in self.boxes.iter().enumerate() {
                if !b.is_empty() {
                    limit = visitor(index as u32, limit);
                    if limit < ray.min {
                        return;
                    }
                }
            }
            return;
        }
        dispatch!(self.level, simd => walk(simd, &self.groups, ray, limit, visitor));
    }

    fn visit_containing(&self, point: Point3D, visitor: &mut dyn FnMut(u32)) {
        for (index, b) in self.boxes.iter().enumerate() {
            if b.contains(point) {
                visitor(index as u32);
            }
        }
    }

    fn describe(&self) -> String {
        format!("list of {}", self.boxes.len())
    }
}
