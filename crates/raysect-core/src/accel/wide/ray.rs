use super::WideTree;
use super::build::{round_down, round_up};
use crate::{BoundingBox3D, Interval, Ray};

/// A ray in the frame of a tree, in single precision and on the safe side.
///
/// Distances along it are counted from where the line of the ray enters the root box, in units in which the largest
/// component of the direction is one.
#[derive(Debug, Clone, Copy)]
pub struct TreeRay {
    /// Distance along the ray at which its line enters the root box.
    pub start: f64,
    /// Units of the tree in a unit of the ray.
    pub(super) speed: f64,
    pub(super) inverse: [f32; 3],
    /// For each axis, what is added to a plane times the inverse: for planes that are entered by, and left by.
    pub(super) near: [f32; 3],
    pub(super) far: [f32; 3],
    pub(super) backward: [bool; 3],
    pub(super) min: f32,
}

/// Bound on what single precision does to a position in the frame: eight roundings of numbers up to two.
const BLUR: f64 = 16.0 / (1u64 << 24) as f64;
/// Components of a direction smaller than one over this, of one, are taken for that: it moves no point by more than a
/// part of the blur.
const MOST: f64 = 1e18;

/// Where a line runs through a box, if it does; a little more on the safe side.
#[inline(always)]
fn passage(b: &BoundingBox3D, ray: &Ray, inverse: [f64; 3]) -> Option<(f64, f64)> {
    let o = ray.origin.to_array();
    let (low, high) = (b.lower.to_array(), b.upper.to_array());
    let (mut first, mut last) = (f64::NEG_INFINITY, f64::INFINITY);
    for a in 0..3 {
        let (t, u) = ((low[a] - o[a]) * inverse[a], (high[a] - o[a]) * inverse[a]);
        let (near, far) = if inverse[a] < 0.0 { (u, t) } else { (t, u) };
        // Comparisons with the NaN of 0 · ∞ are false, which drops it.
        if near > first {
            first = near;
        }
        if far < last {
            last = far;
        }
    }
    let slack = 8.0 * f64::EPSILON * first.abs().max(last.abs());
    (first <= last + slack).then_some((first, last))
}

impl WideTree {
    /// Prepares a ray for a walk through the tree; none if its line misses the root box, or meets it outside the
    /// interval.
    #[inline]
    pub fn prepare(&self, ray: &Ray, within: Interval) -> Option<TreeRay> {
        let d = ray.direction.to_array();
        let inverse = [1.0 / d[0], 1.0 / d[1], 1.0 / d[2]];
        let (first, last) = passage(&self.bounds, ray, inverse)?;
        let slack = 8.0 * f64::EPSILON * first.abs().max(last.abs());
        if first - slack > within.max || last + slack < within.min || !first.is_finite() {
            return None;
        }
        let largest = d[0].abs().max(d[1].abs()).max(d[2].abs());
        let speed = largest * self.frame.scale;
        let o = ray.origin.to_array();
        let entry = ray.point_at(first).to_array();
        let far_away = o[0].abs().max(o[1].abs()).max(o[2].abs()) * self.frame.scale;
        let blur = BLUR + 8.0 * f64::EPSILON * far_away;
        let mut prepared = TreeRay {
            start: first,
            speed,
            inverse: [0.0; 3],
            near: [0.0; 3],
            far: [0.0; 3],
            backward: [false; 3],
            min: round_down((within.min - first) * speed - blur),
        };
        for a in 0..3 {
            let origin = self.frame.map(entry[a], a);
            let inverse = largest * inverse[a];
            let inverse = if inverse.abs() < MOST { inverse } else { MOST.copysign(d[a]) };
            let blur = blur.copysign(inverse);
            prepared.inverse[a] = inverse as f32;
            prepared.near[a] = (-(origin + blur) * inverse) as f32;
            prepared.far[a] = (-(origin - blur) * inverse) as f32;
            prepared.backward[a] = inverse < 0.0;
        }
        Some(prepared)
    }
}

impl TreeRay {
    /// A distance along the ray as the tree counts it, on the safe side of an upper limit.
    #[inline(always)]
    pub fn limit(&self, distance: f64) -> f32 {
        round_up((distance - self.start) * self.speed) * (1.0 + 4.0 * f32::EPSILON)
    }
}
