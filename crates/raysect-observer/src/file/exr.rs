use std::collections::BTreeMap;
use std::io::Cursor;
use std::path::Path;

use exr::meta::attribute::{AttributeValue, Text};
use exr::prelude::{
    AnyChannel, AnyChannels, Blocks, Compression, Encoding, FlatSamples, Image, Layer, LayerAttributes,
    LineOrder, WritableImage,
};

use super::{FileError, write_atomically};

/// Bytes of the longest name of a channel or attribute.
const NAME_BYTES: usize = 255;
/// Longer names need a mark in the file.
const SHORT_NAME_BYTES: usize = 31;
const LONG_NAMES_MARK: u8 = 0x04;

/// Channels that belong together.
#[derive(Debug, Clone, PartialEq)]
pub struct ExrLayer {
    /// Such as `error`: its channel `R` becomes `error.R` of the file.
    ///
    /// Leave it empty for the layer that viewers show first, whose channels keep their plain names.
    pub name: String,
    /// Name and values of each channel, row by row from the top left: shape `[height, width]`.
    pub channels: Vec<(String, Vec<f64>)>,
}

/// A note in the header of a picture.
#[derive(Debug, Clone, PartialEq)]
pub enum ExrAttribute {
    /// A text (`string`). Right for integers above 2⁵³ too.
    Text(String),
    /// A number (`double`).
    Number(f64),
}

/// Saves layers of 32-bit floats as OpenEXR: one part, scan lines, lossless ZIP compression.
///
/// Channels are called `layer.channel` and sorted by name. Infinities and NaN survive; beyond 3.4e38 a value
/// becomes infinite. Equal pictures give equal bytes.
///
/// # Errors
/// [`FileError::Shape`], [`FileError::Encode`] for a picture without pixels or channels, of 2³⁰ pixels and more
/// along one side, for names that are empty, repeated, contain a zero character or exceed 255 bytes, and for
/// attributes whose name the format reserves, [`FileError::Io`].
pub fn save_exr(
    path: impl AsRef<Path>,
    width: usize,
    height: usize,
    layers: &[ExrLayer],
    attributes: &BTreeMap<String, ExrAttribute>,
) -> Result<(), FileError> {
    let path = path.as_ref();
    for (name, side) in [("width", width), ("height", height)] {
        if !(1..1 << 30).contains(&side) {
            return Err(FileError::encode(path, format!("{name} = {side} is outside 1 … 2³⁰ - 1")));
        }
    }
    let channels = collect_channels(path, width, height, layers)?;
    let bytes = encode(path, (width, height), channels, attributes)?;
    write_atomically(path, |writer| writer.write_all(&bytes))
}

/// The values of all channels by their full names.
fn collect_channels(
    path: &Path,
    width: usize,
    height: usize,
    layers: &[ExrLayer],
) -> Result<BTreeMap<String, Vec<f32>>, FileError> {
    let mut channels = BTreeMap::new();
    for layer in layers {
        for (channel, values) in &layer.channels {
            let name =
                if layer.name.is_empty() { channel.clone() } else { format!("{}.{channel}", layer.name) };
            check_name(path, "channel", &name)?;
            FileError::check_shape(path, &name, &[height, width], values.len())?;
            let values = values.iter().map(|&value| value as f32).collect();
            if channel.is_empty() || channels.insert(name.clone(), values).is_some() {
                return Err(FileError::encode(
                    path,
                    format!("the channel '{name}' occurs twice or has no name"),
                ));
            }
        }
    }
    Ok(channels)
}

fn check_name(path: &Path, kind: &str, name: &str) -> Result<(), FileError> {
    if name.is_empty() || name.contains('\0') || name.len() > NAME_BYTES {
        let rule = format!("must have 1 to {NAME_BYTES} bytes and no zero character");
        return Err(FileError::encode(path, format!("the name '{name}' of {kind} {rule}")));
    }
    Ok(())
}

fn encode(
    path: &Path,
    size: (usize, usize),
    channels: BTreeMap<String, Vec<f32>>,
    attributes: &BTreeMap<String, ExrAttribute>,
) -> Result<Vec<u8>, FileError> {
    let long_names = channels.keys().chain(attributes.keys()).any(|name| name.len() > SHORT_NAME_BYTES);
    let mut notes = LayerAttributes::default();
    for (name, value) in attributes {
        check_name(path, "attribute", name)?;
        notes.other.insert(text(name), attribute(value));
    }
    let list =
        channels.into_iter().map(|(name, values)| AnyChannel::new(text(&name), FlatSamples::F32(values)));
    let encoding = Encoding {
        compression: Compression::ZIP16,
        blocks: Blocks::ScanLines,
        line_order: LineOrder::Increasing,
    };
    let layer = Layer::new(size, notes, encoding, AnyChannels::sort(list.collect()));
    let mut file = Cursor::new(Vec::new());
    let written = Image::from_layer(layer).write().to_buffered(&mut file);
    written.map_err(|error| FileError::encode(path, error))?;
    let mut bytes = file.into_inner();
    finish_header(&mut bytes, long_names)
        .ok_or_else(|| FileError::encode(path, "the header is incomplete"))?;
    Ok(bytes)
}

fn text(text: &str) -> Text {
    Text::from_slice_unchecked(text.as_bytes())
}

fn attribute(value: &ExrAttribute) -> AttributeValue {
    match value {
        ExrAttribute::Text(value) => AttributeValue::Text(text(value)),
        ExrAttribute::Number(value) => AttributeValue::F64(*value),
    }
}

/// Sorts the attributes of an encoded picture, which the encoder leaves in arbitrary order, and marks long names.
///
/// An attribute is name, 0, type, 0, length of its value in 32 bits, value; a 0 ends the list.
fn finish_header(bytes: &mut [u8], long_names: bool) -> Option<()> {
    if long_names {
        *bytes.get_mut(5)? |= LONG_NAMES_MARK;
    }
    let header = bytes.get(8..)?;
    let (mut attributes, mut end) = (Vec::new(), 0);
    while *header.get(end)? != 0 {
        let start = end;
        for _ in 0..2 {
            end += 1 + header.get(end..)?.iter().position(|&byte| byte == 0)?;
        }
        let (length, _) = header.get(end..)?.split_first_chunk::<4>()?;
        end += 4 + usize::try_from(u32::from_le_bytes(*length)).ok()?;
        attributes.push(header.get(start..end)?);
    }
    // Names end in 0 and differ, so that whole attributes sort as their names do.
    attributes.sort_unstable();
    let sorted = attributes.concat();
    bytes.get_mut(8..8 + sorted.len())?.copy_from_slice(&sorted);
    Some(())
}

#[cfg(test)]
#[path = "exr_tests.rs"]
mod tests;
