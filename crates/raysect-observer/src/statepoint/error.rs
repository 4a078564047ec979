use std::path::PathBuf;

use thiserror::Error;

/// Why a statepoint is refused.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum StatepointError {
    /// The file is something else.
    #[error("{}: no statepoint", path.display())]
    Foreign {
        /// The file.
        path: PathBuf,
    },
    /// Another version of this program has written it.
    #[error("{}: a statepoint of version {found}, and this program knows version {known}", path.display())]
    Version {
        /// The file.
        path: PathBuf,
        /// Version of the file.
        found: u32,
        /// The version that can be read.
        known: u32,
    },
    /// A part of the file is missing, or something follows it.
    #[error("{}: a statepoint of {expected} bytes of which there are {found}: truncated, or written over", path.display())]
    Length {
        /// The file.
        path: PathBuf,
        /// Length that it should have.
        expected: u64,
        /// Length of the file.
        found: u64,
    },
    /// Bytes have changed.
    #[error("{}: damaged: checksum {found:08x} instead of {expected:08x}", path.display())]
    Checksum {
        /// The file.
        path: PathBuf,
        /// What is written in the file.
        expected: u32,
        /// What its bytes give.
        found: u32,
    },
    /// The checksum is right and the contents make no sense.
    #[error("{}: not understood: {what}", path.display())]
    Contents {
        /// The file.
        path: PathBuf,
        /// What is wrong.
        what: String,
    },
    /// It belongs to another scene, or to other settings of the paths.
    #[error("the statepoint is of another scene: {before}; this is {now}")]
    OtherScene {
        /// What it is of.
        before: String,
        /// What was to go on with it.
        now: String,
    },
    /// It belongs to other pipelines.
    #[error("the statepoint is of the pipelines {before:?}, and these are {now:?}")]
    OtherPipelines {
        /// Names of those in the file.
        before: Vec<String>,
        /// Names of those given.
        now: Vec<String>,
    },
}
