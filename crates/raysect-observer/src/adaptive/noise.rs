//! What a pilot tells of the pixels.

use super::{AdaptiveSampling, Figure, Rule};
use crate::Frame;

/// The standard deviation of a sample of each pixel that is observed, as it enters a rule: relative to the mean, or over
/// the root of the number of rays.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Noise(pub(super) Vec<f64>);

/// What is known of a channel.
struct Channel {
    /// The absolute mean of each pixel that is observed.
    means: Vec<f64>,
    /// The variance of a sample of each, half of it that of the pixels around; relative to the square of the mean, if
    /// that is asked for.
    variances: Vec<f64>,
    /// The variance of the average pixel.
    average: f64,
}

impl Channel {
    fn of(frame: &Frame, pixels: &[usize], channel: usize, is_relative: bool) -> Self {
        let means: Vec<f64> = pixels.iter().map(|&p| frame.pixel(p, channel).value.abs()).collect();
        let plain: Vec<f64> = pixels.iter().map(|&p| variance(frame, p, channel)).collect();
        let (mean, average) = (average(means.iter().copied()), average(plain.iter().copied()));
        let average = if is_relative { relative(average, mean).unwrap_or(0.0) } else { average };
        let own = |place: usize| match is_relative {
            true => relative(plain[place], means[place]),
            false => Some(plain[place]),
        };
        // None where nothing has been seen: that says nothing of the others.
        let mut known = vec![None; frame.shape().pixels()];
        pixels.iter().enumerate().for_each(|(place, &pixel)| known[pixel] = own(place));
        let pooled = |&pixel: &usize| {
            let around = self::average(frame.shape().around(pixel).filter_map(|p| known[p]));
            0.5 * (known[pixel].unwrap_or(around) + around)
        };
        let variances = pixels.iter().map(pooled).collect();
        Self { means, variances, average }
    }
}

/// The variance of a sample of a pixel; zero if it is not known.
fn variance(frame: &Frame, pixel: usize, channel: usize) -> f64 {
    let variance = frame.pixel_variance(pixel, channel);
    if variance.is_finite() { variance } else { 0.0 }
}

fn relative(variance: f64, mean: f64) -> Option<f64> {
    (mean > 0.0).then(|| variance / (mean * mean))
}

/// Zero of nothing.
fn average(numbers: impl Iterator<Item = f64>) -> f64 {
    let (sum, count) = numbers.fold((0.0, 0.0), |(sum, count), number| (sum + number, count + 1.0));
    sum / f64::max(count, 1.0)
}

impl Noise {
    /// Of what some pixels of a frame tell, and the rays that were traced for all samples of each pixel.
    pub(crate) fn of(sampling: &AdaptiveSampling, frame: &Frame, pixels: &[usize], rays: &[u64]) -> Self {
        let count = if sampling.figure == Figure::First { 1 } else { frame.channels().len() };
        let is_relative = sampling.rule != Rule::Total;
        let channels: Vec<Channel> =
            (0..count).map(|channel| Channel::of(frame, pixels, channel, is_relative)).collect();
        // Where nothing at all has been seen, as little is known of one pixel as of another.
        let dark = channels.iter().all(|channel| channel.means.iter().all(|mean| *mean == 0.0));
        let spread = |(place, &pixel): (usize, &usize)| {
            let samples = frame.samples(pixel).max(1) as f64;
            let of = |channel: &Channel| {
                let variance = channel.variances[place] + (channel.average + f64::from(dark)) / samples;
                (channel.means[place], variance.sqrt())
            };
            match is_relative {
                true => reduced(sampling.figure, channels.iter().map(of)),
                false => of(&channels[0]).1 / (rays[pixel].max(1) as f64 / samples).sqrt(),
            }
        };
        Self(pixels.iter().enumerate().map(spread).collect())
    }
}

/// One number of the means and relative deviations of all channels.
fn reduced(figure: Figure, channels: impl Iterator<Item = (f64, f64)> + Clone) -> f64 {
    let worst = || channels.clone().map(|(_, relative)| relative).fold(0.0, f64::max);
    match figure {
        Figure::First | Figure::Colour => worst(),
        Figure::Bins(reduction) => {
            let bins: Vec<(f64, f64)> = channels.clone().skip(1).filter(|bin| bin.0 > 0.0).collect();
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::FrameShape;
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
    fn noise_is_that_of_the_samples_with_a_little_of_the_others() {
        // Means 2, 1 and 0, variances 4/3, 1/3 and 0 of four samples each; averages of 1 and 5/9.
        let samples: [&[f64]; 3] = [&[1.0, 3.0, 1.0, 3.0], &[0.5, 1.5, 0.5, 1.5], &[0.0; 4]];
        let third = 1.0 / 3.0;
        // Relative variances of a third where something is seen. Two rays a sample.
        let plain = [0.5 * (4.0 + 2.5) * third, 0.5 * (1.0 + 5.0 * third) * third, 0.25 * third];
        for (sampling, variances, rays) in
            [(AdaptiveSampling::mono(10), [third; 3], 1.0), (AdaptiveSampling::total(10), plain, 2.0)]
        {
            for (pixel, found) in noise(sampling, &samples).iter().enumerate() {
                let expected = (variances[pixel] + 5.0 / 9.0 / 4.0) / rays;
                assert!((found * found / expected - 1.0).abs() < 1e-12, "{pixel}: {found}, {sampling:?}");
            }
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
