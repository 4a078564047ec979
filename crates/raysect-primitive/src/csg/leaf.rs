use std::any::Any;
use std::sync::Arc;

use raysect_core::accel::{Slabs, slabs};
use raysect_core::{BoundingBox3D, Primitive, Ray};
use raysect_math::{AffineMatrix3D, Point3D};

use super::operand::{Probe, moved, norm};
use crate::chord::Chord;
use crate::{Cone, Cuboid, Cylinder, Parabola, Sphere};

/// A convex shape whose chords are had without asking through `dyn`.
#[derive(Clone, Copy)]
enum Convex {
    Sphere(Sphere),
    Cuboid(Cuboid),
    Cylinder(Cylinder),
    Cone(Cone),
    Parabola(Parabola),
}

/// A convex leaf of a composite, with the maps that lead from the space of the composite to its own.
#[derive(Clone)]
pub(super) struct Leaf {
    shape: Convex,
    /// The last of the maps, and those before it, outermost first: one for each composite on the way that places the next
    /// one or the leaf. They are not multiplied: the crossings are to be those of composites that ask each other, to the
    /// bit.
    to_local: Option<AffineMatrix3D>,
    before: Vec<AffineMatrix3D>,
    /// Around it in the space of the composite, if it is not there already: to move a line takes longer than to test a box.
    bounds: Option<BoundingBox3D>,
    tested: Option<Slabs>,
    /// By how much the maps together stretch the greatest component of a vector, at most.
    stretch: f64,
}

/// A shape as what it is, shared or not.
pub(super) fn known<T: Primitive>(shape: &dyn Primitive) -> Option<&T> {
    let any: &dyn Any = shape;
    any.downcast_ref::<T>().or_else(|| any.downcast_ref::<Arc<T>>().map(|shared| &**shared))
}

/// What is shared as any shape.
pub(super) fn unwrapped(mut shape: &dyn Primitive) -> &dyn Primitive {
    while let Some(shared) = (shape as &dyn Any).downcast_ref::<Arc<dyn Primitive>>() {
        shape = &**shared;
    }
    shape
}

impl Leaf {
    /// The shape where it is, if it is one of the convex ones.
    pub(super) fn of(shape: &dyn Primitive) -> Option<Self> {
        let shape = known(shape)
            .map(|s| Convex::Sphere(*s))
            .or_else(|| known(shape).map(|s| Convex::Cuboid(*s)))
            .or_else(|| known(shape).map(|s| Convex::Cylinder(*s)))
            .or_else(|| known(shape).map(|s| Convex::Cone(*s)))
            .or_else(|| known(shape).map(|s| Convex::Parabola(*s)))?;
        Some(Self { shape, to_local: None, before: Vec::new(), bounds: None, tested: None, stretch: 1.0 })
    }

    /// The same as a composite knows it that places the one it belonged to, by a map and its inverse.
    pub(super) fn below(mut self, to_parent: &AffineMatrix3D, to_local: &AffineMatrix3D) -> Self {
        let bounds = match self.bounds {
            None => self.shape.as_primitive().bounding_box(to_parent),
            Some(bounds) => bounds.transformed(to_parent),
        };
        (self.bounds, self.tested) = (Some(bounds), Some(slabs(&bounds)));
        match self.to_local {
            None => self.to_local = Some(*to_local),
            Some(_) => self.before.insert(0, *to_local),
        }
        self.stretch *= norm(to_local);
        self
    }

    /// False if a line certainly passes it by between two distances, as far as that is soon said.
    #[inline(always)]
    pub(super) fn may_meet(&self, probe: &Probe, first: f64, last: f64) -> bool {
        self.tested.as_ref().is_none_or(|bounds| probe.meets(bounds, first, last))
    }

    /// What of a line is within.
    #[inline]
    pub(super) fn chord(&self, ray: &Ray) -> Option<Chord> {
        let room;
        let local = match &self.to_local {
            None => ray,
            Some(map) if self.before.is_empty() => {
                room = moved(map, ray);
                &room
            }
            Some(map) => {
                room = moved(map, &self.before.iter().fold(*ray, |ray, map| moved(map, &ray)));
                &room
            }
        };
        self.shape.chord(local)
    }

    /// Whether a point is inside, if the surface is known to be farther away than a distance, all in the space of the
    /// composite.
    #[inline]
    pub(super) fn is_inside(&self, point: Point3D, distance: f64) -> Option<bool> {
        let before = self.before.iter().fold(point, |point, map| map.transform_point(point));
        let depth =
            self.shape.depth(self.to_local.as_ref().map_or(before, |map| map.transform_point(before)));
        (depth.abs() > distance * self.stretch).then_some(depth > 0.0)
    }
}

impl Convex {
    fn as_primitive(&self) -> &dyn Primitive {
        match self {
            Self::Sphere(shape) => shape,
            Self::Cuboid(shape) => shape,
            Self::Cylinder(shape) => shape,
            Self::Cone(shape) => shape,
            Self::Parabola(shape) => shape,
        }
    }

