/// A value with its standard error in units of the last digits: `3.127(9)`, `1.20(12)e-9`.
///
/// The error has one significant digit, two if the first is a 1. An exponent is written where digits before
/// the point would be unknown and for numbers below 1e-4. Where the error fixes no last digit (it is zero,
/// not finite, negative, or below the 17th digit of the value) both numbers are written in full: `5 ± inf`.
///
/// ```
/// use raysect_math::format_with_error;
/// assert_eq!(format_with_error(3.12689, 0.0093), "3.127(9)");
/// assert_eq!(format_with_error(1.2e-9, 1.2e-10), "1.20(12)e-9");
/// assert_eq!(format_with_error(5.0, f64::INFINITY), "5 ± inf");
/// ```
pub fn format_with_error(value: f64, error: f64) -> String {
    aligned(value, error).unwrap_or_else(|| format!("{} ± {}", plain(value), plain(error)))
}

/// The shortest decimal number that is read back as `x`.
fn plain(x: f64) -> String {
    if x == 0.0 || !x.is_finite() || (1e-4..1e16).contains(&x.abs()) {
        format!("{x}")
    } else {
        format!("{x:e}")
    }
}

/// Significant digits and decimal exponent of the first of them, for `x` rounded to `1 + decimals` digits.
fn digits(x: f64, decimals: usize) -> Option<(String, i32)> {
    split(&format!("{x:.decimals$e}"))
}

fn split(text: &str) -> Option<(String, i32)> {
    let (mantissa, exponent) = text.split_once('e')?;
    Some((mantissa.replace('.', ""), exponent.parse().ok()?))
}

fn aligned(value: f64, error: f64) -> Option<String> {
    if !value.is_finite() || !error.is_finite() || error <= 0.0 {
        return None;
    }
    let (shortest, decade) = split(&format!("{error:e}"))?;
    let decimals = usize::from(shortest.starts_with('1'));
    // The last digit that is written stands for 10^last.
    let last = decade - decimals as i32;
    let (mut error_digits, carried) = digits(error, decimals)?;
    error_digits.push_str(&"0".repeat((carried - decade) as usize));

    let value_digits = rounded(value.abs(), last)?;
    let first = last + value_digits.len().max(error_digits.len()) as i32 - 1;
    let sign = if value < 0.0 && value_digits != "0" { "-" } else { "" };
    let exponent = if last > 0 || first < -4 { first } else { 0 };
    let places = (exponent - last) as usize;
    let padded = format!("{value_digits:0>width$}", width = places + 1);
    let (whole, fraction) = padded.split_at(padded.len() - places);
    let point = if places > 0 { "." } else { "" };
    let power = if exponent == 0 { String::new() } else { format!("e{exponent}") };
    Some(format!("{sign}{whole}{point}{fraction}({error_digits}){power}"))
}

