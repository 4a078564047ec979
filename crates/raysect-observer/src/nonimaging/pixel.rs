use raysect_core::Ray;
use raysect_core::save::{Entry, MakeError, SaveError, Saved, SceneWriter, Storable};
use raysect_math::sampling::{hemisphere, uniforms};
use raysect_math::{Point3D, RectangleSampler3D, Rng, Vector3D};

use super::{Counting, counting_setting};
use crate::{FrameShape, Observer, ObserverError, Sensor, Targeted};

/// A flat rectangle in the plane z = 0 that sees the half space z > 0.
///
/// Its étendue is π times its area. (Raysect takes 2π for π, so that its radiance is half of this one; the power is the
/// same; [`etendue_without_cosine`](Self::etendue_without_cosine) gives its numbers.)
///
/// ```
/// use raysect_observer::{Pixel, Sensor};
/// let pixel = Pixel::new(0.01, 0.01)?;
/// assert!((pixel.sensor().etendue(0).unwrap() - 3.141592653589793e-4).abs() < 1e-18);
/// # Ok::<(), raysect_observer::ObserverError>(())
/// ```
pub type Pixel = Observer<Rectangle>;

/// A [`Pixel`] whose directions are aimed at targets in part: see [`Observer::targets`].
///
/// ```
/// use raysect_observer::{Pixel, Target, TargetedPixel};
/// # use raysect_math::Point3D;
/// let lamp = Target::sphere(Point3D::new(0.0, 0.3, 2.0), 0.05)?;
/// let pixel: TargetedPixel = Pixel::new(0.01, 0.01)?.targets([lamp], 0.9)?;
/// # Ok::<(), raysect_observer::ObserverError>(())
/// ```
pub type TargetedPixel = Observer<Targeted<Rectangle>>;

/// The sensor of a [`Pixel`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rectangle {
    area: RectangleSampler3D,
    counting: Counting,
}

counting_setting!(Rectangle);

impl Observer<Rectangle> {
    /// With its extents along x and y [m].
    ///
    /// # Errors
    /// [`ObserverError::Math`] for an extent outside 1e-150 … 1e150 m.
    #[doc(alias("x_width", "y_width"))]
    pub fn new(width: f64, height: f64) -> Result<Self, ObserverError> {
        let area = RectangleSampler3D::new(width, height)?;
        Ok(Self::with_sensor(Rectangle { area, counting: Counting::default() }))
    }
}

impl Rectangle {
    /// Extent along x [m].
    pub fn width(&self) -> f64 {
        self.area.width()
    }

    /// Extent along y [m].
    pub fn height(&self) -> f64 {
        self.area.height()
    }

    /// Area [m²].
    pub fn collection_area(&self) -> f64 {
        self.area.width() * self.area.height()
    }
}

impl Sensor for Rectangle {
    fn shape(&self) -> FrameShape {
        FrameShape::Single
    }

    #[inline]
    fn sample_ray(&self, _: usize, rng: &mut Rng) -> Ray {
        let origin = self.area.sample_at(uniforms(rng));
        Ray::new(origin, hemisphere::sample_cosine(uniforms(rng)))
    }

    #[inline]
    fn pdf(&self, _: usize, origin: Point3D, direction: Vector3D) -> Option<f64> {
        Some(self.area.pdf(origin) * hemisphere::pdf_cosine(direction))
    }

    #[inline]
    fn origin_pdf(&self, _: usize, origin: Point3D) -> Option<f64> {
        Some(self.area.pdf(origin))
    }

    #[inline]
    fn direction_pdf(&self, _: usize, _: Point3D, direction: Vector3D) -> Option<f64> {
        Some(hemisphere::pdf_cosine(direction))
    }

    #[inline]
    fn etendue(&self, _: usize) -> Option<f64> {
        Some(self.counting.half_space() * self.collection_area())
    }

    fn description(&self) -> String {
        let counting = self.counting.describe();
        format!("{} of {:e} m × {:e} m{counting}", self.kind(), self.width(), self.height())
    }

    fn kind(&self) -> &'static str {
        "flat pixel"
    }
}

impl Storable for Rectangle {
    const KIND: &'static str = "Rectangle";

    fn save(&self, saved: Saved, _: &mut SceneWriter) -> Result<Saved, SaveError> {
        Ok(self.counting.save(saved.number("width", self.width()).number("height", self.height())))
    }

    fn load(entry: &Entry<'_>) -> Result<Self, MakeError> {
        let area = RectangleSampler3D::new(entry.number("width")?, entry.number("height")?)?;
        Ok(Self { area, counting: Counting::load(entry)? })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::check_sensor;
    use std::f64::consts::PI;

    #[test]
    fn the_etendue_is_pi_times_the_area() {
        let pixel = Pixel::new(0.01, 0.03).unwrap();
        check_sensor(pixel.sensor(), 10_000, 1).unwrap();
        assert!((pixel.sensor().etendue(0).unwrap() / (3e-4 * PI) - 1.0).abs() < 1e-15);
    }

    #[test]
    fn impossible_pixels_are_refused() {
        for width in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            assert!(Pixel::new(width, 1.0).is_err() && Pixel::new(1.0, width).is_err());
        }
    }
}
