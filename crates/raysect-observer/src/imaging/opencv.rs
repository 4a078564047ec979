use std::sync::Arc;

use raysect_core::Ray;
use raysect_core::save::{Entry, MakeError, SaveError, Saved, SceneWriter, Storable};
use raysect_math::{AffineMatrix3D, Point3D, Rng, Vector3D};

use super::etendue::{PixelEtendue, etendue_settings};
use super::opencv_model::{OpenCvModel, camera_to_local};
use super::raster::check_pixels;
use crate::{FrameShape, Observer, ObserverError, Sensor};

/// A camera that has been calibrated with OpenCV: camera matrix, distortion, and its place as rotation and translation.
///
/// The model is OpenCV's: k₁ … k₆, p₁ and p₂. The picture is undistorted by Newton's method, followed from the principal
/// point over all corners of pixels when the camera is made, so that no pixel lies beyond a fold of the distortion. The
/// centre of the pixel in column c and row r is at (c, r), as in OpenCV.
///
/// Rotation and translation map a point X of the observer's own space to R X + t in the frame of the camera, which has
/// **x to the right and y down**, and looks along z. Nothing is turned besides, as in Raysect: a camera without rotation
/// is upside down among those whose x is to the left and y up, and a turn of 180° about z sets it upright. A calibration
/// in coordinates of the scene is used as it is.
///
/// ```
/// use raysect_math::rotate_z;
/// use raysect_observer::OpenCvCamera;
/// let matrix = [[800.0, 0.0, 319.5], [0.0, 800.0, 239.5], [0.0, 0.0, 1.0]];
/// let camera = OpenCvCamera::new((64, 48), matrix, &[-0.2, 0.05, 0.0, 0.0, 0.0])?     // k₁ k₂ p₁ p₂ k₃
///     .extrinsics([0.0; 3], [0.0; 3])?
///     .transform(rotate_z(180.0));
/// # Ok::<(), raysect_observer::ObserverError>(())
/// ```
#[doc(alias = "OpenCVCamera")]
pub type OpenCvCamera = Observer<OpenCv>;

/// The sensor of an [`OpenCvCamera`].
#[derive(Debug, Clone, PartialEq)]
pub struct OpenCv {
    columns: usize,
    rows: usize,
    model: OpenCvModel,
    /// Undistorted corners of the pixels, row by row, from which those of a place inside are found.
    corners: Arc<[[f64; 2]]>,
    rotation: [f64; 3],
    translation: [f64; 3],
    to_local: AffineMatrix3D,
    pub(super) etendue: PixelEtendue,
}

etendue_settings!(OpenCv);

impl Observer<OpenCv> {
    /// Of columns × rows of pixels, with a camera matrix [px] and none, 4, 5 or 8 coefficients of distortion in OpenCV's
    /// order k₁, k₂, p₁, p₂, k₃, k₄, k₅, k₆.
    ///
    /// # Errors
    /// [`ObserverError::Math`] for no pixels or 2³² and more and for what is no camera matrix,
    /// [`ObserverError::Distortion`] if a corner of a pixel lies where the picture is folded or cannot be undistorted.
    pub fn new(
        pixels: (usize, usize),
        camera_matrix: [[f64; 3]; 3],
        distortion: &[f64],
    ) -> Result<Self, ObserverError> {
        Ok(Self::with_sensor(OpenCv::of(pixels, camera_matrix, distortion)?))
    }

    /// Placed by a rotation vector (axis times angle [rad], as OpenCV gives it) and a translation [m].
    ///
    /// # Errors
    /// [`ObserverError::Math`] for numbers that are not finite.
    #[doc(alias("r_vector", "t_vector"))]
    pub fn extrinsics(mut self, rotation: [f64; 3], translation: [f64; 3]) -> Result<Self, ObserverError> {
        self.sensor_mut().set_extrinsics(rotation, translation)?;
        Ok(self)
    }
}

/// Steps from the principal point to the first corner, and from a corner to the next.
const STEPS: [usize; 2] = [64, 4];

impl OpenCv {
    fn of(
        (columns, rows): (usize, usize),
        matrix: [[f64; 3]; 3],
        distortion: &[f64],
    ) -> Result<Self, ObserverError> {
        check_pixels(columns, rows)?;
        let model = OpenCvModel::new(matrix, distortion)?;
        Ok(Self {
            columns,
            rows,
            model,
            corners: corners(&model, columns, rows)?,
            rotation: [0.0; 3],
            translation: [0.0; 3],
            to_local: AffineMatrix3D::IDENTITY,
            etendue: PixelEtendue::Unknown,
        })
    }

    fn set_extrinsics(&mut self, rotation: [f64; 3], translation: [f64; 3]) -> Result<(), ObserverError> {
        self.to_local = camera_to_local(rotation, translation)?;
        (self.rotation, self.translation) = (rotation, translation);
        Ok(())
    }

