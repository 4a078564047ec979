use std::sync::Arc;

use raysect_core::accel::Slabs;
use raysect_core::save::{SaveError, Saved, SceneWriter};
use raysect_core::{BoundingBox3D, Crossing, Interval, Primitive, Ray, Scratch, Surface};
use raysect_math::{AffineMatrix3D, MathError, Normal3D, Point3D};

use super::leaf::Leaf;
use crate::PrimitiveError;
use crate::select::{larger, smaller};

/// A shape and its place in the space of the composite that is made of it.
///
/// Every shape is one, placed where it is. An `Arc` of a shape is a shape, too, so that one can be an operand many
/// times.
///
/// ```
/// use std::sync::Arc;
/// use raysect_math::translate;
/// use raysect_primitive::{Cuboid, Place, Sphere, Union};
///
/// let ball = Arc::new(Sphere::new(0.2)?);
/// let dumbbell = Union::new(ball.clone(), ball.placed(translate(1.0, 0.0, 0.0)))?;
/// let bar = Cuboid::centred(2.0, 0.1, 0.1)?;
/// Union::new(dumbbell, bar)?;
/// # Ok::<(), raysect_primitive::PrimitiveError>(())
/// ```
#[derive(Clone)]
pub struct Operand {
    shape: Arc<dyn Primitive>,
    to_parent: AffineMatrix3D,
}

impl std::fmt::Debug for Operand {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{} under {:?}", self.shape.kind(), self.to_parent.to_rows())
    }
}

impl<P: Primitive> From<P> for Operand {
    /// The shape where it is.
    fn from(shape: P) -> Self {
        Self { shape: Arc::new(shape), to_parent: AffineMatrix3D::IDENTITY }
    }
}

/// Places a shape as an operand of [`Union`](crate::Union), [`Intersect`](crate::Intersect) or
/// [`Subtract`](crate::Subtract).
pub trait Place: Primitive + Sized {
    /// The shape moved, turned, stretched or mirrored by `transform`.
    fn placed(self, transform: AffineMatrix3D) -> Operand {
        Operand { to_parent: transform, ..Operand::from(self) }
    }
}

impl<P: Primitive> Place for P {}

/// An operand as the composite keeps it.
#[derive(Clone)]
pub(super) struct Member {
    pub(super) shape: Arc<dyn Primitive>,
    to_parent: AffineMatrix3D,
    to_local: AffineMatrix3D,
    in_place: bool,
    /// True if to find the crossings takes longer than to test the box.
    pub(super) costly: bool,
    /// Around the operand in the space of the composite.
    pub(super) bounds: BoundingBox3D,
    /// Greatest coordinate that enters the arithmetic [m].
    pub(super) reach: f64,
    stretch: f64,
    shift: f64,
}

impl Member {
    /// `shape` is the composite, `position` the operand, for the error.
    pub(super) fn new(
        operand: Operand,
        shape: &'static str,
        position: &'static str,
    ) -> Result<Self, PrimitiveError> {
        let Operand { shape: inner, to_parent } = operand;
        if !inner.is_solid() {
            return Err(PrimitiveError::OpenOperand { shape, position, operand: inner.kind() });
        }
        let placed = |source: MathError| PrimitiveError::OperandTransform { shape, position, source };
        let to_local = to_parent.inverse().map_err(placed)?;
        let bounds = inner.bounding_box(&to_parent);
        let corner = if bounds.is_empty() { 0.0 } else { bounds.lower.max_abs().max(bounds.upper.max_abs()) };
        let shift = to_parent.origin().max_abs();
        let in_place = to_parent == AffineMatrix3D::IDENTITY;
        let costly = !in_place || inner.parts() > 1;
        Ok(Self {
            costly,
            shape: inner,
            to_parent,
            to_local,
            in_place,
            bounds,
            reach: corner.max(shift),
            stretch: norm(&to_parent),
            shift,
        })
    }

    /// Adds what is to be saved of it, under names that begin with `which`.
    pub(super) fn saved(
        &self,
        saved: Saved,
        which: &str,
        writer: &mut SceneWriter,
    ) -> Result<Saved, SaveError> {
        let shape = writer.shared_object(&self.shape)?;
        Ok(saved.reference(which, shape).transform(&format!("{which}_transform"), &self.to_parent))
    }

    #[inline]
    fn local(&self, ray: &Ray) -> Ray {
        if self.in_place { *ray } else { moved(&self.to_local, ray) }
    }

    /// A leaf of the operand in the space of the composite.
    pub(super) fn placed_leaf(&self, leaf: Leaf) -> Leaf {
        if self.in_place { leaf } else { leaf.below(&self.to_parent, &self.to_local) }
    }

    /// In the space of the composite, a part of the greatest coordinate of a ray's origin and a length, over the greatest
    /// component of its direction, that are not less than those of the operand; and a greatest coordinate.
    pub(super) fn placed_lengths(&self, [part, length]: [f64; 2], reach: f64) -> ([f64; 2], f64) {
        if self.in_place {
            return ([part, length], reach);
        }
        // A direction may shrink on the way in by as much as it is stretched on the way out.
        let part = part * self.stretch;
        let shifted = part * self.to_local.origin().max_abs() + length * self.stretch;
        ([part * norm(&self.to_local), shifted], self.stretch * reach + self.shift)
    }

