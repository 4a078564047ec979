use std::ops::Mul;

use glam::{DAffine3, DMat3, DVec3};

use crate::{MathError, Normal3D, Point3D, Vector3D};

/// An affine map of space: a 3×3 matrix and a translation. `a * b` applies `b` first.
///
/// Read it as the 4×4 matrix with bottom row (0, 0, 0, 1) that multiplies column vectors.
///
/// ```
/// use raysect_math::{Point3D, rotate_y, translate};
/// let m = translate(0.0, 0.0, 5.0) * rotate_y(90.0);
/// let p = m * Point3D::new(0.0, 0.0, 1.0);
/// assert!(p.distance_to(Point3D::new(1.0, 0.0, 5.0)) < 1e-15);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AffineMatrix3D(DAffine3);

impl Default for AffineMatrix3D {
    fn default() -> Self {
        Self::IDENTITY
    }
}

impl AffineMatrix3D {
    /// The map that changes nothing.
    #[doc(alias = "NULL_TRANSFORM")]
    pub const IDENTITY: Self = Self(DAffine3::IDENTITY);

    /// From four rows of a 4×4 matrix.
    ///
    /// # Errors
    /// [`MathError::NotFinite`], or [`MathError::NotAffine`] unless the last row is (0, 0, 0, 1).
    pub fn from_rows(rows: [[f64; 4]; 4]) -> Result<Self, MathError> {
        for (row, values) in rows.iter().enumerate() {
            for (column, &value) in values.iter().enumerate() {
                if !value.is_finite() {
                    return Err(MathError::NotFinite { row, column, value });
                }
            }
        }
        if rows[3] != [0.0, 0.0, 0.0, 1.0] {
            return Err(MathError::NotAffine { row: rows[3] });
        }
        let column = |j: usize| DVec3::new(rows[0][j], rows[1][j], rows[2][j]);
        Ok(Self(DAffine3 {
            matrix3: DMat3::from_cols(column(0), column(1), column(2)),
            translation: column(3),
        }))
    }

    /// From the sixteen numbers of a 4×4 matrix, row by row.
    ///
    /// # Errors
    /// As [`from_rows`](Self::from_rows).
    pub fn from_row_major(m: [f64; 16]) -> Result<Self, MathError> {
        let row = |i: usize| [m[4 * i], m[4 * i + 1], m[4 * i + 2], m[4 * i + 3]];
        Self::from_rows([row(0), row(1), row(2), row(3)])
    }

    /// From the images of the three axes and of the origin.
    #[inline]
    pub fn from_axes(x: Vector3D, y: Vector3D, z: Vector3D, origin: Point3D) -> Self {
        Self(DAffine3 { matrix3: DMat3::from_cols(x.into(), y.into(), z.into()), translation: origin.into() })
    }

    /// The four rows of the 4×4 matrix.
    pub fn to_rows(self) -> [[f64; 4]; 4] {
        let row = |i: usize| [self.get(i, 0), self.get(i, 1), self.get(i, 2), self.get(i, 3)];
        [row(0), row(1), row(2), [0.0, 0.0, 0.0, 1.0]]
    }

    /// The element in `row` 0 … 3 and `column` 0 … 3.
    ///
    /// # Panics
    /// For an index beyond 3, like the indexing of an array.
    pub fn get(&self, row: usize, column: usize) -> f64 {
        assert!(row < 4 && column < 4, "element [{row}, {column}] of a 4×4 matrix");
        match (row, column) {
            (3, 3) => 1.0,
            (3, _) => 0.0,
            (_, 3) => self.0.translation[row],
            _ => self.0.matrix3.col(column)[row],
        }
    }

    /// The image of the axis 0 (x), 1 (y) or 2 (z).
    #[inline]
    pub fn axis(&self, axis: usize) -> Vector3D {
        self.0.matrix3.col(axis).into()
    }

    /// The image of the origin.
    #[inline]
    pub fn origin(&self) -> Point3D {
        self.0.translation.into()
    }

    /// The map in glam's form.
    #[inline]
    pub fn to_glam(self) -> DAffine3 {
        self.0
    }

    /// Moves a point.
    #[inline]
    pub fn transform_point(&self, p: Point3D) -> Point3D {
        self.0.transform_point3(p.into()).into()
    }

    /// Turns and stretches a vector; translation does not act.
    #[inline]
    pub fn transform_vector(&self, v: Vector3D) -> Vector3D {
        self.0.transform_vector3(v.into()).into()
    }

    /// Transforms a surface normal by the inverse transpose. The result is not renormalised.
    ///
    /// # Errors
    /// [`MathError::Singular`] if the map has no inverse.
    pub fn transform_normal(&self, n: Normal3D) -> Result<Normal3D, MathError> {
        Ok(self.inverse()?.transform_normal_with_inverse(n))
    }

    /// Called on the inverse of a map: the normal transformed by the map itself, not renormalised.
    #[doc(alias = "transform_with_inverse")]
    #[inline]
    pub fn transform_normal_with_inverse(&self, n: Normal3D) -> Normal3D {
        let n: DVec3 = n.into();
        let m = &self.0.matrix3;
        Normal3D::new(m.x_axis.dot(n), m.y_axis.dot(n), m.z_axis.dot(n))
    }

