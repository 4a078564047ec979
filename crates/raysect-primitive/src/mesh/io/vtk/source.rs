use super::super::fault::Fault;
use super::super::text::{Text, any_number, integer, shown, words};

/// Lines of text, and numbers between them as text or as bytes, the highest first.
#[derive(Debug)]
pub(super) struct Source<'a> {
    bytes: &'a [u8],
    text: Text<'a>,
    pub(super) is_binary: bool,
    /// Position of the number that was read last, in a binary file.
    at: usize,
}

/// A type of numbers.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Number {
    Bit,
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    I64,
    U64,
    F32,
    F64,
}

impl Number {
    pub(super) fn parse(word: &[u8]) -> Result<Self, String> {
        Ok(match word.to_ascii_lowercase().as_slice() {
            b"bit" => Self::Bit,
            b"char" | b"signed_char" => Self::I8,
            b"unsigned_char" => Self::U8,
            b"short" => Self::I16,
            b"unsigned_short" => Self::U16,
            b"int" | b"vtkidtype" => Self::I32,
            b"unsigned_int" => Self::U32,
            b"long" | b"vtktypeint64" => Self::I64,
            b"unsigned_long" | b"vtktypeuint64" => Self::U64,
            b"float" => Self::F32,
            b"double" => Self::F64,
            _ => return Err(format!("the type '{}' is not read", shown(word))),
        })
    }

    /// Bytes of a number.
    fn size(self) -> usize {
        match self {
            Self::Bit | Self::I8 | Self::U8 => 1,
            Self::I16 | Self::U16 => 2,
            Self::I32 | Self::U32 | Self::F32 => 4,
            Self::I64 | Self::U64 | Self::F64 => 8,
        }
    }

    /// A number from its bytes; whole ones up to 2⁵³ are exact.
    fn decode(self, bytes: &[u8]) -> f64 {
        let mut wide = [0; 8];
        wide[..bytes.len()].copy_from_slice(bytes);
        let word = u64::from_be_bytes(wide);
        match self {
            Self::Bit | Self::U8 => f64::from((word >> 56) as u8),
            Self::I8 => f64::from((word >> 56) as i8),
            Self::I16 => f64::from((word >> 48) as i16),
            Self::U16 => f64::from((word >> 48) as u16),
            Self::I32 => f64::from((word >> 32) as i32),
            Self::U32 => f64::from((word >> 32) as u32),
            Self::I64 => word as i64 as f64,
            Self::U64 => word as f64,
            Self::F32 => f64::from(f32::from_bits((word >> 32) as u32)),
            Self::F64 => f64::from_bits(word),
        }
    }
}

impl<'a> Source<'a> {
    pub(super) fn new(bytes: &'a [u8]) -> Self {
        Self { bytes, text: Text::new(bytes), is_binary: false, at: 0 }
    }

    /// Bytes of the file.
    pub(super) fn size(&self) -> usize {
        self.bytes.len()
    }

    /// The next line, as it stands.
    pub(super) fn raw_line(&mut self) -> Option<&'a [u8]> {
        let line = self.text.line();
        self.at = self.text.start();
        line
    }

    /// The words of the next line that has some; none at the end of the file.
    pub(super) fn line(&mut self) -> Vec<&'a [u8]> {
        while let Some(line) = self.raw_line() {
            let words: Vec<&[u8]> = words(line).collect();
            if !words.is_empty() {
                return words;
            }
        }
        Vec::new()
    }

    /// True if the next line begins with a word.
    pub(super) fn begins_with(&self, word: &[u8]) -> bool {
        let mut next = self.text.clone();
        if !self.is_binary {
            return next.word().is_some_and(|found| found.eq_ignore_ascii_case(word));
        }
        let rest = &self.bytes[self.text.position()..];
        let rest = rest.trim_ascii_start();
        rest.get(..word.len()).is_some_and(|found| found.eq_ignore_ascii_case(word))
    }

    /// A count in a line, from which as many numbers of `size` bytes must follow.
    pub(super) fn count(&self, word: &[u8], what: &str) -> Result<usize, Fault> {
        let count: u64 = integer(word, what).map_err(|what| self.fault(what))?;
        self.admit(count, what)
    }

    /// A count of things of at least a byte, if they can follow. (A bit counts as one only in a text.)
    pub(super) fn admit(&self, count: u64, what: &str) -> Result<usize, Fault> {
        let remaining = self.text.remaining() as u64;
        let most = if self.is_binary { remaining.saturating_mul(8) } else { remaining };
        usize::try_from(count)
            .ok()
            .filter(|_| count <= most)
            .ok_or_else(|| self.fault(format!("{what}: {count} should follow, {remaining} bytes do")))
    }

    /// The next number.
    pub(super) fn number(&mut self, number: Number, what: &str) -> Result<f64, Fault> {
        if !self.is_binary {
            let word = self.text.expect(what)?;
            return any_number(word, what).map_err(|what| self.fault(what));
        }
        let start = self.text.position();
        let bytes = self.take(number.size(), what)?;
        self.at = start;
        Ok(number.decode(bytes))
    }

    /// The next number, finite.
    pub(super) fn finite(&mut self, number: Number, what: &str) -> Result<f64, Fault> {
        let value = self.number(number, what)?;
        if value.is_finite() { Ok(value) } else { Err(self.fault(format!("{what}: {value} is not finite"))) }
    }

    fn take(&mut self, count: usize, what: &str) -> Result<&'a [u8], Fault> {
        let start = self.text.position();
        let found = start.checked_add(count).and_then(|end| self.bytes.get(start..end));
        let missing = || format!("the file ends at byte {} where {what} should follow", self.bytes.len());
        let found = found.ok_or_else(|| Fault::Byte(start, missing()))?;
        self.text.skip_to(start + count);
        Ok(found)
    }

    /// Passes over `count` numbers.
    pub(super) fn pass_over(&mut self, count: usize, number: Number, what: &str) -> Result<(), Fault> {
        self.each(count, number, what, |_| ())
    }

    /// Hands over `count` numbers one by one.
    pub(super) fn each(
        &mut self,
        count: usize,
        number: Number,
        what: &str,
        mut take: impl FnMut(f64),
    ) -> Result<(), Fault> {
        if self.is_binary && number == Number::Bit {
            let bytes = self.take(count.div_ceil(8), what)?;
            (0..count).for_each(|k| take(f64::from(bytes[k / 8] >> (7 - k % 8) & 1)));
            return Ok(());
        }
        for _ in 0..count {
            let value = self.number(number, what)?;
            take(value);
        }
        Ok(())
    }

    /// Line or byte of what was read last.
    pub(super) fn place(&self) -> usize {
        if self.is_binary { self.at } else { self.text.line_number() }
    }

    /// Makes a fault of a [`place`](Self::place).
    pub(super) fn fault_at(&self) -> fn(usize, String) -> Fault {
        if self.is_binary { Fault::Byte } else { Fault::Line }
    }

    /// A fault in what was read last.
    pub(super) fn fault(&self, what: impl Into<String>) -> Fault {
        self.fault_at()(self.place(), what.into())
    }
}
