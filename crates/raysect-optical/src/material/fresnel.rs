//! Reflectances of metals.

/// How the reflectance of a metal follows from its index.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum FresnelLaw {
    /// Fresnel's formulae for a complex index, for unpolarised light (M. Born and E. Wolf, *Principles of Optics*,
    /// 7th ed., § 14.2).
    #[default]
    Exact,
    /// What they become where n² + k² is large, as Raysect has it at every index: up to 0.2 off for small ones.
    LargeIndex,
}

impl FresnelLaw {
    /// The reflectance for the cosine of incidence (0 … 1), the index on the side of incidence, and the index and the
    /// extinction of the metal.
    #[inline]
    pub(crate) fn reflectance(self, cosine: f64, near: f64, index: f64, extinction: f64) -> f64 {
        match self {
            Self::Exact => exact(cosine, near, index, extinction),
            Self::LargeIndex => large_index(cosine, index / near, extinction / near),
        }
    }
}

/// With w = a + ib = √((n + ik)² − n₀² sin² θ) the amplitudes of both polarisations are rational functions of w and
/// cos θ. They are written as sums of squares and by w² − n₀² cos² θ = (n + ik)² − n₀², which lose nothing at grazing
/// incidence, nor for indices that are almost equal.
fn exact(cosine: f64, near: f64, index: f64, extinction: f64) -> f64 {
    let sine_squared = (1.0 - cosine) * (1.0 + cosine);
    // So small a cosine has no square.
    if cosine * cosine < f64::MIN_POSITIVE {
        return 1.0;
    }
    let projected = near * cosine;
    let imaginary = 2.0 * index * extinction;
    // (n + ik)² − n₀², and without the second square near the normal.
    let excess = (index - near) * (index + near) - extinction * extinction;
    let real = if cosine > 0.5 {
        (index - extinction) * (index + extinction) - near * near * sine_squared
    } else {
        excess + projected * projected
    };
    let modulus = real.hypot(imaginary);
    // The larger part by the root, the smaller one from the product: their difference would cancel.
    let larger = (0.5 * (modulus + real.abs())).sqrt();
    let smaller = if larger > 0.0 { 0.5 * imaginary / larger } else { 0.0 };
    let (a, b) = if real >= 0.0 { (larger, smaller) } else { (smaller, larger) };
    let square = |x: f64, y: f64| x * x + y * y;
    let sum = square(a + projected, b);
    let s = square(excess, imaginary) / (sum * sum);
    let (along, across, rest) = (a * cosine, near * sine_squared, b * cosine);
    let p = s * (square(along - across, rest) / square(along + across, rest));
    (0.5 * (s + p)).min(1.0)
}

fn large_index(cosine: f64, index: f64, extinction: f64) -> f64 {
    let k0 = index * index + extinction * extinction;
    let (k1, k2, k3) = (k0 * cosine * cosine + 1.0, 2.0 * index * cosine, k0 + cosine * cosine);
    0.5 * ((k1 - k2) / (k1 + k2) + (k3 - k2) / (k3 + k2))
}

#[cfg(test)]
#[path = "fresnel_tests.rs"]
mod digits;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::material::dielectric::fresnel;

    fn at(law: FresnelLaw, degrees: f64, index: f64, extinction: f64) -> f64 {
        law.reflectance(degrees.to_radians().cos(), 1.0, index, extinction)
    }

    #[test]
    fn metals_reflect_what_the_exact_law_says() {
        let cases = [
            (0.0, 0.2, 3.3, 0.935_117_599_351_176),
            (75.0, 2.9, 3.0, 0.507_185_472_488_460_4),
            (80.0, 1.5, 0.1, 0.391_527_035_980_585_8),
        ];
        for (degrees, index, extinction, expected) in cases {
            let found = at(FresnelLaw::Exact, degrees, index, extinction);
            assert!((found - expected).abs() < 1e-14, "{degrees} {found} {expected}");
            // The other law is no substitute.
            assert!(
                degrees == 0.0
                    || (at(FresnelLaw::LargeIndex, degrees, index, extinction) - expected).abs() > 1e-3
            );
        }
    }

    #[test]
    fn the_law_of_large_indices_is_that_of_raysect() {
        for (degrees, expected) in [(0.0, 0.923_372), (45.0, 0.922_464), (80.0, 0.940_644)] {
            assert!((at(FresnelLaw::LargeIndex, degrees, 0.2, 3.0) - expected).abs() < 5e-7);
        }
        let off = at(FresnelLaw::LargeIndex, 0.3f64.acos().to_degrees(), 0.2, 0.5);
        assert!(
            (off - 0.655).abs() < 5e-4
                && (at(FresnelLaw::Exact, 0.3f64.acos().to_degrees(), 0.2, 0.5) - 0.864).abs() < 5e-4
        );
    }

    #[test]
    fn without_extinction_a_metal_is_glass() {
        for degrees in [0.0, 1e-7, 30.0, 60.0, 89.0, 90.0 - 1e-9] {
            assert!(at(FresnelLaw::Exact, degrees, 1.0, 0.0) < 1e-30, "{degrees}");
        }
        for index in [0.3, 1.0 / 1.5, 1.0 + 1e-9, 1.5, 2.4] {
            for degrees in [0.0, 1e-7, 30.0, 60.0, 89.0] {
                let cosine = f64::to_radians(degrees).cos();
                let glass = fresnel(cosine, 1.0, index).map_or(1.0, |f| f.0);
                let metal = FresnelLaw::Exact.reflectance(cosine, 1.0, index, 0.0);
                assert!((metal - glass).abs() <= 1e-12 * glass, "{index} {degrees}: {metal} {glass}");
            }
        }
    }

    #[test]
    fn reflectances_are_between_zero_and_one_everywhere() {
        for index in [0.0, 1e-8, 0.1, 1.0, 4.0, 1e6] {
            for extinction in [0.0, 1e-8, 0.1, 1.0, 4.0, 1e6] {
                // Neither index nor extinction: refused before any ray is traced.
                if index + extinction == 0.0 {
                    continue;
                }
                for cosine in [0.0, f64::MIN_POSITIVE, 1e-12, 1e-3, 0.5, 1.0 - 1e-12, 1.0] {
                    let found = FresnelLaw::Exact.reflectance(cosine, 1.0, index, extinction);
                    assert!((0.0..=1.0).contains(&found), "{index} {extinction} {cosine}: {found}");
                }
            }
        }
        assert!(1.0 - at(FresnelLaw::Exact, 90.0 - 1e-6, 0.2, 3.3) < 1e-6);
    }
}
