//! Weights of the knots next to a place, in one variable of several.

use super::axis::Axis;
use super::hermite::Hermite;
use super::{Extrapolation, Interpolation};
use crate::MathError;

/// Weights of up to four neighbouring knots along one variable.
///
/// A cubic piece in several variables is put together from values, slopes and mixed derivatives at the corners of its
/// cell. Slopes are those of parabolas, as in one variable, but mixed derivatives are made of differences over both
/// neighbours, as Raysect makes them; where the knots are even these are the same.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Stencil {
    /// The first knot.
    pub(super) first: usize,
    /// The number of knots.
    pub(super) count: usize,
    /// What the values contribute.
    pub(super) values: [f64; 4],
    /// What the slopes contribute.
    pub(super) slopes: [f64; 4],
    /// What the factor of this variable in a mixed derivative contributes.
    pub(super) mixed: [f64; 4],
}

impl Stencil {
    /// The three sums over a row of values along this variable that begins with the first knot.
    #[inline]
    pub(super) fn sums(&self, row: &[f64]) -> [f64; 3] {
        let mut sums = [0.0; 3];
        for (k, value) in row[..self.count].iter().enumerate() {
            sums[0] += self.values[k] * value;
            sums[1] += self.slopes[k] * value;
            sums[2] += self.mixed[k] * value;
        }
        sums
    }
}

/// Weights of the four knots of a cell's stencil for the slopes at both ends of the cell, in units of the cell.
#[derive(Debug, Clone, Copy, PartialEq)]
struct CellSlopes {
    first: usize,
    parabolic: [[f64; 4]; 2],
    central: [[f64; 4]; 2],
}

impl CellSlopes {
    fn new(axis: &Axis, cell: usize) -> Self {
        let last = axis.len() - 1;
        let first = cell.saturating_sub(1).min(axis.len().saturating_sub(4));
        let mut slopes = Self { first, parabolic: [[0.0; 4]; 2], central: [[0.0; 4]; 2] };
        for side in 0..2 {
            let knot = cell + side;
            let (parabolic, central) = (&mut slopes.parabolic[side], &mut slopes.central[side]);
            if knot == 0 || knot == last {
                for weights in [parabolic, central] {
                    weights[cell - first] = -1.0;
                    weights[cell + 1 - first] = 1.0;
                }
                continue;
            }
            let (left, right) = (axis.width(knot - 1), axis.width(knot));
            let (unit, at) = (axis.width(cell), knot - first);
            // The mean of the secants on both sides, each weighted by the width of the other.
            let (before, after) =
                (unit * right / (left * (left + right)), unit * left / (right * (left + right)));
            (parabolic[at - 1], parabolic[at], parabolic[at + 1]) = (-before, before - after, after);
            (central[at - 1], central[at + 1]) = (-unit / (left + right), unit / (left + right));
        }
        slopes
    }
}

/// The knots along one variable with what is needed for stencils.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct StencilAxis {
    axis: Axis,
    /// One for each cell; empty for linear interpolation.
    cells: Vec<CellSlopes>,
    extrapolation: Extrapolation,
}

impl StencilAxis {
    pub(super) fn new(
        name: &'static str,
        knots: &[f64],
        interpolation: Interpolation,
    ) -> Result<Self, MathError> {
        let axis = Axis::new(name, knots)?;
        let cells = match interpolation {
            Interpolation::Linear => Vec::new(),
            Interpolation::Cubic => (0..axis.len() - 1).map(|cell| CellSlopes::new(&axis, cell)).collect(),
        };
        Ok(Self { axis, cells, extrapolation: Extrapolation::Nearest })
    }

    pub(super) fn extend(&mut self, extrapolation: Extrapolation, range: f64) -> Result<(), MathError> {
        self.extrapolation = extrapolation;
        self.axis.extend(range)
    }

    pub(super) fn axis(&self) -> &Axis {
        &self.axis
    }

    /// The weights for the derivative of the given order at `x`; none where there is no value.
    #[inline]
    pub(super) fn stencil(&self, x: f64, order: u32) -> Option<Stencil> {
        if !self.axis.admits(x) {
            return None;
        }
        let (low, high) = self.axis.domain();
        let outside = x < low || x > high;
        let nearest = outside && self.extrapolation == Extrapolation::Nearest;
        let inside = if nearest { x.clamp(low, high) } else { x };
        let cell = self.axis.cell(inside);
        let width = self.axis.width(cell);
        let t = if nearest && x > high { 1.0 } else { (inside - self.axis.knots()[cell]) / width };
        let scale = if order == 0 {
            1.0
        } else if nearest {
            0.0
        } else {
            width.powi(order as i32).recip()
        };
        let none = [0.0; 4];
        let mut stencil = Stencil { first: cell, count: 2, values: none, slopes: none, mixed: none };
        let Some(slopes) = self.cells.get(cell) else {
            let [low, high] = Hermite::line(t, order).values;
            (stencil.values[0], stencil.values[1]) = (low * scale, high * scale);
            return Some(stencil);
        };
        let basis = if outside && !nearest { Hermite::beyond(t, order) } else { Hermite::cubic(t, order) };
        stencil.first = slopes.first;
        stencil.count = self.axis.len().min(4);
        stencil.values[cell - slopes.first] = basis.values[0] * scale;
        stencil.values[cell - slopes.first + 1] = basis.values[1] * scale;
        let [a, b] = basis.slopes.map(|slope| slope * scale);
        for k in 0..4 {
            stencil.slopes[k] = a * slopes.parabolic[0][k] + b * slopes.parabolic[1][k];
            stencil.mixed[k] = a * slopes.central[0][k] + b * slopes.central[1][k];
        }
        Some(stencil)
    }
}
