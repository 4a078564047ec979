//! The contract of a shape.

use std::any::Any;
use std::sync::Arc;

use raysect_math::{AffineMatrix3D, Normal3D, Point3D, Vector3D};

use crate::accel::wide::TraversalStack;
use crate::save::{SaveError, Saved, SceneWriter, save_shared, short_name};
use crate::{BoundingBox3D, BoundingSphere3D, Interval, Ray};

/// Names the leaf of a composite, the face of a leaf and the place on the face.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Feature {
    /// Leaf of a composite shape; 0 for a plain one.
    pub part: u32,
    /// Face of the leaf (the triangle of a mesh).
    pub face: u32,
    /// Coordinates on the face, as the shape defines them (barycentric v, w of a triangle).
    pub uv: [f64; 2],
}

/// A place where a line crosses the surface of a shape.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Crossing {
    /// Distance along the ray, in units of the direction's length.
    pub distance: f64,
    /// Which piece of the surface.
    pub feature: Feature,
    /// True if the line leaves the shape there.
    pub exiting: bool,
}

/// How a ray that starts on the surface of a shape leaves it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Departure {
    /// True if the ray goes to the inside of the surface.
    pub inward: bool,
    /// The crossing that is being left lies within ± this distance of the ray's origin.
    pub bound: f64,
    /// The piece of the surface that is being left.
    pub feature: Feature,
}

impl Departure {
    /// Which of the crossings in order is the one that is being left, if one is: of the right kind, rather on the face
    /// that is left than on another, and rather near than far.
    ///
    /// `steepness` is the cosine between the ray and the surface at a crossing. A ray along a face is in doubt far along
    /// its way, where it crosses other faces: these are left only if they may go through the origin of the ray.
    pub fn left_among(
        &self,
        crossings: impl Iterator<Item = Crossing>,
        steepness: impl Fn(&Crossing) -> f64,
    ) -> Option<usize> {
        let elsewhere =
            |c: &Crossing| (c.feature.part, c.feature.face) != (self.feature.part, self.feature.face);
        let candidates =
            crossings.enumerate().filter(|(_, c)| c.exiting != self.inward && c.distance.abs() <= self.bound);
        let (index, left) = candidates.min_by(|(_, a), (_, b)| {
            elsewhere(a).cmp(&elsewhere(b)).then(a.distance.abs().total_cmp(&b.distance.abs()))
        })?;
        (!elsewhere(&left) || self.goes_through(&left, steepness)).then_some(index)
    }

    /// True if the surface at a crossing may go through the origin of the ray, as far as rounding can tell.
    pub fn goes_through(&self, crossing: &Crossing, steepness: impl Fn(&Crossing) -> f64) -> bool {
        let here = Crossing { distance: 0.0, feature: self.feature, exiting: !self.inward };
        crossing.distance.abs() * steepness(crossing) <= 4.0 * self.bound * steepness(&here)
    }
}

/// The surface at a crossing, in the local space of the shape.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Surface {
    /// The point, brought back onto the surface as exactly as rounding allows [m].
    pub point: Point3D,
    /// The outward unit normal of the geometry.
    pub normal: Normal3D,
    /// The outward unit normal to shade with; differs from `normal` on smoothed meshes only.
    pub shading_normal: Normal3D,
    /// Bound on the distance of `point` from the true surface [m].
    pub bound: f64,
}

/// A point drawn on a surface by [`Primitive::sample_surface`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SurfaceSample {
    /// The point [m].
    pub point: Point3D,
    /// The outward unit normal there.
    pub normal: Normal3D,
    /// The outward unit normal to shade with, where it is another one.
    pub shading_normal: Option<Normal3D>,
    /// Which piece of the surface.
    pub feature: Feature,
    /// Density of the choice [1/m²].
    pub density: f64,
}

/// A direction drawn towards a shape by [`Primitive::sample_direction`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DirectionSample {
    /// Unit vector towards the shape.
    pub direction: Vector3D,
    /// Density of the choice [1/sr].
    pub density: f64,
}

/// How points on a shape can be chosen as seen from a point, for light sampling.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SurfaceSampling {
    /// Not at all: its bounding sphere is aimed at instead.
    None,
    /// By area: [`Primitive::sample_surface`].
    Area,
    /// By solid angle: [`Primitive::sample_direction`].
    SolidAngle,
}

/// Room for the intermediate results of shapes, lent by the caller and reused: one per worker.
#[derive(Debug, Default)]
pub struct Scratch {
    pool: Vec<Vec<Crossing>>,
    stack: TraversalStack,
}

impl Scratch {
    /// An empty list of crossings, to be given back.
    pub fn take(&mut self) -> Vec<Crossing> {
        let mut list = self.pool.pop().unwrap_or_default();
        list.clear();
        list
    }

