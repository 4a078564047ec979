use super::super::Value;
use crate::MathError;

/// The knots along one variable, and how far beyond them an interpolator may go.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Axis {
    name: &'static str,
    knots: Vec<f64>,
    range: f64,
}

impl Axis {
    /// At least two ascending, finite knots; without extrapolation.
    pub(super) fn new(name: &'static str, knots: &[f64]) -> Result<Self, MathError> {
        if knots.len() < 2 {
            return Err(MathError::TooFewKnots { axis: name, count: knots.len() });
        }
        check_finite(name, &[knots.len()], knots)?;
        for (i, pair) in knots.windows(2).enumerate() {
            if pair[0] >= pair[1] {
                let (index, previous, value) = (i + 1, pair[0], pair[1]);
                return Err(MathError::KnotsNotAscending { axis: name, index, value, previous });
            }
        }
        Ok(Self { name, knots: knots.to_vec(), range: 0.0 })
    }

    /// Lets places through up to `range` beyond the ends, infinity for any.
    pub(super) fn extend(&mut self, range: f64) -> Result<(), MathError> {
        self.range = MathError::check(range >= 0.0, range, "extrapolation range", "", "0 or more")?;
        Ok(())
    }

    pub(super) fn knots(&self) -> &[f64] {
        &self.knots
    }

    pub(super) fn len(&self) -> usize {
        self.knots.len()
    }

    /// The first and last knot.
    pub(super) fn domain(&self) -> (f64, f64) {
        (self.knots[0], self.knots[self.len() - 1])
    }

    /// True where the interpolator has a value; false for NaN.
    #[inline]
    pub(super) fn admits(&self, x: f64) -> bool {
        let (low, high) = self.domain();
        x >= low - self.range && x <= high + self.range
    }

    /// The error for a coordinate that is not admitted.
    pub(super) fn check(&self, x: f64) -> Result<(), MathError> {
        if self.admits(x) {
            return Ok(());
        }
        let (low, high) = self.domain();
        Err(MathError::OutsideGrid {
            axis: self.name,
            value: x,
            low: low - self.range,
            high: high + self.range,
        })
    }

    /// The cell that holds `x`: its lower knot, of the end cells for places outside. A knot belongs to the cell above
    /// it, the last one to the last cell.
    #[inline]
    pub(super) fn cell(&self, x: f64) -> usize {
        self.knots[1..self.len() - 1].partition_point(|&knot| knot <= x)
    }

    /// Width of a cell.
    #[inline]
    pub(super) fn width(&self, cell: usize) -> f64 {
        self.knots[cell + 1] - self.knots[cell]
    }
}

/// The error that names the first number of a table (in row-major order) that is not finite.
pub(super) fn check_finite(name: &'static str, shape: &[usize], values: &[f64]) -> Result<(), MathError> {
    let Some(first) = values.iter().position(|value| !Value::is_finite(*value)) else { return Ok(()) };
    let mut index = vec![0; shape.len()];
    let mut rest = first;
    for (axis, &count) in shape.iter().enumerate().rev() {
        index[axis] = rest % count;
        rest /= count;
    }
    Err(MathError::TableNotFinite { name, index, value: values[first] })
}

/// One finite value for each point of a grid.
pub(super) fn check_values(shape: &[usize], values: &[f64]) -> Result<(), MathError> {
    if shape.iter().product::<usize>() != values.len() {
        return Err(MathError::TableSize { shape: shape.to_vec(), count: values.len() });
    }
    check_finite("f", shape, values)
}
