use raysect_core::Ray;
use raysect_math::{Point3D, Rng, Vector3D};

/// How the pixels of a sensor are arranged.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FrameShape {
    /// One pixel.
    Single,
    /// A row of pixels.
    Line(usize),
    /// A picture.
    Image {
        /// Pixels across, from the camera's left (+x) to its right.
        columns: usize,
        /// Pixels down, from the top (+y).
        rows: usize,
    },
}

impl FrameShape {
    /// Number of pixels.
    pub const fn pixels(self) -> usize {
        self.columns() * self.rows()
    }

    /// Pixels across.
    pub const fn columns(self) -> usize {
        match self {
            Self::Single => 1,
            Self::Line(columns) | Self::Image { columns, .. } => columns,
        }
    }

    /// Pixels down.
    pub const fn rows(self) -> usize {
        match self {
            Self::Single | Self::Line(_) => 1,
            Self::Image { rows, .. } => rows,
        }
    }

    /// A pixel and those that it touches.
    pub(crate) fn around(self, pixel: usize) -> impl Iterator<Item = usize> {
        let (columns, rows) = (self.columns(), self.rows());
        let near = |at: usize, count: usize| at.saturating_sub(1)..(at + 2).min(count);
        let (column, row) = (pixel % columns, pixel / columns);
        near(row, rows).flat_map(move |row| near(column, columns).map(move |column| row * columns + column))
    }
}

impl std::fmt::Display for FrameShape {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Single => write!(f, "1 pixel"),
            Self::Line(n) => write!(f, "{n} pixels"),
            Self::Image { columns, rows } => write!(f, "{columns}×{rows} pixels"),
        }
    }
}

/// What looks: where its rays begin and go, and how it weighs what they bring.
///
/// Everything is in the local space of the observer. Pixels are numbered row by row. The weight of a sample follows
/// from the other answers and is never written by hand: radiance counts `response · cosine / (pdf · étendue)`, or
/// just `response` for a sensor that looks along one direction only.
/// [`check_sensor`](crate::testing::check_sensor) tests that E\[response · cosine / pdf\] is the étendue.
pub trait Sensor: Send + Sync {
    /// How its pixels are arranged.
    fn shape(&self) -> FrameShape;

    /// Draws a ray of a pixel; its direction is a unit vector.
    fn sample_ray(&self, pixel: usize, rng: &mut Rng) -> Ray;

    /// Density of [`sample_ray`](Self::sample_ray) per area and solid angle [1/m²/sr]; none for a sensor whose rays
    /// begin at one point or go one way only.
    fn pdf(&self, pixel: usize, origin: Point3D, direction: Vector3D) -> Option<f64>;

    /// Density of the origins of its rays [1/m²]; none for a sensor whose rays begin at one point, and for one that
    /// does not want to be [`Targeted`](crate::Targeted).
    fn origin_pdf(&self, _pixel: usize, _origin: Point3D) -> Option<f64> {
        None
    }

    /// Density of the directions of the rays that begin at an origin [1/sr], by which other directions can be mixed in
    /// ([`Targeted`](crate::Targeted)); [`pdf`](Self::pdf) over [`origin_pdf`](Self::origin_pdf) by default, none for
    /// a sensor that looks one way only.
    fn direction_pdf(&self, pixel: usize, origin: Point3D, direction: Vector3D) -> Option<f64> {
        let (pdf, origins) = (self.pdf(pixel, origin, direction)?, self.origin_pdf(pixel, origin)?);
        Some(if origins > 0.0 { pdf / origins } else { 0.0 })
    }

    /// Relative sensitivity to light that arrives against `direction` at `origin`.
    fn response(&self, _pixel: usize, _origin: Point3D, _direction: Vector3D) -> f64 {
        1.0
    }

    /// Cosine of the angle between `direction` and the normal of the sensor; the z axis by default.
    fn cosine(&self, _pixel: usize, _origin: Point3D, direction: Vector3D) -> f64 {
        direction.z.max(0.0)
    }

    /// ∫∫ response cos θ dΩ dA of a pixel [m² sr], by which radiance becomes power; none if it is not known.
    fn etendue(&self, pixel: usize) -> Option<f64>;

    /// Everything that makes its samples what they are: frames of sensors that describe themselves differently are
    /// never added up. By default what it is and how many pixels it has; a sensor with settings names them here.
    fn description(&self) -> String {
        format!("{} of {}", self.kind(), self.shape())
    }

    /// What it is, for messages and `plan`.
    fn kind(&self) -> &'static str {
        let full = std::any::type_name::<Self>();
        full.rsplit("::").next().unwrap_or(full)
    }
}

/// By how much the radiance along a ray of a sensor counts.
pub(crate) fn radiance_weight<S: Sensor + ?Sized>(sensor: &S, pixel: usize, ray: &Ray) -> f64 {
    let (origin, direction) = (ray.origin, ray.direction);
    let response = sensor.response(pixel, origin, direction);
    match (sensor.pdf(pixel, origin, direction), sensor.etendue(pixel)) {
        (Some(pdf), Some(etendue)) => {
            let seen = response * sensor.cosine(pixel, origin, direction);
            // A direction below the horizon that misses its target by rounding has no density either.
            if seen == 0.0 { 0.0 } else { seen / (pdf * etendue) }
        }
        _ => response,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pixels_touch_those_beside_them_and_none_beyond_the_border() {
        let of = |shape: FrameShape, pixel| shape.around(pixel).collect::<Vec<_>>();
        let image = FrameShape::Image { columns: 4, rows: 3 };
        assert_eq!(of(image, 5), [0, 1, 2, 4, 5, 6, 8, 9, 10]);
        assert_eq!(of(image, 3), [2, 3, 6, 7]);
        assert_eq!(of(image, 8), [4, 5, 8, 9]);
        assert_eq!(of(FrameShape::Line(5), 4), [3, 4]);
        assert_eq!(of(FrameShape::Single, 0), [0]);
    }
}
