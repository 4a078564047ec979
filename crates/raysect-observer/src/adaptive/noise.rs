//! What a pilot tells of the pixels.

use super::{AdaptiveSampling, Figure, Rule};
use crate::{Frame, FrameShape};

/// So many samples' weight have the pixels around a pixel in what is known of it.
const NEIGHBOURS: f64 = 4.0;

/// The standard deviation of a sample of each pixel that is observed, as it enters a rule: relative to the mean, or over
/// the root of the number of rays.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Noise(pub(super) Vec<f64>);

/// Mean and variance of the samples of a pixel in a channel, or of several pixels.
#[derive(Debug, Clone, Copy, Default)]
struct Moments {
    mean: f64,
    variance: f64,
}

/// What is known of a channel.
struct Channel {
    /// Of each pixel that is observed, together with those around it.
    pixels: Vec<Moments>,
    average: Moments,
}

impl Moments {
    /// As the error of a pixel shows it; a variance that is not known is zero.
    fn of(frame: &Frame, pixel: usize, channel: usize) -> Self {
        let estimate = frame.pixel(pixel, channel);
        let variance = estimate.error.powi(2) * frame.samples(pixel) as f64;
        let variance = if variance.is_finite() { variance } else { 0.0 };
        Self { mean: estimate.value.abs(), variance }
    }

    fn average(all: impl Iterator<Item = Self>) -> Self {
        let (mut sum, mut count) = (Self::default(), 0.0);
        for one in all {
            count += 1.0;
            sum = Self { mean: sum.mean + one.mean, variance: sum.variance + one.variance };
        }
        let count = f64::max(count, 1.0);
        Self { mean: sum.mean / count, variance: sum.variance / count }
    }

    /// Together with others, by the weights of both.
    fn with(self, other: Self, weights: (f64, f64)) -> Self {
        let of = |a: f64, b: f64| (a * weights.0 + b * weights.1) / (weights.0 + weights.1);
        Self { mean: of(self.mean, other.mean), variance: of(self.variance, other.variance) }
    }

    /// The variance relative to the square of the mean; none without a mean.
    fn relative(self) -> Option<f64> {
        (self.mean > 0.0).then(|| self.variance / (self.mean * self.mean))
    }
}

impl Channel {
    fn of(frame: &Frame, pixels: &[usize], channel: usize) -> Self {
        let mut all = vec![None; frame.shape().pixels()];
        pixels.iter().for_each(|&pixel| all[pixel] = Some(Moments::of(frame, pixel, channel)));
        let pooled = |&pixel: &usize| {
            let around = Moments::average(around(frame.shape(), pixel).filter_map(|p| all[p]));
            let own = all[pixel].unwrap_or_default();
            own.with(around, (frame.samples(pixel) as f64, NEIGHBOURS))
        };
        let average = Moments::average(all.iter().copied().flatten());
        Self { pixels: pixels.iter().map(pooled).collect(), average }
    }
}

impl Noise {
    /// Of what some pixels of a frame tell, and the rays that were traced for all samples of each pixel.
    pub(crate) fn of(sampling: &AdaptiveSampling, frame: &Frame, pixels: &[usize], rays: &[u64]) -> Self {
        let count = if sampling.figure == Figure::First { 1 } else { frame.channels().len() };
        let channels: Vec<Channel> = (0..count).map(|c| Channel::of(frame, pixels, c)).collect();
        let spread = |(place, &pixel): (usize, &usize)| {
            let samples = frame.samples(pixel).max(1) as f64;
            if sampling.rule == Rule::Total {
                let variance = channels[0].pixels[place].variance + channels[0].average.variance / samples;
                return (variance * samples / rays[pixel].max(1) as f64).sqrt();
            }
            relative(sampling.figure, &channels, place, samples)
        };
        Self(pixels.iter().enumerate().map(spread).collect())
    }
}

/// The relative standard deviation of a sample of a pixel.
fn relative(figure: Figure, channels: &[Channel], place: usize, samples: f64) -> f64 {
    // Where nothing at all has been seen, as little is known of one pixel as of another.
    let dark = channels.iter().all(|channel| channel.average.mean == 0.0);
    let of = |channel: &Channel| {
        let own = channel.pixels[place];
        let floor = channel.average.relative().unwrap_or(f64::from(dark)) / samples;
        (own.mean, (own.relative().unwrap_or(0.0) + floor).sqrt())
    };
    let worst = || channels.iter().map(|channel| of(channel).1).fold(0.0, f64::max);
    match figure {
        Figure::First | Figure::Colour => worst(),
        Figure::Bins(reduction) => {
            let bins: Vec<(f64, f64)> = channels[1..].iter().map(of).filter(|bin| bin.0 > 0.0).collect();
            reduction.of(&bins).unwrap_or_else(worst)
        }
    }
}

