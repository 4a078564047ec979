//! Errors that are made longer cover what they should, and only those that should be longer are.

use raysect_math::Rng;

use super::Frame;
use super::tests::frame_of;
use crate::FrameShape;

const SQUARE: FrameShape = FrameShape::Image { columns: 8, rows: 8 };

/// A frame of several pixels with samples of their own.
fn frame_of_pixels(shape: FrameShape, mut samples: impl FnMut(usize) -> Vec<f64>) -> Frame {
    let pixels = shape.pixels();
    let mut frame = Frame::new("test", "1");
    frame.prepare(shape, vec!["a".into(), "dark".into()], "x", 0, &vec![true; pixels]);
    let mut sums = frame.take_lane(0);
    for pixel in 0..pixels {
        let one = frame_of(&samples(pixel)).take_lane(0);
        let (closed, open) = (one.closed.len(), one.open.len());
        sums.closed[pixel * closed..(pixel + 1) * closed].copy_from_slice(&one.closed);
        sums.open[pixel * open..(pixel + 1) * open].copy_from_slice(&one.open);
    }
    frame.put_lane(0, sums);
    frame
}

/// Shares of intervals of one error and of 1.96 errors that cover the truth.
type Covered = (f64, f64);

/// Of many frames, by the error that the samples of a pixel alone have and by that of the frame; with samples of mean 1,
/// times a scale of each pixel.
fn coverage(
    shape: FrameShape,
    count: u64,
    draw: impl Fn(&mut Rng) -> f64,
    scale: impl Fn(usize) -> f64,
) -> [Covered; 2] {
    let (mut covered, mut rng) = ([(0.0, 0.0); 2], Rng::new(5));
    let (frames, pixels) = (12_800 / shape.pixels(), shape.pixels());
    for _ in 0..frames {
        let frame =
            frame_of_pixels(shape, |pixel| (0..count).map(|_| scale(pixel) * draw(&mut rng)).collect());
        for pixel in 0..pixels {
            for (covered, found) in covered.iter_mut().zip([frame.normal(pixel, 0), frame.pixel(pixel, 0)]) {
                let z = (found.value - scale(pixel)).abs() / found.error;
                covered.0 += f64::from(z < 1.0) / (frames * pixels) as f64;
                covered.1 += f64::from(z < 1.96) / (frames * pixels) as f64;
            }
        }
    }
    covered
}

fn log_normal(rng: &mut Rng) -> f64 {
    (rng.normal(0.0, 1.0) - 0.5).exp()
}

fn exponential(rng: &mut Rng) -> f64 {
    -rng.uniform().ln()
}

/// Squares of normal numbers: a gamma distribution of shape 1/2.
fn squared(rng: &mut Rng) -> f64 {
    rng.normal(0.0, 1.0).powi(2)
}

fn even(rng: &mut Rng) -> f64 {
    1.0 + rng.normal(0.0, 0.1)
}

/// Since variances are raised only, intervals may rather cover a little too much than too little.
fn is_good((one, two): Covered) -> bool {
    (one - 0.68).abs() < 0.03 && (0.935..0.97).contains(&two)
}

#[test]
fn few_skewed_samples_cover_what_they_should_beside_others_like_them() {
    type Draw = fn(&mut Rng) -> f64;
    let kinds: [(&str, Draw); 4] =
        [("log-normal", log_normal), ("exponential", exponential), ("squared", squared), ("even", even)];
    for (name, draw) in kinds {
        for count in [64, 128, 256] {
            let [plain, found] = coverage(SQUARE, count, draw, |_| 1.0);
            println!("{name}, {count} samples: plain {plain:?}, found {found:?}");
            assert!(is_good(found), "{name}, {count}: {found:?}");
            let misses = count == 64 && name != "even";
            assert!(!misses || !is_good(plain), "{name}, {count}: {plain:?}");
        }
    }
}

#[test]
fn skewed_samples_cover_nearly_what_they_should_in_a_row_of_unlike_pixels() {
    let row = FrameShape::Line(100);
    let good = |(one, two): Covered| (one - 0.6827).abs() < 0.03 && (two - 0.95).abs() < 0.02;
    for count in [96, 160, 480] {
        // Dark pixels and bright ones, in order: neighbours differ a little.
        let [plain, found] = coverage(row, count, log_normal, |pixel| 1.0 + pixel as f64);
        println!("{count} samples: plain {plain:?}, found {found:?}");
        assert!(good(found) && (count > 160 || !good(plain)), "{count}: {plain:?} {found:?}");
        // In disorder: dark ones beside bright ones get errors that are a little too long.
        let [plain, found] = coverage(row, count, log_normal, |pixel| 1.0 + (37 * pixel % 100) as f64);
        println!("{count} samples, in disorder: plain {plain:?}, found {found:?}");
        assert!((0.65..0.75).contains(&found.0) && (0.93..0.97).contains(&found.1), "{count}: {found:?}");
    }
}

