//! Recorded frames of the Cornell box, and ours of the same camera.

use std::path::Path;

use raysect::observer::file::{NpyArray, NpyData, load_npz};
use raysect::optical::colour::CieObserver;
use raysect::prelude::*;

use crate::comparison::Picture;
use crate::cornell::{self, Variant};

fn numbers(array: Option<&NpyArray>, name: &str) -> Result<(Vec<usize>, Vec<f64>), String> {
    match array {
        Some(NpyArray { shape, data: NpyData::F64(values) }) => Ok((shape.clone(), values.clone())),
        Some(_) => Err(format!("'{name}' is not an array of floating-point numbers")),
        None => Err(format!("there is no array '{name}'")),
    }
}

/// Reads `xyz_mean` and `xyz_error`, \[row, column, XYZ\].
pub(crate) fn load(path: &Path) -> Result<Picture, String> {
    let arrays = load_npz(path).map_err(|e| e.to_string())?;
    let (shape, mean) = numbers(arrays.get("xyz_mean"), "xyz_mean")?;
    let (error_shape, error) = numbers(arrays.get("xyz_error"), "xyz_error")?;
    match shape[..] {
        [rows, columns, channels] if error_shape == shape && channels == 3 => {
            Ok(Picture { rows, columns, channels, mean, error })
        }
        _ => Err(format!("shapes {shape:?} and {error_shape:?}: [rows, columns, 3] is needed")),
    }
}

/// The variant that a file's name tells.
pub(crate) fn variant_of(path: &Path) -> Option<Variant> {
    let name = path.file_name()?.to_str()?;
    match (name.contains("glass"), name.contains("diffuse")) {
        (true, false) => Some(Variant::Glass),
        (false, true) => Some(Variant::Diffuse),
        _ => None,
    }
}

/// Our picture of the same pixels, with a median relative error of at most `error`.
pub(crate) fn render(
    variant: Variant,
    columns: usize,
    rows: usize,
    bins: usize,
    seed: u64,
    error: f64,
) -> raysect::Result<Picture> {
    let world = cornell::cornell_box(variant)?;
    let camera = cornell::camera((columns, rows))?.spectral_bins(bins).seed(seed).quiet(true);
    // Raysect's table: pixels without noise then agree to rounding.
    let mut rgb = RgbPipeline2D::new().observer(CieObserver::FiveNanometres);
    let mut samples = 64;
    loop {
        camera.clone().pixel_samples(samples).observe(&world, &mut rgb)?;
        let frame = rgb.frame();
        let picture = Picture { rows, columns, channels: 3, mean: frame.mean(), error: frame.error() };
        let ratio = picture.median_error() / error;
        if ratio <= 1.0 {
            return Ok(picture);
        }
        // A little more than the error now seen asks for, at most four times as many at once.
        let all = frame.samples(0) as f64;
        samples = ((all * (1.02 * ratio * ratio - 1.0)).ceil()).clamp(64.0, 3.0 * all) as u64;
    }
}
