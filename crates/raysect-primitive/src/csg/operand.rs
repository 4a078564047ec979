use std::sync::Arc;

use raysect_core::{BoundingBox3D, Crossing, Primitive, Ray, Scratch, Surface};
use raysect_math::{AffineMatrix3D, MathError, Normal3D, Vector3D};

use crate::PrimitiveError;

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

/// How many roundings may act upon a crossing of an operand, in multiples of ε times the lengths that enter: four of
/// the map to the operand's space for each of some levels of nesting, and those of its own solution.
const ROUNDINGS: f64 = 32.0;

/// An operand as the composite keeps it.
#[derive(Clone)]
pub(super) struct Member {
    pub(super) shape: Arc<dyn Primitive>,
    to_parent: AffineMatrix3D,
    to_local: AffineMatrix3D,
    in_place: bool,
    /// Around the operand in the space of the composite.
    pub(super) bounds: BoundingBox3D,
    /// Greatest coordinate that enters the arithmetic [m].
    pub(super) reach: f64,
    /// Error of a crossing across its surface, in units of the lengths that enter.
    pub(super) rounding: f64,
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
        Ok(Self {
            shape: inner,
            to_parent,
            to_local,
            in_place,
            bounds,
            reach: corner.max(shift),
            rounding: ROUNDINGS * f64::EPSILON * condition(&to_parent, &to_local),
            stretch: (0..3).map(|i| row_sum(&to_parent, i)).fold(0.0, f64::max),
            shift,
        })
    }

    #[inline]
    fn local(&self, ray: &Ray) -> Ray {
        if self.in_place {
            return *ray;
        }
        Ray {
            origin: self.to_local.transform_point(ray.origin),
            direction: self.to_local.transform_vector(ray.direction),
            max_distance: ray.max_distance,
        }
    }

    /// Appends every crossing of the line, unless it passes beside the box; `inverse` is one over the direction.
    #[inline]
    pub(super) fn crossings(
        &self,
        ray: &Ray,
        inverse: Vector3D,
        scratch: &mut Scratch,
        out: &mut Vec<Crossing>,
    ) {
        if line_meets(&self.bounds, ray, inverse) {
            self.shape.crossings(&self.local(ray), scratch, out);
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

    pub(super) fn contains(&self, point: raysect_math::Point3D) -> bool {
        self.shape.contains(self.to_local.transform_point(point))
    }

    /// The surface at a crossing of the operand, in the space of the composite.
    pub(super) fn surface(&self, ray: &Ray, crossing: &Crossing) -> Surface {
        let local = self.shape.surface(&self.local(ray), crossing);
        let rounding = 16.0 * f64::EPSILON;
        if self.in_place {
            return Surface { bound: local.bound + rounding * local.point.max_abs(), ..local };
        }
        let point = self.to_parent.transform_point(local.point);
        let upright = |n: Normal3D| self.to_local.transform_normal_with_inverse(n).normalise_unchecked();
        let normal = upright(local.normal);
        let shading_normal =
            if local.shading_normal == local.normal { normal } else { upright(local.shading_normal) };
        let reach = point.max_abs() + self.stretch * local.point.max_abs() + self.shift;
        Surface { point, normal, shading_normal, bound: self.stretch * local.bound + rounding * reach }
    }
}

/// Sum of the magnitudes in a row of the 3×3 part.
fn row_sum(m: &AffineMatrix3D, row: usize) -> f64 {
    (0..3).map(|column| m.get(row, column).abs()).sum()
}

/// By how much rounding grows on the way into a space and back: the norm of |M| |M⁻¹|
/// (N. Higham, *Accuracy and Stability of Numerical Algorithms*, 2nd ed., § 7.2).
fn condition(m: &AffineMatrix3D, inverse: &AffineMatrix3D) -> f64 {
    (0..3).map(|i| (0..3).map(|j| m.get(i, j).abs() * row_sum(inverse, j)).sum()).fold(1.0, f64::max)
}

/// One over each component of a direction; infinite for zero.
#[inline]
pub(super) fn inverse_direction(direction: Vector3D) -> Vector3D {
    Vector3D::new(1.0 / direction.x, 1.0 / direction.y, 1.0 / direction.z)
}

/// False if the whole line of the ray passes beside the box.
#[inline]
fn line_meets(bounds: &BoundingBox3D, ray: &Ray, inverse: Vector3D) -> bool {
    let (o, low, high) = (ray.origin, bounds.lower, bounds.upper);
    let (mut near, mut far) = (f64::NEG_INFINITY, f64::INFINITY);
    let slabs =
        [(o.x, inverse.x, low.x, high.x), (o.y, inverse.y, low.y, high.y), (o.z, inverse.z, low.z, high.z)];
    for (o, inverse, low, high) in slabs {
        if inverse.is_infinite() {
            if o < low || o > high {
                return false;
            }
            continue;
        }
        let (a, b) = ((low - o) * inverse, (high - o) * inverse);
        near = near.max(a.min(b));
        far = far.min(a.max(b));
    }
    // Each distance carries three roundings.
    near <= far + 8.0 * f64::EPSILON * (near.abs() + far.abs())
}
