use super::super::{Arg, Function, sample2d, sample3d};
use super::{
    Extrapolation, Extrapolation1D, Interpolation, Interpolation1D, Interpolator1DArray, Interpolator2DArray,
    Interpolator3DArray,
};
use crate::MathError;
use proptest::prelude::*;

const KINDS: [Interpolation; 2] = [Interpolation::Linear, Interpolation::Cubic];
const BEYOND: [Extrapolation; 2] = [Extrapolation::Nearest, Extrapolation::Linear];
const X: [f64; 5] = [-1.0, 0.0, 0.3, 1.1, 2.0];
const Y: [f64; 6] = [0.0, 0.5, 0.7, 1.5, 1.6, 2.5];
const Z: [f64; 4] = [3.0, 3.5, 4.5, 5.0];

fn grid2(f: impl Fn(f64, f64) -> f64) -> Vec<f64> {
    X.iter().flat_map(|&x| Y.map(|y| f(x, y))).collect()
}

fn grid3(f: impl Fn(f64, f64, f64) -> f64) -> Vec<f64> {
    X.iter()
        .flat_map(|&x| Y.iter().flat_map(move |&y| Z.map(|z| (x, y, z))))
        .map(|(x, y, z)| f(x, y, z))
        .collect()
}

fn numbers(count: usize) -> impl Strategy<Value = Vec<f64>> {
    prop::collection::vec(-1.0..1.0f64, count)
}

#[test]
fn knots_have_their_values() {
    let f = |x: f64, y: f64, z: f64| (3.0 * x).sin() * y + z * y * y;
    for kind in KINDS {
        let plane = Interpolator2DArray::new(&X, &Y, &grid2(|x, y| f(x, y, 3.0)), kind).unwrap();
        let space = Interpolator3DArray::new(&X, &Y, &Z, &grid3(f), kind).unwrap();
        for (x, y) in X.iter().flat_map(|&x| Y.map(|y| (x, y))) {
            assert_eq!(plane.evaluate((x, y)), f(x, y, 3.0));
            assert!(Z.iter().all(|&z| space.evaluate((x, y, z)) == f(x, y, z)));
        }
    }
}

#[test]
fn products_of_straight_lines_come_back_everywhere() {
    let f = |x: f64, y: f64, z: f64| (1.0 - x) * (2.0 + y) * (z - 4.0) + x * y;
    for kind in KINDS {
        let plane = Interpolator2DArray::new(&X, &Y, &grid2(|x, y| f(x, y, 3.0)), kind).unwrap();
        let plane = plane.extrapolate(Extrapolation::Linear, 1.0, 1.0).unwrap();
        let space = Interpolator3DArray::new(&X, &Y, &Z, &grid3(f), kind).unwrap();
        let space = space.extrapolate(Extrapolation::Linear, 1.0, 1.0, 1.0).unwrap();
        for x in [-1.7, 0.1, 2.9] {
            for y in [-0.4, 1.0, 3.3] {
                assert!((plane.evaluate((x, y)) - f(x, y, 3.0)).abs() < 1e-13);
                for z in [2.1, 4.0, 5.9] {
                    assert!((space.evaluate((x, y, z)) - f(x, y, z)).abs() < 1e-13);
                }
            }
        }
    }
}

#[test]
fn quadratics_come_back_inside_an_even_grid() {
    let f = 1.0 + Arg::X * Arg::X * Arg::Y * Arg::Y * Arg::Z * Arg::Z - Arg::X * Arg::Y * Arg::Y;
    let axis = (0.0, 1.0, 6);
    let ([x, y, z], values) = sample3d(&f, axis, axis, axis).unwrap();
    let space = Interpolator3DArray::new(&x, &y, &z, &values, Interpolation::Cubic).unwrap();
    for at in [(0.3, 0.5, 0.7), (0.25, 0.75, 0.45)] {
        assert!((space.evaluate(at) - f.evaluate(at)).abs() < 1e-14);
        let (x, y, z) = at;
        assert!((space.derivative(at, (1, 0, 0)) - (2.0 * x * y * y * z * z - y * y)).abs() < 1e-13);
        assert!((space.derivative(at, (2, 1, 0)) - 4.0 * y * z * z).abs() < 1e-11);
        assert!((space.derivative(at, (2, 2, 2)) - 8.0).abs() < 1e-9);
    }
    // Next to the edges they do not.
    assert!((space.evaluate((0.1, 0.5, 0.7)) - f.evaluate((0.1, 0.5, 0.7))).abs() > 1e-4);
}

