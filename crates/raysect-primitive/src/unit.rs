//! Unit vectors that rounding has made a little longer or shorter.

/// So near to 1 the square of a length may be for [`stretch`]: 3/8 of the square of this is less than half a rounding.
pub(crate) const NEAR: f64 = 1e-8;

/// True if `squared`, the square of a length, is 1 but for rounding.
#[inline(always)]
pub(crate) fn is_near(squared: f64) -> bool {
    (squared - 1.0).abs() < NEAR
}

/// What makes a vector a unit vector, for a square of its length of 1 but for rounding: two terms of the series of
/// 1/√x about 1, which are had sooner than a root and a division.
#[inline(always)]
pub(crate) fn stretch(squared: f64) -> f64 {
    1.5 - 0.5 * squared
}

/// The factor that makes a vector a unit vector, from the square of its length.
#[inline(always)]
pub(crate) fn to_unit(squared: f64) -> f64 {
    if is_near(squared) { stretch(squared) } else { by_root(squared) }
}

/// The same for any length.
#[cold]
pub(crate) fn by_root(squared: f64) -> f64 {
    1.0 / squared.sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::double_double::dd;
    use raysect_math::Rng;

    /// The greatest error of a factor, in roundings, over squares within a distance of 1.
    fn worst(factor: fn(f64) -> f64, within: f64) -> f64 {
        let mut rng = Rng::new(1);
        let errors = (0..10_000).map(|_| {
            let squared = 1.0 + within * rng.range(-1.0, 1.0);
            let exact = dd(1.0) / dd(squared).sqrt();
            ((dd(factor(squared)) - exact).value() / f64::EPSILON).abs()
        });
        errors.fold(0.0, f64::max)
    }

    #[test]
    fn factors_are_right_to_a_rounding() {
        for within in [1e-15, 1e-12, 1e-9, 0.99e-8, 1.1e-8, 1e-4, 0.9] {
            let (found, limit) = (worst(to_unit, within), if within > 0.1 { 4.0 } else { 1.0 });
            assert!(found <= limit, "{within}: {found}");
        }
        assert!(worst(stretch, 1e-7) > 4.0);
    }
}
