use std::ops::Range;

use raysect_math::{Normal3D, Point3D};

use super::super::data::{check_scaling, cross_of_edges};
use super::super::{MeshData, MeshError};
use super::fault::Fault;
use super::triangulate::Triangulator;

/// Vertices and polygons as they stand in a file, before they become a mesh.
#[derive(Debug, Default)]
pub(super) struct Polygons {
    pub(super) vertices: Vec<Point3D>,
    /// Vertex normals of any length; those of length 0 count as not given.
    pub(super) normals: Vec<Normal3D>,
    corners: Vec<u32>,
    /// For each corner its normal, [`NONE`] if it has none; empty if no corner has.
    corner_normals: Vec<u32>,
    outlines: Vec<Outline>,
}

/// No normal.
const NONE: u32 = u32::MAX;

/// A number as the index of a vertex.
pub(super) fn index(value: f64) -> Result<u32, String> {
    let index = value as u32;
    if f64::from(index) == value && index != NONE { Ok(index) } else { Err(format!("{value} is no vertex")) }
}

/// A polygon.
#[derive(Debug, Clone, Copy)]
struct Outline {
    /// Its line or byte in the file.
    place: usize,
    /// One past its last corner.
    end: usize,
}

/// A mesh, and for each triangle the number of its polygon.
#[derive(Debug)]
pub(super) struct Meshed {
    pub(super) mesh: MeshData,
    pub(super) polygon_of: Vec<usize>,
}

impl Polygons {
    /// Adds a corner to the polygon that is being read.
    pub(super) fn corner(&mut self, vertex: u32, normal: Option<u32>) {
        if normal.is_some() && self.corner_normals.is_empty() {
            self.corner_normals.resize(self.corners.len(), NONE);
        }
        if normal.is_some() || !self.corner_normals.is_empty() {
            self.corner_normals.push(normal.unwrap_or(NONE));
        }
        self.corners.push(vertex);
    }

    /// Adds a corner with a vertex of its own. Vertices beyond the range of indices are refused later, by their count.
    pub(super) fn lone_corner(&mut self, place: [f64; 3]) {
        self.corner(self.vertices.len() as u32, None);
        self.vertices.push(place.into());
    }

    /// Ends the polygon that is being read; it came from this line or byte.
    pub(super) fn end_polygon(&mut self, place: usize) {
        self.outlines.push(Outline { place, end: self.corners.len() });
    }

    /// Adds the triangles of a strip, all with the sense of the first.
    pub(super) fn strip(&mut self, corners: impl IntoIterator<Item = u32>, place: usize) {
        let (mut before, mut is_even) = ([None; 2], true);
        for c in corners {
            if let [Some(a), Some(b)] = before {
                let triangle = if is_even { [a, b, c] } else { [b, a, c] };
                triangle.into_iter().for_each(|v| self.corner(v, None));
                self.end_polygon(place);
                is_even = !is_even;
            }
            before = [before[1], Some(c)];
        }
    }

    /// How many polygons there are.
    pub(super) fn len(&self) -> usize {
        self.outlines.len()
    }

    /// Every corner has the normal with the number of its vertex.
    pub(super) fn normals_of_vertices(&mut self) {
        self.corner_normals.clone_from(&self.corners);
    }

    /// Cuts all polygons into triangles; `fault` makes an error of a place.
    pub(super) fn finish(mut self, scaling: f64, fault: fn(usize, String) -> Fault) -> Result<Meshed, Fault> {
        check_scaling(scaling).map_err(MeshError::from)?;
        let mut cutter = Cutter::default();
        let (mut triangles, mut indices, mut polygon_of) = (Vec::new(), Vec::new(), Vec::new());
        triangles.reserve(self.outlines.len());
        let mut start = 0;
        for (polygon, outline) in self.outlines.iter().enumerate() {
            let corners = start..outline.end;
            start = outline.end;
            self.check(&corners).map_err(|what| fault(outline.place, what))?;
            let cut = cutter.cut(&self, corners).map_err(|what| fault(outline.place, what))?;
            for t in cut {
                triangles.push(t.map(|corner| self.corners[corner]));
                if !self.corner_normals.is_empty() {
                    indices.push(t.map(|corner| self.corner_normals[corner]));
                }
                polygon_of.push(polygon);
            }
        }
        let mesh = MeshData::new(std::mem::take(&mut self.vertices), triangles)?.scaled(scaling)?;
        let mesh = if indices.is_empty() { mesh } else { with_known_normals(mesh, self.normals, indices)? };
        Ok(Meshed { mesh, polygon_of })
    }