/// The largest error in the middle of 0 … 1 squared with even cells.
fn error(count: usize, kind: Interpolation) -> f64 {
    let f = (7.0 * Arg::X).sin() * (4.0 * Arg::Y).cos();
    let axis = (0.0, 1.0, count + 1);
    let ([x, y], values) = sample2d(&f, axis, axis).unwrap();
    let g = Interpolator2DArray::new(&x, &y, &values, kind).unwrap();
    let middle = (0.25, 0.75, 301);
    let (_, errors) = sample2d(&(f - g), middle, middle).unwrap();
    errors.iter().fold(0.0, |largest: f64, error| largest.max(error.abs()))
}

#[test]
fn errors_fall_with_the_order_of_the_method() {
    for (kind, order) in [(Interpolation::Linear, 2.0), (Interpolation::Cubic, 3.0)] {
        let measured = (error(64, kind) / error(128, kind)).log2();
        assert!((measured - order).abs() < 0.1, "{kind:?}: {measured}");
    }
}

#[test]
fn beyond_the_range_there_is_no_value() {
    let f = Interpolator2DArray::new(&X, &Y, &grid2(|x, y| x + y), Interpolation::Cubic).unwrap();
    assert!(f.evaluate((-1.1, 0.5)).is_nan() && f.evaluate((0.0, f64::NAN)).is_nan());
    let f = f.extrapolate(Extrapolation::Nearest, 0.5, f64::INFINITY).unwrap();
    assert_eq!((f.evaluate((-1.5, 1e9)), f.evaluate((2.0, f64::NEG_INFINITY))), (1.5, 2.0));
    assert_eq!(f.derivative((-1.2, 1.0), (1, 0)), 0.0);
    assert!((f.derivative((-1.2, 1.0), (0, 1)) - 1.0).abs() < 1e-14);
    let wrong = MathError::OutsideGrid { axis: "x", value: 2.6, low: -1.5, high: 2.5 };
    assert_eq!(f.checked((2.6, 0.0)), Err(wrong));
    assert_eq!(f.domain(), [(-1.0, 2.0), (0.0, 2.5)]);
    assert!(f.extrapolate(Extrapolation::Linear, 0.0, -1.0).is_err());
    let f = Interpolator3DArray::new(&X, &Y, &Z, &grid3(|x, _, _| x), Interpolation::Linear).unwrap();
    assert!(f.evaluate((0.0, 0.0, 5.1)).is_nan());
    assert!(matches!(f.checked((0.0, 0.0, 5.1)), Err(MathError::OutsideGrid { axis: "z", .. })));
}

#[test]
fn faults_of_a_table_are_named_with_their_place() {
    let mut values = grid2(|x, y| x + y);
    values[2 * Y.len() + 4] = f64::NAN;
    let fault = |x: &[f64], y: &[f64], f: &[f64]| {
        Interpolator2DArray::new(x, y, f, Interpolation::Cubic).unwrap_err().to_string()
    };
    assert_eq!(fault(&X, &Y, &values), "f[2, 4] = NaN is not finite");
    assert_eq!(fault(&X, &[1.0, 2.0, 2.0], &values), "y[2] = 2 follows 2: knots must ascend");
    assert_eq!(fault(&X, &Y[..5], &values), "there are 30 values for a grid of [5, 5] [knots]: it needs 25");
    let mut values = grid3(|x, y, _| x + y);
    values[(3 * Y.len() + 1) * Z.len() + 2] = f64::NEG_INFINITY;
    let error = Interpolator3DArray::new(&X, &Y, &Z, &values, Interpolation::Linear).unwrap_err();
    assert_eq!(error.to_string(), "f[3, 1, 2] = -inf is not finite");
    assert!(Interpolator3DArray::new(&X, &Y, &Z[..1], &values, Interpolation::Linear).is_err());
}

