use super::super::Function;
use super::{Extrapolation1D, Interpolation1D, Interpolator1DArray};
use crate::MathError;
use proptest::prelude::*;

const KINDS: [Interpolation1D; 3] =
    [Interpolation1D::Linear, Interpolation1D::Cubic, Interpolation1D::Monotone];
const X: [f64; 6] = [-1.0, 0.0, 0.3, 1.1, 2.0, 2.2];
const F: [f64; 6] = [1.0, 3.0, 2.5, 2.5, -1.0, 0.7];

fn through(f: impl Fn(f64) -> f64, x: &[f64], kind: Interpolation1D) -> Interpolator1DArray {
    let values: Vec<f64> = x.iter().map(|&x| f(x)).collect();
    Interpolator1DArray::new(x, &values, kind).unwrap()
}

/// The largest error over the middle half of 0 … 1 with `count` even cells.
fn error(f: fn(f64) -> f64, count: usize, kind: Interpolation1D) -> f64 {
    let x: Vec<f64> = (0..=count).map(|i| i as f64 / count as f64).collect();
    let g = through(f, &x, kind);
    (250..=750).map(|i| f64::from(i) / 1000.0).map(|x| (f(x) - g.evaluate(x)).abs()).fold(0.0, f64::max)
}

#[test]
fn knots_have_their_values() {
    for kind in KINDS {
        let f = Interpolator1DArray::new(&X, &F, kind).unwrap();
        assert!(X.iter().zip(F).all(|(&x, value)| f.evaluate(x) == value), "{kind:?}");
    }
}

#[test]
fn straight_lines_come_back_everywhere() {
    for kind in KINDS {
        for beyond in [Extrapolation1D::Linear, Extrapolation1D::Quadratic] {
            let f = through(|x| 3.0 - 0.5 * x, &X, kind).extrapolate(beyond, f64::INFINITY).unwrap();
            // Near enough that the rounding of two slopes, times the distance squared, stays small.
            for x in [-2.0, -0.6, 0.1, 1.9, 2.1, 3.0] {
                assert!((f.evaluate(x) - 3.0 + 0.5 * x).abs() < 1e-14, "{kind:?} {x}");
                assert!((f.derivative(x, 1) + 0.5).abs() < 1e-14 && f.derivative(x, 2).abs() < 1e-12);
            }
        }
    }
}

#[test]
fn quadratics_come_back_between_inner_knots() {
    let f = through(|x| 1.0 - x + 2.0 * x * x, &X, Interpolation1D::Cubic);
    for x in [0.0, 0.2, 0.7, 1.1, 1.5, 1.99] {
        assert!((f.evaluate(x) - (1.0 - x + 2.0 * x * x)).abs() < 1e-14);
        assert!((f.derivative(x, 1) - (4.0 * x - 1.0)).abs() < 1e-13);
        assert!((f.derivative(x, 2) - 4.0).abs() < 1e-11 && f.derivative(x, 3).abs() < 1e-10);
    }
    // The end pieces have the slope of the line at the end, and cubics do not come back.
    assert!((f.evaluate(-0.5) - 2.0).abs() > 0.01);
    let cubic = through(|x| x * x * x, &X, Interpolation1D::Cubic);
    assert!((cubic.evaluate(0.7) - 0.343).abs() > 0.01);
}

#[test]
fn errors_fall_with_the_order_of_the_method() {
    let f = |x: f64| (7.0 * x).sin();
    for (kind, order) in [(Interpolation1D::Linear, 2.0), (Interpolation1D::Cubic, 3.0)] {
        let measured = (error(f, 128, kind) / error(f, 256, kind)).log2();
        assert!((measured - order).abs() < 0.1, "{kind:?}: {measured}");
    }
}

#[test]
fn a_monotone_curve_is_more_exact_than_a_straight_one() {
    let ratio =
        error(f64::exp, 64, Interpolation1D::Monotone) / error(f64::exp, 128, Interpolation1D::Monotone);
    assert!(ratio.log2() > 2.8, "{ratio}");
}

