use super::super::bytes::Bytes;
use super::super::fault::Fault;
use super::super::text::{Text, integer, shown, words};
use super::source::Source;

/// What a file says of its contents.
#[derive(Debug)]
pub(super) struct Header {
    pub(super) elements: Vec<Element>,
}

/// A table of rows.
#[derive(Debug)]
pub(super) struct Element {
    pub(super) name: Vec<u8>,
    pub(super) count: u64,
    /// The line that declares it.
    pub(super) line: usize,
    pub(super) properties: Vec<Property>,
}

/// A column of a table.
#[derive(Debug)]
pub(super) struct Property {
    pub(super) name: Vec<u8>,
    pub(super) kind: Kind,
}

#[derive(Debug, Clone, Copy)]
pub(super) enum Kind {
    Scalar(Number),
    List { length: Number, item: Number },
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Number {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    F32,
    F64,
}

impl Number {
    fn parse(word: &[u8]) -> Option<Self> {
        Some(match word {
            b"char" | b"int8" => Self::I8,
            b"uchar" | b"uint8" => Self::U8,
            b"short" | b"int16" => Self::I16,
            b"ushort" | b"uint16" => Self::U16,
            b"int" | b"int32" => Self::I32,
            b"uint" | b"uint32" => Self::U32,
            b"float" | b"float32" => Self::F32,
            b"double" | b"float64" => Self::F64,
            _ => return None,
        })
    }

    /// Bytes of a number.
    pub(super) fn size(self) -> usize {
        match self {
            Self::I8 | Self::U8 => 1,
            Self::I16 | Self::U16 => 2,
            Self::I32 | Self::U32 | Self::F32 => 4,
            Self::F64 => 8,
        }
    }

    pub(super) fn is_integer(self) -> bool {
        !matches!(self, Self::F32 | Self::F64)
    }
}

impl Property {
    /// The least number of bytes of a value in a binary file.
    pub(super) fn size(&self) -> usize {
        match self.kind {
            Kind::Scalar(number) => number.size(),
            Kind::List { length, .. } => length.size(),
        }
    }
}

impl Header {
    /// The header, and what follows it.
    pub(super) fn read(bytes: &[u8]) -> Result<(Self, Source<'_>), Fault> {
        let mut text = Text::new(bytes);
        let first = text.line().unwrap_or_default();
        if first.trim_ascii() != b"ply" {
            return Err(text.fault("not a PLY file: the first line is not 'ply'"));
        }
        let mut encoding = None;
        let mut header = Self { elements: Vec::new() };
        loop {
            let Some(line) = text.line() else {
                return Err(text.fault("the header has no end"));
            };
            let line: Vec<&[u8]> = words(line).collect();
            match line.as_slice() {
                [] | [b"comment" | b"obj_info", ..] => {}
                // Early versions of Blender forget to call it a comment.
                [b"Created", b"by", ..] => {}
                [b"format", kind, b"1.0"] => encoding = Some(*kind),
                [b"end_header"] => break,
                line => header.declare(line, text.line_number()).map_err(|what| text.fault(what))?,
            }
        }
        let at = text.position();
        let source = match encoding {
            Some(b"ascii") => Source::Text(text),
            Some(b"binary_little_endian") => Source::Bytes(Bytes::new(bytes, at, false)),
            Some(b"binary_big_endian") => Source::Bytes(Bytes::new(bytes, at, true)),
            Some(other) => return Err(text.fault(format!("the format '{}' is not known", shown(other)))),
            None => return Err(text.fault("the header names no format of version 1.0")),
        };
        Ok((header, source))
    }

    fn declare(&mut self, line: &[&[u8]], number: usize) -> Result<(), String> {
        match line {
            [b"element", name, count] => {
                let count = integer(count, "the number of rows")?;
                let name = name.to_vec();
                self.elements.push(Element { name, count, line: number, properties: Vec::new() });
            }
            [b"property", b"list", length, item, name] => {
                let kind = Kind::List { length: known(length)?, item: known(item)? };
                if !known(length)?.is_integer() {
                    return Err(format!("the list '{}' has a length that is no integer", shown(name)));
                }
                self.add(name, kind)?;
            }
            [b"property", number, name] => self.add(name, Kind::Scalar(known(number)?))?,
            _ => return Err(format!("'{}' does not begin a line of a header", shown(line[0]))),
        }
        Ok(())
    }

    fn add(&mut self, name: &[u8], kind: Kind) -> Result<(), String> {
        let element = self.elements.last_mut().ok_or("a property before the first element")?;
        element.properties.push(Property { name: name.to_vec(), kind });
        Ok(())
    }
}

fn known(word: &[u8]) -> Result<Number, String> {
    Number::parse(word).ok_or_else(|| format!("the type '{}' is not known", shown(word)))
}
