//! Uniform directions over the whole sphere.

use std::f64::consts::{PI, TAU};

use super::draws;
use crate::Vector3D;

/// A uniform direction: cos θ = 1 − 2 u₀ and φ = 2π u₁
/// (M. Pharr, W. Jakob, G. Humphreys, *Physically Based Rendering*, 4th ed., § A.5.2).
#[doc(alias = "vector_sphere")]
#[inline]
pub fn sample(u: [f64; 2]) -> Vector3D {
    let r = 2.0 * (u[0] * (1.0 - u[0])).sqrt();
    let (s, c) = (TAU * u[1]).sin_cos();
    Vector3D::new(r * c, r * s, 1.0 - 2.0 * u[0])
}

/// Density of [`sample`] [1/sr]: 1/(4π) for every direction.
#[inline]
pub fn pdf(_direction: Vector3D) -> f64 {
    1.0 / (4.0 * PI)
}

/// Uniform directions over the whole sphere.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct SphereSampler;

draws!(SphereSampler -> Vector3D);

impl SphereSampler {
    /// The unit vector for two uniforms in (0, 1); see [`sample`].
    #[inline]
    pub fn sample_at(&self, u: [f64; 2]) -> Vector3D {
        sample(u)
    }

    /// Density [1/sr] at a unit vector: 1/(4π).
    #[inline]
    pub fn pdf(&self, direction: Vector3D) -> f64 {
        pdf(direction)
    }
}

#[cfg(test)]
mod tests {
    use super::super::check::{assert_unit, cap, extremes};
    use super::*;
    use crate::Rng;

    #[test]
    fn directions_follow_their_density() {
        let directions = SphereSampler.samples(200_000, &mut Rng::new(1));
        assert!((cap(2.0).integral(&|v| SphereSampler.pdf(v)) - 1.0).abs() < 1e-12);
        assert!(cap(2.0).fits(&directions, &|v| SphereSampler.pdf(v)));
        directions.into_iter().for_each(assert_unit);
    }

    #[test]
    fn a_slight_preference_for_one_side_is_found_out() {
        let directions = SphereSampler.samples(200_000, &mut Rng::new(2));
        let along_z = |v: Vector3D| pdf(v) * (1.0 + 0.05 * v.z);
        let along_x = |v: Vector3D| pdf(v) * (1.0 + 0.05 * v.x);
        for wrong in [&along_z as &dyn Fn(Vector3D) -> f64, &along_x] {
            assert!((cap(2.0).integral(wrong) - 1.0).abs() < 1e-12);
            assert!(!cap(2.0).fits(&directions, wrong));
        }
    }

    #[test]
    fn the_ends_of_the_uniforms_give_unit_vectors() {
        for u in extremes() {
            assert_unit(sample(u));
        }
        assert!(sample([1.0 - f64::EPSILON / 2.0, 0.3]).x != 0.0);
    }
}
