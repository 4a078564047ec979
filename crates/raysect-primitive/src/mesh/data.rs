use raysect_core::BoundingBox3D;
use raysect_math::{AffineMatrix3D, MathError, Normal3D, Point3D, Vector3D};

use super::MeshError;
use rayon::prelude::*;

/// Vertices, triangles and, optionally, vertex normals.
///
/// The front of a triangle is the side from which its corners run anticlockwise. Coordinates are kept as they are
/// given; vertices need not be shared, and triangles without area are kept (see
/// [`without_degenerate`](Self::without_degenerate)).
///
/// ```
/// use raysect_primitive::MeshData;
/// let corners = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
/// let mesh = MeshData::new(corners, [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]])?;
/// assert_eq!(mesh.triangle_count(), 4);
/// assert_eq!(mesh.face_normal(0).unwrap().to_array(), [0.0, 0.0, -1.0]);
/// assert!(MeshData::new(corners, [[0, 1, 4]]).is_err());
/// # Ok::<(), raysect_primitive::MeshError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct MeshData {
    vertices: Vec<Point3D>,
    triangles: Vec<[u32; 3]>,
    normals: Option<VertexNormals>,
}

/// Unit normals, and those of the three corners of each triangle.
#[derive(Debug, Clone, PartialEq)]
struct VertexNormals {
    normals: Vec<Normal3D>,
    indices: Vec<[u32; 3]>,
}

impl MeshData {
    /// From vertices [m] and the three vertices of each triangle, counted from 0.
    ///
    /// # Errors
    /// [`MeshError::Empty`] without triangles, [`MeshError::TooMany`], [`MeshError::NotFinite`],
    /// [`MeshError::VertexIndex`].
    pub fn new(
        vertices: impl IntoIterator<Item = impl Into<Point3D>>,
        triangles: impl IntoIterator<Item = [u32; 3]>,
    ) -> Result<Self, MeshError> {
        let vertices: Vec<Point3D> = vertices.into_iter().map(Into::into).collect();
        let triangles: Vec<[u32; 3]> = triangles.into_iter().collect();
        check_count("vertices", vertices.len())?;
        check_count("triangles", triangles.len())?;
        if triangles.is_empty() {
            return Err(MeshError::Empty);
        }
        check_finite(&vertices)?;
        if let Some((triangle, index)) = first_beyond(&triangles, vertices.len()) {
            return Err(MeshError::VertexIndex { triangle, index, vertices: vertices.len() });
        }
        Ok(Self { vertices, triangles, normals: None })
    }

    /// With vertex normals of any length, and for each triangle those of its three corners, counted from 0.
    ///
    /// # Errors
    /// [`MeshError::Normal`] for a normal without direction, [`MeshError::NormalIndex`],
    /// [`MeshError::NormalCount`] unless there is one triple for each triangle, [`MeshError::TooMany`].
    pub fn with_normals(
        mut self,
        normals: impl IntoIterator<Item = impl Into<Normal3D>>,
        indices: impl IntoIterator<Item = [u32; 3]>,
    ) -> Result<Self, MeshError> {
        let unit = |(normal, n): (usize, Normal3D)| {
            // What has been normalised before keeps its last digit.
            if (n.length() - 1.0).abs() <= 2.0 * f64::EPSILON {
                return Ok(n);
            }
            n.normalise().map_err(|source| MeshError::Normal { normal, source })
        };
        let normals: Vec<Normal3D> =
            normals.into_iter().map(Into::into).enumerate().map(unit).collect::<Result<_, _>>()?;
        let indices: Vec<[u32; 3]> = indices.into_iter().collect();
        check_count("vertex normals", normals.len())?;
        if indices.len() != self.triangles.len() {
            return Err(MeshError::NormalCount { triangles: self.triangles.len(), found: indices.len() });
        }
        if let Some((triangle, index)) = first_beyond(&indices, normals.len()) {
            return Err(MeshError::NormalIndex { triangle, index, normals: normals.len() });
        }
        self.normals = Some(VertexNormals { normals, indices });
        Ok(self)
    }

    /// Without vertex normals.
    #[must_use]
    pub fn without_normals(self) -> Self {
        Self { normals: None, ..self }
    }

    /// All vertices [m].
    pub fn vertices(&self) -> &[Point3D] {
        &self.vertices
    }

    /// The three vertices of each triangle, counted from 0.
    pub fn triangles(&self) -> &[[u32; 3]] {
        &self.triangles
    }

    /// All vertex normals, of unit length.
    pub fn vertex_normals(&self) -> Option<&[Normal3D]> {
        self.normals.as_ref().map(|n| n.normals.as_slice())
    }

    /// For each triangle the vertex normals of its three corners, counted from 0.
    pub fn normal_indices(&self) -> Option<&[[u32; 3]]> {
        self.normals.as_ref().map(|n| n.indices.as_slice())
    }

    /// How many vertices there are.
    pub fn vertex_count(&self) -> usize {
        self.vertices.len()
    }

