/// The four cubic Hermite polynomials, or a derivative of them: for the values at the ends of the unit interval and
/// for the slopes there.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Hermite {
    /// Weights of the values at 0 and 1.
    pub(super) values: [f64; 2],
    /// Weights of the slopes at 0 and 1.
    pub(super) slopes: [f64; 2],
}

impl Hermite {
    /// The derivative of the given order at `t`, in units of the interval.
    #[inline(always)]
    pub(super) fn cubic(t: f64, order: u32) -> Self {
        let s = 1.0 - t;
        let (rise, slopes) = match order {
            0 => (t * t * (3.0 - 2.0 * t), [t * s * s, -t * t * s]),
            1 => (6.0 * t * s, [s * (1.0 - 3.0 * t), t * (3.0 * t - 2.0)]),
            2 => (6.0 - 12.0 * t, [6.0 * t - 4.0, 6.0 * t - 2.0]),
            3 => (-12.0, [6.0, 6.0]),
            _ => (0.0, [0.0, 0.0]),
        };
        let fall = if order == 0 { s * s * (1.0 + 2.0 * t) } else { -rise };
        Self { values: [fall, rise], slopes }
    }

    /// The same for the straight line between the values.
    #[inline(always)]
    pub(super) fn line(t: f64, order: u32) -> Self {
        let values = match order {
            0 => [1.0 - t, t],
            1 => [-1.0, 1.0],
            _ => [0.0, 0.0],
        };
        Self { values, slopes: [0.0, 0.0] }
    }

    /// The same for the line with the value and slope of the end next to `t`, which lies outside 0 … 1.
    #[inline(always)]
    pub(super) fn beyond(t: f64, order: u32) -> Self {
        let end = usize::from(t > 0.0);
        let mut weights = Self { values: [0.0; 2], slopes: [0.0; 2] };
        weights.values[end] = if order == 0 { 1.0 } else { 0.0 };
        weights.slopes[end] = match order {
            0 => t - end as f64,
            1 => 1.0,
            _ => 0.0,
        };
        weights
    }
}
