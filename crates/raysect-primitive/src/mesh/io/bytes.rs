use super::fault::Fault;

/// Numbers from bytes, with their positions.
#[derive(Debug, Clone)]
pub(super) struct Bytes<'a> {
    bytes: &'a [u8],
    at: usize,
    big_endian: bool,
}

impl<'a> Bytes<'a> {
    /// Of a whole file, to be read from a position on.
    pub(super) fn new(bytes: &'a [u8], at: usize, big_endian: bool) -> Self {
        Self { bytes, at: at.min(bytes.len()), big_endian }
    }

    /// Position of what comes next.
    pub(super) fn position(&self) -> usize {
        self.at
    }

    /// How many bytes are left.
    pub(super) fn remaining(&self) -> usize {
        self.bytes.len() - self.at
    }

    /// A fault at the next byte.
    pub(super) fn fault(&self, what: impl Into<String>) -> Fault {
        Fault::Byte(self.at, what.into())
    }

    /// The next `count` bytes.
    pub(super) fn take(&mut self, count: usize, what: &str) -> Result<&'a [u8], Fault> {
        let found = self.at.checked_add(count).and_then(|end| self.bytes.get(self.at..end));
        let Some(found) = found else {
            return Err(self.fault(format!(
                "{count} bytes of {what} should follow, the end is at {}",
                self.bytes.len()
            )));
        };
        self.at += count;
        Ok(found)
    }

    /// The bytes of one number, the least significant first.
    pub(super) fn little<const N: usize>(&mut self, what: &str) -> Result<[u8; N], Fault> {
        let mut word = [0; N];
        word.copy_from_slice(self.take(N, what)?);
        if self.big_endian {
            word.reverse();
        }
        Ok(word)
    }

    pub(super) fn u8(&mut self, what: &str) -> Result<u8, Fault> {
        Ok(u8::from_le_bytes(self.little(what)?))
    }

    pub(super) fn i32(&mut self, what: &str) -> Result<i32, Fault> {
        Ok(i32::from_le_bytes(self.little(what)?))
    }

    pub(super) fn f32(&mut self, what: &str) -> Result<f64, Fault> {
        Ok(f64::from(f32::from_le_bytes(self.little(what)?)))
    }

    /// Three 32-bit numbers, finite.
    pub(super) fn triple_f32(&mut self, what: &str) -> Result<[f64; 3], Fault> {
        let at = self.at;
        let triple = [self.f32(what)?, self.f32(what)?, self.f32(what)?];
        match triple.iter().position(|x| !x.is_finite()) {
            Some(k) => Err(Fault::Byte(at + 4 * k, format!("{what}: {} is not finite", triple[k]))),
            None => Ok(triple),
        }
    }

    /// A count that was declared, if as many elements of `size` bytes can follow.
    pub(super) fn admit(&self, count: u64, size: usize, what: &str) -> Result<usize, Fault> {
        let fits = usize::try_from(count)
            .ok()
            .filter(|n| n.checked_mul(size).is_some_and(|n| n <= self.remaining()));
        fits.ok_or_else(|| {
            self.fault(format!(
                "{count} {what} of at least {size} bytes should follow, {} bytes do",
                self.remaining()
            ))
        })
    }
}
