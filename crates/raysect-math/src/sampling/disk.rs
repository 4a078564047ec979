//! Uniform points in a disk.

use std::f64::consts::{FRAC_PI_4, PI};

use super::{SLACK, draws};
use crate::{MathError, Point2D, Point3D};

/// The concentric map: a point of the unit disk, and 1 minus its distance from the centre, which is positive
/// however close to the rim the point lies.
#[inline]
pub(super) fn concentric(u: [f64; 2]) -> (f64, f64, f64) {
    let (a, b) = (2.0 * u[0] - 1.0, 2.0 * u[1] - 1.0);
    if a.abs() > b.abs() {
        let (s, c) = (FRAC_PI_4 * (b / a)).sin_cos();
        (a * c, a * s, 2.0 * u[0].min(1.0 - u[0]))
    } else if b != 0.0 {
        let (s, c) = (FRAC_PI_4 * (a / b)).sin_cos();
        (b * s, b * c, 2.0 * u[1].min(1.0 - u[1]))
    } else {
        (0.0, 0.0, 1.0)
    }
}

/// A uniform point in the unit disk.
///
/// The concentric map keeps neighbours together, so that evenly spread uniforms give evenly spread points:
/// P. Shirley, K. Chiu, *A Low Distortion Map Between Disk and Square*, Journal of Graphics Tools 2(3), 1997.
#[doc(alias = "point_disk")]
#[inline]
pub fn sample(u: [f64; 2]) -> Point2D {
    let (x, y, _) = concentric(u);
    Point2D::new(x, y)
}

/// Density of [`sample`] per unit area: 1/π in the unit disk, 0 outside.
#[inline]
pub fn pdf(point: Point2D) -> f64 {
    if point.x * point.x + point.y * point.y <= SLACK { 1.0 / PI } else { 0.0 }
}

/// Uniform points on a disk in the plane z = 0, centred on the origin.
#[doc(alias = "DiskSampler")]
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DiskSampler3D {
    radius: f64,
}

draws!(DiskSampler3D -> Point3D);

impl Default for DiskSampler3D {
    /// Radius 1 m, as in Raysect.
    fn default() -> Self {
        Self { radius: 1.0 }
    }
}

impl DiskSampler3D {
    /// A disk of the given radius [m].
    ///
    /// # Errors
    /// [`MathError::OutOfRange`] for a radius outside 1e-150 … 1e150 m.
    pub fn new(radius: f64) -> Result<Self, MathError> {
        let admitted = (1e-150..=1e150).contains(&radius);
        MathError::check(admitted, radius, "radius", "m", "1e-150 … 1e150")?;
        Ok(Self { radius })
    }

    /// Radius [m].
    #[inline]
    pub fn radius(&self) -> f64 {
        self.radius
    }

    /// Area [m²].
    #[inline]
    pub fn area(&self) -> f64 {
        PI * self.radius * self.radius
    }

    /// The point [m] for two uniforms in (0, 1); see [`sample`].
    #[inline]
    pub fn sample_at(&self, u: [f64; 2]) -> Point3D {
        let (x, y, _) = concentric(u);
        Point3D::new(self.radius * x, self.radius * y, 0.0)
    }

    /// Density [1/m²] at a point of the plane z = 0 [m]: 1 / area on the disk, 0 outside. Its z is not looked
    /// at.
    #[inline]
    pub fn pdf(&self, point: Point3D) -> f64 {
        pdf(Point2D::new(point.x / self.radius, point.y / self.radius)) / (self.radius * self.radius)
    }
}

#[cfg(test)]
mod tests {
    use super::super::check::{Chart, extremes};
    use super::*;
    use crate::{Rng, sampling::uniforms};

    fn polar(radius: f64) -> Chart<Point3D> {
        Chart {
            low: [0.0, -PI],
            high: [radius, PI],
            bins: [8, 16],
            place: Box::new(|[r, phi]| Point3D::new(r * phi.cos(), r * phi.sin(), 0.0)),
            coordinates: Box::new(|p| [p.x.hypot(p.y), p.y.atan2(p.x)]),
            jacobian: Box::new(|[r, _]| r),
        }
    }

    #[test]
    fn points_follow_their_density() {
        let disk = DiskSampler3D::new(2.5).unwrap();
        let chart = polar(2.5);
        let points = disk.samples(200_000, &mut Rng::new(1));
        assert!((chart.integral(&|p| disk.pdf(p)) - 1.0).abs() < 1e-12);
        assert!(chart.fits(&points, &|p| disk.pdf(p)));
        assert!(points.iter().all(|p| p.z == 0.0));
    }

    #[test]
    fn a_density_uniform_in_radius_is_found_out() {
        let disk = DiskSampler3D::new(2.5).unwrap();
        let points = disk.samples(200_000, &mut Rng::new(2));
        let wrong = |p: Point3D| 1.0 / (2.0 * PI * 2.5 * p.x.hypot(p.y));
        assert!((polar(2.5).integral(&wrong) - 1.0).abs() < 1e-12);
        assert!(!polar(2.5).fits(&points, &wrong));
        let clustered: Vec<Point3D> = (points.iter())
            .map(|p| Point3D::new(p.x * p.x.hypot(p.y) / 2.5, p.y * p.x.hypot(p.y) / 2.5, 0.0))
            .collect();
        assert!(!polar(2.5).fits(&clustered, &|p| disk.pdf(p)));
    }

    #[test]
    fn the_ends_of_the_uniforms_stay_on_the_disk() {
        let disk = DiskSampler3D::new(1e-3).unwrap();
        for u in extremes() {
            let (p, q) = (sample(u), disk.sample_at(u));
            assert!(p.x.hypot(p.y) <= 1.0 && q.is_finite(), "{u:?}");
            assert_eq!(pdf(p), 1.0 / PI);
            assert!((disk.pdf(q) * disk.area() - 1.0).abs() < 1e-15);
        }
        assert_eq!(sample([0.5, 0.5]), Point2D::new(0.0, 0.0));
    }

    #[test]
    fn one_minus_the_distance_is_exact_near_the_rim() {
        let mut rng = Rng::new(4);
        for _ in 0..10_000 {
            let (x, y, rim) = concentric(uniforms(&mut rng));
            assert!((1.0 - x.hypot(y) - rim).abs() <= 4.0 * f64::EPSILON && rim > 0.0);
        }
        assert_eq!(concentric([1e-30, 0.4]).2, 2e-30);
    }

    #[test]
    fn outside_the_disk_the_density_is_zero_and_bad_radii_are_refused() {
        assert_eq!(pdf(Point2D::new(0.8, 0.6 + 1e-12)), 0.0);
        assert_eq!(DiskSampler3D::default().pdf(Point3D::new(1.0, 1.0, 0.0)), 0.0);
        for radius in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            assert!(DiskSampler3D::new(radius).is_err());
        }
        let message = DiskSampler3D::new(-1.0).unwrap_err().to_string();
        assert_eq!(message, "radius = -1 m is outside its range 1e-150 … 1e150");
    }
}