#[test]
fn two_and_three_knots_are_enough() {
    let f = Interpolator2DArray::new(&X[..2], &Y[..3], &[0.0, 1.0, 1.4, 1.0, 2.0, 2.4], Interpolation::Cubic);
    let f = f.unwrap().extrapolate(Extrapolation::Linear, 1.0, 1.0).unwrap();
    for (x, y) in [(-0.5, 0.2), (-1.5, -0.5), (0.5, 0.6), (0.0, 1.7)] {
        assert!((f.evaluate((x, y)) - (1.0 + x + 2.0 * y)).abs() < 1e-14);
    }
}

#[test]
fn units_of_the_variables_and_values_do_not_matter() {
    let f = |x: f64, y: f64, z: f64| (3.0 * x).sin() * y + z * y * y;
    let scaled = |knots: &[f64], unit: f64| knots.iter().map(|x| x * unit).collect::<Vec<f64>>();
    // Powers of two: the knots are the same ones.
    for (unit, unit_f) in
        [2f64.powi(-530), 2f64.powi(530)].into_iter().flat_map(|u| [(u, 1.0), (u, u), (1.0, u)])
    {
        let values = scaled(&grid3(f), unit_f);
        for (kind, beyond) in KINDS.into_iter().zip(BEYOND) {
            let [x, y, z] = [&X[..], &Y, &Z].map(|knots| scaled(knots, unit));
            let space = Interpolator3DArray::new(&x, &y, &z, &values, kind).unwrap();
            let space = space.extrapolate(beyond, unit, unit, unit).unwrap();
            let plain = Interpolator3DArray::new(&X, &Y, &Z, &grid3(f), kind).unwrap();
            let plain = plain.extrapolate(beyond, 1.0, 1.0, 1.0).unwrap();
            for (x, y, z) in [(0.2, 0.9, 3.3), (-1.7, 0.6, 4.6), (1.4, 3.1, 2.4)] {
                let (ours, expected) =
                    (space.evaluate((x * unit, y * unit, z * unit)), plain.evaluate((x, y, z)));
                assert!(
                    (ours / unit_f - expected).abs() < 1e-14,
                    "{unit} {unit_f} {kind:?}: {ours} {expected}"
                );
            }
        }
        let values: Vec<f64> = X.map(|x| f(x, 1.0, 0.0)).to_vec();
        for kind in [Interpolation1D::Linear, Interpolation1D::Cubic, Interpolation1D::Monotone] {
            let curve = Interpolator1DArray::new(&scaled(&X, unit), &scaled(&values, unit_f), kind).unwrap();
            let curve = curve.extrapolate(Extrapolation1D::Quadratic, unit).unwrap();
            let plain = Interpolator1DArray::new(&X, &values, kind).unwrap();
            let plain = plain.extrapolate(Extrapolation1D::Quadratic, 1.0).unwrap();
            for x in [-1.9, -0.3, 0.25, 1.0, 2.8] {
                let (ours, expected) = (curve.evaluate(x * unit), plain.evaluate(x));
                assert!(
                    (ours / unit_f - expected).abs() < 1e-14,
                    "{unit} {unit_f} {kind:?}: {ours} {expected}"
                );
            }
        }
    }
}

