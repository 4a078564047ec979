use crate::MathError;

/// A root of a continuous function between two ends where its signs differ.
///
/// Inverse quadratic interpolation where it is safe, bisection elsewhere (T. R. Chandrupatla, *A new hybrid
/// quadratic/bisection algorithm for finding the zero of a nonlinear function without using derivatives*, Adv. Eng.
/// Softw. 28, 1997). The answer lies within `tolerance` of a root, or within rounding if that is 0. The ends may be
/// in either order.
///
/// ```
/// let root = raysect_math::find_root(|x| x.cos() - x, 0.0, 1.0, 0.0)?;
/// assert!((root - 0.739_085_133_215_160_6).abs() < 1e-15);
/// # Ok::<(), raysect_math::MathError>(())
/// ```
///
/// # Errors
/// [`MathError::NoSignChange`] unless the values at the ends differ in sign, one of them is 0, or if the function
/// gives a NaN on the way.
pub fn find_root(
    mut f: impl FnMut(f64) -> f64,
    low: f64,
    high: f64,
    tolerance: f64,
) -> Result<f64, MathError> {
    // The root lies between `near`, the place looked at last, and `far`.
    let (mut near, mut far) = ((low, f(low)), (high, f(high)));
    let refuse = |(a, at_a): (f64, f64), (b, at_b): (f64, f64)| {
        let (low, high) = if a <= b { ((a, at_a), (b, at_b)) } else { ((b, at_b), (a, at_a)) };
        Err(MathError::NoSignChange { low: low.0, at_low: low.1, high: high.0, at_high: high.1 })
    };
    let differ = near.1 * far.1 <= 0.0 || (near.1 > 0.0) != (far.1 > 0.0);
    if near.1.is_nan() || far.1.is_nan() || !differ || !(low - high).is_finite() {
        return refuse(near, far);
    }
    let mut t: f64 = 0.5;
    loop {
        let best = if near.1.abs() < far.1.abs() { near } else { far };
        let narrow = (2.0 * f64::EPSILON * best.0.abs()).max(tolerance) / (far.0 - near.0).abs();
        if best.1 == 0.0 || narrow.is_nan() || narrow >= 0.5 {
            return Ok(best.0);
        }
        let x = near.0 + t.clamp(narrow, 1.0 - narrow) * (far.0 - near.0);
        if x == near.0 || x == far.0 {
            return Ok(best.0);
        }
        let value = f(x);
        if value.is_nan() {
            return refuse((x, value), far);
        }
        let mut old = near;
        if (value > 0.0) != (near.1 > 0.0) {
            (old, far) = (far, near);
        }
        near = (x, value);
        t = interpolate(near, far, old).unwrap_or(0.5);
    }
}

/// The fraction of the way from `near` to `far` where the inverse parabola through three points has its root, if
/// the parabola is single-valued between them.
fn interpolate(near: (f64, f64), far: (f64, f64), old: (f64, f64)) -> Option<f64> {
    let xi = (near.0 - far.0) / (old.0 - far.0);
    let phi = (near.1 - far.1) / (old.1 - far.1);
    let single_valued = phi * phi < xi && (1.0 - phi) * (1.0 - phi) < 1.0 - xi;
    let t = near.1 / (far.1 - near.1) * (old.1 / (far.1 - old.1))
        + (old.0 - near.0) / (far.0 - near.0) * (near.1 / (old.1 - near.1)) * (far.1 / (old.1 - far.1));
    (single_valued && t.is_finite()).then_some(t)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn smooth_flat_steep_and_broken_functions() {
        let mut calls = 0;
        let mut count = |f: fn(f64) -> f64, low: f64, high: f64| {
            calls = 0;
            let root = find_root(
                |x| {
                    calls += 1;
                    f(x)
                },
                low,
                high,
                0.0,
            );
            (root.unwrap(), calls)
        };
        let (root, calls) = count(|x| x.powi(3) - 2.0, 0.0, 2.0);
        assert!((root - 2f64.cbrt()).abs() < 1e-15 && calls < 15, "{root} {calls}");
        let (root, calls) = count(|x| (x - 0.25).powi(9), 2.0, -1.0);
        assert!((root - 0.25).abs() < 1e-15 && calls < 120, "{root} {calls}");
        let (root, calls) = count(|x| (1e6 * (x - 0.1)).tanh(), -1.0, 1.0);
        assert!((root - 0.1).abs() < 1e-15 && calls < 60, "{root} {calls}");
        let (root, calls) = count(|x| if x < 0.7 { -1.0 } else { 3.0 }, 0.0, 1.0);
        assert!((root - 0.7).abs() < 1e-15 && calls < 60, "{root} {calls}");
    }

    #[test]
    fn ends_tolerance_and_refusals() {
        assert_eq!(find_root(|x| x, 0.0, 1.0, 0.0), Ok(0.0));
        let mut calls = 0;
        let rough = find_root(
            |x| {
                calls += 1;
                x.exp() - 2.0
            },
            0.0,
            100.0,
            0.5,
        );
        let rough = rough.unwrap();
        assert!((rough - 2f64.ln()).abs() < 0.5 && calls < 14, "{rough} {calls}");
        let refused = find_root(|x| x * x + 1.0, -1.0, 2.0, 0.0).unwrap_err();
        assert!(refused.to_string().contains("f(-1) = 2 and f(2) = 5"), "{refused}");
        assert!(find_root(|x| if x == 0.5 { f64::NAN } else { x - 0.3 }, 0.0, 1.0, 0.0).is_err());
        assert!(find_root(|x| x, f64::NEG_INFINITY, 1.0, 0.0).is_err());
    }
}
