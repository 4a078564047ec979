use std::path::Path;

use super::super::MeshError;

/// A fault within some bytes, before the file they belong to is known.
#[derive(Debug)]
pub(super) enum Fault {
    /// In a line of a text, counted from 1.
    Line(usize, String),
    /// At a byte, counted from 0.
    Byte(usize, String),
    /// In the mesh as a whole.
    Mesh(MeshError),
}

impl Fault {
    /// The error of the file whose bytes these are.
    pub(super) fn in_file(self, path: &Path) -> MeshError {
        let path = path.to_owned();
        match self {
            Self::Line(line, what) => MeshError::MalformedLine { path, line, what },
            Self::Byte(offset, what) => MeshError::MalformedByte { path, offset, what },
            Self::Mesh(error @ MeshError::Transform(_)) => error,
            Self::Mesh(source) => MeshError::File { path, source: Box::new(source) },
        }
    }
}

impl From<MeshError> for Fault {
    fn from(error: MeshError) -> Self {
        Self::Mesh(error)
    }
}
