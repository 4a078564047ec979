//! What the neighbours of a pixel tell of its variance.
//!
//! A pixel that has not yet seen a rare bright sample has too small a variance, and cannot know. Its neighbours can:
//! most of them look at much the same. How much they are to be believed the frame tells itself, by how far the
//! variances of neighbours lie apart and how much of that their samples explain (B. Efron, C. Morris, *Stein's Estimation
//! Rule and its Competitors*, JASA 68, 1973: empirical Bayes, here for logarithms of variances). Variances are raised
//! only, never lowered: a pixel that is noisier than those about it stays as it is.

use super::Frame;
use super::lengthening::ENOUGH;

/// A variance is at most this many times too small, for all that is known: a pixel that is quieter still is another
/// kind of pixel (B. Efron, C. Morris, *Limiting the Risk of Bayes and Empirical Bayes Estimators*, JASA 67, 1972).
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
    /// Of the pixels of a frame.
    pub(super) fn of(frame: &Frame) -> Self {
        let logarithms: Vec<f64> = (0..frame.observed.len()).map(|p| log_variance(frame, p)).collect();
        let mut found = Self { excess: vec![0.0; logarithms.len()], doubt: 0.0, spread: 0.0 };
        let (mut count, mut doubt, mut scatter, mut explained) = (0.0, 0.0, 0.0, 0.0);
        for (pixel, own) in logarithms.iter().enumerate().filter(|(_, own)| !own.is_nan()) {
            let (others, sum) = around(frame, &logarithms, pixel);
            if others > 1.0 {
                let samples = frame.samples(pixel) as f64;
                found.excess[pixel] = sum / others - own;
                count += 1.0;
                scatter += found.excess[pixel].powi(2) * (others / (others - 1.0));
                doubt += frame.variance_of_variance(pixel) * samples;
                explained += doubt_after(samples);
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

/// Logarithm of the variance of a sample of a pixel, all channels together; NaN if it has none that tells something.
fn log_variance(frame: &Frame, pixel: usize) -> f64 {
    if frame.is_masked(pixel) || (frame.contributing(pixel) as f64) < ENOUGH {
        return f64::NAN;
    }
    let variance = frame.squared_error(pixel) * frame.samples(pixel) as f64;
    if variance > 0.0 && variance.is_finite() { variance.ln() } else { f64::NAN }
}

/// How many pixels, itself and those that touch it, tell something about a pixel, and the sum of what they tell.
fn around(frame: &Frame, logarithms: &[f64], pixel: usize) -> (f64, f64) {
    let (columns, rows) = (frame.shape.columns(), frame.shape.rows());
    let (row, column) = (pixel / columns, pixel % columns);
    let near = |at: usize, of: usize| at.saturating_sub(1)..(at + 2).min(of);
    let places = near(row, rows).flat_map(|r| near(column, columns).map(move |c| r * columns + c));
    places.map(|p| logarithms[p]).filter(|x| !x.is_nan()).fold((0.0, 0.0), |(n, sum), x| (n + 1.0, sum + x))
}
