//! Weights of the knots next to a place, in one variable of several.

use super::axis::Axis;
use super::hermite::Hermite;
use super::{Extrapolation, Interpolation};
use crate::MathError;

/// Weights of the two knots of a cell, for linear pieces.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Pair {
    /// The first knot.
    pub(super) first: usize,
    /// What the values contribute.
    pub(super) values: [f64; 2],
}

impl Pair {
    /// The sum over the values of both.
    #[inline]
    pub(super) fn along(&self, low: f64, high: f64) -> f64 {
        self.values[0] * low + self.values[1] * high
    }
}

/// Weights of up to four neighbouring knots along one variable, for cubic pieces.
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
    /// The sums over four values along this variable, added with the factors of the others.
    #[inline]
    fn contribution(&self, sums: &RowSums) -> f64 {
        let mut sum = 0.0;
        for k in 0..4 {
            sum += self.values[k] * sums.values[k]
                + self.slopes[k] * sums.slopes[k]
                + self.mixed[k] * sums.mixed[k];
        }
        sum
    }
}

/// Rows of four values added up with the factors that the other variables have for this one's values, slopes and
/// mixed derivatives.
#[derive(Default)]
struct RowSums {
    values: [f64; 4],
    slopes: [f64; 4],
    mixed: [f64; 4],
}

impl RowSums {
    /// Adds what begins a row; beyond its end there is no weight.
    #[inline(always)]
    fn add(&mut self, row: &[f64], [values, slopes, mixed]: [f64; 3]) {
        let four = match row.first_chunk::<4>() {
            Some(four) => *four,
            None => std::array::from_fn(|k| row.get(k).copied().unwrap_or(0.0)),
        };
        for k in 0..4 {
            self.values[k] += values * four[k];
            self.mixed[k] += mixed * four[k];
        }
        // Slopes along one variable alone belong to the corners of the cell.
        if slopes != 0.0 {
            for k in 0..4 {
                self.slopes[k] += slopes * four[k];
            }
        }
    }
}

/// The cubic piece of two variables, of values in rows along the second.
#[inline]
pub(super) fn cubic2(values: &[f64], columns: usize, a: &Stencil, b: &Stencil) -> f64 {
    let mut sums = RowSums::default();
    let rows = values[a.first * columns + b.first..].chunks(columns);
    for (i, row) in rows.take(a.count).enumerate() {
        sums.add(row, [a.values[i] + a.slopes[i], a.values[i], a.mixed[i]]);
    }
    b.contribution(&sums)
}

/// The cubic piece of three variables, of values in planes of `rows` rows along the third.
#[inline]
pub(super) fn cubic3(values: &[f64], [rows, columns]: [usize; 2], [a, b, c]: [&Stencil; 3]) -> f64 {
    let mut sums = RowSums::default();
    let (mut value_or_slope, mut value_or_mixed) = ([0.0; 4], [0.0; 4]);
    for j in 0..4 {
        value_or_slope[j] = b.values[j] + b.slopes[j];
        value_or_mixed[j] = b.values[j] + b.mixed[j];
    }
    for i in 0..a.count {
        let (mut of_values, mut of_slopes, mut of_mixed) = ([0.0; 4], [0.0; 4], [0.0; 4]);
        for j in 0..4 {
            of_slopes[j] = a.values[i] * b.values[j];
            of_values[j] =
                a.values[i] * value_or_slope[j] + a.slopes[i] * b.values[j] + a.mixed[i] * b.mixed[j];
            of_mixed[j] = a.mixed[i] * value_or_mixed[j] + a.values[i] * b.mixed[j];
        }
        let start = ((a.first + i) * rows + b.first) * columns + c.first;
        for (j, row) in values[start..].chunks(columns).take(b.count).enumerate() {
            sums.add(row, [of_values[j], of_slopes[j], of_mixed[j]]);
        }
    }
    c.contribution(&sums)
}

