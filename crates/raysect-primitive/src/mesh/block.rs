//! Four triangles, tested side by side in double precision.

use fearless_simd::{Simd, f32x4, f32x8, f64x4, prelude::*};
use raysect_core::accel::wide::LEAF_ITEMS;

use super::triangle::ShearedRay;

/// The corners of the triangles of a leaf: axis, corner, triangle. Places without a triangle hold NaN, which meets
/// nothing.
#[derive(Debug, Clone, Copy)]
pub(super) struct Block<T>([[[T; LEAF_ITEMS]; 3]; 3]);

/// Single or double precision: vertices that single precision holds exactly take half the room.
pub(super) trait Triangles: Copy + Send + Sync {
    /// The corners of up to four triangles; `None` if their coordinates cannot be stored without loss.
    fn of(triangles: [Option<[[f64; 3]; 3]>; LEAF_ITEMS]) -> Option<Self>;

    /// The coordinates of all triangles along an axis, corner by corner.
    fn load<S: Simd>(&self, simd: S, axis: usize) -> [f64x4<S>; 3];

    /// The corners of one triangle.
    fn corners(&self, lane: usize) -> [[f64; 3]; 3];
}

fn arranged<T: Copy>(
    triangles: [Option<[[f64; 3]; 3]>; LEAF_ITEMS],
    none: T,
    stored: impl Fn(f64) -> Option<T>,
) -> Option<Block<T>> {
    let mut planes = [[[none; LEAF_ITEMS]; 3]; 3];
    for (lane, corners) in triangles.iter().enumerate() {
        let Some(corners) = corners else { continue };
        for (number, corner) in corners.iter().enumerate() {
            for (axis, x) in corner.iter().enumerate() {
                planes[axis][number][lane] = stored(*x)?;
            }
        }
    }
    Some(Block(planes))
}

impl Triangles for Block<f32> {
    fn of(triangles: [Option<[[f64; 3]; 3]>; LEAF_ITEMS]) -> Option<Self> {
        arranged(triangles, f32::NAN, |x| (f64::from(x as f32) == x).then_some(x as f32))
    }

    #[inline(always)]
    fn load<S: Simd>(&self, simd: S, axis: usize) -> [f64x4<S>; 3] {
        let plane = self.0[axis].as_flattened();
        let (first, second) = simd.widen_f32x8(f32x8::from_slice(simd, &plane[..8]));
        let last = f32x4::from_slice(simd, &plane[8..]);
        let (third, _) = simd.widen_f32x8(simd.combine_f32x4(last, last));
        [first, second, third]
    }

    fn corners(&self, lane: usize) -> [[f64; 3]; 3] {
        [0, 1, 2].map(|corner| [0, 1, 2].map(|axis| f64::from(self.0[axis][corner][lane])))
    }
}

impl Triangles for Block<f64> {
    fn of(triangles: [Option<[[f64; 3]; 3]>; LEAF_ITEMS]) -> Option<Self> {
        arranged(triangles, f64::NAN, Some)
    }

    #[inline(always)]
    fn load<S: Simd>(&self, simd: S, axis: usize) -> [f64x4<S>; 3] {
        let plane = &self.0[axis];
        [
            f64x4::from_slice(simd, &plane[0]),
            f64x4::from_slice(simd, &plane[1]),
            f64x4::from_slice(simd, &plane[2]),
        ]
    }

    fn corners(&self, lane: usize) -> [[f64; 3]; 3] {
        [0, 1, 2].map(|corner| [0, 1, 2].map(|axis| self.0[axis][corner][lane]))
    }
}

/// A ray in every lane.
pub(super) struct RayLanes<S: Simd> {
    simd: S,
    origin: [f64x4<S>; 3],
    shear: [f64x4<S>; 3],
    start: f64x4<S>,
    axes: [usize; 3],
}

/// A number in every lane, for each axis. Written out: closures would be compiled without the vector instructions.
#[inline(always)]
fn splat<S: Simd>(simd: S, v: [f64; 3]) -> [f64x4<S>; 3] {
    [f64x4::splat(simd, v[0]), f64x4::splat(simd, v[1]), f64x4::splat(simd, v[2])]
}

#[inline(always)]
fn smaller<S: Simd>(a: f64x4<S>, b: f64x4<S>) -> f64x4<S> {
    b.simd_lt(a).select(b, a)
}

#[inline(always)]
fn larger<S: Simd>(a: f64x4<S>, b: f64x4<S>) -> f64x4<S> {
    b.simd_gt(a).select(b, a)
}

impl<S: Simd> RayLanes<S> {
    #[inline(always)]
    pub(super) fn new(simd: S, ray: &ShearedRay) -> Self {
        let [a, b, c] = ray.axes;
        let o = ray.origin;
        Self {
            simd,
            origin: splat(simd, [o[a], o[b], o[c]]),
            shear: splat(simd, ray.shear),
            start: f64x4::splat(simd, ray.start),
            axes: ray.axes,
        }
    }

    /// Distances at which the line of the ray meets the triangles of a block, one bit for each that it meets, and one
    /// for each of which only the oracle, [`ShearedRay::meet`], can tell. The same arithmetic as there, to the bit.
    #[inline(always)]
    pub(super) fn meet<T: Triangles>(&self, block: &T) -> ([f64; LEAF_ITEMS], u64, u64) {
        let simd = self.simd;
        let [ox, oy, oz] = self.origin;
        let [sx, sy, sz] = self.shear;
        let [ax, bx, cx] = block.load(simd, self.axes[0]);
        let [ay, by, cy] = block.load(simd, self.axes[1]);
        let [az, bz, cz] = block.load(simd, self.axes[2]);
        let (az, bz, cz) = (az - oz, bz - oz, cz - oz);
        let (ax, bx, cx) = (ax - ox - sx * az, bx - ox - sx * bz, cx - ox - sx * cz);
        let (ay, by, cy) = (ay - oy - sy * az, by - oy - sy * bz, cy - oy - sy * cz);
        let u = cx * by - cy * bx;
        let v = ax * cy - ay * cx;
        let w = bx * ay - by * ax;
        let zero = f64x4::splat(simd, 0.0);
        let front = u.simd_gt(zero) & v.simd_gt(zero) & w.simd_gt(zero);
        let back = u.simd_lt(zero) & v.simd_lt(zero) & w.simd_lt(zero);
        let doubtful = u.simd_eq(zero) | v.simd_eq(zero) | w.simd_eq(zero);
        let (met, doubtful) = ((front | back).to_bitmask(), doubtful.to_bitmask());
        if met == 0 {
            return ([0.0; LEAF_ITEMS], 0, doubtful);
        }
        let (az, bz, cz) = (sz * az, sz * bz, sz * cz);
        let total = u + v + w;
        let distance = (u * az + v * bz + w * cz) / total;
        let (low, high) = (smaller(smaller(az, bz), cz), larger(larger(az, bz), cz));
        let distance = self.start + larger(smaller(distance, high), low);
        (distance.into(), met, doubtful)
    }
}
