use std::sync::Arc;

use raysect_core::Ray;
use raysect_core::save::{Entry, MakeError, SaveError, Saved, SceneWriter, Storable};
use raysect_math::{MathError, Point3D, Rng, Vector3D};

use super::etendue::{PixelEtendue, digest, etendue_settings};
use super::raster::check_pixels;
use crate::{FrameShape, Observer, ObserverError, Sensor};

/// A camera whose pixels look from given points in given directions: one that has been calibrated, or no camera at all.
///
/// A pixel sees what lies between its own line of sight and half-way to those of its neighbours: origins and directions
/// are interpolated bilinearly between the centres of pixels, so that the footprints of neighbours touch and do not
/// overlap, and the line in the middle is the given one. (Raysect's are twice as wide.) Beyond the outermost centres
/// the lines are extrapolated: a pixel on the border reaches as far outwards as inwards. Along an axis with one pixel
/// only there is no footprint. With [`footprint`](Self::footprint)`(false)` all rays are the given lines.
///
/// ```
/// use raysect_math::{Point3D, Vector3D};
/// use raysect_observer::VectorCamera;
/// let origins = vec![Point3D::ORIGIN; 2];
/// let directions = vec![Vector3D::new(0.1, 0.0, 1.0), Vector3D::new(-0.1, 0.0, 1.0)];
/// let camera = VectorCamera::new((2, 1), origins, directions)?;
/// # Ok::<(), raysect_observer::ObserverError>(())
/// ```
pub type VectorCamera = Observer<Vectors>;

/// The sensor of a [`VectorCamera`].
#[derive(Debug, Clone, PartialEq)]
pub struct Vectors {
    columns: usize,
    rows: usize,
    origins: Arc<[Point3D]>,
    /// Of unit length.
    directions: Arc<[Vector3D]>,
    footprint: bool,
    pub(super) etendue: PixelEtendue,
}

etendue_settings!(Vectors);

impl Observer<Vectors> {
    /// Of columns × rows of pixels, with an origin [m] and a direction for each, row by row from the upper left.
    ///
    /// # Errors
    /// [`ObserverError::PixelCount`] for a wrong number of either, [`ObserverError::Math`] for no pixels or 2³² and
    /// more, an origin that is not finite, or a direction without length.
    pub fn new(
        pixels: (usize, usize),
        origins: Vec<Point3D>,
        directions: Vec<Vector3D>,
    ) -> Result<Self, ObserverError> {
        Ok(Self::with_sensor(Vectors::of(pixels, origins, directions)?))
    }

    /// Whether a pixel sees what lies around its line of sight, up to half-way to its neighbours. On by default.
    pub fn footprint(mut self, footprint: bool) -> Self {
        self.sensor_mut().footprint = footprint;
        self
    }
}

impl Vectors {
    fn of(
        (columns, rows): (usize, usize),
        origins: Vec<Point3D>,
        directions: Vec<Vector3D>,
    ) -> Result<Self, ObserverError> {
        check_pixels(columns, rows)?;
        let expected = columns * rows;
        for (what, found) in [("origins", origins.len()), ("directions", directions.len())] {
            if found != expected {
                return Err(ObserverError::PixelCount { what, found, expected });
            }
        }
        for origin in &origins {
            let farthest = origin.max_abs();
            MathError::check(farthest.is_finite(), farthest, "coordinate of an origin", "m", "finite")?;
        }
        let units = directions.into_iter().map(unit).collect::<Result<Vec<_>, _>>()?;
        Ok(Self {
            columns,
            rows,
            origins: origins.into(),
            directions: units.into(),
            footprint: true,
            etendue: PixelEtendue::Unknown,
        })
    }

    /// The line of sight in the middle of a pixel.
    pub fn line(&self, pixel: usize) -> Option<(Point3D, Vector3D)> {
        Some((*self.origins.get(pixel)?, *self.directions.get(pixel)?))
    }

    /// The value at a place off the centre of a pixel, in pixels.
    fn interpolate(
        &self,
        pixel: usize,
        [right, down]: [f64; 2],
        value: impl Fn(usize) -> Vector3D,
    ) -> Vector3D {
        let (column, row) = (pixel % self.columns, pixel / self.columns);
        let (other_column, across) = neighbour(column, self.columns, right);
        let (other_row, along) = neighbour(row, self.rows, down);
        let at = |column: usize, row: usize| value(row * self.columns + column);
        let upper = mix(at(column, row), at(other_column, row), across);
        let lower = mix(at(column, other_row), at(other_column, other_row), across);
        mix(upper, lower, along)
    }
}