    /// The undistorted place of a point of a pixel, 0 … 1 across and down.
    fn undistort(&self, pixel: usize, [across, down]: [f64; 2]) -> [f64; 2] {
        let (column, row) = (pixel % self.columns, pixel / self.columns);
        let first = row * (self.columns + 1) + column;
        let second = first + self.columns + 1;
        let corner = |index: usize| self.corners[index];
        let mix = |a: [f64; 2], b: [f64; 2], share: f64| [0, 1].map(|i| a[i] + share * (b[i] - a[i]));
        let upper = mix(corner(first), corner(first + 1), across);
        let guess = mix(upper, mix(corner(second), corner(second + 1), across), down);
        let place = [column as f64 - 0.5 + across, row as f64 - 0.5 + down];
        // Between corners that are found the distortion has no fold to speak of.
        self.model.undistort(self.model.plane(place), guess).unwrap_or(guess)
    }
}

/// The undistorted corners of all pixels: along the row and then the columns from the corner nearest to the principal
/// point.
fn corners(model: &OpenCvModel, columns: usize, rows: usize) -> Result<Arc<[[f64; 2]]>, ObserverError> {
    let (width, height) = (columns + 1, rows + 1);
    let nearest = |centre: f64, count: usize| (centre + 0.5).round().clamp(0.0, count as f64 - 1.0) as usize;
    let start = [nearest(model.matrix[0][2], width), nearest(model.matrix[1][2], height)];
    let plane = |[column, row]: [usize; 2]| model.plane([column as f64 - 0.5, row as f64 - 0.5]);
    let failed = |[column, row]: [usize; 2]| ObserverError::Distortion { column, row };
    let mut found = vec![[0.0; 2]; width * height];
    let first = model.follow(([0.0; 2], [0.0; 2]), plane(start), STEPS[0]);
    found[start[1] * width + start[0]] = first.ok_or(failed(start))?;
    let mut step = |from: [usize; 2], to: [usize; 2]| {
        let known = (plane(from), found[from[1] * width + from[0]]);
        found[to[1] * width + to[0]] = model.follow(known, plane(to), STEPS[1]).ok_or(failed(to))?;
        Ok::<(), ObserverError>(())
    };
    for column in start[0] + 1..width {
        step([column - 1, start[1]], [column, start[1]])?;
    }
    for column in (0..start[0]).rev() {
        step([column + 1, start[1]], [column, start[1]])?;
    }
    for column in 0..width {
        for row in start[1] + 1..height {
            step([column, row - 1], [column, row])?;
        }
        for row in (0..start[1]).rev() {
            step([column, row + 1], [column, row])?;
        }
    }
    Ok(found.into())
}

impl Sensor for OpenCv {
    fn shape(&self) -> FrameShape {
        FrameShape::Image { columns: self.columns, rows: self.rows }
    }

    fn sample_ray(&self, pixel: usize, rng: &mut Rng) -> Ray {
        let across = rng.uniform();
        let [x, y] = self.undistort(pixel, [across, rng.uniform()]);
        let direction = self.to_local.transform_vector(Vector3D::new(x, y, 1.0));
        Ray::new(self.to_local.origin(), direction.normalise_unchecked())
    }

    fn pdf(&self, _: usize, _: Point3D, _: Vector3D) -> Option<f64> {
        None
    }

    fn direction_pdf(&self, pixel: usize, _: Point3D, direction: Vector3D) -> Option<f64> {
        let column = |axis: usize| self.to_local.axis(axis).dot(direction);
        let of_camera = Vector3D::new(column(0), column(1), column(2));
        let met = self.model.density(of_camera).map_or(0.0, |([u, v], density)| {
            let (column, row) = ((pixel % self.columns) as f64, (pixel / self.columns) as f64);
            let focal = self.model.matrix[0][0].max(self.model.matrix[1][1]);
            let size = focal + self.columns.max(self.rows) as f64 + u.abs().max(v.abs());
            let slack = 64.0 * f64::EPSILON * size;
            let inside = (u - column).abs() <= 0.5 + slack && (v - row).abs() <= 0.5 + slack;
            if inside { density } else { 0.0 }
        });
        Some(met)
    }

    fn etendue(&self, pixel: usize) -> Option<f64> {
        self.etendue.of(pixel, || f64::NAN)
    }

    fn description(&self) -> String {
        let (kind, shape, etendue) = (self.kind(), self.shape(), self.etendue.describe());
        let (matrix, distortion) = (self.model.matrix, self.model.distortion);
        let (r, t) = (self.rotation, self.translation);
        format!("{kind} of {shape}, {matrix:?}, distortion {distortion:?}, at {r:?} {t:?}, étendue {etendue}")
    }

    fn kind(&self) -> &'static str {
        "OpenCV camera"
    }
}

