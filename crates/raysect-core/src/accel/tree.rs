use fearless_simd::{Level, Simd, dispatch};
use raysect_math::Point3D;

use super::wide::{LEAF_ITEMS, LeafTest, NO_ITEM, TraversalStack, TreeRay, WideTree};
use super::{Accelerator, Slabs, TraversalRay, Visitor, slabs};
use crate::{BoundingBox3D, Interval, Ray};

/// A hierarchy of boxes with eight children to a node: a [`WideTree`] over the instances.
#[derive(Debug)]
#[doc(alias = "KDTree")]
pub struct Tree {
    tree: WideTree,
    boxes: Vec<BoundingBox3D>,
    slabs: Vec<Slabs>,
    /// Instances without end, which no tree can hold.
    endless: Vec<u32>,
    level: Level,
}

fn is_endless(b: &BoundingBox3D) -> bool {
    let finite = b.lower.is_finite() && b.upper.is_finite() && b.largest_extent().is_finite();
    !finite && !b.is_empty()
}

impl Tree {
    /// Over boxes [m].
    pub fn new(boxes: &[BoundingBox3D]) -> Self {
        let endless = (0..boxes.len() as u32).filter(|&i| is_endless(&boxes[i as usize])).collect();
        let finite: Vec<BoundingBox3D> =
            boxes.iter().map(|b| if is_endless(b) { BoundingBox3D::EMPTY } else { *b }).collect();
        Self {
            tree: WideTree::new(&finite),
            slabs: boxes.iter().map(slabs).collect(),
            boxes: boxes.to_vec(),
            endless,
            level: Level::new(),
        }
    }
}

/// Shows the instances of a leaf to a visitor if their boxes, tested exactly, are met.
struct Visit<'a, 'v> {
    tree: &'a Tree,
    ray: &'a TraversalRay,
    tree_ray: &'a TreeRay,
    limit: f64,
    visitor: &'a mut Visitor<'v>,
}

impl Visit<'_, '_> {
    #[inline(always)]
    fn item(&mut self, item: u32) {
        if self.ray.enter(&self.tree.slabs[item as usize], self.limit).is_some() {
            self.limit = (self.visitor)(item, self.limit);
        }
    }
}

impl<S: Simd> LeafTest<S> for Visit<'_, '_> {
    #[inline(always)]
    fn leaf(&mut self, _: S, leaf: u32, limit: f32) -> f32 {
        let before = self.limit;
        let items: [u32; LEAF_ITEMS] = self.tree.tree.leaves()[leaf as usize];
        for item in items.into_iter().take_while(|&i| i != NO_ITEM) {
            self.item(item);
            if self.limit < self.ray.min {
                return f32::NEG_INFINITY;
            }
        }
        if self.limit < before { self.tree_ray.limit(self.limit) } else { limit }
    }
}

impl Accelerator for Tree {
    fn visit(&self, ray: &TraversalRay, mut limit: f64, visitor: &mut Visitor<'_>) {
        for &item in &self.endless {
            if ray.enter(&self.slabs[item as usize], limit).is_some() {
                limit = visitor(item, limit);
                if limit < ray.min {
                    return;
                }
            }
        }
        let plain = Ray::new(ray.origin, ray.direction);
        let Some(tree_ray) = self.tree.prepare(&plain, Interval::new(ray.min, limit)) else { return };
        let end = tree_ray.limit(limit);
        let mut visit = Visit { tree: self, ray, tree_ray: &tree_ray, limit, visitor };
        let mut stack = TraversalStack::default();
        dispatch!(self.level, simd => self.tree.walk(simd, &tree_ray, end, &mut stack, &mut visit));
    }

    fn visit_containing(&self, point: Point3D, visitor: &mut dyn FnMut(u32)) {
        let mut found = self.endless.clone();
        self.tree.around(point.to_array(), |item| found.push(item));
        found.retain(|&item| self.boxes[item as usize].contains(point));
        found.sort_unstable();
        found.into_iter().for_each(visitor);
    }

    fn describe(&self) -> String {
        format!("tree of {} over {}", self.tree.node_count(), self.boxes.len())
    }
}

#[cfg(test)]
mod tests {
    use super::super::List;
    use super::*;
    use crate::Ray;
    use raysect_math::{Rng, Vector3D};

    fn random_boxes(rng: &mut Rng, count: usize, flat: bool) -> Vec<BoundingBox3D> {
        let mut corner =
            |scale: f64| Point3D::new(scale * rng.uniform(), scale * rng.uniform(), scale * rng.uniform());
        (0..count)
            .map(|_| {
                let low = corner(10.0);
                let mut size = corner(1.0).to_vector();
                if flat {
                    size.z = 0.0;
                }
                BoundingBox3D::new(low, low + size).unwrap()
            })
            .collect()
    }

    fn boxes_met(a: &dyn Accelerator, ray: &TraversalRay) -> Vec<u32> {
        let mut met = Vec::new();
        a.visit(ray, f64::INFINITY, &mut |i, limit| {
            met.push(i);
            limit
        });
        met.sort_unstable();
        met
    }

    #[test]
    fn tree_and_list_meet_the_same_boxes() {
        let mut rng = Rng::new(5);
        for (count, flat) in [(0, false), (1, true), (300, false), (300, true)] {
            let boxes = random_boxes(&mut rng, count, flat);
            let (tree, list) = (Tree::new(&boxes), List::new(&boxes));
            for _ in 0..2000 {
                let mut u = || 2.0 * rng.uniform() - 1.0;
                let direction = Vector3D::new(u(), u(), if u() > 0.5 { 0.0 } else { u() });
                let origin = Point3D::new(5.0 + 6.0 * u(), 5.0 + 6.0 * u(), 5.0 + 6.0 * u());
                let ray = TraversalRay::new(&Ray::new(origin, direction), 0.0);
                // Of very few boxes a list does not test any.
                let all = boxes_met(&list, &ray);
                let met = all
                    .into_iter()
                    .filter(|&i| ray.enter(&slabs(&boxes[i as usize]), f64::INFINITY).is_some());
                assert_eq!(boxes_met(&tree, &ray), met.collect::<Vec<_>>());
                let (mut a, mut b) = (Vec::new(), Vec::new());
                tree.visit_containing(origin, &mut |i| a.push(i));
                list.visit_containing(origin, &mut |i| b.push(i));
                assert_eq!(a, b);
            }
        }
    }

    #[test]
    fn boxes_without_end_are_always_visited() {
        let mut boxes = random_boxes(&mut Rng::new(8), 50, false);
        let floor = f64::INFINITY;
        boxes.push(BoundingBox3D {
            lower: Point3D::new(-floor, -floor, -1.0),
            upper: Point3D::new(floor, floor, 0.0),
        });
        let (tree, list) = (Tree::new(&boxes), List::new(&boxes));
        let ray = TraversalRay::new(&Ray::new(Point3D::new(5.0, 5.0, 20.0), -Vector3D::Z), 0.0);
        assert_eq!(boxes_met(&tree, &ray), boxes_met(&list, &ray));
        assert!(boxes_met(&tree, &ray).contains(&50));
    }

    #[test]
    fn equal_boxes_do_not_make_a_bottomless_tree() {
        let b = BoundingBox3D::new(Point3D::ORIGIN, Point3D::new(1.0, 1.0, 1.0)).unwrap();
        let tree = Tree::new(&vec![b; 1000]);
        let ray = TraversalRay::new(&Ray::new(Point3D::new(0.5, 0.5, -1.0), Vector3D::Z), 0.0);
        assert_eq!(boxes_met(&tree, &ray).len(), 1000);
    }
}
