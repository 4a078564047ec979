use std::f64::consts::PI;
use std::sync::Arc;

use raysect_core::Ray;
use raysect_core::save::{Entry, MakeError, SaveError, Saved, SceneWriter, Storable};
use raysect_math::spatial::{KdItem, KdTree};
use raysect_math::{MathError, Point3D, Rng, Vector3D};
use raysect_primitive::MeshData;

use super::mesh_surface::MeshSurface;
use super::{Counting, counting_setting};
use crate::{FrameShape, Observer, ObserverError, Sensor};

/// The whole surface of a mesh as one pixel: a point of it is as likely as its area, and sees the half space in front of
/// its triangle.
///
/// As for a [`MeshCamera`](crate::MeshCamera), the mesh is in the observer's own space: hang the observer under the node of
/// a mesh to take over its transform, and lift rays off a mesh that stands in the scene by a
/// [`surface_offset`](Self::surface_offset).
///
/// ```
/// use raysect_observer::{MeshPixel, Sensor};
/// use raysect_primitive::MeshData;
/// let pixel = MeshPixel::new(&MeshData::cube(0.05)?)?;
/// assert!((pixel.sensor().etendue(0).unwrap() - 0.1884955592153876).abs() < 1e-15);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub type MeshPixel = Observer<MeshWhole>;

/// The sensor of a [`MeshPixel`].
#[derive(Debug, Clone)]
pub struct MeshWhole {
    surface: MeshSurface,
    counting: Counting,
    /// Sums of the areas, over the last.
    cumulative: Arc<[f64]>,
    area: f64,
    /// Finds the triangle on which a ray begins.
    tree: Arc<KdTree<3>>,
}

counting_setting!(MeshWhole);

impl Observer<MeshWhole> {
    /// Of all triangles of a mesh. They look to the side from which their corners run anticlockwise.
    ///
    /// # Errors
    /// [`ObserverError::Math`] for a triangle without area ([`MeshData::without_degenerate`] drops those).
    pub fn new(mesh: &MeshData) -> Result<Self, ObserverError> {
        Ok(Self::with_sensor(MeshWhole::of(MeshSurface::new(mesh)?)?))
    }

    /// Lets rays begin this far above the triangles [m]; 0 by default.
    ///
    /// # Errors
    /// [`ObserverError::Math`] unless it lies in 0 … 1e150 m.
    pub fn surface_offset(mut self, offset: f64) -> Result<Self, ObserverError> {
        let mut surface = self.sensor().surface.clone();
        surface.set_offset(offset)?;
        let counting = self.sensor().counting;
        *self.sensor_mut() = MeshWhole { counting, ..MeshWhole::of(surface)? };
        Ok(self)
    }
}

impl MeshWhole {
    fn of(surface: MeshSurface) -> Result<Self, ObserverError> {
        let mut area = 0.0;
        let mut cumulative: Vec<f64> = Vec::with_capacity(surface.faces().len());
        for face in surface.faces() {
            area += face.triangle.area();
            cumulative.push(area);
        }
        cumulative.iter_mut().for_each(|sum| *sum /= area);
        let item = |face: usize| -> Result<KdItem<3>, MathError> {
            let [lower, upper] = surface.bounds(face);
            KdItem::new(face as u32, lower, upper)
        };
        let items = (0..surface.faces().len()).map(item).collect::<Result<Vec<_>, _>>()?;
        let tree = Arc::new(KdTree::new(items)?);
        Ok(Self { surface, counting: Counting::default(), cumulative: cumulative.into(), area, tree })
    }

    /// Area of all triangles [m²].
    pub fn collection_area(&self) -> f64 {
        self.area
    }

    /// The triangle of a uniform number, and where the number lies within its share: uniform again.
    fn choose(&self, u: f64) -> (usize, f64) {
        let face = self.cumulative.partition_point(|&sum| sum <= u).min(self.cumulative.len() - 1);
        let below = if face == 0 { 0.0 } else { self.cumulative[face - 1] };
        let within = (u - below) / (self.cumulative[face] - below);
        (face, within.clamp(f64::EPSILON, 1.0 - f64::EPSILON))
    }

