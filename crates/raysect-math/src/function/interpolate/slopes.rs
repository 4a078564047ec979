//! Slopes of curves at their knots, in the units of the values over those of the knots.

/// Slope of the line through neighbouring knots.
fn secant(x: &[f64], f: &[f64], i: usize) -> f64 {
    (f[i + 1] - f[i]) / (x[i + 1] - x[i])
}

/// The slope of the parabola through each knot and its neighbours; at the ends of the line to the neighbour.
pub(super) fn parabolic(x: &[f64], f: &[f64]) -> Vec<f64> {
    let last = x.len() - 1;
    let inner = |i: usize| {
        let (left, right) = (x[i] - x[i - 1], x[i + 1] - x[i]);
        (secant(x, f, i - 1) * right + secant(x, f, i) * left) / (left + right)
    };
    (0..=last)
        .map(|i| match i {
            0 => secant(x, f, 0),
            _ if i == last => secant(x, f, last - 1),
            _ => inner(i),
        })
        .collect()
}

/// Slopes that make a monotone curve of monotone values: the weighted harmonic mean of the slopes on both sides, 0 where
/// they differ in sign; at the ends the three-point formula, cut off at three times the end's secant and at 0 (Fritsch
/// and Butland 1984; C. Moler, *Numerical Computing with MATLAB*, SIAM 2004, 3.4).
pub(super) fn monotone(x: &[f64], f: &[f64]) -> Vec<f64> {
    let last = x.len() - 1;
    if last == 1 {
        return vec![secant(x, f, 0); 2];
    }
    let inner = |i: usize| {
        let (left, right) = (x[i] - x[i - 1], x[i + 1] - x[i]);
        let (before, after) = (secant(x, f, i - 1), secant(x, f, i));
        if before == 0.0 || after == 0.0 || (before > 0.0) != (after > 0.0) {
            return 0.0;
        }
        // Weights (2 h₊ + h₋) / 3 (h₋ + h₊) and (h₊ + 2 h₋) / 3 (h₋ + h₊), whatever the unit of x.
        let share = right / (left + right) / 3.0;
        1.0 / ((1.0 / 3.0 + share) / before + (2.0 / 3.0 - share) / after)
    };
    let end = |near: f64, far: f64, secant: f64, next: f64| {
        let slope = ((2.0 * near + far) * secant - near * next) / (near + far);
        if slope * secant <= 0.0 {
            0.0
        } else if secant * next <= 0.0 && slope.abs() > 3.0 * secant.abs() {
            3.0 * secant
        } else {
            slope
        }
    };
    (0..=last)
        .map(|i| match i {
            0 => end(x[1] - x[0], x[2] - x[1], secant(x, f, 0), secant(x, f, 1)),
            _ if i == last => end(
                x[last] - x[last - 1],
                x[last - 1] - x[last - 2],
                secant(x, f, last - 1),
                secant(x, f, last - 2),
            ),
            _ => inner(i),
        })
        .collect()
}
