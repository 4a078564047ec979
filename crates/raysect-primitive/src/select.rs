//! The larger and the smaller of two numbers, each in one instruction: neither may be a NaN, which `f64::max` and
//! `f64::min` look for.

/// The larger of two numbers, the first among equals.
#[inline(always)]
pub(crate) fn larger(a: f64, b: f64) -> f64 {
    if b > a { b } else { a }
}

/// The smaller of two numbers, the first among equals.
#[inline(always)]
pub(crate) fn smaller(a: f64, b: f64) -> f64 {
    if b < a { b } else { a }
}
