use raysect_core::Ray;
use raysect_core::save::{Entry, MakeError, SaveError, Saved, SceneWriter, Storable};
use raysect_math::{MathError, Point3D, Rng, Vector3D};

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
    columns: usize,
    rows: usize,
    /// Width of a pixel in a plane at distance 1.
    pitch: f64,
    etendue: Etendue,
    cosine_weighted: bool,
}

/// Where the étendue of the pixels comes from.
#[derive(Debug, Clone, PartialEq)]
enum Etendue {
    Unknown,
    Uniform(f64),
    Aperture(f64),
    Map(Vec<f64>),
}

impl Observer<Pinhole> {
    /// Of columns × rows of pixels, with a field of view [deg] across the larger number of them.
    ///
    /// # Errors
    /// [`ObserverError::Math`] for no pixels or 2³² and more, or a field of view outside 0 … 180 degrees.
    pub fn new(pixels: (usize, usize), field_of_view: f64) -> Result<Self, ObserverError> {
        let (columns, rows) = pixels;
        let admitted = field_of_view > 0.0 && field_of_view < 180.0;
        MathError::check(admitted, field_of_view, "field of view", "deg", "0 … 180, both excluded")?;
        let width = 2.0 * (0.5 * field_of_view.to_radians()).tan();
        let pitch = width / columns.max(rows).max(1) as f64;
        Ok(Self::with_sensor(Pinhole::of(columns, rows, pitch)?))
    }

    /// With the same étendue for every pixel [m² sr], so that power can be measured.
    ///
    /// # Errors
    /// [`ObserverError::Math`] unless it is positive and finite.
    #[doc(alias = "sensitivity")]
    pub fn etendue(mut self, etendue: f64) -> Result<Self, ObserverError> {
        self.sensor_mut().set_etendue(Etendue::Uniform(etendue))?;
        Ok(self)
    }

    /// With the étendue of a small flat aperture of an area [m²] across the axis: A ∫ cos θ dΩ over each pixel.
    ///
    /// # Errors
    /// [`ObserverError::Math`] unless the area is positive and finite.
    pub fn aperture(mut self, area: f64) -> Result<Self, ObserverError> {
        self.sensor_mut().set_etendue(Etendue::Aperture(area))?;
        Ok(self)
    }

    /// With the étendue of each pixel from a calibration [m² sr], row by row.
    ///
    /// # Errors
    /// [`ObserverError::PixelCount`] for a wrong number of values, [`ObserverError::Math`] for one that is negative
    /// or not finite.
    pub fn etendue_map(mut self, map: Vec<f64>) -> Result<Self, ObserverError> {
        self.sensor_mut().set_etendue(Etendue::Map(map))?;
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
    fn of(columns: usize, rows: usize, pitch: f64) -> Result<Self, ObserverError> {
        MathError::check(columns >= 1, columns as f64, "pixels across", "", "1 or more")?;
        MathError::check(rows >= 1, rows as f64, "pixels down", "", "1 or more")?;
        let fits = columns.checked_mul(rows).is_some_and(|pixels| pixels <= u32::MAX as usize);
        MathError::check(fits, columns as f64 * rows as f64, "pixels", "", "below 2³²")?;
        let admitted = pitch > 0.0 && pitch.is_finite();
        MathError::check(admitted, pitch, "width of a pixel at distance 1", "", "positive and finite")?;
        Ok(Self { columns, rows, pitch, etendue: Etendue::Unknown, cosine_weighted: false })
    }

    fn set_etendue(&mut self, etendue: Etendue) -> Result<(), ObserverError> {
        match &etendue {
            Etendue::Unknown => {}
            &Etendue::Uniform(value) => {
                let admitted = value > 0.0 && value.is_finite();
                MathError::check(admitted, value, "étendue", "m² sr", "positive and finite")?;
            }
            &Etendue::Aperture(area) => {
                let admitted = area > 0.0 && area.is_finite();
                MathError::check(admitted, area, "aperture", "m²", "positive and finite")?;
            }
            Etendue::Map(map) => {
                let expected = self.shape().pixels();
                if map.len() != expected {
                    let (what, found) = ("étendue map", map.len());
                    return Err(ObserverError::PixelCount { what, found, expected });
                }
                for &value in map {
                    let admitted = value >= 0.0 && value.is_finite();
                    MathError::check(admitted, value, "étendue", "m² sr", "0 or more and finite")?;
                }
            }
        }
        self.etendue = etendue;
        Ok(())
    }

    /// Place of a pixel's corner of greatest x and y in the plane at distance 1.
    fn corner(&self, pixel: usize) -> (f64, f64) {
        let (column, row) = ((pixel % self.columns) as f64, (pixel / self.columns) as f64);
        let (half_width, half_height) = (0.5 * self.columns as f64, 0.5 * self.rows as f64);
        (self.pitch * (half_width - column), self.pitch * (half_height - row))
    }

    /// ∫ cos θ dΩ over a pixel [sr]: the view factor of a parallel rectangle from a point, times π (J. R. Howell, *A
    /// Catalog of Radiation Heat Transfer Configuration Factors*, B-4).
    fn projected_solid_angle(&self, pixel: usize) -> f64 {
        let (right, top) = self.corner(pixel);
        let from_axis = |x: f64, y: f64| {
            let (a, b) = (x.hypot(1.0), y.hypot(1.0));
            0.5 * (x / a * (y / a).atan() + y / b * (x / b).atan())
        };
        let (left, bottom) = (right - self.pitch, top - self.pitch);
        from_axis(right, top) - from_axis(left, top) - from_axis(right, bottom) + from_axis(left, bottom)
    }
}

impl Sensor for Pinhole {
    fn shape(&self) -> FrameShape {
        FrameShape::Image { columns: self.columns, rows: self.rows }
    }

