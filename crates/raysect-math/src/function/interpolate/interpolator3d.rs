use super::super::contract::{Function, finite};
use super::axis::{Axis, check_values};
use super::grid_axis::GridAxis;
use super::nodes::{Node3, Table, cubic3, nodes3};
use super::{Extrapolation, Interpolation};
use crate::MathError;

/// A function through values on a grid of x, y and z.
///
/// Cubic pieces are made as in [`Interpolator2DArray`](super::Interpolator2DArray), with mixed derivatives of two and
/// of all three variables. Outside the grid there is no value (NaN) unless [`extrapolate`](Self::extrapolate) gives it
/// one. A cubic table keeps eight numbers for each knot: the value and its derivatives.
///
/// ```
/// use raysect_math::function::{Arg, Extrapolation, Function, Interpolation, Interpolator3DArray, sample3d};
/// let axis = (0.0, 1.0, 5);
/// let ([x, y, z], f) = sample3d(&(Arg::X * Arg::Y - Arg::Z), axis, axis, axis)?;
/// let f = Interpolator3DArray::new(&x, &y, &z, &f, Interpolation::Linear)?;
/// let f = f.extrapolate(Extrapolation::Nearest, 0.0, 0.0, 1.0)?;
/// assert_eq!(f.evaluate((0.5, 0.25, 1.5)), -0.875);
/// # Ok::<(), raysect_math::MathError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Interpolator3DArray {
    x: GridAxis,
    y: GridAxis,
    z: GridAxis,
    table: Table<Node3>,
}

impl Interpolator3DArray {
    /// Through `f[(i * y.len() + j) * z.len() + k]` at `(x[i], y[j], z[k])`.
    ///
    /// # Errors
    /// Fewer than two knots along an axis, knots that do not ascend, another number of values than of points, and
    /// numbers that are not finite: [`MathError::TooFewKnots`], [`MathError::KnotsNotAscending`],
    /// [`MathError::TableSize`], [`MathError::TableNotFinite`].
    pub fn new(
        x: &[f64],
        y: &[f64],
        z: &[f64],
        f: &[f64],
        interpolation: Interpolation,
    ) -> Result<Self, MathError> {
        let x = GridAxis::new("x", x)?;
        let y = GridAxis::new("y", y)?;
        let z = GridAxis::new("z", z)?;
        check_values(&[x.axis().len(), y.axis().len(), z.axis().len()], f)?;
        let table = match interpolation {
            Interpolation::Linear => Table::Linear(f.to_vec()),
            Interpolation::Cubic => Table::Cubic(nodes3(f, [x.axis(), y.axis(), z.axis()])),
        };
        Ok(Self { x, y, z, table })
    }

    /// With values up to a range beyond the first and last knot of each axis [units of x, y and z], infinity for
    /// everywhere.
    ///
    /// # Errors
    /// [`MathError::OutOfRange`] for a negative or NaN range.
    #[doc(alias = "extrapolation_range")]
    pub fn extrapolate(
        mut self,
        extrapolation: Extrapolation,
        range_x: f64,
        range_y: f64,
        range_z: f64,
    ) -> Result<Self, MathError> {
        self.x.extend(extrapolation, range_x)?;
        self.y.extend(extrapolation, range_y)?;
        self.z.extend(extrapolation, range_z)?;
        Ok(self)
    }

    /// The first and last knot of each axis.
    pub fn domain(&self) -> [(f64, f64); 3] {
        [self.x.axis().domain(), self.y.axis().domain(), self.z.axis().domain()]
    }

    pub(super) fn axes(&self) -> [&Axis; 3] {
        [self.x.axis(), self.y.axis(), self.z.axis()]
    }

    /// The derivative of the given orders along x, y and z; 0, 0 and 0 is the value. NaN where there is no value.
    ///
    /// Where pieces meet, that of the piece above counts.
    pub fn derivative(&self, at: (f64, f64, f64), orders: (u32, u32, u32)) -> f64 {
        self.piece(at, orders)
    }

    /// Compiled apart for orders of 0, by which much falls away.
    #[inline(always)]
    fn piece(&self, at: (f64, f64, f64), orders: (u32, u32, u32)) -> f64 {
        let (rows, columns) = (self.y.axis().len(), self.z.axis().len());
        match &self.table {
            Table::Linear(values) => {
                let [a, b, c] = [
                    self.x.linear(at.0, orders.0),
                    self.y.linear(at.1, orders.1),
                    self.z.linear(at.2, orders.2),
                ];
                let start = (a.first * rows + b.first) * columns + c.first;
                let corners = &values[start..][..rows * columns + columns + 2];
                let face = |start: usize| {
                    let low = c.along(corners[start], corners[start + 1]);
                    b.along(low, c.along(corners[start + columns], corners[start + columns + 1]))
                };
                a.along(face(0), face(rows * columns))
            }
            Table::Cubic(nodes) => {
                let [a, b, c] = [
                    self.x.cubic(at.0, orders.0),
                    self.y.cubic(at.1, orders.1),
                    self.z.cubic(at.2, orders.2),
                ];
                cubic3(nodes, [rows, columns], [&a, &b, &c])
            }
        }
    }
}

impl Function<(f64, f64, f64)> for Interpolator3DArray {
    type Value = f64;
    #[inline]
    fn evaluate(&self, at: (f64, f64, f64)) -> f64 {
        self.piece(at, (0, 0, 0))
    }

    fn checked(&self, at: (f64, f64, f64)) -> Result<f64, MathError> {
        self.x.axis().check(at.0)?;
        self.y.axis().check(at.1)?;
        self.z.axis().check(at.2)?;
        finite(at, self.evaluate(at))
    }
}
