//! The true radiance of each pixel of a small picture, from a run that is long enough to be called true.
//!
//! `cargo test --test statistics -- --ignored --nocapture write_truth` makes it anew, and says where.

use std::fmt::Write;
use std::path::PathBuf;

use raysect::prelude::*;

use crate::cornell::{self, Variant};
use crate::sensors::Moments;

/// Pixels to a side.
pub(crate) const SIDE: usize = 8;
/// Bins of the spectrum.
pub(crate) const BINS: usize = 15;
/// Samples of a pixel behind the truth, and a seed that no test uses.
const SAMPLES: u64 = 1 << 20;
const SEED: u64 = 1_000_003;

/// What is known of an element of the picture.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Known {
    /// Its mean.
    pub(crate) value: f64,
    /// Standard error of that.
    error: f64,
    /// Skewness of its samples.
    skewness: f64,
}

/// Every pixel in every bin, and after them over the whole spectrum: `[pixel][channel]`.
pub(crate) type Truth = Vec<Vec<Known>>;

impl Known {
    /// True for an element that is dark in every sample.
    pub(crate) fn is_dark(&self) -> bool {
        self.value == 0.0 && self.error == 0.0
    }

    /// Variance of a single sample.
    pub(crate) fn variance(&self) -> f64 {
        self.error * self.error * SAMPLES as f64
    }

    /// True if the mean of so many samples is so close to a normal distribution that 95 % intervals can be relied on:
    /// more than 25 γ² of them (W. G. Cochran, *Sampling Techniques*, 3rd ed., Wiley 1977, § 2.15).
    pub(crate) fn is_normal_after(&self, samples: u64) -> bool {
        samples as f64 > 25.0 * self.skewness * self.skewness
    }
}

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
            let known = |c: &[f64]| Known { value: c[0], error: c[1], skewness: c[2] };
            numbers.chunks_exact(3).map(known).collect()
        })
        .collect();
    assert_eq!(truth.len(), SIDE * SIDE);
    assert!(truth.iter().all(|pixel| pixel.len() == BINS + 1));
    truth
}

/// The truth of fewer and larger pixels: the averages of those that they cover, of which only the value is known.
pub(crate) fn coarse(truth: Truth, side: usize) -> Truth {
    if side == SIDE {
        return truth;
    }
    let each = SIDE / side;
    let empty = Known { value: 0.0, error: f64::NAN, skewness: f64::NAN };
    let mut averages = vec![vec![empty; BINS + 1]; side * side];
    for (pixel, channels) in truth.iter().enumerate() {
        let (row, column) = (pixel / SIDE / each, pixel % SIDE / each);
        for (average, known) in averages[row * side + column].iter_mut().zip(channels) {
            average.value += known.value / (each * each) as f64;
        }
    }
    averages
}

#[test]
#[ignore = "takes some minutes; writes a file, to be copied to where the other tests read it"]
fn write_truth() {
    let mut moments = Moments::new();
    camera(SIDE).seed(SEED).pixel_samples(SAMPLES).observe(&world(), &mut moments).unwrap();
    let mut text = format!(
        "# Radiance of the diffuse Cornell box (examples/common/cornell.rs), {SIDE}x{SIDE} pixels, {BINS} bins over\n\
         # 375 to 740 nm. One line a pixel, row by row: mean, its standard error, and skewness of the samples, in each\n\
         # bin [W/m2/sr/nm] and then of the whole spectrum [W/m2/sr]. Made with {SAMPLES} samples a pixel and seed\n\
         # {SEED} by cargo test --test statistics -- --ignored write_truth\n"
    );
    for pixel in 0..SIDE * SIDE {
        for bin in 0..=BINS {
            let (mean, skewness) = moments.of(pixel, bin);
            write!(text, "{:.9e} {:.3e} {skewness:.3} ", mean.value, mean.error).unwrap();
        }
        text.truncate(text.trim_end().len());
        text.push('\n');
    }
    let path = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(file().file_name().unwrap());
    std::fs::write(&path, text).unwrap();
    println!("{}", path.display());
}