proptest! {
    #[test]
    fn a_surface_of_one_variable_is_the_curve(
        f in numbers(X.len()), x in -1.0..2.0f64, y in 0.0..2.5f64, z in 3.0..5.0f64,
    ) {
        let curve = Interpolator1DArray::new(&X, &f, Interpolation1D::Cubic).unwrap();
        let along = |x: f64| curve.evaluate(x);
        let plane = Interpolator2DArray::new(&X, &Y, &grid2(|x, _| along(x)), Interpolation::Cubic).unwrap();
        let space = Interpolator3DArray::new(&X, &Y, &Z, &grid3(|x, _, _| along(x)), Interpolation::Cubic).unwrap();
        prop_assert!((plane.evaluate((x, y)) - along(x)).abs() < 1e-14);
        prop_assert!((space.evaluate((x, y, z)) - along(x)).abs() < 1e-14);
    }

    #[test]
    fn slopes_are_those_of_the_surface(
        f in numbers(X.len() * Y.len()), x in -1.9..2.9f64, y in -0.9..3.4f64, kind in 0..2usize, beyond in 0..2usize,
    ) {
        let surface = Interpolator2DArray::new(&X, &Y, &f, KINDS[kind]).unwrap();
        let surface = surface.extrapolate(BEYOND[beyond], 1.0, 1.0).unwrap();
        let h = 1e-5;
        prop_assume!(X.iter().all(|knot| (x - knot).abs() > h) && Y.iter().all(|knot| (y - knot).abs() > h));
        for (i, j) in [(0, 0), (1, 0), (0, 1), (1, 1), (2, 1)] {
            let at = |x, y| surface.derivative((x, y), (i, j));
            for (slope, difference) in [
                (surface.derivative((x, y), (i + 1, j)), (at(x + h, y) - at(x - h, y)) / (2.0 * h)),
                (surface.derivative((x, y), (i, j + 1)), (at(x, y + h) - at(x, y - h)) / (2.0 * h)),
            ] {
                prop_assert!((slope - difference).abs() < 1e-4 * (1.0 + slope.abs()), "{} {}", slope, difference);
            }
        }
    }

    #[test]
    fn values_and_slopes_are_continuous_across_knots_and_edges(
        f in numbers(X.len() * Y.len() * Z.len()), knot in 0..X.len(), y in 0.0..2.5f64, z in 3.0..5.0f64,
    ) {
        let space = Interpolator3DArray::new(&X, &Y, &Z, &f, Interpolation::Cubic).unwrap();
        let space = space.extrapolate(Extrapolation::Linear, 1.0, 1.0, 1.0).unwrap();
        let (below, above) = (X[knot] - 1e-9, X[knot] + 1e-9);
        for orders in [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1), (1, 1, 0)] {
            let jump = space.derivative((above, y, z), orders) - space.derivative((below, y, z), orders);
            prop_assert!(jump.abs() < 1e-4, "{jump}");
        }
    }

    #[test]
    fn the_variables_are_alike(
        f in numbers(X.len() * Y.len() * Z.len()), x in -1.5..2.5f64, y in -0.5..3.0f64, z in 2.5..5.5f64,
    ) {
        let turned: Vec<f64> = (0..Z.len())
            .flat_map(|k| (0..X.len()).flat_map(move |i| (0..Y.len()).map(move |j| (i * Y.len() + j) * Z.len() + k)))
            .map(|index| f[index])
            .collect();
        for kind in KINDS {
            let one = Interpolator3DArray::new(&X, &Y, &Z, &f, kind).unwrap();
            let other = Interpolator3DArray::new(&Z, &X, &Y, &turned, kind).unwrap();
            let one = one.extrapolate(Extrapolation::Linear, 1.0, 1.0, 1.0).unwrap();
            let other = other.extrapolate(Extrapolation::Linear, 1.0, 1.0, 1.0).unwrap();
            prop_assert!((one.evaluate((x, y, z)) - other.evaluate((z, x, y))).abs() < 1e-12);
        }
    }
}
