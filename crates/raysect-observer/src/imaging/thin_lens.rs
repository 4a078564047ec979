use std::f64::consts::PI;
use std::sync::Arc;

use raysect_core::Ray;
use raysect_core::save::{Entry, MakeError, SaveError, Saved, SceneWriter, Storable};
use raysect_math::sampling::{disk, uniforms};
use raysect_math::{MathError, Point3D, Rng, Vector3D};

use super::gauss::gauss_legendre;
use super::raster::Raster;
use crate::{FrameShape, Observer, ObserverError, Sensor};

/// A camera with a round lens of no thickness: what stands at the focus distance is sharp, all else is blurred.
///
/// It looks along z, with x to its left and y up; the lens is a disk in the plane z = 0. A pixel is a square in the
/// plane at the focus distance, upright as for a pinhole, and sees what passes through any point of the lens into it.
/// Its étendue follows from that: power can be measured without a calibration.
///
/// ```
/// use raysect_observer::{Sensor, ThinLensCamera};
/// // An opening of 5 cm across, focused at 3 m.
/// let camera = ThinLensCamera::new((64, 48), 45.0, 0.025, 3.0)?;
/// assert!(camera.sensor().etendue(0).is_some());
/// # Ok::<(), raysect_observer::ObserverError>(())
/// ```
pub type ThinLensCamera = Observer<ThinLens>;

/// The sensor of a [`ThinLensCamera`].
#[derive(Debug, Clone, PartialEq)]
pub struct ThinLens {
    /// In the plane at the focus distance.
    raster: Raster,
    radius: f64,
    focus: f64,
    /// Of every pixel [m² sr].
    etendues: Arc<[f64]>,
}

impl Observer<ThinLens> {
    /// Of columns × rows of pixels, with a field of view [deg] across the larger number of them, a lens of a radius [m],
    /// focused at a distance [m].
    ///
    /// # Errors
    /// [`ObserverError::Math`] for no pixels or 2³² and more, a field of view outside 0 … 179 degrees, a radius or a
    /// focus distance outside 1e-60 … 1e60 m.
    pub fn new(
        pixels: (usize, usize),
        field_of_view: f64,
        radius: f64,
        focus_distance: f64,
    ) -> Result<Self, ObserverError> {
        let admitted = field_of_view > 0.0 && field_of_view <= 179.0;
        MathError::check(admitted, field_of_view, "field of view", "deg", "0 … 179, 0 excluded")?;
        let at_one = Raster::of_field_of_view(pixels, field_of_view)?;
        Ok(Self::with_sensor(ThinLens::of(pixels, at_one.pitch, radius, focus_distance)?))
    }
}

impl ThinLens {
    /// The pitch belongs to a plane at distance 1.
    fn of(pixels: (usize, usize), pitch: f64, radius: f64, focus: f64) -> Result<Self, ObserverError> {
        let admitted = |x: f64| (1e-60..=1e60).contains(&x);
        MathError::check(admitted(radius), radius, "radius of the lens", "m", "1e-60 … 1e60")?;
        MathError::check(admitted(focus), focus, "focus distance", "m", "1e-60 … 1e60")?;
        Raster::at_distance_one(pixels, pitch)?;
        let raster = Raster::new(pixels, pitch * focus, ("width of a pixel at the focus distance", "m"))?;
        let mut lens = Self { raster, radius, focus, etendues: Arc::from([]) };
        lens.etendues = lens.all_etendues();
        Ok(lens)
    }

    /// Radius of the lens [m].
    pub fn radius(&self) -> f64 {
        self.radius
    }

    /// Distance of the plane that is sharp [m].
    pub fn focus_distance(&self) -> f64 {
        self.focus
    }

    /// ∫ cos θ dΩ over the lens, from a point of the plane of focus at a distance from the axis whose square is given:
    /// π times the view factor of a parallel disk (J. R. Howell, *A Catalog of Radiation Heat Transfer Configuration
    /// Factors*, B-13), in a form without cancellation.
    fn projected_lens(&self, off_axis_squared: f64) -> f64 {
        let (r2, h2) = (self.radius * self.radius, self.focus * self.focus);
        let s = off_axis_squared + h2 + r2;
        let root = (s * s - 4.0 * off_axis_squared * r2).sqrt();
        2.0 * PI * r2 * h2 / (root * (root + off_axis_squared + h2 - r2))
    }

