use raysect_core::Ray;
use raysect_core::save::{Entry, MakeError, SaveError, Saved, SceneWriter, Storable};
use raysect_math::{Point3D, Rng, Vector3D};

use super::etendue::{PixelEtendue, etendue_settings};
use super::raster::Raster;
use crate::{FrameShape, Observer, ObserverError, Sensor};

/// A camera that sees everything from one point.
///
/// It looks along z, with x to its left and y up. Its pixels are squares in a plane; the field of view belongs to
/// the larger number of them.
///
/// ```
/// use raysect_observer::PinholeCamera;
/// let camera = PinholeCamera::new((640, 480), 45.0)?.pixel_samples(100).spectral_bins(15);
/// # Ok::<(), raysect_observer::ObserverError>(())
/// ```
pub type PinholeCamera = Observer<Pinhole>;

/// The sensor of a [`PinholeCamera`].
#[derive(Debug, Clone, PartialEq)]
pub struct Pinhole {
    /// In a plane at distance 1.
    raster: Raster,
    etendue: PixelEtendue,
    cosine_weighted: bool,
}

etendue_settings!(Pinhole);

impl Observer<Pinhole> {
    /// Of columns × rows of pixels, with a field of view [deg] across the larger number of them.
    ///
    /// # Errors
    /// [`ObserverError::Math`] for no pixels or 2³² and more, or a field of view outside 0 … 180 degrees.
    pub fn new(pixels: (usize, usize), field_of_view: f64) -> Result<Self, ObserverError> {
        Ok(Self::with_sensor(Pinhole::of(Raster::of_field_of_view(pixels, field_of_view)?)))
    }

    /// With the étendue of a small flat aperture of an area [m²] across the axis: A ∫ cos θ dΩ over each pixel.
    ///
    /// # Errors
    /// [`ObserverError::Math`] unless the area is positive and finite.
    pub fn aperture(mut self, area: f64) -> Result<Self, ObserverError> {
        let pixels = self.sensor().shape().pixels();
        self.sensor_mut().etendue = PixelEtendue::Aperture(area).checked(pixels)?;
        Ok(self)
    }

    /// Multiplies what it sees by the cosine of the angle to its axis, as Raysect does. Off by default: a radiance
    /// has no such factor.
    pub fn cosine_weighted(mut self, cosine_weighted: bool) -> Self {
        self.sensor_mut().cosine_weighted = cosine_weighted;
        self
    }
}

impl Pinhole {
    fn of(raster: Raster) -> Self {
        Self { raster, etendue: PixelEtendue::Unknown, cosine_weighted: false }
    }

    /// ∫ cos θ dΩ over a pixel [sr]: the view factor of a parallel rectangle from a point, times π (J. R. Howell, *A
    /// Catalog of Radiation Heat Transfer Configuration Factors*, B-4).
    fn projected_solid_angle(&self, pixel: usize) -> f64 {
        let [right, top] = self.raster.corner(pixel);
        let from_axis = |x: f64, y: f64| {
            let (a, b) = (x.hypot(1.0), y.hypot(1.0));
            0.5 * (x / a * (y / a).atan() + y / b * (x / b).atan())
        };
        let (left, bottom) = (right - self.raster.pitch, top - self.raster.pitch);
        from_axis(right, top) - from_axis(left, top) - from_axis(right, bottom) + from_axis(left, bottom)
    }
}

impl Sensor for Pinhole {
    fn shape(&self) -> FrameShape {
        self.raster.shape()
    }

    #[inline]
    fn sample_ray(&self, pixel: usize, rng: &mut Rng) -> Ray {
        let [x, y] = self.raster.sample(pixel, rng);
        Ray::new(Point3D::ORIGIN, Vector3D::new(x, y, 1.0).normalise_unchecked())
    }

    fn pdf(&self, _: usize, _: Point3D, _: Vector3D) -> Option<f64> {
        None
    }

    fn direction_pdf(&self, pixel: usize, _: Point3D, direction: Vector3D) -> Option<f64> {
        let Vector3D { x, y, z } = direction;
        // An area of the plane at distance 1 fills cos³ θ of it as a solid angle.
        Some(if z > 0.0 { self.raster.pdf(pixel, [x / z, y / z], 0.0) / (z * z * z) } else { 0.0 })
    }

