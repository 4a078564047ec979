use std::sync::Arc;

use super::*;
use crate::{MathError, Vector3D};
use proptest::prelude::*;

#[test]
fn arithmetic_is_that_of_the_values() {
    let f = (Arg::X + Arg::Y * 2.0 - 1.0 / Arg::Z) % 4.0;
    assert_eq!(f.evaluate((1.0, 2.0, 0.5)), 3.0);
    assert_eq!((-Arg::X % 3.0).evaluate(1.0), -1.0);
    assert_eq!((2.0 - Arg::X - |x: f64| x * x).evaluate(3.0), -10.0);
    assert_eq!((Arg::X.pow(3.0) % 5.0).evaluate(2.0), 3.0);
    assert_eq!(Arg::Y.atan2(Arg::X).evaluate((-1.0, 0.0)), std::f64::consts::PI);
    assert_eq!(function(4.0).pow(Arg::X).evaluate(0.5), 2.0);
}

#[test]
fn comparisons_yield_one_and_zero() {
    let all = |x: f64| {
        [
            Arg::X.equal(1.0).evaluate(x),
            Arg::X.not_equal(1.0).evaluate(x),
            Arg::X.less(1.0).evaluate(x),
            Arg::X.less_equal(1.0).evaluate(x),
            Arg::X.greater(1.0).evaluate(x),
            Arg::X.greater_equal(1.0).evaluate(x),
        ]
    };
    assert_eq!(all(0.0), [0.0, 1.0, 1.0, 1.0, 0.0, 0.0]);
    assert_eq!(all(1.0), [1.0, 0.0, 0.0, 1.0, 0.0, 1.0]);
    assert_eq!(all(2.0), [0.0, 1.0, 0.0, 0.0, 1.0, 1.0]);
}

#[test]
fn outside_the_domain_there_is_no_number_and_an_error_on_demand() {
    assert!(Arg::X.sqrt().evaluate(-1.0).is_nan() && Arg::X.asin().evaluate(1.1).is_nan());
    assert!(Arg::X.pow(0.5).evaluate(-1.0).is_nan() && (Arg::X % 0.0).evaluate(1.0).is_nan());
    assert_eq!((1.0 / Arg::X).evaluate(0.0), f64::INFINITY);
    let error = (1.0 / (Arg::X - Arg::Y)).checked((2.0, 2.0)).unwrap_err();
    assert!(matches!(&error, MathError::Undefined { at, .. } if at == &[2.0, 2.0]), "{error}");
    assert_eq!(Arg::X.ln().checked(1.0), Ok(0.0));
    let spoilt = components(1.0, Arg::X.sqrt(), 0.0);
    assert_eq!(spoilt.checked(-1.0).unwrap_err().to_string(), "f(-1) = 1, NaN, 0 is not finite");
}

#[test]
fn shared_functions_are_functions() {
    let shared: Arc<dyn Function2D> = Arc::new(Arg::X * Arg::Y);
    let twice = function(shared.clone()) + shared;
    assert_eq!(twice.evaluate((2.0, 3.0)), 12.0);
    let field: Arc<dyn VectorFunction1D> = Arc::new(|x: f64| Vector3D::X * x);
    assert_eq!((function(field) * 2.0).evaluate(3.0), Vector3D::X * 6.0);
}

#[test]
fn vectors_have_their_algebra() {
    let field = components(Arg::X, 1.0, -Arg::Y);
    let f = (field * Arg::X + Vector3D::Z) / 2.0 - field;
    assert_eq!(f.evaluate((4.0, 6.0)), Vector3D::new(4.0, 1.0, -5.5));
    assert_eq!((Vector3D::X * Arg::X).evaluate(2.0), Vector3D::X * 2.0);
    assert_eq!((3.0 * -function(Vector3D::Y)).evaluate(0.0), Vector3D::Y * -3.0);
    assert_eq!(field.equal(Vector3D::new(1.0, 1.0, -2.0)).evaluate((1.0, 2.0)), 1.0);
    assert_eq!(field.not_equal(Vector3D::new(1.0, 1.0, -2.0)).evaluate((1.0, 2.0)), 0.0);
}

#[test]
fn a_blend_clamps_its_mask_and_leaves_out_what_does_not_count() {
    let f = blend(Arg::X.sqrt(), Arg::X, Arg::X / -4.0 + 1.0);
    assert_eq!((f.evaluate(9.0), f.evaluate(4.0), f.evaluate(-1.0)), (3.0, 2.0, -1.0));
    assert_eq!(f.evaluate(1.0), 1.0);
    assert_eq!(f.evaluate(2.0), 0.5 * 2f64.sqrt() + 1.0);
    assert!(blend(1.0, 2.0, f64::NAN).evaluate(0.0).is_nan());
}

#[test]
fn a_blend_of_vectors_turns() {
    let half = blend(Vector3D::X, Vector3D::Y * 3.0, 0.5).evaluate(0.0);
    assert!((half - Vector3D::new(1.0, 1.0, 0.0) * 2f64.sqrt()).length() < 1e-15);
    // The linear passage would be shorter.
    assert!((half - Vector3D::new(0.5, 1.5, 0.0)).length() > 0.5);
    assert_eq!(blend(Vector3D::ZERO, Vector3D::Y, 0.25).evaluate(0.0), Vector3D::Y * 0.25);
}

/// 2/√π Σ (−1)ⁿ x²ⁿ⁺¹ / (n! (2n + 1)) (Abramowitz and Stegun 1964, 7.1.5), good to rounding for |x| < 1.
fn erf_series(x: f64) -> f64 {
    let mut power = x;
    let mut sum = x;
    for n in 1..40 {
        power *= -x * x / f64::from(n);
        sum += power / f64::from(2 * n + 1);
    }
    sum * std::f64::consts::FRAC_2_SQRT_PI
}

#[test]
fn the_error_function_is_good_to_rounding() {
    for i in -100..=100 {
        let x = f64::from(i) / 100.0;
        let (value, expected) = (Arg::X.erf().evaluate(x), erf_series(x));
        assert!((value - expected).abs() <= 4.0 * f64::EPSILON * expected.abs(), "{x}: {value} {expected}");
    }
    // erfc(2) to the last digit.
    assert!((1.0 - Arg::X.erf().evaluate(2.0) - 0.004_677_734_981_047_266).abs() < 2e-16);
    assert_eq!(Arg::X.erf().evaluate(40.0), 1.0);
}

#[test]
fn nothing_is_stored_but_what_has_a_size() {
    assert_eq!(size_of_val(&(Arg::X.sqrt() + Arg::Y.exp() * 2.0)), size_of::<f64>());
}

proptest! {
    #[test]
    fn an_expression_is_its_closure(x in -5.0..5.0f64, y in -5.0..5.0f64) {
        let f = (Arg::X * Arg::Y).sin().abs().sqrt() + (Arg::X - 2.0 * Arg::Y).atan().exp().ln() / 3.0 - Arg::Y.cos();
        let closure = |x: f64, y: f64| (x * y).sin().abs().sqrt() + (x - 2.0 * y).atan().exp().ln() / 3.0 - y.cos();
        prop_assert_eq!(f.evaluate((x, y)), closure(x, y));
        prop_assert_eq!(Arg::X.exp().of(function2d(closure)).evaluate((x, y)), closure(x, y).exp());
    }
}
