use raysect_math::{AffineMatrix3D, MathError, Point3D, Vector3D};

/// The camera model of OpenCV: pinhole, radial and tangential distortion.
///
/// Its camera looks along z, with x to the right and y down; a point (x, y, 1) is seen at the pixel
/// (f_x x″ + s y″ + c_x, f_y y″ + c_y), with
///
/// x″ = x κ + 2 p₁ x y + p₂ (r² + 2 x²), y″ = y κ + p₁ (r² + 2 y²) + 2 p₂ x y,
/// κ = (1 + k₁ r² + k₂ r⁴ + k₃ r⁶) / (1 + k₄ r² + k₅ r⁴ + k₆ r⁶), r² = x² + y²
/// (OpenCV documentation, *Camera Calibration and 3D Reconstruction*, detailed description).
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct OpenCvModel {
    pub(super) matrix: [[f64; 3]; 3],
    /// k₁, k₂, p₁, p₂, k₃, k₄, k₅, k₆.
    pub(super) distortion: [f64; 8],
}

/// A place seen by the camera and how the picture changes there.
#[derive(Debug, Clone, Copy)]
struct Distorted {
    place: [f64; 2],
    /// ∂(x″, y″)/∂(x, y), row by row.
    slope: [[f64; 2]; 2],
}

impl Distorted {
    /// Determinant of the slope: positive where the picture is not folded.
    fn determinant(&self) -> f64 {
        let [[a, b], [c, d]] = self.slope;
        a * d - b * c
    }
}

/// Steps of Newton's method that a place may take.
const STEPS: usize = 12;

impl OpenCvModel {
    /// # Errors
    /// [`MathError::OutOfRange`] for numbers that are not finite, focal lengths that are not positive, or elements that
    /// no camera matrix has.
    pub(super) fn new(matrix: [[f64; 3]; 3], distortion: &[f64]) -> Result<Self, MathError> {
        for (value, name) in
            [(matrix[0][0], "f_x of the camera matrix"), (matrix[1][1], "f_y of the camera matrix")]
        {
            MathError::check(value > 0.0 && value.is_finite(), value, name, "px", "positive and finite")?;
        }
        for value in [matrix[0][1], matrix[0][2], matrix[1][2]] {
            MathError::check(value.is_finite(), value, "element of the camera matrix", "px", "finite")?;
        }
        for (row, column, expected) in [(1, 0, 0.0), (2, 0, 0.0), (2, 1, 0.0), (2, 2, 1.0)] {
            let value = matrix[row][column];
            let admitted = value == expected;
            MathError::check(admitted, value, "lower element of the camera matrix", "", "0, 0 and 0, 0, 1")?;
        }
        let count = distortion.len();
        let admitted = matches!(count, 0 | 4 | 5 | 8);
        MathError::check(admitted, count as f64, "number of distortion coefficients", "", "0, 4, 5 or 8")?;
        let mut all = [0.0; 8];
        all[..count].copy_from_slice(distortion);
        for value in all {
            MathError::check(value.is_finite(), value, "distortion coefficient", "", "finite")?;
        }
        Ok(Self { matrix, distortion: all })
    }

    /// The distorted place of a pixel in a plane at distance 1.
    pub(super) fn plane(&self, [u, v]: [f64; 2]) -> [f64; 2] {
        let y = (v - self.matrix[1][2]) / self.matrix[1][1];
        [(u - self.matrix[0][2] - self.matrix[0][1] * y) / self.matrix[0][0], y]
    }

    fn distort(&self, [x, y]: [f64; 2]) -> Distorted {
        let [k1, k2, p1, p2, k3, k4, k5, k6] = self.distortion;
        let s = x * x + y * y;
        let upper = 1.0 + s * (k1 + s * (k2 + s * k3));
        let lower = 1.0 + s * (k4 + s * (k5 + s * k6));
        let kappa = upper / lower;
        // Derivative by r².
        let growth =
            (k1 + s * (2.0 * k2 + s * 3.0 * k3) - kappa * (k4 + s * (2.0 * k5 + s * 3.0 * k6))) / lower;
        let place = [
            x * kappa + 2.0 * p1 * x * y + p2 * (s + 2.0 * x * x),
            y * kappa + p1 * (s + 2.0 * y * y) + 2.0 * p2 * x * y,
        ];
        let cross = 2.0 * x * y * growth + 2.0 * p1 * x + 2.0 * p2 * y;
        let slope = [
            [kappa + 2.0 * x * x * growth + 2.0 * p1 * y + 6.0 * p2 * x, cross],
            [cross, kappa + 2.0 * y * y * growth + 6.0 * p1 * y + 2.0 * p2 * x],
        ];
        Distorted { place, slope }
    }