/// A pixel and those that it touches.
fn around(shape: FrameShape, pixel: usize) -> impl Iterator<Item = usize> {
    let (columns, rows) = (shape.columns(), shape.rows());
    let near = |at: usize, count: usize| at.saturating_sub(1)..(at + 2).min(count);
    let (column, row) = (pixel % columns, pixel / columns);
    near(row, rows).flat_map(move |row| near(column, columns).map(move |column| row * columns + column))
}

/// The value that this percentage of some values does not exceed, interpolated between its neighbours. The values are
/// sorted for it; there must be one at least.
pub(super) fn percentile(values: &mut [f64], percentage: f64) -> f64 {
    values.sort_by(f64::total_cmp);
    let place = (values.len() - 1) as f64 * percentage / 100.0;
    let (below, above) = (values[place.floor() as usize], values[place.ceil() as usize]);
    below + (above - below) * place.fract()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::frame::add_sample;

    /// A frame of one channel whose pixels have these samples.
    fn frame_of(shape: FrameShape, samples: &[&[f64]]) -> Frame {
        let mut frame = Frame::new("test", "1");
        frame.prepare(shape, vec!["a".into()], "x", 0, &vec![true; shape.pixels()]);
        let mut sums = frame.take_lane(0);
        for (pixel, samples) in samples.iter().enumerate() {
            let mut block = vec![0.0; sums.open_stride()];
            samples.iter().for_each(|x| add_sample(&mut block, &[*x]));
            sums.put_block(pixel, &block);
        }
        frame.put_lane(0, sums);
        frame
    }

    fn noise(sampling: AdaptiveSampling, samples: &[&[f64]]) -> Vec<f64> {
        let frame = frame_of(FrameShape::Line(samples.len()), samples);
        let pixels: Vec<usize> = (0..samples.len()).collect();
        Noise::of(&sampling, &frame, &pixels, &vec![8; samples.len()]).0
    }

    #[test]
    fn pixels_touch_those_beside_them_and_none_beyond_the_border() {
        let of = |shape, pixel| around(shape, pixel).collect::<Vec<_>>();
        let image = FrameShape::Image { columns: 4, rows: 3 };
        assert_eq!(of(image, 5), [0, 1, 2, 4, 5, 6, 8, 9, 10]);
        assert_eq!(of(image, 3), [2, 3, 6, 7]);
        assert_eq!(of(image, 8), [4, 5, 8, 9]);
        assert_eq!(of(FrameShape::Line(5), 4), [3, 4]);
        assert_eq!(of(FrameShape::Single, 0), [0]);
    }

    #[test]
    fn noise_is_that_of_the_samples_with_a_little_of_the_others() {
        // Means 2, 1 and 0, variances 4/3, 1/3 and 0 of four samples each; averages of 1 and 5/9.
        let samples: [&[f64]; 3] = [&[1.0, 3.0, 1.0, 3.0], &[0.5, 1.5, 0.5, 1.5], &[0.0; 4]];
        let (v, floor) = ([4.0 / 3.0, 1.0 / 3.0, 0.0], 5.0 / 9.0);
        let pooled = |own: f64, around: f64| (own + around) / 2.0;
        let means = [pooled(2.0, 1.5), pooled(1.0, 1.0), pooled(0.0, 0.5)];
        let variances = [pooled(v[0], (v[0] + v[1]) / 2.0), pooled(v[1], floor), pooled(v[2], v[1] / 2.0)];
        let found = noise(AdaptiveSampling::mono(10), &samples);
        for (pixel, found) in found.iter().enumerate() {
            let expected = variances[pixel] / means[pixel].powi(2) + floor / 4.0;
            assert!((found * found / expected - 1.0).abs() < 1e-12, "{pixel}");
        }
        // Two rays a sample.
        let found = noise(AdaptiveSampling::total(10), &samples);
        for (pixel, found) in found.iter().enumerate() {
            let expected = (variances[pixel] + floor / 4.0) / 2.0;
            assert!((found * found / expected - 1.0).abs() < 1e-12, "{pixel}");
        }
    }

    #[test]
    fn a_dark_picture_is_equally_unknown_everywhere_and_an_even_one_is_known() {
        let dark = noise(AdaptiveSampling::mono(10), &[&[0.0; 4], &[0.0; 4]]);
        assert!(dark[0] > 0.0 && dark[0] == dark[1]);
        assert_eq!(noise(AdaptiveSampling::mono(10), &[&[2.0; 4], &[3.0; 4]]), [0.0; 2]);
        let single = noise(AdaptiveSampling::mono(10), &[&[2.0; 1], &[3.0; 1]]);
        assert!(single.iter().all(|noise| noise.is_finite()));
    }
}
