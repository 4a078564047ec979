//! Values and slopes at the knots of a grid, of which cubic pieces are put together.
//!
//! Slopes along one variable are those of parabolas, as in one variable, but mixed derivatives are made of differences
//! over both neighbours, as Raysect makes them; where the knots are even these are the same. All are derivatives in
//! units of mean cells.

use super::axis::Axis;
use super::grid_axis::Ends;

/// The value, the slopes along x and y, and the mixed derivative at a knot of a plane grid.
pub(super) type Node2 = [f64; 4];

/// [`Node2`], and then the derivatives along z of these four.
pub(super) type Node3 = [f64; 8];

/// What is known at the knots of a grid.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Table<Node> {
    /// The values, for linear pieces.
    Linear(Vec<f64>),
    /// Values and derivatives, for cubic ones.
    Cubic(Vec<Node>),
}

/// How much the rises to a knot from the one before and from it to the one after count for a slope there.
type Weights = [f64; 2];

/// Of the parabola through three knots.
fn parabola([left, right]: [f64; 2]) -> Weights {
    [right / (left + right) / left, left / (left + right) / right]
}

/// Of the line from neighbour to neighbour.
fn secant([left, right]: [f64; 2]) -> Weights {
    [1.0 / (left + right); 2]
}

/// The weights at every knot of an axis, by the widths of the cells on both sides, in mean cells; at the ends those of
/// the line to the neighbour.
fn weights(axis: &Axis, inner: impl Fn([f64; 2]) -> Weights) -> Vec<Weights> {
    let last = axis.len() - 1;
    let width = |cell: usize| axis.width(cell) / axis.mean_width();
    (0..=last)
        .map(|knot| match knot {
            0 => [0.0, 1.0 / width(0)],
            _ if knot == last => [1.0 / width(last - 1), 0.0],
            _ => inner([width(knot - 1), width(knot)]),
        })
        .collect()
}

/// A slope of all values of a grid along the axis whose neighbours are `stride` apart.
fn differentiated(values: &[f64], stride: usize, weights: &[Weights]) -> Vec<f64> {
    let slope = |(place, value): (usize, &f64)| {
        let knot = place / stride % weights.len();
        let [before, after] = weights[knot];
        let mut sum = 0.0;
        if knot > 0 {
            sum += before * (value - values[place - stride]);
        }
        if knot + 1 < weights.len() {
            sum += after * (values[place + stride] - value);
        }
        sum
    };
    values.iter().enumerate().map(slope).collect()
}

/// Of the values of a grid with columns along the second axis.
pub(super) fn nodes2(values: &[f64], [x, y]: [&Axis; 2]) -> Vec<Node2> {
    let columns = y.len();
    let along_x = differentiated(values, columns, &weights(x, parabola));
    let along_y = differentiated(values, 1, &weights(y, parabola));
    let mixed = differentiated(values, columns, &weights(x, secant));
    let mixed = differentiated(&mixed, 1, &weights(y, secant));
    (0..values.len()).map(|i| [values[i], along_x[i], along_y[i], mixed[i]]).collect()
}

/// Of the values of a grid with columns along the third axis.
pub(super) fn nodes3(values: &[f64], [x, y, z]: [&Axis; 3]) -> Vec<Node3> {
    let strides = [y.len() * z.len(), z.len(), 1];
    let parabolic = |axis: usize, of: &Axis| differentiated(values, strides[axis], &weights(of, parabola));
    let (along_x, along_y, along_z) = (parabolic(0, x), parabolic(1, y), parabolic(2, z));
    let secants = [x, y, z].map(|axis| weights(axis, secant));
    let mixed = |values: &[f64], axis: usize| differentiated(values, strides[axis], &secants[axis]);
    let (over_x, over_y) = (mixed(values, 0), mixed(values, 1));
    let (xy, xz, yz) = (mixed(&over_x, 1), mixed(&over_x, 2), mixed(&over_y, 2));
    let xyz = mixed(&xy, 2);
    let node = |i: usize| [values[i], along_x[i], along_y[i], xy[i], along_z[i], xz[i], yz[i], xyz[i]];
    (0..values.len()).map(node).collect()
}

/// The factors of the four numbers of a [`Node2`] at a corner of a cell.
#[inline(always)]
fn factors(a: &Ends, i: usize, b: &Ends, j: usize) -> [f64; 4] {
    let (value, slope) = (a.values[i], a.slopes[i]);
    [value * b.values[j], slope * b.values[j], value * b.slopes[j], slope * b.slopes[j]]
}

/// The cubic piece of two variables.
#[inline(always)]
pub(super) fn cubic2(nodes: &[Node2], columns: usize, a: &Ends, b: &Ends) -> f64 {
    let start = a.first * columns + b.first;
    let corners = &nodes[start..][..columns + 2];
    let mut sums = [0.0; 4];
    for (i, j) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
        let (node, factors) = (&corners[i * columns + j], factors(a, i, b, j));
        for k in 0..4 {
            sums[k] += factors[k] * node[k];
        }
    }
    (sums[0] + sums[1]) + (sums[2] + sums[3])
}

/// The cubic piece of three variables, in planes of `rows` rows along the third.
#[inline(always)]
pub(super) fn cubic3(nodes: &[Node3], [rows, columns]: [usize; 2], [a, b, c]: [&Ends; 3]) -> f64 {
    let start = (a.first * rows + b.first) * columns + c.first;
    let corners = &nodes[start..][..rows * columns + columns + 2];
    let mut sums = [0.0; 4];
    for (i, j) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
        let edge = &corners[(i * rows + j) * columns..][..2];
        let factors = factors(a, i, b, j);
        for k in 0..4 {
            let values = c.values[0] * edge[0][k] + c.values[1] * edge[1][k];
            let slopes = c.slopes[0] * edge[0][k + 4] + c.slopes[1] * edge[1][k + 4];
            sums[k] += factors[k] * (values + slopes);
        }
    }
    (sums[0] + sums[1]) + (sums[2] + sums[3])
}
