use super::super::contract::{Function, finite};
use super::axis::{Axis, check_values};
use super::hermite::Hermite;
use super::{Extrapolation1D, Interpolation1D, slopes};
use crate::MathError;

/// A curve through values at knots on a line.
///
/// Outside the knots it has no value (NaN) unless [`extrapolate`](Self::extrapolate) gives it one.
///
/// ```
/// use raysect_math::function::{Extrapolation1D, Function, Interpolation1D, Interpolator1DArray};
/// let f = Interpolator1DArray::new(&[0.0, 1.0, 3.0], &[0.0, 1.0, 0.0], Interpolation1D::Linear)?;
/// assert_eq!((f.evaluate(2.0), f.derivative(2.0, 1)), (0.5, -0.5));
/// assert_eq!(f.checked(4.0).unwrap_err().to_string(), "x = 4 is outside the range 0 … 3 of the interpolator");
/// let f = f.extrapolate(Extrapolation1D::Nearest, 2.0)?;
/// assert_eq!((f.evaluate(5.0), f.evaluate(5.5).is_nan()), (0.0, true));
/// # Ok::<(), raysect_math::MathError>(())
/// ```
#[doc(alias("interpolate", "find_index"))]
#[derive(Debug, Clone, PartialEq)]
pub struct Interpolator1DArray {
    axis: Axis,
    values: Vec<f64>,
    /// At the knots; empty for straight lines.
    slopes: Vec<f64>,
    extrapolation: Extrapolation1D,
}

impl Interpolator1DArray {
    /// Through the values `f` at the knots `x`.
    ///
    /// # Errors
    /// Fewer than two knots, knots that do not ascend, another number of values than of knots, and numbers that are not
    /// finite: [`MathError::TooFewKnots`], [`MathError::KnotsNotAscending`], [`MathError::TableSize`],
    /// [`MathError::TableNotFinite`].
    pub fn new(x: &[f64], f: &[f64], interpolation: Interpolation1D) -> Result<Self, MathError> {
        let axis = Axis::new("x", x)?;
        check_values(&[x.len()], f)?;
        let slopes = match interpolation {
            Interpolation1D::Linear => Vec::new(),
            Interpolation1D::Cubic => slopes::parabolic(x, f),
            Interpolation1D::Monotone => slopes::monotone(x, f),
        };
        Ok(Self { axis, values: f.to_vec(), slopes, extrapolation: Extrapolation1D::Nearest })
    }

    /// With values up to `range` beyond the first and last knot [unit of x], infinity for everywhere.
    ///
    /// # Errors
    /// [`MathError::OutOfRange`] for a negative or NaN range.
    #[doc(alias = "extrapolation_range")]
    pub fn extrapolate(mut self, extrapolation: Extrapolation1D, range: f64) -> Result<Self, MathError> {
        self.axis.extend(range)?;
        self.extrapolation = extrapolation;
        Ok(self)
    }

    pub(super) fn axis(&self) -> &Axis {
        &self.axis
    }

    /// The first and last knot.
    pub fn domain(&self) -> (f64, f64) {
        self.axis.domain()
    }

    /// The derivative of the given order; 0 is the value. NaN where there is no value.
    ///
    /// Where pieces meet, that of the piece above counts. The end knots belong to the curve, not to what lies beyond.
    #[inline]
    pub fn derivative(&self, x: f64, order: u32) -> f64 {
        if !self.axis.holds(x) {
            return self.outside(x, order);
        }
        let (cell, [low, high]) = self.axis.cell(x);
        let width = high - low;
        let t = (x - low) / width;
        let value = |weights: [f64; 2]| weights[0] * self.values[cell] + weights[1] * self.values[cell + 1];
        let normalised = if self.slopes.is_empty() {
            value(Hermite::line(t, order).values)
        } else {
            let basis = Hermite::cubic(t, order);
            let [a, b] = basis.slopes;
            value(basis.values) + width * (a * self.slopes[cell] + b * self.slopes[cell + 1])
        };
        normalised / width.powi(order as i32)
    }

    /// The integral from `low` to `high` [unit of f times unit of x], exact but for rounding: every piece is a polynomial
    /// of at most third degree, for which Simpson's rule holds. Negative the other way round, NaN if there is no value
    /// somewhere between.
    ///
    /// ```
    /// use raysect_math::function::{Interpolation1D, Interpolator1DArray};
    /// let f = Interpolator1DArray::new(&[0.0, 1.0, 3.0], &[0.0, 1.0, 0.0], Interpolation1D::Linear)?;
    /// assert_eq!((f.integral(0.0, 3.0), f.integral(2.0, 1.0), f.average(1.0, 3.0)), (1.5, -0.75, 0.5));
    /// # Ok::<(), raysect_math::MathError>(())
    /// ```
    #[doc(alias = "integrate")]
    pub fn integral(&self, low: f64, high: f64) -> f64 {
        if high < low {
            return -self.integral(high, low);
        }
        let knots = self.axis.knots();
        let first = knots.partition_point(|&knot| knot <= low);
        let inner = knots[first..].iter().copied().take_while(|&knot| knot < high);
        let (mut from, mut sum) = (low, 0.0);
        for to in inner.chain([high]) {
            let middle = from + 0.5 * (to - from);
            let values = self.evaluate(from) + 4.0 * self.evaluate(middle) + self.evaluate(to);
            sum += (to - from) / 6.0 * values;
            from = to;
        }
        sum
    }

    /// The average between two places, in either order [unit of f]; the value itself where they are equal. NaN if
    /// there is no value somewhere between.
    pub fn average(&self, low: f64, high: f64) -> f64 {
        if low == high { self.evaluate(low) } else { self.integral(low, high) / (high - low) }
    }

    #[cold]
    fn outside(&self, x: f64, order: u32) -> f64 {
        let ((low, high), last) = (self.domain(), self.values.len() - 1);
        if !self.axis.admits(x) {
            f64::NAN
        } else if x < low {
            self.beyond(x - low, 0, 0, order)
        } else {
            self.beyond(x - high, last, last - 1, order)
        }
    }

    /// The derivative at `distance` (with its sign) from the end knot `end`, next to which lies the end cell `cell`.
    fn beyond(&self, distance: f64, end: usize, cell: usize, order: u32) -> f64 {
        let width = self.axis.width(cell);
        let secant = (self.values[cell + 1] - self.values[cell]) / width;
        let (slope, bend) = match self.extrapolation {
            Extrapolation1D::Nearest => return if order == 0 { self.values[end] } else { 0.0 },
            Extrapolation1D::Quadratic if !self.slopes.is_empty() => {
                (self.slopes[end], self.slopes[cell + 1] - self.slopes[cell])
            }
            Extrapolation1D::Linear | Extrapolation1D::Quadratic => (secant, 0.0),
        };
        match order {
            0 => self.values[end] + distance * (slope + 0.5 * (distance / width) * bend),
            1 => slope + distance / width * bend,
            2 => bend / width,
            _ => 0.0,
        }
    }
}

impl Function<f64> for Interpolator1DArray {
    type Value = f64;
    #[inline]
    fn evaluate(&self, x: f64) -> f64 {
        self.derivative(x, 0)
    }

    fn checked(&self, x: f64) -> Result<f64, MathError> {
        self.axis.check(x)?;
        finite(x, self.evaluate(x))
    }
}
