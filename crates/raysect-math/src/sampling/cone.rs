//! Directions in a circular cone about +z: uniform, or weighted by the cosine to z.

use std::f64::consts::{PI, TAU};

use super::{SLACK, disk::concentric, draws};
use crate::{MathError, Vector3D};

/// A circular cone about +z, with uniform directions in it.
///
/// It is held as 1 − cos θ of its half angle θ, which keeps its digits however narrow the cone is
/// (M. Pharr, W. Jakob, G. Humphreys, *Physically Based Rendering*, 4th ed., § 6.2.4).
///
/// ```
/// use raysect_math::Cone;
/// // The cone in which a sphere of radius 1 m appears from 1000 km away.
/// let cone = Cone::of_sphere(1.0, 1e6);
/// let v = cone.sample_at([0.3, 0.8]);
/// assert_eq!(cone.pdf(v), 1.0 / cone.solid_angle());
/// ```
#[doc(alias = "vector_cone")]
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cone {
    /// 1 − cos θ, in 0 … 2.
    versine: f64,
}

impl Cone {
    /// The cone with the given half angle [deg].
    ///
    /// # Errors
    /// [`MathError::OutOfRange`] for an angle outside 1e-140 … 180°.
    pub fn from_angle(angle: f64) -> Result<Self, MathError> {
        MathError::check((1e-140..=180.0).contains(&angle), angle, "cone angle", "deg", "1e-140 … 180")?;
        let half = (0.5 * angle).to_radians().sin();
        Ok(Self { versine: 2.0 * half * half })
    }

    /// The cone of half angle θ up to 90° with the given sin² θ, for hot paths: values outside 1e-290 … 1 are
    /// clamped.
    ///
    /// `sin² θ / (1 + cos θ)` is 1 − cos θ without cancellation (*Physically Based Rendering*, 4th ed.,
    /// § 6.2.4). Towards 90° the rounding of the argument shows: the solid angle is right to ε / cos θ, while
    /// that of [`of_sphere`](Self::of_sphere) is right to ε.
    #[inline]
    pub fn from_sin_squared(sin_squared: f64) -> Self {
        let sin_squared = sin_squared.clamp(1e-290, 1.0);
        Self { versine: sin_squared / (1.0 + (1.0 - sin_squared).sqrt()) }
    }

    /// The cone in which a sphere of the given radius [m] appears from the given distance between its centre
    /// and the apex [m], for hot paths. From the surface or inside it is the half space.
    ///
    /// Right to rounding for every radius below the distance: cos² θ = (d − r)(d + r) / d².
    #[inline]
    pub fn of_sphere(radius: f64, distance: f64) -> Self {
        let sin = (radius / distance).clamp(1e-145, 1.0);
        let one_minus_sin = ((distance - radius) / distance).max(0.0);
        Self { versine: sin * sin / (1.0 + (one_minus_sin * (1.0 + sin)).sqrt()) }
    }

    /// Half angle [deg].
    pub fn angle(&self) -> f64 {
        (2.0 * (0.5 * self.versine).sqrt().min(1.0).asin()).to_degrees()
    }

    /// Solid angle [sr]: 2π (1 − cos θ).
    #[inline]
    pub fn solid_angle(&self) -> f64 {
        TAU * self.versine
    }

    /// True if a unit vector lies in the cone, to rounding.
    ///
    /// A vector that has been turned to the world and back carries an error of about ε rad, which may take it
    /// across the border: where that matters, keep the density from when the sample was drawn.
    #[inline]
    pub fn contains(&self, direction: Vector3D) -> bool {
        let Vector3D { x, y, z } = direction;
        let versine = if z > 0.0 { (x * x + y * y) / (1.0 + z) } else { 1.0 - z };
        versine <= self.versine * SLACK
    }

    /// The uniform direction in the cone for two uniforms in (0, 1): 1 − cos θ = u₀ (1 − cos θ_max),
    /// φ = 2π u₁ (*Physically Based Rendering*, 4th ed., § A.5.4).
    #[doc(alias = "vector_cone_uniform")]
    #[inline]
    pub fn sample_at(&self, u: [f64; 2]) -> Vector3D {
        let versine = u[0] * self.versine;
        let r = (versine * (2.0 - versine)).sqrt();
        let (s, c) = (TAU * u[1]).sin_cos();
        Vector3D::new(r * c, r * s, 1.0 - versine)
    }

