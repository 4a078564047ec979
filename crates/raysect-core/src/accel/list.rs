use raysect_math::Point3D;

use super::{Accelerator, TraversalRay, Visitor};
use crate::BoundingBox3D;

/// Tests the box of every instance: the fastest structure for a handful of them.
#[derive(Debug)]
pub struct List {
    boxes: Vec<BoundingBox3D>,
}

impl List {
    /// Over boxes [m].
    pub fn new(boxes: &[BoundingBox3D]) -> Self {
        Self { boxes: boxes.to_vec() }
    }
}

impl Accelerator for List {
    fn visit(&self, ray: &TraversalRay, mut limit: f64, visitor: &mut Visitor<'_>) {
        for (index, b) in self.boxes.iter().enumerate() {
            if ray.enter(b, limit).is_some() {
                limit = visitor(index as u32, limit);
                if limit < ray.min {
                    return;
                }
            }
        }
    }

    fn visit_containing(&self, point: Point3D, visitor: &mut dyn FnMut(u32)) {
        for (index, b) in self.boxes.iter().enumerate() {
            if b.contains(point) {
                visitor(index as u32);
            }
        }
    }

    fn describe(&self) -> String {
        format!("list of {}", self.boxes.len())
    }
}
