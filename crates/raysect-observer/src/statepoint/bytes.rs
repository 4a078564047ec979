//! Numbers and texts as bytes, little-endian.

/// Collects bytes.
#[derive(Debug, Default)]
pub(crate) struct ByteWriter(pub(super) Vec<u8>);

impl ByteWriter {
    pub(crate) fn count(&mut self, number: u64) {
        self.0.extend(number.to_le_bytes());
    }

    pub(crate) fn text(&mut self, text: &str) {
        self.count(text.len() as u64);
        self.0.extend(text.bytes());
    }

    pub(crate) fn numbers(&mut self, numbers: &[f64]) {
        self.count(numbers.len() as u64);
        self.0.extend(numbers.iter().flat_map(|number| number.to_le_bytes()));
    }
}

/// Reads bytes back. Nothing is believed of a length before as many bytes are seen.
#[derive(Debug)]
pub(crate) struct ByteReader<'a>(pub(super) &'a [u8]);

impl<'a> ByteReader<'a> {
    fn take(&mut self, count: usize) -> Result<&'a [u8], String> {
        let split = self.0.split_at_checked(count);
        let (taken, rest) = split.ok_or_else(|| format!("{count} bytes where {} are left", self.0.len()))?;
        self.0 = rest;
        Ok(taken)
    }

    pub(crate) fn count(&mut self) -> Result<u64, String> {
        let mut word = [0; 8];
        word.copy_from_slice(self.take(8)?);
        Ok(u64::from_le_bytes(word))
    }

    pub(crate) fn size(&mut self) -> Result<usize, String> {
        let count = self.count()?;
        usize::try_from(count).map_err(|_| format!("a size of {count}"))
    }

    pub(crate) fn text(&mut self) -> Result<String, String> {
        let length = self.size()?;
        let bytes = self.take(length)?.to_vec();
        String::from_utf8(bytes).map_err(|_| "a text that is not UTF-8".to_owned())
    }

    pub(crate) fn numbers(&mut self) -> Result<Vec<f64>, String> {
        let length = self.size()?;
        let bytes = self.take(length.checked_mul(8).ok_or_else(|| format!("{length} numbers"))?)?;
        let (words, _) = bytes.as_chunks::<8>();
        Ok(words.iter().map(|word| f64::from_le_bytes(*word)).collect())
    }
}
