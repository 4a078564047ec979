//! Arithmetic with 32 digits, for expected values in tests.

use std::ops::{Add, Div, Mul, Neg, Sub};

/// The unevaluated sum of two doubles (Y. Hida, X. Li, D. Bailey, *Algorithms for Quad-Double Precision Floating Point
/// Arithmetic*, 2001, § 3).
#[derive(Debug, Clone, Copy, PartialEq, PartialOrd)]
pub(crate) struct Dd(f64, f64);

/// A double as it is.
pub(crate) fn dd(x: f64) -> Dd {
    Dd(x, 0.0)
}

fn two_sum(a: f64, b: f64) -> Dd {
    let s = a + b;
    let v = s - a;
    Dd(s, (a - (s - v)) + (b - v))
}

fn quick(a: f64, b: f64) -> Dd {
    let s = a + b;
    Dd(s, b - (s - a))
}

impl Dd {
    /// The nearest double.
    pub(crate) fn value(self) -> f64 {
        self.0 + self.1
    }

    /// Of a number of 0 or more.
    pub(crate) fn sqrt(self) -> Self {
        if self.0 <= 0.0 {
            return dd(0.0);
        }
        let x = dd(self.0.sqrt());
        // Two steps of Heron's rule double the digits twice.
        let x = (x + self / x) * dd(0.5);
        (x + self / x) * dd(0.5)
    }
}

impl Add for Dd {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        let (s, t) = (two_sum(self.0, other.0), two_sum(self.1, other.1));
        let s = quick(s.0, s.1 + t.0);
        quick(s.0, s.1 + t.1)
    }
}

impl Neg for Dd {
    type Output = Self;
    fn neg(self) -> Self {
        Self(-self.0, -self.1)
    }
}

impl Sub for Dd {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for Dd {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        let p = self.0 * other.0;
        let error = self.0.mul_add(other.0, -p) + (self.0 * other.1 + self.1 * other.0);
        quick(p, error)
    }
}

impl Div for Dd {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        let first = self.0 / other.0;
        let rest = self - other * dd(first);
        let second = rest.0 / other.0;
        let rest = rest - other * dd(second);
        quick(first, second) + dd(rest.0 / other.0)
    }
}

#[test]
fn digits_are_kept() {
    let third = dd(1.0) / dd(3.0);
    let one = third + third + third - dd(1.0);
    assert!(one.value().abs() < 1e-31, "{one:?}");
    let two = dd(2.0).sqrt() * dd(2.0).sqrt() - dd(2.0);
    assert!(two.value().abs() < 1e-31, "{two:?}");
    let small = (dd(1e15) + dd(1.0)) * (dd(1e15) - dd(1.0)) - dd(1e15) * dd(1e15);
    assert_eq!(small.value(), -1.0);
}
