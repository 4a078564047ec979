//! What the neighbours of a pixel tell of its variance.
//!
//! A pixel that has not yet seen a rare bright sample has too small a variance, and cannot know. Its neighbours can:
//! most of them look at much the same. How much they are to be believed the frame tells itself, by how far the
//! variances of neighbours lie apart and how much of that their samples explain (B. Efron, C. Morris, *Stein's Estimation
//! Rule and its Competitors*, JASA 68, 1973: empirical Bayes, here for logarithms of variances). Variances are raised
//! only, never lowered: a pixel that is noisier than those about it stays as it is.

use super::lengthening::Told;
use crate::FrameShape;

/// A variance is taken to be this many times too small at most: a pixel that is quieter still is likely another kind of
/// pixel (B. Efron, C. Morris, *Limiting the Risk of Bayes and Empirical Bayes Estimators*, JASA 67, 1972).
const FARTHEST: f64 = 10.0;

/// The moments of n samples tell too little of the variance of their variance, since the rarest are missing: by about
/// 1 + 100 / n. Chosen together with the factor for skewness, and by the same judges.
const MISSING: f64 = 100.0;

/// The variances of pixels beside those of their neighbours.
pub(super) struct Neighbourhood {
    /// By how much the logarithm of the mean variance about a pixel exceeds that of its own; 0 where nothing is known.
    excess: Vec<f64>,
    /// Variance of the logarithm of a variance after one sample, as many of them would have it.
    doubt: f64,
    /// Variance of the logarithms of the true variances of neighbours.
    spread: f64,
}

impl Neighbourhood {
    /// Of pixels arranged in a shape, from what the samples of each tell.
    pub(super) fn of(shape: FrameShape, told: &[Option<Told>]) -> Self {
        let logarithms: Vec<f64> = told.iter().map(log_variance).collect();
        let mut found = Self { excess: vec![0.0; told.len()], doubt: 0.0, spread: 0.0 };
        let (mut count, mut doubt, mut scatter, mut explained) = (0.0, 0.0, 0.0, 0.0);
        for (pixel, told) in told.iter().enumerate() {
            let Some(told) = told.as_ref().filter(|_| !logarithms[pixel].is_nan()) else { continue };
            let around = shape.around(pixel).map(|p| logarithms[p]).filter(|x| !x.is_nan());
            let (pixels, sum) = around.fold((0.0, 0.0), |(n, sum), x| (n + 1.0, sum + x));
            if pixels > 1.0 {
                found.excess[pixel] = sum / pixels - logarithms[pixel];
                count += 1.0;
                scatter += found.excess[pixel].powi(2) * (pixels / (pixels - 1.0));
                doubt += told.variance_of_variance * told.samples;
                explained += doubt_after(told.samples);
            }
        }
        if count > 0.0 {
            found.doubt = doubt / count;
            found.spread = ((scatter - found.doubt * explained) / count).max(0.0);
        }
        found
    }

    /// The weight of its neighbours in the variance of a pixel of so many samples.
    pub(super) fn weight(&self, samples: f64) -> f64 {
        let doubt = self.doubt * doubt_after(samples);
        if doubt > 0.0 { doubt / (doubt + self.spread) } else { 0.0 }
    }

    /// The factor by which they raise its error.
    pub(super) fn stretch(&self, pixel: usize, samples: f64) -> f64 {
        let excess = self.excess[pixel].min(FARTHEST.ln());
        if excess <= 0.0 { 1.0 } else { (1.0 + self.weight(samples) * excess.exp_m1()).sqrt() }
    }
}

/// What is left of a doubt after some samples.
fn doubt_after(samples: f64) -> f64 {
    (1.0 + MISSING / samples) / samples
}

/// Logarithm of the variance of a sample of a pixel; NaN if that is not known, or 0.
fn log_variance(told: &Option<Told>) -> f64 {
    let variance = told.as_ref().map_or(f64::NAN, |told| told.variance);
    if variance > 0.0 && variance.is_finite() { variance.ln() } else { f64::NAN }
}
