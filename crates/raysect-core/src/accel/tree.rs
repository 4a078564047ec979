use raysect_math::Point3D;

use super::{Accelerator, Slabs, TraversalRay, Visitor, slabs};
use crate::BoundingBox3D;

/// A binary hierarchy of boxes, split by the surface area heuristic (I. Wald, *On fast Construction of SAH-based
/// Bounding Volume Hierarchies*, 2007).
#[derive(Debug)]
pub struct Tree {
    nodes: Vec<TreeNode>,
    order: Vec<u32>,
    boxes: Vec<BoundingBox3D>,
    slabs: Vec<Slabs>,
}

#[derive(Debug, Clone, Copy)]
struct TreeNode {
    bounds: BoundingBox3D,
    slabs: Slabs,
    /// A leaf holds `order[first..first + count]`; a branch (count 0) has the children `first` and `first + 1`.
    first: u32,
    count: u32,
}

impl TreeNode {
    fn new(first: u32, count: u32) -> Self {
        let bounds = BoundingBox3D::EMPTY;
        Self { bounds, slabs: slabs(&bounds), first, count }
    }
}

const BINS: usize = 16;
const LEAF: usize = 2;
/// Cost of testing an instance in units of the test of a box.
const HIT_COST: f64 = 8.0;
/// A balanced subtree of four thousand million leaves is 32 deep; splits by the middle end a bad one.
const STACK: usize = 64;
const MAX_DEPTH: usize = 48;

impl Tree {
    /// Over boxes [m].
    pub fn new(boxes: &[BoundingBox3D]) -> Self {
        let order: Vec<u32> = (0..boxes.len() as u32).filter(|&i| !boxes[i as usize].is_empty()).collect();
        let root = TreeNode::new(0, order.len() as u32);
        let slabs = boxes.iter().map(slabs).collect();
        let mut tree = Self { nodes: vec![root], order, boxes: boxes.to_vec(), slabs };
        tree.split(0, 0);
        tree
    }

    fn split(&mut self, node: usize, depth: usize) {
        let (first, count) = (self.nodes[node].first as usize, self.nodes[node].count as usize);
        let members = &self.order[first..first + count];
        let union = |members: &[u32]| {
            members.iter().fold(BoundingBox3D::EMPTY, |b, &i| b.union(&self.boxes[i as usize]))
        };
        let bounds = union(members);
        self.nodes[node].bounds = bounds;
        self.nodes[node].slabs = slabs(&bounds);
        if count <= LEAF {
            return;
        }
        let middle = match self.best_split(members, &bounds) {
            Some((axis, position)) if depth < MAX_DEPTH => {
                let boxes = &self.boxes;
                let below = |i: &u32| boxes[*i as usize].centre()[axis] < position;
                self.order[first..first + count].sort_by_key(|i| (!below(i), *i));
                first + self.order[first..first + count].iter().filter(|i| below(i)).count()
            }
            Some(_) => first + count / 2,
            None => return,
        };
        let children = self.nodes.len();
        for (start, end) in [(first, middle), (middle, first + count)] {
            self.nodes.push(TreeNode::new(start as u32, (end - start) as u32));
        }
        self.nodes[node].first = children as u32;
        self.nodes[node].count = 0;
        self.split(children, depth + 1);
        self.split(children + 1, depth + 1);
    }

