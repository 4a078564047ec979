use earcut::Earcut;

use crate::orientation::orientation;
use crate::{MathError, Point2D};

/// A simple polygon in a plane: its outline does not cross or touch itself.
///
/// ```
/// use raysect_math::{Point2D, Polygon2D};
/// let corner = |x: f64, y: f64| Point2D::new(x, y);
/// let outline = vec![corner(0.0, 0.0), corner(2.0, 0.0), corner(2.0, 2.0), corner(1.0, 0.5), corner(0.0, 2.0)];
/// let polygon = Polygon2D::new(outline)?;
/// assert_eq!(polygon.signed_area(), 2.5);
/// assert!(polygon.contains(corner(0.2, 1.0)) && polygon.contains(corner(1.0, 0.5)));
/// assert!(!polygon.contains(corner(1.0, 0.6)));
/// assert_eq!(polygon.triangulate()?.len(), 3);
/// # Ok::<(), raysect_math::MathError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Polygon2D {
    vertices: Vec<Point2D>,
}

impl Polygon2D {
    /// From its vertices [m] in order, in either sense; a last vertex equal to the first is left out.
    ///
    /// All is judged by exact signs. The effort is that of sorting the edges, and of comparing those that overlap along
    /// x.
    ///
    /// # Errors
    /// [`MathError::PolygonVertex`] for fewer than three vertices, for a vertex beyond 1e140 m or not finite, for one
    /// equal to the vertex before it, and for one at which the outline turns back on itself;
    /// [`MathError::PolygonCrossing`] if edges cross or touch that are not neighbours.
    pub fn new(vertices: impl Into<Vec<Point2D>>) -> Result<Self, MathError> {
        let mut vertices: Vec<Point2D> = vertices.into();
        if vertices.len() > 1 && vertices.first() == vertices.last() {
            vertices.pop();
        }
        let polygon = Self { vertices };
        polygon.check_vertices()?;
        polygon.check_crossings()?;
        Ok(polygon)
    }

    fn check_vertices(&self) -> Result<(), MathError> {
        let count = self.vertices.len();
        let wrong = |vertex: usize, reason| {
            let at = self.vertices.get(vertex).map_or([f64::NAN; 2], |&p| p.into());
            Err(MathError::PolygonVertex { vertex, x: at[0], y: at[1], reason })
        };
        if count < 3 {
            return wrong(count.saturating_sub(1), "it is the last: three are needed");
        }
        if let Some(far) = self.vertices.iter().position(|p| !(p.x.abs() <= 1e140 && p.y.abs() <= 1e140)) {
            return wrong(far, "its coordinates must lie in -1e140 … 1e140");
        }
        let before = |i: usize| self.vertices[(i + count - 1) % count];
        if let Some(repeated) = (0..count).find(|&i| before(i) == self.vertices[i]) {
            return wrong(repeated, "it equals the vertex before it");
        }
        for (i, &here) in self.vertices.iter().enumerate() {
            let (before, after) = (before(i), self.vertices[(i + 1) % count]);
            let forth = here.vector_to(before).dot(here.vector_to(after));
            if forth > 0.0 && orientation(before, here, after) == 0.0 {
                return wrong(i, "the outline turns back on itself there");
            }
        }
        Ok(())
    }

    fn check_crossings(&self) -> Result<(), MathError> {
        let count = self.vertices.len();
        let mut order: Vec<usize> = (0..count).collect();
        let low = |i: usize| self.edge(i).0.x.min(self.edge(i).1.x);
        let high = |i: usize| self.edge(i).0.x.max(self.edge(i).1.x);
        order.sort_by(|&i, &j| low(i).total_cmp(&low(j)));
        for (k, &i) in order.iter().enumerate() {
            for &j in order[k + 1..].iter().take_while(|&&j| low(j) <= high(i)) {
                let neighbours = (i + 1) % count == j || (j + 1) % count == i;
                if !neighbours && meet(self.edge(i), self.edge(j)) {
                    return Err(MathError::PolygonCrossing { first: i.min(j), second: i.max(j) });
                }
            }
        }
        Ok(())
    }

    /// The edge that leaves a vertex.
    fn edge(&self, i: usize) -> (Point2D, Point2D) {
        (self.vertices[i], self.vertices[(i + 1) % self.vertices.len()])
    }

    fn edges(&self) -> impl Iterator<Item = (Point2D, Point2D)> {
        (0..self.vertices.len()).map(|i| self.edge(i))
    }

    /// The vertices [m] in order, each once.
    #[inline]
    pub fn vertices(&self) -> &[Point2D] {
        &self.vertices
    }

