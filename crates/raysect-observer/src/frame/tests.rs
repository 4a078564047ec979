use raysect_math::{Rng, Statistics};

use super::*;

/// A frame of one pixel with these samples.
pub(super) fn frame_of(samples: &[f64]) -> Frame {
    let mut frame = Frame::new("test", "1");
    frame.prepare(FrameShape::Single, vec!["a".into(), "dark".into()], "x", 0, &[true]);
    let mut sums = frame.take_lane(0);
    let mut block = vec![0.0; sums.open_stride()];
    for (number, &x) in samples.iter().enumerate() {
        add_sample(&mut block, &[x, 0.0]);
        if (number as u64 + 1).is_multiple_of(BLOCK) {
            sums.put_block(0, &block);
            block.fill(0.0);
        }
    }
    if !(samples.len() as u64).is_multiple_of(BLOCK) {
        sums.put_block(0, &block);
    }
    frame.put_lane(0, sums);
    frame
}

/// The standard error, written down once more: pairs of complete blocks, deviations of the rest.
fn expected_error(samples: &[f64]) -> f64 {
    let n = samples.len();
    let whole = n / BLOCK as usize * BLOCK as usize;
    let mean = samples[..whole].iter().sum::<f64>() / whole as f64;
    let squares = |of: &[f64]| of.iter().map(|x| (x - mean).powi(2)).sum::<f64>();
    let pairs: f64 = samples[..whole].chunks(2).map(|p| (p[0] - p[1]).powi(2)).sum();
    let count = whole as f64;
    let within = pairs + squares(&samples[..whole]) * count / (count - 1.0) * 4.0 / (count * count);
    (within + squares(&samples[whole..]) * count / (count + 1.0)).sqrt() / n as f64
}

#[test]
fn fewer_samples_than_a_block_have_the_plain_statistics() {
    let mut rng = Rng::new(8);
    let samples: Vec<f64> = (1..BLOCK).map(|_| rng.normal(1e3, 1.0)).collect();
    let mut plain = Statistics::new();
    samples.iter().for_each(|x| plain.add(*x));
    let found = frame_of(&samples).normal(0, 0);
    assert!((found.value / plain.mean() - 1.0).abs() < 1e-14);
    assert!((found.error / plain.error() - 1.0).abs() < 1e-10);
    assert_eq!(frame_of(&samples[..1]).pixel(0, 0).error, f64::INFINITY);
    assert_eq!(frame_of(&[]).pixel(0, 0).error, f64::INFINITY);
}

#[test]
fn complete_blocks_are_judged_by_their_pairs() {
    let mut rng = Rng::new(9);
    let samples: Vec<f64> = (0..1000).map(|_| rng.normal(1e3, 1.0)).collect();
    for count in [BLOCK as usize, BLOCK as usize + 1, 5 * BLOCK as usize, 1000] {
        let (frame, part) = (frame_of(&samples[..count]), &samples[..count]);
        let found = frame.normal(0, 0);
        let mean = part.iter().sum::<f64>() / count as f64;
        assert!((found.value / mean - 1.0).abs() < 1e-14, "{count}");
        assert!((found.error / expected_error(part) - 1.0).abs() < 1e-9, "{count}: {}", found.error);
        assert_eq!((frame.samples(0), frame.contributing(0)), (count as u64, count as u64));
        assert_eq!(frame.pixel(0, 1), Estimate { value: 0.0, error: 0.0 });
    }
}

/// Mean square of the differences from the truth, and of the errors, of many averages of a pixel that is bright
/// on one side of an edge.
fn edge(count: u64, stratified: bool) -> (f64, f64) {
    let (mut differences, mut errors) = (0.0, 0.0);
    for seed in 0..4000 {
        let mut strata = crate::strata::Strata::default();
        let samples: Vec<f64> = (0..count)
            .map(|s| {
                let rng = Rng::new(seed * count + s);
                let mut rng = if stratified { rng.confined_to(strata.of(seed, 0, 0, s)) } else { rng };
                let (x, y) = (rng.uniform(), rng.uniform());
                f64::from(0.7 * x + y < 0.8)
            })
            .collect();
        let found = frame_of(&samples).pixel(0, 0);
        // The area below a line of slope −0.7 from (0, 0.8) to (1, 0.1).
        differences += (found.value - 0.45).powi(2) / 4000.0;
        errors += found.error * found.error / 4000.0;
    }
    (differences, errors)
}

#[test]
fn equal_pairs_do_not_make_an_error_of_zero() {
    let samples: Vec<f64> = (0..BLOCK).map(|s| if s / 2 == 5 { 10.0 } else { 0.0 }).collect();
    let found = frame_of(&samples).pixel(0, 0);
    assert!(found.error > 0.01 * found.value, "{found:?}");
    assert_eq!(frame_of(&[3.0; BLOCK as usize]).pixel(0, 0), Estimate { value: 3.0, error: 0.0 });
}

#[test]
fn strata_reduce_the_error_and_the_error_bar_knows() {
    for blocks in [1, 4, 16] {
        let count = blocks * BLOCK;
        let (plain, _) = edge(count, false);
        let (differences, errors) = edge(count, true);
        assert!((plain * count as f64 / (0.45 * 0.55) - 1.0).abs() < 0.1);
        assert!(differences < 0.4 * plain, "{differences} {plain}");
        assert!((errors / differences - 1.0).abs() < 0.1, "{errors} {differences}");
    }
    // Where the last block is not complete the error bar may be too long, but never too short.
    let (differences, errors) = edge(2 * BLOCK + BLOCK / 2, true);
    assert!(errors > 0.95 * differences, "{errors} {differences}");
}

#[test]
fn a_frame_takes_nothing_else() {
    let mut frame = Frame::new("test", "1");
    let shape = FrameShape::Single;
    let channels = ["a".to_owned()];
    frame.prepare(shape, channels.to_vec(), "one range", 0, &[true]);
    assert!(frame.check(shape, &channels, "one range").is_ok());
    assert!(frame.check(shape, &channels, "another range").is_err());
    frame.clear();
    assert!(frame.check(shape, &channels, "another range").is_ok());
}

#[test]
fn a_total_of_one_pixel_is_the_pixel() {
    let mut rng = Rng::new(12);
    let samples: Vec<f64> = (0..100).map(|_| rng.uniform().ln().powi(2)).collect();
    let frame = frame_of(&samples);
    let (pixel, total) = (frame.pixel(0, 0), frame.total());
    assert!(pixel.error > frame.normal(0, 0).error);
    assert!(pixel.value == total.value && (pixel.error / total.error - 1.0).abs() < 1e-12);
}
