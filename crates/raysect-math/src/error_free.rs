//! Sums and products with their rounding error, and what can be had from them.
//!
//! Products are split instead of fused, so that every processor gives the same bits.

/// The rounded sum of two numbers and its error: `a + b` is exactly the sum of both (D. E. Knuth, *The Art of
/// Computer Programming* 2, section 4.2.2).
///
/// ```
/// assert_eq!(raysect_math::error_free::two_sum(1.0, 1e-20), (1.0, 1e-20));
/// ```
#[inline]
pub fn two_sum(a: f64, b: f64) -> (f64, f64) {
    let sum = a + b;
    let b_part = sum - a;
    (sum, (a - (sum - b_part)) + (b - b_part))
}

/// The rounded product of two numbers and its error: `a · b` is exactly the sum of both (T. J. Dekker, *A
/// floating-point technique for extending the available precision*, Numer. Math. 18, 1971).
///
/// Exact for factors below 2⁹⁹⁵ whose product lies in 2⁻⁹⁶⁰ … 2¹⁰²³ in size.
#[inline]
pub fn two_product(a: f64, b: f64) -> (f64, f64) {
    let product = a * b;
    let ((a_high, a_low), (b_high, b_low)) = (split(a), split(b));
    let error = a_low * b_low - (((product - a_high * b_high) - a_low * b_high) - a_high * b_low);
    (product, error)
}

/// The upper 26 bits of a number and the rest (G. W. Veltkamp).
#[inline]
fn split(a: f64) -> (f64, f64) {
    const SPLITTER: f64 = 134_217_729.0;
    let wide = SPLITTER * a;
    let high = wide - (wide - a);
    (high, a - high)
}

/// `a · b − c · d` with a relative error of a few roundings, and with the right sign, however nearly the products
/// cancel; within the range of [`two_product`].
#[inline]
pub fn difference_of_products(a: f64, b: f64, c: f64, d: f64) -> f64 {
    let ((left, left_error), (right, right_error)) = (two_product(a, b), two_product(c, d));
    (left - right) + (left_error - right_error)
}

/// `a + b · c`, rounded about once, however nearly the terms cancel; within the range of [`two_product`].
#[inline]
pub fn add_product(a: f64, b: f64, c: f64) -> f64 {
    let (product, product_error) = two_product(b, c);
    let (sum, sum_error) = two_sum(a, product);
    sum + (sum_error + product_error)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// A number with a random fraction of 53 bits, as integer and exponent.
    fn parts(x: f64) -> (i128, i32) {
        let bits = x.to_bits();
        let (exponent, fraction) = (((bits >> 52) & 0x7ff) as i32, (bits & ((1 << 52) - 1)) as i128);
        let mantissa = if exponent == 0 { fraction } else { fraction | (1 << 52) };
        (if x < 0.0 { -mantissa } else { mantissa }, exponent.max(1) - 1075)
    }

    proptest! {
        #[test]
        fn products_are_exact(a in -1e3..1e3f64, b in -1e3..1e3f64) {
            prop_assume!(a.abs() > 1e-6 && b.abs() > 1e-6);
            let (product, error) = two_product(a, b);
            let ((am, ae), (bm, be), (pm, pe)) = (parts(a), parts(b), parts(product));
            // Compared in units of the last bit of the exact product, in integers.
            let rest = am * bm - (pm << (pe - ae - be));
            prop_assert_eq!(rest as f64 * 2f64.powi(ae + be), error);
        }

        #[test]
        fn sums_are_exact(a in -1e3..1e3f64, b in -1e-6..1e-6f64) {
            prop_assume!(b.abs() > 1e-20 && a.abs() > 1e-3);
            let (sum, error) = two_sum(a, b);
            prop_assert_eq!(sum, a + b);
            let unit = parts(a).1.min(parts(b).1).min(parts(sum).1);
            let whole = |x: f64| parts(x).0 << (parts(x).1 - unit);
            prop_assert_eq!((whole(a) + whole(b) - whole(sum)) as f64 * 2f64.powi(unit), error);
        }
    }

    #[test]
    fn cancelling_products_keep_their_sign() {
        let x = 1.0 + f64::EPSILON;
        // x² − (1 + 2ε) · 1 = ε²
        assert_eq!(x * x - (1.0 + 2.0 * f64::EPSILON), 0.0, "plain arithmetic loses it");
        assert_eq!(difference_of_products(x, x, 1.0 + 2.0 * f64::EPSILON, 1.0), f64::EPSILON.powi(2));
        assert_eq!(add_product(-(1.0 + 2.0 * f64::EPSILON), x, x), f64::EPSILON.powi(2));
    }
}
