use super::error::{Fault, product, take, word};
use super::{NpyArray, NpyData};

/// The most axes an array of NumPy can have.
const AXES: usize = 64;

/// Reads a `.npy` file of version 1 to 3. Positions of faults count from its start.
pub(super) fn read_npy(bytes: &[u8]) -> Result<NpyArray, Fault> {
    if take(bytes, 0, 6)? != b"\x93NUMPY" {
        return Err(Fault::new(0, "not an array of NumPy: the magic bytes are missing"));
    }
    let [major, minor] = word(bytes, 6)?;
    let (start, length) = match (major, minor) {
        (1, 0) => (10, u32::from(u16::from_le_bytes(word(bytes, 8)?))),
        (2 | 3, 0) => (12, u32::from_le_bytes(word(bytes, 8)?)),
        _ => return Err(Fault::new(6, format!("version {major}.{minor} of .npy: 1.0, 2.0 or 3.0 is read"))),
    };
    let length = usize::try_from(length).map_err(|_| Fault::new(8, "the header is too long"))?;
    let header = Header::parse(take(bytes, start, length)?).map_err(|f| Fault::new(start + f.at, f.what))?;
    let start = start + length;
    read_values(header, take(bytes, start, bytes.len() - start)?).map_err(|what| Fault::new(start, what))
}

fn read_values(header: Header, bytes: &[u8]) -> Result<NpyArray, String> {
    let Header { dtype, fortran_order, shape } = header;
    if product(&shape).and_then(|count| count.checked_mul(dtype.size)) != Some(bytes.len()) {
        let Dtype { kind, size, .. } = dtype;
        let kind = char::from(kind);
        return Err(format!(
            "{} bytes do not fill the shape {shape:?} of {kind}, {size} bytes each",
            bytes.len()
        ));
    }
    let data = dtype.decode(bytes)?;
    let data = if fortran_order { to_c_order(data, &shape) } else { data };
    Ok(NpyArray { shape, data })
}

#[derive(Clone, Copy)]
struct Dtype {
    big_endian: bool,
    kind: u8,
    /// Bytes of one value, positive.
    size: usize,
}

impl Dtype {
    fn parse(text: &str) -> Result<Self, String> {
        let refused =
            || format!("the type '{text}' is not read: f4, f8, i1, i2, i4, i8, u1, u2, u4, u8, b1 and U are");
        let (&[order, kind], digits) = text.as_bytes().split_first_chunk::<2>().ok_or_else(refused)?;
        let digits = std::str::from_utf8(digits).map_err(|_| refused())?;
        let size: usize = digits.parse().map_err(|_| refused())?;
        let size = match (kind, size) {
            (b'f', 4 | 8) | (b'i' | b'u', 1 | 2 | 4 | 8) | (b'b', 1) => size,
            (b'U', 1..) => size.checked_mul(4).ok_or_else(refused)?,
            _ => return Err(refused()),
        };
        match order {
            b'<' | b'>' => Ok(Self { big_endian: order == b'>', kind, size }),
            b'|' if size == 1 => Ok(Self { big_endian: false, kind, size }),
            _ => Err(refused()),
        }
    }

