//! The distribution of facets that is known as GGX.

use std::f64::consts::{PI, TAU};

use raysect_math::{MathError, Vector3D};

/// How much of a rough surface hides behind its own hills, from two directions at once.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum Masking {
    /// The product of what is seen from each direction, as in Raysect (B. Walter et al., *Microfacet Models for
    /// Refraction through Rough Surfaces*, EGSR 2007, § 5.1).
    #[default]
    Separable,
    /// What is high is seen from both: a little brighter (E. Heitz, *Understanding the Masking-Shadowing Function in
    /// Microfacet-Based BRDFs*, JCGT 3(2), 2014, § 5.3). For reflection; light that passes through a rough surface
    /// sees its hills from below, and the product stays.
    HeightCorrelated,
}

/// The ways of masking by the names that files have for them.
pub(crate) const MASKINGS: [(&str, Masking); 2] =
    [("separable", Masking::Separable), ("height correlated", Masking::HeightCorrelated)];

/// Facets in the distribution of T. Trowbridge and K. Reitz (JOSA 65, 1975), GGX in Walter et al. 2007: those of an
/// ellipsoid. Directions are unit vectors in surface space.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Ggx {
    roughness: f64,
    pub(super) masking: Masking,
}

impl Ggx {
    pub(super) fn new(roughness: f64) -> Result<Self, MathError> {
        MathError::check(
            roughness > 0.0 && roughness <= 1.0,
            roughness,
            "roughness",
            "",
            "above 0, at most 1",
        )?;
        Ok(Self { roughness, masking: Masking::default() })
    }

    pub(super) fn roughness(&self) -> f64 {
        self.roughness
    }

