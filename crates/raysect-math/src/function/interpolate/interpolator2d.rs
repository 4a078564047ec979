use super::super::contract::{Function, finite};
use super::axis::{Axis, check_values};
use super::grid_axis::GridAxis;
use super::nodes::{Node2, Table, cubic2, nodes2};
use super::{Extrapolation, Interpolation};
use crate::MathError;

/// A surface through values on a grid of x and y.
///
/// A cubic piece has at the corners of its cell the values, the slopes of the parabolas through three knots along
/// x and y (at the edges those of the line to the neighbour), and the mixed derivatives
/// (f₊₊ − f₊₋ − f₋₊ + f₋₋) / (Δx Δy) of the knots on both sides. Surface and slopes are continuous. Polynomials of the
/// second degree come back but for the cells at the edges; if the knots are even, so do their products, such as x² y².
///
/// A cubic table keeps four numbers for each knot: the value and its derivatives.
///
/// Outside the grid there is no value (NaN) unless [`extrapolate`](Self::extrapolate) gives it one.
///
/// ```
/// use raysect_math::function::{Arg, Function, Interpolation, Interpolator2DArray, sample2d};
/// let ([x, y], f) = sample2d(&(Arg::X * Arg::Y), (0.0, 1.0, 5), (0.0, 2.0, 9))?;
/// let f = Interpolator2DArray::new(&x, &y, &f, Interpolation::Cubic)?;
/// assert!((f.evaluate((0.3, 1.1)) - 0.33).abs() < 1e-15);
/// assert!((f.derivative((0.3, 1.1), (1, 0)) - 1.1).abs() < 1e-14);
/// # Ok::<(), raysect_math::MathError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Interpolator2DArray {
    x: GridAxis,
    y: GridAxis,
    table: Table<Node2>,
}

impl Interpolator2DArray {
    /// Through `f[i * y.len() + j]` at `(x[i], y[j])`.
    ///
    /// # Errors
    /// Fewer than two knots along an axis, knots that do not ascend, another number of values than of points, and
    /// numbers that are not finite: [`MathError::TooFewKnots`], [`MathError::KnotsNotAscending`],
    /// [`MathError::TableSize`], [`MathError::TableNotFinite`].
    pub fn new(x: &[f64], y: &[f64], f: &[f64], interpolation: Interpolation) -> Result<Self, MathError> {
        let (x, y) = (GridAxis::new("x", x)?, GridAxis::new("y", y)?);
        check_values(&[x.axis().len(), y.axis().len()], f)?;
        let table = match interpolation {
            Interpolation::Linear => Table::Linear(f.to_vec()),
            Interpolation::Cubic => Table::Cubic(nodes2(f, [x.axis(), y.axis()])),
        };
        Ok(Self { x, y, table })
    }

    /// With values up to a range beyond the first and last knot of each axis [units of x and y], infinity for everywhere.
    ///
    /// # Errors
    /// [`MathError::OutOfRange`] for a negative or NaN range.
    #[doc(alias = "extrapolation_range")]
    pub fn extrapolate(
        mut self,
        extrapolation: Extrapolation,
        range_x: f64,
        range_y: f64,
    ) -> Result<Self, MathError> {
        self.x.extend(extrapolation, range_x)?;
        self.y.extend(extrapolation, range_y)?;
        Ok(self)
    }

    /// The first and last knot of each axis.
    pub fn domain(&self) -> [(f64, f64); 2] {
        [self.x.axis().domain(), self.y.axis().domain()]
    }

    pub(super) fn axes(&self) -> [&Axis; 2] {
        [self.x.axis(), self.y.axis()]
    }

    /// The derivative of the given orders along x and y; 0 and 0 is the value. NaN where there is no value.
    ///
    /// Where pieces meet, that of the piece above counts.
    pub fn derivative(&self, at: (f64, f64), orders: (u32, u32)) -> f64 {
        self.piece(at, orders)
    }

    /// Compiled apart for orders of 0, by which much falls away.
    #[inline(always)]
    fn piece(&self, (x, y): (f64, f64), (order_x, order_y): (u32, u32)) -> f64 {
        let columns = self.y.axis().len();
        match &self.table {
            Table::Linear(values) => {
                let (a, b) = (self.x.linear(x, order_x), self.y.linear(y, order_y));
                let corners = &values[a.first * columns + b.first..][..columns + 2];
                let low = b.along(corners[0], corners[1]);
                a.along(low, b.along(corners[columns], corners[columns + 1]))
            }
            Table::Cubic(nodes) => {
                cubic2(nodes, columns, &self.x.cubic(x, order_x), &self.y.cubic(y, order_y))
            }
        }
    }
}

impl Function<(f64, f64)> for Interpolator2DArray {
    type Value = f64;
    #[inline]
    fn evaluate(&self, at: (f64, f64)) -> f64 {
        self.piece(at, (0, 0))
    }

    fn checked(&self, at: (f64, f64)) -> Result<f64, MathError> {
        self.x.axis().check(at.0)?;
        self.y.axis().check(at.1)?;
        finite(at, self.evaluate(at))
    }
}