    fn decode(self, bytes: &[u8]) -> Result<NpyData, String> {
        let big = self.big_endian;
        Ok(match (self.kind, self.size) {
            (b'f', 4) => NpyData::F64(words(bytes, big, |w| f64::from(f32::from_le_bytes(w)))),
            (b'f', _) => NpyData::F64(words(bytes, big, f64::from_le_bytes)),
            (b'i', 1) => NpyData::I64(words(bytes, big, |w| i64::from(i8::from_le_bytes(w)))),
            (b'i', 2) => NpyData::I64(words(bytes, big, |w| i64::from(i16::from_le_bytes(w)))),
            (b'i', 4) => NpyData::I64(words(bytes, big, |w| i64::from(i32::from_le_bytes(w)))),
            (b'i', _) => NpyData::I64(words(bytes, big, i64::from_le_bytes)),
            (b'u', 1) => NpyData::U8(bytes.to_vec()),
            (b'u', 2) => NpyData::U64(words(bytes, big, |w| u64::from(u16::from_le_bytes(w)))),
            (b'u', 4) => NpyData::U64(words(bytes, big, |w| u64::from(u32::from_le_bytes(w)))),
            (b'u', _) => NpyData::U64(words(bytes, big, u64::from_le_bytes)),
            (b'b', _) => NpyData::Bool(bytes.iter().map(|&byte| byte != 0).collect()),
            (_, size) => NpyData::Text(
                bytes.chunks_exact(size).map(|text| decode_text(text, big)).collect::<Result<_, _>>()?,
            ),
        })
    }
}

fn words<T, const N: usize>(bytes: &[u8], big_endian: bool, decode: impl Fn([u8; N]) -> T) -> Vec<T> {
    let (words, _) = bytes.as_chunks::<N>();
    let little = |&(mut word): &[u8; N]| {
        if big_endian {
            word.reverse();
        }
        decode(word)
    };
    words.iter().map(little).collect()
}

fn decode_text(bytes: &[u8], big_endian: bool) -> Result<String, String> {
    let codes = words(bytes, big_endian, u32::from_le_bytes);
    let padding = codes.iter().rev().take_while(|&&code| code == 0).count();
    let decode = |&code: &u32| char::from_u32(code).ok_or_else(|| format!("{code:#x} is not a character"));
    codes[..codes.len() - padding].iter().map(decode).collect()
}

fn to_c_order(data: NpyData, shape: &[usize]) -> NpyData {
    match data {
        NpyData::F64(values) => NpyData::F64(reorder(&values, shape)),
        NpyData::I64(values) => NpyData::I64(reorder(&values, shape)),
        NpyData::U64(values) => NpyData::U64(reorder(&values, shape)),
        NpyData::U8(values) => NpyData::U8(reorder(&values, shape)),
        NpyData::Bool(values) => NpyData::Bool(reorder(&values, shape)),
        NpyData::Text(values) => NpyData::Text(reorder(&values, shape)),
    }
}

/// From the order in which the first index runs fastest to that in which the last one does.
fn reorder<T: Clone>(values: &[T], shape: &[usize]) -> Vec<T> {
    if values.is_empty() {
        return Vec::new();
    }
    let stride = |axis: usize| shape[..axis].iter().product::<usize>();
    let strides: Vec<usize> = (0..shape.len()).map(stride).collect();
    let (mut index, mut position) = (vec![0; shape.len()], 0);
    let mut next = || {
        let value = values[position].clone();
        for axis in (0..shape.len()).rev() {
            index[axis] += 1;
            position += strides[axis];
            if index[axis] < shape[axis] {
                break;
            }
            position -= index[axis] * strides[axis];
            index[axis] = 0;
        }
        value
    };
    (0..values.len()).map(|_| next()).collect()
}

struct Header {
    dtype: Dtype,
    fortran_order: bool,
    shape: Vec<usize>,
}

impl Header {
    /// Reads `{'descr': '<f8', 'fortran_order': False, 'shape': (3, 4), }` with its keys in any order.
    fn parse(text: &[u8]) -> Result<Self, Fault> {
        let mut literal = Literal { text, at: 0 };
        let (mut dtype, mut fortran_order, mut shape) = (None, None, None);
        literal.expect(b'{')?;
        while !literal.accept(b'}') {
            let at = literal.at;
            let key = literal.quoted()?;
            literal.expect(b':')?;
            let repeated = match key {
                "descr" => dtype.replace(literal.dtype()?).is_some(),
                "fortran_order" => fortran_order.replace(literal.truth()?).is_some(),
                "shape" => shape.replace(literal.shape()?).is_some(),
                _ => return Err(Fault::new(at, format!("the key '{key}' of the header is unknown"))),
            };
            if repeated {
                return Err(Fault::new(at, format!("the key '{key}' of the header is repeated")));
            }
            if !literal.accept(b',') {
                literal.expect(b'}')?;
                break;
            }
        }
        literal.expect_end()?;
        let missing = |key| Fault::new(0, format!("the header lacks the key '{key}'"));
        Ok(Self {
            dtype: dtype.ok_or_else(|| missing("descr"))?,
            fortran_order: fortran_order.ok_or_else(|| missing("fortran_order"))?,
            shape: shape.ok_or_else(|| missing("shape"))?,
        })
    }
}

