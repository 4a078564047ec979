//! The pieces of comma separated values that every table needs.

use std::borrow::Cow;

/// A text as a field of a table of comma separated values: quoted if it has a comma, a quotation mark or a line break
/// (RFC 4180).
pub fn csv_text(text: &str) -> Cow<'_, str> {
    if text.contains([',', '"', '\n', '\r']) {
        Cow::Owned(format!("\"{}\"", text.replace('"', "\"\"")))
    } else {
        Cow::Borrowed(text)
    }
}

/// A number with the fewest digits that bring every bit back, with an exponent where they would be many; infinities are
/// `inf`, what is not a number is `NaN`.
pub fn csv_number(number: f64) -> String {
    let size = number.abs();
    if size == 0.0 || (1e-4..1e16).contains(&size) || !number.is_finite() {
        return number.to_string();
    }
    format!("{number:e}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texts_are_quoted_where_they_must_be() {
        assert_eq!(csv_text("radiance [W/m²/sr/nm]"), "radiance [W/m²/sr/nm]");
        assert_eq!(csv_text("a, \"b\""), "\"a, \"\"b\"\"\"");
    }

    #[test]
    fn every_bit_of_a_number_comes_back() {
        for x in [0.1, -0.0, 1.0 / 3.0, 1e-310, f64::MAX, f64::MIN_POSITIVE, -5e15, f64::NEG_INFINITY] {
            let text = csv_number(x);
            assert_eq!(text.parse::<f64>().map(f64::to_bits), Ok(x.to_bits()), "{text}");
            assert!(text.len() < 26, "{text}");
        }
    }
}
