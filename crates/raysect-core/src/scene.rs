use raysect_math::{AffineMatrix3D, Normal3D, Point3D, Vector3D};
use std::sync::Arc;

use crate::accel::{Accelerator, TraversalRay};
use crate::{
    Attachment, BoundingBox3D, Crossing, Departure, Feature, Intersection, Interval, NodeId, Primitive, Ray,
    Scratch, SurfaceSample,
};

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
    convex: bool,
    solid: bool,
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
    fn local<'a>(&self, ray: &'a Ray, room: &'a mut Option<Ray>) -> &'a Ray {
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
    fn hit_after(
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
}

/// What a ray has hit, before anything is computed about it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Candidate {
    /// Number of the instance in the scene.
    pub instance: u32,
    /// Where.
    pub crossing: Crossing,
}

/// The surface at a hit, in world space.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SurfacePoint {
    /// Number of the instance in the scene.
    pub instance: u32,
    /// The point [m].
    pub point: Point3D,
    /// The point in the local space of the shape [m].
    pub local_point: Point3D,
    /// Outward unit normal of the geometry.
    pub normal: Normal3D,
    /// Outward unit normal to shade with.
    pub shading_normal: Normal3D,
    /// Bound on the error of `point` [m].
    pub bound: f64,
    /// Distance along the ray, in units of its direction's length.
    pub distance: f64,
    /// True if the ray leaves the shape here.
    pub exiting: bool,
    /// Which piece of the surface.
    pub feature: Feature,
}

impl SurfacePoint {
    /// The point moved off the surface by twice its error bound, outward or inward, for code that starts a ray of
    /// its own without saying where it comes from.
    #[doc(alias("inside_point", "outside_point"))]
    pub fn launch_point(&self, outward: bool) -> Point3D {
        let step = self.normal.as_vector() * (2.0 * self.bound);
        if outward { self.point + step } else { self.point - step }
    }
}

/// Cosine below which a chord may be hidden by rounding: that of one as high as the rounding of its place, where a
/// surface of a radius of 100 roundings is still one.
const GRAZING: f64 = 0.1;

/// How many surfaces at one place are remembered while a ray works its way through them.
const CLUSTER: usize = 4;

/// Where a ray comes from: the surface it leaves, and others that coincide with it.
///
/// Nothing is moved off a surface. The ray begins at the hit point, and the crossing that it leaves is recognised
/// by its instance and kind. Within the error of the point, crossings of *other* instances count exactly if the
/// ray still has to pass them: if it runs through their surface in the sense in which it arrived, and has not been
/// through them already.
#[derive(Debug, Clone, Copy)]
pub struct Leaving {
    departure: Departure,
    grazes: bool,
    instance: u32,
    clustered: u32,
    zone: f64,
    arrived: Vector3D,
    towards: Vector3D,
    /// Instances that coincide here, and in which direction the ray went away from them: a sign is all that is
    /// asked of it.
    cluster: [(u32, [f32; 3]); CLUSTER],
}

impl Leaving {
    /// For a ray that arrived along `arrived` at `surface` and leaves along `towards` (both unit vectors).
    /// `before` is where the arriving ray itself came from.
    // Written so that the answer is made where it is wanted: it is too large to be copied in passing.
    #[inline]
    pub fn new(surface: &SurfacePoint, arrived: Vector3D, towards: Vector3D, before: Option<&Self>) -> Self {
        if let Some(before) = before.filter(|b| surface.distance <= b.zone) {
            return Self::departing(surface, arrived, towards).remembering(before);
        }
        Self::departing(surface, arrived, towards)
    }

    /// The same for a ray whose departure is kept: from where it came is replaced by where it now is.
    #[inline]
    pub fn renew(kept: &mut Option<Self>, surface: &SurfacePoint, arrived: Vector3D, towards: Vector3D) {
        if let Some(before) = kept.as_ref().filter(|b| surface.distance <= b.zone) {
            *kept = Some(Self::departing(surface, arrived, towards).remembering(before));
            return;
        }
        *kept = Some(Self::departing(surface, arrived, towards));
    }

