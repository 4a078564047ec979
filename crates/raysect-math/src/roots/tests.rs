use proptest::prelude::*;

use super::scaling::{exponent, scale};
use super::*;
use crate::error_free::{two_product, two_sum};

/// Coefficients from the highest degree on.
pub(super) fn solve(c: &[f64]) -> Roots<4> {
    match *c {
        [a, b, c] => solve_quadratic(a, b, c).widen(),
        [a, b, c, d] => solve_cubic(a, b, c, d).widen(),
        [a, b, c, d, e] => solve_quartic(a, b, c, d, e),
        _ => panic!("{c:?}"),
    }
}

/// |p(x)| in units of ε Σ |cᵢ xⁱ|, evaluated in twice the precision after a change of the units of x and p by powers of
/// two.
pub(super) fn residual(c: &[f64], x: f64) -> f64 {
    let unit = if x == 0.0 { 0 } else { exponent(x) };
    let power = |i: usize| unit * (c.len() - 1 - i) as i32;
    let sizes = c.iter().enumerate().filter(|(_, c)| **c != 0.0).map(|(i, c)| exponent(*c) + power(i));
    let largest = sizes.max().unwrap_or(0);
    let x = scale(x, -unit);
    let (mut high, mut low, mut size) = (0.0, 0.0, 0.0);
    for (i, &c) in c.iter().enumerate() {
        let coefficient = scale(c, power(i) - largest);
        let (product, error) = two_product(high, x);
        let (sum, sum_error) = two_sum(product, coefficient);
        let (h, l) = two_sum(sum, low * x + (error + sum_error));
        (high, low) = (h, l);
        size = size * x.abs() + coefficient.abs();
    }
    let residual = if high + low == 0.0 { 0.0 } else { (high + low).abs() / (f64::EPSILON * size) };
    if residual.is_nan() { f64::INFINITY } else { residual }
}

/// How far a root of some multiplicity m can be from the exact one, as evaluation in twice the precision cannot tell
/// a value from 0 below (n ε)² Σ |cᵢ xⁱ|, beside p⁽ᵐ⁾/m! · (distance)ᵐ.
fn doubt(c: &[f64], root: f64, multiplicity: usize) -> f64 {
    let size = c.iter().fold(0.0, |s, c| s * root.abs() + c.abs());
    let mut rest = c.to_vec();
    let mut derivative = 0.0;
    for _ in 0..=multiplicity {
        // One synthetic division after the other leaves the derivatives over their factorials.
        derivative = rest.iter_mut().fold(0.0, |carry, c| {
            *c += carry * root;
            *c
        });
        rest.pop();
    }
    let unseen = (c.len() as f64 * f64::EPSILON).powi(2) * size;
    (unseen / derivative.abs()).powf(1.0 / multiplicity as f64)
}

/// What is wrong with the roots of a polynomial whose exact ones, with their multiplicities, are known.
pub(super) fn judge(c: &[f64], roots: &[f64], exact: &[(f64, usize)]) -> Result<(), String> {
    if !roots.is_sorted() {
        return Err(format!("not in order: {roots:?}"));
    }
    let mut rest = roots;
    for &(root, multiplicity) in exact.iter().filter(|r| r.0.is_finite()) {
        // Two spacings of numbers, also of the smallest.
        let mut tolerance = (2.0 * f64::EPSILON * root.abs()).max(1e-323);
        if multiplicity > 1 {
            tolerance += doubt(c, root, multiplicity);
        }
        let count = rest.iter().take_while(|&&r| (r - root).abs() <= tolerance).count();
        if count > multiplicity || (multiplicity - count) % 2 == 1 {
            return Err(format!(
                "{count} instead of {multiplicity} times {root:?}: {roots:?}, exactly {exact:?}"
            ));
        }
        rest = &rest[count..];
    }
    if rest.is_empty() { Ok(()) } else { Err(format!("ghosts: {roots:?}, exactly {exact:?}")) }
}

/// The lines of a file: kind, coefficients, exact roots.
fn recorded() -> impl Iterator<Item = (&'static str, Vec<f64>, Vec<(f64, usize)>)> {
    let text = include_str!("../../tests/data/polynomials.txt");
    text.lines().filter(|line| !line.starts_with('#')).map(|line| {
        let (left, right) = line.split_once(" ;").unwrap();
        let mut words = left.split_whitespace();
        let kind = words.next().unwrap();
        let coefficients = words.map(|w| w.parse().unwrap()).collect();
        let words: Vec<&str> = right.split_whitespace().collect();
        let exact = words.chunks(2).map(|w| (w[0].parse().unwrap(), w[1].parse().unwrap())).collect();
        (kind, coefficients, exact)
    })
}

