//! What the solids of revolution about the z axis share: the passage of a line through a convex body, the bounds of
//! disks, and the choice between the pieces that are seen from a point.

use std::f64::consts::PI;

use raysect_core::{BoundingBox3D, BoundingSphere3D, Crossing, Feature, Interval, Ray, SurfaceSample};
use raysect_math::{AffineMatrix3D, MathError, Normal3D, Point3D, Vector3D, sampling};

use crate::PrimitiveError;
use crate::chord::Chord;
use crate::select::{larger, smaller};

/// Number of the curved face.
pub(crate) const SIDE: u32 = 0;
/// Number of the flat face across z = 0.
pub(crate) const LOWER: u32 = 1;
/// Number of the flat face across z = height.
pub(crate) const UPPER: u32 = 2;

/// Refuses a dimension outside 1e-100 … 1e100 m, whose square could overflow or vanish.
pub(crate) fn check_length(
    shape: &'static str,
    name: &'static str,
    value: f64,
) -> Result<(), PrimitiveError> {
    MathError::check((1e-100..=1e100).contains(&value), value, name, "m", "1e-100 … 1e100 m")
        .map(|_| ())
        .map_err(|source| PrimitiveError::Dimension { shape, source })
}

/// Refuses shapes so flat or so slender that their coefficients could overflow or vanish.
pub(crate) fn check_aspect(shape: &'static str, radius: f64, height: f64) -> Result<(), PrimitiveError> {
    let ratio = radius / height;
    MathError::check((1e-50..=1e50).contains(&ratio), ratio, "radius / height", "", "1e-50 … 1e50")
        .map(|_| ())
        .map_err(|source| PrimitiveError::Dimension { shape, source })
}

/// Where a line runs within a convex body, and by which faces it comes and goes.
///
/// A body is the intersection of a curved solid with half-spaces. Each of them cuts the passage short; of faces at
/// equal distance the one that was met first in the computation counts, so that a line through a rim crosses once.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Passage {
    near: f64,
    far: f64,
    entry: u32,
    exit: u32,
    misses: bool,
}

impl Passage {
    /// Of a line within a curved solid; `misses` if it is outside for all its length.
    #[inline]
    pub(crate) fn within_side(near: f64, far: f64, misses: bool) -> Self {
        Self { near, far, entry: SIDE, exit: SIDE, misses }
    }

    /// This, unless the line is outside for all its length.
    #[inline]
    pub(crate) fn that_meets(self) -> Option<Self> {
        (!self.misses).then_some(self)
    }

    /// Cuts off what lies below the plane z = 0 or above the plane z = `height`.
    #[inline]
    pub(crate) fn between_ends(mut self, height: f64, ray: &Ray) -> Self {
        let (o, d) = (ray.origin.z, ray.direction.z);
        if d == 0.0 {
            self.misses |= o < 0.0 || o > height;
            return self;
        }
        let (to_lower, to_upper) = (-o / d, (height - o) / d);
        let (lower_first, upper_first) = if d > 0.0 { (LOWER, UPPER) } else { (UPPER, LOWER) };
        let (first, last) = (smaller(to_lower, to_upper), larger(to_lower, to_upper));
        // Selections and no branches: which way lines run cannot be foretold.
        self.entry = if first > self.near { lower_first } else { self.entry };
        self.near = larger(self.near, first);
        self.exit = if last < self.far { upper_first } else { self.exit };
        self.far = smaller(self.far, last);
        self
    }

    /// Keeps the distances t for which `speed · t ≥ missing`.
    #[inline]
    fn ahead_of(mut self, missing: f64, speed: f64, face: u32) -> Self {
        if speed == 0.0 {
            self.misses |= missing > 0.0;
            return self;
        }
        let t = missing / speed;
        // Selections and no branches: which way lines run cannot be foretold.
        let first = if speed > 0.0 { t } else { f64::NEG_INFINITY };
        let last = if speed < 0.0 { t } else { f64::INFINITY };
        self.entry = if first > self.near { face } else { self.entry };
        self.near = if first > self.near { first } else { self.near };
        self.exit = if last < self.far { face } else { self.exit };
        self.far = if last < self.far { last } else { self.far };
        self
    }

    /// For a line that had been moved forward by `t`. Whether it meets the body is decided before, where distances
    /// have more digits.
    #[inline]
    pub(crate) fn counted_from(mut self, t: f64) -> Self {
        self.misses |= self.near > self.far;
        self.near += t;
        self.far += t;
        self
    }