    #[inline]
    fn response(&self, _: usize, _: Point3D, direction: Vector3D) -> f64 {
        if self.cosine_weighted { direction.z } else { 1.0 }
    }

    fn etendue(&self, pixel: usize) -> Option<f64> {
        self.etendue.of(pixel, || self.projected_solid_angle(pixel))
    }

    fn description(&self) -> String {
        let weighted = if self.cosine_weighted { ", cosine-weighted" } else { "" };
        let (kind, shape, pitch) = (self.kind(), self.shape(), self.raster.pitch);
        let etendue = self.etendue.describe();
        format!("{kind} of {shape}, pixels {pitch:e} wide at distance 1, étendue {etendue}{weighted}")
    }

    fn kind(&self) -> &'static str {
        "pinhole camera"
    }
}

impl Storable for Pinhole {
    const KIND: &'static str = "Pinhole";

    fn save(&self, saved: Saved, _: &mut SceneWriter) -> Result<Saved, SaveError> {
        let saved = saved
            .count("columns", self.raster.columns as u64)
            .count("rows", self.raster.rows as u64)
            .number("pitch", self.raster.pitch)
            .flag("cosine_weighted", self.cosine_weighted);
        Ok(self.etendue.save(saved))
    }

    fn load(entry: &Entry<'_>) -> Result<Self, MakeError> {
        let pixels = (entry.integer("columns")?, entry.integer("rows")?);
        let mut pinhole = Self::of(Raster::at_distance_one(pixels, entry.number("pitch")?)?);
        pinhole.cosine_weighted = entry.flag("cosine_weighted")?;
        pinhole.etendue = PixelEtendue::load(entry, pinhole.shape().pixels(), true)?;
        Ok(pinhole)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;
    use std::f64::consts::PI;

    #[test]
    fn pixels_lie_where_raysect_has_them() {
        let camera = PinholeCamera::new((4, 2), 90.0).unwrap();
        let sensor = camera.sensor();
        let mut rng = Rng::new(1);
        for pixel in 0..8 {
            let (column, row) = ((pixel % 4) as f64, (pixel / 4) as f64);
            for _ in 0..100 {
                let d = sensor.sample_ray(pixel, &mut rng).direction;
                let (x, y) = (d.x / d.z, d.y / d.z);
                assert!(x < 1.0 - 0.5 * column && x > 0.5 - 0.5 * column, "x {x} of column {column}");
                assert!(y < 0.5 - 0.5 * row && y > -0.5 * row, "y {y} of row {row}");
            }
        }
    }

    #[test]
    fn an_aperture_gives_every_pixel_its_etendue() {
        let wide = PinholeCamera::new((300, 300), 175.0).unwrap().aperture(2.0).unwrap();
        let total: f64 = (0..90_000).map(|p| wide.sensor().etendue(p).unwrap()).sum();
        let half = (0.5 * 175f64.to_radians()).tan();
        let a = half.hypot(1.0);
        assert_relative_eq!(total, 2.0 * 4.0 * (half / a) * (half / a).atan(), max_relative = 1e-10);
        assert!(total < 2.0 * PI);
        // A single pixel: A cos⁴ θ times its area in the plane.
        let narrow = PinholeCamera::new((1, 1), 0.02).unwrap().aperture(1.0).unwrap();
        let side = 2.0 * (0.01f64.to_radians()).tan();
        assert_relative_eq!(narrow.sensor().etendue(0).unwrap(), side * side, max_relative = 1e-6);
    }

    #[test]
    fn impossible_cameras_are_refused() {
        assert!(PinholeCamera::new((0, 4), 45.0).is_err());
        assert!(PinholeCamera::new((1 << 16, 1 << 16), 45.0).is_err());
        assert!(PinholeCamera::new((usize::MAX, usize::MAX), 45.0).is_err());
        assert!(PinholeCamera::new((4, 4), 180.0).is_err());
        assert!(PinholeCamera::new((4, 4), f64::NAN).is_err());
        let camera = || PinholeCamera::new((2, 2), 45.0).unwrap();
        assert!(camera().etendue(0.0).is_err() && camera().aperture(-1.0).is_err());
        assert!(camera().etendue_map(vec![1.0; 3]).is_err() && camera().etendue_map(vec![1.0; 4]).is_ok());
    }
}
