use super::{Function, Place};
use crate::{MathError, Point3D, Vector3D};

/// One axis of a grid: the lowest place, the highest place, the number of places.
pub type GridAxis = (f64, f64, usize);

/// The places along each of the axes of a grid, and the values in row-major order.
pub type GridSamples<const AXES: usize, V> = ([Vec<f64>; AXES], Vec<V>);

/// Places on a closed range, equally far apart, and the values there.
///
/// One place alone is the lowest.
///
/// ```
/// let (x, f) = raysect_math::function::sample1d(&f64::sqrt, (0.0, 4.0, 3)).unwrap();
/// assert_eq!((x, f), (vec![0.0, 2.0, 4.0], vec![0.0, f64::sqrt(2.0), 2.0]));
/// ```
///
/// # Errors
/// [`MathError::OutOfRange`] for no places, for a range that descends or is not finite.
pub fn sample1d<F: Function<f64> + ?Sized>(
    function: &F,
    x: GridAxis,
) -> Result<(Vec<f64>, Vec<F::Value>), MathError> {
    let x = places(x)?;
    let values = sample_points(function, &x);
    Ok((x, values))
}

/// The places along both axes of a grid, and the values: that of `(x[i], y[j])` is `f[i * y.len() + j]`.
///
/// # Errors
/// [`MathError::OutOfRange`] for no places, for a range that descends or is not finite.
pub fn sample2d<F: Function<(f64, f64)> + ?Sized>(
    function: &F,
    x: GridAxis,
    y: GridAxis,
) -> Result<GridSamples<2, F::Value>, MathError> {
    let (x, y) = (places(x)?, places(y)?);
    let mut values = Vec::with_capacity(x.len() * y.len());
    for &a in &x {
        values.extend(y.iter().map(|&b| function.evaluate((a, b))));
    }
    Ok(([x, y], values))
}

/// The places along the axes of a grid, and the values: that of `(x[i], y[j], z[k])` is
/// `f[(i * y.len() + j) * z.len() + k]`.
///
/// # Errors
/// [`MathError::OutOfRange`] for no places, for a range that descends or is not finite.
pub fn sample3d<F: Function<(f64, f64, f64)> + ?Sized>(
    function: &F,
    x: GridAxis,
    y: GridAxis,
    z: GridAxis,
) -> Result<GridSamples<3, F::Value>, MathError> {
    let (x, y, z) = (places(x)?, places(y)?, places(z)?);
    let mut values = Vec::with_capacity(x.len() * y.len() * z.len());
    for &a in &x {
        for &b in &y {
            values.extend(z.iter().map(|&c| function.evaluate((a, b, c))));
        }
    }
    Ok(([x, y, z], values))
}

/// The values at given places.
#[doc(alias = "sample1d_points")]
pub fn sample_points<P: Place, F: Function<P> + ?Sized>(function: &F, at: &[P]) -> Vec<F::Value> {
    at.iter().map(|&place| function.evaluate(place)).collect()
}

/// Distances along a path of straight pieces [m], equally far apart from its beginning to its end, and the values
/// there. Two corners make a line.
///
/// ```
/// use raysect_math::{Point3D, function::{Arg, sample_path}};
/// let corners = [(0.0, 0.0), (3.0, 0.0), (3.0, 1.0)].map(|(x, y)| Point3D::new(x, y, 0.0));
/// let (distance, f) = sample_path(&(Arg::X + 10.0 * Arg::Y), &corners, 5).unwrap();
/// assert_eq!((distance, f), (vec![0.0, 1.0, 2.0, 3.0, 4.0], vec![0.0, 1.0, 2.0, 3.0, 13.0]));
/// ```
///
/// # Errors
/// [`MathError::OutOfRange`] for fewer than two corners, no places or a length that is not finite.
pub fn sample_path<F: Function<(f64, f64, f64)> + ?Sized>(
    function: &F,
    corners: &[Point3D],
    count: usize,
) -> Result<(Vec<f64>, Vec<F::Value>), MathError> {
    MathError::check(corners.len() >= 2, corners.len() as f64, "number of corners", "", "2 or more")?;
    let pieces: Vec<Vector3D> = corners.windows(2).map(|pair| pair[0].vector_to(pair[1])).collect();
    let mut ends = vec![0.0];
    for piece in &pieces {
        ends.push(ends[ends.len() - 1] + piece.length());
    }
    let distances = places((0.0, ends[pieces.len()], count))?;
    let values = distances.iter().map(|&distance| {
        let i = ends[1..pieces.len()].partition_point(|&end| end <= distance);
        let length = ends[i + 1] - ends[i];
        let t = if length > 0.0 { (distance - ends[i]) / length } else { 0.0 };
        let at = corners[i] + pieces[i] * t;
        function.evaluate((at.x, at.y, at.z))
    });
    let values = values.collect();
    Ok((distances, values))
}