    /// How many triangles there are, at least 1.
    pub fn triangle_count(&self) -> usize {
        self.triangles.len()
    }

    /// A vertex [m].
    pub fn vertex(&self, index: usize) -> Option<Point3D> {
        self.vertices.get(index).copied()
    }

    /// The three vertices of a triangle, counted from 0.
    pub fn triangle(&self, index: usize) -> Option<[u32; 3]> {
        self.triangles.get(index).copied()
    }

    /// A vertex normal, of unit length.
    pub fn vertex_normal(&self, index: usize) -> Option<Normal3D> {
        self.vertex_normals()?.get(index).copied()
    }

    /// The places of the three corners of a triangle [m].
    ///
    /// # Panics
    /// For a triangle that does not exist, like the indexing of a slice.
    #[inline]
    pub fn corners(&self, triangle: usize) -> [Point3D; 3] {
        self.triangles[triangle].map(|vertex| self.vertices[vertex as usize])
    }

    /// The vertex normals at the three corners of a triangle.
    #[inline]
    pub fn corner_normals(&self, triangle: usize) -> Option<[Normal3D; 3]> {
        let VertexNormals { normals, indices } = self.normals.as_ref()?;
        Some(indices.get(triangle)?.map(|normal| normals[normal as usize]))
    }

    /// The unit normal of a triangle, on the side from which its corners run anticlockwise; `None` for a triangle
    /// without area.
    pub fn face_normal(&self, triangle: usize) -> Option<Normal3D> {
        if triangle >= self.triangles.len() {
            return None;
        }
        let (cross, _) = cross_of_edges(self.corners(triangle));
        cross.normalise().ok().map(Normal3D::from)
    }

    /// Area of a triangle [m²]; 0 for one that does not exist.
    pub fn triangle_area(&self, triangle: usize) -> f64 {
        if triangle >= self.triangles.len() {
            return 0.0;
        }
        let (cross, scale) = cross_of_edges(self.corners(triangle));
        0.5 * cross.length() * scale * scale
    }

    /// True for a triangle without area: two corners coincide, or all three lie on a line.
    pub fn is_degenerate(&self, triangle: usize) -> bool {
        self.face_normal(triangle).is_none()
    }

    /// The smallest box around all triangles [m]; vertices of no triangle do not count.
    pub fn bounding_box(&self) -> BoundingBox3D {
        BoundingBox3D::around(self.triangles.iter().flatten().map(|&v| self.vertices[v as usize]))
    }

    /// The box around each triangle [m].
    pub(super) fn triangle_boxes(&self) -> Vec<BoundingBox3D> {
        let of = |t: &[u32; 3]| BoundingBox3D::around(t.map(|v| self.vertices[v as usize]));
        self.triangles.par_iter().with_min_len(4096).map(of).collect()
    }

    /// Bytes that vertices, triangles and normals take.
    pub(super) fn bytes(&self) -> usize {
        let normals = self.normals.as_ref();
        size_of_val(self.vertices.as_slice())
            + size_of_val(self.triangles.as_slice())
            + normals.map_or(0, |n| size_of_val(n.normals.as_slice()) + size_of_val(n.indices.as_slice()))
    }

    /// Every coordinate multiplied by a positive factor: 0.001 makes metres of millimetres.
    ///
    /// # Errors
    /// [`MeshError::Transform`] unless the factor is positive and finite, [`MeshError::NotFinite`] if a coordinate
    /// outgrows the range of numbers.
    pub fn scaled(mut self, factor: f64) -> Result<Self, MeshError> {
        check_scaling(factor)?;
        for p in &mut self.vertices {
            *p = Point3D::new(p.x * factor, p.y * factor, p.z * factor);
        }
        check_finite(&self.vertices)?;
        Ok(self)
    }

    /// Inside out: every triangle wound the other way, every vertex normal reversed.
    #[doc(alias = "flip_normals")]
    #[must_use]
    pub fn flipped(mut self) -> Self {
        self.rewind();
        if let Some(VertexNormals { normals, .. }) = &mut self.normals {
            normals.iter_mut().for_each(|n| *n = -*n);
        }
        self
    }

    /// Exchanges the first and third corner of every triangle.
    fn rewind(&mut self) {
        self.triangles.iter_mut().for_each(|t| t.swap(0, 2));
        if let Some(VertexNormals { indices, .. }) = &mut self.normals {
            indices.iter_mut().for_each(|t| t.swap(0, 2));
        }
    }

    /// Moved by an affine map. Fronts stay fronts: a mirror image is wound the other way.
    ///
    /// # Errors
    /// [`MeshError::Transform`] for a map without inverse, [`MeshError::NotFinite`] if a coordinate outgrows the
    /// range of numbers, [`MeshError::Normal`] if a normal does.
    pub fn transformed(mut self, m: &AffineMatrix3D) -> Result<Self, MeshError> {
        let inverse = m.inverse()?;
        for p in &mut self.vertices {
            *p = *m * *p;
        }
        check_finite(&self.vertices)?;
        if let Some(VertexNormals { normals, .. }) = &mut self.normals {
            for (normal, n) in normals.iter_mut().enumerate() {
                let image = inverse.transform_normal_with_inverse(*n);
                *n = image.normalise().map_err(|source| MeshError::Normal { normal, source })?;
            }
        }
        if is_mirror(m)? {
            self.rewind();
        }
        Ok(self)
    }