    /// The undistorted place whose image is `target`, from a guess on the same side of every fold; none if Newton's
    /// method does not end or ends where the picture is folded.
    pub(super) fn undistort(&self, target: [f64; 2], guess: [f64; 2]) -> Option<[f64; 2]> {
        let mut p = guess;
        for _ in 0..STEPS {
            let image = self.distort(p);
            let determinant = image.determinant();
            if !(determinant > 0.0 && determinant.is_finite()) {
                return None;
            }
            let miss = [image.place[0] - target[0], image.place[1] - target[1]];
            let [[a, b], [c, d]] = image.slope;
            let step = [(d * miss[0] - b * miss[1]) / determinant, (a * miss[1] - c * miss[0]) / determinant];
            p = [p[0] - step[0], p[1] - step[1]];
            // After a step this small the next one, its square, is below rounding.
            if step[0].abs().max(step[1].abs()) <= 1e-9 * (1.0 + p[0].abs().max(p[1].abs())) {
                return Some(p);
            }
        }
        None
    }

    /// The same, followed along a straight line in the picture from a place whose solution is known: a fold on the way is
    /// not jumped over.
    pub(super) fn follow(
        &self,
        from: ([f64; 2], [f64; 2]),
        target: [f64; 2],
        steps: usize,
    ) -> Option<[f64; 2]> {
        let (start, mut p) = from;
        for step in 1..=steps {
            let share = step as f64 / steps as f64;
            let place = [0, 1].map(|axis| start[axis] + share * (target[axis] - start[axis]));
            p = self.undistort(place, p)?;
        }
        Some(p)
    }

    /// Density per solid angle, at a direction of the camera's frame, of directions through a uniform point of a picture
    /// of one square pixel; and the pixel that is met. None behind the camera.
    pub(super) fn density(&self, direction: Vector3D) -> Option<([f64; 2], f64)> {
        let Vector3D { x, y, z } = direction;
        if z <= 0.0 {
            return None;
        }
        let image = self.distort([x / z, y / z]);
        let [u, v] = image.place;
        let [[fx, skew, cx], [_, fy, cy], _] = self.matrix;
        let pixel = [fx * u + skew * v + cx, fy * v + cy];
        let stretch = image.determinant() * fx * fy;
        (stretch > 0.0).then_some((pixel, stretch / (z * z * z)))
    }
}

/// The map from the camera's frame to that in which rotation vector [rad] and translation [m] place it: the inverse of
/// x ↦ R x + t, with R by O. Rodrigues' formula.
pub(super) fn camera_to_local(
    rotation: [f64; 3],
    translation: [f64; 3],
) -> Result<AffineMatrix3D, MathError> {
    for value in rotation.into_iter().chain(translation) {
        MathError::check(value.is_finite(), value, "element of rotation or translation", "", "finite")?;
    }
    let vector = Vector3D::from(rotation);
    let angle = vector.length();
    let (sin, cos) = angle.sin_cos();
    let axis = if angle > 0.0 { vector / angle } else { Vector3D::Z };
    // The inverse turns the other way.
    let turn = |v: Vector3D| v * cos - axis.cross(v) * sin + axis * (axis.dot(v) * (1.0 - cos));
    let back = turn(-Vector3D::from(translation));
    let origin = Point3D::new(back.x, back.y, back.z);
    Ok(AffineMatrix3D::from_axes(turn(Vector3D::X), turn(Vector3D::Y), turn(Vector3D::Z), origin))
}

#[cfg(test)]
mod tests {
    use super::*;

    const MATRIX: [[f64; 3]; 3] = [[800.0, 0.5, 320.0], [0.0, 790.0, 240.0], [0.0, 0.0, 1.0]];
    const STRONG: [f64; 8] = [-0.28, 0.09, 1e-3, -7e-4, -0.01, 0.02, -0.003, 0.001];

    #[test]
    fn the_slope_is_the_derivative() {
        let model = OpenCvModel::new(MATRIX, &STRONG).unwrap();
        for [x, y] in [[0.0, 0.0], [0.3, -0.2], [-0.5, 0.45]] {
            let h = 1e-6;
            let slope = model.distort([x, y]).slope;
            for axis in 0..2 {
                let shift = [if axis == 0 { h } else { 0.0 }, if axis == 1 { h } else { 0.0 }];
                let (plus, minus) = (
                    model.distort([x + shift[0], y + shift[1]]),
                    model.distort([x - shift[0], y - shift[1]]),
                );
                for row in 0..2 {
                    let found = (plus.place[row] - minus.place[row]) / (2.0 * h);
                    assert!((found - slope[row][axis]).abs() < 1e-8, "{found} {slope:?}");
                }
            }
        }
    }