    #[inline(always)]
    fn departing(surface: &SurfacePoint, arrived: Vector3D, towards: Vector3D) -> Self {
        let cosine = surface.normal.dot(towards);
        // A chord that is thinner than rounding may end where the normal still faces the ray: what goes straight on has
        // passed it all the same.
        let inward = if towards == arrived { !surface.exiting } else { cosine < 0.0 };
        let departure =
            Departure { inward, bound: surface.bound / cosine.abs().max(1e-12), feature: surface.feature };
        Self {
            departure,
            grazes: cosine.abs() < GRAZING,
            instance: surface.instance,
            clustered: 0,
            zone: surface.bound / cosine.abs().max(1e-3),
            arrived,
            towards,
            cluster: [(u32::MAX, [0.0; 3]); CLUSTER],
        }
    }

    /// Takes over what coincides here: the same place as before, left anew.
    #[cold]
    fn remembering(mut self, before: &Self) -> Self {
        let towards = before.towards.to_array().map(|x| x as f32);
        let known = &before.cluster[..before.clustered as usize];
        for &(instance, direction) in known.iter().chain([&(before.instance, towards)]) {
            if instance != self.instance && (self.clustered as usize) < CLUSTER {
                self.cluster[self.clustered as usize] = (instance, direction);
                self.clustered += 1;
            }
        }
        self
    }

    /// Notes that the ray has gone through another surface at the same place, too.
    pub fn passed(&mut self, instance: u32) {
        if instance != self.instance && (self.clustered as usize) < CLUSTER {
            let towards = self.towards.to_array().map(|x| x as f32);
            self.cluster[self.clustered as usize] = (instance, towards);
            self.clustered += 1;
        }
    }

    /// Within this distance along the ray, crossings count as being at the same place.
    pub fn zone(&self) -> f64 {
        self.zone
    }

    /// Number of the instance that is being left.
    pub fn instance(&self) -> u32 {
        self.instance
    }

    /// True if a crossing of another instance within the zone of doubt has still to be passed.
    #[cold]
    fn pending(&self, instance: u32, normal: Vector3D) -> bool {
        let ahead = normal.dot(self.towards);
        let known = self.cluster[..self.clustered as usize].iter().rev().find(|(i, _)| *i == instance);
        match known {
            // It has been dealt with, and comes again only if the ray has turned back.
            Some((_, direction)) => normal.dot(direction.map(f64::from)) * ahead < 0.0,
            None => normal.dot(self.arrived) * ahead > 0.0,
        }
    }
}

/// A compiled world: flat, immutable, shared by all threads.
pub struct Scene<A: Attachment> {
    /// The placed shapes, in the order of the tree.
    pub instances: Vec<Instance<A>>,
    /// What the attachments have made of them.
    pub compiled: A::Compiled,
    accelerator: Box<dyn Accelerator>,
    /// True if there are so few instances that each is asked without a structure.
    few: bool,
}

/// So few instances are asked one after the other: their boxes cost as much as they do.
const FEW: usize = 2;

impl<A: Attachment> std::fmt::Debug for Scene<A> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "Scene({}, {:?})", self.accelerator.describe(), self.instances)
    }
}

impl<A: Attachment> Scene<A> {
    pub(crate) fn new(
        instances: Vec<Instance<A>>,
        compiled: A::Compiled,
        acceleration: &crate::Acceleration,
    ) -> Self {
        let boxes: Vec<_> = instances.iter().map(|i| i.bounds).collect();
        let few = matches!(acceleration, crate::Acceleration::Automatic) && instances.len() <= FEW;
        Self { instances, compiled, accelerator: acceleration.build(&boxes), few }
    }

    /// The structure that finds what a ray may hit.
    pub fn accelerator(&self) -> &dyn Accelerator {
        &*self.accelerator
    }