    /// Appends every crossing of the line.
    #[inline]
    pub(super) fn crossings(&self, ray: &Ray, scratch: &mut Scratch, out: &mut Vec<Crossing>) {
        if self.in_place {
            self.shape.crossings(ray, scratch, out);
        } else {
            self.shape.crossings(&self.local(ray), scratch, out);
        }
    }

    /// Appends the crossings of the line that matter within an interval.
    #[inline]
    pub(super) fn crossings_within(
        &self,
        ray: &Ray,
        within: Interval,
        scratch: &mut Scratch,
        out: &mut Vec<Crossing>,
    ) {
        if self.in_place {
            self.shape.crossings_within(ray, within, scratch, out);
        } else {
            self.shape.crossings_within(&self.local(ray), within, scratch, out);
        }
    }

    /// The box around the operand under a map of the composite.
    pub(super) fn bounding_box(&self, m: &AffineMatrix3D) -> BoundingBox3D {
        self.shape.bounding_box(&(*m * self.to_parent))
    }

    /// The map to the world if `m` is that of the composite.
    pub(super) fn placed_by(&self, m: &AffineMatrix3D) -> AffineMatrix3D {
        *m * self.to_parent
    }

    pub(super) fn contains(&self, point: Point3D) -> bool {
        self.shape.contains(self.to_local.transform_point(point))
    }

    /// The surface at a crossing of the operand, in the space of the composite.
    pub(super) fn surface(&self, ray: &Ray, crossing: &Crossing) -> Surface {
        let rounding = 16.0 * f64::EPSILON;
        if self.in_place {
            let mut surface = self.shape.surface(ray, crossing);
            surface.bound += rounding * surface.point.max_abs();
            return surface;
        }
        let local = self.shape.surface(&self.local(ray), crossing);
        let point = self.to_parent.transform_point(local.point);
        let upright = |n: Normal3D| self.to_local.transform_normal_with_inverse(n).normalise_unchecked();
        let normal = upright(local.normal);
        let shading_normal =
            if local.shading_normal == local.normal { normal } else { upright(local.shading_normal) };
        let reach = point.max_abs() + self.stretch * local.point.max_abs() + self.shift;
        Surface { point, normal, shading_normal, bound: self.stretch * local.bound + rounding * reach }
    }
}

/// A ray under a map.
#[inline]
pub(super) fn moved(map: &AffineMatrix3D, ray: &Ray) -> Ray {
    Ray {
        origin: map.transform_point(ray.origin),
        direction: map.transform_vector(ray.direction),
        max_distance: ray.max_distance,
    }
}

/// The greatest sum of the magnitudes in a row of the 3×3 part: by how much the greatest component of a vector grows at
/// most.
pub(super) fn norm(m: &AffineMatrix3D) -> f64 {
    (0..3).map(|row| (0..3).map(|column| m.get(row, column).abs()).sum()).fold(0.0, f64::max)
}

/// A line, prepared for tests against boxes.
pub(super) struct Probe {
    origin: [f64; 3],
    inverse: [f64; 3],
    /// For each axis, true if the line meets the upper face first.
    backward: [bool; 3],
}

impl Probe {
    #[inline]
    pub(super) fn new(ray: &Ray) -> Self {
        let d = ray.direction;
        let inverse = [1.0 / d.x, 1.0 / d.y, 1.0 / d.z];
        let backward = [inverse[0] < 0.0, inverse[1] < 0.0, inverse[2] < 0.0];
        Self { origin: ray.origin.to_array(), inverse, backward }
    }

    /// A length [m], or the greatest coordinate of the origin if that is more, as a distance along the line, at least.
    #[inline]
    pub(super) fn distance_of(&self, length: f64) -> f64 {
        let [x, y, z] = self.inverse.map(f64::abs);
        let [a, b, c] = self.origin.map(f64::abs);
        larger(larger(larger(a, b), c), length) * smaller(smaller(x, y), z)
    }

    /// True if the line meets the box at a distance between `first` and `last`. Comparisons with a NaN, of a line in the
    /// plane of a face, are false, which drops it.
    #[inline]
    pub(super) fn meets(&self, bounds: &Slabs, first: f64, last: f64) -> bool {
        let (mut near, mut far) = (first, last);
        for axis in 0..3 {
            let (o, inverse, backward) = (self.origin[axis], self.inverse[axis], self.backward[axis]);
            let a = (bounds[usize::from(backward)][axis] - o) * inverse;
            let b = (bounds[usize::from(!backward)][axis] - o) * inverse;
            near = if a > near { a } else { near };
            far = if b < far { b } else { far };
        }
        // Each distance carries three roundings. A line beside a slab that it runs along is infinitely near: NaN here.
        const SLACK: f64 = 8.0 * f64::EPSILON;
        near - SLACK * near.abs() <= far + SLACK * far.abs()
    }
}
