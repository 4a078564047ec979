//! Points drawn uniformly over the area of a mesh that can be seen from a point.

use std::ops::Range;

use raysect_core::BoundingBox3D;
use raysect_math::sampling::triangle;
use raysect_math::{Normal3D, Point3D, Vector3D};

use super::MeshData;

/// Cells of directions: six faces of a cube, four quarters of each.
const CELLS: usize = 24;

/// Triangles whose normals are alike.
#[derive(Debug)]
struct Group {
    /// Their places in the order of all.
    places: Range<usize>,
    area: f64,
    /// Middle of their normals, and cosine and sine of the largest angle to it.
    axis: Vector3D,
    cosine: f64,
    sine: f64,
    /// The lowest of the heights of their planes above the centre of the mesh, each along its own normal [m].
    height: f64,
}

/// The triangles of a mesh with sums of their areas, in groups by normals: what certainly faces away is not drawn, and
/// a share of the rest is looked up in a number of steps that grows as the logarithm of the number of triangles.
#[derive(Debug)]
pub(super) struct Areas {
    centre: Point3D,
    /// Largest distance from the centre along an axis [m]: what rounding acts upon.
    reach: f64,
    groups: Vec<Group>,
    /// The numbers of the triangles, group by group.
    order: Vec<u32>,
    /// Of each triangle with those before it in its group [m²].
    sums: Vec<f64>,
}

/// The cell of a direction.
fn cell(normal: Normal3D) -> usize {
    let n = normal.to_array();
    let largest = (0..3).fold(0, |best, axis| if n[axis].abs() > n[best].abs() { axis } else { best });
    let sign = |axis: usize| usize::from(n[axis % 3] < 0.0);
    largest << 3 | sign(largest) << 2 | sign(largest + 1) << 1 | sign(largest + 2)
}

impl Areas {
    pub(super) fn new(data: &MeshData) -> Self {
        let mut cells: [Vec<u32>; CELLS] = Default::default();
        for triangle in 0..data.triangle_count() {
            // What has no normal has no area.
            if let Some(normal) = data.face_normal(triangle) {
                cells[cell(normal)].push(triangle as u32);
            }
        }
        let bounds: BoundingBox3D = data.bounding_box();
        let centre = bounds.lower + bounds.lower.vector_to(bounds.upper) * 0.5;
        let mut areas = Self {
            centre,
            reach: bounds.largest_extent(),
            groups: Vec::new(),
            order: Vec::with_capacity(data.triangle_count()),
            sums: Vec::with_capacity(data.triangle_count()),
        };
        cells.iter().filter(|cell| !cell.is_empty()).for_each(|cell| areas.add(data, cell));
        areas
    }

    fn add(&mut self, data: &MeshData, triangles: &[u32]) {
        let start = self.order.len();
        let normal = |&t: &u32| data.face_normal(t as usize).map_or(Vector3D::Z, Normal3D::as_vector);
        let (mut area, mut middle) = (0.0, Vector3D::new(0.0, 0.0, 0.0));
        for triangle in triangles {
            area += data.triangle_area(*triangle as usize);
            middle += normal(triangle);
            self.order.push(*triangle);
            self.sums.push(area);
        }
        // All of them look into the same quarter of a face of a cube.
        let axis = middle.normalise_unchecked();
        let (mut cosine, mut height): (f64, f64) = (1.0, f64::INFINITY);
        for triangle in triangles {
            let (n, [corner, ..]) = (normal(triangle), data.corners(*triangle as usize));
            cosine = cosine.min(n.dot(axis));
            height = height.min(n.dot(self.centre.vector_to(corner)));
        }
        let sine = ((1.0 - cosine) * (1.0 + cosine)).max(0.0).sqrt();
        self.groups.push(Group { places: start..self.order.len(), area, axis, cosine, sine, height });
    }

    /// True unless all triangles of a group face away from a point. A triangle faces it if the point lies above its
    /// plane; no normal of the group points more towards it than its cone allows.
    fn is_seen(&self, group: &Group, from: Point3D) -> bool {
        let towards = self.centre.vector_to(from);
        let (along, distance) = (group.axis.dot(towards), towards.length());
        let across = (distance * distance - along * along).max(0.0).sqrt();
        let within = along >= distance * group.cosine;
        let highest = if within { distance } else { along * group.cosine + across * group.sine };
        // The root of a difference may be off by the root of its rounding.
        let slack = 1e-7 * group.sine * distance + 64.0 * f64::EPSILON * (distance + self.reach);
        highest + slack > group.height
    }

    /// The area from which points are drawn for a point [m²]: all of it that may face it, or both sides of a sheet.
    pub(super) fn seen_from(&self, from: Point3D, sheet: bool) -> f64 {
        self.groups.iter().filter(|g| sheet || self.is_seen(g, from)).map(|g| g.area).sum()
    }