/// A unit vector; one that is a unit vector already keeps its bits, so that files do.
fn unit(v: Vector3D) -> Result<Vector3D, MathError> {
    if (v.length() - 1.0).abs() <= 4.0 * f64::EPSILON { Ok(v) } else { v.normalise() }
}

/// The pixel of a row or column with which to interpolate for a place off the centre, and the share of its value. At the
/// border it is the neighbour on the other side, with a negative share.
fn neighbour(place: usize, count: usize, offset: f64) -> (usize, f64) {
    let last = count - 1;
    match (offset >= 0.0, place) {
        _ if count == 1 => (place, 0.0),
        (true, place) if place < last => (place + 1, offset),
        (true, place) => (place - 1, -offset),
        (false, 0) => (1, offset),
        (false, place) => (place - 1, -offset),
    }
}

fn mix(a: Vector3D, b: Vector3D, share: f64) -> Vector3D {
    a + (b - a) * share
}

impl Sensor for Vectors {
    fn shape(&self) -> FrameShape {
        FrameShape::Image { columns: self.columns, rows: self.rows }
    }

    fn sample_ray(&self, pixel: usize, rng: &mut Rng) -> Ray {
        let (origin, direction) = (self.origins[pixel], self.directions[pixel]);
        if !self.footprint {
            return Ray::new(origin, direction);
        }
        let right = rng.uniform() - 0.5;
        let place = [right, rng.uniform() - 0.5];
        let shift = self.interpolate(pixel, place, |p| origin.vector_to(self.origins[p]));
        let mixed = self.interpolate(pixel, place, |p| self.directions[p]);
        // Lines that look opposite ways have no middle.
        Ray::new(origin + shift, mixed.normalise().unwrap_or(direction))
    }

    fn pdf(&self, _: usize, _: Point3D, _: Vector3D) -> Option<f64> {
        None
    }

    fn etendue(&self, pixel: usize) -> Option<f64> {
        self.etendue.of(pixel, || f64::NAN)
    }

    fn description(&self) -> String {
        let origins = self.origins.iter().flat_map(|p| p.to_array());
        let lines = digest(origins.chain(self.directions.iter().flat_map(|v| v.to_array())));
        let footprint = if self.footprint { "" } else { " without footprint" };
        let (kind, shape, etendue) = (self.kind(), self.shape(), self.etendue.describe());
        format!("{kind} of {shape}, lines {lines:016x}{footprint}, étendue {etendue}")
    }

    fn kind(&self) -> &'static str {
        "vector camera"
    }
}

impl Storable for Vectors {
    const KIND: &'static str = "Vectors";

    fn save(&self, saved: Saved, _: &mut SceneWriter) -> Result<Saved, SaveError> {
        let origins: Vec<f64> = self.origins.iter().flat_map(|p| p.to_array()).collect();
        let directions: Vec<f64> = self.directions.iter().flat_map(|v| v.to_array()).collect();
        let saved = saved
            .count("columns", self.columns as u64)
            .count("rows", self.rows as u64)
            .numbers("origins", &origins)
            .numbers("directions", &directions)
            .flag("footprint", self.footprint);
        Ok(self.etendue.save(saved))
    }

    fn load(entry: &Entry<'_>) -> Result<Self, MakeError> {
        let pixels = (entry.integer("columns")?, entry.integer("rows")?);
        let origins = triples("origins", &entry.numbers("origins")?)?;
        let directions = triples("directions", &entry.numbers("directions")?)?;
        let origins = origins.into_iter().map(Point3D::from).collect();
        let mut vectors = Self::of(pixels, origins, directions.into_iter().map(Vector3D::from).collect())?;
        vectors.footprint = entry.flag("footprint")?;
        vectors.etendue = PixelEtendue::load(entry, vectors.shape().pixels(), false)?;
        Ok(vectors)
    }
}

