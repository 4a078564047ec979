use super::Roots;
use super::scaling::{exponent, scale};
use crate::error_free::difference_of_products;

/// The real roots of a x² + b x + c.
///
/// The discriminant is formed without cancellation, so that the number of roots is right for the coefficients as
/// they are (N. J. Higham, *Accuracy and Stability of Numerical Algorithms*, section 1.8), and over- or underflows
/// for none. A double root is given twice. With `a` = 0 there is one root, as the other is infinite; a root beyond
/// the range of numbers is left out; 0 = 0 and coefficients that are not finite have none.
///
/// ```
/// use raysect_math::solve_quadratic;
/// assert_eq!(solve_quadratic(1.0, -1e9, 1.0)[..], [1e-9, 1e9]);
/// assert!(solve_quadratic(1.0, 0.0, 1.0).is_empty());
/// ```
#[inline]
pub fn solve_quadratic(a: f64, b: f64, c: f64) -> Roots<2> {
    let mut roots = Roots::default();
    if !(a.is_finite() && b.is_finite() && c.is_finite()) || (a == 0.0 && b == 0.0) {
        return roots;
    }
    if a == 0.0 {
        roots.insert(0.0 - c / b);
        return roots;
    }
    if c == 0.0 {
        roots.insert(0.0);
        roots.insert(0.0 - b / a);
        return roots;
    }
    // Scaled so that a and c are about 1: x = 2ˢ y, and all divided by 2ᵍ.
    let (ea, ec) = (exponent(a), exponent(c));
    let s = (ec - ea).div_euclid(2);
    let g = ea + 2 * s;
    let eb = if b == 0.0 { -2000 } else { exponent(b) + s - g };
    if eb > 60 {
        // The discriminant is b² to far beyond rounding.
        roots.insert(0.0 - c / b);
        roots.insert(0.0 - b / a);
        return roots;
    }
    let (a, b, c) = (scale(a, 2 * s - g), scale(b, s - g), scale(c, -g));
    let discriminant = difference_of_products(b, b, 4.0 * a, c);
    if discriminant >= 0.0 {
        // The root of larger size without cancellation, the other from the product of both.
        let q = -0.5 * (b + discriminant.sqrt().copysign(b));
        roots.insert(scale(q / a, s));
        roots.insert(scale(c / q, s));
    }
    roots
}
