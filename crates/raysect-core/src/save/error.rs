use std::error::Error as StdError;
use std::path::PathBuf;

use raysect_math::MathError;
use thiserror::Error;

use crate::CoreError;

/// Why a scene cannot be saved, or a file is not a scene.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum SaveError {
    /// Something that does not say how it is saved.
    #[error("a {role} of the kind {kind} cannot be saved: it does not say how")]
    NotSaved {
        /// What it is for: a shape, a material.
        role: &'static str,
        /// What it is.
        kind: String,
    },
    /// A number that JSON does not have.
    #[error("{kind} with {field} = {value} cannot be saved: a file holds finite numbers only")]
    NotFinite {
        /// What it is.
        kind: String,
        /// The name of the number.
        field: String,
        /// Its value.
        value: f64,
    },
    /// Something in a world that a file has no place for.
    #[error("{0} cannot be saved")]
    NoPlace(String),
    /// Where in the world or in the file it happened.
    #[error("{place}: {source}")]
    At {
        /// The node, object or setting.
        place: String,
        /// What happened there.
        source: Box<SaveError>,
    },
    /// In which file it happened.
    #[error("{}: {source}", path.display())]
    File {
        /// The file.
        path: PathBuf,
        /// What happened.
        source: Box<SaveError>,
    },
    /// The operating system refused to read or to write.
    #[error(transparent)]
    Io(#[from] std::io::Error),
    /// The text is not JSON, or has a key twice.
    #[error("line {line}, column {column}: {what}")]
    Syntax {
        /// Line, counted from 1.
        line: usize,
        /// Column where it was noticed, counted from 1.
        column: usize,
        /// What is wrong.
        what: String,
    },
    /// A file of another version.
    #[error("version {found} of the format is unknown: this library reads version {known}")]
    Version {
        /// The version of the file.
        found: u64,
        /// The version that is known.
        known: u64,
    },
    /// A kind that nobody has registered.
    #[error("no {role} of the kind '{kind}' is registered; there are: {known}")]
    UnknownKind {
        /// What it is for: a shape, a material.
        role: String,
        /// The kind in the file.
        kind: String,
        /// The kinds there are.
        known: String,
    },
    /// The file says something that a scene cannot mean.
    #[error("{0}")]
    Content(String),
    /// A constructor refuses what the file says.
    #[error(transparent)]
    Refused(Box<dyn StdError + Send + Sync>),
}

impl SaveError {
    /// With the place where it happened.
    pub(crate) fn at(self, place: impl Into<String>) -> Self {
        Self::At { place: place.into(), source: Box::new(self) }
    }

    pub(crate) fn content(what: impl Into<String>) -> Self {
        Self::Content(what.into())
    }

    /// From what a constructor returned; an error of the file itself stays as it is.
    pub(crate) fn refused(error: Box<dyn StdError + Send + Sync>) -> Self {
        match error.downcast::<Self>() {
            Ok(own) => *own,
            Err(other) => Self::Refused(other),
        }
    }
}

impl From<CoreError> for SaveError {
    fn from(error: CoreError) -> Self {
        Self::Refused(error.into())
    }
}

impl From<MathError> for SaveError {
    fn from(error: MathError) -> Self {
        Self::Refused(error.into())
    }
}