/// Numbers by three.
pub(crate) fn triples(what: &'static str, numbers: &[f64]) -> Result<Vec<[f64; 3]>, MathError> {
    let (triples, rest) = numbers.as_chunks::<3>();
    MathError::check(rest.is_empty(), numbers.len() as f64, what, "", "three numbers for each")?;
    Ok(triples.to_vec())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::check_sensor;
    use crate::{OrthographicCamera, PinholeCamera};

    /// The centres of the pixels of a pinhole of 4 × 3, pitch 0.25.
    fn pinhole_lines() -> (Vec<Point3D>, Vec<Vector3D>) {
        let direction =
            |p: usize| Vector3D::new(0.375 - 0.25 * (p % 4) as f64, 0.25 - 0.25 * (p / 4) as f64, 1.0);
        (vec![Point3D::ORIGIN; 12], (0..12).map(direction).collect())
    }

    #[test]
    fn footprints_touch_and_do_not_overlap() {
        let (origins, directions) = pinhole_lines();
        let camera = VectorCamera::new((4, 3), origins, directions).unwrap();
        let sensor = camera.sensor();
        check_sensor(sensor, 1000, 1).unwrap();
        let mut rng = Rng::new(2);
        for pixel in 0..12 {
            let centre = [0.375 - 0.25 * (pixel % 4) as f64, 0.25 - 0.25 * (pixel / 4) as f64];
            let (mut low, mut high) = ([1.0f64; 2], [-1.0f64; 2]);
            for _ in 0..4000 {
                let d = sensor.sample_ray(pixel, &mut rng).direction;
                for (axis, place) in [d.x / d.z, d.y / d.z].into_iter().enumerate() {
                    low[axis] = low[axis].min(place - centre[axis]);
                    high[axis] = high[axis].max(place - centre[axis]);
                }
            }
            // Straight lines between unit vectors leave the plane of the pixels a little.
            for reach in low.iter().map(|x| -x).chain(high) {
                assert!((reach - 0.125).abs() < 0.012, "pixel {pixel}: {reach}");
            }
        }
    }

    #[test]
    fn a_vector_camera_of_parallel_lines_is_orthographic() {
        let place = |p: usize| Point3D::new(0.2 - 0.4 * (p % 2) as f64, 0.0, 0.0);
        let camera = VectorCamera::new((2, 1), (0..2).map(place).collect(), vec![Vector3D::Z; 2]).unwrap();
        let ortho = OrthographicCamera::new((2, 1), 0.8).unwrap();
        for pixel in 0..2 {
            let (mut a, mut b) = (Rng::new(3), Rng::new(3));
            for _ in 0..100 {
                let (ray, other) =
                    (camera.sensor().sample_ray(pixel, &mut a), ortho.sensor().sample_ray(pixel, &mut b));
                assert!((ray.origin.x - other.origin.x).abs() < 1e-15 && ray.direction == Vector3D::Z);
            }
        }
    }

    #[test]
    fn one_pixel_and_rays_without_footprint_are_the_given_lines() {
        let (origin, direction) = (Point3D::new(1.0, 2.0, 3.0), Vector3D::new(0.0, 3.0, 4.0));
        let single = VectorCamera::new((1, 1), vec![origin], vec![direction]).unwrap();
        let (origins, directions) = pinhole_lines();
        let bare = VectorCamera::new((4, 3), origins, directions).unwrap().footprint(false);
        let mut rng = Rng::new(1);
        let ray = single.sensor().sample_ray(0, &mut rng);
        assert!(ray.origin == origin && (ray.direction - Vector3D::new(0.0, 0.6, 0.8)).length() < 1e-15);
        for pixel in 0..12 {
            let ray = bare.sensor().sample_ray(pixel, &mut rng);
            assert_eq!(Some((ray.origin, ray.direction)), bare.sensor().line(pixel));
        }
        // A pinhole's own centres: the same order of pixels.
        let pinhole = PinholeCamera::new((4, 3), 2.0 * 0.5f64.atan().to_degrees()).unwrap();
        let first = pinhole.sensor().sample_ray(0, &mut rng).direction;
        assert!(first.dot(bare.sensor().line(0).unwrap().1) > 0.98);
    }

    #[test]
    fn lines_that_look_opposite_ways_stay_lines() {
        let opposite = vec![Vector3D::Z, -Vector3D::Z];
        let camera = VectorCamera::new((2, 1), vec![Point3D::ORIGIN; 2], opposite).unwrap();
        check_sensor(camera.sensor(), 1000, 1).unwrap();
    }

    #[test]
    fn impossible_lines_are_refused() {
        let new = |n: usize, origin: f64, direction: f64| {
            VectorCamera::new(
                (2, 1),
                vec![Point3D::new(origin, 0.0, 0.0); 2],
                vec![Vector3D::Z * direction; n],
            )
        };
        assert!(new(2, 0.0, 1.0).is_ok());
        assert!(matches!(new(3, 0.0, 1.0), Err(ObserverError::PixelCount { found: 3, expected: 2, .. })));
        assert!(new(2, f64::NAN, 1.0).is_err() && new(2, 0.0, 0.0).is_err());
        assert!(VectorCamera::new((0, 0), vec![], vec![]).is_err());
    }
}
