use std::fmt;

use super::{PathEvent, PathVertex};
use crate::{OpticalError, Spectrum, World};

/// Everything that has happened to one path, from where light is measured to where it comes from.
///
/// ```
/// use raysect_math::{Point3D, Vector3D, translate};
/// use raysect_optical::{PathEvent, PerfectReflectingSurface, Ray, UniformSurfaceEmitter, WithMaterial, World};
/// # use raysect_primitive::{Cuboid, Sphere};
/// let mut world = World::new();
/// let plate = Cuboid::new(Point3D::new(-9.0, -1.0, -9.0), Point3D::new(9.0, 0.0, 9.0))?;
/// world.add(plate.material(PerfectReflectingSurface).name("mirror"))?;
/// world.add(Sphere::new(5.0)?.material(UniformSurfaceEmitter::new(1.0, 2.0)).transform(translate(0.0, 20.0, 20.0)))?;
///
/// let path = Ray::new(Point3D::new(0.0, 5.0, -5.0), Vector3D::new(0.0, -1.0, 1.0)).replay(&world, 0)?;
/// assert_eq!((path.depth, path.rays, path.end()), (1, 2, PathEvent::Emitted));
/// assert_eq!(path.vertices[1].hit.as_ref().map(|hit| hit.name.as_str()), Some("mirror"));
/// assert!(path.radiance.iter().all(|radiance| *radiance == 2.0));
/// println!("{path}");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[doc(alias = "LoggedRay")]
#[derive(Debug, Clone, PartialEq)]
pub struct LoggedPath {
    /// Where it starts, and every place where something happens to it, in this order; two at least.
    pub vertices: Vec<PathVertex>,
    /// The radiance that arrives where it starts [W/m²/sr/nm], bin by bin: with the bits of the path that was not logged.
    pub radiance: Vec<f64>,
    /// The ends of the range of wavelengths that it carries [nm].
    pub range: (f64, f64),
    /// The one wavelength that it has settled on, where something disperses [nm].
    pub wavelength: Option<f64>,
    /// How often it has been scattered.
    pub depth: u32,
    /// Rays traced for it, those towards lights not counted.
    #[doc(alias = "ray_count")]
    pub rays: u64,
    /// Rays traced towards lights.
    pub shadow_rays: u64,
}

impl LoggedPath {
    /// How it ended.
    pub fn end(&self) -> PathEvent {
        self.vertices.last().map_or(PathEvent::Started, |vertex| vertex.event)
    }

    /// The radiance as a spectrum.
    ///
    /// # Errors
    /// [`OpticalError::Slicing`] for bins too narrow to be told apart.
    pub fn spectrum(&self) -> Result<Spectrum, OpticalError> {
        Spectrum::from_samples(self.range.0, self.range.1, self.radiance.clone())
    }

    /// With the names that nodes have in the world in which it was followed.
    pub fn with_names(mut self, world: &World) -> Self {
        for hit in self.vertices.iter_mut().filter_map(|vertex| vertex.hit.as_mut()) {
            hit.name = world.name(hit.node).unwrap_or_default().to_owned();
        }
        self
    }
}

/// A line for each vertex.
impl fmt::Display for LoggedPath {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (number, vertex) in self.vertices.iter().enumerate() {
            let PathVertex { point: p, event, .. } = vertex;
            write!(f, "{number:>3} {event:<11} at ({:.6}, {:.6}, {:.6}) m", p.x, p.y, p.z)?;
            if let Some(hit) = &vertex.hit {
                let side = if hit.inside { "inside" } else { "outside" };
                let name = if hit.name.is_empty() { hit.shape } else { &hit.name };
                write!(f, ", {side} of {name} ({})", hit.material)?;
            }
            write!(f, ", throughput {:.4e} → {:.4e}", vertex.mean_before(), vertex.mean_after())?;
            writeln!(f, ", radiance +{:.4e}", vertex.mean_along() + vertex.mean_radiance())?;
        }
        let mean = self.radiance.iter().sum::<f64>() / self.radiance.len() as f64;
        write!(f, "radiance {mean:.6e} W/m²/sr/nm, {} rays, {} towards lights", self.rays, self.shadow_rays)?;
        match self.wavelength {
            Some(wavelength) => write!(f, ", at {wavelength:.3} nm"),
            None => Ok(()),
        }
    }
}
