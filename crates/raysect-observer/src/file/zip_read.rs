use std::borrow::Cow;

use miniz_oxide::inflate::decompress_to_vec_with_limit;

use super::error::{Fault, take, word};

const ENCRYPTED: u16 = 1;
const STORED: u16 = 0;
const DEFLATED: u16 = 8;
/// Deflate encodes at most 258 bytes in two bits.
const LARGEST_RATIO: usize = 1032;

/// An entry of a zip archive.
pub(super) struct ZipEntry {
    /// Name of the entry.
    pub(super) name: String,
    /// Position of its bytes in the archive.
    pub(super) start: usize,
    method: u16,
    crc: u32,
    packed: usize,
    size: usize,
}

/// Lists the entries of an archive in the order of its directory.
pub(super) fn list_entries(archive: &[u8]) -> Result<Vec<ZipEntry>, Fault> {
    if archive.starts_with(b"\x93NUMPY") {
        return Err(Fault::new(0, "a single array (.npy), not an archive of arrays (.npz)"));
    }
    if !archive.starts_with(b"PK\x03\x04") && !archive.starts_with(b"PK\x05\x06") {
        return Err(Fault::new(0, "not a zip archive: the signature is missing"));
    }
    let directory = Directory::find(archive)?;
    let (mut at, mut total) = (directory.start, 0);
    let mut entries = Vec::new();
    for _ in 0..directory.count {
        let (entry, next) = directory.entry(archive, at)?;
        total += entry.packed;
        if total > directory.start {
            return Err(Fault::new(at, format!("the entry '{}' overlaps another", entry.name)));
        }
        entries.push(entry);
        at = next;
    }
    if at != directory.end {
        return Err(Fault::new(at, format!("the directory should end at byte {}", directory.end)));
    }
    Ok(entries)
}

impl ZipEntry {
    /// True if the bytes of the archive are those of the entry.
    pub(super) fn is_stored(&self) -> bool {
        self.method == STORED
    }

    /// The bytes of the entry, inflated if need be; the checksum is verified.
    pub(super) fn read<'a>(&self, archive: &'a [u8]) -> Result<Cow<'a, [u8]>, Fault> {
        let packed = take(archive, self.start, self.packed)?;
        let bytes = if self.is_stored() { Cow::Borrowed(packed) } else { Cow::Owned(self.inflate(packed)?) };
        if bytes.len() != self.size {
            return Err(self.fault(format!("{} bytes are declared, {} are present", self.size, bytes.len())));
        }
        let crc = crc32fast::hash(&bytes);
        if crc != self.crc {
            return Err(self.fault(format!("checksum {crc:08x} instead of {:08x}", self.crc)));
        }
        Ok(bytes)
    }

    fn inflate(&self, packed: &[u8]) -> Result<Vec<u8>, Fault> {
        if packed.is_empty() || self.size / LARGEST_RATIO > packed.len() {
            return Err(self.fault(format!(
                "{} bytes cannot hold {} deflated ones",
                packed.len(),
                self.size
            )));
        }
        decompress_to_vec_with_limit(packed, self.size).map_err(|error| self.fault(error))
    }

    fn fault(&self, what: impl std::fmt::Display) -> Fault {
        Fault::new(self.start, format!("the entry '{}': {what}", self.name))
    }
}

/// Where the list of entries lies.
struct Directory {
    start: usize,
    end: usize,
    count: u64,
}

impl Directory {
    fn find(archive: &[u8]) -> Result<Self, Fault> {
        let at = find_end(archive)?;
        let [disk, first] = [u16_at(archive, at + 4)?, u16_at(archive, at + 6)?];
        let [here, count] = [u16_at(archive, at + 8)?, u16_at(archive, at + 10)?];
        if disk != 0 || first != 0 || here != count {
            return Err(Fault::new(at, "archives of several parts are not read"));
        }
        let [size, start] = [u32_at(archive, at + 12)?, u32_at(archive, at + 16)?];
        let saturated = count == u16::MAX || size == u32::MAX || start == u32::MAX;
        let locator = at.checked_sub(20).filter(|&p| saturated && archive[p..].starts_with(b"PK\x06\x07"));
        match locator {
            Some(locator) => Self::zip64(archive, locator),
            None => Self::new(u64::from(count), u64::from(start), u64::from(size), at),
        }
    }

    fn zip64(archive: &[u8], locator: usize) -> Result<Self, Fault> {
        let at = position(u64_at(archive, locator + 8)?, locator + 8)?;
        if at > locator || take(archive, at, 4)? != b"PK\x06\x06" {
            return Err(Fault::new(locator + 8, format!("no zip64 record at byte {at}")));
        }
        let [count, size, start] =
            [u64_at(archive, at + 32)?, u64_at(archive, at + 40)?, u64_at(archive, at + 48)?];
        Self::new(count, start, size, at)
    }