/// By how much the error of a pixel is longer.
fn factor(frame: &Frame, pixel: usize) -> f64 {
    frame.pixel(pixel, 0).error / frame.normal(pixel, 0).error
}

#[test]
fn nothing_is_longer_where_nothing_is_amiss() {
    // Of symmetric samples nothing is changed, nor is it of many.
    let mut rng = Rng::new(11);
    let even: Vec<f64> = (0..640).map(|_| rng.uniform()).collect();
    let skewed: Vec<f64> = (0..64_000).map(|_| rng.uniform().ln().powi(2)).collect();
    for samples in [even, skewed] {
        let found = factor(&frame_of(&samples), 0);
        assert!((1.0..1.001).contains(&found), "{found}");
    }
}

#[test]
fn a_noisy_pixel_keeps_its_error_and_its_neighbours_nearly_theirs() {
    let mut rng = Rng::new(3);
    let noisy = 27;
    let mut draw = |scale: f64| -> Vec<f64> { (0..64).map(|_| scale * even(&mut rng)).collect() };
    let frame = frame_of_pixels(SQUARE, |pixel| draw(if pixel == noisy { 100.0 } else { 1.0 }));
    assert!((factor(&frame, noisy) - 1.0).abs() < 0.01, "{}", factor(&frame, noisy));
    let beside: f64 = [18, 19, 20, 26, 28, 34, 35, 36].iter().map(|&p| factor(&frame, p)).sum();
    let apart: f64 = [0, 1, 8, 9, 6, 7, 62, 63].iter().map(|&p| factor(&frame, p)).sum();
    println!("beside {} apart {}", beside / 8.0, apart / 8.0);
    assert!(beside / 8.0 < 1.25 && apart / 8.0 < 1.1, "{beside} {apart}");
}

#[test]
fn pixels_of_another_kind_are_not_taken_for_unlucky_ones() {
    let mut rng = Rng::new(4);
    let mut draw = |scale: f64| -> Vec<f64> { (0..64).map(|_| 1.0 + scale * even(&mut rng)).collect() };
    // Every other row is a million times as quiet.
    let frame = frame_of_pixels(SQUARE, |pixel| draw(if pixel / 8 % 2 == 0 { 1.0 } else { 1e-6 }));
    assert!((0..64).all(|pixel| (1.0..1.02).contains(&factor(&frame, pixel))));
    // One of rounding alone among noisy ones may at most be as unlucky as a pixel can be.
    let frame = frame_of_pixels(SQUARE, |pixel| draw(if pixel == 9 { 1e-15 } else { 1.0 }));
    assert!((1.0..3.17).contains(&factor(&frame, 9)), "{}", factor(&frame, 9));
    assert!(frame.pixel(9, 0).error < 1e-15);
    // One that has seen the same in every sample has no error, and tells its neighbours nothing.
    let frame = frame_of_pixels(SQUARE, |pixel| draw(if pixel == 9 { 0.0 } else { 1.0 }));
    assert_eq!(frame.pixel(9, 0).error, 0.0);
    assert!((0..64).filter(|p| *p != 9).all(|p| (1.0..1.6).contains(&factor(&frame, p))));
}

#[test]
fn an_unlucky_pixel_learns_from_its_neighbours() {
    // One sample in fifty is bright; one pixel has seen none, but some that are not quite dark.
    let mut rng = Rng::new(6);
    let unlucky = 36;
    let mut frame_with = |shape: FrameShape| {
        frame_of_pixels(shape, |pixel| {
            let bright = |i: usize| f64::from(u8::from(pixel != unlucky && i % 50 == 7));
            (0..128).map(|i| bright(i) + 0.05 * rng.uniform()).collect()
        })
    };
    let square = factor(&frame_with(SQUARE), unlucky);
    let row = factor(&frame_with(FrameShape::Line(64)), unlucky);
    assert!(square > 1.5 && row > 1.5, "{square} {row}");
}
