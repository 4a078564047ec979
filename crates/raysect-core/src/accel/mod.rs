//! Finding the few instances whose boxes a ray meets.

mod list;
mod tree;
pub mod wide;

use std::fmt;
use std::sync::Arc;

use raysect_math::{Point3D, Vector3D};

pub use list::List;
pub use tree::Tree;

use crate::{BoundingBox3D, Ray};

/// A ray prepared for many box tests.
#[derive(Debug, Clone, Copy)]
pub struct TraversalRay {
    /// Where the ray begins [m].
    pub origin: Point3D,
    /// One over the components of its direction; infinite where a component is 0.
    pub inverse: Vector3D,
    /// Where it goes.
    pub direction: Vector3D,
    /// Boxes that end before this distance are passed over; a little below 0 for a ray that leaves a surface.
    pub min: f64,
    /// For each axis, true if the ray meets the upper face first.
    backward: [bool; 3],
}

/// A box as traversal wants it: the lower and the upper coordinates, picked by the sign of the ray.
pub type Slabs = [[f64; 3]; 2];

/// The faces of a box.
pub fn slabs(b: &BoundingBox3D) -> Slabs {
    [b.lower.to_array(), b.upper.to_array()]
}

impl TraversalRay {
    /// Prepares a ray.
    #[inline]
    pub fn new(ray: &Ray, min: f64) -> Self {
        let d = ray.direction;
        let inverse = Vector3D::new(1.0 / d.x, 1.0 / d.y, 1.0 / d.z);
        let backward = [inverse.x < 0.0, inverse.y < 0.0, inverse.z < 0.0];
        Self { origin: ray.origin, inverse, direction: d, min, backward }
    }

    /// Distance at which the ray enters the box, if it meets it between `min` and `limit`.
    ///
    /// The order of the operands drops the NaN of 0 · ∞ (a ray in the plane of a face meets the box), and the far
    /// distance is enlarged by the rounding of the test (T. Ize, *Robust BVH Ray Traversal*, JCGT 2(2), 2013).
    #[inline(always)]
    pub fn enter(&self, b: &Slabs, limit: f64) -> Option<f64> {
        const GROW: f64 = 1.0 + 8.0 * f64::EPSILON;
        let (o, i, s) = (self.origin, self.inverse, self.backward);
        let near = |axis: usize, o: f64, i: f64| (b[usize::from(s[axis])][axis] - o) * i;
        let far = |axis: usize, o: f64, i: f64| (b[usize::from(!s[axis])][axis] - o) * i;
        let larger = |a: f64, b: f64| if a > b { a } else { b };
        let smaller = |a: f64, b: f64| if a < b { a } else { b };
        let first = larger(near(2, o.z, i.z), larger(near(1, o.y, i.y), larger(near(0, o.x, i.x), self.min)));
        let last =
            smaller(far(2, o.z, i.z), smaller(far(1, o.y, i.y), smaller(far(0, o.x, i.x), f64::INFINITY)));
        (first <= smaller(larger(last * GROW, last), limit)).then_some(first)
    }
}

/// Asked for every instance whose box the ray meets; answers with the distance beyond which nothing is wanted any
/// more (negative infinity ends the search).
pub type Visitor<'a> = dyn FnMut(u32, f64) -> f64 + 'a;

/// A structure over the boxes of the instances of a scene.
///
/// It may only decide in which order and how few instances are visited, never what is hit: any order and any
/// superset give the same result.
pub trait Accelerator: Send + Sync {
    /// Visits the instances whose boxes the ray meets between `ray.min` and `limit`.
    fn visit(&self, ray: &TraversalRay, limit: f64, visitor: &mut Visitor<'_>);

    /// Visits the instances whose boxes contain a point, in ascending order of their numbers.
    fn visit_containing(&self, point: Point3D, visitor: &mut dyn FnMut(u32));

    /// What it is, for `plan`.
    fn describe(&self) -> String;
}

/// Builds a user's own [`Accelerator`] from the boxes of the instances [m].
pub type AcceleratorBuilder = dyn Fn(&[BoundingBox3D]) -> Box<dyn Accelerator> + Send + Sync;

/// Which [`Accelerator`] a world builds.
#[derive(Clone, Default)]
pub enum Acceleration {
    /// A list for few instances, a tree for many.
    #[default]
    Automatic,
    /// Every box is tested (Raysect's `Unaccelerated`).
    List,
    /// A hierarchy of boxes.
    Tree,
    /// A user's own.
    Custom(Arc<AcceleratorBuilder>),
}

impl fmt::Debug for Acceleration {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Automatic => "Automatic",
            Self::List => "List",
            Self::Tree => "Tree",
            Self::Custom(_) => "Custom",
        })
    }
}

/// Up to this many instances a list is faster than a tree.
const LIST_LIMIT: usize = 12;

impl Acceleration {
    /// Builds the structure over boxes [m].
    pub fn build(&self, boxes: &[BoundingBox3D]) -> Box<dyn Accelerator> {
        match self {
            Self::Custom(builder) => builder(boxes),
            Self::List => Box::new(List::new(boxes)),
            Self::Tree => Box::new(Tree::new(boxes)),
            Self::Automatic if boxes.len() <= LIST_LIMIT => Box::new(List::new(boxes)),
            Self::Automatic => Box::new(Tree::new(boxes)),
        }
    }
}