    #[inline]
    fn meets(&self) -> bool {
        !self.misses && self.near <= self.far && self.near >= f64::MIN && self.far <= f64::MAX
    }

    /// What is within the body, if the line meets it.
    #[inline]
    pub(crate) fn chord(self) -> Option<Chord> {
        let Self { near, far, entry, exit, .. } = self;
        self.meets().then_some(Chord { near, far, entry, exit })
    }

    /// The first crossing within an interval. Without a chord on the way, which costs a twentieth of it.
    #[inline]
    pub(crate) fn first(&self, within: Interval) -> Option<Crossing> {
        if !self.meets() {
            return None;
        }
        if within.contains(self.near) {
            return Some(Chord::crossing(self.near, self.entry, false));
        }
        within.contains(self.far).then(|| Chord::crossing(self.far, self.exit, true))
    }

    /// The exit of a ray that starts on the surface and goes inward: it has entered, so it leaves by the nearest far
    /// side, however rounding has placed its origin.
    #[inline]
    pub(crate) fn exit_ahead(&self, max_distance: f64) -> Option<Crossing> {
        let far = self.far.max(0.0);
        (far <= max_distance && far.is_finite()).then(|| Chord::crossing(far, self.exit, true))
    }
}

/// The feature of a face.
#[inline]
pub(crate) fn face_of(face: u32) -> Feature {
    Feature { face, ..Feature::default() }
}

/// The roots of `a t² + 2 b t + c`, from its discriminant `b² − a c`: first the one of the greater magnitude, which
/// becomes infinite as `a` vanishes. None if the polynomial has no linear part to speak of.
///
/// The sum of `b` and the root never cancels (N. Higham, *Accuracy and Stability of Numerical Algorithms*, 2nd ed.,
/// § 1.8); the discriminant is left to the caller, who knows a form of it without cancellation. If it is negative both
/// are the place of the extremum.
#[inline]
pub(crate) fn roots(a: f64, b: f64, c: f64, discriminant: f64) -> Option<(f64, f64)> {
    if discriminant < 0.0 {
        return Some((-b / a, -b / a));
    }
    let q = -(b + discriminant.sqrt().copysign(b));
    (q != 0.0).then(|| (q / a, c / q))
}

/// A line begun where a quadric with its tip on the z axis is best solved.
pub(crate) struct NearTip {
    /// Where it begins across the axis [m].
    pub(crate) x: f64,
    pub(crate) y: f64,
    /// Height of that place above the plane z = 0 [m].
    height: f64,
    /// Depth below the tip [m].
    pub(crate) depth: f64,
    pub(crate) direction: Vector3D,
    /// The distance by which the origin has been moved along the line.
    moved: f64,
}

impl NearTip {
    /// Moves the origin to the closest approach to the tip if that is much nearer; else nothing is gained by it, and
    /// the origin stays as it is given. The coefficients are then of the size of what is sought, be it far from the
    /// origin or close to the tip.
    ///
    /// I. Wald, *Improving Numerical Precision in Intersection Programs*, Ray Tracing Gems II, ch. 34.
    #[inline]
    pub(crate) fn new(ray: &Ray, tip: f64) -> Self {
        let (o, d) = (ray.origin, ray.direction);
        let depth = tip - o.z;
        let t = (depth * d.z - o.x * d.x - o.y * d.y) / d.length_squared();
        let (x, y, w) = (o.x + t * d.x, o.y + t * d.y, depth - t * d.z);
        if 16.0 * (x * x + y * y + w * w) < o.x * o.x + o.y * o.y + depth * depth {
            // Height and depth fit together, or else the base would be moved against the side.
            Self { x, y, height: tip - w, depth: w, direction: d, moved: t }
        } else {
            Self { x: o.x, y: o.y, height: o.z, depth, direction: d, moved: 0.0 }
        }
    }

    /// What of a passage through the side lies above the plane z = 0, counted from the origin as it was given.
    #[inline]
    pub(crate) fn above_base(&self, side: Passage) -> Passage {
        side.ahead_of(-self.height, self.direction.z, LOWER).counted_from(self.moved)
    }
}

/// A point moved within a distance of the z axis, if it lies outside.
#[inline]
pub(crate) fn within_disk(x: f64, y: f64, radius: f64) -> (f64, f64) {
    let rho = (x * x + y * y).sqrt();
    if rho > radius { (x / rho * radius, y / rho * radius) } else { (x, y) }
}

/// How far a disk of unit radius across z reaches along an axis of the world.
pub(crate) fn disk_reach(m: &AffineMatrix3D, axis: usize) -> f64 {
    m.get(axis, 0).hypot(m.get(axis, 1))
}