    /// The nearest hit of a ray up to its `max_distance`. Among equals the lower instance number wins, so that the
    /// answer does not depend on the acceleration.
    pub fn hit(&self, ray: &Ray, leaving: Option<&Leaving>, scratch: &mut Scratch) -> Option<Candidate> {
        if self.few {
            return self.hit_few(ray, leaving, scratch);
        }
        let mut best: Option<Candidate> = None;
        let prepared = TraversalRay::new(ray, leaving.map_or(0.0, |l| -l.zone));
        self.accelerator.visit(&prepared, ray.max_distance, &mut |index, limit| {
            let Some(crossing) = self.hit_instance(index, ray, leaving, limit, scratch) else { return limit };
            let nearer = best.is_none_or(|b| {
                crossing.distance < b.crossing.distance
                    || (crossing.distance == b.crossing.distance && index < b.instance)
            });
            if nearer {
                best = Some(Candidate { instance: index, crossing });
            }
            crossing.distance.min(limit)
        });
        best
    }

    #[inline]
    fn hit_few(&self, ray: &Ray, leaving: Option<&Leaving>, scratch: &mut Scratch) -> Option<Candidate> {
        if let [_] = self.instances[..] {
            let crossing = self.hit_instance(0, ray, leaving, ray.max_distance, scratch)?;
            return Some(Candidate { instance: 0, crossing });
        }
        let (mut best, mut limit) = (None, ray.max_distance);
        for index in 0..self.instances.len() as u32 {
            let Some(crossing) = self.hit_instance(index, ray, leaving, limit, scratch) else { continue };
            // Among equals the first one stays.
            if best.is_none_or(|b: Candidate| crossing.distance < b.crossing.distance) {
                best = Some(Candidate { instance: index, crossing });
                limit = limit.min(crossing.distance);
            }
        }
        best
    }

    /// The nearest hit of one instance alone, up to the distance `limit`.
    // A ray that leaves no surface does not pay for what one that does may need.
    #[inline(always)]
    pub fn hit_instance(
        &self,
        index: u32,
        ray: &Ray,
        leaving: Option<&Leaving>,
        limit: f64,
        scratch: &mut Scratch,
    ) -> Option<Crossing> {
        if let Some(leaving) = leaving {
            return self.hit_leaving(index, ray, leaving, limit, scratch);
        }
        let (instance, mut room) = (&self.instances[index as usize], None);
        instance.primitive.hit(instance.local(ray, &mut room), Interval::new(0.0, limit), scratch)
    }

    /// The same for a ray that leaves a surface, of this instance or of another one.
    #[inline]
    fn hit_leaving(
        &self,
        index: u32,
        ray: &Ray,
        leaving: &Leaving,
        limit: f64,
        scratch: &mut Scratch,
    ) -> Option<Crossing> {
        let (instance, returns) = (&self.instances[index as usize], leaving.instance == index);
        if returns && instance.convex && !leaving.departure.inward {
            return None;
        }
        let mut room = None;
        let local = instance.local(ray, &mut room);
        if returns {
            return instance.hit_after(local, leaving, limit, scratch);
        }
        self.hit_other(index, [ray, local], leaving, limit, scratch)
    }

    /// The nearest hit of an instance by a ray, in the world and in its space, that leaves another one.
    #[inline]
    fn hit_other(
        &self,
        index: u32,
        [ray, local]: [&Ray; 2],
        leaving: &Leaving,
        limit: f64,
        scratch: &mut Scratch,
    ) -> Option<Crossing> {
        let instance = &self.instances[index as usize];
        let crossing = instance.primitive.hit(local, Interval::new(-leaving.zone, limit), scratch)?;
        if crossing.distance > leaving.zone {
            return Some(crossing);
        }
        let normal = self.finish(ray, &Candidate { instance: index, crossing }).normal.as_vector();
        if leaving.pending(index, normal) {
            return Some(Crossing { distance: crossing.distance.max(0.0), ..crossing });
        }
        instance.primitive.hit(local, Interval::new(leaving.zone.next_up(), limit), scratch)
    }

    /// True if an instance that `blocks` stands in the way of a ray before its `max_distance`.
    pub fn is_blocked(
        &self,
        ray: &Ray,
        leaving: Option<&Leaving>,
        scratch: &mut Scratch,
        blocks: impl Fn(u32) -> bool,
    ) -> bool {
        let mut blocked = false;
        let prepared = TraversalRay::new(ray, leaving.map_or(0.0, |l| -l.zone));
        self.accelerator.visit(&prepared, ray.max_distance, &mut |index, limit| {
            if blocks(index) && self.hit_instance(index, ray, leaving, limit, scratch).is_some() {
                blocked = true;
                return f64::NEG_INFINITY;
            }
            limit
        });
        blocked
    }

