//! A picture that light is added to, pixel by pixel.

use std::path::Path;

use raysect::observer::file::{FileError, save_png_rgb8};

pub(crate) struct Canvas {
    pub(crate) columns: usize,
    pub(crate) rows: usize,
    /// Linear red, green and blue.
    pixels: Vec<[f64; 3]>,
}

impl Canvas {
    /// A black picture.
    pub(crate) fn new((columns, rows): (usize, usize)) -> Self {
        Self { columns, rows, pixels: vec![[0.0; 3]; columns * rows] }
    }

    /// Adds so much of a colour to a pixel.
    pub(crate) fn add(&mut self, column: usize, row: usize, colour: [f64; 3], amount: f64) {
        let pixel = &mut self.pixels[row * self.columns + column];
        *pixel = std::array::from_fn(|i| pixel[i] + amount * colour[i]);
    }

    /// Writes a PNG; bright pixels approach the limit and keep their hue.
    pub(crate) fn save(&self, path: &Path) -> Result<(), FileError> {
        let encoded = |pixel: &[f64; 3]| {
            let brightest = pixel.iter().copied().fold(1e-9, f64::max);
            let factor = (1.0 - (-brightest).exp()) / brightest;
            pixel.map(|light| (255.0 * (factor * light).powf(1.0 / 2.2)).round() as u8)
        };
        let bytes: Vec<u8> = self.pixels.iter().flat_map(encoded).collect();
        save_png_rgb8(path, self.columns, self.rows, &bytes)
    }
}