    #[test]
    fn undistorting_undoes_distorting_to_rounding() {
        let model = OpenCvModel::new(MATRIX, &STRONG).unwrap();
        for i in -10..=10 {
            for j in -10..=10 {
                let p = [0.05 * f64::from(i), 0.05 * f64::from(j)];
                let found = model.follow(([0.0; 2], [0.0; 2]), model.distort(p).place, 16).unwrap();
                assert!(
                    (found[0] - p[0]).abs() < 1e-14 && (found[1] - p[1]).abs() < 1e-14,
                    "{p:?} {found:?}"
                );
            }
        }
    }

    #[test]
    fn a_place_beyond_the_fold_is_not_found() {
        // r (1 − 0.3 r²) grows up to r = 1.054, where it is 0.703.
        let model = OpenCvModel::new(MATRIX, &[-0.3, 0.0, 0.0, 0.0]).unwrap();
        let origin = ([0.0; 2], [0.0; 2]);
        assert!(model.follow(origin, [0.70, 0.0], 64).is_some());
        assert!(model.follow(origin, [0.71, 0.0], 64).is_none());
        // Grows again beyond: the far branch is no solution either.
        let model = OpenCvModel::new(MATRIX, &[-0.3, 0.03, 0.0, 0.0]).unwrap();
        assert!(model.distort([4.0, 0.0]).determinant() > 0.0);
        assert!(model.follow(origin, model.distort([4.0, 0.0]).place, 64).is_none());
    }

    #[test]
    fn the_density_is_that_of_uniform_points_of_a_pixel() {
        // Its integral over all directions that meet a pixel is one: by the transform of a fine grid.
        let model = OpenCvModel::new([[2.0, 0.1, 0.2], [0.0, 2.5, -0.1], [0.0, 0.0, 1.0]], &STRONG).unwrap();
        let (n, reach) = (800, 0.8);
        let mut sum = 0.0;
        for i in 0..n {
            for j in 0..n {
                let at = |k: usize| reach * (2.0 * (k as f64 + 0.5) / n as f64 - 1.0);
                let v = Vector3D::new(at(i), at(j), 1.0);
                let cell = (2.0 * reach / n as f64).powi(2) / v.length().powi(3);
                let ([u, w], density) = model.density(v.normalise().unwrap()).unwrap();
                if u.abs() < 0.5 && w.abs() < 0.5 {
                    sum += density * cell;
                }
            }
        }
        assert!((sum - 1.0).abs() < 5e-3, "{sum}");
    }

    #[test]
    fn a_camera_is_placed_by_the_inverse_of_its_extrinsics() {
        let rotation = [0.3, -0.2, 0.9];
        let m = camera_to_local(rotation, [1.0, 2.0, 3.0]).unwrap();
        let seen = m.inverse().unwrap().transform_point(Point3D::ORIGIN);
        assert!((seen.x - 1.0).abs() + (seen.y - 2.0).abs() + (seen.z - 3.0).abs() < 1e-14);
        // The axis of the rotation stays.
        let axis = Vector3D::from(rotation);
        assert!((m.transform_vector(axis) - axis).length() < 1e-15 && (m.determinant() - 1.0).abs() < 1e-14);
        // A quarter about z: x of the object is seen as y of the camera.
        let quarter = camera_to_local([0.0, 0.0, std::f64::consts::FRAC_PI_2], [0.0; 3]).unwrap();
        assert!((quarter.transform_vector(Vector3D::Y) - Vector3D::X).length() < 1e-15);
    }

    #[test]
    fn what_no_camera_matrix_is_is_refused() {
        let good = MATRIX;
        assert!(
            OpenCvModel::new(good, &[0.0; 3]).is_err() && OpenCvModel::new(good, &[f64::NAN; 4]).is_err()
        );
        for (row, column, value) in [(0, 0, 0.0), (1, 1, -1.0), (1, 0, 1.0), (2, 2, 2.0), (0, 2, f64::NAN)] {
            let mut bad = good;
            bad[row][column] = value;
            assert!(OpenCvModel::new(bad, &[]).is_err(), "{row} {column}");
        }
    }
}