/// `x / 10^last` rounded to an integer, in decimal; nothing if it had more than 17 digits.
fn rounded(x: f64, last: i32) -> Option<String> {
    if x == 0.0 {
        return Some("0".into());
    }
    let (shortest, decade) = split(&format!("{x:e}"))?;
    if decade < last {
        let up = decade == last - 1 && shortest.as_bytes() > b"5".as_slice();
        return Some(if up { "1".into() } else { "0".into() });
    }
    if decade - last > 16 {
        return None;
    }
    let (mut text, carried) = digits(x, (decade - last) as usize)?;
    text.push_str(&"0".repeat((carried - decade) as usize));
    Some(text)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn the_error_rounds_to_one_digit_or_to_two_after_a_one() {
        for (value, error, text) in [
            (3.12689, 0.0093, "3.127(9)"),
            (3.12689, 0.0094, "3.127(9)"),
            (3.12689, 0.0096, "3.127(10)"),
            (3.12689, 0.0011, "3.1269(11)"),
            (3.12689, 0.0019, "3.1269(19)"),
            (3.12689, 0.00196, "3.1269(20)"),
            (3.12689, 0.002, "3.127(2)"),
            (3.0, 0.02, "3.00(2)"),
            (-3.12689, 0.3, "-3.1(3)"),
            (9.9996, 0.003, "10.000(3)"),
            (99.96, 0.3, "100.0(3)"),
            (42.0, 3.0, "42(3)"),
            (3.0, 1.0, "3.0(10)"),
            (142.0, 12.0, "142(12)"),
        ] {
            assert_eq!(format_with_error(value, error), text, "{value} {error}");
        }
    }

    #[test]
    fn small_and_large_numbers_have_exponents() {
        for (value, error, text) in [
            (1.2e-9, 1.2e-10, "1.20(12)e-9"),
            (-1.2e-9, 3e-11, "-1.20(3)e-9"),
            (1234.0, 20.0, "1.23(2)e3"),
            (1234.0, 123.0, "1.23(12)e3"),
            (123_456.7, 0.2, "123456.7(2)"),
            (6.02214e23, 3e19, "6.0221(3)e23"),
            (9.9999e-10, 2e-13, "1.0000(2)e-9"),
            (9.99996e99, 3e96, "1.0000(3)e100"),
            (1.234e-4, 2e-6, "0.000123(2)"),
            (1.234e-5, 2e-7, "1.23(2)e-5"),
            (9.9996e-5, 3e-8, "0.00010000(3)"),
            (5e-324, 5e-324, "5(5)e-324"),
            (f64::MAX, 3e307, "1.8(3)e308"),
        ] {
            assert_eq!(format_with_error(value, error), text, "{value} {error}");
        }
    }

    #[test]
    fn errors_above_the_value_set_the_digits() {
        for (value, error, text) in [
            (0.0, 3e-9, "0(3)e-9"),
            (0.0, 0.01, "0.000(10)"),
            (-0.0, 0.2, "0.0(2)"),
            (0.001, 0.5, "0.0(5)"),
            (-0.001, 0.5, "0.0(5)"),
            (-0.06, 0.5, "-0.1(5)"),
            (0.04, 0.5, "0.0(5)"),
            (0.06, 14.0, "0(14)"),
            (3.0, 40.0, "0(4)e1"),
            (7.0, 40.0, "1(4)e1"),
            (2.3e-9, 1.4e-8, "0.2(14)e-8"),
        ] {
            assert_eq!(format_with_error(value, error), text, "{value} {error}");
        }
    }

    #[test]
    fn errors_that_fix_no_digit_are_written_in_full() {
        for (value, error, text) in [
            (5.0, f64::INFINITY, "5 ± inf"),
            (-5.25, f64::NAN, "-5.25 ± NaN"),
            (f64::NAN, 0.1, "NaN ± 0.1"),
            (f64::NEG_INFINITY, f64::INFINITY, "-inf ± inf"),
            (5.0, 0.0, "5 ± 0"),
            (0.0, 0.0, "0 ± 0"),
            (1.5e-9, 0.0, "1.5e-9 ± 0"),
            (5.0, -0.5, "5 ± -0.5"),
            (1e300, 1.0, "1e300 ± 1"),
            (0.1, 1e-20, "0.1 ± 1e-20"),
        ] {
            assert_eq!(format_with_error(value, error), text, "{value} {error}");
        }
    }

    /// Value, error and unit of the last digit that a text stands for.
    fn read(text: &str) -> (f64, f64, f64) {
        let (value, rest) = text.split_once('(').unwrap();
        let (error, power) = rest.split_once(')').unwrap();
        let places = value.split_once('.').map_or(0, |(_, fraction)| fraction.len() as i32);
        let exponent: i32 = if power.is_empty() { 0 } else { power[1..].parse().unwrap() };
        let number = |digits: &str, shift: i32| format!("{digits}e{shift}").parse::<f64>().unwrap();
        (number(value, exponent), number(error, exponent - places), number("1", exponent - places))
    }

    proptest! {
        #[test]
        fn the_text_stands_for_the_numbers(
            mantissa in -10.0..10.0f64, decade in -200..200i32, e in 1.0..10.0f64, below in -15..5i32,
        ) {
            let (value, error) = (mantissa * 10f64.powi(decade), e * 10f64.powi(decade + below));
            let text = format_with_error(value, error);
            prop_assume!(!text.contains('±'));
            let (v, s, unit) = read(&text);
            prop_assert!((v - value).abs() <= 0.5 * unit * (1.0 + 1e-9) + 1e-15 * value.abs(), "{text}");
            prop_assert!((s - error).abs() <= 0.5 * unit * (1.0 + 1e-9), "{text}");
            // One digit from 2 to 10, or two from 10 to 20.
            let n = (s / unit).round();
            prop_assert!((2.0..=20.0).contains(&n), "{text}");
        }
    }
}
