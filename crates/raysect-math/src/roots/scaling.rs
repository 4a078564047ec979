//! Powers of two that bring a polynomial into the middle of the range of numbers, without rounding.

/// The `e` with 2ᵉ ≤ |x| < 2ᵉ⁺¹, also for subnormal `x`; `x` is finite and not 0.
#[inline]
pub(super) fn exponent(x: f64) -> i32 {
    let field = |x: f64| ((x.to_bits() >> 52) & 0x7ff) as i32;
    match field(x) {
        0 => field(x * 2f64.powi(54)) - 1077,
        normal => normal - 1023,
    }
}

/// 2ᵉ, with `e` cut off at the ends of the normal numbers.
#[inline]
fn power_of_two(e: i32) -> f64 {
    f64::from_bits(((e.clamp(-1022, 1023) + 1023) as u64) << 52)
}

/// x · 2ᵉ for any `e` that matters, exact unless it over- or underflows.
#[inline]
pub(super) fn scale(x: f64, e: i32) -> f64 {
    let third = e / 3;
    x * power_of_two(third) * power_of_two(third) * power_of_two(e - 2 * third)
}

/// True if no product of a coefficient with powers of a root comes near the ends of the range of numbers.
#[inline]
pub(super) fn is_moderate<const M: usize>(c: &[f64; M]) -> bool {
    c.iter().all(|&x| x == 0.0 || exponent(x).abs() <= 64)
}

/// Coefficients of the variable y = x / 2ᵉ with the largest about 1. What underflows beside it is without effect
/// where y is about 1.
#[inline]
pub(super) fn about<const M: usize>(c: &[f64; M], e: i32) -> [f64; M] {
    let size = |i: usize| (c[i] != 0.0).then(|| exponent(c[i]) + e * i as i32);
    let largest = (0..M).filter_map(size).max().unwrap_or(0);
    std::array::from_fn(|i| scale(c[i], e * i as i32 - largest))
}

/// Powers of two between which the sizes of all roots lie, as far as numbers reach (M. Fujiwara, *Über die obere Schranke des absoluten
/// Betrages der Wurzeln einer algebraischen Gleichung*, Tôhoku Math. J. 10, 1916), for the polynomial and, for the
/// lower one, for the polynomial of the reciprocals. The first and last coefficient must not be 0.
#[inline]
pub(super) fn root_sizes<const M: usize>(c: &[f64; M]) -> (f64, f64) {
    let ceiling = |a: i32, b: i32| (a + b - 1).div_euclid(b);
    let (first, last) = (exponent(c[0]), exponent(c[M - 1]));
    let (mut low, mut high) = (i32::MIN, i32::MIN);
    for i in 0..M {
        if c[i] != 0.0 {
            let e = exponent(c[i]) + 1;
            if i > 0 {
                low = low.max(ceiling(e - first, i as i32));
            }
            if i + 1 < M {
                high = high.max(ceiling(e - last, (M - 1 - i) as i32));
            }
        }
    }
    (scale(1.0, -(low + 1)).max(5e-324), power_of_two(high + 1))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exponents_of_all_numbers() {
        for (x, e) in
            [(1.0, 0), (1.9, 0), (2.0, 1), (-0.75, -1), (f64::MAX, 1023), (f64::MIN_POSITIVE, -1022)]
        {
            assert_eq!(exponent(x), e);
        }
        assert_eq!((exponent(5e-324), exponent(-1e-310)), (-1074, -1030));
        assert_eq!((scale(1.5, -1074), scale(5e-324, 2000)), (1e-323, 2f64.powi(926)));
    }

    #[test]
    fn bounds_hold_the_roots() {
        // (x − 1) (x − 1000)
        let (low, high) = root_sizes(&[1000.0, -1001.0, 1.0]);
        assert!((0.1..=1.0).contains(&low) && (1000.0..5000.0).contains(&high));
        assert_eq!(root_sizes(&[1e-300, 1e300]), (5e-324, 2f64.powi(-1022)));
        assert_eq!(root_sizes(&[1e300, 1e-300]).1, 2f64.powi(1023));
    }
}
