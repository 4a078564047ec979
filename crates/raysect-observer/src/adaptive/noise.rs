//! What a pilot tells of the pixels.

use super::{AdaptiveSampling, Figure, Rule};
use crate::Frame;

/// The standard deviation of a sample of each pixel that is observed, as it enters a rule: relative to the mean, or over
/// the root of the number of rays.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Noise(pub(super) Vec<f64>);

/// What a channel has in the average pixel.
#[derive(Debug, Clone, Copy, Default)]
struct Average {
    mean: f64,
    variance: f64,
}

impl Average {
    /// The variance relative to the square of the mean. A channel in which nothing has been seen has none, unless `all`
    /// of them are dark: then as little is known of any pixel as of the others.
    fn relative(self, all_dark: bool) -> f64 {
        match self.mean > 0.0 {
            true => self.variance / (self.mean * self.mean),
            false => f64::from(all_dark),
        }
    }
}

impl Noise {
    /// Of what some pixels of a frame tell, and the rays that were traced for all samples of each pixel.
    pub(crate) fn of(sampling: &AdaptiveSampling, frame: &Frame, pixels: &[usize], rays: &[u64]) -> Self {
        let channels = match sampling.figure {
            Figure::First => 0..1,
            Figure::Colour | Figure::Bins(_) => 0..frame.channels().len(),
        };
        let averages: Vec<Average> = channels.map(|channel| average(frame, pixels, channel)).collect();
        let spread = |&pixel: &usize| match sampling.rule {
            Rule::Total => {
                let samples = frame.samples(pixel).max(1) as f64;
                let variance = variance(frame, pixel, 0) + averages[0].variance / samples;
                (variance / (rays[pixel].max(1) as f64 / samples)).sqrt()
            }
            Rule::Worst | Rule::Equal => relative(sampling.figure, frame, pixel, &averages),
        };
        Self(pixels.iter().map(spread).collect())
    }
}

/// The variance of a sample, as the error of a pixel shows it; zero if it is not known.
fn variance(frame: &Frame, pixel: usize, channel: usize) -> f64 {
    let variance = frame.pixel(pixel, channel).error.powi(2) * frame.samples(pixel) as f64;
    if variance.is_finite() { variance } else { 0.0 }
}

fn average(frame: &Frame, pixels: &[usize], channel: usize) -> Average {
    let mut all = Average::default();
    for &pixel in pixels {
        all.mean += frame.pixel(pixel, channel).value.abs() / pixels.len() as f64;
        all.variance += variance(frame, pixel, channel) / pixels.len() as f64;
    }
    all
}

/// The relative standard deviation of a sample of a pixel.
fn relative(figure: Figure, frame: &Frame, pixel: usize, averages: &[Average]) -> f64 {
    let samples = frame.samples(pixel).max(1) as f64;
    let dark = averages.iter().all(|average| average.mean == 0.0);
    let of = |channel: usize| {
        let mean = frame.pixel(pixel, channel).value.abs();
        let own = if mean > 0.0 { variance(frame, pixel, channel) / (mean * mean) } else { 0.0 };
        (mean, (own + averages[channel].relative(dark) / samples).sqrt())
    };
    let worst = || (0..averages.len()).map(|channel| of(channel).1).fold(0.0, f64::max);
    match figure {
        Figure::First | Figure::Colour => worst(),
        Figure::Bins(reduction) => {
            let bins: Vec<(f64, f64)> = (1..averages.len()).map(of).filter(|(mean, _)| *mean > 0.0).collect();
            reduction.of(&bins).unwrap_or_else(worst)
        }
    }
}

/// The value that this percentage of some values does not exceed, interpolated between its neighbours. The values are
/// sorted for it; there must be one at least.
pub(super) fn percentile(values: &mut [f64], percentage: f64) -> f64 {
    values.sort_by(f64::total_cmp);
    let place = (values.len() - 1) as f64 * percentage / 100.0;
    let (below, above) = (values[place.floor() as usize], values[place.ceil() as usize]);
    below + (above - below) * place.fract()
}
