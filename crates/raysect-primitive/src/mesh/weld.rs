use std::collections::HashMap;
use std::collections::hash_map::Entry;

use raysect_math::Point3D;

use super::MeshData;

/// For each vertex the first one at the same coordinates.
#[derive(Debug)]
pub(super) struct Places {
    /// Number of the place of each vertex, counted from 0.
    pub(super) of: Vec<u32>,
    /// The places, in the order in which the vertices reach them first.
    pub(super) points: Vec<Point3D>,
}

impl Places {
    pub(super) fn new(vertices: &[Point3D]) -> Self {
        let mut seen = HashMap::with_capacity(vertices.len());
        let mut points = Vec::new();
        let name = |&p: &Point3D| match seen.entry(key(p)) {
            Entry::Occupied(entry) => *entry.get(),
            Entry::Vacant(entry) => {
                // There are no more places than vertices, and those have 32-bit indices.
                let place = points.len() as u32;
                points.push(p);
                *entry.insert(place)
            }
        };
        let of = vertices.iter().map(name).collect();
        Self { of, points }
    }
}

/// Bits that are equal for equal coordinates: both zeros are one.
fn key(p: Point3D) -> [u64; 3] {
    p.to_array().map(|x| (x + 0.0).to_bits())
}

impl MeshData {
    /// With vertices at equal coordinates made one; the first of them stays. Triangles and normals stay as they are.
    #[must_use]
    pub fn weld(self) -> Self {
        let Places { of, points } = Places::new(self.vertices());
        if points.len() == of.len() { self } else { self.renumbered(points, &of) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_places_become_one_vertex() {
        let corners = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
        let again = [[1.0, 0.0, -0.0], [0.0, -0.0, 0.0], [0.0, 0.0, 1.0]];
        let mesh = MeshData::new(corners.into_iter().chain(again), [[0, 1, 2], [3, 4, 5]]).unwrap();
        let welded = mesh.clone().weld();
        assert_eq!(welded.triangles(), [[0, 1, 2], [1, 0, 3]]);
        assert_eq!(welded.vertex_count(), 4);
        assert!((0..2).all(|t| welded.corners(t) == mesh.corners(t)));
        assert_eq!(welded.clone().weld(), welded);
        // Neighbours by one bit stay apart.
        let apart = [[1.0, 0.0, 0.0], [1.0 + f64::EPSILON, 0.0, 0.0], [0.0; 3]];
        assert_eq!(MeshData::new(apart, [[0, 1, 2]]).unwrap().weld().vertex_count(), 3);
    }
}
