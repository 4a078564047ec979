use raysect_core::Ray;
use raysect_core::save::{Entry, MakeError, SaveError, Saved, SceneWriter, Storable};
use raysect_math::sampling::uniforms;
use raysect_math::{Point3D, Rng, Vector3D};
use raysect_primitive::MeshData;

use super::mesh_surface::MeshSurface;
use super::{Counting, counting_setting};
use crate::{FrameShape, Observer, ObserverError, Sensor};

/// The triangles of a mesh as pixels: each sees the half space in front of it.
///
/// The mesh is in the observer's own space: what holds for observers holds for it, too. To watch the surface of a mesh
/// that stands in the scene, hang the observer under its node ([`parent`](Observer::parent)), so that it takes over its
/// transform and moves with it; or give it [`MeshData::transformed`]. Rays begin on the triangles: of a mesh that stands
/// in the scene they would meet the triangle they come from, or not, by rounding. A small
/// [`surface_offset`](Self::surface_offset) lifts them off.
///
/// ```
/// use raysect_observer::{MeshCamera, Sensor};
/// use raysect_primitive::MeshData;
/// let camera = MeshCamera::new(&MeshData::cube(0.05)?)?;
/// // π times half a face of 10 cm.
/// assert!((camera.sensor().etendue(0).unwrap() - 0.015707963267948967).abs() < 1e-16);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub type MeshCamera = Observer<MeshPatches>;

/// The sensor of a [`MeshCamera`].
#[derive(Debug, Clone)]
pub struct MeshPatches {
    surface: MeshSurface,
    counting: Counting,
}

counting_setting!(MeshPatches);

impl Observer<MeshPatches> {
    /// Of the triangles of a mesh, in their order. They look to the side from which their corners run anticlockwise.
    ///
    /// # Errors
    /// [`ObserverError::Math`] for a triangle without area ([`MeshData::without_degenerate`] drops those).
    pub fn new(mesh: &MeshData) -> Result<Self, ObserverError> {
        let surface = MeshSurface::new(mesh)?;
        Ok(Self::with_sensor(MeshPatches { surface, counting: Counting::default() }))
    }

    /// Lets rays begin this far above the triangles [m]; 0 by default.
    ///
    /// # Errors
    /// [`ObserverError::Math`] unless it lies in 0 … 1e150 m.
    pub fn surface_offset(mut self, offset: f64) -> Result<Self, ObserverError> {
        self.sensor_mut().surface.set_offset(offset)?;
        Ok(self)
    }
}

impl MeshPatches {
    /// Area of a triangle [m²].
    pub fn collection_area(&self, triangle: usize) -> Option<f64> {
        Some(self.surface.faces().get(triangle)?.triangle.area())
    }
}

impl Sensor for MeshPatches {
    fn shape(&self) -> FrameShape {
        FrameShape::Line(self.surface.faces().len())
    }

    fn sample_ray(&self, pixel: usize, rng: &mut Rng) -> Ray {
        self.surface.sample(pixel, uniforms(rng), rng)
    }

    fn pdf(&self, pixel: usize, origin: Point3D, direction: Vector3D) -> Option<f64> {
        Some(self.origin_pdf(pixel, origin)? * self.surface.direction_pdf(pixel, direction))
    }

    fn origin_pdf(&self, pixel: usize, origin: Point3D) -> Option<f64> {
        let on = self.surface.begins_on(pixel, origin);
        Some(if on { 1.0 / self.surface.faces()[pixel].triangle.area() } else { 0.0 })
    }

    fn direction_pdf(&self, pixel: usize, _: Point3D, direction: Vector3D) -> Option<f64> {
        Some(self.surface.direction_pdf(pixel, direction))
    }

    fn cosine(&self, pixel: usize, _: Point3D, direction: Vector3D) -> f64 {
        self.surface.cosine(pixel, direction)
    }

    fn etendue(&self, pixel: usize) -> Option<f64> {
        self.collection_area(pixel).map(|area| self.counting.half_space() * area)
    }

    fn description(&self) -> String {
        format!("{} of {}{}", self.kind(), self.surface.describe(), self.counting.describe())
    }

    fn kind(&self) -> &'static str {
        "mesh camera"
    }
}

impl Storable for MeshPatches {
    const KIND: &'static str = "MeshPatches";

    fn save(&self, saved: Saved, _: &mut SceneWriter) -> Result<Saved, SaveError> {
        Ok(self.counting.save(self.surface.save(saved)))
    }

    fn load(entry: &Entry<'_>) -> Result<Self, MakeError> {
        Ok(Self { surface: MeshSurface::load(entry)?, counting: Counting::load(entry)? })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::check_sensor;

    #[test]
    fn every_triangle_sees_the_half_space_in_front_of_it() {
        for offset in [0.0, 1e-6, 0.01] {
            let cube = MeshCamera::new(&MeshData::cube(0.05).unwrap()).unwrap();
            check_sensor(cube.surface_offset(offset).unwrap().sensor(), 2000, 1).unwrap();
            let ball = MeshCamera::new(&MeshData::icosphere(2, 3.0).unwrap()).unwrap();
            check_sensor(ball.surface_offset(offset).unwrap().sensor(), 2000, 1).unwrap();
        }
    }

    #[test]
    fn rays_begin_on_their_triangle_and_look_outward() {
        let data = MeshData::icosphere(1, 1.0).unwrap();
        let camera = MeshCamera::new(&data).unwrap().surface_offset(0.1).unwrap();
        let mut rng = Rng::new(1);
        for pixel in 0..data.triangle_count() {
            let normal = Vector3D::from(data.face_normal(pixel).unwrap());
            let ray = camera.sensor().sample_ray(pixel, &mut rng);
            let height = data.corners(pixel)[0].vector_to(ray.origin).dot(normal);
            assert!((height - 0.1).abs() < 1e-14 && ray.direction.dot(normal) > 0.0);
        }
    }

    #[test]
    fn triangles_without_area_and_negative_offsets_are_refused() {
        let flat = MeshData::new([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [2.0, 0.0, 0.0]], [[0, 1, 2]]).unwrap();
        assert!(MeshCamera::new(&flat).is_err());
        let cube = || MeshCamera::new(&MeshData::cube(1.0).unwrap()).unwrap();
        assert!(cube().surface_offset(-1e-9).is_err() && cube().surface_offset(f64::NAN).is_err());
    }
}
