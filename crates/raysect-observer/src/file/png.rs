use std::path::Path;

use image::codecs::png::PngEncoder;
use image::{ExtendedColorType, ImageEncoder};

use super::{FileError, write_atomically};

/// Saves a picture of 8 bits per channel.
///
/// `rgb` holds red, green, blue of each pixel, row by row from the top left: shape `[height, width, 3]`.
/// Viewers take the values for sRGB.
///
/// # Errors
/// [`FileError::Shape`], [`FileError::Encode`] for a picture without pixels or of 2³¹ and more along one side,
/// [`FileError::Io`].
pub fn save_png_rgb8(
    path: impl AsRef<Path>,
    width: usize,
    height: usize,
    rgb: &[u8],
) -> Result<(), FileError> {
    let path = path.as_ref();
    FileError::check_shape(path, "the picture", &[height, width, 3], rgb.len())?;
    save(path, width, height, rgb, ExtendedColorType::Rgb8)
}

/// Saves a picture of 16 bits per channel, otherwise as [`save_png_rgb8`].
///
/// # Errors
/// As [`save_png_rgb8`].
pub fn save_png_rgb16(
    path: impl AsRef<Path>,
    width: usize,
    height: usize,
    rgb: &[u16],
) -> Result<(), FileError> {
    let path = path.as_ref();
    FileError::check_shape(path, "the picture", &[height, width, 3], rgb.len())?;
    // The encoder takes native bytes and turns them into big-endian ones.
    let bytes: Vec<u8> = rgb.iter().flat_map(|value| value.to_ne_bytes()).collect();
    save(path, width, height, &bytes, ExtendedColorType::Rgb16)
}

fn save(
    path: &Path,
    width: usize,
    height: usize,
    bytes: &[u8],
    colour: ExtendedColorType,
) -> Result<(), FileError> {
    let encoded = encode(path, width, height, bytes, colour)?;
    write_atomically(path, |writer| writer.write_all(&encoded))
}

/// The bytes of a PNG file of 8 bits per channel; the path is for messages.
#[cfg(feature = "plot")]
pub(crate) fn png_rgb8(path: &Path, width: usize, height: usize, rgb: &[u8]) -> Result<Vec<u8>, FileError> {
    FileError::check_shape(path, "the picture", &[height, width, 3], rgb.len())?;
    encode(path, width, height, rgb, ExtendedColorType::Rgb8)
}

fn encode(
    path: &Path,
    width: usize,
    height: usize,
    bytes: &[u8],
    colour: ExtendedColorType,
) -> Result<Vec<u8>, FileError> {
    let [columns, rows] = [side(path, "width", width)?, side(path, "height", height)?];
    let mut encoded = Vec::new();
    PngEncoder::new(&mut encoded)
        .write_image(bytes, columns, rows, colour)
        .map_err(|error| FileError::encode(path, error))?;
    Ok(encoded)
}

fn side(path: &Path, name: &str, length: usize) -> Result<u32, FileError> {
    match u32::try_from(length) {
        Ok(side @ 1..=0x7fff_ffff) => Ok(side),
        _ => Err(FileError::encode(path, format!("{name} = {length} is outside 1 … 2³¹ - 1"))),
    }
}

#[cfg(test)]
mod tests {
    use super::super::scratch::Folder;
    use super::*;

    #[test]
    fn eight_bits_come_back() {
        let folder = Folder::new();
        let path = folder.join("a.png");
        let rgb: Vec<u8> = (0..7 * 5 * 3).map(|i| (i * 37 % 256) as u8).collect();
        save_png_rgb8(&path, 7, 5, &rgb).unwrap();
        let picture = image::open(&path).unwrap();
        assert_eq!(picture.color(), image::ColorType::Rgb8);
        assert_eq!((picture.width(), picture.height()), (7, 5));
        assert_eq!(picture.into_rgb8().into_raw(), rgb);
        assert_eq!(folder.names(), ["a.png"]);
    }

    #[test]
    fn sixteen_bits_come_back() {
        let folder = Folder::new();
        let path = folder.join("a.png");
        let rgb: Vec<u16> = (0..3 * 4 * 3).map(|i| (i * 1823 + 258) as u16).collect();
        save_png_rgb16(&path, 3, 4, &rgb).unwrap();
        let picture = image::open(&path).unwrap();
        assert_eq!(picture.color(), image::ColorType::Rgb16);
        assert_eq!(picture.into_rgb16().into_raw(), rgb);
    }

    #[test]
    fn refuses_wrong_counts() {
        let folder = Folder::new();
        let path = folder.join("a.png");
        let shape = save_png_rgb8(&path, 2, 2, &[0; 11]);
        assert!(matches!(shape, Err(FileError::Shape { expected: 12, found: 11, .. })));
        let shape = save_png_rgb16(&path, usize::MAX, 2, &[0; 12]);
        assert!(matches!(shape, Err(FileError::Shape { expected: usize::MAX, .. })));
        assert!(matches!(save_png_rgb8(&path, 0, 2, &[]), Err(FileError::Encode { .. })));
        assert!(matches!(save_png_rgb16(&path, 1 << 40, 0, &[]), Err(FileError::Encode { .. })));
        assert!(folder.names().is_empty());
    }
}