    #[inline]
    fn chord(&self, ray: &Ray) -> Option<Chord> {
        match self {
            Self::Sphere(shape) => shape.chord(ray),
            Self::Cuboid(shape) => shape.chord(ray),
            Self::Cylinder(shape) => shape.chord(ray),
            Self::Cone(shape) => shape.chord(ray),
            Self::Parabola(shape) => shape.chord(ray),
        }
    }

    /// A distance within which there is no surface [m], negative outside; NaN if it does not know.
    #[inline]
    fn depth(&self, point: Point3D) -> f64 {
        match self {
            Self::Sphere(shape) => shape.depth(point),
            Self::Cuboid(shape) => shape.depth(point),
            Self::Cylinder(shape) => shape.depth(point),
            Self::Cone(shape) => shape.depth(point),
            Self::Parabola(_) => f64::NAN,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use raysect_math::{Rng, SphereSampler, Vector3D, rotate, translate};

    fn shapes() -> Vec<Arc<dyn Primitive>> {
        vec![
            Arc::new(Sphere::new(0.8).unwrap()),
            Arc::new(Cuboid::new([-0.7, -0.5, -0.6].into(), [0.6, 0.8, 0.5].into()).unwrap()),
            Arc::new(Arc::new(Cylinder::new(0.4, 1.7).unwrap())),
            Arc::new(Cone::new(0.9, 0.6).unwrap()),
            Arc::new(Parabola::new(0.6, 1.1).unwrap()),
        ]
    }

    /// How many of many points within a part of the distance that a leaf claims to be free of its surface are on the
    /// other side of it after all, and how many there are.
    fn trespassers(leaf: &Leaf, shape: &dyn Primitive, to_local: AffineMatrix3D, part: f64) -> [usize; 2] {
        let contains = |p: Point3D| shape.contains(to_local * p);
        let (mut rng, mut counts) = (Rng::new(61), [0; 2]);
        for _ in 0..20_000 {
            let p = Point3D::ORIGIN + SphereSampler.sample(&mut rng) * rng.range(0.0, 3.0);
            let distance = 10f64.powf(rng.range(-2.0, 0.0));
            let Some(inside) = leaf.is_inside(p, distance) else { continue };
            let q = p + SphereSampler.sample(&mut rng) * (part * distance);
            counts[0] += usize::from(contains(q) != inside);
            counts[1] += 1;
        }
        counts
    }

    #[test]
    fn surfaces_are_as_far_away_as_leaves_say() {
        let uneven = AffineMatrix3D::from_axes(
            Vector3D::new(0.9, 0.2, 0.0),
            Vector3D::new(-0.3, 1.1, 0.1),
            Vector3D::new(0.0, 0.3, 0.8),
            Point3D::new(0.1, -0.1, 0.2),
        );
        for shape in shapes() {
            let plain = Leaf::of(&*shape).unwrap();
            let turned = translate(0.1, 0.2, -0.1) * rotate(20.0, 30.0, 40.0);
            let (out, back) = (uneven.inverse().unwrap(), turned.inverse().unwrap());
            let placed = plain.clone().below(&out, &uneven).below(&back, &turned);
            let both = uneven * turned;
            let silent = shape.kind().contains("Parabola");
            for (leaf, to_local) in [(plain, AffineMatrix3D::IDENTITY), (placed, both)] {
                // A map may stretch the length of a vector by √3 times as much as its greatest component.
                let [wrong, known] = trespassers(&leaf, &*shape, to_local, 1.0 / 3f64.sqrt());
                assert!(wrong == 0 && (known > 5000) != silent, "{}: {wrong} of {known}", shape.kind());
                let [wrong, known] = trespassers(&leaf, &*shape, to_local, 4.0);
                assert!(silent || wrong > 20, "{}: {wrong} of {known}", shape.kind());
            }
        }
    }

    #[test]
    fn chords_are_the_crossings_of_the_shape() {
        let m = translate(0.1, 0.2, -0.1) * rotate(20.0, 30.0, 40.0);
        let mut rng = Rng::new(62);
        for shape in shapes() {
            let leaf = Leaf::of(&*shape).unwrap().below(&m.inverse().unwrap(), &m);
            let mut met = 0;
            for _ in 0..1000 {
                let from = Point3D::ORIGIN + SphereSampler.sample(&mut rng) * 3.0;
                let ray = Ray::new(from, from.vector_to(Point3D::ORIGIN) + SphereSampler.sample(&mut rng));
                let mut all = Vec::new();
                shape.crossings(&moved(&m, &ray), &mut Default::default(), &mut all);
                assert_eq!(leaf.chord(&ray).iter().flat_map(Chord::crossings).collect::<Vec<_>>(), all);
                met += all.len();
            }
            assert!(met > 400, "{}: {met}", shape.kind());
        }
    }

    #[test]
    fn shapes_that_are_not_known_are_no_leaves() {
        assert!(Leaf::of(&crate::Torus::new(0.7, 0.3).unwrap()).is_none());
        let shared: Arc<dyn Primitive> = Arc::new(Sphere::default());
        let again: Arc<dyn Primitive> = Arc::new(shared);
        assert!(Leaf::of(unwrapped(&again)).is_some() && Leaf::of(&again).is_none());
    }
}
