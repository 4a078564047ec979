//! Points along a line, as good from afar as from near.

use raysect_math::Vector3D;

/// The upper 26 bits of a number.
#[inline(always)]
pub(super) fn upper(x: f64) -> f64 {
    f64::from_bits(x.to_bits() & !0x07ff_ffff)
}

/// `o + d t` for a `t` of 26 bits, rounded about once however nearly the terms cancel.
///
/// Both products are exact. If the first sum cancels, it is exact as well, since the terms are on a common grid.
#[inline(always)]
fn at_short(o: f64, d: f64, t: f64) -> f64 {
    let high = upper(d);
    (o + high * t) + (d - high) * t
}

/// `o + d t`, rounded about once besides 2⁻⁷⁶ `d t`: far less than the rounding of `t`.
#[inline(always)]
fn at_any(o: f64, d: f64, t: f64) -> f64 {
    let (high, short) = (upper(d), upper(t));
    (o + high * short) + (high * (t - short) + (d - high) * t)
}

/// The point of a line at a distance of 26 bits (see [`upper`]).
#[inline(always)]
pub(super) fn point_at_short(o: Vector3D, d: Vector3D, t: f64) -> Vector3D {
    Vector3D::new(at_short(o.x, d.x, t), at_short(o.y, d.y, t), at_short(o.z, d.z, t))
}

/// The point of a line at a distance.
#[inline(always)]
pub(super) fn point_at(o: Vector3D, d: Vector3D, t: f64) -> Vector3D {
    Vector3D::new(at_any(o.x, d.x, t), at_any(o.y, d.y, t), at_any(o.z, d.z, t))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::double_double::dd;
    use raysect_math::Rng;

    /// The greatest error in roundings of the result, and of 2⁻²³ roundings of the product.
    fn worst(at: fn(f64, f64, f64) -> f64, short: bool) -> f64 {
        let mut rng = Rng::new(9);
        let errors = (0..100_000).map(|number| {
            let d = rng.range(-1.0, 1.0);
            let t = rng.range(0.5, 2.0) * 10f64.powi(number % 10);
            let t = if short { upper(t) } else { t };
            let o = rng.range(-2.0, 2.0) - d * t;
            let exact = dd(o) + dd(d) * dd(t);
            let error = (dd(at(o, d, t)) - exact).value().abs();
            let product = if short { 0.0 } else { 2f64.powi(-23) * (d * t).abs() };
            error / (0.5 * f64::EPSILON * (exact.value().abs() + product))
        });
        errors.fold(0.0, f64::max)
    }

    #[test]
    fn points_are_right_to_a_rounding_from_any_distance() {
        let found = [worst(at_short, true), worst(at_any, false)];
        assert!(found.iter().all(|&x| x <= 2.0), "{found:?}");
        assert!(worst(|o, d, t| o + d * t, true) > 1e3);
    }
}
