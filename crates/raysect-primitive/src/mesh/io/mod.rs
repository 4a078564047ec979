//! Files of meshes: OBJ, STL, PLY, VTK and Raysect's own RSM.
//!
//! Each format has a function that reads and one that writes; [`MeshData::load`] and [`MeshData::save`] choose by the
//! name of the file, [`MeshData::from_bytes`] reads what is in memory. Lengths are in metres, and what is read is
//! multiplied by a `scaling`: 0.001 for a file in mm. Faces of more than three corners are cut into triangles.
//!
//! A file that breaks the rules of its format is refused with its path and the line or byte, never read halfway, and
//! memory is claimed only for what is present. The readers are written here: the known crates for OBJ and STL name no
//! lines, know no continued lines, no capitals and no concave faces, or read decimal digits as 32-bit numbers. They
//! judge these readers in the tests.

mod bytes;
mod fault;
mod format;
mod obj;
mod ply;
mod polygons;
mod rsm;
mod split;
mod stl;
mod text;
mod triangulate;
mod vtk;

use std::fs;
use std::io::{self, ErrorKind};
use std::path::Path;

use raysect_math::Point3D;

pub use format::{MeshEncoding, MeshFormat};
pub use obj::{export_obj, import_obj};
pub use ply::{export_ply, import_ply};
pub use rsm::{RsmFlags, export_rsm, import_rsm};
pub use stl::{export_stl, import_stl};
pub use vtk::{TriangleScalars, export_vtk, import_vtk, import_vtk_with_scalars};

use self::fault::Fault;
use super::MeshError;

/// Reads a whole file.
fn read_file<T>(path: &Path, parse: impl FnOnce(&[u8]) -> Result<T, Fault>) -> Result<T, MeshError> {
    let bytes = read_bytes(path)?;
    parse(&bytes).map_err(|fault| fault.in_file(path))
}

fn read_bytes(path: &Path) -> Result<Vec<u8>, MeshError> {
    let read = || {
        if fs::metadata(path)?.is_file() {
            fs::read(path)
        } else {
            Err(io::Error::new(ErrorKind::InvalidInput, "not a regular file"))
        }
    };
    read().map_err(|error| MeshError::io(path, &error))
}

fn write_file(path: &Path, bytes: &[u8]) -> Result<(), MeshError> {
    fs::write(path, bytes).map_err(|error| MeshError::io(path, &error))
}

/// True if 32-bit numbers hold every coordinate exactly.
fn are_f32(vertices: &[Point3D]) -> bool {
    vertices.iter().flat_map(|p| p.to_array()).all(|x| f64::from(x as f32) == x)
}