    /// The integral of [`projected_lens`](Self::projected_lens) over every pixel.
    ///
    /// It is analytic within the focus distance of the real axis, by which the error of a Gauss-Legendre rule falls as
    /// ρ to the power −2n (L. N. Trefethen, *Approximation Theory and Approximation Practice*, ch. 19).
    fn all_etendues(&self) -> Arc<[f64]> {
        let rings = 2.0 * self.focus / self.raster.pitch;
        let rho = rings + rings.hypot(1.0);
        let n = ((16.0 / (2.0 * rho.log10())).ceil() as usize).clamp(2, 256);
        let (rule, half) = (gauss_legendre(n), 0.5 * self.raster.pitch);
        let of = |pixel: usize| {
            let [right, top] = self.raster.corner(pixel);
            let mut sum = 0.0;
            for (x, across) in &rule {
                for (y, down) in &rule {
                    let (x, y) = (right - half * (1.0 + x), top - half * (1.0 + y));
                    sum += across * down * self.projected_lens(x * x + y * y);
                }
            }
            half * half * sum
        };
        (0..self.raster.shape().pixels()).map(of).collect()
    }
}

impl Sensor for ThinLens {
    fn shape(&self) -> FrameShape {
        self.raster.shape()
    }

    #[inline]
    fn sample_ray(&self, pixel: usize, rng: &mut Rng) -> Ray {
        let [x, y] = self.raster.sample(pixel, rng);
        let lens = disk::sample(uniforms(rng));
        let origin = Point3D::new(self.radius * lens.x, self.radius * lens.y, 0.0);
        let direction = Vector3D::new(x - origin.x, y - origin.y, self.focus);
        Ray::new(origin, direction.normalise_unchecked())
    }

    fn pdf(&self, pixel: usize, origin: Point3D, direction: Vector3D) -> Option<f64> {
        Some(self.origin_pdf(pixel, origin)? * self.direction_pdf(pixel, origin, direction)?)
    }

    #[inline]
    fn origin_pdf(&self, _: usize, origin: Point3D) -> Option<f64> {
        let squared = origin.x * origin.x + origin.y * origin.y;
        let area = PI * self.radius * self.radius;
        let inside = squared <= self.radius * self.radius * (1.0 + 16.0 * f64::EPSILON);
        Some(if inside { 1.0 / area } else { 0.0 })
    }

    #[inline]
    fn direction_pdf(&self, pixel: usize, origin: Point3D, direction: Vector3D) -> Option<f64> {
        let Vector3D { x, y, z } = direction;
        if z <= 0.0 {
            return Some(0.0);
        }
        let distance = self.focus / z;
        let place = [origin.x + distance * x, origin.y + distance * y];
        Some(self.raster.pdf(pixel, place, self.radius) * (distance * distance / z))
    }

    fn etendue(&self, pixel: usize) -> Option<f64> {
        self.etendues.get(pixel).copied()
    }

    /// 1 towards the pixel, 0 elsewhere.
    fn response(&self, pixel: usize, origin: Point3D, direction: Vector3D) -> f64 {
        if self.direction_pdf(pixel, origin, direction) > Some(0.0) { 1.0 } else { 0.0 }
    }

    fn description(&self) -> String {
        let (kind, shape, pitch) = (self.kind(), self.shape(), self.raster.pitch);
        let (radius, focus) = (self.radius, self.focus);
        format!("{kind} of {shape}, pixels {pitch:e} m wide at {focus:e} m, radius {radius:e} m")
    }

    fn kind(&self) -> &'static str {
        "thin lens camera"
    }
}

impl Storable for ThinLens {
    const KIND: &'static str = "ThinLens";

