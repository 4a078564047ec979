use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::io::{self, ErrorKind, Write};
use std::path::Path;

use super::error::Fault;
use super::npy_read::read_npy;
use super::zip_read::{ZipEntry, list_entries};
use super::zip_write::{ZIP64_LIMIT, ZipWriter};
use super::{FileError, NpyArray, NpyData, write_atomically};

/// The most axes that every version of NumPy reads.
const AXES: usize = 32;
/// Bytes of the longest name, so that `.npy` still fits into 16 bits of length.
const NAME_BYTES: usize = 0xffff - 4;

/// Saves named arrays as NumPy's `.npz`, uncompressed, in the given order.
///
/// `numpy.load` opens the file. Any size is possible; beyond 4 GiB the archive turns into zip64.
/// Equal arrays give equal bytes.
///
/// # Errors
/// [`FileError::Shape`] if an array does not fill its shape, [`FileError::Encode`] for a name that is empty,
/// repeated, contains a zero character or exceeds 65531 bytes, for more than 32 axes, and for a text that ends
/// in a zero character, [`FileError::Io`].
pub fn save_npz<S: AsRef<str>>(path: impl AsRef<Path>, arrays: &[(S, NpyArray)]) -> Result<(), FileError> {
    let path = path.as_ref();
    let mut names = BTreeSet::new();
    for (name, array) in arrays {
        check(path, name.as_ref(), array, !names.insert(name.as_ref()))?;
    }
    write_atomically(path, |writer| write_archive(writer, arrays, ZIP64_LIMIT))
}

fn check(path: &Path, name: &str, array: &NpyArray, repeated: bool) -> Result<(), FileError> {
    FileError::check_shape(path, name, &array.shape, array.data.len())?;
    let axes = array.shape.len();
    let refuse = |what: &str| Err(FileError::encode(path, format!("the array '{name}' {what}")));
    if name.is_empty() || name.contains('\0') || name.len() > NAME_BYTES {
        return refuse("has a name that is empty, too long or with a zero character");
    }
    if repeated {
        return refuse("occurs twice");
    }
    if axes > AXES {
        return refuse(&format!("has {axes} axes, NumPy reads {AXES}"));
    }
    match &array.data {
        NpyData::Text(texts) if texts.iter().any(|text| text.ends_with('\0')) => {
            refuse("holds a text that ends in a zero character")
        }
        _ => Ok(()),
    }
}

fn write_archive<S: AsRef<str>>(
    writer: &mut dyn Write,
    arrays: &[(S, NpyArray)],
    zip64_limit: u64,
) -> io::Result<()> {
    let mut archive = ZipWriter::new(writer, zip64_limit);
    for (name, array) in arrays {
        archive.add(&format!("{}.npy", name.as_ref()), array.file_size(), &|writer| array.write(writer))?;
    }
    archive.finish()
}

/// Loads all arrays of an `.npz` file, as `numpy.savez` and `numpy.savez_compressed` write it.
///
/// Numbers are widened as [`NpyData`] tells, big-endian ones turned round, and Fortran order becomes C order.
/// Checksums are verified, and memory is claimed only for bytes that are present.
///
/// # Errors
/// [`FileError::Malformed`] for a damaged file, another format or types other than those of [`NpyData`];
/// within a compressed array the offset is that of its first byte. [`FileError::Io`].
pub fn load_npz(path: impl AsRef<Path>) -> Result<BTreeMap<String, NpyArray>, FileError> {
    let path = path.as_ref();
    let archive = read_file(path).map_err(|source| FileError::io(path, source))?;
    read_archive(&archive).map_err(|fault| fault.in_file(path))
}

fn read_file(path: &Path) -> io::Result<Vec<u8>> {
    if fs::metadata(path)?.is_file() {
        fs::read(path)
    } else {
        Err(io::Error::new(ErrorKind::InvalidInput, "not a regular file"))
    }
}

fn read_archive(archive: &[u8]) -> Result<BTreeMap<String, NpyArray>, Fault> {
    let mut arrays = BTreeMap::new();
    for entry in list_entries(archive)? {
        let name = entry.name.strip_suffix(".npy").unwrap_or(&entry.name).to_owned();
        let array = read_entry(&entry, archive)?;
        if arrays.insert(name, array).is_some() {
            return Err(Fault::new(entry.start, format!("the entry '{}' is repeated", entry.name)));
        }
    }
    Ok(arrays)
}

fn read_entry(entry: &ZipEntry, archive: &[u8]) -> Result<NpyArray, Fault> {
    read_npy(&entry.read(archive)?).map_err(|Fault { at, what }| {
        let name = &entry.name;
        if entry.is_stored() {
            Fault::new(entry.start + at, format!("the entry '{name}': {what}"))
        } else {
            Fault::new(entry.start, format!("the entry '{name}', byte {at} of the inflated array: {what}"))
        }
    })
}

#[cfg(test)]
#[path = "npz_tests.rs"]
mod tests;
