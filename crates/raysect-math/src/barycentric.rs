//! Places in triangles and tetrahedra by the shares of their corners.

use crate::orientation::orientation;
use crate::{MathError, Point2D, Point3D};

/// The shares of the corners of a triangle in a point of its plane: their sum is 1, and a function that is linear
/// between values at the corners has the mean of these, weighted by the shares.
///
/// The point lies in the triangle or on its edge if none is negative; the signs are exact (for coordinates that are 0
/// or of size 1e-140 … 1e140).
///
/// ```
/// use raysect_math::{Point2D, triangle_shares};
/// let corners = [Point2D::new(0.0, 0.0), Point2D::new(4.0, 0.0), Point2D::new(0.0, 2.0)];
/// assert_eq!(triangle_shares(corners, Point2D::new(1.0, 1.0))?, [0.25, 0.25, 0.5]);
/// assert!(triangle_shares(corners, Point2D::new(3.0, 1.0))?.iter().any(|&share| share < 0.0));
/// # Ok::<(), raysect_math::MathError>(())
/// ```
///
/// # Errors
/// [`MathError::OutOfRange`] for corners on one line, or coordinates that are not finite.
#[doc(alias(
    "barycentric_coords",
    "inside_triangle",
    "barycentric_inside_triangle",
    "barycentric_interpolation"
))]
pub fn triangle_shares(corners: [Point2D; 3], point: Point2D) -> Result<[f64; 3], MathError> {
    let [a, b, c] = corners;
    let area = orientation(a, b, c);
    MathError::check(is_some(area), 0.5 * area, "area of the triangle", "m²", "other than 0, finite")?;
    let parts = [orientation(b, c, point), orientation(c, a, point), orientation(a, b, point)];
    finite(parts.map(|part| part / area))
}

/// The shares of the corners of a tetrahedron in a point: their sum is 1, and none is negative if the point lies in it.
///
/// ```
/// use raysect_math::{Point3D, tetrahedron_shares};
/// let at = |x, y, z| Point3D::new(x, y, z);
/// let corners = [at(0.0, 0.0, 0.0), at(4.0, 0.0, 0.0), at(0.0, 2.0, 0.0), at(0.0, 0.0, 1.0)];
/// assert_eq!(tetrahedron_shares(corners, at(1.0, 0.5, 0.25))?, [0.25; 4]);
/// # Ok::<(), raysect_math::MathError>(())
/// ```
///
/// # Errors
/// [`MathError::OutOfRange`] for corners in one plane, or coordinates that are not finite.
#[doc(alias("barycentric_coords_tetra", "inside_tetrahedra", "barycentric_inside_tetrahedra"))]
#[doc(alias = "barycentric_interpolation_tetra")]
pub fn tetrahedron_shares(corners: [Point3D; 4], point: Point3D) -> Result<[f64; 4], MathError> {
    let [a, b, c, d] = corners;
    let volume = six_volumes(a, b, c, d);
    MathError::check(
        is_some(volume),
        volume / 6.0,
        "volume of the tetrahedron",
        "m³",
        "other than 0, finite",
    )?;
    let parts = [
        six_volumes(point, b, c, d),
        six_volumes(a, point, c, d),
        six_volumes(a, b, point, d),
        six_volumes(a, b, c, point),
    ];
    finite(parts.map(|part| part / volume))
}

/// Six times the volume of a tetrahedron, positive if d lies on the side of the face abc that its normal points to.
#[inline]
pub(crate) fn six_volumes(a: Point3D, b: Point3D, c: Point3D, d: Point3D) -> f64 {
    a.vector_to(b).cross(a.vector_to(c)).dot(a.vector_to(d))
}

fn is_some(size: f64) -> bool {
    size != 0.0 && size.is_finite()
}

fn finite<const N: usize>(shares: [f64; N]) -> Result<[f64; N], MathError> {
    for share in shares {
        MathError::check(share.is_finite(), share, "share of a corner", "", "finite")?;
    }
    Ok(shares)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn shares_of_a_triangle_put_the_point_together(p in prop::array::uniform8(-4.0..4.0f64)) {
            let corners = [0, 2, 4].map(|i| Point2D::new(p[i], p[i + 1]));
            let point = Point2D::new(p[6], p[7]);
            prop_assume!(orientation(corners[0], corners[1], corners[2]).abs() > 0.1);
            let shares = triangle_shares(corners, point).unwrap();
            let sum = |f: fn(Point2D) -> f64| (0..3).map(|i| shares[i] * f(corners[i])).sum::<f64>();
            prop_assert!((shares.iter().sum::<f64>() - 1.0).abs() < 1e-11);
            prop_assert!((sum(|c| c.x) - point.x).abs() < 1e-10 && (sum(|c| c.y) - point.y).abs() < 1e-10);
            let inside = crate::Polygon2D::new(corners).unwrap().contains(point);
            prop_assert_eq!(shares.iter().all(|&s| s >= 0.0), inside);
        }

        #[test]
        fn shares_of_a_tetrahedron_put_the_point_together(
            p in prop::array::uniform12(-4.0..4.0f64), q in prop::array::uniform3(-4.0..4.0f64),
        ) {
            let corners = [0, 3, 6, 9].map(|i| Point3D::new(p[i], p[i + 1], p[i + 2]));
            let point = Point3D::from(q);
            let [a, b, c, d] = corners;
            prop_assume!(six_volumes(a, b, c, d).abs() > 0.1);
            let shares = tetrahedron_shares(corners, point).unwrap();
            prop_assert!((shares.iter().sum::<f64>() - 1.0).abs() < 1e-10);
            for axis in 0..3 {
                let sum: f64 = (0..4).map(|i| shares[i] * corners[i][axis]).sum();
                prop_assert!((sum - point[axis]).abs() < 1e-9);
            }
        }

        #[test]
        fn points_on_an_edge_have_no_share_of_the_corner_across(t in 0..=1024i32, k in 0..3usize) {
            // Exact numbers: the share is 0 and not a rounding of it.
            let corners = [Point2D::new(1.0, 1.0), Point2D::new(9.0, 5.0), Point2D::new(-3.0, 11.0)];
            let (from, to) = (corners[(k + 1) % 3], corners[(k + 2) % 3]);
            let point = from + from.vector_to(to) * (f64::from(t) / 1024.0);
            let shares = triangle_shares(corners, point).unwrap();
            prop_assert_eq!(shares[k], 0.0);
            prop_assert!(shares.iter().all(|&s| s >= 0.0));
        }
    }

    #[test]
    fn flat_ones_and_what_is_not_finite_are_refused() {
        let p = |x: f64, y: f64| Point2D::new(x, y);
        let flat = triangle_shares([p(0.0, 0.0), p(1.0, 1.0), p(3.0, 3.0)], p(0.0, 0.0)).unwrap_err();
        assert_eq!(flat.to_string(), "area of the triangle = 0 m² is outside its range other than 0, finite");
        let corners = [p(0.0, 0.0), p(1.0, 0.0), p(0.0, 1.0)];
        assert!(triangle_shares(corners, p(f64::NAN, 0.0)).is_err());
        assert!(triangle_shares([corners[0], corners[1], p(0.0, f64::INFINITY)], corners[0]).is_err());
        let q = |x: f64, y: f64, z: f64| Point3D::new(x, y, z);
        let corners = [q(0.0, 0.0, 0.0), q(1.0, 0.0, 0.0), q(0.0, 1.0, 0.0), q(1.0, 1.0, 0.0)];
        assert!(tetrahedron_shares(corners, corners[0]).is_err());
    }
}
