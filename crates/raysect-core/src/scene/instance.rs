use std::sync::Arc;

use raysect_math::{AffineMatrix3D, Normal3D, Vector3D};

use super::{Candidate, Leaving, SurfacePoint};
use crate::{BoundingBox3D, Crossing, NodeId, Primitive, Ray, Scratch, SurfaceSample};

/// A shape placed in the world, with what is attached to it.
pub struct Instance<A> {
    /// The shape.
    pub primitive: Arc<dyn Primitive>,
    /// What is attached to it: its material in optics.
    pub attached: Arc<A>,
    /// From the shape's space to the world.
    pub to_world: AffineMatrix3D,
    /// From the world to the shape's space.
    pub to_local: AffineMatrix3D,
    /// Box around it in the world [m].
    pub bounds: BoundingBox3D,
    /// The node it was compiled from.
    pub node: NodeId,
    /// The common factor of all lengths, if its transform is a similarity.
    pub similarity: Option<f64>,
    pub(super) convex: bool,
    pub(super) solid: bool,
    /// True if the space of the shape is that of the world.
    in_place: bool,
    /// One over the factor of a similarity.
    shrink: f64,
    /// Largest stretch of a length by `to_world`, and the size of its translation [m]: what rounding acts upon.
    stretch: f64,
    shift: f64,
}

impl<A> std::fmt::Debug for Instance<A> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{} ({})", self.primitive.kind(), self.node)
    }
}

impl<A> Instance<A> {
    pub(crate) fn new(
        primitive: Arc<dyn Primitive>,
        attached: Arc<A>,
        to_world: AffineMatrix3D,
        to_local: AffineMatrix3D,
        node: NodeId,
    ) -> Self {
        let bounds = primitive.bounding_box(&to_world);
        let row = |i: usize| (0..3).map(|j| to_world.get(i, j).abs()).sum::<f64>();
        Self {
            convex: primitive.is_convex(),
            solid: primitive.is_solid(),
            in_place: to_world == AffineMatrix3D::IDENTITY && to_local == AffineMatrix3D::IDENTITY,
            stretch: row(0).max(row(1)).max(row(2)),
            shift: to_world.origin().max_abs(),
            similarity: to_world.similarity_scale(),
            shrink: to_world.similarity_scale().map_or(1.0, |scale| 1.0 / scale),
            primitive,
            attached,
            to_world,
            to_local,
            bounds,
            node,
        }
    }

    /// A ray in the space of the shape: itself where that is the space of the world, else in the room lent for it.
    #[inline]
    pub(super) fn local<'a>(&self, ray: &'a Ray, room: &'a mut Option<Ray>) -> &'a Ray {
        if self.in_place { ray } else { room.insert(self.moved(ray)) }
    }

    #[inline]
    fn moved(&self, ray: &Ray) -> Ray {
        Ray {
            origin: self.to_local.transform_point(ray.origin),
            direction: self.to_local.transform_vector(ray.direction),
            max_distance: ray.max_distance,
        }
    }

    /// A unit normal of the shape in the world.
    #[inline]
    fn upright(&self, normal: Normal3D) -> Normal3D {
        match self.similarity {
            // A similarity turns normals like vectors and stretches them by a known factor.
            Some(_) => Normal3D::from(self.to_world.transform_vector(normal.as_vector()) * self.shrink),
            None => self.to_local.transform_normal_with_inverse(normal).normalise_unchecked(),
        }
    }

    /// The next crossing of a ray that starts on this shape.
    ///
    /// What goes into a solid comes out of it. Where the chord is so thin that rounding hides it, along the surface or
    /// at an edge, it ends where it begins.
    #[inline]
    pub(super) fn hit_after(
        &self,
        local: &Ray,
        leaving: &Leaving,
        limit: f64,
        scratch: &mut Scratch,
    ) -> Option<Crossing> {
        let departure = &leaving.departure;
        let next = self.primitive.hit_after(local, departure, limit, scratch);
        let fits = next.map_or(!departure.inward, |c| c.exiting == departure.inward);
        if fits || !self.solid { next } else { self.hidden_chord(local, leaving, next, limit, scratch) }
    }

    #[cold]
    fn hidden_chord(
        &self,
        local: &Ray,
        leaving: &Leaving,
        next: Option<Crossing>,
        limit: f64,
        scratch: &mut Scratch,
    ) -> Option<Crossing> {
        let departure = &leaving.departure;
        if next.is_some() && !leaving.grazes {
            return next;
        }
        if next.is_none() && limit < f64::INFINITY {
            // Most likely it ends beyond the limit. Only a ray that grazes is worth a second look.
            let beyond = |s| self.primitive.hit_after(local, departure, f64::INFINITY, s);
            if !leaving.grazes || beyond(scratch).is_some() {
                return None;
            }
        }
        Some(Crossing { distance: 0.0, feature: departure.feature, exiting: departure.inward })
    }

    /// Everything about the surface at a hit of it.
    // Always within `Scene::finish`: the answer of a call within a call would be copied on its way out.
    #[inline(always)]
    pub(super) fn surface_at(&self, ray: &Ray, hit: &Candidate) -> SurfacePoint {
        if self.in_place {
            return self.surface_in_place(ray, hit);
        }
        let local = self.primitive.surface(&self.moved(ray), &hit.crossing);
        let point = self.to_world.transform_point(local.point);
        let normal = self.upright(local.normal);
        let shading_normal =
            if local.shading_normal == local.normal { normal } else { self.upright(local.shading_normal) };
        let rounding = 16.0 * f64::EPSILON;
        let reach = point.max_abs() + self.stretch * local.point.max_abs() + self.shift;
        SurfacePoint {
            instance: hit.instance,
            point,
            local_point: local.point,
            normal,
            shading_normal,
            bound: self.stretch * local.bound + rounding * reach,
            distance: hit.crossing.distance,
            exiting: hit.crossing.exiting,
            feature: hit.crossing.feature,
        }
    }

    /// The same where the space of the shape is that of the world.
    #[inline]
    fn surface_in_place(&self, ray: &Ray, hit: &Candidate) -> SurfacePoint {
        let local = self.primitive.surface(ray, &hit.crossing);
        SurfacePoint {
            instance: hit.instance,
            point: local.point,
            local_point: local.point,
            normal: local.normal,
            shading_normal: local.shading_normal,
            bound: local.bound + 32.0 * f64::EPSILON * local.point.max_abs(),
            distance: hit.crossing.distance,
            exiting: hit.crossing.exiting,
            feature: hit.crossing.feature,
        }
    }

    /// The surface at a point that was drawn on it, as a ray from `from` along the unit vector `direction`
    /// meets it at `distance`.
    #[inline]
    pub(super) fn surface_drawn(
        &self,
        index: u32,
        sample: &SurfaceSample,
        direction: Vector3D,
        distance: f64,
    ) -> SurfacePoint {
        let point = self.to_world.transform_point(sample.point);
        let normal = self.upright(sample.normal);
        let shading_normal = sample.shading_normal.map_or(normal, |n| self.upright(n));
        let reach = point.max_abs() + self.stretch * sample.point.max_abs() + self.shift;
        SurfacePoint {
            instance: index,
            point,
            local_point: sample.point,
            normal,
            shading_normal,
            bound: 16.0 * f64::EPSILON * reach,
            distance,
            exiting: normal.dot(direction) > 0.0,
            feature: sample.feature,
        }
    }
}
