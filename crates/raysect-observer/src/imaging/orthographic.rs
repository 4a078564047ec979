use raysect_core::Ray;
use raysect_core::save::{Entry, MakeError, SaveError, Saved, SceneWriter, Storable};
use raysect_math::{Point3D, Rng, Vector3D};

use super::etendue::{PixelEtendue, etendue_settings};
use super::raster::Raster;
use crate::{FrameShape, Observer, ObserverError, Sensor};

/// A camera whose rays are all parallel to z: what it sees has the same size at every distance.
///
/// Its pixels are squares in the plane z = 0, with x to the left and y up. A ray begins anywhere in its pixel.
///
/// ```
/// use raysect_observer::OrthographicCamera;
/// let camera = OrthographicCamera::new((640, 480), 2.5)?.pixel_samples(100);
/// # Ok::<(), raysect_observer::ObserverError>(())
/// ```
pub type OrthographicCamera = Observer<Orthographic>;

/// The sensor of an [`OrthographicCamera`].
#[derive(Debug, Clone, PartialEq)]
pub struct Orthographic {
    raster: Raster,
    pub(super) etendue: PixelEtendue,
}

etendue_settings!(Orthographic);

impl Observer<Orthographic> {
    /// Of columns × rows of pixels that are together `width` [m] wide.
    ///
    /// # Errors
    /// [`ObserverError::Math`] for no pixels or 2³² and more, or pixels outside 1e-150 … 1e150 m.
    pub fn new(pixels: (usize, usize), width: f64) -> Result<Self, ObserverError> {
        let raster = Raster::new(pixels, width / pixels.0.max(1) as f64, PITCH)?;
        Ok(Self::with_sensor(Orthographic { raster, etendue: PixelEtendue::Unknown }))
    }
}

/// What messages call the width of a pixel.
const PITCH: (&str, &str) = ("width of a pixel", "m");

impl Orthographic {
    /// Width of all pixels of a row together [m].
    pub fn width(&self) -> f64 {
        self.raster.pitch * self.raster.columns as f64
    }
}

impl Sensor for Orthographic {
    fn shape(&self) -> FrameShape {
        self.raster.shape()
    }

    #[inline]
    fn sample_ray(&self, pixel: usize, rng: &mut Rng) -> Ray {
        let [x, y] = self.raster.sample(pixel, rng);
        Ray::new(Point3D::new(x, y, 0.0), Vector3D::Z)
    }

    fn pdf(&self, _: usize, _: Point3D, _: Vector3D) -> Option<f64> {
        None
    }

    fn etendue(&self, pixel: usize) -> Option<f64> {
        self.etendue.of(pixel, || f64::NAN)
    }

    fn description(&self) -> String {
        let (kind, shape, pitch) = (self.kind(), self.shape(), self.raster.pitch);
        format!("{kind} of {shape}, pixels {pitch:e} m wide, étendue {}", self.etendue.describe())
    }

    fn kind(&self) -> &'static str {
        "orthographic camera"
    }
}

impl Storable for Orthographic {
    const KIND: &'static str = "Orthographic";

    fn save(&self, saved: Saved, _: &mut SceneWriter) -> Result<Saved, SaveError> {
        let saved = saved
            .count("columns", self.raster.columns as u64)
            .count("rows", self.raster.rows as u64)
            .number("pitch", self.raster.pitch);
        Ok(self.etendue.save(saved))
    }

    fn load(entry: &Entry<'_>) -> Result<Self, MakeError> {
        let pixels = (entry.integer("columns")?, entry.integer("rows")?);
        let raster = Raster::new(pixels, entry.number("pitch")?, PITCH)?;
        let etendue = PixelEtendue::load(entry, raster.shape().pixels(), false)?;
        Ok(Self { raster, etendue })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::check_sensor;

    #[test]
    fn pixels_tile_a_rectangle_from_the_upper_left() {
        let camera = OrthographicCamera::new((4, 2), 0.8).unwrap().etendue(2e-6).unwrap();
        let sensor = camera.sensor();
        check_sensor(sensor, 1000, 1).unwrap();
        assert!((sensor.width() - 0.8).abs() < 1e-15);
        let mut rng = Rng::new(1);
        for pixel in 0..8 {
            let (column, row) = ((pixel % 4) as f64, (pixel / 4) as f64);
            for _ in 0..100 {
                let ray = sensor.sample_ray(pixel, &mut rng);
                let (x, y) = (ray.origin.x, ray.origin.y);
                assert!(x < 0.4 - 0.2 * column + 1e-15 && x > 0.2 - 0.2 * column - 1e-15, "{x}");
                assert!(y < 0.2 - 0.2 * row + 1e-15 && y > -0.2 * row - 1e-15, "{y}");
                assert_eq!((ray.origin.z, ray.direction), (0.0, Vector3D::Z));
            }
        }
    }

    #[test]
    fn impossible_cameras_are_refused() {
        for width in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            assert!(OrthographicCamera::new((4, 2), width).is_err());
        }
        assert!(OrthographicCamera::new((0, 2), 1.0).is_err());
        let camera = || OrthographicCamera::new((2, 1), 1.0).unwrap();
        assert!(camera().etendue(-1.0).is_err() && camera().etendue_map(vec![1.0]).is_err());
        assert_eq!(camera().etendue_map(vec![1.0, 2.0]).unwrap().sensor().etendue(1), Some(2.0));
    }
}
