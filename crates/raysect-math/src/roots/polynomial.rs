//! Cubics and quartics by the roots of their derivatives.
//!
//! Between two neighbouring roots of its derivative a polynomial is monotonic: a root lies there if the signs at the
//! ends differ, and is found by Newton's method in that bracket (C. Yuksel, *High-Performance Polynomial Root Finding
//! for Graphics*, Proc. ACM Comput. Graph. Interact. Tech. 5, 2022). Signs and values that ordinary evaluation leaves
//! in doubt come from compensated evaluation.

use super::scaling::{about, exponent, is_moderate, root_sizes, scale};
use super::{Bracket, Roots, solve_quadratic};
use crate::error_free::{two_product, two_sum};

/// The real roots of a x³ + b x² + c x + d.
///
/// Each is as good as the nearest numbers allow: what is left of the polynomial there is a few roundings of its
/// largest term. Of a double root none or two are given, of a triple root one or three. With `a` = 0 the degree
/// falls, as a root goes to infinity; roots beyond the range of numbers are left out; coefficients that are not
/// finite have none.
///
/// ```
/// let roots = raysect_math::solve_cubic(1.0, -6.0, 11.0, -6.0);
/// assert_eq!(roots[..], [1.0, 2.0, 3.0]);
/// ```
#[inline]
pub fn solve_cubic(a: f64, b: f64, c: f64, d: f64) -> Roots<3> {
    if !(a.is_finite() && b.is_finite() && c.is_finite() && d.is_finite()) {
        return Roots::default();
    }
    if a == 0.0 {
        return solve_quadratic(b, c, d).widen();
    }
    if d == 0.0 {
        return solve_quadratic(a, b, c).with_zero();
    }
    let slope = slope([d, c, b, a]);
    roots_between(&[d, c, b, a], &solve_quadratic(slope[2], slope[1], slope[0]))
}

/// The real roots of a x⁴ + b x³ + c x² + d x + e; in all else like [`solve_cubic`].
///
/// ```
/// let roots = raysect_math::solve_quartic(1.0, 0.0, -5.0, 0.0, 4.0);
/// assert_eq!(roots[..], [-2.0, -1.0, 1.0, 2.0]);
/// ```
#[doc(alias = "solve_biquadratic")]
#[inline]
pub fn solve_quartic(a: f64, b: f64, c: f64, d: f64, e: f64) -> Roots<4> {
    if !(a.is_finite() && b.is_finite() && c.is_finite() && d.is_finite() && e.is_finite()) {
        return Roots::default();
    }
    if a == 0.0 {
        return solve_cubic(b, c, d, e).widen();
    }
    if e == 0.0 {
        return solve_cubic(a, b, c, d).with_zero();
    }
    let slope = slope([e, d, c, b, a]);
    roots_between(&[e, d, c, b, a], &solve_cubic(slope[3], slope[2], slope[1], slope[0]))
}

/// Coefficients of the derivative, the last one 0, divided by 4 if they would overflow.
#[inline]
fn slope<const M: usize>(c: [f64; M]) -> [f64; M] {
    let unit = if c.iter().any(|x| x.abs() > 1e300) { 0.25 } else { 1.0 };
    std::array::from_fn(|i| if i + 1 < M { c[i + 1] * unit * (i + 1) as f64 } else { 0.0 })
}

/// The roots between the points where the slope vanishes. Coefficients ascend from the constant, which is not 0;
/// nor is the last.
#[inline]
fn roots_between<const M: usize, const N: usize>(c: &[f64; M], critical: &[f64]) -> Roots<N> {
    let mut roots = Roots::default();
    let (least, most) = root_sizes(c);
    let moderate = is_moderate(c);
    let evaluate = |x: f64| if moderate { evaluate(c, x) } else { evaluate_scaled(c, x) };
    let positive = |x: f64| evaluate(x).0 >= 0.0;
    let mut low = -most;
    let mut low_positive = positive(low);
    let ends = critical.iter().copied().filter(|x| x.abs() < most).chain([most]);
    for high in ends {
        let high_positive = positive(high);
        if high_positive != low_positive {
            let mut bracket = Bracket { low, high, rising: high_positive };
            // No root is smaller than `least`: the bracket need not reach 0.
            if low <= 0.0 && high >= 0.0 {
                if (c[0] > 0.0) == high_positive {
                    bracket.high = low.max(-least);
                } else {
                    bracket.low = high.min(least);
                }
            }
            roots.insert(bracket.newton(0.0, evaluate));
        }
        (low, low_positive) = (high, high_positive);
    }
    roots
}

/// Value and slope, with a value whose sign can be trusted: as exact as if computed in twice the precision where
/// rounding could matter.
#[inline]
fn evaluate<const M: usize>(c: &[f64; M], x: f64) -> (f64, f64) {
    let (mut value, mut slope, mut size) = (c[M - 1], 0.0, c[M - 1].abs());
    for &coefficient in c[..M - 1].iter().rev() {
        slope = slope * x + value;
        value = value * x + coefficient;
        size = size * x.abs() + coefficient.abs();
    }
    // Twice the bound on the rounding of Horner's scheme (Higham, section 5.1).
    if value.abs() <= 2.0 * M as f64 * f64::EPSILON * size {
        value = compensated(c, x);
    }
    (value, slope)
}

/// A positive multiple of value and slope that neither over- nor underflows, for coefficients of any size.
#[cold]
fn evaluate_scaled<const M: usize>(c: &[f64; M], x: f64) -> (f64, f64) {
    if x == 0.0 {
        return (c[0], c[1]);
    }
    let e = exponent(x);
    let (value, slope) = evaluate(&about(c, e), scale(x, -e));
    let middle = if e < 0 { -100 } else { 100 };
    (scale(value, middle), scale(slope, middle - e))
}

/// Horner's scheme with its rounding errors summed alongside (S. Graillat, P. Langlois, N. Louvet, *Algorithms for
/// accurate, validated and fast polynomial evaluation*, Japan J. Indust. Appl. Math. 26, 2009).
fn compensated<const M: usize>(c: &[f64; M], x: f64) -> f64 {
    let (mut value, mut correction) = (c[M - 1], 0.0);
    for &coefficient in c[..M - 1].iter().rev() {
        let (product, product_error) = two_product(value, x);
        let (sum, sum_error) = two_sum(product, coefficient);
        value = sum;
        correction = correction * x + (product_error + sum_error);
    }
    value + correction
}