    /// Everything about the surface at a hit.
    #[inline]
    pub fn finish(&self, ray: &Ray, hit: &Candidate) -> SurfacePoint {
        let instance = &self.instances[hit.instance as usize];
        if instance.in_place {
            return Self::finish_in_place(instance, ray, hit);
        }
        let local = instance.primitive.surface(&instance.moved(ray), &hit.crossing);
        let point = instance.to_world.transform_point(local.point);
        let normal = instance.upright(local.normal);
        let shading_normal = if local.shading_normal == local.normal {
            normal
        } else {
            instance.upright(local.shading_normal)
        };
        let rounding = 16.0 * f64::EPSILON;
        let reach = point.max_abs() + instance.stretch * local.point.max_abs() + instance.shift;
        SurfacePoint {
            instance: hit.instance,
            point,
            local_point: local.point,
            normal,
            shading_normal,
            bound: instance.stretch * local.bound + rounding * reach,
            distance: hit.crossing.distance,
            exiting: hit.crossing.exiting,
            feature: hit.crossing.feature,
        }
    }

    /// As [`finish`](Self::finish), where the space of the shape is that of the world.
    #[inline]
    fn finish_in_place(instance: &Instance<A>, ray: &Ray, hit: &Candidate) -> SurfacePoint {
        let local = instance.primitive.surface(ray, &hit.crossing);
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

    /// The surface at a point that was drawn on an instance, as a ray from `from` along the unit vector `direction`
    /// meets it at `distance`.
    #[inline]
    pub fn sampled_surface(
        &self,
        index: u32,
        sample: &SurfaceSample,
        direction: Vector3D,
        distance: f64,
    ) -> SurfacePoint {
        let instance = &self.instances[index as usize];
        let point = instance.to_world.transform_point(sample.point);
        let normal = instance.upright(sample.normal);
        let shading_normal = sample.shading_normal.map_or(normal, |n| instance.upright(n));
        let reach = point.max_abs() + instance.stretch * sample.point.max_abs() + instance.shift;
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

    /// True if a straight line crosses an instance at most twice.
    pub fn is_convex(&self, index: u32) -> bool {
        self.instances[index as usize].convex
    }

    /// A hit as the user of a world sees it.
    pub fn intersection(&self, ray: &Ray, hit: &Candidate) -> Intersection {
        let instance = &self.instances[hit.instance as usize];
        let surface = self.finish(ray, hit);
        Intersection {
            ray: *ray,
            node: instance.node,
            surface,
            to_local: instance.to_local,
            to_world: instance.to_world,
        }
    }

    /// The instances that contain a point of the world, in ascending order.
    pub fn containing(&self, point: Point3D, mut found: impl FnMut(u32)) {
        self.accelerator.visit_containing(point, &mut |index| {
            let instance = &self.instances[index as usize];
            if instance.primitive.contains(instance.to_local.transform_point(point)) {
                found(index);
            }
        });
    }

    /// Every crossing of every instance along a ray from its origin to its `max_distance`, in order.
    pub fn crossings(&self, ray: &Ray, scratch: &mut Scratch) -> Vec<Candidate> {
        let mut all = Vec::new();
        let mut list = scratch.take();
        let prepared = TraversalRay::new(ray, 0.0);
        self.accelerator.visit(&prepared, ray.max_distance, &mut |index, limit| {
            let instance = &self.instances[index as usize];
            list.clear();
            let mut room = None;
            instance.primitive.crossings(instance.local(ray, &mut room), scratch, &mut list);
            let ahead = list.iter().filter(|c| c.distance >= 0.0 && c.distance <= ray.max_distance);
            all.extend(ahead.map(|&crossing| Candidate { instance: index, crossing }));
            limit
        });
        all.sort_by(|a, b| {
            a.crossing.distance.total_cmp(&b.crossing.distance).then(a.instance.cmp(&b.instance))
        });
        scratch.give_back(list);
        all
    }
}
