//! Uniform points in a square or rectangle.

use super::{SLACK, draws};
use crate::{MathError, Point2D, Point3D};

/// A uniform point in the unit square, 0 … 1 along both axes.
#[doc(alias = "point_square")]
#[inline]
pub fn sample(u: [f64; 2]) -> Point2D {
    Point2D::new(u[0], u[1])
}

/// Density of [`sample`] per unit area: 1 in the unit square, 0 outside.
#[inline]
pub fn pdf(point: Point2D) -> f64 {
    let inside = |t: f64| (0.0..=1.0).contains(&t);
    if inside(point.x) && inside(point.y) { 1.0 } else { 0.0 }
}

/// Uniform points on a rectangle in the plane z = 0, centred on the origin.
#[doc(alias = "RectangleSampler")]
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RectangleSampler3D {
    width: f64,
    height: f64,
}

draws!(RectangleSampler3D -> Point3D);

impl Default for RectangleSampler3D {
    /// 1 m × 1 m, as in Raysect.
    fn default() -> Self {
        Self { width: 1.0, height: 1.0 }
    }
}

impl RectangleSampler3D {
    /// A rectangle with the given extents along x and y [m].
    ///
    /// # Errors
    /// [`MathError::OutOfRange`] for an extent outside 1e-150 … 1e150 m.
    pub fn new(width: f64, height: f64) -> Result<Self, MathError> {
        for (value, name) in [(width, "width"), (height, "height")] {
            MathError::check((1e-150..=1e150).contains(&value), value, name, "m", "1e-150 … 1e150")?;
        }
        Ok(Self { width, height })
    }

    /// Extent along x [m].
    #[inline]
    pub fn width(&self) -> f64 {
        self.width
    }

    /// Extent along y [m].
    #[inline]
    pub fn height(&self) -> f64 {
        self.height
    }

    /// Area [m²].
    #[inline]
    pub fn area(&self) -> f64 {
        self.width * self.height
    }

    /// The point [m] for two uniforms in (0, 1).
    #[inline]
    pub fn sample_at(&self, u: [f64; 2]) -> Point3D {
        Point3D::new((u[0] - 0.5) * self.width, (u[1] - 0.5) * self.height, 0.0)
    }

    /// Density [1/m²] at a point of the plane z = 0 [m]: 1 / area on the rectangle, 0 outside. Its z is not
    /// looked at.
    #[inline]
    pub fn pdf(&self, point: Point3D) -> f64 {
        let inside = |t: f64, extent: f64| t.abs() <= 0.5 * extent * SLACK;
        if inside(point.x, self.width) && inside(point.y, self.height) { 1.0 / self.area() } else { 0.0 }
    }
}

#[cfg(test)]
mod tests {
    use super::super::check::{Chart, extremes};
    use super::*;
    use crate::{Rng, sampling::uniforms};

    fn plane(low: [f64; 2], high: [f64; 2]) -> Chart<Point3D> {
        Chart {
            low,
            high,
            bins: [12, 10],
            place: Box::new(|[x, y]| Point3D::new(x, y, 0.0)),
            coordinates: Box::new(|p| [p.x, p.y]),
            jacobian: Box::new(|_| 1.0),
        }
    }

    #[test]
    fn points_of_the_rectangle_follow_their_density() {
        let rectangle = RectangleSampler3D::new(3.0, 0.2).unwrap();
        let points = rectangle.samples(200_000, &mut Rng::new(1));
        let chart = plane([-1.5, -0.1], [1.5, 0.1]);
        assert!((chart.integral(&|p| rectangle.pdf(p)) - 1.0).abs() < 1e-12);
        assert!(chart.fits(&points, &|p| rectangle.pdf(p)));
        // Bins beyond the border must stay empty.
        let wide = plane([-3.0, -0.2], [3.0, 0.3]);
        assert!((wide.integral(&|p| rectangle.pdf(p)) - 1.0).abs() < 1e-12);
        assert!(wide.fits(&points, &|p| rectangle.pdf(p)));
    }

    #[test]
    fn points_of_the_square_follow_their_density() {
        let mut rng = Rng::new(3);
        let points: Vec<Point3D> =
            (0..200_000).map(|_| sample(uniforms(&mut rng))).map(|p| Point3D::new(p.x, p.y, 0.0)).collect();
        let chart = plane([0.0, 0.0], [1.0, 1.0]);
        let density = |p: Point3D| pdf(Point2D::new(p.x, p.y));
        assert!((chart.integral(&density) - 1.0).abs() < 1e-12);
        assert!(chart.fits(&points, &density));
        assert!(!chart.fits(&points, &|p| 0.9 + 0.2 * p.x));
    }

    #[test]
    fn a_slope_of_one_part_in_twenty_is_found_out() {
        let rectangle = RectangleSampler3D::new(3.0, 0.2).unwrap();
        let points = rectangle.samples(200_000, &mut Rng::new(2));
        let chart = plane([-1.5, -0.1], [1.5, 0.1]);
        let sloping = |p: Point3D| rectangle.pdf(p) * (1.0 + 0.05 * p.x / 1.5);
        assert!((chart.integral(&sloping) - 1.0).abs() < 1e-12);
        assert!(!chart.fits(&points, &sloping));
        let wider = RectangleSampler3D::new(3.0, 0.21).unwrap();
        assert!(!chart.fits(&points, &|p| wider.pdf(p)));
    }

    #[test]
    fn the_ends_of_the_uniforms_stay_on_the_rectangle() {
        let rectangle = RectangleSampler3D::new(0.7, 1e100).unwrap();
        for u in extremes() {
            let p = rectangle.sample_at(u);
            assert!(p.is_finite() && p.x.abs() <= 0.35 && p.y.abs() <= 0.5e100);
            assert_eq!((rectangle.pdf(p), pdf(sample(u))), (1.0 / 0.7e100, 1.0));
        }
    }

    #[test]
    fn outside_the_density_is_zero_and_bad_extents_are_refused() {
        assert_eq!(pdf(Point2D::new(0.5, 1.0 + 1e-12)), 0.0);
        assert_eq!(RectangleSampler3D::default().pdf(Point3D::new(-0.5 - 1e-12, 0.0, 0.0)), 0.0);
        for bad in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            assert!(RectangleSampler3D::new(bad, 1.0).is_err() && RectangleSampler3D::new(1.0, bad).is_err());
        }
    }
}