    /// Without the triangles that have no area, and how many those were. Vertices keep their numbers.
    ///
    /// # Errors
    /// [`MeshError::Empty`] if no triangle is left.
    #[doc(alias = "tolerant")]
    pub fn without_degenerate(mut self) -> Result<(Self, usize), MeshError> {
        let keep: Vec<bool> = (0..self.triangles.len()).map(|t| !self.is_degenerate(t)).collect();
        let dropped = keep.iter().filter(|&&kept| !kept).count();
        if dropped == keep.len() {
            return Err(MeshError::Empty);
        }
        if dropped > 0 {
            retain(&mut self.triangles, &keep);
            if let Some(VertexNormals { indices, .. }) = &mut self.normals {
                retain(indices, &keep);
            }
        }
        Ok((self, dropped))
    }

    /// With every vertex at another, finite place.
    pub(super) fn moved_to(mut self, vertices: Vec<Point3D>) -> Self {
        debug_assert_eq!(vertices.len(), self.vertices.len());
        self.vertices = vertices;
        self
    }

    /// Every triangle's vertices replaced by others, and these the only ones; for meshes that stay valid.
    pub(super) fn renumbered(mut self, vertices: Vec<Point3D>, names: &[u32]) -> Self {
        self.triangles.iter_mut().flatten().for_each(|v| *v = names[*v as usize]);
        self.vertices = vertices;
        self
    }
}

/// `Ok` for a factor that makes metres of another unit of length.
pub(super) fn check_scaling(scaling: f64) -> Result<f64, MathError> {
    let admitted = scaling > 0.0 && scaling.is_finite();
    MathError::check(admitted, scaling, "scaling", "", "greater than 0 and finite")
}

fn check_count(what: &'static str, count: usize) -> Result<(), MeshError> {
    if u32::try_from(count).is_ok() { Ok(()) } else { Err(MeshError::TooMany { what, count }) }
}

fn check_finite(vertices: &[Point3D]) -> Result<(), MeshError> {
    match vertices.iter().position(|p| !p.is_finite()) {
        Some(vertex) => Err(MeshError::NotFinite { vertex, position: vertices[vertex].to_array() }),
        None => Ok(()),
    }
}

/// The first triangle with an index of `count` or more, and that index.
fn first_beyond(triangles: &[[u32; 3]], count: usize) -> Option<(usize, u32)> {
    let beyond = |t: &[u32; 3]| t.iter().copied().find(|&index| index as usize >= count);
    triangles.iter().enumerate().find_map(|(triangle, t)| Some((triangle, beyond(t)?)))
}

fn retain<T>(values: &mut Vec<T>, keep: &[bool]) {
    let mut kept = keep.iter();
    values.retain(|_| kept.next().copied().unwrap_or(false));
}

/// True if the map turns a right hand into a left one.
fn is_mirror(m: &AffineMatrix3D) -> Result<bool, MathError> {
    // Unit axes: the determinant itself leaves the range of numbers at scales where the map is sound.
    let [x, y, z] = [m.axis(0).normalise()?, m.axis(1).normalise()?, m.axis(2).normalise()?];
    Ok(x.cross(y).dot(z) < 0.0)
}

/// The vector product of two edges in the sense of the corners, in units of the square of the second number [m].
///
/// The two shorter edges are taken, which keeps the relative error of a needle's area near its aspect ratio times ε
/// (W. Kahan, *Miscalculating Area and Angles of a Needle-like Triangle*, 2014, tells why the choice matters); the
/// unit keeps squares within the range of numbers.
pub(super) fn cross_of_edges([a, b, c]: [Point3D; 3]) -> (Vector3D, f64) {
    // Halves: the difference of the largest numbers is no number.
    let half = |p: Point3D, q: Point3D| q.to_vector() * 0.5 - p.to_vector() * 0.5;
    let edges = [half(a, b), half(b, c), half(c, a)];
    let sizes = edges.map(Vector3D::max_abs);
    let scale = sizes[0].max(sizes[1]).max(sizes[2]);
    if scale == 0.0 {
        return (Vector3D::new(0.0, 0.0, 0.0), 0.0);
    }
    let [ab, bc, ca] = edges.map(|e| e / scale);
    let [l0, l1, l2] = [ab, bc, ca].map(Vector3D::length_squared);
    let cross = if l0 >= l1 && l0 >= l2 {
        bc.cross(ca)
    } else if l1 >= l2 {
        ca.cross(ab)
    } else {
        ab.cross(bc)
    };
    (cross, 2.0 * scale)
}

#[cfg(test)]
#[path = "data_tests.rs"]
mod tests;