/// The box of points that reach from `below` to `above` of the image of the origin along each axis, with the rounding
/// of maps.
pub(crate) fn rounded_box(m: &AffineMatrix3D, reach: impl Fn(usize) -> (f64, f64)) -> BoundingBox3D {
    let origin = m.origin().to_array();
    let (mut lower, mut upper) = (origin, origin);
    for axis in 0..3 {
        let (below, above) = reach(axis);
        let pad = 8.0 * f64::EPSILON * (below.abs() + above.abs() + origin[axis].abs());
        lower[axis] = origin[axis] + below - pad;
        upper[axis] = origin[axis] + above + pad;
    }
    BoundingBox3D { lower: lower.into(), upper: upper.into() }
}

/// The image of a ball about a point of the z axis, for a similarity of known scale.
pub(crate) fn ball_about_axis(m: &AffineMatrix3D, scale: f64, z: f64, radius: f64) -> BoundingSphere3D {
    let centre = m.transform_point(Point3D::new(0.0, 0.0, z));
    let rounding = 8.0 * f64::EPSILON * (centre.max_abs() + m.origin().max_abs());
    BoundingSphere3D { centre, radius: radius * scale * 1.000_000_001 + rounding }
}

/// Height of the centre and radius of the smallest ball around a base disk and a tip above it: through both, or
/// about the base if the tip is low.
pub(crate) fn tip_ball(radius: f64, height: f64) -> (f64, f64) {
    if height <= radius {
        return (0.0, radius);
    }
    let ball = 0.5 * height + 0.5 * radius * (radius / height);
    (height - ball, ball)
}

/// Half the arc [rad] in which cos Δ · `denominator` exceeds `numerator`, for a denominator of 0 or more.
#[inline]
pub(crate) fn half_arc(numerator: f64, denominator: f64) -> f64 {
    if numerator >= denominator {
        0.0
    } else if numerator <= -denominator {
        PI
    } else {
        (numerator / denominator).acos()
    }
}

/// A point at the distance `rho` from the z axis, turned by `angle` [rad] from the side on which `from` lies.
#[inline]
pub(crate) fn turned(from: Point3D, rho: f64, angle: f64) -> (f64, f64) {
    let away = from.x.hypot(from.y);
    let (cx, cy) = if away > 0.0 { (from.x / away, from.y / away) } else { (1.0, 0.0) };
    let (sine, cosine) = angle.sin_cos();
    (rho * (cx * cosine - cy * sine), rho * (cx * sine + cy * cosine))
}

/// The weight of a piece of the surface in the choice: the solid angle that it would subtend if it were small, from its
/// area, the height of the observer above it and the distance to it.
#[inline]
pub(crate) fn piece_weight(area: f64, height: f64, aside: f64) -> f64 {
    let distance = height.hypot(aside);
    if height > 0.0 { area / distance / distance * (height / distance) } else { 0.0 }
}

/// Probabilities of the faces from their weights; all 0 if none is seen.
#[inline]
pub(crate) fn chances(weights: [f64; 3]) -> [f64; 3] {
    let total = weights[0] + weights[1] + weights[2];
    if total > 0.0 { weights.map(|w| w / total) } else { [0.0; 3] }
}

/// A face drawn by its probability.
#[inline]
pub(crate) fn choose(chances: &[f64; 3], u: f64) -> Option<u32> {
    let mut rest = u;
    let chosen = (0..3).filter(|&f| chances[f] > 0.0).find(|&f| {
        rest -= chances[f];
        rest <= 0.0
    });
    chosen.or_else(|| (0..3).rfind(|&f| chances[f] > 0.0)).map(|f| f as u32)
}

/// A uniform point of a flat face, which is chosen with probability `chance`.
#[inline]
pub(crate) fn sample_disk(radius: f64, z: f64, face: u32, chance: f64, u: [f64; 2]) -> SurfaceSample {
    let p = sampling::disk::sample(u);
    SurfaceSample {
        point: Point3D::new(radius * p.x, radius * p.y, z),
        normal: flat_normal(face),
        shading_normal: None,
        feature: face_of(face),
        density: chance / disk_area(radius),
    }
}

/// The outward unit normal of a flat face.
#[inline]
pub(crate) fn flat_normal(face: u32) -> Normal3D {
    Normal3D::new(0.0, 0.0, if face == UPPER { 1.0 } else { -1.0 })
}

/// Area of a disk [m²].
#[inline]
pub(crate) fn disk_area(radius: f64) -> f64 {
    PI * radius * radius
}
