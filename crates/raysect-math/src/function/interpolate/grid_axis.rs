//! Weights of the knots at the ends of a cell, in one variable of several.

use super::Extrapolation;
use super::axis::Axis;
use super::hermite::Hermite;
use crate::MathError;

/// Weights of the two knots of a cell.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Ends {
    /// The first knot.
    pub(super) first: usize,
    /// What the values contribute.
    pub(super) values: [f64; 2],
    /// What the slopes contribute, which are those of a cell of mean width; nothing for linear pieces.
    pub(super) slopes: [f64; 2],
}

impl Ends {
    /// The sum over the values of both.
    #[inline]
    pub(super) fn along(&self, low: f64, high: f64) -> f64 {
        self.values[0] * low + self.values[1] * high
    }
}

/// The knots along one variable of several, and how values go on beyond them.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct GridAxis {
    axis: Axis,
    extrapolation: Extrapolation,
    /// Cells of mean width for a unit of length.
    per_unit: f64,
}

impl GridAxis {
    pub(super) fn new(name: &'static str, knots: &[f64]) -> Result<Self, MathError> {
        let axis = Axis::new(name, knots)?;
        let per_unit = axis.mean_width().recip();
        Ok(Self { axis, extrapolation: Extrapolation::Nearest, per_unit })
    }

    pub(super) fn extend(&mut self, extrapolation: Extrapolation, range: f64) -> Result<(), MathError> {
        self.extrapolation = extrapolation;
        self.axis.extend(range)
    }

    pub(super) fn axis(&self) -> &Axis {
        &self.axis
    }

    /// Where a place lies in which cell.
    #[inline(always)]
    fn locate(&self, x: f64, order: u32) -> Located {
        let (cell, [low, high]) = match self.axis.even_cell(x) {
            Some(found) => found,
            None if self.axis.holds(x) => self.axis.cell(x),
            None => return self.locate_outside(x, order),
        };
        let width = high - low;
        let scale = if order == 0 { 1.0 } else { width.powi(order as i32).recip() };
        Located { cell, width, t: (x - low) / width, scale, beyond: false }
    }

    #[cold]
    fn locate_outside(&self, x: f64, order: u32) -> Located {
        if !self.axis.admits(x) {
            return Located { cell: 0, width: 0.0, t: f64::NAN, scale: f64::NAN, beyond: false };
        }
        let above = x > self.axis.domain().1;
        let cell = if above { self.axis.len() - 2 } else { 0 };
        let [low, high] = self.axis.ends(cell);
        let width = high - low;
        if self.extrapolation == Extrapolation::Nearest {
            let (t, scale) = (if above { 1.0 } else { 0.0 }, if order == 0 { 1.0 } else { 0.0 });
            return Located { cell, width, t, scale, beyond: false };
        }
        let scale = width.powi(order as i32).recip();
        Located { cell, width, t: (x - low) / width, scale, beyond: true }
    }

    /// The weights for the derivative of the given order at `x`, linear; NaN where there is no value.
    #[inline(always)]
    pub(super) fn linear(&self, x: f64, order: u32) -> Ends {
        let Located { cell, t, scale, .. } = self.locate(x, order);
        let values = Hermite::line(t, order).values.map(|weight| weight * scale);
        Ends { first: cell, values, slopes: [0.0; 2] }
    }

    /// The weights for the derivative of the given order at `x`, cubic; NaN where there is no value.
    #[inline(always)]
    pub(super) fn cubic(&self, x: f64, order: u32) -> Ends {
        let Located { cell, width, t, scale, beyond } = self.locate(x, order);
        let basis = if beyond { Hermite::beyond(t, order) } else { Hermite::cubic(t, order) };
        let of_slopes = scale * (width * self.per_unit);
        Ends {
            first: cell,
            values: basis.values.map(|value| value * scale),
            slopes: basis.slopes.map(|slope| slope * of_slopes),
        }
    }
}

/// A place along one variable.
struct Located {
    cell: usize,
    /// Of the cell.
    width: f64,
    /// In units of the cell.
    t: f64,
    /// Of the derivative, for the unit of the cell.
    scale: f64,
    /// True if a cubic piece goes on as a line.
    beyond: bool,
}
