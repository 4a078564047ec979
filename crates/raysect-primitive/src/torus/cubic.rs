//! Where a quartic without a cubic term is level.

/// A number at most an eighth above the cube root, and not below it: a third of the exponent, with the fraction taken as
/// part of it (W. Kahan, K. Ng, 1991, in the comments of the C library's `cbrt`: wrong by 5 % at most).
#[inline]
fn above_cube_root(x: f64) -> f64 {
    if x < 1e-290 {
        return x.cbrt();
    }
    1.0625 * f64::from_bits(x.to_bits() / 3 + (715_094_163 << 32))
}

/// Where Newton's method begins for the root a of a³ + p a − `size`, the largest of all in size.
#[inline]
fn guess(p: f64, size: f64) -> f64 {
    if p > 0.0 {
        // A step of Halley's method from the bound size/p, as long as that is of the size of the root.
        let bound = size / p;
        let squared = bound * bound;
        if squared > 4.0 * p {
            return above_cube_root(size).min(bound);
        }
        let (a, b, c) = (squared * squared, squared * p, p * p);
        // Of very small numbers nothing is left, and the bound is the root.
        let part = (3.0 * a + 5.0 * b + c) / (6.0 * (a + b) + c);
        return if part > 0.0 { bound * part } else { bound };
    }
    let unit = (-p / 3.0).sqrt();
    let cosine = size / (2.0 * unit * unit * unit);
    if cosine.abs() <= 1.0 {
        // 2 cos(acos(x)/3) to 1e-4, by its values and slopes at 0 and 1.
        return unit * (1.732_050_8 + cosine * (0.333_333_3 + cosine * (0.019_657_1 * cosine - 0.085_041_2)));
    }
    above_cube_root(size) + (-p).sqrt()
}

/// The real roots of s³ + p s + q in ascending order, to some roundings, with NaN for those that are not there; of a
/// double root two or none.
///
/// The root of the largest size is alone on its side of 0, so that Newton's method comes down to it from any bound
/// without a detour, and comes to a bound from a little below; the other two have a sum and a product that follow from
/// it without cancellation.
#[inline]
pub(super) fn roots_of_depressed_cubic(p: f64, q: f64) -> [f64; 3] {
    let size = q.abs();
    let mut a = guess(p, size);
    for _ in 0..60 {
        let step = (a * (a * a + p) - size) / (3.0 * a * a + p);
        // A triple root at 0 makes it NaN.
        if step.is_nan() {
            break;
        }
        a -= step;
        // Since a² ≥ −p, one and a half times the square of a step bounds the error that it leaves, in units of a.
        if step.abs() <= 1e-8 * a {
            break;
        }
    }
    let discriminant = a * a - 4.0 * size / a;
    if discriminant.is_nan() || discriminant < 0.0 {
        return [-a.copysign(q), f64::NAN, f64::NAN];
    }
    let far = 0.5 * (a + discriminant.sqrt());
    let near = size / a / far;
    if q >= 0.0 { [-a, near, far] } else { [-far, -near, a] }
}

#[cfg(test)]
mod tests {
    use super::*;
    use raysect_math::{Rng, solve_cubic};

    #[test]
    fn depressed_cubics_as_the_general_solver_has_them() {
        let mut rng = Rng::new(2);
        for number in 0..30_000 {
            let orders = 10f64.powf(rng.range(-12.0, 0.0));
            let p = rng.range(-1.0, 1.0) * if number % 2 == 0 { 1.0 } else { orders };
            let q = rng.range(-1.0, 1.0) * if number % 3 == 0 { orders } else { p.abs().powf(1.5) };
            let exact = solve_cubic(1.0, 0.0, p, q);
            let found = roots_of_depressed_cubic(p, q).into_iter().filter(|s| !s.is_nan());
            let found: Vec<f64> = found.collect();
            let double = (4.0 * p.powi(3) + 27.0 * q * q).abs() < 1e-13 * q * q;
            assert!(found.len() == exact.len() || double, "{p} {q}: {found:?} {exact:?}");
            for (a, b) in found.iter().zip(exact.iter()).filter(|_| !double) {
                // The slope at the smaller two vanishes at a double root.
                let slope = (3.0 * b * b + p).abs() / (3.0 * b * b + p.abs());
                assert!((a - b).abs() <= 1e-14 * b.abs() / slope.max(1e-6), "{p} {q}: {found:?} {exact:?}");
            }
        }
        assert_eq!(roots_of_depressed_cubic(-1.0, 0.0), [-1.0, 0.0, 1.0]);
        assert_eq!(roots_of_depressed_cubic(0.0, -8.0)[0], 2.0);
        for (p, q) in [(0.0, 0.0), (1.0, 0.0), (1e-300, -0.0)] {
            assert_eq!(
                roots_of_depressed_cubic(p, q).into_iter().filter(|&s| s == 0.0).count(),
                1,
                "{p} {q}"
            );
        }
    }
}