#[test]
fn counts_and_roots_agree_with_exact_arithmetic() {
    let mut faults = Vec::new();
    let mut count = 0;
    for (kind, coefficients, exact) in recorded() {
        count += 1;
        if let Err(what) = judge(&coefficients, &solve(&coefficients), &exact) {
            faults.push(format!("{kind} {coefficients:?}: {what}"));
        }
    }
    assert!(count > 700);
    assert!(faults.is_empty(), "{} of {count}:\n{}", faults.len(), faults.join("\n"));
}

#[test]
fn the_judge_refuses_wrong_roots() {
    let (c, exact) = ([1.0, -4.0, 2.0, 4.0, -3.0], [(-1.0, 1), (1.0, 2), (3.0, 1)]);
    for right in [&[-1.0, 3.0][..], &[-1.0, 1.0, 1.0, 3.0]] {
        assert!(judge(&c, right, &exact).is_ok());
    }
    let wrong = [
        &[3.0][..],
        &[-1.0, 1.0, 3.0],
        &[-1.0, 3.0, 4.0],
        &[3.0, -1.0],
        &[-1.0, 3.0 + 1e-14],
        &[-1.0, 1.0, 1.0 + 1e-14, 3.0],
        &[],
    ];
    assert!(wrong.iter().all(|roots| judge(&c, roots, &exact).is_err()));
    let c = [1.0, -6.0, 11.0, -6.0];
    assert!(residual(&c, 3.0) == 0.0 && residual(&c, 3.0 + 1e-13) > 5.0);
}

#[test]
fn nothing_is_found_where_nothing_is_defined() {
    for wrong in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        for place in 0..5 {
            let mut c = [1.0, -2.0, -3.0, 1.0, 0.5];
            c[place] = wrong;
            assert!(solve(&c).is_empty() && (place > 3 || solve(&c[..4]).is_empty()));
            assert!(place > 2 || solve(&c[..3]).is_empty());
        }
    }
    assert!([3, 4, 5].iter().all(|&n| solve(&[0.0; 5][..n]).is_empty()));
}

/// Exact coefficients of ∏ (x − kᵢ / 1024).
pub(super) fn product(roots: &[i32]) -> Vec<f64> {
    let mut p = vec![1.0];
    for &k in roots {
        let r = f64::from(k) / 1024.0;
        let shifted: Vec<f64> = std::iter::once(0.0).chain(p.iter().map(|c| -r * c)).collect();
        p.push(0.0);
        p.iter_mut().zip(shifted).for_each(|(a, b)| *a += b);
    }
    p
}

/// Each different root and how often it occurs.
pub(super) fn counted(mut roots: Vec<i32>) -> Vec<(f64, usize)> {
    roots.sort_unstable();
    let chunks = roots.chunk_by(|a, b| a == b);
    chunks.map(|c| (f64::from(c[0]) / 1024.0, c.len())).collect()
}

proptest! {
    #[test]
    fn roots_that_were_put_in_come_out(roots in prop::collection::vec(-1500..1500i32, 2..=4)) {
        let outcome = judge(&product(&roots), &solve(&product(&roots)), &counted(roots));
        prop_assert!(outcome.is_ok(), "{outcome:?}");
    }

    #[test]
    fn clusters_are_resolved(centre in -1000..1000i32, near in prop::collection::vec(-3..=3i32, 2..=4)) {
        let roots: Vec<i32> = near.iter().map(|k| centre + k).collect();
        let outcome = judge(&product(&roots), &solve(&product(&roots)), &counted(roots));
        prop_assert!(outcome.is_ok(), "{outcome:?}");
    }

    #[test]
    fn units_do_not_matter(roots in prop::collection::vec(-1500..1500i32, 2..=4), x in -120..120i32, p in -300..300i32) {
        let c = product(&roots);
        let unit = |k: i32| 2f64.powi(k);
        let scaled: Vec<f64> = c.iter().enumerate().map(|(i, c)| c * unit(x * i as i32) * unit(p)).collect();
        let expected: Vec<f64> = solve(&c).iter().map(|r| r * unit(x)).collect();
        prop_assert_eq!(&solve(&scaled)[..], &expected[..]);
    }
}
