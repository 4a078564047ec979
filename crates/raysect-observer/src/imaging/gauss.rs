//! Gauss-Legendre quadrature of few points.

use std::f64::consts::PI;

/// Abscissae and weights of `n` points on −1 … 1: roots of the Legendre polynomial by Newton's method (W. H. Press et
/// al., *Numerical Recipes*, 3rd ed., § 4.6.1).
pub(super) fn gauss_legendre(n: usize) -> Vec<(f64, f64)> {
    let point = |i: usize| {
        let mut x = (PI * (i as f64 + 0.75) / (n as f64 + 0.5)).cos();
        let mut slope = 1.0;
        for _ in 0..8 {
            let (mut before, mut value) = (0.0, 1.0);
            for degree in 0..n {
                let d = degree as f64;
                (before, value) = (value, ((2.0 * d + 1.0) * x * value - d * before) / (d + 1.0));
            }
            slope = n as f64 * (x * value - before) / (x * x - 1.0);
            x -= value / slope;
        }
        (x, 2.0 / ((1.0 - x * x) * slope * slope))
    };
    (0..n).map(point).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn n_points_integrate_polynomials_up_to_degree_2n_minus_1_and_no_further() {
        for n in [1, 2, 3, 8, 33] {
            let points = gauss_legendre(n);
            let integral = |degree: i32| points.iter().map(|(x, w)| w * x.powi(degree)).sum::<f64>();
            let exact = |degree: i32| if degree % 2 == 0 { 2.0 / f64::from(degree + 1) } else { 0.0 };
            for degree in 0..2 * n as i32 {
                assert!((integral(degree) - exact(degree)).abs() < 1e-13, "{n} points, degree {degree}");
            }
            if n < 9 {
                let degree = 2 * n as i32;
                assert!((integral(degree) - exact(degree)).abs() > 1e-6, "{n} points, degree {degree}");
            }
        }
    }
}
