//! Files of meshes: OBJ, STL, PLY, VTK and Raysect's own RSM.
//!
//! Each format has a function that reads and one that writes; [`MeshData::load`](super::MeshData::load) and
//! [`MeshData::save`](super::MeshData::save) choose by the name of the file,
//! [`MeshData::from_bytes`](super::MeshData::from_bytes) reads what is in memory. Lengths are in metres, and what is
//! read is multiplied by a `scaling`: 0.001 for a file in mm. Faces of more than three corners are cut into triangles.
//!
//! ```
//! use raysect_primitive::MeshData;
//! use raysect_primitive::mesh::io::MeshFormat;
//!
//! let square = "v 0 0 0\nv 20 0 0\nv 20 20 0\nv 0 20 0\nf 1 2 3 4\n";
//! let mesh = MeshData::from_bytes(square.as_bytes(), MeshFormat::Obj, 0.001)?;
//! assert_eq!(mesh.triangles(), [[0, 1, 2], [0, 2, 3]]);
//! assert!((mesh.health().surface_area - 4e-4).abs() < 1e-18);
//!
//! let error = MeshData::from_bytes(b"v 0 0 nan", MeshFormat::Obj, 1.0).unwrap_err();
//! assert_eq!(error.to_string(), "(bytes): line 1: coordinates of a vertex: nan is not finite");
//! # Ok::<(), raysect_primitive::MeshError>(())
//! ```
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
