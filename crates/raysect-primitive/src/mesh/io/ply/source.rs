use super::super::bytes::Bytes;
use super::super::fault::Fault;
use super::super::text::{Text, any_number};
use super::header::{Element, Number, Property};

/// What follows the header.
#[derive(Debug)]
pub(super) enum Source<'a> {
    Text(Text<'a>),
    Bytes(Bytes<'a>),
}

impl Source<'_> {
    /// The number of rows of an element, if as many can follow.
    pub(super) fn admit(&self, element: &Element) -> Result<usize, Fault> {
        let (size, remaining) = match self {
            Self::Text(text) => (element.properties.len(), text.remaining()),
            Self::Bytes(bytes) => (element.properties.iter().map(Property::size).sum(), bytes.remaining()),
        };
        let fits = |n: &usize| n.checked_mul(size.max(1)).is_some_and(|n| n <= remaining);
        usize::try_from(element.count).ok().filter(fits).ok_or_else(|| {
            let name = String::from_utf8_lossy(&element.name).into_owned();
            let what = format!("{} rows of '{name}' do not fit {remaining} bytes", element.count);
            Fault::Line(element.line, what)
        })
    }

    /// A number; whole ones are exact.
    pub(super) fn number(&mut self, number: Number, what: &str) -> Result<f64, Fault> {
        match self {
            Self::Text(text) => {
                let word = text.expect(what)?;
                any_number(word, what).map_err(|what| text.fault(what))
            }
            Self::Bytes(bytes) => Ok(match number {
                Number::I8 => f64::from(i8::from_le_bytes(bytes.little(what)?)),
                Number::U8 => f64::from(u8::from_le_bytes(bytes.little(what)?)),
                Number::I16 => f64::from(i16::from_le_bytes(bytes.little(what)?)),
                Number::U16 => f64::from(u16::from_le_bytes(bytes.little(what)?)),
                Number::I32 => f64::from(i32::from_le_bytes(bytes.little(what)?)),
                Number::U32 => f64::from(u32::from_le_bytes(bytes.little(what)?)),
                Number::F32 => f64::from(f32::from_le_bytes(bytes.little(what)?)),
                Number::F64 => f64::from_le_bytes(bytes.little(what)?),
            }),
        }
    }

    /// A list, whose items are handed over one by one.
    pub(super) fn list(
        &mut self,
        length: Number,
        item: Number,
        mut take: impl FnMut(f64) -> Result<(), String>,
    ) -> Result<(), Fault> {
        let count = self.number(length, "the length of a list")?;
        if !(count >= 0.0 && count == f64::from(count as u32)) {
            return Err(self.fault(format!("{count} is no length of a list")));
        }
        for _ in 0..count as u32 {
            let value = self.number(item, "an item of a list")?;
            take(value).map_err(|what| self.fault(what))?;
        }
        Ok(())
    }

    /// Line or byte of what comes next.
    pub(super) fn place(&self) -> usize {
        match self {
            Self::Text(text) => {
                let mut next = text.clone();
                next.word();
                next.line_number()
            }
            Self::Bytes(bytes) => bytes.position(),
        }
    }

    /// A fault in what was read last.
    pub(super) fn fault(&self, what: String) -> Fault {
        match self {
            Self::Text(text) => text.fault(what),
            Self::Bytes(bytes) => bytes.fault(what),
        }
    }

    /// Makes a fault of a [`place`](Self::place).
    pub(super) fn fault_at(&self) -> fn(usize, String) -> Fault {
        match self {
            Self::Text(_) => Fault::Line,
            Self::Bytes(_) => Fault::Byte,
        }
    }

    /// That nothing follows but white space.
    pub(super) fn end(&mut self) -> Result<(), Fault> {
        match self {
            Self::Text(text) => match text.word() {
                Some(_) => Err(text.fault("more follows than the header tells")),
                None => Ok(()),
            },
            Self::Bytes(bytes) => {
                let rest = bytes.clone().take(bytes.remaining(), "white space")?;
                if rest.trim_ascii().is_empty() {
                    return Ok(());
                }
                Err(bytes.fault(format!("{} bytes follow that the header does not tell of", rest.len())))
            }
        }
    }
}