    /// That a polygon has corners enough, and that they exist.
    fn check(&self, corners: &Range<usize>) -> Result<(), String> {
        if corners.len() < 3 {
            return Err(format!("a face of {} corners: at least 3 are needed", corners.len()));
        }
        let missing = |all: &[u32], count: usize| {
            all.get(corners.clone())?.iter().copied().find(|&index| index as usize >= count && index != NONE)
        };
        if let Some(v) = missing(&self.corners, self.vertices.len()) {
            return Err(format!("vertex {v} is named, there are {} (counted from 0)", self.vertices.len()));
        }
        if let Some(n) = missing(&self.corner_normals, self.normals.len()) {
            return Err(format!("normal {n} is named, there are {} (counted from 0)", self.normals.len()));
        }
        Ok(())
    }
}

/// Cuts one polygon after the other; keeps its room.
#[derive(Debug, Default)]
struct Cutter {
    triangulator: Triangulator,
    /// Corners of the polygon without repetition.
    ring: Vec<usize>,
    places: Vec<Point3D>,
}

impl Cutter {
    /// The corners of the triangles of a polygon, by their number among all corners.
    fn cut(
        &mut self,
        polygons: &Polygons,
        corners: Range<usize>,
    ) -> Result<impl Iterator<Item = [usize; 3]>, String> {
        let vertex = |corner: usize| polygons.corners[corner];
        let is_triangle = corners.len() == 3;
        self.ring.clear();
        for corner in corners {
            // A corner that is named twice running adds nothing; triangles stay for what they are.
            if is_triangle || self.ring.last().is_none_or(|&last| vertex(last) != vertex(corner)) {
                self.ring.push(corner);
            }
        }
        if let [first, .., last] = *self.ring
            && !is_triangle
            && vertex(first) == vertex(last)
        {
            self.ring.pop();
        }
        self.places.clear();
        self.places.extend(self.ring.iter().map(|&corner| polygons.vertices[vertex(corner) as usize]));
        let (cut, _) = self.triangulator.cut(&self.places)?.as_chunks::<3>();
        Ok(cut.iter().map(|t| t.map(|k| self.ring[k as usize])))
    }
}

/// Corners without a normal, or with one of length 0, get that of their face.
fn with_known_normals(
    mesh: MeshData,
    mut normals: Vec<Normal3D>,
    mut indices: Vec<[u32; 3]>,
) -> Result<MeshData, MeshError> {
    let given = normals.len();
    let is_known: Vec<bool> = normals.iter().map(|n| n.max_abs() > 0.0).collect();
    let is_missing = |n: u32| n == NONE || is_known.get(n as usize).is_some_and(|known| !known);
    if indices.iter().flatten().all(|&n| is_missing(n)) {
        return Ok(mesh);
    }
    for (triangle, t) in indices.iter_mut().enumerate() {
        if !t.iter().any(|&n| is_missing(n)) {
            continue;
        }
        let face = u32::try_from(normals.len()).ok().filter(|&n| n != NONE);
        let face = face.ok_or(MeshError::TooMany { what: "vertex normals", count: normals.len() })?;
        let (cross, _) = cross_of_edges(mesh.corners(triangle));
        normals.push(cross.normalise().map(Normal3D::from).unwrap_or_default());
        *t = t.map(|n| if is_missing(n) { face } else { n });
    }
    // No corner names those of length 0 any more.
    let dummies = normals[..given].iter_mut().zip(&is_known).filter(|(_, known)| !**known);
    dummies.for_each(|(n, _)| *n = Normal3D::default());
    mesh.with_normals(normals, indices)
}
