use std::io::{self, Write};

use crc32fast::Hasher;

/// From this value on a field of 32 bits is replaced by one of 64 bits.
pub(super) const ZIP64_LIMIT: u64 = 0xffff_ffff;
/// 1 January 1980, midnight, so that equal contents give equal bytes: time, then date.
const TIMESTAMP: [u16; 2] = [0, 0x21];
const UTF8_NAME: u16 = 1 << 11;

/// A writer of zip archives whose entries are stored without compression.
///
/// Layout: PKWARE, *.ZIP File Format Specification* 6.3, § 4.3.
pub(super) struct ZipWriter<'a> {
    writer: &'a mut dyn Write,
    position: u64,
    directory: Vec<u8>,
    count: u64,
    limit: u64,
}

impl<'a> ZipWriter<'a> {
    /// `limit` is [`ZIP64_LIMIT`]; less makes fields of 64 bits appear earlier.
    pub(super) fn new(writer: &'a mut dyn Write, limit: u64) -> Self {
        Self { writer, position: 0, directory: Vec::new(), count: 0, limit }
    }

    /// Adds an entry of `size` bytes. `fill` is called twice: for the checksum and for the bytes.
    pub(super) fn add(
        &mut self,
        name: &str,
        size: u64,
        fill: &dyn Fn(&mut dyn Write) -> io::Result<()>,
    ) -> io::Result<()> {
        let mut checksum = Checksum(Hasher::new());
        fill(&mut checksum)?;
        let entry =
            Entry { name, size, offset: self.position, crc: checksum.0.finalize(), limit: self.limit };
        let header = entry.local_header();
        self.writer.write_all(&header)?;
        fill(self.writer)?;
        self.position += header.len() as u64 + size;
        self.directory.extend_from_slice(&entry.directory_record());
        self.count += 1;
        Ok(())
    }

    /// Writes the directory.
    pub(super) fn finish(self) -> io::Result<()> {
        let (start, size) = (self.position, self.directory.len() as u64);
        self.writer.write_all(&self.directory)?;
        let large = self.count >= 0xffff || start >= self.limit || size >= self.limit;
        if large {
            self.writer.write_all(&zip64_end(self.count, start, size))?;
        }
        let count = if large { u16::MAX } else { self.count as u16 };
        let [start, size] = [start, size].map(|value| if large { u32::MAX } else { value as u32 });
        let mut end = Record::new(*b"PK\x05\x06");
        end.u16(&[0, 0, count, count]).u32(&[size, start]).u16(&[0]);
        self.writer.write_all(&end.0)
    }
}

struct Entry<'a> {
    name: &'a str,
    size: u64,
    offset: u64,
    crc: u32,
    limit: u64,
}

impl Entry<'_> {
    fn large(&self) -> bool {
        self.size >= self.limit
    }

    /// Version needed, flags, method, time, date, checksum, both sizes, length of the name.
    fn common(&self, record: &mut Record, large: bool) {
        let flags = if self.name.is_ascii() { 0 } else { UTF8_NAME };
        let size = if self.large() { u32::MAX } else { self.size as u32 };
        record.u16(&[if large { 45 } else { 20 }, flags, 0]).u16(&TIMESTAMP);
        record.u32(&[self.crc, size, size]).u16(&[self.name.len() as u16]);
    }

    fn local_header(&self) -> Vec<u8> {
        let extra = if self.large() { zip64_extra(&[self.size, self.size]) } else { Vec::new() };
        let mut record = Record::new(*b"PK\x03\x04");
        self.common(&mut record, self.large());
        record.u16(&[extra.len() as u16]);
        [record.0.as_slice(), self.name.as_bytes(), &extra].concat()
    }

    fn directory_record(&self) -> Vec<u8> {
        let far = self.offset >= self.limit;
        let sizes: &[u64] = if self.large() { &[self.size, self.size] } else { &[] };
        let offsets: &[u64] = if far { &[self.offset] } else { &[] };
        let extra = zip64_extra(&[sizes, offsets].concat());
        let large = self.large() || far;
        let mut record = Record::new(*b"PK\x01\x02");
        record.u16(&[if large { 45 } else { 20 }]);
        self.common(&mut record, large);
        // No comment, first disk, no attributes.
        record.u16(&[extra.len() as u16, 0, 0, 0]).u32(&[0]);
        record.u32(&[if far { u32::MAX } else { self.offset as u32 }]);
        [record.0.as_slice(), self.name.as_bytes(), &extra].concat()
    }
}

fn zip64_extra(values: &[u64]) -> Vec<u8> {
    let mut record = Record(Vec::new());
    if !values.is_empty() {
        record.u16(&[1, 8 * values.len() as u16]).u64(values);
    }
    record.0
}

/// The record of 64-bit fields at the end of the directory, and the pointer to it.
fn zip64_end(count: u64, start: u64, size: u64) -> Vec<u8> {
    let mut record = Record::new(*b"PK\x06\x06");
    record.u64(&[44]).u16(&[45, 45]).u32(&[0, 0]).u64(&[count, count, size, start]);
    record.0.extend_from_slice(b"PK\x06\x07");
    record.u32(&[0]).u64(&[start + size]).u32(&[1]);
    record.0
}

/// Little-endian fields one after the other.
struct Record(Vec<u8>);

impl Record {
    fn new(signature: [u8; 4]) -> Self {
        Self(signature.to_vec())
    }

    fn u16(&mut self, values: &[u16]) -> &mut Self {
        self.0.extend(values.iter().flat_map(|value| value.to_le_bytes()));
        self
    }

    fn u32(&mut self, values: &[u32]) -> &mut Self {
        self.0.extend(values.iter().flat_map(|value| value.to_le_bytes()));
        self
    }

    fn u64(&mut self, values: &[u64]) -> &mut Self {
        self.0.extend(values.iter().flat_map(|value| value.to_le_bytes()));
        self
    }
}

/// Takes bytes for their checksum alone.
struct Checksum(Hasher);

impl Write for Checksum {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.0.update(bytes);
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}