    #[inline]
    fn sample_ray(&self, pixel: usize, rng: &mut Rng) -> Ray {
        let (right, top) = self.corner(pixel);
        let direction =
            Vector3D::new(right - self.pitch * rng.uniform(), top - self.pitch * rng.uniform(), 1.0);
        Ray::new(Point3D::ORIGIN, direction.normalise_unchecked())
    }

    fn pdf(&self, _: usize, _: Point3D, _: Vector3D) -> Option<f64> {
        None
    }

    #[inline]
    fn response(&self, _: usize, _: Point3D, direction: Vector3D) -> f64 {
        if self.cosine_weighted { direction.z } else { 1.0 }
    }

    fn etendue(&self, pixel: usize) -> Option<f64> {
        match &self.etendue {
            Etendue::Unknown => None,
            Etendue::Uniform(etendue) => Some(*etendue),
            Etendue::Aperture(area) => Some(area * self.projected_solid_angle(pixel)),
            Etendue::Map(map) => map.get(pixel).copied(),
        }
    }

    fn description(&self) -> String {
        let etendue = match &self.etendue {
            Etendue::Map(map) => {
                // A map is told apart by a digest of its bits.
                let digest = map
                    .iter()
                    .fold(0u64, |d, x| (d.rotate_left(5) ^ x.to_bits()).wrapping_mul(0x0100_0000_01b3));
                format!("map {digest:016x}")
            }
            known => format!("{known:?}"),
        };
        let weighted = if self.cosine_weighted { ", cosine-weighted" } else { "" };
        let (kind, shape) = (self.kind(), self.shape());
        format!("{kind} of {shape}, pixels {:e} wide at distance 1, étendue {etendue}{weighted}", self.pitch)
    }

    fn kind(&self) -> &'static str {
        "pinhole camera"
    }
}

impl Storable for Pinhole {
    const KIND: &'static str = "Pinhole";

    fn save(&self, saved: Saved, _: &mut SceneWriter) -> Result<Saved, SaveError> {
        let saved = saved
            .count("columns", self.columns as u64)
            .count("rows", self.rows as u64)
            .number("pitch", self.pitch)
            .flag("cosine_weighted", self.cosine_weighted);
        Ok(match &self.etendue {
            Etendue::Unknown => saved,
            Etendue::Uniform(etendue) => saved.number("etendue", *etendue),
            Etendue::Aperture(area) => saved.number("aperture", *area),
            Etendue::Map(map) => saved.numbers("etendue_map", map),
        })
    }

    fn load(entry: &Entry<'_>) -> Result<Self, MakeError> {
        let (columns, rows) = (entry.integer("columns")?, entry.integer("rows")?);
        let mut pinhole = Self::of(columns, rows, entry.number("pitch")?)?;
        pinhole.cosine_weighted = entry.flag("cosine_weighted")?;
        // Of two the second is left over, and refused as such.
        if entry.has("etendue") {
            pinhole.set_etendue(Etendue::Uniform(entry.number("etendue")?))?;
        } else if entry.has("aperture") {
            pinhole.set_etendue(Etendue::Aperture(entry.number("aperture")?))?;
        } else if entry.has("etendue_map") {
            pinhole.set_etendue(Etendue::Map(entry.numbers("etendue_map")?))?;
        }
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
