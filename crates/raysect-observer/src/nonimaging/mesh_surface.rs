use std::f64::consts::PI;
use std::sync::Arc;

use raysect_core::Ray;
use raysect_core::save::{Entry, MakeError, Saved};
use raysect_math::sampling::{hemisphere, uniforms};
use raysect_math::{Frame, MathError, Point3D, Rng, TriangleSampler3D, Vector3D};
use raysect_primitive::MeshData;

use crate::ObserverError;
use crate::imaging::vector::triples;

/// Triangles that look along their normals.
#[derive(Debug, Clone)]
pub(super) struct MeshSurface {
    data: Arc<MeshData>,
    faces: Arc<[Face]>,
    /// How far above the triangles rays begin [m].
    pub(super) offset: f64,
}

/// One triangle.
#[derive(Debug, Clone, Copy)]
pub(super) struct Face {
    pub(super) triangle: TriangleSampler3D,
    /// z is the normal.
    frame: Frame,
}

impl MeshSurface {
    /// # Errors
    /// [`ObserverError::Math`] for a triangle without area.
    pub(super) fn new(data: &MeshData) -> Result<Self, ObserverError> {
        let face = |index: usize| -> Result<Face, MathError> {
            let [a, b, c] = data.corners(index);
            let triangle = TriangleSampler3D::new(a, b, c)?;
            let normal = a.vector_to(b).cross(a.vector_to(c)).normalise()?;
            Ok(Face { triangle, frame: Frame::from_z(normal) })
        };
        let faces = (0..data.triangle_count()).map(face).collect::<Result<Vec<_>, _>>()?;
        Ok(Self { data: Arc::new(data.clone().without_normals()), faces: faces.into(), offset: 0.0 })
    }

    pub(super) fn set_offset(&mut self, offset: f64) -> Result<(), ObserverError> {
        MathError::check((0.0..=1e150).contains(&offset), offset, "surface offset", "m", "0 … 1e150")?;
        self.offset = offset;
        Ok(())
    }

    pub(super) fn faces(&self) -> &[Face] {
        &self.faces
    }

    /// A ray that begins at a uniform point of a triangle.
    #[inline]
    pub(super) fn sample(&self, face: usize, u: [f64; 2], rng: &mut Rng) -> Ray {
        let Face { triangle, frame } = &self.faces[face];
        let point = triangle.sample_at(u);
        let direction = frame.to_world(hemisphere::sample_cosine(uniforms(rng)));
        Ray::new(if self.offset > 0.0 { point + frame.z * self.offset } else { point }, direction)
    }

    /// Cosine of a direction to the normal of a triangle, 0 from behind.
    #[inline]
    pub(super) fn cosine(&self, face: usize, direction: Vector3D) -> f64 {
        self.faces[face].frame.z.dot(direction).max(0.0)
    }

    /// Density of the directions from a triangle [1/sr].
    #[inline]
    pub(super) fn direction_pdf(&self, face: usize, direction: Vector3D) -> f64 {
        self.cosine(face, direction) / PI
    }

    /// True if a ray of the triangle may begin at the point, to rounding.
    pub(super) fn begins_on(&self, face: usize, origin: Point3D) -> bool {
        let Face { triangle, frame } = &self.faces[face];
        let height = frame.z.dot(triangle.vertices()[0].vector_to(origin)) - self.offset;
        let size = triangle.vertices().iter().fold(self.offset, |m, v| m.max(v.max_abs()));
        height.abs() <= 64.0 * f64::EPSILON * size && triangle.pdf(origin - frame.z * self.offset) > 0.0
    }

    /// Box around the places where rays of a triangle begin.
    pub(super) fn bounds(&self, face: usize) -> [[f64; 3]; 2] {
        let Face { triangle, frame } = &self.faces[face];
        let mut bounds = [[f64::INFINITY; 3], [f64::NEG_INFINITY; 3]];
        for vertex in triangle.vertices() {
            let place = (vertex + frame.z * self.offset).to_array();
            for axis in 0..3 {
                let slack = 16.0 * f64::EPSILON * (vertex.max_abs() + self.offset);
                bounds[0][axis] = bounds[0][axis].min(place[axis] - slack);
                bounds[1][axis] = bounds[1][axis].max(place[axis] + slack);
            }
        }
        bounds
    }

    /// Words that differ if the numbers do.
    pub(super) fn describe(&self) -> String {
        let corners = self.faces.iter().flat_map(|f| f.triangle.vertices()).flat_map(|p| p.to_array());
        let digest = crate::imaging::etendue::digest(corners);
        format!("{} triangles {digest:016x}, {:e} m above them", self.faces.len(), self.offset)
    }

    pub(super) fn save(&self, saved: Saved) -> Saved {
        let coordinates: Vec<f64> = self.data.vertices().iter().flat_map(|p| p.to_array()).collect();
        let indices: Vec<f64> = self.data.triangles().iter().flatten().map(|&i| f64::from(i)).collect();
        saved
            .numbers("vertices", &coordinates)
            .numbers("triangles", &indices)
            .number("surface_offset", self.offset)
    }

    pub(super) fn load(entry: &Entry<'_>) -> Result<Self, MakeError> {
        let vertices = triples("vertices", &entry.numbers("vertices")?)?;
        let mut triangles = Vec::new();
        for corners in triples("triangles", &entry.numbers("triangles")?)? {
            for index in corners {
                let admitted = index.fract() == 0.0 && (0.0..=f64::from(u32::MAX)).contains(&index);
                MathError::check(admitted, index, "vertex of a triangle", "", "a number of a vertex")?;
            }
            triangles.push(corners.map(|index| index as u32));
        }
        let mut surface = Self::new(&MeshData::new(vertices, triangles)?)?;
        surface.set_offset(entry.number("surface_offset")?)?;
        Ok(surface)
    }
}