    /// Determinant of the 3×3 part: the factor by which volumes grow, negative for a mirror image.
    #[inline]
    pub fn determinant(&self) -> f64 {
        self.0.matrix3.determinant()
    }

    /// True if every element is finite.
    #[inline]
    pub fn is_finite(&self) -> bool {
        self.0.is_finite()
    }

    /// The inverse map, for scales from 1e-150 to 1e150, mixed ones too.
    ///
    /// Gauss-Jordan elimination with full pivoting after equilibration of rows and columns by powers of two,
    /// so that singularity is judged by condition and not by the size of a determinant
    /// (N. Higham, *Accuracy and Stability of Numerical Algorithms*, 2nd ed., § 9.8 and § 14.4).
    ///
    /// # Errors
    /// [`MathError::Singular`] if the axes do not span space to within rounding.
    pub fn inverse(&self) -> Result<Self, MathError> {
        if !self.is_finite() {
            return Err(MathError::Singular);
        }
        let mut a = [[0.0; 3]; 3];
        for (row, values) in a.iter_mut().enumerate() {
            for (column, value) in values.iter_mut().enumerate() {
                *value = self.get(row, column);
            }
        }
        let inverse = invert3(a).ok_or(MathError::Singular)?;
        let column = |j: usize| DVec3::new(inverse[0][j], inverse[1][j], inverse[2][j]);
        let matrix3 = DMat3::from_cols(column(0), column(1), column(2));
        let translation = -(matrix3 * self.0.translation);
        let result = DAffine3 { matrix3, translation };
        if result.is_finite() { Ok(Self(result)) } else { Err(MathError::Singular) }
    }

    /// True if no element differs from the identity by `tolerance` or more (Raysect's default 1e-8).
    pub fn is_identity(&self, tolerance: f64) -> bool {
        self.is_close(&Self::IDENTITY, tolerance)
    }

    /// True if no element differs from `other` by `tolerance` or more.
    pub fn is_close(&self, other: &Self, tolerance: f64) -> bool {
        self.0.to_cols_array().iter().zip(other.0.to_cols_array()).all(|(a, b)| (a - b).abs() < tolerance)
    }

    /// The common factor by which the map stretches every length, if it is one: a similarity (rotation,
    /// mirror image, translation and one scale) to within `64 ε`.
    pub fn similarity_scale(&self) -> Option<f64> {
        let [x, y, z] = [self.axis(0), self.axis(1), self.axis(2)];
        let scale = x.length();
        let tolerance = 64.0 * f64::EPSILON;
        let equal = |v: Vector3D| (v.length() / scale - 1.0).abs() <= tolerance;
        let upright = |a: Vector3D, b: Vector3D| (a.dot(b) / scale / scale).abs() <= tolerance;
        (scale > 0.0 && equal(y) && equal(z) && upright(x, y) && upright(y, z) && upright(z, x))
            .then_some(scale)
    }
}

/// The exponent `e` of the power of two nearest below `x`, for positive normal `x`.
fn exponent(x: f64) -> i32 {
    if x > 0.0 && x.is_finite() { x.log2().floor() as i32 } else { 0 }
}

fn scale2(x: f64, e: i32) -> f64 {
    // Two factors reach the whole range of exponents without overflow of the factor itself.
    x * 2f64.powi(e / 2) * 2f64.powi(e - e / 2)
}

fn invert3(mut a: [[f64; 3]; 3]) -> Option<[[f64; 3]; 3]> {
    let largest = |values: [f64; 3]| values.into_iter().fold(0.0, |m: f64, v| m.max(v.abs()));
    let mut row_shift = [0; 3];
    for i in 0..3 {
        row_shift[i] = -exponent(largest(a[i]));
        a[i] = a[i].map(|v| scale2(v, row_shift[i]));
    }
    let mut column_shift = [0; 3];
    for j in 0..3 {
        column_shift[j] = -exponent(largest([a[0][j], a[1][j], a[2][j]]));
        for row in &mut a {
            row[j] = scale2(row[j], column_shift[j]);
        }
    }
    let mut b = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let (mut rows_left, mut pivot_column) = (vec![0, 1, 2], [0; 3]);
    while !rows_left.is_empty() {
        let used: Vec<usize> = (0..3).filter(|r| !rows_left.contains(r)).map(|r| pivot_column[r]).collect();
        let candidates = rows_left.iter().flat_map(|&r| (0..3).map(move |c| (r, c)));
        let (row, column) = candidates
            .filter(|(_, c)| !used.contains(c))
            .max_by(|p, q| a[p.0][p.1].abs().total_cmp(&a[q.0][q.1].abs()))?;
        let pivot = a[row][column];
        // After equilibration a pivot at rounding level means linear dependence.
        if pivot.abs() <= 8.0 * f64::EPSILON {
            return None;
        }
        a[row] = a[row].map(|v| v / pivot);
        b[row] = b[row].map(|v| v / pivot);
        for other in (0..3).filter(|&r| r != row) {
            let factor = a[other][column];
            for j in 0..3 {
                a[other][j] -= factor * a[row][j];
                b[other][j] -= factor * b[row][j];
            }
        }
        pivot_column[row] = column;
        rows_left.retain(|&r| r != row);
    }
    let mut inverse = [[0.0; 3]; 3];
    for row in 0..3 {
        let target = pivot_column[row];
        for j in 0..3 {
            inverse[target][j] = scale2(b[row][j], row_shift[j] + column_shift[target]);
        }
    }
    Some(inverse)
}