    /// The stack of a walk through a [`WideTree`](crate::accel::wide::WideTree).
    #[inline]
    pub fn stack(&mut self) -> &mut TraversalStack {
        &mut self.stack
    }

    /// Takes a list back for later use.
    pub fn give_back(&mut self, list: Vec<Crossing>) {
        self.pool.push(list);
    }
}

/// A shape. It answers in its own local space, keeps no state between calls, and knows nothing of materials.
///
/// # Contract
/// [`testing::check_primitive`](crate::testing::check_primitive) tests all of this:
/// - `crossings` reports every crossing of the infinite line, in order. Those of a solid alternate between
///   entering and leaving, beginning with entering; a touch gives none or a pair.
/// - `hit`, `hit_after` and `crossings_within` report what `crossings` reports.
/// - `contains` agrees with the parity of the crossings.
/// - The bounding box contains every surface point, under every affine map.
pub trait Primitive: Any + Send + Sync {
    /// A tight box around the image of the shape under `m`, rounded outward.
    fn bounding_box(&self, m: &AffineMatrix3D) -> BoundingBox3D;

    /// A sphere around the image of the shape under `m`.
    fn bounding_sphere(&self, m: &AffineMatrix3D) -> BoundingSphere3D {
        self.bounding_box(m).enclosing_sphere()
    }

    /// True for points inside and on the surface of a solid.
    fn contains(&self, point: Point3D) -> bool;

    /// Appends every crossing of the infinite line through the ray, in order of distance.
    fn crossings(&self, ray: &Ray, scratch: &mut Scratch, out: &mut Vec<Crossing>);

    /// As [`crossings`](Self::crossings), for a caller to whom only an interval of distances matters.
    ///
    /// What is appended agrees with the shape within the interval: with all its crossings there, and with whether the
    /// ends are inside. Crossings beyond may be missing or others, as long as all are in order and alternate. A composite
    /// so passes over operands that lie elsewhere.
    fn crossings_within(&self, ray: &Ray, _within: Interval, scratch: &mut Scratch, out: &mut Vec<Crossing>) {
        self.crossings(ray, scratch, out);
    }

    /// The first crossing within an interval of distances.
    fn hit(&self, ray: &Ray, within: Interval, scratch: &mut Scratch) -> Option<Crossing> {
        let mut all = scratch.take();
        self.crossings(ray, scratch, &mut all);
        let first = all.iter().copied().find(|c| within.contains(c.distance));
        scratch.give_back(all);
        first
    }

    /// The next crossing of a ray that starts on this very surface, up to `max_distance`.
    ///
    /// The crossing that is being left is recognised by its kind (a ray that goes inward has just entered), by its piece
    /// of the surface and by being nearest to the origin, not by an offset; the answer is the one that follows it.
    fn hit_after(
        &self,
        ray: &Ray,
        departure: &Departure,
        max_distance: f64,
        scratch: &mut Scratch,
    ) -> Option<Crossing> {
        let mut all = scratch.take();
        self.crossings(ray, scratch, &mut all);
        let steepness = |c: &Crossing| self.surface(ray, c).normal.dot(ray.direction).abs();
        let left = departure.left_among(all.iter().copied(), steepness);
        let next = match left {
            Some(index) => all.get(index + 1).copied(),
            None => all.iter().copied().find(|c| c.distance > 0.0),
        };
        scratch.give_back(all);
        let next = next.map(|c| Crossing { distance: c.distance.max(0.0), ..c });
        next.filter(|c| c.distance <= max_distance)
    }

    /// Point, normals and error bound at a crossing that this shape has reported for this ray.
    fn surface(&self, ray: &Ray, crossing: &Crossing) -> Surface;

    /// True if it encloses a volume; false for a sheet, which contains nothing.
    fn is_solid(&self) -> bool {
        true
    }

    /// True if a straight line crosses it at most twice.
    fn is_convex(&self) -> bool {
        false
    }

    /// How many leaves it is composed of.
    fn parts(&self) -> u32 {
        1
    }

    /// How points on it can be chosen for light sampling.
    fn surface_sampling(&self) -> SurfaceSampling {
        SurfaceSampling::None
    }

    /// A point on the part of the surface that faces `from`, from three uniforms in (0, 1).
    fn sample_surface(&self, _from: Point3D, _u: [f64; 3]) -> Option<SurfaceSample> {
        None
    }

    /// Density [1/m²] with which [`sample_surface`](Self::sample_surface) chooses `point` on the piece `feature`.
    fn surface_density(&self, _from: Point3D, _point: Point3D, _feature: Feature) -> f64 {
        0.0
    }

    /// A direction from `from` towards the shape, from two uniforms in (0, 1).
    fn sample_direction(&self, _from: Point3D, _u: [f64; 2]) -> Option<DirectionSample> {
        None
    }

