/// An interval at whose ends a continuous function has different signs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bracket {
    /// The lower end.
    pub low: f64,
    /// The upper end.
    pub high: f64,
    /// True if the function is negative at the lower end and positive at the upper one.
    pub rising: bool,
}

impl Bracket {
    /// The root by Newton's method, with a bisection wherever a step would leave the bracket or is not half as long
    /// as the one before, and as long as the ends differ by orders of magnitude (C. Yuksel, *High-Performance Polynomial Root Finding for Graphics*, Proc. ACM Comput.
    /// Graph. Interact. Tech. 5, 2022, section 3).
    ///
    /// `f` gives value and slope. It ends where the value is 0 or NaN, the bracket has no number left between its
    /// ends, or a step is not longer than `tolerance` or half the spacing of numbers there.
    ///
    /// ```
    /// use raysect_math::Bracket;
    /// let bracket = Bracket { low: 0.0, high: 2.0, rising: true };
    /// let root = bracket.newton(0.0, |x| (x * x - 2.0, 2.0 * x));
    /// assert!((root - 2f64.sqrt()).abs() < 1e-15);
    /// ```
    #[inline]
    pub fn newton(self, tolerance: f64, mut f: impl FnMut(f64) -> (f64, f64)) -> f64 {
        /// Two for each bit of a number: a bisection between any two steps.
        const STEPS: usize = 128;
        let Self { mut low, mut high, rising } = self;
        let mut x = middle(low, high);
        let mut before = high - low;
        for _ in 0..STEPS {
            let (value, slope) = f(x);
            if value == 0.0 || value.is_nan() {
                return x;
            }
            if (value > 0.0) == rising {
                high = x;
            } else {
                low = x;
            }
            let step = value / slope;
            let next = x - step;
            if step.abs() <= tolerance.max(0.5 * f64::EPSILON * x.abs()) {
                return next.clamp(low, high);
            }
            if next > low && next < high && step.abs() <= 0.5 * before && !is_wide(low, high) {
                before = step.abs();
                x = next;
                continue;
            }
            let halved = middle(low, high);
            if halved <= low || halved >= high {
                return x;
            }
            before = high - low;
            x = halved;
        }
        x
    }
}

/// True if both ends have the same sign and very different sizes.
#[inline]
fn is_wide(low: f64, high: f64) -> bool {
    let ratio = 65536.0;
    (low > 0.0 && high > ratio * low) || (high < 0.0 && low < ratio * high)
}

/// The number half-way between two; counted in numbers, not in size, if they differ by orders of magnitude.
#[inline]
fn middle(low: f64, high: f64) -> f64 {
    if is_wide(low, high) {
        let bits = low.abs().to_bits().midpoint(high.abs().to_bits());
        return f64::from_bits(bits).copysign(low);
    }
    0.5 * low + 0.5 * high
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn wide_brackets_take_few_steps() {
        let mut steps = 0;
        let bracket = Bracket { low: 1e-300, high: 1e300, rising: true };
        let root = bracket.newton(0.0, |x| {
            steps += 1;
            (x.ln() - 5.0, 1.0 / x)
        });
        assert!((root / 5f64.exp() - 1.0).abs() < 1e-15 && steps < 40, "{root} after {steps}");
    }

    #[test]
    fn a_wrong_slope_costs_time_only() {
        for slope in [0.0, -1.0, 1e-300, 1e300, f64::NAN, f64::INFINITY] {
            // An infinite slope claims that the root has been found.
            let tolerant = slope.is_infinite() || slope == 1e300;
            let bracket = Bracket { low: 0.0, high: 2.0, rising: true };
            let root = bracket.newton(0.0, |x| (x.powi(3) - 2.0, slope));
            assert!((root - 2f64.cbrt()).abs() < 1e-15 || tolerant, "{slope}: {root}");
        }
    }

    #[test]
    fn falling_and_multiple_roots() {
        let bracket = Bracket { low: -1.0, high: 3.0, rising: false };
        assert!((bracket.newton(0.0, |x| (1.0 - x, -1.0)) - 1.0).abs() < 1e-15);
        let root = bracket.newton(0.0, |x| (-(x - 0.3).powi(3), -3.0 * (x - 0.3).powi(2)));
        assert!((root - 0.3).abs() < 1e-15);
    }
}
