use std::path::Path;

use raysect_math::{Normal3D, Point3D};

use self::header::{Element, Header, Kind};
use self::source::Source;
use super::super::{MeshData, MeshError};
use super::fault::Fault;
use super::polygons::{Polygons, index};
use super::{MeshEncoding, read_file, write_file};

mod encode;
mod header;
mod source;

/// Reads a PLY file, text or binary of either byte order; coordinates are multiplied by `scaling` (0.001 for a file in
/// mm).
///
/// Faces of any number of corners and triangle strips are read, vertex normals (`nx`, `ny`, `nz`) too; other properties
/// and elements are passed over.
///
/// # Errors
/// [`MeshError::MalformedLine`] of the header and of a text, [`MeshError::MalformedByte`] of binary data,
/// [`MeshError::File`] without a face, [`MeshError::Transform`] unless the scaling is positive and finite,
/// [`MeshError::Io`].
pub fn import_ply(path: impl AsRef<Path>, scaling: f64) -> Result<MeshData, MeshError> {
    read_file(path.as_ref(), |bytes| parse(bytes, scaling))
}

/// Writes a PLY file, its binary form with the lowest byte first. Both give back every coordinate exactly: as `float`
/// if all are 32-bit numbers, otherwise as `double`.
///
/// A vertex with several normals is written once for each. Raysect reads the binary form of meshes of 32-bit numbers
/// without normals.
///
/// # Errors
/// [`MeshError::Encode`] if the normals make too many vertices, [`MeshError::Io`].
pub fn export_ply(path: impl AsRef<Path>, mesh: &MeshData, encoding: MeshEncoding) -> Result<(), MeshError> {
    let path = path.as_ref();
    let bytes =
        encode::encode(mesh, encoding).map_err(|what| MeshError::Encode { path: path.to_owned(), what })?;
    write_file(path, &bytes)
}

pub(super) fn parse(bytes: &[u8], scaling: f64) -> Result<MeshData, Fault> {
    let (header, mut source) = Header::read(bytes)?;
    let mut polygons = Polygons::default();
    for element in &header.elements {
        match element.name.as_slice() {
            b"vertex" => read_vertices(element, &mut source, &mut polygons)?,
            b"face" => read_faces(element, &mut source, &mut polygons, false)?,
            b"tristrips" => read_faces(element, &mut source, &mut polygons, true)?,
            _ => pass_over(element, &mut source)?,
        }
    }
    source.end()?;
    if !polygons.normals.is_empty() {
        polygons.normals_of_vertices();
    }
    Ok(polygons.finish(scaling, source.fault_at())?.mesh)
}

/// Where among the properties of an element stand those of these names.
fn positions<const N: usize>(element: &Element, names: [&[u8]; N]) -> Option<[usize; N]> {
    let mut found = [0; N];
    for (position, name) in found.iter_mut().zip(names) {
        let is_it = |p: &header::Property| p.name == name && matches!(p.kind, Kind::Scalar(_));
        *position = element.properties.iter().position(is_it)?;
    }
    Some(found)
}

fn read_vertices(element: &Element, source: &mut Source, polygons: &mut Polygons) -> Result<(), Fault> {
    let no_place = || Fault::Line(element.line, "the vertices have no properties x, y and z".into());
    let place = positions(element, [b"x", b"y", b"z"]).ok_or_else(no_place)?;
    let normal = positions(element, [b"nx", b"ny", b"nz"]);
    let count = source.admit(element)?;
    polygons.vertices.reserve(count);
    let mut row = vec![0.0; element.properties.len()];
    for _ in 0..count {
        for (value, property) in row.iter_mut().zip(&element.properties) {
            match property.kind {
                Kind::Scalar(number) => *value = source.number(number, "a property of a vertex")?,
                Kind::List { length, item } => {
                    source.list(length, item, |_| Ok(()))?;
                }
            }
        }
        let finite = |at: [usize; 3]| {
            let triple = at.map(|k| row[k]);
            let all = triple.iter().all(|x| x.is_finite());
            let fault =
                || format!("a vertex with ({}, {}, {}) is not finite", triple[0], triple[1], triple[2]);
            if all { Ok(triple) } else { Err(source.fault(fault())) }
        };
        polygons.vertices.push(Point3D::from(finite(place)?));
        if let Some(normal) = normal {
            polygons.normals.push(Normal3D::from(finite(normal)?));
        }
    }
    Ok(())
}

fn read_faces(
    element: &Element,
    source: &mut Source,
    polygons: &mut Polygons,
    are_strips: bool,
) -> Result<(), Fault> {
    let is_corners = |p: &header::Property| {
        (p.name == b"vertex_indices" || p.name == b"vertex_index") && matches!(p.kind, Kind::List { .. })
    };
    let corners = element.properties.iter().position(is_corners);
    let no_corners = || Fault::Line(element.line, "the faces have no list vertex_indices".into());
    let corners = corners.ok_or_else(no_corners)?;
    let mut strip = Vec::new();
    for _ in 0..source.admit(element)? {
        let place = source.place();
        for (k, property) in element.properties.iter().enumerate() {
            match property.kind {
                Kind::Scalar(number) => {
                    source.number(number, "a property of a face")?;
                }
                Kind::List { length, item } if k != corners => source.list(length, item, |_| Ok(()))?,
                Kind::List { length, item } if are_strips => {
                    source.list(length, item, |value| {
                        strip.push(if value == -1.0 { None } else { Some(index(value)?) });
                        Ok(())
                    })?;
                    strip
                        .split(Option::is_none)
                        .for_each(|s| polygons.strip(s.iter().copied().flatten(), place));
                    strip.clear();
                }
                Kind::List { length, item } => {
                    source.list(length, item, |value| {
                        polygons.corner(index(value)?, None);
                        Ok(())
                    })?;
                    polygons.end_polygon(place);
                }
            }
        }
    }
    Ok(())
}

fn pass_over(element: &Element, source: &mut Source) -> Result<(), Fault> {
    if element.properties.is_empty() {
        return Ok(());
    }
    for _ in 0..source.admit(element)? {
        for property in &element.properties {
            match property.kind {
                Kind::Scalar(number) => {
                    source.number(number, "a property")?;
                }
                Kind::List { length, item } => source.list(length, item, |_| Ok(()))?,
            }
        }
    }
    Ok(())
}

#[cfg(test)]
#[path = "ply_tests.rs"]
mod tests;
