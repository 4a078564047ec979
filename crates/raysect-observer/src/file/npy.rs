use std::io::{self, Write};

/// An array as NumPy stores it, in C order: the last index runs fastest.
#[derive(Debug, Clone, PartialEq)]
pub struct NpyArray {
    /// Length of each axis; empty for a single number.
    pub shape: Vec<usize>,
    /// The values, as many as the product of the shape.
    pub data: NpyData,
}

/// The values of an array.
///
/// Narrower numbers of a file are widened: `float32` to `float64`, `int8`, `int16` and `int32` to `int64`,
/// `uint16` and `uint32` to `uint64`.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum NpyData {
    /// NumPy's `float64`.
    F64(Vec<f64>),
    /// NumPy's `int64`.
    I64(Vec<i64>),
    /// NumPy's `uint64`.
    U64(Vec<u64>),
    /// NumPy's `uint8`.
    U8(Vec<u8>),
    /// NumPy's `bool`.
    Bool(Vec<bool>),
    /// NumPy's `str`. No text may end in a zero character, which NumPy takes for padding.
    Text(Vec<String>),
}

impl NpyData {
    /// Number of values.
    pub fn len(&self) -> usize {
        match self {
            Self::F64(values) => values.len(),
            Self::I64(values) => values.len(),
            Self::U64(values) => values.len(),
            Self::U8(values) => values.len(),
            Self::Bool(values) => values.len(),
            Self::Text(values) => values.len(),
        }
    }

    /// True without values.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The type as NumPy writes it, such as `<f8`.
    pub fn dtype(&self) -> String {
        match self {
            Self::F64(_) => "<f8".to_owned(),
            Self::I64(_) => "<i8".to_owned(),
            Self::U64(_) => "<u8".to_owned(),
            Self::U8(_) => "|u1".to_owned(),
            Self::Bool(_) => "|b1".to_owned(),
            Self::Text(values) => format!("<U{}", characters(values)),
        }
    }

    /// Bytes of one value.
    fn item_size(&self) -> usize {
        match self {
            Self::F64(_) | Self::I64(_) | Self::U64(_) => 8,
            Self::U8(_) | Self::Bool(_) => 1,
            Self::Text(values) => 4 * characters(values),
        }
    }
}

/// Characters of the longest text, at least 1.
fn characters(texts: &[String]) -> usize {
    texts.iter().map(|text| text.chars().count()).max().unwrap_or(0).max(1)
}

impl NpyArray {
    /// A single number.
    pub fn scalar(value: f64) -> Self {
        Self { shape: Vec::new(), data: NpyData::F64(vec![value]) }
    }

    /// A single text.
    pub fn text(value: impl Into<String>) -> Self {
        Self { shape: Vec::new(), data: NpyData::Text(vec![value.into()]) }
    }

    /// Bytes of the `.npy` file.
    pub(super) fn file_size(&self) -> u64 {
        self.header().len() as u64 + self.data.len() as u64 * self.data.item_size() as u64
    }

    /// Writes the `.npy` file, version 1.0.
    pub(super) fn write(&self, writer: &mut dyn Write) -> io::Result<()> {
        writer.write_all(&self.header())?;
        match &self.data {
            NpyData::F64(values) => write_words(values, writer, |v| v.to_le_bytes()),
            NpyData::I64(values) => write_words(values, writer, |v| v.to_le_bytes()),
            NpyData::U64(values) => write_words(values, writer, |v| v.to_le_bytes()),
            NpyData::U8(values) => writer.write_all(values),
            NpyData::Bool(values) => write_words(values, writer, |&v| [u8::from(v)]),
            NpyData::Text(values) => write_texts(values, writer),
        }
    }

    /// Magic bytes, version, length and dictionary, padded to a multiple of 64 bytes.
    fn header(&self) -> Vec<u8> {
        let lengths: String = self.shape.iter().map(|length| format!("{length}, ")).collect();
        // Python's tuples: (), (3,) and (3, 4).
        let shape = if self.shape.len() == 1 { lengths.trim_end() } else { lengths.trim_end_matches(", ") };
        let text =
            format!("{{'descr': '{}', 'fortran_order': False, 'shape': ({shape}), }}", self.data.dtype());
        let length = (10 + text.len() + 1).next_multiple_of(64) - 10;
        let mut header = b"\x93NUMPY\x01\x00".to_vec();
        // At most 32 axes, so that two bytes suffice.
        header.extend_from_slice(&(length as u16).to_le_bytes());
        header.extend_from_slice(text.as_bytes());
        header.resize(10 + length - 1, b' ');
        header.push(b'\n');
        header
    }
}

/// Writes in blocks, without a second copy of the whole array.
fn write_words<T, const N: usize>(
    values: &[T],
    writer: &mut dyn Write,
    to_bytes: impl Fn(&T) -> [u8; N],
) -> io::Result<()> {
    for block in values.chunks(8192) {
        let bytes: Vec<u8> = block.iter().flat_map(&to_bytes).collect();
        writer.write_all(&bytes)?;
    }
    Ok(())
}

/// Texts as 32-bit characters, padded with zeros to the longest.
fn write_texts(texts: &[String], writer: &mut dyn Write) -> io::Result<()> {
    let width = 4 * characters(texts);
    for text in texts {
        let mut bytes: Vec<u8> = text.chars().flat_map(|c| u32::from(c).to_le_bytes()).collect();
        bytes.resize(width, 0);
        writer.write_all(&bytes)?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn text(shape: &[usize]) -> String {
        let header = NpyArray { shape: shape.to_vec(), data: NpyData::F64(Vec::new()) }.header();
        assert_eq!(header.len() % 64, 0);
        String::from_utf8(header[10..].to_vec()).unwrap().trim_end().to_owned()
    }

    #[test]
    fn headers_are_python_dictionaries() {
        assert_eq!(text(&[]), "{'descr': '<f8', 'fortran_order': False, 'shape': (), }");
        assert_eq!(text(&[3]), "{'descr': '<f8', 'fortran_order': False, 'shape': (3,), }");
        assert_eq!(text(&[3, 0, 4]), "{'descr': '<f8', 'fortran_order': False, 'shape': (3, 0, 4), }");
    }

    #[test]
    fn sizes_are_those_of_the_bytes() {
        let texts = vec!["é".to_owned(), String::new(), "abc".to_owned()];
        for data in [
            NpyData::F64(vec![1.0; 20_000]),
            NpyData::I64(vec![-1]),
            NpyData::U64(vec![]),
            NpyData::U8(vec![1, 2, 3]),
            NpyData::Bool(vec![true]),
            NpyData::Text(texts),
            NpyData::Text(vec![]),
        ] {
            let array = NpyArray { shape: vec![data.len()], data };
            let mut bytes = Vec::new();
            array.write(&mut bytes).unwrap();
            assert_eq!(bytes.len() as u64, array.file_size(), "{}", array.data.dtype());
        }
    }
}