    fn save(&self, saved: Saved, _: &mut SceneWriter) -> Result<Saved, SaveError> {
        Ok(saved
            .count("columns", self.raster.columns as u64)
            .count("rows", self.raster.rows as u64)
            .number("pitch_in_focus", self.raster.pitch)
            .number("radius", self.radius)
            .number("focus_distance", self.focus))
    }

    fn load(entry: &Entry<'_>) -> Result<Self, MakeError> {
        let pixels = (entry.integer("columns")?, entry.integer("rows")?);
        let (pitch, focus) = (entry.number("pitch_in_focus")?, entry.number("focus_distance")?);
        let mut lens = Self::of(pixels, pitch / focus, entry.number("radius")?, focus)?;
        // Every bit of what was saved, not a quotient and its product.
        lens.raster.pitch = pitch;
        lens.etendues = lens.all_etendues();
        Ok(lens)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::check_sensor;

    #[test]
    fn the_etendue_is_that_of_the_rays() {
        // Wide, fast, close; and of one pixel.
        for (pixels, view, radius, focus) in [
            ((3, 5), 70.0, 0.5, 1.0),
            ((1, 1), 120.0, 2.0, 1.0),
            ((64, 2), 20.0, 1e-3, 5.0),
            ((2, 2), 1e-3, 0.5, 1.0),
        ] {
            let camera = ThinLensCamera::new(pixels, view, radius, focus).unwrap();
            check_sensor(camera.sensor(), 100_000, 1).unwrap();
        }
        let mut wrong = ThinLensCamera::new((1, 1), 120.0, 2.0, 1.0).unwrap().sensor().clone();
        wrong.etendues = Arc::from([wrong.etendues[0] * 1.02]);
        assert!(check_sensor(&wrong, 100_000, 1).is_err());
    }

    #[test]
    fn a_small_lens_has_the_etendue_of_an_aperture() {
        let radius = 1e-7;
        let lens = ThinLensCamera::new((5, 3), 80.0, radius, 2.0).unwrap();
        let pinhole =
            crate::PinholeCamera::new((5, 3), 80.0).unwrap().aperture(PI * radius * radius).unwrap();
        for pixel in 0..15 {
            let ratio = lens.sensor().etendue(pixel).unwrap() / pinhole.sensor().etendue(pixel).unwrap();
            assert!((ratio - 1.0).abs() < 1e-12, "{ratio}");
        }
    }

    #[test]
    fn all_pixels_together_have_the_etendue_of_one_that_covers_them() {
        let total = |n: usize| -> f64 {
            let camera = ThinLensCamera::new((n, n), 100.0, 0.7, 1.3).unwrap();
            (0..n * n).map(|p| camera.sensor().etendue(p).unwrap()).sum()
        };
        for n in [2, 7, 40] {
            assert!((total(n) / total(1) - 1.0).abs() < 1e-12, "{n}");
        }
    }

    #[test]
    fn rays_of_a_pixel_meet_in_the_plane_of_focus() {
        let camera = ThinLensCamera::new((400, 300), 40.0, 0.1, 3.0).unwrap();
        let (sensor, mut rng) = (camera.sensor(), Rng::new(1));
        let pitch = 6.0 * (20f64.to_radians()).tan() / 400.0;
        for _ in 0..1000 {
            let ray = sensor.sample_ray(0, &mut rng);
            let p = ray.point_at(3.0 / ray.direction.z);
            assert!(p.x < 200.0 * pitch + 1e-12 && p.x > 199.0 * pitch - 1e-12, "{p:?}");
            assert!(p.y < 150.0 * pitch + 1e-12 && p.y > 149.0 * pitch - 1e-12, "{p:?}");
        }
    }

    #[test]
    fn impossible_lenses_are_refused() {
        for (view, radius, focus) in [(0.0, 1.0, 1.0), (180.0, 1.0, 1.0), (45.0, 0.0, 1.0), (45.0, 1.0, -1.0)]
        {
            assert!(ThinLensCamera::new((2, 2), view, radius, focus).is_err());
        }
        assert!(ThinLensCamera::new((2, 2), 45.0, f64::NAN, 1.0).is_err());
        assert!(ThinLensCamera::new((0, 2), 45.0, 1.0, 1.0).is_err());
    }
}
