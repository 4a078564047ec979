//! Random points and directions, each with the probability density it is drawn from.
//!
//! The functions `sample…` take two uniform numbers in the open interval (0, 1), from [`uniforms`] or from a
//! low-discrepancy sequence; the function `pdf…` beside each gives the density per unit solid angle [1/sr] or
//! area [1/m²] of its samples. Directions are unit vectors about the z axis: turn them with
//! [`Frame`](crate::Frame). The samplers hold a domain of their own and draw from an [`Rng`] too.
//!
//! ```
//! use raysect_math::{Frame, Rng, Vector3D, sampling};
//! let mut rng = Rng::new(1);
//! let frame = Frame::from_z(Vector3D::X);
//! let local = sampling::hemisphere::sample_cosine(sampling::uniforms(&mut rng));
//! assert!(frame.to_world(local).x > 0.0);
//! assert!(sampling::hemisphere::pdf_cosine(local) > 0.0);
//! ```

#[cfg(test)]
mod all_tests;
#[cfg(test)]
mod check;
pub mod cone;
pub mod disk;
pub mod hemisphere;
pub mod sphere;
mod spherical_disk;
mod spherical_rectangle;
mod spherical_triangle;
pub mod square;
mod targeted;
pub mod triangle;

pub use spherical_disk::SphericalDiskSampler;
pub use spherical_rectangle::SphericalRectangleSampler;
pub use spherical_triangle::SphericalTriangleSampler;
pub use targeted::{TargetSphere, TargetedHemisphereSampler, TargetedSphereSampler};

use crate::Rng;

/// Two independent numbers, uniform in the open interval (0, 1).
#[inline]
pub fn uniforms(rng: &mut Rng) -> [f64; 2] {
    let first = rng.uniform();
    [first, rng.uniform()]
}

/// Widens the border of a domain, so that no rounded sample of it has density zero.
const SLACK: f64 = 1.0 + 16.0 * f64::EPSILON;

/// The draws that every sampler offers, in terms of its `sample_at`.
macro_rules! draws {
    ($sampler:ident -> $output:ty) => {
        impl $sampler {
            /// One sample.
            #[inline]
            pub fn sample(&self, rng: &mut $crate::Rng) -> $output {
                self.sample_at($crate::sampling::uniforms(rng))
            }

            /// `n` independent samples.
            pub fn samples(&self, n: usize, rng: &mut $crate::Rng) -> Vec<$output> {
                (0..n).map(|_| self.sample(rng)).collect()
            }
        }
    };
}
use draws;
