use std::io;
use std::path::{Path, PathBuf};

use raysect_math::MathError;
use thiserror::Error;

/// What can be wrong with a triangle mesh or its file.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum MeshError {
    /// There is no triangle.
    #[error("the mesh has no triangle")]
    Empty,
    /// More elements than 32-bit indices can name.
    #[error("{count} {what}: a mesh has at most 4294967295")]
    TooMany {
        /// What there is too much of.
        what: &'static str,
        /// How many were given.
        count: usize,
    },
    /// A triangle has no area.
    #[error("triangle {triangle} (counted from 0) has no area, and the mesh is not to be tolerant")]
    Degenerate {
        /// The triangle, counted from 0.
        triangle: usize,
    },
    /// The triangles close, but their fronts look inward.
    #[error("the fronts of the triangles look inward: flip the normals, or say that the mesh is not closed")]
    InsideOut,
    /// A triangle names a vertex that does not exist.
    #[error("triangle {triangle} names vertex {index}, there are {vertices} (counted from 0)")]
    VertexIndex {
        /// The triangle, counted from 0.
        triangle: usize,
        /// The vertex it names.
        index: u32,
        /// How many vertices there are.
        vertices: usize,
    },
    /// A triangle names a vertex normal that does not exist.
    #[error("triangle {triangle} names vertex normal {index}, there are {normals} (counted from 0)")]
    NormalIndex {
        /// The triangle, counted from 0.
        triangle: usize,
        /// The normal it names.
        index: u32,
        /// How many normals there are.
        normals: usize,
    },
    /// A coordinate is not a finite number.
    #[error("vertex {vertex} at ({}, {}, {}) m is not finite", position[0], position[1], position[2])]
    NotFinite {
        /// The vertex, counted from 0.
        vertex: usize,
        /// Its coordinates [m].
        position: [f64; 3],
    },
    /// A vertex normal has no direction.
    #[error("vertex normal {normal}: {source}")]
    Normal {
        /// The normal, counted from 0.
        normal: usize,
        /// What it is.
        source: MathError,
    },
    /// Vertex normals must be named once for each triangle.
    #[error("{found} triples of normal indices for {triangles} triangles")]
    NormalCount {
        /// How many triangles there are.
        triangles: usize,
        /// How many triples were given.
        found: usize,
    },
    /// A scale or a transform that leaves no mesh.
    #[error("the mesh cannot be transformed: {0}")]
    Transform(#[from] MathError),
    /// Values for each triangle that are not as many as the triangles.
    #[error("'{name}' has {found} values for {triangles} triangles")]
    ScalarCount {
        /// Name of the values.
        name: String,
        /// How many triangles there are.
        triangles: usize,
        /// How many values were given.
        found: usize,
    },
    /// The operating system refused to read or to write.
    #[error("{}: {message}", path.display())]
    Io {
        /// The file.
        path: PathBuf,
        /// The kind of the refusal.
        kind: io::ErrorKind,
        /// The words of the operating system.
        message: String,
    },
    /// A file whose format is not known.
    #[error("{}: neither the name nor the contents tell a format: OBJ, STL, PLY, VTK and RSM are known", path.display())]
    UnknownFormat {
        /// The file.
        path: PathBuf,
    },
    /// A line of a text file breaks the rules of the format.
    #[error("{}: line {line}: {what}", path.display())]
    MalformedLine {
        /// The file.
        path: PathBuf,
        /// The line, counted from 1.
        line: usize,
        /// What is wrong there.
        what: String,
    },
    /// The bytes of a binary file break the rules of the format.
    #[error("{}: byte {offset}: {what}", path.display())]
    MalformedByte {
        /// The file.
        path: PathBuf,
        /// Where the fault was noticed, counted from 0.
        offset: usize,
        /// What is wrong there.
        what: String,
    },
    /// A file whose parts are well formed does not describe a mesh.
    #[error("{}: {source}", path.display())]
    File {
        /// The file.
        path: PathBuf,
        /// What is wrong with the mesh.
        source: Box<MeshError>,
    },
    /// The mesh cannot be expressed in the format.
    #[error("{}: {what}", path.display())]
    Encode {
        /// The file.
        path: PathBuf,
        /// What stands in the way.
        what: String,
    },
}

impl MeshError {
    /// An [`Io`](Self::Io) error of a file.
    pub(crate) fn io(path: &Path, source: &io::Error) -> Self {
        Self::Io { path: path.to_owned(), kind: source.kind(), message: source.to_string() }
    }
}
