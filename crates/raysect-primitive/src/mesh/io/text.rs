use super::fault::Fault;

/// Words and lines of a text, with their numbers. Lines end in LF, CR LF or CR.
#[derive(Debug, Clone)]
pub(super) struct Text<'a> {
    bytes: &'a [u8],
    at: usize,
    /// Line of `at`, counted from 1.
    line: usize,
    /// Line of the word or line that was read last.
    last: usize,
    /// Position of the word or line that was read last.
    start: usize,
}

impl<'a> Text<'a> {
    pub(super) fn new(bytes: &'a [u8]) -> Self {
        let at = if bytes.starts_with(b"\xef\xbb\xbf") { 3 } else { 0 };
        Self { bytes, at, line: 1, last: 1, start: at }
    }

    /// Position of what comes next.
    pub(super) fn position(&self) -> usize {
        self.at
    }

    /// Goes on at a later position, after bytes that are no text. Lines are counted no more.
    pub(super) fn skip_to(&mut self, position: usize) {
        self.at = position.min(self.bytes.len());
    }

    /// Line of the word or line that was read last, counted from 1.
    pub(super) fn line_number(&self) -> usize {
        self.last
    }

    /// Position of the word or line that was read last.
    pub(super) fn start(&self) -> usize {
        self.start
    }

    /// How many bytes are left.
    pub(super) fn remaining(&self) -> usize {
        self.bytes.len() - self.at
    }

    /// A fault in the line that was read last.
    pub(super) fn fault(&self, what: impl Into<String>) -> Fault {
        Fault::Line(self.last, what.into())
    }

    /// The next line without its end.
    pub(super) fn line(&mut self) -> Option<&'a [u8]> {
        let rest = &self.bytes[self.at..];
        if rest.is_empty() {
            return None;
        }
        (self.last, self.start) = (self.line, self.at);
        let length = rest.iter().position(|b| matches!(b, b'\n' | b'\r')).unwrap_or(rest.len());
        self.at += length;
        self.pass_line_end();
        Some(&rest[..length])
    }

    fn pass_line_end(&mut self) {
        let length = match self.bytes[self.at..] {
            [b'\r', b'\n', ..] => 2,
            [b'\r' | b'\n', ..] => 1,
            _ => return,
        };
        self.at += length;
        self.line += 1;
    }

    /// The next word, over the ends of lines.
    pub(super) fn word(&mut self) -> Option<&'a [u8]> {
        loop {
            match self.bytes.get(self.at)? {
                b'\n' | b'\r' => self.pass_line_end(),
                b if b.is_ascii_whitespace() => self.at += 1,
                _ => break,
            }
        }
        (self.last, self.start) = (self.line, self.at);
        let rest = &self.bytes[self.at..];
        let length = rest.iter().position(u8::is_ascii_whitespace).unwrap_or(rest.len());
        self.at += length;
        Some(&rest[..length])
    }

    /// The next word without going past it.
    pub(super) fn peek(&self) -> Option<&'a [u8]> {
        self.clone().word()
    }

    /// The next word, which must be there.
    pub(super) fn expect(&mut self, what: &str) -> Result<&'a [u8], Fault> {
        match self.word() {
            Some(word) => Ok(word),
            None => Err(Fault::Line(self.line, format!("the file ends where {what} should follow"))),
        }
    }

    /// The next word as a finite number.
    pub(super) fn number(&mut self, what: &str) -> Result<f64, Fault> {
        let word = self.expect(what)?;
        finite(word, what).map_err(|what| self.fault(what))
    }

    /// Three finite numbers.
    pub(super) fn triple(&mut self, what: &str) -> Result<[f64; 3], Fault> {
        Ok([self.number(what)?, self.number(what)?, self.number(what)?])
    }
}

/// A word as a number, NaN and infinities included.
pub(super) fn any_number(word: &[u8], what: &str) -> Result<f64, String> {
    let number = std::str::from_utf8(word).ok().and_then(|text| text.parse().ok());
    number.ok_or_else(|| format!("{what}: '{}' is no number", shown(word)))
}

/// A word as a finite number.
pub(super) fn finite(word: &[u8], what: &str) -> Result<f64, String> {
    let number = any_number(word, what)?;
    if number.is_finite() { Ok(number) } else { Err(format!("{what}: {} is not finite", shown(word))) }
}

/// A word as an integer.
pub(super) fn integer<T: std::str::FromStr>(word: &[u8], what: &str) -> Result<T, String> {
    let number = std::str::from_utf8(word).ok().and_then(|text| text.parse().ok());
    number.ok_or_else(|| format!("{what}: '{}' is no such integer", shown(word)))
}

/// The beginning of a word, fit for a message.
pub(super) fn shown(word: &[u8]) -> String {
    let text: String = String::from_utf8_lossy(word).chars().take(32).collect();
    text.escape_debug().to_string()
}

/// The words of a line.
pub(super) fn words(line: &[u8]) -> impl Iterator<Item = &[u8]> {
    line.split(u8::is_ascii_whitespace).filter(|word| !word.is_empty())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_and_lines_know_their_number() {
        let mut text = Text::new(b"\xef\xbb\xbfone two\r\nthree\r\rfive\n  six");
        assert_eq!((text.word(), text.line_number()), (Some(b"one".as_slice()), 1));
        assert_eq!((text.line(), text.line_number()), (Some(b" two".as_slice()), 1));
        assert_eq!(text.peek(), Some(b"three".as_slice()));
        assert_eq!((text.word(), text.line_number()), (Some(b"three".as_slice()), 2));
        assert_eq!((text.word(), text.line_number()), (Some(b"five".as_slice()), 4));
        assert_eq!((text.line(), text.line_number()), (Some(b"".as_slice()), 4));
        assert_eq!((text.line(), text.line_number()), (Some(b"  six".as_slice()), 5));
        assert_eq!((text.line(), text.word()), (None, None));
        assert!(matches!(text.expect("more"), Err(Fault::Line(5, what)) if what.contains("more")));
    }

    #[test]
    fn numbers_are_finite() {
        assert_eq!(finite(b"-1.5e-3", "x"), Ok(-1.5e-3));
        for wrong in ["nan", "inf", "1e999", "1,5", "", "0x10", "\u{fffd}"] {
            assert!(finite(wrong.as_bytes(), "x").is_err(), "{wrong}");
        }
        assert_eq!(integer(b"4294967295", "i"), Ok(u32::MAX));
        assert!(integer::<u32>(b"4294967296", "i").is_err());
    }
}
