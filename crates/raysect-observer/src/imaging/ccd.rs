use raysect_core::Ray;
use raysect_core::save::{Entry, MakeError, SaveError, Saved, SceneWriter, Storable};
use raysect_math::sampling::{hemisphere, uniforms};
use raysect_math::{Point3D, Rng, Vector3D};

use super::raster::Raster;
use crate::nonimaging::{Counting, counting_setting};
use crate::{FrameShape, Observer, ObserverError, Sensor, Targeted};

/// A bare detector of square pixels in the plane z = 0: each point of it sees the whole half space z > 0.
///
/// It shows a picture behind an aperture or lens of the scene only. x is to the left and y up, as for cameras; a
/// picture that a lens throws on it is upside down.
///
/// ```
/// use raysect_observer::{CcdArray, Sensor};
/// let ccd = CcdArray::new((10, 10), 0.035)?;
/// let etendue = std::f64::consts::PI * 0.0035 * 0.0035;
/// assert!((ccd.sensor().etendue(0).unwrap() / etendue - 1.0).abs() < 1e-15);
/// # Ok::<(), raysect_observer::ObserverError>(())
/// ```
#[doc(alias = "CCDArray")]
pub type CcdArray = Observer<Ccd>;

/// A [`CcdArray`] whose directions are aimed at targets in part: see [`Observer::targets`].
#[doc(alias = "TargetedCCDArray")]
pub type TargetedCcdArray = Observer<Targeted<Ccd>>;

/// The sensor of a [`CcdArray`].
#[derive(Debug, Clone, PartialEq)]
pub struct Ccd {
    raster: Raster,
    counting: Counting,
}

counting_setting!(Ccd);

/// What messages call the width of a pixel.
const PITCH: (&str, &str) = ("width of a pixel", "m");

impl Observer<Ccd> {
    /// Of columns × rows of pixels that are together `width` [m] wide.
    ///
    /// # Errors
    /// [`ObserverError::Math`] for no pixels or 2³² and more, or pixels outside 1e-150 … 1e150 m.
    pub fn new(pixels: (usize, usize), width: f64) -> Result<Self, ObserverError> {
        let raster = Raster::new(pixels, width / pixels.0.max(1) as f64, PITCH)?;
        Ok(Self::with_sensor(Ccd { raster, counting: Counting::default() }))
    }
}

impl Ccd {
    /// Width of all pixels of a row together [m].
    pub fn width(&self) -> f64 {
        self.raster.pitch * self.raster.columns as f64
    }

    /// Area of a pixel [m²].
    pub fn pixel_area(&self) -> f64 {
        self.raster.pitch * self.raster.pitch
    }
}

impl Sensor for Ccd {
    fn shape(&self) -> FrameShape {
        self.raster.shape()
    }

    #[inline]
    fn sample_ray(&self, pixel: usize, rng: &mut Rng) -> Ray {
        let [x, y] = self.raster.sample(pixel, rng);
        Ray::new(Point3D::new(x, y, 0.0), hemisphere::sample_cosine(uniforms(rng)))
    }

    #[inline]
    fn pdf(&self, pixel: usize, origin: Point3D, direction: Vector3D) -> Option<f64> {
        Some(hemisphere::pdf_cosine(direction) * self.raster.pdf(pixel, [origin.x, origin.y], 0.0))
    }

    #[inline]
    fn origin_pdf(&self, pixel: usize, origin: Point3D) -> Option<f64> {
        Some(self.raster.pdf(pixel, [origin.x, origin.y], 0.0))
    }

    #[inline]
    fn direction_pdf(&self, _: usize, _: Point3D, direction: Vector3D) -> Option<f64> {
        Some(hemisphere::pdf_cosine(direction))
    }

    #[inline]
    fn etendue(&self, _: usize) -> Option<f64> {
        Some(self.counting.half_space() * self.pixel_area())
    }

    fn description(&self) -> String {
        let (kind, shape, pitch) = (self.kind(), self.shape(), self.raster.pitch);
        format!("{kind} of {shape}, pixels {pitch:e} m wide{}", self.counting.describe())
    }

    fn kind(&self) -> &'static str {
        "CCD array"
    }
}

impl Storable for Ccd {
    const KIND: &'static str = "Ccd";

    fn save(&self, saved: Saved, _: &mut SceneWriter) -> Result<Saved, SaveError> {
        let saved = saved.count("columns", self.raster.columns as u64).count("rows", self.raster.rows as u64);
        Ok(self.counting.save(saved.number("pitch", self.raster.pitch)))
    }

    fn load(entry: &Entry<'_>) -> Result<Self, MakeError> {
        let pixels = (entry.integer("columns")?, entry.integer("rows")?);
        let raster = Raster::new(pixels, entry.number("pitch")?, PITCH)?;
        Ok(Self { raster, counting: Counting::load(entry)? })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::check_sensor;
    use std::f64::consts::PI;

    #[test]
    fn the_etendue_of_a_pixel_is_pi_times_its_area() {
        let ccd = CcdArray::new((5, 3), 0.05).unwrap();
        check_sensor(ccd.sensor(), 10_000, 1).unwrap();
        assert!((ccd.sensor().etendue(7).unwrap() / (PI * 1e-4) - 1.0).abs() < 1e-15);
        assert!((ccd.sensor().width() - 0.05).abs() < 1e-16);
    }

    #[test]
    fn beside_its_pixel_and_behind_it_the_density_is_zero() {
        let ccd = CcdArray::new((2, 1), 2.0).unwrap();
        let density = |pixel, x, direction| ccd.sensor().pdf(pixel, Point3D::new(x, 0.0, 0.0), direction);
        assert_eq!(density(0, 0.5, Vector3D::Z), Some(1.0 / PI));
        assert_eq!(density(1, 0.5, Vector3D::Z), Some(0.0));
        assert_eq!(density(0, 0.5, -Vector3D::Z), Some(0.0));
    }

    #[test]
    fn impossible_detectors_are_refused() {
        for width in [0.0, -1.0, f64::NAN] {
            assert!(CcdArray::new((4, 2), width).is_err());
        }
        assert!(CcdArray::new((2, 0), 1.0).is_err());
    }
}
