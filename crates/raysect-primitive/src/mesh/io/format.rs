use std::path::Path;

use super::super::{MeshData, MeshError};
use super::fault::Fault;
use super::{
    RsmFlags, export_obj, export_ply, export_rsm, export_stl, export_vtk, obj, ply, read_bytes, rsm, stl, vtk,
};

/// A format of mesh files.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum MeshFormat {
    /// Wavefront OBJ.
    Obj,
    /// STL of a stereolithograph, text or binary.
    Stl,
    /// PLY of Stanford, text or binary.
    Ply,
    /// Legacy VTK, text or binary.
    Vtk,
    /// Raysect's own binary form.
    Rsm,
}

/// How a file holds its numbers.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum MeshEncoding {
    /// As decimal digits, which give back every coordinate exactly.
    Ascii,
    /// As bytes.
    Binary,
}

impl MeshFormat {
    /// The format that a name ends in, in capitals or not.
    pub fn of_name(path: impl AsRef<Path>) -> Option<Self> {
        let extension = path.as_ref().extension()?.to_str()?.to_ascii_lowercase();
        match extension.as_str() {
            "obj" => Some(Self::Obj),
            "stl" => Some(Self::Stl),
            "ply" => Some(Self::Ply),
            "vtk" => Some(Self::Vtk),
            "rsm" => Some(Self::Rsm),
            _ => None,
        }
    }

    /// The format that some bytes begin like. OBJ has no mark of its own and is never told.
    pub fn of_bytes(bytes: &[u8]) -> Option<Self> {
        let begins = |mark: &[u8]| bytes.get(..mark.len()).is_some_and(|b| b.eq_ignore_ascii_case(mark));
        match () {
            () if begins(b"ply\n") || begins(b"ply\r") => Some(Self::Ply),
            () if begins(b"# vtk DataFile") => Some(Self::Vtk),
            () if bytes.starts_with(b"RSM\x01\x00") => Some(Self::Rsm),
            () if begins(b"solid") || stl::has_size_of_count(bytes) => Some(Self::Stl),
            () => None,
        }
    }

    fn parse(self, bytes: &[u8], scaling: f64) -> Result<MeshData, Fault> {
        match self {
            Self::Obj => obj::parse(bytes, scaling),
            Self::Stl => stl::parse(bytes, scaling),
            Self::Ply => ply::parse(bytes, scaling),
            Self::Vtk => Ok(vtk::parse(bytes, scaling)?.0),
            Self::Rsm => Ok(rsm::parse(bytes, scaling)?.0),
        }
    }
}

impl MeshData {
    /// Reads the bytes of a file; coordinates are multiplied by `scaling` (0.001 for a file in mm).
    ///
    /// # Errors
    /// Those of the format's own function; the path in them is `(bytes)`.
    pub fn from_bytes(bytes: &[u8], format: MeshFormat, scaling: f64) -> Result<Self, MeshError> {
        format.parse(bytes, scaling).map_err(|fault| fault.in_file(Path::new("(bytes)")))
    }

    /// Reads a file of any format of [`MeshFormat`], told by the end of its name or else by its first bytes; coordinates
    /// are multiplied by `scaling` (0.001 for a file in mm).
    ///
    /// # Errors
    /// [`MeshError::UnknownFormat`], and those of the format's own function.
    pub fn load(path: impl AsRef<Path>, scaling: f64) -> Result<Self, MeshError> {
        let path = path.as_ref();
        let bytes = read_bytes(path)?;
        let format = MeshFormat::of_name(path).or_else(|| MeshFormat::of_bytes(&bytes));
        let format = format.ok_or_else(|| MeshError::UnknownFormat { path: path.to_owned() })?;
        format.parse(&bytes, scaling).map_err(|fault| fault.in_file(path))
    }

    /// Writes a file in the format that its name ends in, STL and PLY in their binary form, VTK as text, RSM with
    /// [`RsmFlags::default`].
    ///
    /// # Errors
    /// [`MeshError::UnknownFormat`], and those of the format's own function.
    pub fn save(&self, path: impl AsRef<Path>) -> Result<(), MeshError> {
        let path = path.as_ref();
        match MeshFormat::of_name(path) {
            Some(MeshFormat::Obj) => export_obj(path, self),
            Some(MeshFormat::Stl) => export_stl(path, self, MeshEncoding::Binary),
            Some(MeshFormat::Ply) => export_ply(path, self, MeshEncoding::Binary),
            Some(MeshFormat::Vtk) => export_vtk(path, self, &[], MeshEncoding::Ascii),
            Some(MeshFormat::Rsm) => export_rsm(path, self, RsmFlags::default()),
            None => Err(MeshError::UnknownFormat { path: path.to_owned() }),
        }
    }
}