impl Mul for AffineMatrix3D {
    type Output = Self;
    #[inline]
    fn mul(self, other: Self) -> Self {
        Self(self.0 * other.0)
    }
}

impl Mul<Point3D> for AffineMatrix3D {
    type Output = Point3D;
    #[inline]
    fn mul(self, p: Point3D) -> Point3D {
        self.transform_point(p)
    }
}

impl Mul<Vector3D> for AffineMatrix3D {
    type Output = Vector3D;
    #[inline]
    fn mul(self, v: Vector3D) -> Vector3D {
        self.transform_vector(v)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{rotate, rotate_vector, translate};
    use proptest::prelude::*;

    fn scale(x: f64, y: f64, z: f64) -> AffineMatrix3D {
        AffineMatrix3D::from_axes(Vector3D::X * x, Vector3D::Y * y, Vector3D::Z * z, Point3D::ORIGIN)
    }

    fn assert_inverse(m: AffineMatrix3D) {
        let product = m.inverse().unwrap() * m;
        assert!(product.is_close(&AffineMatrix3D::IDENTITY, 1e-14), "{product:?}");
    }

    #[test]
    fn inverts_scales_over_three_hundred_decades() {
        let r = rotate(31.0, -64.0, 12.0);
        for exponent in (-150..=150).step_by(10) {
            let s = 10f64.powi(exponent);
            assert_inverse(r * scale(s, s, s));
        }
        assert_inverse(scale(1e-100, 1.0, 1e90) * translate(1.0, 2.0, 3.0));
    }

    #[test]
    fn refuses_a_plane_of_axes() {
        let flat = AffineMatrix3D::from_axes(
            Vector3D::new(1.0, 2.0, 3.0),
            Vector3D::new(-4.0, 1.0, 0.5),
            Vector3D::new(-3.0, 3.0, 3.5),
            Point3D::ORIGIN,
        );
        assert_eq!(flat.inverse(), Err(MathError::Singular));
        assert_eq!(scale(1.0, 0.0, 1.0).inverse(), Err(MathError::Singular));
        assert_eq!(scale(f64::NAN, 1.0, 1.0).inverse(), Err(MathError::Singular));
    }

    #[test]
    fn names_the_element_that_is_wrong() {
        let mut rows = AffineMatrix3D::IDENTITY.to_rows();
        rows[1][2] = f64::NAN;
        assert!(matches!(
            AffineMatrix3D::from_rows(rows),
            Err(MathError::NotFinite { row: 1, column: 2, .. })
        ));
        let mut rows = AffineMatrix3D::IDENTITY.to_rows();
        rows[3][0] = 1.0;
        assert!(matches!(AffineMatrix3D::from_rows(rows), Err(MathError::NotAffine { .. })));
    }

    #[test]
    fn normals_stay_upright_under_shear() {
        let shear = AffineMatrix3D::from_axes(
            Vector3D::X,
            Vector3D::new(0.7, 1.0, 0.0),
            Vector3D::new(0.0, 0.3, 2.0),
            Point3D::ORIGIN,
        );
        let n = shear.transform_normal(Normal3D::new(0.0, 0.0, 1.0)).unwrap();
        assert!(n.dot(shear * Vector3D::X).abs() < 1e-15 && n.dot(shear * Vector3D::Y).abs() < 1e-15);
    }

    #[test]
    fn ten_thousand_rotations_do_not_drift() {
        let step = rotate_vector(0.1, Vector3D::new(1.0, 2.0, -0.5)).unwrap();
        let turned = (0..10_800).fold(AffineMatrix3D::IDENTITY, |m, _| m * step);
        assert!(turned.is_identity(1e-11), "{turned:?}");
        assert_eq!(step.similarity_scale().map(|s| (s - 1.0).abs() < 1e-15), Some(true));
        assert_eq!(scale(1.0, 2.0, 1.0).similarity_scale(), None);
    }

    proptest! {
        #[test]
        fn inverse_undoes_general_maps(e in prop::array::uniform9(-1.0..1.0f64), t in prop::array::uniform3(-1e3..1e3f64)) {
            let axes = |i: usize| Vector3D::new(e[i], e[i + 1], e[i + 2]);
            let m = AffineMatrix3D::from_axes(axes(0), axes(3), axes(6), Point3D::from(t));
            prop_assume!(m.determinant().abs() > 1e-2);
            let inverse = m.inverse().unwrap();
            let p = Point3D::new(0.3, -4.0, 2.5);
            prop_assert!((inverse * (m * p)).distance_to(p) < 1e-9);
        }
    }
}
