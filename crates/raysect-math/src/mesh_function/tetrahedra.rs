use super::{FARTHEST, SETTINGS};
use crate::barycentric::six_volumes;
use crate::spatial::{KdItem, KdTree3D};
use crate::{MathError, Point3D, Vector3D};

/// Tetrahedra in space, found by a tree.
#[derive(Debug, PartialEq)]
pub(super) struct Tetrahedra {
    vertices: Vec<Point3D>,
    corners: Vec<[u32; 4]>,
    tree: KdTree3D,
}

/// Faces whose normals point to the fourth corner.
const FACES: [[usize; 3]; 4] = [[0, 1, 2], [0, 2, 3], [0, 3, 1], [1, 3, 2]];

/// By how much a border is widened, for the largest coordinate [m]; see that of triangles.
fn slack(corners: &[Point3D; 4]) -> f64 {
    16.0 * f64::EPSILON * corners.iter().map(|p| p.max_abs()).fold(0.0, f64::max)
}

impl Tetrahedra {
    pub(super) fn new(vertices: Vec<Point3D>, mut corners: Vec<[u32; 4]>) -> Result<Self, MathError> {
        let wrong = |kind, index, reason| Err(MathError::MeshPart { kind, index, reason });
        let is_far = |p: &Point3D| p.max_abs().is_nan() || p.max_abs() > FARTHEST;
        if let Some(index) = vertices.iter().position(is_far) {
            let Point3D { x, y, z } = vertices[index];
            return wrong("vertex", index, format!("({x}, {y}, {z}) is beyond 1e100 m or not finite"));
        }
        let mut items = Vec::with_capacity(corners.len());
        for (index, tetrahedron) in corners.iter_mut().enumerate() {
            if let Some(missing) = tetrahedron.iter().find(|&&v| v as usize >= vertices.len()) {
                let count = vertices.len();
                return wrong("tetrahedron", index, format!("there is no vertex {missing} among {count}"));
            }
            let places = tetrahedron.map(|v| vertices[v as usize]);
            let [a, b, c, d] = places;
            let sense = six_volumes(a, b, c, d);
            if sense == 0.0 {
                return wrong("tetrahedron", index, "its vertices lie in one plane".into());
            }
            if sense < 0.0 {
                tetrahedron.swap(2, 3);
            }
            let slack = slack(&places);
            let (mut low, mut high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
            for place in places {
                for axis in 0..3 {
                    low[axis] = low[axis].min(place[axis] - slack);
                    high[axis] = high[axis].max(place[axis] + slack);
                }
            }
            items.push(KdItem::new(u32::try_from(index).unwrap_or(u32::MAX), low, high)?);
        }
        Ok(Self { vertices, corners, tree: KdTree3D::with_settings(items, &SETTINGS)? })
    }

    pub(super) fn len(&self) -> usize {
        self.corners.len()
    }

    /// A tetrahedron that holds the point.
    #[inline]
    pub(super) fn find(&self, point: Point3D) -> Option<u32> {
        self.tree.first_containing(point, |tetrahedron| self.holds(tetrahedron, point))
    }

    /// The shortest height of a tetrahedron above a face.
    pub(super) fn shortest_height(&self) -> f64 {
        let of = |corners: &[u32; 4]| {
            let places = corners.map(|v| self.vertices[v as usize]);
            let volume = six_volumes(places[0], places[1], places[2], places[3]).abs();
            let areas = FACES.map(|face| {
                let [a, b, c] = face.map(|k| places[k]);
                a.vector_to(b).cross(a.vector_to(c)).length()
            });
            volume / areas.into_iter().fold(0.0, f64::max)
        };
        self.corners.iter().map(of).fold(f64::INFINITY, f64::min)
    }

    /// Adds where a line crosses the planes of the faces of tetrahedra that it may pass, in lengths of its direction.
    pub(super) fn add_breaks(&self, origin: Point3D, direction: Vector3D, out: &mut Vec<f64>) {
        self.tree.trace(origin, direction, f64::INFINITY, |tetrahedra, limit| {
            for &tetrahedron in tetrahedra {
                let places = self.corners[tetrahedron as usize].map(|v| self.vertices[v as usize]);
                self.cut(&places, origin, direction, out);
            }
            limit
        });
    }

    /// Adds where a line enters and leaves a tetrahedron, if it passes it.
    fn cut(&self, places: &[Point3D; 4], origin: Point3D, direction: Vector3D, out: &mut Vec<f64>) {
        let (mut near, mut far) = (f64::NEG_INFINITY, f64::INFINITY);
        let slack = slack(places);
        for face in FACES {
            let [a, b, c] = face.map(|k| places[k]);
            let (u, v) = (a.vector_to(b), a.vector_to(c));
            let normal = u.cross(v);
            let (height, rate) = (normal.dot(a.vector_to(origin)), normal.dot(direction));
            if rate > 0.0 {
                near = near.max(-height / rate);
            } else if rate < 0.0 {
                far = far.min(-height / rate);
            } else if height < -slack * u.length() * v.length() {
                return;
            }
        }
        // A line along an edge or a face is rounded past it: breaks that are too many do no harm.
        if near.is_finite() && far.is_finite() && near <= far + slack / direction.length() {
            out.extend([near, far]);
        }
    }

    fn holds(&self, tetrahedron: u32, point: Point3D) -> bool {
        let places = self.corners[tetrahedron as usize].map(|v| self.vertices[v as usize]);
        let slack = slack(&places);
        FACES.into_iter().all(|face| {
            let [a, b, c] = face.map(|k| places[k]);
            let (u, v) = (a.vector_to(b), a.vector_to(c));
            u.cross(v).dot(a.vector_to(point)) >= -slack * u.length() * v.length()
        })
    }
}
