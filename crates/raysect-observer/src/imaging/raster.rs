use raysect_math::{MathError, Rng};

use crate::{FrameShape, ObserverError};

/// Square pixels in a plane across the z axis, row by row from +x and +y.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Raster {
    pub(crate) columns: usize,
    pub(crate) rows: usize,
    /// Width of a pixel, in the unit of the plane.
    pub(crate) pitch: f64,
}

/// Refuses no pixels, and more than can be numbered.
pub(crate) fn check_pixels(columns: usize, rows: usize) -> Result<(), ObserverError> {
    MathError::check(columns >= 1, columns as f64, "pixels across", "", "1 or more")?;
    MathError::check(rows >= 1, rows as f64, "pixels down", "", "1 or more")?;
    let fits = columns.checked_mul(rows).is_some_and(|pixels| pixels <= u32::MAX as usize);
    MathError::check(fits, columns as f64 * rows as f64, "pixels", "", "below 2³²")?;
    Ok(())
}

impl Raster {
    /// The name and unit of the pitch are for messages.
    pub(crate) fn new(
        (columns, rows): (usize, usize),
        pitch: f64,
        (name, unit): (&'static str, &'static str),
    ) -> Result<Self, ObserverError> {
        check_pixels(columns, rows)?;
        MathError::check((1e-150..=1e150).contains(&pitch), pitch, name, unit, "1e-150 … 1e150")?;
        Ok(Self { columns, rows, pitch })
    }

    /// Of a field of view [deg] across the larger number of pixels, in a plane at distance 1.
    pub(crate) fn of_field_of_view(
        pixels: (usize, usize),
        field_of_view: f64,
    ) -> Result<Self, ObserverError> {
        let admitted = field_of_view > 0.0 && field_of_view < 180.0;
        MathError::check(admitted, field_of_view, "field of view", "deg", "0 … 180, both excluded")?;
        let width = 2.0 * (0.5 * field_of_view.to_radians()).tan();
        Self::at_distance_one(pixels, width / pixels.0.max(pixels.1).max(1) as f64)
    }

    /// In a plane at distance 1.
    pub(crate) fn at_distance_one(pixels: (usize, usize), pitch: f64) -> Result<Self, ObserverError> {
        Self::new(pixels, pitch, ("width of a pixel at distance 1", ""))
    }

    pub(crate) fn shape(&self) -> FrameShape {
        FrameShape::Image { columns: self.columns, rows: self.rows }
    }

    /// The corner of greatest x and y of a pixel.
    #[inline]
    pub(crate) fn corner(&self, pixel: usize) -> [f64; 2] {
        let (column, row) = ((pixel % self.columns) as f64, (pixel / self.columns) as f64);
        let (half_width, half_height) = (0.5 * self.columns as f64, 0.5 * self.rows as f64);
        [self.pitch * (half_width - column), self.pitch * (half_height - row)]
    }

    /// A uniform point of a pixel, from the next two numbers.
    #[inline]
    pub(crate) fn sample(&self, pixel: usize, rng: &mut Rng) -> [f64; 2] {
        let [right, top] = self.corner(pixel);
        let x = right - self.pitch * rng.uniform();
        [x, top - self.pitch * rng.uniform()]
    }

    /// Density of [`sample`](Self::sample) per area of the plane; its border is widened by what the rounding of numbers up to
    /// `scale` may move.
    #[inline]
    pub(crate) fn pdf(&self, pixel: usize, point: [f64; 2], scale: f64) -> f64 {
        let corner = self.corner(pixel);
        let reach = self.pitch * self.columns.max(self.rows) as f64;
        let inside = |axis: usize| {
            let slack = 16.0 * f64::EPSILON * (reach + scale + point[axis].abs());
            point[axis] <= corner[axis] + slack && point[axis] >= corner[axis] - self.pitch - slack
        };
        if inside(0) && inside(1) { 1.0 / (self.pitch * self.pitch) } else { 0.0 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_sample_has_a_density_in_its_own_pixel_and_in_no_other() {
        let raster = Raster::new((5, 3), 0.3, ("pitch", "m")).unwrap();
        let mut rng = Rng::new(1);
        for sampled in 0..15 {
            for _ in 0..50 {
                let point = raster.sample(sampled, &mut rng);
                let densities: Vec<f64> = (0..15).map(|pixel| raster.pdf(pixel, point, 0.0)).collect();
                assert_eq!(densities.iter().filter(|&&d| d > 0.0).count(), 1);
                assert!((densities[sampled] - 1.0 / 0.09).abs() < 1e-12);
            }
        }
        let corner = raster.corner(0);
        assert!((corner[0] - 0.75).abs() < 1e-15 && (corner[1] - 0.45).abs() < 1e-15, "{corner:?}");
    }
}