    /// The name of the masking in files.
    pub(super) fn masking_name(&self) -> &'static str {
        if self.masking == MASKINGS[0].1 { MASKINGS[0].0 } else { MASKINGS[1].0 }
    }

    /// Density of facets of normal `m` [1/sr], per projected area: ∫ D m_z dω = 1.
    #[inline]
    pub(super) fn distribution(&self, m: Vector3D) -> f64 {
        if m.z <= 0.0 {
            return 0.0;
        }
        let squared = self.roughness * self.roughness;
        let stretched = squared * m.z * m.z + m.x * m.x + m.y * m.y;
        squared / (PI * stretched * stretched)
    }

    /// Projected length of the ellipsoid seen from `v`: Smith's masking is 2 |v_z| / (|v_z| + this).
    #[inline]
    fn reach(&self, v: Vector3D) -> f64 {
        let squared = self.roughness * self.roughness;
        (v.z * v.z + squared * (v.x * v.x + v.y * v.y)).sqrt()
    }

    /// The masking of one direction, over its cosine; finite at grazing incidence.
    #[inline]
    pub(super) fn visible(&self, v: Vector3D) -> f64 {
        2.0 / (v.z.abs() + self.reach(v))
    }

    /// Masking and shadowing of two directions on the same side, over the cosine of the first.
    #[inline]
    pub(super) fn reflected(&self, incoming: Vector3D, outgoing: Vector3D) -> f64 {
        match self.masking {
            Masking::Separable => self.product(incoming, outgoing),
            Masking::HeightCorrelated => {
                let (a, b) = (incoming.z.abs(), outgoing.z.abs());
                let sum = b * self.reach(incoming) + a * self.reach(outgoing);
                if sum > 0.0 { 2.0 * b / sum } else { 0.0 }
            }
        }
    }

    /// The product of the masking of two directions, over the cosine of the first.
    #[inline]
    pub(super) fn product(&self, incoming: Vector3D, outgoing: Vector3D) -> f64 {
        self.visible(incoming) * outgoing.z.abs() * self.visible(outgoing)
    }

    /// Draws the normal of a facet that is seen from `v` (v_z ≥ 0), of density
    /// [`visible`](Self::visible) · D · max(0, v·m) [1/sr] (E. Heitz, *Sampling the GGX Distribution of Visible
    /// Normals*, JCGT 7(4), 2018).
    #[inline]
    pub(super) fn sample_visible(&self, v: Vector3D, u: [f64; 2]) -> Vector3D {
        let a = self.roughness;
        let seen = Vector3D::new(a * v.x, a * v.y, v.z.max(0.0)).normalise_unchecked();
        let across = seen.x * seen.x + seen.y * seen.y;
        let first = if across > 0.0 {
            Vector3D::new(-seen.y, seen.x, 0.0) * (1.0 / across.sqrt())
        } else {
            Vector3D::X
        };
        let second = seen.cross(first);
        // A point of the hemisphere as it is seen: a half disk, and another one foreshortened.
        let (radius, angle) = (u[0].sqrt(), TAU * u[1]);
        let x = radius * angle.cos();
        let share = 0.5 * (1.0 + seen.z);
        let y = (1.0 - share) * (1.0 - x * x).max(0.0).sqrt() + share * radius * angle.sin();
        let towards = (1.0 - x * x - y * y).max(0.0).sqrt();
        let n = first * x + second * y + seen * towards;
        Vector3D::new(a * n.x, a * n.y, n.z.max(f64::MIN_POSITIVE.sqrt())).normalise_unchecked()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn facets_cover_the_surface_once() {
        for roughness in [0.05, 0.3, 1.0] {
            let facets = Ggx::new(roughness).unwrap();
            let sum = |incoming: Option<Vector3D>| {
                let (rings, sectors) = (4000, 64);
                let mut sum = 0.0;
                for i in 0..rings {
                    // Equal steps of the square root of the tangent resolve the peak.
                    let s = (f64::from(i) + 0.5) / f64::from(rings);
                    let (sine, cosine) = (0.5 * PI * s * s).sin_cos();
                    for j in 0..sectors {
                        let (y, x) = (TAU * (f64::from(j) + 0.5) / f64::from(sectors)).sin_cos();
                        let m = Vector3D::new(sine * x, sine * y, cosine);
                        let weight = incoming.map_or(m.z, |v| v.dot(m).max(0.0) * facets.visible(v));
                        sum += facets.distribution(m) * weight * sine * PI * s;
                    }
                }
                sum * TAU / f64::from(sectors) / f64::from(rings)
            };
            assert!((sum(None) - 1.0).abs() < 1e-5, "{roughness}: {}", sum(None));
            for degrees in [0.0, 60.0, 85.0] {
                let (x, z) = f64::to_radians(degrees).sin_cos();
                let visible = sum(Some(Vector3D::new(x, 0.0, z)));
                assert!((visible - 1.0).abs() < 2e-3, "{roughness} {degrees}: {visible}");
            }
        }
    }

    #[test]
    fn normals_are_unit_vectors_for_the_first_and_the_last_uniforms_and_at_grazing_incidence() {
        let ends = [0.5f64.powi(53), 0.25, 1.0 - 0.5f64.powi(53)];
        for roughness in [1e-6, 0.3, 1.0] {
            let facets = Ggx::new(roughness).unwrap();
            for z in [0.0, 1e-300, 1e-9, 0.5, 1.0] {
                let v = Vector3D::new(0.0, f64::sqrt((1.0 - z) * (1.0 + z)), z);
                for (a, b) in ends.into_iter().flat_map(|a| ends.map(|b| (a, b))) {
                    let m = facets.sample_visible(v, [a, b]);
                    assert!((m.length() - 1.0).abs() < 1e-12 && m.z > 0.0, "{roughness} {z} {a} {b}: {m:?}");
                    assert!(m.dot(v) > -1e-12, "{roughness} {z} {a} {b}: {m:?}");
                    assert!(facets.visible(v).is_finite() && facets.distribution(m).is_finite());
                }
            }
        }
    }

    #[test]
    fn roughness_is_above_zero_and_at_most_one() {
        assert!(Ggx::new(0.0).is_err() && Ggx::new(1.0 + 1e-9).is_err() && Ggx::new(f64::NAN).is_err());
        assert!(Ggx::new(1e-6).unwrap_or_else(|e| panic!("{e}")).distribution(Vector3D::Z).is_finite());
    }
}
