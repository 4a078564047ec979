use super::{FARTHEST, SETTINGS};
use crate::error_free::difference_of_products;
use crate::orientation::orientation;
use crate::spatial::{KdItem, KdTree2D};
use crate::{MathError, Point2D};

/// Triangles in a plane, found by a tree.
#[derive(Debug, PartialEq)]
pub(super) struct Triangles {
    vertices: Vec<Point2D>,
    /// Anticlockwise.
    corners: Vec<[u32; 3]>,
    tree: KdTree2D,
}

/// By how much a border is widened, for the largest coordinate of a triangle [m]: a point that is rounded onto it lies
/// off by half of ε for each coordinate, and the sides of a point are rounded about as much.
fn slack(corners: &[Point2D; 3]) -> f64 {
    8.0 * f64::EPSILON * corners.iter().map(|p| p.x.abs().max(p.y.abs())).fold(0.0, f64::max)
}

impl Triangles {
    pub(super) fn new(vertices: Vec<Point2D>, mut corners: Vec<[u32; 3]>) -> Result<Self, MathError> {
        let wrong = |kind, index, reason| Err(MathError::MeshPart { kind, index, reason });
        let is_far = |p: &Point2D| !(p.x.abs() <= FARTHEST && p.y.abs() <= FARTHEST);
        if let Some(index) = vertices.iter().position(is_far) {
            let Point2D { x, y } = vertices[index];
            return wrong("vertex", index, format!("({x}, {y}) is beyond 1e100 m or not finite"));
        }
        let mut items = Vec::with_capacity(corners.len());
        for (index, triangle) in corners.iter_mut().enumerate() {
            if let Some(missing) = triangle.iter().find(|&&v| v as usize >= vertices.len()) {
                let count = vertices.len();
                return wrong("triangle", index, format!("there is no vertex {missing} among {count}"));
            }
            let places = triangle.map(|v| vertices[v as usize]);
            let [a, b, c] = places;
            let sense = orientation(a, b, c);
            if sense == 0.0 {
                return wrong("triangle", index, "its vertices lie on one line".into());
            }
            if sense < 0.0 {
                triangle.swap(1, 2);
            }
            let slack = slack(&places);
            let low = [a.x.min(b.x).min(c.x) - slack, a.y.min(b.y).min(c.y) - slack];
            let high = [a.x.max(b.x).max(c.x) + slack, a.y.max(b.y).max(c.y) + slack];
            items.push(KdItem::new(u32::try_from(index).unwrap_or(u32::MAX), low, high)?);
        }
        Ok(Self { vertices, corners, tree: KdTree2D::with_settings(items, &SETTINGS)? })
    }

    pub(super) fn vertex_count(&self) -> usize {
        self.vertices.len()
    }

    pub(super) fn len(&self) -> usize {
        self.corners.len()
    }

    /// The shortest height of a triangle above a side.
    pub(super) fn shortest_height(&self) -> f64 {
        let of = |corners: &[u32; 3]| {
            let [a, b, c] = corners.map(|v| self.vertices[v as usize]);
            let longest = a.vector_to(b).length().max(b.vector_to(c).length()).max(c.vector_to(a).length());
            orientation(a, b, c).abs() / longest
        };
        self.corners.iter().map(of).fold(f64::INFINITY, f64::min)
    }

    /// Lends the two ends of each side of each triangle; those between two triangles twice.
    pub(super) fn each_edge(&self, each: &mut dyn FnMut([f64; 2], [f64; 2])) {
        for corners in &self.corners {
            let [a, b, c] = corners.map(|v| self.vertices[v as usize]).map(|p| [p.x, p.y]);
            each(a, b);
            each(b, c);
            each(c, a);
        }
    }

    /// The vertices of a triangle.
    #[inline]
    pub(super) fn corners(&self, triangle: u32) -> [u32; 3] {
        self.corners[triangle as usize]
    }

    /// A triangle that holds the point, and the barycentric coordinates there: none negative, with sum 1.
    #[inline]
    pub(super) fn find(&self, x: f64, y: f64) -> Option<(u32, [f64; 3])> {
        let point = Point2D::new(x, y);
        let mut weights = [0.0; 3];
        let holds = |triangle: u32| match self.weights(triangle, point) {
            Some(found) => {
                weights = found;
                true
            }
            None => false,
        };
        let triangle = self.tree.first_containing([x, y], holds)?;
        Some((triangle, weights))
    }

    #[inline]
    fn weights(&self, triangle: u32, point: Point2D) -> Option<[f64; 3]> {
        let places = self.corners(triangle).map(|v| self.vertices[v as usize]);
        let slack = slack(&places);
        let mut weights = [0.0; 3];
        for (opposite, weight) in weights.iter_mut().enumerate() {
            let (from, to) = (places[(opposite + 1) % 3], places[(opposite + 2) % 3]);
            let (edge, away) = (from.vector_to(to), from.vector_to(point));
            let border = -slack * (edge.x.abs() + edge.y.abs());
            let (left, right) = (edge.x * away.y, edge.y * away.x);
            // Most of the triangles that do not hold the point are told by a side that rounding cannot turn.
            if left - right < border - 4.0 * f64::EPSILON * (left.abs() + right.abs()) {
                return None;
            }
            let side = difference_of_products(edge.x, away.y, edge.y, away.x);
            if side < border {
                return None;
            }
            *weight = side.max(0.0);
        }
        let sum = weights[0] + weights[1] + weights[2];
        (sum > 0.0).then(|| weights.map(|w| w / sum))
    }
}

/// Gives a function with `triangles` their structure.
macro_rules! structured_by_triangles {
    ($name:ident) => {
        impl Structured2D for $name {
            /// The shortest height of a triangle.
            fn length_scale(&self) -> f64 {
                self.triangles.shortest_height()
            }

            fn each_edge(&self, each: &mut dyn FnMut([f64; 2], [f64; 2])) {
                self.triangles.each_edge(each);
            }
        }
    };
}
pub(super) use structured_by_triangles;
