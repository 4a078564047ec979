//! Interpolators against those of Raysect 0.9.1.

use raysect_math::function::{
    Extrapolation, Extrapolation1D, Function, Interpolation, Interpolation1D, Interpolator1DArray,
    Interpolator2DArray, Interpolator3DArray,
};

/// Two implementations in double precision agree to 1e-9 of the largest value of the grid.
const TOLERANCE: f64 = 1e-9;

#[derive(Default)]
struct Case {
    axes: Vec<Vec<f64>>,
    values: Vec<f64>,
    /// Interpolation, extrapolation, place, value.
    points: Vec<(String, String, Vec<f64>, f64)>,
}

fn cases() -> Vec<Case> {
    let mut cases: Vec<Case> = Vec::new();
    for line in include_str!("data/interpolation.txt").lines().filter(|line| !line.starts_with('#')) {
        let mut words = line.split_whitespace();
        let head = words.next().unwrap();
        if head == "case" {
            cases.push(Case::default());
            continue;
        }
        let case = cases.last_mut().unwrap();
        let mut word = || if head == "at" { words.next().unwrap().to_owned() } else { String::new() };
        let (interpolation, extrapolation) = (word(), word());
        let mut numbers: Vec<f64> = words.map(|word| word.parse().unwrap()).collect();
        match head {
            "at" => {
                let value = numbers.pop().unwrap();
                case.points.push((interpolation, extrapolation, numbers, value));
            }
            "f" => case.values = numbers,
            _ => case.axes.push(numbers),
        }
    }
    cases
}

fn kind(interpolation: &str) -> Interpolation {
    if interpolation == "linear" { Interpolation::Linear } else { Interpolation::Cubic }
}

fn beyond(extrapolation: &str) -> Extrapolation {
    if extrapolation == "linear" { Extrapolation::Linear } else { Extrapolation::Nearest }
}

/// The value of ours at one of the points.
fn value(case: &Case, interpolation: &str, extrapolation: &str, at: &[f64]) -> f64 {
    match case.axes.len() {
        1 => {
            let kind =
                if interpolation == "linear" { Interpolation1D::Linear } else { Interpolation1D::Cubic };
            let f = Interpolator1DArray::new(&case.axes[0], &case.values, kind).unwrap();
            let beyond = match extrapolation {
                "none" => return f.evaluate(at[0]),
                "nearest" => Extrapolation1D::Nearest,
                "linear" => Extrapolation1D::Linear,
                _ => Extrapolation1D::Quadratic,
            };
            f.extrapolate(beyond, 1.0).unwrap().evaluate(at[0])
        }
        2 => {
            let f = Interpolator2DArray::new(&case.axes[0], &case.axes[1], &case.values, kind(interpolation));
            let range = if extrapolation == "none" { 0.0 } else { 1.0 };
            let f = f.unwrap().extrapolate(beyond(extrapolation), range, range).unwrap();
            f.evaluate((at[0], at[1]))
        }
        _ => {
            let [x, y, z] = [0, 1, 2].map(|axis| case.axes[axis].as_slice());
            let f = Interpolator3DArray::new(x, y, z, &case.values, kind(interpolation)).unwrap();
            let range = if extrapolation == "none" { 0.0 } else { 1.0 };
            let f = f.extrapolate(beyond(extrapolation), range, range, range).unwrap();
            f.evaluate((at[0], at[1], at[2]))
        }
    }
}

/// The number of points, and of those where ours is within the tolerance of the expected value.
fn agreement(case: &Case, value: impl Fn(&str, &str, &[f64]) -> f64) -> (usize, usize) {
    let scale = case.values.iter().fold(0.0, |largest: f64, value| largest.max(value.abs()));
    let agrees = |(interpolation, extrapolation, at, expected): &&(String, String, Vec<f64>, f64)| {
        (value(interpolation, extrapolation, at) - expected).abs() <= TOLERANCE * scale
    };
    (case.points.len(), case.points.iter().filter(agrees).count())
}

/// All points of all grids of so many axes agree.
fn check(axes: usize, grids: usize, points: usize) {
    let cases: Vec<Case> = cases().into_iter().filter(|case| case.axes.len() == axes).collect();
    assert_eq!(cases.len(), grids);
    let mut total = 0;
    for case in &cases {
        let (count, agreeing) = agreement(case, |i, e, at| value(case, i, e, at));
        assert_eq!(agreeing, count);
        total += count;
        // The judge refuses the wrong interpolation, and values that are off by ten tolerances.
        let other = |i: &str| if i == "linear" { "cubic" } else { "linear" };
        let (_, wrong) = agreement(case, |i, e, at| value(case, other(i), e, at));
        assert!(wrong < count * 9 / 10, "{wrong} of {count}");
        let (_, wrong) = agreement(case, |i, e, at| value(case, i, e, at) + 1e-8 * 3.0);
        assert_eq!(wrong, 0);
    }
    assert_eq!(total, points);
}

#[test]
fn curves_agree_with_raysect() {
    check(1, 1, 2 * 39 + 5 * 4);
}

#[test]
fn surfaces_agree_with_raysect() {
    check(2, 2, 2 * 40 + 4 * 40);
}

#[test]
fn functions_of_three_variables_agree_with_raysect() {
    check(3, 2, 2 * 40 + 4 * 40);
}
