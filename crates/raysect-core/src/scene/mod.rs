//! A world as rays see it.

mod batch;
mod instance;
mod leaving;
mod surface_point;

use raysect_math::{Point3D, Vector3D};

pub use instance::Instance;
pub use leaving::Leaving;
pub use surface_point::{Candidate, SurfacePoint};

use crate::accel::{Accelerator, TraversalRay};
use crate::{Attachment, Crossing, Feature, Intersection, Interval, Ray, Scratch, SurfaceSample};

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

/// What has been hit, by its instance and crossing, which is taken apart and put together again: one that is copied as a
/// whole is read in larger pieces than it has just been written in, and the copy waits until all of these have reached
/// memory. A function would copy it in passing.
macro_rules! candidate {
    ($instance:expr, $crossing:ident) => {{
        let Feature { part, face, uv } = $crossing.feature;
        let (distance, exiting) = ($crossing.distance, $crossing.exiting);
        Candidate {
            instance: $instance,
            crossing: Crossing { distance, feature: Feature { part, face, uv }, exiting },
        }
    }};
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
        if self.few { self.hit_few(ray, leaving, scratch) } else { self.hit_many(ray, leaving, scratch) }
    }

    #[inline(always)]
    fn hit_many(&self, ray: &Ray, leaving: Option<&Leaving>, scratch: &mut Scratch) -> Option<Candidate> {
        let mut best: Option<Candidate> = None;
        let prepared = TraversalRay::new(ray, leaving.map_or(0.0, |l| -l.zone));
        self.accelerator.visit(&prepared, ray.max_distance, &mut |index, limit| {
            let Some(c) = self.hit_instance(index, ray, leaving, limit, scratch) else { return limit };
            let nearer = best.is_none_or(|b| {
                c.distance < b.crossing.distance || (c.distance == b.crossing.distance && index < b.instance)
            });
            if nearer {
                best = Some(candidate!(index, c));
            }
            c.distance.min(limit)
        });
        best
    }

    #[inline]
    fn hit_few(&self, ray: &Ray, leaving: Option<&Leaving>, scratch: &mut Scratch) -> Option<Candidate> {
        if let [_] = self.instances[..] {
            let c = self.hit_instance(0, ray, leaving, ray.max_distance, scratch)?;
            return Some(candidate!(0, c));
        }
        let (mut best, mut limit) = (None, ray.max_distance);
        for index in 0..self.instances.len() as u32 {
            let Some(c) = self.hit_instance(index, ray, leaving, limit, scratch) else { continue };
            // Among equals the first one stays.
            if best.is_none_or(|b: Candidate| c.distance < b.crossing.distance) {
                best = Some(candidate!(index, c));
                limit = limit.min(c.distance);
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
        self.instances[hit.instance as usize].surface_at(ray, hit)
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
        self.instances[index as usize].surface_drawn(index, sample, direction, distance)
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