/// `count` places from `low` to `high`, both included.
fn places((low, high, count): GridAxis) -> Result<Vec<f64>, MathError> {
    MathError::check(count >= 1, count as f64, "number of places", "", "1 or more")?;
    MathError::check(low.is_finite(), low, "lower end", "", "finite")?;
    MathError::check(
        high.is_finite() && high >= low,
        high,
        "upper end",
        "",
        "the lower end or more, finite",
    )?;
    if count == 1 {
        return Ok(vec![low]);
    }
    let last = (count - 1) as f64;
    let place = |i: usize| low * (1.0 - i as f64 / last) + high * (i as f64 / last);
    Ok((0..count).map(place).collect())
}

#[cfg(test)]
mod tests {
    use super::super::Arg;
    use super::*;

    #[test]
    fn grids_are_in_row_major_order_with_both_ends() {
        let ([x, y], f) = sample2d(&(10.0 * Arg::X + Arg::Y), (1.0, 2.0, 2), (0.0, 0.3, 3)).unwrap();
        assert_eq!((x, y), (vec![1.0, 2.0], vec![0.0, 0.15, 0.3]));
        assert_eq!(f, [10.0, 10.15, 10.3, 20.0, 20.15, 20.3]);
        let sum = 100.0 * Arg::X + 10.0 * Arg::Y + Arg::Z;
        let ([x, y, z], f) = sample3d(&sum, (1.0, 2.0, 2), (3.0, 5.0, 3), (6.0, 7.0, 2)).unwrap();
        assert_eq!((x.len(), y.len(), z.len(), f.len()), (2, 3, 2, 12));
        assert_eq!((f[0], f[1], f[2], f[(3 + 2) * 2 + 1]), (136.0, 137.0, 146.0, 257.0));
    }

    #[test]
    fn the_ends_are_exact_and_one_place_is_the_lowest() {
        let (x, _) = sample1d(&1.0, (0.1, 0.7, 12)).unwrap();
        assert_eq!((x[0], x[11]), (0.1, 0.7));
        assert_eq!(sample1d(&1.0, (0.1, 0.7, 1)).unwrap().0, [0.1]);
    }

    #[test]
    fn what_is_no_grid_is_refused() {
        for axis in [(0.0, 1.0, 0), (1.0, 0.0, 3), (f64::NAN, 1.0, 3), (0.0, f64::INFINITY, 3)] {
            assert!(sample1d(&1.0, axis).is_err(), "{axis:?}");
        }
        assert!(sample_path(&1.0, &[Point3D::ORIGIN], 3).is_err());
    }

    #[test]
    fn a_path_may_stand_still_and_ends_at_its_last_corner() {
        let at = |x: f64| Point3D::new(x, 0.0, 0.0);
        let (s, f) = sample_path(&Arg::X, &[at(1.0), at(1.0), at(4.0), at(4.0)], 4).unwrap();
        assert_eq!((s, f), (vec![0.0, 1.0, 2.0, 3.0], vec![1.0, 2.0, 3.0, 4.0]));
        assert_eq!(sample_path(&Arg::X, &[at(2.0), at(2.0)], 2).unwrap().1, [2.0, 2.0]);
    }
}
