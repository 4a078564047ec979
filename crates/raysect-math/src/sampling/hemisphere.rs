//! Directions over the hemisphere about +z: uniform, or weighted by the cosine to z.

use std::f64::consts::{PI, TAU};

use super::{disk::concentric, draws};
use crate::Vector3D;

/// A uniform direction with z > 0: cos θ = u₀ and φ = 2π u₁
/// (M. Pharr, W. Jakob, G. Humphreys, *Physically Based Rendering*, 4th ed., § A.5.2).
#[doc(alias = "vector_hemisphere_uniform")]
#[inline]
pub fn sample_uniform(u: [f64; 2]) -> Vector3D {
    let r = ((1.0 - u[0]) * (1.0 + u[0])).sqrt();
    let (s, c) = (TAU * u[1]).sin_cos();
    Vector3D::new(r * c, r * s, u[0])
}

/// Density of [`sample_uniform`] [1/sr]: 1/(2π) for z ≥ 0, otherwise 0.
#[inline]
pub fn pdf_uniform(direction: Vector3D) -> f64 {
    if direction.z >= 0.0 { 1.0 / TAU } else { 0.0 }
}

/// A direction with density proportional to z; z > 0 for all uniforms in (0, 1).
///
/// N. Malley's method, a uniform point of the disk lifted to the sphere (*Physically Based Rendering*, 4th
/// ed., § A.5.3), with z² = (1 − r)(1 + r) from an exact 1 − r.
#[doc(alias = "vector_hemisphere_cosine")]
#[inline]
pub fn sample_cosine(u: [f64; 2]) -> Vector3D {
    let (x, y, rim) = concentric(u);
    Vector3D::new(x, y, (rim * (2.0 - rim)).sqrt())
}

/// Density of [`sample_cosine`] [1/sr]: z/π for z > 0, otherwise 0.
#[inline]
pub fn pdf_cosine(direction: Vector3D) -> f64 {
    if direction.z > 0.0 { direction.z / PI } else { 0.0 }
}

/// Uniform directions over the hemisphere about +z.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct HemisphereUniformSampler;

draws!(HemisphereUniformSampler -> Vector3D);

impl HemisphereUniformSampler {
    /// The unit vector for two uniforms in (0, 1); see [`sample_uniform`].
    #[inline]
    pub fn sample_at(&self, u: [f64; 2]) -> Vector3D {
        sample_uniform(u)
    }

    /// Density [1/sr] at a unit vector: 1/(2π) for z ≥ 0, otherwise 0.
    #[inline]
    pub fn pdf(&self, direction: Vector3D) -> f64 {
        pdf_uniform(direction)
    }
}

/// Directions over the hemisphere about +z, weighted by the cosine to z.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct HemisphereCosineSampler;

draws!(HemisphereCosineSampler -> Vector3D);

impl HemisphereCosineSampler {
    /// The unit vector for two uniforms in (0, 1); see [`sample_cosine`].
    #[inline]
    pub fn sample_at(&self, u: [f64; 2]) -> Vector3D {
        sample_cosine(u)
    }

    /// Density [1/sr] at a unit vector: z/π for z > 0, otherwise 0.
    #[inline]
    pub fn pdf(&self, direction: Vector3D) -> f64 {
        pdf_cosine(direction)
    }
}

#[cfg(test)]
mod tests {
    use super::super::check::{assert_unit, cap, extremes};
    use super::*;
    use crate::Rng;

    #[test]
    fn directions_follow_their_densities() {
        let uniform = HemisphereUniformSampler.samples(200_000, &mut Rng::new(1));
        let cosine = HemisphereCosineSampler.samples(200_000, &mut Rng::new(2));
        for chart in [cap(1.0), cap(2.0)] {
            assert!((chart.integral(&pdf_uniform) - 1.0).abs() < 1e-12);
            assert!((chart.integral(&pdf_cosine) - 1.0).abs() < 1e-12);
            assert!(chart.fits(&uniform, &|v| HemisphereUniformSampler.pdf(v)));
            assert!(chart.fits(&cosine, &|v| HemisphereCosineSampler.pdf(v)));
        }
        uniform.into_iter().chain(cosine).for_each(assert_unit);
    }

    #[test]
    fn the_one_density_claimed_for_the_other_is_found_out() {
        let uniform = HemisphereUniformSampler.samples(200_000, &mut Rng::new(3));
        let cosine = HemisphereCosineSampler.samples(200_000, &mut Rng::new(4));
        assert!(!cap(1.0).fits(&uniform, &pdf_cosine));
        assert!(!cap(1.0).fits(&cosine, &pdf_uniform));
        let whole_sphere = |_: Vector3D| 1.0 / (4.0 * PI);
        assert!(!cap(1.0).fits(&uniform, &whole_sphere) && !cap(2.0).fits(&uniform, &whole_sphere));
    }

    #[test]
    fn the_ends_of_the_uniforms_give_unit_vectors_above_the_plane() {
        for u in extremes().chain([[1e-300, 0.4], [0.4, 1e-300]]) {
            for v in [sample_uniform(u), sample_cosine(u)] {
                assert_unit(v);
                assert!(v.z > 0.0 && pdf_uniform(v) > 0.0 && pdf_cosine(v) > 0.0, "{u:?}");
            }
        }
    }

    #[test]
    fn below_the_plane_the_density_is_zero() {
        let v = Vector3D::new(0.6, 0.0, -0.8);
        assert_eq!((pdf_uniform(v), pdf_cosine(v), pdf_cosine(Vector3D::X)), (0.0, 0.0, 0.0));
    }
}
