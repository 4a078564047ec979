//! How the tests compare samples with the density that they claim: Pearson's χ² over a grid of bins.

use crate::Vector3D;
use std::f64::consts::PI;

/// The smallest and largest numbers that a generator of 53 bits can give, and some between.
const EXTREMES: [f64; 5] = [EDGE, 0.25, 0.5, 0.75, 1.0 - EDGE];
const EDGE: f64 = 1.0 / (1u64 << 53) as f64;

/// Every pair of [`EXTREMES`], and each end with a thousand numbers across the interval.
pub(super) fn extremes() -> impl Iterator<Item = [f64; 2]> {
    let across = |end: f64| (0..1000).map(move |i| (end, (i as f64 + 0.5) / 1000.0));
    let rim = [EDGE, 1.0 - EDGE].into_iter().flat_map(across).flat_map(|(a, b)| [[a, b], [b, a]]);
    EXTREMES.into_iter().flat_map(|a| EXTREMES.into_iter().map(move |b| [a, b])).chain(rim)
}

/// Two coordinates on the domain of a sampler, cut into bins.
pub(super) struct Chart<P> {
    pub(super) low: [f64; 2],
    pub(super) high: [f64; 2],
    pub(super) bins: [usize; 2],
    /// The place with the given coordinates.
    pub(super) place: Box<dyn Fn([f64; 2]) -> P>,
    /// Its coordinates.
    pub(super) coordinates: Box<dyn Fn(P) -> [f64; 2]>,
    /// Area or solid angle per unit of both coordinates.
    pub(super) jacobian: Box<dyn Fn([f64; 2]) -> f64>,
}

impl<P: Copy> Chart<P> {
    /// Integral of a density over each bin: the midpoint rule, exact where density times Jacobian is linear.
    fn probabilities(&self, pdf: &dyn Fn(P) -> f64) -> Vec<f64> {
        const STEPS: usize = 4;
        let step = [0, 1].map(|i| (self.high[i] - self.low[i]) / (self.bins[i] * STEPS) as f64);
        let mut integrals = vec![0.0; self.bins[0] * self.bins[1]];
        for i in 0..self.bins[0] * STEPS {
            for j in 0..self.bins[1] * STEPS {
                let at = [self.low[0] + (i as f64 + 0.5) * step[0], self.low[1] + (j as f64 + 0.5) * step[1]];
                integrals[(i / STEPS) * self.bins[1] + j / STEPS] +=
                    pdf((self.place)(at)) * (self.jacobian)(at) * step[0] * step[1];
            }
        }
        integrals
    }

    /// Integral of a density over the chart.
    pub(super) fn integral(&self, pdf: &dyn Fn(P) -> f64) -> f64 {
        self.probabilities(pdf).iter().sum()
    }

    /// True if χ² of the samples stays below `dof + 5 √(2 dof)`, which a right density exceeds for about one
    /// seed in 50 000. Samples outside the chart have a bin of their own.
    pub(super) fn fits(&self, samples: &[P], pdf: &dyn Fn(P) -> f64) -> bool {
        let mut expected = self.probabilities(pdf);
        let outside = 1.0 - expected.iter().sum::<f64>();
        expected.push(if outside > 1e-9 { outside } else { 0.0 });
        let mut observed = vec![0u64; expected.len()];
        for &sample in samples {
            observed[self.bin(sample)] += 1;
        }
        let (mut chi_squared, mut bins) = (0.0, 0.0);
        for (bin, (&count, probability)) in observed.iter().zip(expected).enumerate() {
            let mean = probability * samples.len() as f64;
            if mean > 0.0 {
                assert!(mean > 5.0 || bin + 1 == observed.len(), "too few samples for a bin: {mean}");
                chi_squared += (count as f64 - mean).powi(2) / mean;
                bins += 1.0;
            } else if count > 0 {
                return false;
            }
        }
        let freedom: f64 = bins - 1.0;
        chi_squared < freedom + 5.0 * (2.0 * freedom).sqrt()
    }

    fn bin(&self, sample: P) -> usize {
        let at = (self.coordinates)(sample);
        let mut bin = 0;
        for i in 0..2 {
            let fraction = (at[i] - self.low[i]) / (self.high[i] - self.low[i]);
            if !(-1e-12..=1.0 + 1e-12).contains(&fraction) {
                return self.bins[0] * self.bins[1];
            }
            bin = bin * self.bins[i] + ((fraction * self.bins[i] as f64) as usize).min(self.bins[i] - 1);
        }
        bin
    }
}

/// The directions with 1 − cos θ in 0 … `versine`: solid angle is uniform in 1 − cos θ and φ.
pub(super) fn cap(versine: f64) -> Chart<Vector3D> {
    Chart {
        low: [0.0, -PI],
        high: [versine, PI],
        bins: [10, 12],
        place: Box::new(|[h, phi]| {
            let r = (h * (2.0 - h)).sqrt();
            Vector3D::new(r * phi.cos(), r * phi.sin(), 1.0 - h)
        }),
        coordinates: Box::new(|v| {
            let across = v.x * v.x + v.y * v.y;
            [if v.z > 0.0 { across / (1.0 + v.z) } else { 1.0 - v.z }, v.y.atan2(v.x)]
        }),
        jacobian: Box::new(|_| 1.0),
    }
}

/// Asserts that a direction is a unit vector to 4 ε.
pub(super) fn assert_unit(v: Vector3D) {
    assert!(v.is_finite() && (v.length() - 1.0).abs() <= 4.0 * f64::EPSILON, "{v:?}");
}