    /// A triangle and the barycentric coordinates of the second and the third corner of a point in it, from three
    /// uniforms in (0, 1), and the area that it is drawn from [m²]. Triangles without area are never drawn.
    pub(super) fn draw(&self, from: Point3D, sheet: bool, u: [f64; 3]) -> Option<(u32, [f64; 2], f64)> {
        let area = self.seen_from(from, sheet);
        let mut share = u[0] * area;
        let mut chosen = None;
        for group in self.groups.iter().filter(|g| sheet || self.is_seen(g, from)) {
            chosen = Some((group, share));
            if share <= group.area {
                break;
            }
            share -= group.area;
        }
        let (group, share) = chosen?;
        let sums = &self.sums[group.places.clone()];
        let place = sums.partition_point(|&sum| sum < share).min(sums.len() - 1);
        let [_, v, w] = triangle::sample([u[1], u[2]]);
        Some((self.order[group.places.start + place], [v, w], area))
    }

    pub(super) fn bytes(&self) -> usize {
        size_of_val(self.sums.as_slice())
            + size_of_val(self.order.as_slice())
            + size_of_val(self.groups.as_slice())
    }
}

#[cfg(test)]
mod tests {
    use raysect_math::Rng;

    use super::*;

    #[test]
    fn triangles_are_drawn_by_their_areas_and_never_without_one() {
        let corners = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 3.0, 0.0], [2.0, 0.0, 0.0]];
        // Areas 0, 1/2, 0, 3/2, 0.
        let triangles = [[0, 1, 4], [0, 1, 2], [0, 0, 1], [0, 1, 3], [0, 4, 1]];
        let areas = Areas::new(&MeshData::new(corners, triangles).unwrap());
        let from = Point3D::new(0.0, 0.0, 1.0);
        assert_eq!(areas.seen_from(from, true), 2.0);
        let draw = |u: [f64; 3]| areas.draw(from, true, u).unwrap().0;
        let count = 1000;
        let draws = (0..count).map(|i| draw([(f64::from(i) + 0.5) / f64::from(count), 0.3, 0.6]));
        let mut found = [0; 5];
        draws.for_each(|triangle| found[triangle as usize] += 1);
        assert_eq!(found, [0, 250, 0, 750, 0]);
        for edge in [f64::MIN_POSITIVE, 0.25, 1.0 - f64::EPSILON] {
            assert!([1, 3].contains(&draw([edge, 0.5, 0.5])));
        }
        // From below nothing faces the point; the sheet has two sides all the same.
        let below = Point3D::new(0.0, 0.0, -1.0);
        assert_eq!((areas.seen_from(below, false), areas.seen_from(below, true)), (0.0, 2.0));
        assert!(areas.draw(below, false, [0.5; 3]).is_none());
    }

    #[test]
    fn of_a_cube_the_faces_are_drawn_that_look_at_the_point() {
        let areas = Areas::new(&MeshData::cube(0.5).unwrap());
        for (from, faces) in [([0.1, 0.2, 3.0], 1.0), ([0.6, 0.2, 3.0], 2.0), ([-3.0, 2.0, -0.6], 3.0)] {
            assert_eq!(areas.seen_from(from.into(), false), faces, "{from:?}");
        }
        assert_eq!(areas.seen_from(Point3D::ORIGIN, false), 0.0);
    }

    #[test]
    fn no_triangle_that_faces_a_point_is_passed_over() {
        let mut rng = Rng::new(3);
        let lumpy = MeshData::icosphere(3, 1.0).unwrap();
        let vertices: Vec<Point3D> =
            lumpy.vertices().iter().map(|v| Point3D::ORIGIN + v.to_vector() * rng.range(0.7, 1.3)).collect();
        let lumpy = lumpy.moved_to(vertices);
        let areas = Areas::new(&lumpy);
        let (mut facing, mut seen) = (0.0, 0.0);
        for _ in 0..300 {
            let mut coordinate = || 3.0 * rng.range(-1.0, 1.0);
            let from = Point3D::new(coordinate(), coordinate(), coordinate());
            for group in &areas.groups {
                let faces = |&&t: &&u32| {
                    let [corner, ..] = lumpy.corners(t as usize);
                    lumpy.face_normal(t as usize).unwrap().dot(corner.vector_to(from)) > 0.0
                };
                let faces: Vec<&u32> = areas.order[group.places.clone()].iter().filter(faces).collect();
                assert!(faces.is_empty() || areas.is_seen(group, from), "{from:?}");
                facing += faces.iter().map(|t| lumpy.triangle_area(**t as usize)).sum::<f64>();
            }
            seen += areas.seen_from(from, false);
        }
        // On a ball without lumps five eighths of what is drawn faces the point.
        assert!(facing < seen && facing > 0.3 * seen, "{facing} {seen}");
    }
}