/// Weights of the four knots of a cell's stencil for the values and slopes at both ends of the cell, in units of the cell.
#[derive(Debug, Clone, Copy, PartialEq)]
struct CellSlopes {
    first: usize,
    /// 1 for the knot at the end.
    ends: [[f64; 4]; 2],
    parabolic: [[f64; 4]; 2],
    central: [[f64; 4]; 2],
}

impl CellSlopes {
    fn new(axis: &Axis, cell: usize) -> Self {
        let last = axis.len() - 1;
        let first = cell.saturating_sub(1).min(axis.len().saturating_sub(4));
        let none = [[0.0; 4]; 2];
        let mut slopes = Self { first, ends: none, parabolic: none, central: none };
        for side in 0..2 {
            let knot = cell + side;
            slopes.ends[side][knot - first] = 1.0;
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
                (unit / left * (right / (left + right)), unit / right * (left / (left + right)));
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

    /// True if pieces are linear.
    #[inline]
    pub(super) fn is_linear(&self) -> bool {
        self.cells.is_empty()
    }

    /// Where a place lies in which cell.
    #[inline(always)]
    fn locate(&self, x: f64, order: u32) -> Located {
        if !self.axis.holds(x) {
            return self.locate_outside(x, order);
        }
        let cell = self.axis.cell(x);
        let (low, width) = self.axis.extent(cell);
        let scale = if order == 0 { 1.0 } else { width.powi(order as i32).recip() };
        Located { cell, t: (x - low) / width, scale, beyond: false }
    }

    #[cold]
    fn locate_outside(&self, x: f64, order: u32) -> Located {
        if !self.axis.admits(x) {
            return Located { cell: 0, t: f64::NAN, scale: f64::NAN, beyond: false };
        }
        let above = x > self.axis.domain().1;
        let cell = if above { self.axis.len() - 2 } else { 0 };
        if self.extrapolation == Extrapolation::Nearest {
            let (t, scale) = (if above { 1.0 } else { 0.0 }, if order == 0 { 1.0 } else { 0.0 });
            return Located { cell, t, scale, beyond: false };
        }
        let (low, width) = self.axis.extent(cell);
        Located { cell, t: (x - low) / width, scale: width.powi(order as i32).recip(), beyond: true }
    }

    /// The weights for the derivative of the given order at `x`, linear; NaN where there is no value.
    #[inline(always)]
    pub(super) fn pair(&self, x: f64, order: u32) -> Pair {
        let Located { cell, t, scale, .. } = self.locate(x, order);
        Pair { first: cell, values: Hermite::line(t, order).values.map(|weight| weight * scale) }
    }

    /// The weights for the derivative of the given order at `x`, cubic; NaN where there is no value.
    #[inline(always)]
    pub(super) fn stencil(&self, x: f64, order: u32) -> Stencil {
        let Located { cell, t, scale, beyond } = self.locate(x, order);
        let basis = if beyond { Hermite::beyond(t, order) } else { Hermite::cubic(t, order) };
        let of_cell = &self.cells[cell];
        let (first, count) = (of_cell.first, self.axis.len().min(4));
        let [low, high] = basis.values.map(|value| value * scale);
        let [a, b] = basis.slopes.map(|slope| slope * scale);
        let mut stencil = Stencil { first, count, values: [0.0; 4], slopes: [0.0; 4], mixed: [0.0; 4] };
        for k in 0..4 {
            stencil.values[k] = low * of_cell.ends[0][k] + high * of_cell.ends[1][k];
            stencil.slopes[k] = a * of_cell.parabolic[0][k] + b * of_cell.parabolic[1][k];
            stencil.mixed[k] = a * of_cell.central[0][k] + b * of_cell.central[1][k];
        }
        stencil
    }
}

/// A place along one variable.
struct Located {
    cell: usize,
    /// In units of the cell.
    t: f64,
    /// Of the derivative, for the unit of the cell.
    scale: f64,
    /// True if a cubic piece goes on as a line.
    beyond: bool,
}