/// A reader of the few literals of Python that occur in a header.
struct Literal<'a> {
    text: &'a [u8],
    at: usize,
}

impl<'a> Literal<'a> {
    fn skip(&mut self, skipped: impl Fn(&u8) -> bool) -> &'a [u8] {
        let rest = self.text.get(self.at..).unwrap_or_default();
        let count = rest.iter().take_while(|byte| skipped(byte)).count();
        self.at += count;
        &rest[..count]
    }

    fn peek(&mut self) -> Option<u8> {
        self.skip(u8::is_ascii_whitespace);
        self.text.get(self.at).copied()
    }

    fn accept(&mut self, byte: u8) -> bool {
        let found = self.peek() == Some(byte);
        self.at += usize::from(found);
        found
    }

    fn expect(&mut self, byte: u8) -> Result<(), Fault> {
        if self.accept(byte) {
            Ok(())
        } else {
            Err(self.fault(format!("'{}' is expected", char::from(byte))))
        }
    }

    fn expect_end(&mut self) -> Result<(), Fault> {
        if self.peek().is_none() { Ok(()) } else { Err(self.fault("the header should end")) }
    }

    fn fault(&self, what: impl ToString) -> Fault {
        Fault::new(self.at, what)
    }

    fn quoted(&mut self) -> Result<&'a str, Fault> {
        let Some(mark @ (b'\'' | b'"')) = self.peek() else {
            return Err(self.fault("a text in quotation marks is expected"));
        };
        self.at += 1;
        let at = self.at;
        let text = self.skip(|&byte| byte != mark);
        self.expect(mark)?;
        std::str::from_utf8(text).map_err(|error| Fault::new(at + error.valid_up_to(), "not UTF-8"))
    }

    fn dtype(&mut self) -> Result<Dtype, Fault> {
        if self.peek() == Some(b'[') {
            return Err(self.fault("arrays of records are not read"));
        }
        let at = self.at;
        Dtype::parse(self.quoted()?).map_err(|what| Fault::new(at, what))
    }

    fn truth(&mut self) -> Result<bool, Fault> {
        self.peek();
        let at = self.at;
        match self.skip(u8::is_ascii_alphabetic) {
            b"True" => Ok(true),
            b"False" => Ok(false),
            _ => Err(Fault::new(at, "True or False is expected")),
        }
    }

    fn shape(&mut self) -> Result<Vec<usize>, Fault> {
        let mut shape = Vec::new();
        self.expect(b'(')?;
        while !self.accept(b')') {
            if shape.len() == AXES {
                return Err(self.fault(format!("more than {AXES} axes")));
            }
            shape.push(self.integer()?);
            // The mark of long integers, which Python 2 wrote.
            self.accept(b'L');
            if !self.accept(b',') {
                self.expect(b')')?;
                break;
            }
        }
        Ok(shape)
    }

    fn integer(&mut self) -> Result<usize, Fault> {
        self.peek();
        let at = self.at;
        let digits = std::str::from_utf8(self.skip(u8::is_ascii_digit)).unwrap_or_default();
        digits.parse().map_err(|error| Fault::new(at, format!("the length of an axis: {error}")))
    }
}

#[cfg(test)]
#[path = "npy_read_tests.rs"]
mod tests;
