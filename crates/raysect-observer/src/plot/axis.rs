/// A range of values with places for marks, and the power of ten that is taken out of their labels.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Axis {
    pub(super) low: f64,
    pub(super) high: f64,
    ticks: Vec<f64>,
    step: f64,
    exponent: i32,
}

impl Axis {
    /// Over exactly these values, which must be finite; over ±½ about them if they are as good as equal.
    pub(super) fn over(low: f64, high: f64) -> Self {
        Self::with_least_step(low, high, 0.0)
    }

    /// Over numbered things, with marks at whole numbers.
    pub(super) fn counting(low: f64, high: f64) -> Self {
        Self::with_least_step(low, high, 1.0)
    }

    fn with_least_step(low: f64, high: f64, least: f64) -> Self {
        let largest = low.abs().max(high.abs());
        // Differences below that have no digits that a mark could show.
        let apart = high - low > 1e-9 * largest;
        let (low, high) = if apart { (low, high) } else { (low - half(low), low + half(low)) };
        let step = nice_step(((high - low) / 6.0).max(least));
        // A multiple of the step that rounding has put outside is still a mark.
        let (first, last) = ((low / step - 1e-9).ceil(), (high / step + 1e-9).floor());
        let count = (last - first).clamp(0.0, 20.0) as usize + 1;
        let ticks: Vec<f64> = (0..count).map(|i| (first + i as f64) * step).collect();
        let power = low.abs().max(high.abs()).log10().floor() as i32;
        let exponent = if (-3..5).contains(&power) { 0 } else { power };
        Self { low, high, ticks, step, exponent }
    }

    /// Over these values and a little more, from zero if none is negative and they come near it.
    pub(super) fn around(low: f64, high: f64) -> Self {
        let margin = 0.05 * (high - low);
        let from_zero = low >= 0.0 && low < 0.5 * high;
        Self::over(if from_zero { 0.0 } else { low - margin }, high + margin)
    }

    /// Place of a value, 0 … 1 within the range.
    pub(super) fn place(&self, value: f64) -> f64 {
        (value - self.low) / (self.high - self.low)
    }

    /// Value and label of each mark.
    pub(super) fn marks(&self) -> Vec<(f64, String)> {
        let scale = 10f64.powi(self.exponent);
        let digits = (-((self.step / scale).log10() + 1e-9).floor()).clamp(0.0, 12.0) as usize;
        let label = |tick: f64| {
            let text = format!("{:.digits$}", tick / scale);
            // Rounding may leave a zero its sign.
            if text.trim_start_matches('-').chars().all(|c| c == '0' || c == '.') {
                text.trim_start_matches('-').to_owned()
            } else {
                text.replace('-', "−")
            }
        };
        self.ticks.iter().map(|&tick| (tick, label(tick))).collect()
    }

    /// A label with the power of ten that the marks leave out: `power [10⁻⁶ W/nm]`.
    pub(super) fn titled(&self, label: &str) -> String {
        if self.exponent == 0 {
            return label.to_owned();
        }
        let power = format!("10{}", superscript(self.exponent));
        match label.rsplit_once('[') {
            Some((name, "]")) => format!("{name}[{power}]"),
            Some((name, unit)) => format!("{name}[{power} {unit}"),
            None => format!("{label} [{power}]"),
        }
    }
}

/// Half the width of the range about a single value.
fn half(value: f64) -> f64 {
    if value == 0.0 { 0.5 } else { 0.5 * value.abs() }
}

/// The next of 1, 2, 5 times a power of ten.
fn nice_step(step: f64) -> f64 {
    let power = 10f64.powf(step.log10().floor());
    let factor = [1.0, 2.0, 5.0].into_iter().find(|f| f * power >= step).unwrap_or(10.0);
    factor * power
}

fn superscript(number: i32) -> String {
    let raised = |c: char| match c.to_digit(10) {
        Some(digit) => ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'][digit as usize],
        None => '⁻',
    };
    number.to_string().chars().map(raised).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn labels(axis: &Axis) -> Vec<String> {
        axis.marks().into_iter().map(|(_, label)| label).collect()
    }

    #[test]
    fn marks_are_round_numbers_within_the_range() {
        assert_eq!(labels(&Axis::over(375.0, 740.0)), ["400", "500", "600", "700"]);
        assert_eq!(labels(&Axis::over(0.0, 1.0)), ["0.0", "0.2", "0.4", "0.6", "0.8", "1.0"]);
        assert_eq!(labels(&Axis::over(-0.3, 0.3)), ["−0.3", "−0.2", "−0.1", "0.0", "0.1", "0.2", "0.3"]);
        for (low, high) in
            [(1e-300, 3e-300), (-7e12, 2e13), (499.99, 500.01), (0.0, 0.0), (5.0, 5.0), (0.0, 1e300)]
        {
            let axis = Axis::over(low, high);
            let marks = axis.marks();
            assert!((2..=12).contains(&marks.len()), "{low} {high}: {marks:?}");
            assert!(marks.iter().all(|(v, _)| (-1e-9..=1.0 + 1e-9).contains(&axis.place(*v))), "{marks:?}");
            let distinct: std::collections::BTreeSet<_> = marks.iter().map(|(_, label)| label).collect();
            assert_eq!(distinct.len(), marks.len(), "{marks:?}");
        }
    }

    #[test]
    fn numbered_things_have_marks_at_whole_numbers() {
        assert_eq!(labels(&Axis::counting(0.0, 3.0)), ["0", "1", "2", "3"]);
        assert_eq!(labels(&Axis::counting(-1.0, 0.0)), ["−1", "0"]);
        assert_eq!(labels(&Axis::counting(0.0, 300.0)), ["0", "50", "100", "150", "200", "250", "300"]);
    }

    #[test]
    fn small_and_large_values_have_their_power_of_ten_in_the_title() {
        let small = Axis::over(0.0, 4.2e-7);
        assert_eq!(labels(&small)[..3], ["0", "1", "2"]);
        assert_eq!(small.titled("power [W/nm]"), "power [10⁻⁷ W/nm]");
        assert_eq!(Axis::over(0.0, 2e12).titled("n"), "n [10¹²]");
        assert_eq!(Axis::over(0.0, 2.0).titled("power [W/nm]"), "power [W/nm]");
    }

    #[test]
    fn values_near_zero_are_shown_from_zero() {
        assert_eq!(Axis::around(0.1, 4.0).low, 0.0);
        assert!(Axis::around(3.9, 4.0).low > 3.8);
        assert!(Axis::around(-1.0, 4.0).low < -1.0);
        assert_eq!((Axis::around(0.0, 0.0).low, Axis::around(1.0, 1.0 + 1e-15).low), (-0.5, 0.5));
    }
}