    /// Density of [`sample_at`](Self::sample_at) [1/sr] at a unit vector: 1 / solid angle in the cone, 0
    /// outside.
    #[inline]
    pub fn pdf(&self, direction: Vector3D) -> f64 {
        if self.contains(direction) { 1.0 / self.solid_angle() } else { 0.0 }
    }
}

draws!(Cone -> Vector3D);

/// Uniform directions in a cone about +z.
#[doc(alias = "ConeSampler")]
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ConeUniformSampler {
    cone: Cone,
}

draws!(ConeUniformSampler -> Vector3D);

impl Default for ConeUniformSampler {
    /// Half angle 45°, as in Raysect.
    fn default() -> Self {
        Self { cone: Cone { versine: 1.0 - std::f64::consts::FRAC_1_SQRT_2 } }
    }
}

impl From<Cone> for ConeUniformSampler {
    #[inline]
    fn from(cone: Cone) -> Self {
        Self { cone }
    }
}

impl ConeUniformSampler {
    /// A cone with the given half angle [deg].
    ///
    /// # Errors
    /// [`MathError::OutOfRange`] for an angle outside 1e-140 … 180°.
    pub fn new(angle: f64) -> Result<Self, MathError> {
        Ok(Self { cone: Cone::from_angle(angle)? })
    }

    /// The cone.
    #[inline]
    pub fn cone(&self) -> Cone {
        self.cone
    }

    /// Solid angle [sr].
    #[inline]
    pub fn solid_angle(&self) -> f64 {
        self.cone.solid_angle()
    }

    /// The unit vector for two uniforms in (0, 1); see [`Cone::sample_at`].
    #[inline]
    pub fn sample_at(&self, u: [f64; 2]) -> Vector3D {
        self.cone.sample_at(u)
    }

    /// Density [1/sr] at a unit vector: 1 / solid angle in the cone, 0 outside.
    #[inline]
    pub fn pdf(&self, direction: Vector3D) -> f64 {
        self.cone.pdf(direction)
    }
}

/// Directions in a cone about +z, weighted by the cosine to z.
///
/// The projection onto the plane z = 0 is uniform in the disk of radius sin θ_max, so that the density is
/// cos θ / (π sin² θ_max). (Raysect's radius is asin θ_max, which gives a wider cone and does not exist
/// beyond 57°.)
#[doc(alias = "vector_cone_cosine")]
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ConeCosineSampler {
    cone: Cone,
    sin: f64,
    cos: f64,
}

draws!(ConeCosineSampler -> Vector3D);

impl Default for ConeCosineSampler {
    /// Half angle 45°, as in Raysect.
    fn default() -> Self {
        Self::within(ConeUniformSampler::default().cone)
    }
}

impl ConeCosineSampler {
    /// A cone with the given half angle [deg].
    ///
    /// # Errors
    /// [`MathError::OutOfRange`] for an angle outside 1e-140 … 90°.
    pub fn new(angle: f64) -> Result<Self, MathError> {
        MathError::check((1e-140..=90.0).contains(&angle), angle, "cone angle", "deg", "1e-140 … 90")?;
        Ok(Self::within(Cone::from_angle(angle)?))
    }

    /// The part of the given cone that lies in z ≥ 0, for hot paths.
    #[inline]
    pub fn within(cone: Cone) -> Self {
        let versine = cone.versine.min(1.0);
        Self { cone: Cone { versine }, sin: (versine * (2.0 - versine)).sqrt(), cos: 1.0 - versine }
    }

    /// The cone.
    #[inline]
    pub fn cone(&self) -> Cone {
        self.cone
    }

    /// Solid angle [sr].
    #[inline]
    pub fn solid_angle(&self) -> f64 {
        self.cone.solid_angle()
    }

    /// The unit vector for two uniforms in (0, 1); its z is positive.
    #[inline]
    pub fn sample_at(&self, u: [f64; 2]) -> Vector3D {
        let (x, y, rim) = concentric(u);
        // 1 − r² sin² = cos² + sin² (1 − r)(1 + r), a sum of positive terms.
        let z_squared = self.cos * self.cos + self.sin * self.sin * (rim * (2.0 - rim));
        Vector3D::new(self.sin * x, self.sin * y, z_squared.sqrt())
    }

    /// Density [1/sr] at a unit vector: z / (π sin² θ_max) in the cone, 0 outside.
    #[inline]
    pub fn pdf(&self, direction: Vector3D) -> f64 {
        if direction.z > 0.0 && self.cone.contains(direction) {
            direction.z / (PI * self.sin * self.sin)
        } else {
            0.0
        }
    }
}

#[cfg(test)]
mod tests;