    /// Axis and position of the cheapest split, unless a leaf is cheaper.
    fn best_split(&self, members: &[u32], bounds: &BoundingBox3D) -> Option<(usize, f64)> {
        let centres = BoundingBox3D::around(members.iter().map(|&i| self.boxes[i as usize].centre()));
        let leaf_cost = HIT_COST * members.len() as f64 * bounds.surface_area();
        let mut best: Option<(f64, usize, f64)> = None;
        for axis in 0..3 {
            let (low, extent) = (centres.lower[axis], centres.extent(axis));
            if extent <= 0.0 || !extent.is_finite() {
                continue;
            }
            let mut bins = [(BoundingBox3D::EMPTY, 0usize); BINS];
            for &i in members {
                let b = &self.boxes[i as usize];
                let bin = (((b.centre()[axis] - low) / extent * BINS as f64) as usize).min(BINS - 1);
                bins[bin] = (bins[bin].0.union(b), bins[bin].1 + 1);
            }
            for cut in 1..BINS {
                let side = |range: &[(BoundingBox3D, usize)]| {
                    let (b, n) =
                        range.iter().fold((BoundingBox3D::EMPTY, 0), |a, b| (a.0.union(&b.0), a.1 + b.1));
                    (n, b.surface_area() * n as f64)
                };
                let ((lower, a), (upper, b)) = (side(&bins[..cut]), side(&bins[cut..]));
                let cost = 2.0 * bounds.surface_area() + HIT_COST * (a + b);
                if lower > 0 && upper > 0 && best.is_none_or(|(c, _, _)| cost < c) {
                    best = Some((cost, axis, low + extent * cut as f64 / BINS as f64));
                }
            }
        }
        // A leaf may be cheaper, but never a long one: boxes that overlap must still be told apart somewhere.
        best.filter(|(cost, _, _)| *cost < leaf_cost || members.len() > 8).map(|(_, axis, at)| (axis, at))
    }

    fn leaf(&self, node: &TreeNode) -> &[u32] {
        &self.order[node.first as usize..(node.first + node.count) as usize]
    }
}

impl Accelerator for Tree {
    fn visit(&self, ray: &TraversalRay, mut limit: f64, visitor: &mut Visitor<'_>) {
        let mut stack = [(0u32, 0.0f64); STACK];
        let mut height = 0;
        if self.order.is_empty() {
            return;
        }
        if let Some(near) = ray.enter(&self.nodes[0].slabs, limit) {
            stack[0] = (0, near);
            height = 1;
        }
        while height > 0 {
            height -= 1;
            let (index, near) = stack[height];
            if near > limit {
                continue;
            }
            let node = &self.nodes[index as usize];
            if node.count > 0 {
                for &i in self.leaf(node) {
                    if ray.enter(&self.slabs[i as usize], limit).is_some() {
                        limit = visitor(i, limit);
                        if limit < ray.min {
                            return;
                        }
                    }
                }
                continue;
            }
            let children = [node.first, node.first + 1];
            let [a, b] =
                children.map(|c| ray.enter(&self.nodes[c as usize].slabs, limit).map(|near| (c, near)));
            let (nearer, farther) = match (a, b) {
                (Some(a), Some(b)) if b.1 < a.1 => (Some(b), Some(a)),
                (a, b) => (a, b),
            };
            for child in [farther, nearer].into_iter().flatten() {
                stack[height] = child;
                height += 1;
            }
        }
    }

    fn visit_containing(&self, point: Point3D, visitor: &mut dyn FnMut(u32)) {
        let (mut stack, mut found) = (vec![0u32], Vec::new());
        while let Some(index) = stack.pop() {
            let node = &self.nodes[index as usize];
            if !node.bounds.contains(point) {
                continue;
            }
            if node.count > 0 {
                found.extend(self.leaf(node).iter().filter(|&&i| self.boxes[i as usize].contains(point)));
            } else {
                stack.extend([node.first, node.first + 1]);
            }
        }
        found.sort_unstable();
        found.into_iter().for_each(visitor);
    }

    fn describe(&self) -> String {
        format!("tree of {} over {}", self.nodes.len(), self.order.len())
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
                assert_eq!(boxes_met(&tree, &ray), boxes_met(&list, &ray));
                let (mut a, mut b) = (Vec::new(), Vec::new());
                tree.visit_containing(origin, &mut |i| a.push(i));
                list.visit_containing(origin, &mut |i| b.push(i));
                assert_eq!(a, b);
            }
        }
    }

    #[test]
    fn equal_boxes_do_not_make_a_bottomless_tree() {
        let b = BoundingBox3D::new(Point3D::ORIGIN, Point3D::new(1.0, 1.0, 1.0)).unwrap();
        let tree = Tree::new(&vec![b; 1000]);
        let ray = TraversalRay::new(&Ray::new(Point3D::new(0.5, 0.5, -1.0), Vector3D::Z), 0.0);
        assert_eq!(boxes_met(&tree, &ray).len(), 1000);
    }
}
