//! Shapes that are wrong on purpose.

use raysect::core::{BoundingBox3D, Crossing, Departure, Interval, Primitive, Ray, Scratch, Surface};
use raysect::math::{AffineMatrix3D, Normal3D, Point3D};

/// What is wrong with a shape.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Fault {
    /// Takes the surface from which a ray starts for the next one.
    Forgets,
    /// Sees everything too far by this part of the distance.
    Stretches(f64),
    /// Sees the exits too far by this part of the size, from inside.
    Shifts(f64),
    /// Has normals that are tilted by this tangent.
    Tilts(f64),
    /// Misses one line in so many.
    Misses(u32),
    /// Bounds that leave out all but this part of the shape.
    Culls(f64),
    /// Says the contrary of where it is.
    Denies,
}

/// A shape with a fault.
pub(crate) struct Wrong<P>(pub(crate) P, pub(crate) Fault);

impl<P: Primitive> Wrong<P> {
    fn spoil(&self, mut crossing: Crossing) -> Crossing {
        if let Fault::Stretches(part) = self.1 {
            crossing.distance *= 1.0 + part;
        }
        crossing
    }

    fn misses(&self, ray: &Ray) -> bool {
        let Fault::Misses(one_in) = self.1 else { return false };
        let bits = ray.direction.x.to_bits() ^ ray.direction.y.to_bits().rotate_left(17);
        (bits.wrapping_mul(0x9e37_79b9_7f4a_7c15) >> 40).is_multiple_of(u64::from(one_in))
    }
}

impl<P: Primitive> Primitive for Wrong<P> {
    fn bounding_box(&self, m: &AffineMatrix3D) -> BoundingBox3D {
        let whole = self.0.bounding_box(m);
        let Fault::Culls(part) = self.1 else { return whole };
        let centre = whole.enclosing_sphere().centre;
        let near = |p: Point3D| centre + centre.vector_to(p) * part;
        BoundingBox3D::around([near(whole.lower), near(whole.upper)])
    }

    fn contains(&self, point: Point3D) -> bool {
        self.0.contains(point) != (self.1 == Fault::Denies)
    }

    fn crossings(&self, ray: &Ray, scratch: &mut Scratch, out: &mut Vec<Crossing>) {
        if !self.misses(ray) {
            let before = out.len();
            self.0.crossings(ray, scratch, out);
            out[before..].iter_mut().for_each(|c| *c = self.spoil(*c));
            if let Fault::Shifts(by) = self.1 {
                let inside = out[before..].iter().any(|c| c.distance < 0.0);
                let exits = out[before..].iter_mut().filter(|c| c.exiting && inside);
                exits.for_each(|c| c.distance += by);
            }
        }
    }

    fn hit(&self, ray: &Ray, within: Interval, scratch: &mut Scratch) -> Option<Crossing> {
        if self.misses(ray) { None } else { self.0.hit(ray, within, scratch).map(|c| self.spoil(c)) }
    }

    fn hit_after(&self, ray: &Ray, left: &Departure, max: f64, scratch: &mut Scratch) -> Option<Crossing> {
        if self.misses(ray) {
            return None;
        }
        let next = if self.1 == Fault::Forgets {
            self.0.hit(ray, Interval::new(0.0, max), scratch)
        } else {
            self.0.hit_after(ray, left, max, scratch)
        };
        next.map(|c| self.spoil(c))
    }

    fn surface(&self, ray: &Ray, crossing: &Crossing) -> Surface {
        let surface = self.0.surface(ray, crossing);
        let Fault::Tilts(tangent) = self.1 else { return surface };
        let n = surface.normal.as_vector();
        let aside = n.orthogonal().unwrap_or(n);
        let normal = Normal3D::from(n + aside * tangent).normalise_unchecked();
        Surface { normal, shading_normal: normal, ..surface }
    }

    fn is_convex(&self) -> bool {
        self.0.is_convex()
    }
}
