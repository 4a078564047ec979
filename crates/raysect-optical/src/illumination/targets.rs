use std::f64::consts::PI;

use raysect_core::BoundingSphere3D;
use raysect_math::sampling::{sphere, uniforms};
use raysect_math::{Cone, Frame, Point3D, Rng, Vector3D};

/// Spheres around important things: a density of directions that favours them.
///
/// From outside, each is the uniform density over the cone that it subtends; from inside, over all directions; they
/// are mixed by their importances, as in Raysect.
#[derive(Debug, Clone, Default)]
#[doc(alias = "ImportanceManager")]
pub struct Targets {
    spheres: Vec<(BoundingSphere3D, f64)>,
    /// Sums of the normalised importances; the last is 1.
    cumulative: Vec<f64>,
}

impl Targets {
    /// From spheres and their importances, which must be positive.
    pub fn new(spheres: Vec<(BoundingSphere3D, f64)>) -> Self {
        let total: f64 = spheres.iter().map(|s| s.1).sum();
        let spheres: Vec<_> = spheres.into_iter().map(|(s, importance)| (s, importance / total)).collect();
        let mut sum = 0.0;
        let cumulative = spheres
            .iter()
            .map(|s| {
                sum += s.1;
                sum
            })
            .collect();
        Self { spheres, cumulative }
    }

    /// True if there is nothing to aim at.
    #[inline]
    pub fn is_empty(&self) -> bool {
        self.spheres.is_empty()
    }

    /// How many there are.
    pub fn len(&self) -> usize {
        self.spheres.len()
    }

    /// A direction from a point towards one of them; any direction if there is none.
    #[doc(alias = "important_direction_sample")]
    pub fn sample(&self, from: Point3D, rng: &mut Rng) -> Vector3D {
        let u = rng.uniform();
        let chosen = self.cumulative.partition_point(|&c| c < u).min(self.spheres.len().saturating_sub(1));
        match self.spheres.get(chosen) {
            Some((target, _)) if from.distance_to(target.centre) > target.radius => {
                let axis = from.vector_to(target.centre);
                let cone = Cone::of_sphere(target.radius, axis.length());
                Frame::from_z(axis.normalise_unchecked()).to_world(cone.sample(rng))
            }
            _ => sphere::sample(uniforms(rng)),
        }
    }

    /// Density [1/sr] of [`sample`](Self::sample) for a unit direction.
    #[doc(alias = "important_direction_pdf")]
    pub fn density(&self, from: Point3D, direction: Vector3D) -> f64 {
        let of = |(target, weight): &(BoundingSphere3D, f64)| {
            let axis = from.vector_to(target.centre);
            let distance = axis.length();
            if distance <= target.radius {
                return weight / (4.0 * PI);
            }
            let along = axis.dot(direction);
            let miss = (axis - direction * along).length();
            let inside = along > 0.0 && miss <= target.radius * (1.0 + 1e-14);
            if inside { weight / Cone::of_sphere(target.radius, distance).solid_angle() } else { 0.0 }
        };
        self.spheres.iter().map(of).sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn two() -> Targets {
        let ball = |z, r| BoundingSphere3D::new(Point3D::new(0.0, 0.0, z), r).unwrap();
        Targets::new(vec![(ball(3.0, 1.0), 0.2), (ball(-2.0, 0.5), 0.6), (ball(0.0, 0.3), 0.2)])
    }

    #[test]
    fn the_density_integrates_to_one_and_is_that_of_the_samples() {
        let (targets, mut rng) = (two(), Rng::new(1));
        for from in [Point3D::new(0.5, 0.0, 0.0), Point3D::new(0.1, 0.0, 0.0)] {
            let n = 400_000;
            let values: Vec<f64> = (0..n)
                .map(|_| targets.density(from, sphere::sample(uniforms(&mut rng))) * 4.0 * PI)
                .collect();
            let mean = values.iter().sum::<f64>() / n as f64;
            let variance = values.iter().map(|v| (v - mean).powi(2)).sum::<f64>() / n as f64;
            assert!((mean - 1.0).abs() < 4.0 * (variance / n as f64).sqrt(), "{mean}");
            // E[1/p] over the samples is the solid angle where p > 0: all of it only from inside a sphere.
            let inverse = (0..n).map(|_| targets.density(from, targets.sample(from, &mut rng)).recip());
            let values: Vec<f64> = inverse.collect();
            assert!(values.iter().all(|v| v.is_finite()));
            let reach = values.iter().sum::<f64>() / n as f64;
            let spread =
                (values.iter().map(|v| (v - reach).powi(2)).sum::<f64>() / n as f64 / n as f64).sqrt();
            let cone = |r: f64, d: f64| Cone::of_sphere(r, d).solid_angle();
            let expected = if from.x > 0.3 {
                cone(1.0, 9.25f64.sqrt()) + cone(0.5, 4.25f64.sqrt()) + cone(0.3, 0.5)
            } else {
                4.0 * PI
            };
            assert!((reach - expected).abs() < 4.0 * spread, "{reach} {expected}");
        }
    }

    #[test]
    fn small_importances_need_not_sum_to_one() {
        let ball = BoundingSphere3D::new(Point3D::new(0.0, 0.0, 3.0), 1.0).unwrap();
        let targets = Targets::new(vec![(ball, 0.1)]);
        let direction = targets.sample(Point3D::ORIGIN, &mut Rng::new(2));
        assert!(targets.density(Point3D::ORIGIN, direction) > 0.0);
    }
}