    /// The cosine to the triangle on which a ray begins; of triangles back to back, to the one that looks its way. None for
    /// an origin on no triangle.
    fn cosine_at(&self, origin: Point3D, direction: Vector3D) -> Option<f64> {
        let mut found: Option<f64> = None;
        self.tree.first_containing(origin.to_array(), |face| {
            let face = face as usize;
            if self.surface.begins_on(face, origin) {
                let cosine = self.surface.cosine(face, direction);
                found = Some(found.map_or(cosine, |before| before.max(cosine)));
            }
            false
        });
        found
    }
}

impl Sensor for MeshWhole {
    fn shape(&self) -> FrameShape {
        FrameShape::Single
    }

    fn sample_ray(&self, _: usize, rng: &mut Rng) -> Ray {
        let (face, within) = self.choose(rng.uniform());
        self.surface.sample(face, [within, rng.uniform()], rng)
    }

    fn pdf(&self, _: usize, origin: Point3D, direction: Vector3D) -> Option<f64> {
        Some(self.cosine_at(origin, direction).unwrap_or(0.0) / (PI * self.area))
    }

    fn origin_pdf(&self, _: usize, origin: Point3D) -> Option<f64> {
        Some(if self.cosine_at(origin, Vector3D::Z).is_some() { 1.0 / self.area } else { 0.0 })
    }

    fn direction_pdf(&self, _: usize, origin: Point3D, direction: Vector3D) -> Option<f64> {
        Some(self.cosine_at(origin, direction).unwrap_or(0.0) / PI)
    }

    fn cosine(&self, _: usize, origin: Point3D, direction: Vector3D) -> f64 {
        self.cosine_at(origin, direction).unwrap_or(0.0)
    }

    fn etendue(&self, _: usize) -> Option<f64> {
        Some(self.counting.half_space() * self.area)
    }

    fn description(&self) -> String {
        format!("{} of {}{}", self.kind(), self.surface.describe(), self.counting.describe())
    }

    fn kind(&self) -> &'static str {
        "mesh pixel"
    }
}

impl Storable for MeshWhole {
    const KIND: &'static str = "MeshWhole";

    fn save(&self, saved: Saved, _: &mut SceneWriter) -> Result<Saved, SaveError> {
        Ok(self.counting.save(self.surface.save(saved)))
    }

    fn load(entry: &Entry<'_>) -> Result<Self, MakeError> {
        let counting = Counting::load(entry)?;
        Ok(Self { counting, ..Self::of(MeshSurface::load(entry)?)? })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::check_sensor;

    #[test]
    fn the_etendue_is_pi_times_the_surface() {
        for offset in [0.0, 1e-6, 0.01] {
            let pixel = MeshPixel::new(&MeshData::icosphere(3, 0.7).unwrap()).unwrap();
            check_sensor(pixel.surface_offset(offset).unwrap().sensor(), 20_000, 1).unwrap();
        }
        let cube = MeshPixel::new(&MeshData::cube(0.5).unwrap()).unwrap();
        assert!((cube.sensor().collection_area() - 6.0).abs() < 1e-14);
    }

    #[test]
    fn points_are_as_likely_as_their_area() {
        // A large triangle and a small one beside it.
        let corners = [[0.0, 0.0, 0.0], [3.0, 0.0, 0.0], [0.0, 1.0, 0.0], [-1.0, 0.0, 0.0]];
        let pixel = MeshPixel::new(&MeshData::new(corners, [[0, 1, 2], [0, 2, 3]]).unwrap()).unwrap();
        let mut rng = Rng::new(5);
        let n = 40_000;
        let right = (0..n).filter(|_| pixel.sensor().sample_ray(0, &mut rng).origin.x > 0.0).count() as f64;
        let sigma = (0.75 * 0.25 * n as f64).sqrt();
        assert!((right - 0.75 * n as f64).abs() < 4.0 * sigma, "{right}");
    }

    #[test]
    fn a_sheet_of_two_triangles_back_to_back_sees_both_sides() {
        let corners = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
        let sheet = MeshPixel::new(&MeshData::new(corners, [[0, 1, 2], [0, 2, 1]]).unwrap()).unwrap();
        check_sensor(sheet.sensor(), 20_000, 1).unwrap();
        assert!((sheet.sensor().etendue(0).unwrap() - PI).abs() < 1e-15);
    }
}