impl Storable for OpenCv {
    const KIND: &'static str = "OpenCv";

    fn save(&self, saved: Saved, _: &mut SceneWriter) -> Result<Saved, SaveError> {
        let saved = saved
            .count("columns", self.columns as u64)
            .count("rows", self.rows as u64)
            .numbers("camera_matrix", self.model.matrix.as_flattened())
            .numbers("distortion", &self.model.distortion)
            .numbers("rotation_vector", &self.rotation)
            .numbers("translation_vector", &self.translation);
        Ok(self.etendue.save(saved))
    }

    fn load(entry: &Entry<'_>) -> Result<Self, MakeError> {
        let pixels = (entry.integer("columns")?, entry.integer("rows")?);
        let m = entry.array::<9>("camera_matrix")?;
        let matrix = [[m[0], m[1], m[2]], [m[3], m[4], m[5]], [m[6], m[7], m[8]]];
        let mut camera = Self::of(pixels, matrix, &entry.array::<8>("distortion")?)?;
        camera.set_extrinsics(entry.array("rotation_vector")?, entry.array("translation_vector")?)?;
        camera.etendue = PixelEtendue::load(entry, camera.shape().pixels(), false)?;
        Ok(camera)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::PinholeCamera;
    use crate::testing::check_sensor;

    const MATRIX: [[f64; 3]; 3] = [[8.0, 0.0, 2.5], [0.0, 8.0, 1.5], [0.0, 0.0, 1.0]];

    #[test]
    fn without_distortion_it_is_a_pinhole_upside_down() {
        let camera = OpenCvCamera::new((6, 4), MATRIX, &[]).unwrap().etendue(1e-9).unwrap();
        let pinhole = PinholeCamera::new((6, 4), 2.0 * (3.0f64 / 8.0).atan().to_degrees()).unwrap();
        check_sensor(camera.sensor(), 1000, 1).unwrap();
        let (mut a, mut b) = (Rng::new(1), Rng::new(1));
        for pixel in 0..24 {
            for _ in 0..50 {
                let (ray, other) =
                    (camera.sensor().sample_ray(pixel, &mut a), pinhole.sensor().sample_ray(pixel, &mut b));
                let (d, e) = (ray.direction, other.direction);
                assert!((d.x + e.x).abs() + (d.y + e.y).abs() + (d.z - e.z).abs() < 1e-14, "{d:?} {e:?}");
                let (p, q) = (
                    camera.sensor().direction_pdf(pixel, Point3D::ORIGIN, d).unwrap(),
                    pinhole.sensor().direction_pdf(pixel, Point3D::ORIGIN, e).unwrap(),
                );
                assert!((p / q - 1.0).abs() < 1e-12);
            }
        }
    }

    #[test]
    fn every_ray_of_a_distorted_picture_falls_into_its_pixel() {
        let distortion = [-0.3, 0.1, 2e-3, -1e-3, 0.0, 0.01, -0.02, 0.003];
        let camera = OpenCvCamera::new((6, 4), MATRIX, &distortion)
            .unwrap()
            .extrinsics([0.2, -0.4, 0.1], [0.1, 0.2, 0.3])
            .unwrap();
        let (sensor, mut rng) = (camera.sensor(), Rng::new(1));
        check_sensor(sensor, 1000, 1).unwrap();
        for sampled in 0..24 {
            for _ in 0..50 {
                let ray = sensor.sample_ray(sampled, &mut rng);
                assert_eq!(ray.origin, sensor.to_local.origin());
                for pixel in 0..24 {
                    let density = sensor.direction_pdf(pixel, ray.origin, ray.direction).unwrap();
                    assert_eq!(density > 0.0, pixel == sampled, "{pixel} {sampled}");
                }
            }
        }
    }

    #[test]
    fn a_picture_beyond_the_fold_is_refused_by_its_corner() {
        // r (1 − 0.3 r²) reaches 0.703 only.
        let wide = [[4.0, 0.0, 2.5], [0.0, 4.0, 1.5], [0.0, 0.0, 1.0]];
        let refusal = OpenCvCamera::new((6, 4), wide, &[-0.3, 0.0, 0.0, 0.0]).unwrap_err();
        assert!(matches!(refusal, ObserverError::Distortion { .. }), "{refusal}");
        assert!(OpenCvCamera::new((6, 4), wide, &[-0.03, 0.0, 0.0, 0.0]).is_ok());
        // And a principal point outside the picture is no fault.
        let aside = [[50.0, 0.0, -20.0], [0.0, 50.0, 30.0], [0.0, 0.0, 1.0]];
        assert!(OpenCvCamera::new((6, 4), aside, &[-0.03, 0.0, 0.0, 0.0]).is_ok());
        assert!(OpenCvCamera::new((0, 4), aside, &[]).is_err());
    }
}
