use std::io;
use std::path::{Path, PathBuf};

use thiserror::Error;

/// What can go wrong with a file.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum FileError {
    /// The operating system refused to read or to write.
    #[error("{}: {source}", path.display())]
    Io {
        /// The file.
        path: PathBuf,
        /// The reason.
        source: io::Error,
    },
    /// The contents break the rules of the format.
    #[error("{}: byte {offset}: {what}", path.display())]
    Malformed {
        /// The file.
        path: PathBuf,
        /// Where the fault was noticed, counted from 0.
        offset: u64,
        /// What is wrong there.
        what: String,
    },
    /// The number of values differs from the product of the shape.
    #[error("{}: {name} of shape {shape:?} holds {expected} values, {found} are given", path.display())]
    Shape {
        /// The file.
        path: PathBuf,
        /// Name of the array, the channel or the picture.
        name: String,
        /// The shape that was given.
        shape: Vec<usize>,
        /// Product of the shape, `usize::MAX` if larger.
        expected: usize,
        /// Number of values that were given.
        found: usize,
    },
    /// The contents cannot be expressed in the format.
    #[error("{}: {what}", path.display())]
    Encode {
        /// The file.
        path: PathBuf,
        /// What stands in the way.
        what: String,
    },
}

impl FileError {
    /// An [`Io`](Self::Io) error of a file.
    pub(super) fn io(path: &Path, source: io::Error) -> Self {
        Self::Io { path: path.to_owned(), source }
    }

    /// An [`Encode`](Self::Encode) error of a file.
    pub(super) fn encode(path: &Path, what: impl ToString) -> Self {
        Self::Encode { path: path.to_owned(), what: what.to_string() }
    }

    /// `Ok` if `found` is the product of `shape`, otherwise [`Shape`](Self::Shape).
    pub(super) fn check_shape(path: &Path, name: &str, shape: &[usize], found: usize) -> Result<(), Self> {
        let count = product(shape);
        if count == Some(found) {
            return Ok(());
        }
        let expected = count.unwrap_or(usize::MAX);
        Err(Self::Shape {
            path: path.to_owned(),
            name: name.to_owned(),
            shape: shape.to_vec(),
            expected,
            found,
        })
    }
}

/// The number of elements of an array, `None` if it exceeds the range of `usize`.
pub(super) fn product(shape: &[usize]) -> Option<usize> {
    if shape.contains(&0) {
        return Some(0);
    }
    shape.iter().try_fold(1, |count: usize, &length| count.checked_mul(length))
}

/// A fault within some bytes, before the file they belong to is known.
#[derive(Debug)]
pub(super) struct Fault {
    /// Position from the start of the bytes.
    pub(super) at: usize,
    /// What is wrong there.
    pub(super) what: String,
}

impl Fault {
    pub(super) fn new(at: usize, what: impl ToString) -> Self {
        Self { at, what: what.to_string() }
    }

    /// The error of the file whose bytes these are.
    pub(super) fn in_file(self, path: &Path) -> FileError {
        FileError::Malformed { path: path.to_owned(), offset: self.at as u64, what: self.what }
    }
}

/// `count` bytes from position `at`.
pub(super) fn take(bytes: &[u8], at: usize, count: usize) -> Result<&[u8], Fault> {
    let found = at.checked_add(count).and_then(|end| bytes.get(at..end));
    found.ok_or_else(|| Fault::new(at, format!("{count} bytes should follow, the end is at {}", bytes.len())))
}

/// `N` bytes from position `at`.
pub(super) fn word<const N: usize>(bytes: &[u8], at: usize) -> Result<[u8; N], Fault> {
    let mut word = [0; N];
    word.copy_from_slice(take(bytes, at, N)?);
    Ok(word)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn counts_elements_without_overflow() {
        assert_eq!(product(&[]), Some(1));
        assert_eq!(product(&[3, 4]), Some(12));
        assert_eq!(product(&[usize::MAX, 2, 0]), Some(0));
        assert_eq!(product(&[usize::MAX, 2]), None);
    }

    #[test]
    fn messages_carry_path_and_numbers() {
        let error = FileError::check_shape(Path::new("a.npz"), "mean", &[2, 3], 5).unwrap_err();
        assert_eq!(error.to_string(), "a.npz: mean of shape [2, 3] holds 6 values, 5 are given");
        let error = take(&[0; 4], 3, 2).unwrap_err().in_file(Path::new("b.npz"));
        assert_eq!(error.to_string(), "b.npz: byte 3: 2 bytes should follow, the end is at 4");
    }
}