    /// Density [1/sr] with which [`sample_direction`](Self::sample_direction) chooses a unit direction.
    fn direction_density(&self, _from: Point3D, _direction: Vector3D) -> f64 {
        0.0
    }

    /// What a file needs to know to make it again; see [`save`](crate::save). A composite refers to its parts by
    /// [`SceneWriter::shared_object`].
    ///
    /// # Errors
    /// [`SaveError::NotSaved`] by default.
    fn save(&self, _writer: &mut SceneWriter) -> Result<Saved, SaveError> {
        let kind = short_name(std::any::type_name::<Self>()).to_owned();
        Err(SaveError::NotSaved { role: "shape", kind })
    }

    /// What it is, for lists and messages.
    fn kind(&self) -> &'static str {
        let full = std::any::type_name::<Self>();
        full.rsplit("::").next().unwrap_or(full)
    }
}

impl<P: Primitive + ?Sized> Primitive for Arc<P> {
    fn bounding_box(&self, m: &AffineMatrix3D) -> BoundingBox3D {
        (**self).bounding_box(m)
    }
    fn bounding_sphere(&self, m: &AffineMatrix3D) -> BoundingSphere3D {
        (**self).bounding_sphere(m)
    }
    fn contains(&self, point: Point3D) -> bool {
        (**self).contains(point)
    }
    fn crossings(&self, ray: &Ray, scratch: &mut Scratch, out: &mut Vec<Crossing>) {
        (**self).crossings(ray, scratch, out);
    }
    fn crossings_within(&self, ray: &Ray, within: Interval, scratch: &mut Scratch, out: &mut Vec<Crossing>) {
        (**self).crossings_within(ray, within, scratch, out);
    }
    fn hit(&self, ray: &Ray, within: Interval, scratch: &mut Scratch) -> Option<Crossing> {
        (**self).hit(ray, within, scratch)
    }
    fn hit_after(&self, ray: &Ray, left: &Departure, max: f64, scratch: &mut Scratch) -> Option<Crossing> {
        (**self).hit_after(ray, left, max, scratch)
    }
    fn surface(&self, ray: &Ray, crossing: &Crossing) -> Surface {
        (**self).surface(ray, crossing)
    }
    fn is_solid(&self) -> bool {
        (**self).is_solid()
    }
    fn is_convex(&self) -> bool {
        (**self).is_convex()
    }
    fn parts(&self) -> u32 {
        (**self).parts()
    }
    fn surface_sampling(&self) -> SurfaceSampling {
        (**self).surface_sampling()
    }
    fn sample_surface(&self, from: Point3D, u: [f64; 3]) -> Option<SurfaceSample> {
        (**self).sample_surface(from, u)
    }
    fn surface_density(&self, from: Point3D, point: Point3D, feature: Feature) -> f64 {
        (**self).surface_density(from, point, feature)
    }
    fn sample_direction(&self, from: Point3D, u: [f64; 2]) -> Option<DirectionSample> {
        (**self).sample_direction(from, u)
    }
    fn direction_density(&self, from: Point3D, direction: Vector3D) -> f64 {
        (**self).direction_density(from, direction)
    }
    fn save(&self, writer: &mut SceneWriter) -> Result<Saved, SaveError> {
        save_shared(self, writer)
    }
    fn kind(&self) -> &'static str {
        (**self).kind()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Nothing but an answer that depends on the interval that is asked for.
    struct Echo;

    impl Primitive for Echo {
        fn bounding_box(&self, _: &AffineMatrix3D) -> BoundingBox3D {
            BoundingBox3D::EMPTY
        }
        fn contains(&self, _: Point3D) -> bool {
            false
        }
        fn crossings(&self, _: &Ray, _: &mut Scratch, _: &mut Vec<Crossing>) {}
        fn crossings_within(&self, _: &Ray, within: Interval, _: &mut Scratch, out: &mut Vec<Crossing>) {
            let at = |distance| Crossing { distance, feature: Feature::default(), exiting: false };
            out.extend([within.min, within.max].map(at));
        }
        fn surface(&self, ray: &Ray, _: &Crossing) -> Surface {
            let normal = Normal3D::new(0.0, 0.0, 1.0);
            Surface { point: ray.origin, normal, shading_normal: normal, bound: 0.0 }
        }
    }

    #[test]
    fn shared_shapes_are_told_which_interval_matters() {
        let shared: Arc<dyn Primitive> = Arc::new(Arc::new(Echo));
        let ray = Ray::new(Point3D::ORIGIN, Vector3D::Z);
        let mut out = Vec::new();
        Primitive::crossings_within(
            &shared,
            &ray,
            Interval::new(2.0, 5.0),
            &mut Scratch::default(),
            &mut out,
        );
        assert_eq!(out.iter().map(|c| c.distance).collect::<Vec<_>>(), [2.0, 5.0]);
    }
}