#[test]
fn a_step_is_not_overshot() {
    let (x, f) = ([0.0, 1.0, 2.0, 3.0, 4.0], [0.0, 0.0, 1.0, 1.0, 1.0]);
    let lowest = |kind| {
        let f = Interpolator1DArray::new(&x, &f, kind).unwrap();
        (0..=400).map(|i| f.evaluate(f64::from(i) / 100.0)).fold(f64::INFINITY, f64::min)
    };
    assert_eq!(lowest(Interpolation1D::Monotone), 0.0);
    assert!(lowest(Interpolation1D::Cubic) < -0.05);
}

/// By scipy's `PchipInterpolator`, which has the same slopes.
#[test]
fn monotone_slopes_are_those_of_pchip() {
    let f = Interpolator1DArray::new(&X, &F, Interpolation1D::Monotone).unwrap();
    for (x, expected) in PCHIP {
        assert!((f.evaluate(x) - expected).abs() < 1e-14, "{x}: {} {expected}", f.evaluate(x));
    }
}

#[test]
fn beyond_the_range_there_is_no_value() {
    let f = Interpolator1DArray::new(&X, &F, Interpolation1D::Cubic).unwrap();
    assert!(
        f.evaluate(-1.0000001).is_nan() && f.evaluate(f64::NAN).is_nan() && f.derivative(2.3, 1).is_nan()
    );
    let f = f.extrapolate(Extrapolation1D::Nearest, 0.5).unwrap();
    assert_eq!((f.evaluate(-1.5), f.evaluate(2.7), f.derivative(2.7, 1)), (1.0, 0.7, 0.0));
    assert!(f.evaluate(-1.5000001).is_nan() && f.evaluate(2.7000001).is_nan());
    assert_eq!(f.checked(3.0), Err(MathError::OutsideGrid { axis: "x", value: 3.0, low: -1.5, high: 2.7 }));
    assert!(f.checked(f64::NAN).is_err() && f.checked(2.7).is_ok());
    let f = f.extrapolate(Extrapolation1D::Nearest, f64::INFINITY).unwrap();
    assert_eq!((f.evaluate(f64::NEG_INFINITY), f.domain()), (1.0, (-1.0, 2.2)));
    let line = f.clone().extrapolate(Extrapolation1D::Linear, f64::INFINITY).unwrap();
    assert!(matches!(line.checked(f64::INFINITY), Err(MathError::Undefined { .. })));
    assert!(f.clone().extrapolate(Extrapolation1D::Nearest, -0.1).is_err());
    assert!(f.extrapolate(Extrapolation1D::Nearest, f64::NAN).is_err());
}

#[test]
fn two_and_three_knots_are_enough() {
    for kind in KINDS {
        let f = Interpolator1DArray::new(&X[..2], &F[..2], kind).unwrap();
        assert_eq!(f.evaluate(-0.5), 2.0, "{kind:?}");
        let f = Interpolator1DArray::new(&X[..3], &F[..3], kind).unwrap();
        assert!(f.evaluate(-0.5).is_finite() && f.evaluate(0.2).is_finite());
    }
}

#[test]
fn faults_of_a_table_are_named_with_their_place() {
    let fault = |x: &[f64], f: &[f64]| {
        Interpolator1DArray::new(x, f, Interpolation1D::Cubic).unwrap_err().to_string()
    };
    assert_eq!(fault(&[1.0], &[1.0]), "the axis x has 1 knots: it needs 2 or more");
    assert_eq!(fault(&[0.0, 1.0, 1.0], &[0.0; 3]), "x[2] = 1 follows 1: knots must ascend");
    assert_eq!(fault(&[0.0, 1.0, 0.5], &[0.0; 3]), "x[2] = 0.5 follows 1: knots must ascend");
    assert_eq!(fault(&[0.0, f64::NAN, 2.0], &[0.0; 3]), "x[1] = NaN is not finite");
    assert_eq!(fault(&[0.0, f64::INFINITY], &[0.0; 2]), "x[1] = inf is not finite");
    assert_eq!(fault(&[0.0, 1.0], &[0.0, f64::NAN]), "f[1] = NaN is not finite");
    assert_eq!(fault(&[0.0, 1.0], &[0.0; 3]), "there are 3 values for a grid of [2] [knots]: it needs 2");
}