    /// The area [m²], positive if the vertices go anticlockwise (x to the right, y up).
    pub fn signed_area(&self) -> f64 {
        let first = self.vertices[0];
        let cross = |(a, b): (Point2D, Point2D)| first.vector_to(a).cross(first.vector_to(b));
        0.5 * self.edges().map(cross).sum::<f64>()
    }

    /// True if the vertices go clockwise (x to the right, y up); the answer is exact.
    #[doc(alias = "winding2d")]
    pub fn is_clockwise(&self) -> bool {
        let count = self.vertices.len();
        let key = |i: usize| (self.vertices[i].x, self.vertices[i].y);
        // Nothing lies beyond the outermost vertex, where the outline turns as the whole does.
        let outermost = (0..count).fold(0, |best, i| if key(i) < key(best) { i } else { best });
        let at = |step: usize| self.vertices[(outermost + step) % count];
        orientation(at(count - 1), at(0), at(1)) < 0.0
    }

    /// True if the point lies in the polygon, on an edge or at a vertex; the answer is exact.
    ///
    /// D. Sunday's form of the winding number (*Inclusion of a Point in a Polygon*, 2001).
    #[doc(alias = "point_inside_polygon")]
    pub fn contains(&self, point: Point2D) -> bool {
        if !(point.x.abs() <= 1e140 && point.y.abs() <= 1e140) {
            return false;
        }
        let mut winding = 0;
        for (a, b) in self.edges() {
            if point.y < a.y.min(b.y) || point.y > a.y.max(b.y) {
                continue;
            }
            let side = orientation(a, b, point);
            if side == 0.0 && in_box(a, b, point) {
                return true;
            }
            if a.y <= point.y && b.y > point.y && side > 0.0 {
                winding += 1;
            } else if a.y > point.y && b.y <= point.y && side < 0.0 {
                winding -= 1;
            }
        }
        winding != 0
    }

    /// Triangles that fill the polygon, as numbers of its vertices, each clockwise as Raysect has them.
    ///
    /// There are two fewer than vertices; a vertex within a straight piece of the outline may be left out, with its
    /// triangle of no area.
    ///
    /// # Errors
    /// [`MathError::PolygonNotCut`] if the ears of a polygon that is close to touching itself cannot be told apart.
    #[doc(alias = "triangulate2d")]
    pub fn triangulate(&self) -> Result<Vec<[u32; 3]>, MathError> {
        let first = self.vertices[0];
        let local = self.vertices.iter().map(|&p| <[f64; 2]>::from(first.vector_to(p)));
        let (mut corners, holes): (Vec<u32>, [u32; 0]) = (Vec::new(), []);
        Earcut::new().earcut(local, &holes, &mut corners);
        let mut triangles: Vec<[u32; 3]> = Vec::with_capacity(corners.len() / 3);
        let mut covered = 0.0;
        for corner in corners.chunks_exact(3) {
            let [a, b, c] = [0, 1, 2].map(|k| self.vertices[corner[k] as usize]);
            let area = orientation(a, b, c);
            covered += 0.5 * area.abs();
            let clockwise = area < 0.0;
            triangles.push(if clockwise {
                [corner[0], corner[1], corner[2]]
            } else {
                [corner[0], corner[2], corner[1]]
            });
        }
        let area = self.signed_area().abs();
        // Each partial sum is rounded, of terms no larger than the square around the polygon.
        let size = self.vertices.iter().map(|&p| first.distance_to(p)).fold(0.0, f64::max);
        let rounding = 8.0 * f64::EPSILON * self.vertices.len() as f64 * size * size;
        if (covered - area).abs() <= rounding {
            Ok(triangles)
        } else {
            Err(MathError::PolygonNotCut { covered, area })
        }
    }
}

fn in_box(a: Point2D, b: Point2D, p: Point2D) -> bool {
    let between = |a: f64, b: f64, p: f64| a.min(b) <= p && p <= a.max(b);
    between(a.x, b.x, p.x) && between(a.y, b.y, p.y)
}

/// True if two segments have a point in common.
fn meet((a, b): (Point2D, Point2D), (c, d): (Point2D, Point2D)) -> bool {
    if a.y.max(b.y) < c.y.min(d.y) || c.y.max(d.y) < a.y.min(b.y) {
        return false;
    }
    let [c_side, d_side] = [orientation(a, b, c), orientation(a, b, d)];
    let [a_side, b_side] = [orientation(c, d, a), orientation(c, d, b)];
    let apart = |u: f64, v: f64| (u > 0.0 && v < 0.0) || (u < 0.0 && v > 0.0);
    (apart(c_side, d_side) && apart(a_side, b_side))
        || (c_side == 0.0 && in_box(a, b, c))
        || (d_side == 0.0 && in_box(a, b, d))
        || (a_side == 0.0 && in_box(c, d, a))
        || (b_side == 0.0 && in_box(c, d, b))
}

#[cfg(test)]
mod tests;