    fn new(count: u64, start: u64, size: u64, end: usize) -> Result<Self, Fault> {
        if start.checked_add(size) != Some(end as u64) {
            let what = format!("a directory of {size} bytes from byte {start} should end at byte {end}");
            return Err(Fault::new(end, what));
        }
        Ok(Self { start: position(start, end)?, end, count })
    }

    /// The entry whose record is at `at`, and the position of the next record.
    fn entry(&self, archive: &[u8], at: usize) -> Result<(ZipEntry, usize), Fault> {
        let archive = take(archive, 0, self.end)?;
        let record = take(archive, at, 46)?;
        if !record.starts_with(b"PK\x01\x02") {
            return Err(Fault::new(at, format!("{} entries are declared, one is missing here", self.count)));
        }
        let [flags, method] = [u16_at(record, 8)?, u16_at(record, 10)?];
        if flags & ENCRYPTED != 0 || !matches!(method, STORED | DEFLATED) {
            let what =
                format!("method {method}, flags {flags:#x}: only stored and deflated entries are read");
            return Err(Fault::new(at, what));
        }
        let lengths = [u16_at(record, 28)?, u16_at(record, 30)?, u16_at(record, 32)?];
        let [name, extra, comment] = lengths.map(usize::from);
        let (name, extra_at) = (take(archive, at + 46, name)?, at + 46 + name);
        let extra = take(archive, extra_at, extra)?;
        let mut fields = [u32_at(record, 24)?, u32_at(record, 20)?, u32_at(record, 42)?].map(u64::from);
        widen(&mut fields, extra).map_err(|fault| Fault::new(extra_at + fault.at, fault.what))?;
        let [size, packed, local] = fields;
        let [size, packed] = [position(size, at + 24)?, position(packed, at + 20)?];
        let start = self.data_start(archive, position(local, at + 42)?, name)?;
        if packed > self.start.saturating_sub(start) {
            let what = format!("{packed} bytes from byte {start} reach beyond the entries");
            return Err(Fault::new(at + 20, what));
        }
        let text = std::str::from_utf8(name).map_err(|_| Fault::new(at + 46, "the name is not UTF-8"))?;
        let (name, crc) = (text.to_owned(), u32_at(record, 16)?);
        Ok((ZipEntry { name, start, method, crc, packed, size }, extra_at + extra.len() + comment))
    }

    /// Where the bytes of an entry start, behind its own header at `at`.
    fn data_start(&self, archive: &[u8], at: usize, name: &[u8]) -> Result<usize, Fault> {
        let header = take(archive, at, 30)?;
        if !header.starts_with(b"PK\x03\x04") {
            return Err(Fault::new(at, "the header of an entry is missing"));
        }
        let [length, extra] = [u16_at(header, 26)?, u16_at(header, 28)?].map(usize::from);
        if take(archive, at + 30, length)? != name {
            return Err(Fault::new(at + 30, "the name of the entry differs from that in the directory"));
        }
        Ok(at + 30 + length + extra)
    }
}

/// The record that ends the archive, sought from behind since a comment may follow.
fn find_end(archive: &[u8]) -> Result<usize, Fault> {
    let missing = || Fault::new(archive.len(), "the archive is cut short: its directory is missing");
    let last = archive.len().checked_sub(22).ok_or_else(missing)?;
    let first = last.saturating_sub(usize::from(u16::MAX));
    let is_end = |&at: &usize| {
        let record = &archive[at..];
        record.starts_with(b"PK\x05\x06")
            && u16_at(record, 20).is_ok_and(|comment| record.len() == 22 + usize::from(comment))
    };
    (first..=last).rev().find(is_end).ok_or_else(missing)
}

/// Takes size, packed size and offset from the zip64 field where 32 bits do not suffice.
fn widen(fields: &mut [u64; 3], extra: &[u8]) -> Result<(), Fault> {
    let mut at = 0;
    while at + 4 <= extra.len() {
        let [kind, length] = [u16_at(extra, at)?, u16_at(extra, at + 2)?];
        let content = take(extra, at + 4, usize::from(length))?;
        if kind == 1 {
            let mut used = 0;
            for field in fields.iter_mut().filter(|field| **field == u64::from(u32::MAX)) {
                *field = u64_at(content, used).map_err(|fault| Fault::new(at + 4 + used, fault.what))?;
                used += 8;
            }
        }
        at += 4 + content.len();
    }
    Ok(())
}

fn position(value: u64, at: usize) -> Result<usize, Fault> {
    usize::try_from(value)
        .ok()
        .filter(|&v| v <= isize::MAX as usize)
        .ok_or_else(|| Fault::new(at, format!("{value} bytes exceed the memory")))
}

fn u16_at(bytes: &[u8], at: usize) -> Result<u16, Fault> {
    word(bytes, at).map(u16::from_le_bytes)
}

fn u32_at(bytes: &[u8], at: usize) -> Result<u32, Fault> {
    word(bytes, at).map(u32::from_le_bytes)
}

fn u64_at(bytes: &[u8], at: usize) -> Result<u64, Fault> {
    word(bytes, at).map(u64::from_le_bytes)
}