proptest! {
    #[test]
    fn slopes_are_those_of_the_curve(
        f in prop::array::uniform6(-1.0..1.0f64), x in -2.9..4.1f64, kind in 0..3usize, beyond in 0..3usize,
    ) {
        let beyond = [Extrapolation1D::Nearest, Extrapolation1D::Linear, Extrapolation1D::Quadratic][beyond];
        let curve = Interpolator1DArray::new(&X, &f, KINDS[kind]).unwrap().extrapolate(beyond, 2.0).unwrap();
        let h = 1e-5;
        prop_assume!(X.iter().all(|knot| (x - knot).abs() > 2.0 * h));
        for order in 0..3 {
            let difference = (curve.derivative(x + h, order) - curve.derivative(x - h, order)) / (2.0 * h);
            let slope = curve.derivative(x, order + 1);
            prop_assert!((slope - difference).abs() < 1e-5 * (1.0 + slope.abs()), "{slope} {difference}");
        }
    }

    #[test]
    fn a_monotone_curve_stays_between_neighbouring_values(
        f in prop::array::uniform6(-1.0..1.0f64), t in 0.0..=1.0f64, cell in 0..5usize,
    ) {
        let curve = Interpolator1DArray::new(&X, &f, Interpolation1D::Monotone).unwrap();
        let value = curve.evaluate(X[cell] + t * (X[cell + 1] - X[cell]));
        let (low, high) = (f[cell].min(f[cell + 1]), f[cell].max(f[cell + 1]));
        prop_assert!(value >= low - 1e-15 && value <= high + 1e-15, "{value} outside {low} … {high}");
    }
}

const PCHIP: [(f64, f64); 7] = [
    (-0.9, 1.4464615384615382),
    (-0.25, 2.9134615384615383),
    (0.2, 2.6296296296296293),
    (0.75, 2.5),
    (1.25, 2.240740740740741),
    (1.9, -0.8799725651577495),
    (2.15, 0.1319602272727246),
];

#[test]
fn integrals_are_those_of_the_curve() {
    // The midpoint rule with 2000 steps per piece, between places on, between and beyond the knots.
    let sum = |f: &Interpolator1DArray, low: f64, high: f64| {
        let mut ends = vec![low, high];
        ends.extend(X.iter().filter(|x| (low..high).contains(*x)));
        ends.sort_by(f64::total_cmp);
        let piece = |ends: &[f64]| {
            let step = (ends[1] - ends[0]) / 2000.0;
            (0..2000).map(|i| f.evaluate(ends[0] + (f64::from(i) + 0.5) * step)).sum::<f64>() * step
        };
        ends.windows(2).map(piece).sum::<f64>()
    };
    for kind in KINDS {
        for beyond in [Extrapolation1D::Nearest, Extrapolation1D::Linear, Extrapolation1D::Quadratic] {
            let f = Interpolator1DArray::new(&X, &F, kind).unwrap().extrapolate(beyond, 1.0).unwrap();
            for (low, high) in
                [(-1.0, 2.2), (-1.5, 3.0), (0.0, 0.3), (0.1, 0.2), (0.15, 1.9), (-2.0, -1.2), (2.2, 3.2)]
            {
                let expected = sum(&f, low, high);
                assert!((f.integral(low, high) - expected).abs() < 2e-6, "{kind:?} {beyond:?} {low} {high}");
                assert_eq!(f.integral(high, low), -f.integral(low, high));
                let average = expected / (high - low);
                assert!((f.average(high, low) - average).abs() < 2e-5, "{kind:?} {beyond:?} {low} {high}");
            }
            // The judge tells a curve that is a thousandth too high.
            assert!((f.integral(-1.0, 2.2) * 1.001 - sum(&f, -1.0, 2.2)).abs() > 1e-3);
        }
    }
}

#[test]
fn integrals_have_no_value_where_the_curve_has_none() {
    let f = Interpolator1DArray::new(&X, &F, Interpolation1D::Cubic).unwrap();
    assert!(
        f.integral(-1.1, 1.0).is_nan() && f.integral(0.0, 2.3).is_nan() && f.integral(f64::NAN, 1.0).is_nan()
    );
    assert!(f.average(3.0, 3.0).is_nan());
    assert_eq!((f.integral(0.3, 0.3), f.average(0.3, 0.3)), (0.0, 2.5));
}
