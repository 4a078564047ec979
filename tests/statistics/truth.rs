//! The true radiance of each pixel of a small picture, from a run that is long enough to be called true.
//!
//! `cargo test --test statistics -- --ignored write_truth` makes it anew.

use std::fmt::Write;
use std::path::PathBuf;

use raysect::prelude::*;

use crate::cornell::{self, Variant};
use crate::sensors::Bins;

/// Pixels to a side.
pub(crate) const SIDE: usize = 8;
/// Bins of the spectrum.
pub(crate) const BINS: usize = 15;
/// Samples of a pixel behind the truth, and a seed that no test uses.
const SAMPLES: u64 = 1 << 20;
const SEED: u64 = 1_000_003;

/// Radiance of every pixel in every bin, and after them over the whole spectrum: `[pixel][channel]`.
pub(crate) type Truth = Vec<Vec<Estimate>>;

/// The scene.
pub(crate) fn world() -> World {
    cornell::cornell_box(Variant::Diffuse).unwrap()
}

/// The camera of so many pixels to a side.
pub(crate) fn camera(side: usize) -> PinholeCamera {
    cornell::camera((side, side)).unwrap().spectral_bins(BINS).quiet(true)
}

/// Where the truth is kept.
fn file() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/data/cornell_diffuse_8x8_radiance.txt")
}

/// Reads the truth.
pub(crate) fn load() -> Truth {
    let text = std::fs::read_to_string(file()).unwrap();
    let rows = text.lines().filter(|line| !line.starts_with('#'));
    let truth: Truth = rows
        .map(|row| {
            let numbers: Vec<f64> = row.split_whitespace().map(|x| x.parse().unwrap()).collect();
            numbers.chunks_exact(2).map(|c| Estimate { value: c[0], error: c[1] }).collect()
        })
        .collect();
    assert_eq!(truth.len(), SIDE * SIDE);
    assert!(truth.iter().all(|pixel| pixel.len() == BINS + 1));
    truth
}

#[test]
#[ignore = "writes the file that the other tests read; takes some minutes"]
fn write_truth() {
    let (mut bins, mut radiance) = (Bins::new(0..BINS), RadiancePipeline2D::new());
    let camera = camera(SIDE).seed(SEED).pixel_samples(SAMPLES);
    camera.observe(&world(), &mut (&mut bins, &mut radiance)).unwrap();
    let mut text = format!(
        "# Radiance of the diffuse Cornell box (examples/common/cornell.rs), {SIDE}x{SIDE} pixels, {BINS} bins over\n\
         # 375 to 740 nm. One line a pixel, row by row: mean and standard error in each bin [W/m2/sr/nm], then of\n\
         # the whole spectrum [W/m2/sr]. Made with {SAMPLES} samples a pixel and seed {SEED} by\n\
         # cargo test --test statistics -- --ignored write_truth\n"
    );
    for pixel in 0..SIDE * SIDE {
        let channels = (0..BINS).map(|bin| bins.frame().pixel(pixel, bin));
        for estimate in channels.chain([radiance.frame().pixel(pixel, 0)]) {
            write!(text, "{:.9e} {:.3e} ", estimate.value, estimate.error).unwrap();
        }
        text.truncate(text.trim_end().len());
        text.push('\n');
    }
    std::fs::write(file(), text).unwrap();
}
