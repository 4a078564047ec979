use std::path::Path;

use super::super::{MeshData, MeshError};
use super::fault::Fault;
use super::{MeshEncoding, read_file, write_file};

mod attributes;
mod cells;
mod encode;
mod reader;
mod source;

/// A number for each triangle of a mesh.
#[derive(Debug, Clone, PartialEq)]
pub struct TriangleScalars {
    /// What the numbers mean.
    pub name: String,
    /// One number for each triangle.
    pub values: Vec<f64>,
}

/// Reads a legacy VTK file (`.vtk`), text or binary; coordinates are multiplied by `scaling` (0.001 for a file in mm).
///
/// Polygonal data and unstructured grids of versions 1 to 5 are read: triangles, triangle strips, quadrilaterals,
/// pixels and polygons; points and lines are passed over, cells with a volume refused. Normals of the points become
/// vertex normals.
///
/// # Errors
/// [`MeshError::MalformedLine`] of a text, [`MeshError::MalformedByte`] of a binary file, [`MeshError::File`] without
/// a triangle, [`MeshError::Transform`] unless the scaling is positive and finite, [`MeshError::Io`].
pub fn import_vtk(path: impl AsRef<Path>, scaling: f64) -> Result<MeshData, MeshError> {
    Ok(import_vtk_with_scalars(path, scaling)?.0)
}

/// Like [`import_vtk`], with the scalars of the cells (`SCALARS` and `FIELD` of one component), one number for each
/// triangle; they may be NaN, and are not scaled. Triangles of one polygon have the same number.
///
/// # Errors
/// As [`import_vtk`].
pub fn import_vtk_with_scalars(
    path: impl AsRef<Path>,
    scaling: f64,
) -> Result<(MeshData, Vec<TriangleScalars>), MeshError> {
    read_file(path.as_ref(), |bytes| parse(bytes, scaling))
}

/// Writes a legacy VTK file of version 2.0 with an unstructured grid, and numbers for each triangle.
///
/// Every coordinate is given back exactly: as `float` if all are 32-bit numbers, otherwise as `double`. A vertex with
/// several normals is written once for each. Raysect reads texts of meshes of 32-bit numbers.
///
/// # Errors
/// [`MeshError::ScalarCount`] unless there is one number for each triangle, [`MeshError::Encode`] for more vertices
/// than the format can name, [`MeshError::Io`].
pub fn export_vtk(
    path: impl AsRef<Path>,
    mesh: &MeshData,
    scalars: &[TriangleScalars],
    encoding: MeshEncoding,
) -> Result<(), MeshError> {
    let path = path.as_ref();
    let triangles = mesh.triangle_count();
    if let Some(s) = scalars.iter().find(|s| s.values.len() != triangles) {
        return Err(MeshError::ScalarCount { name: s.name.clone(), triangles, found: s.values.len() });
    }
    let bytes = encode::encode(mesh, scalars, encoding)
        .map_err(|what| MeshError::Encode { path: path.to_owned(), what })?;
    write_file(path, &bytes)
}

pub(super) fn parse(bytes: &[u8], scaling: f64) -> Result<(MeshData, Vec<TriangleScalars>), Fault> {
    reader::Reader::new(bytes)?.read(scaling)
}

#[cfg(test)]
#[path = "vtk_tests.rs"]
mod tests;
