use std::fmt::Write;
use std::path::Path;

use raysect_math::{Normal3D, Point3D};

use super::super::{MeshData, MeshError};
use super::bytes::Bytes;
use super::fault::Fault;
use super::polygons::Polygons;
use super::text::{Text, shown};
use super::{MeshEncoding, read_file, write_file};

/// Bytes before the first triangle of a binary file: a free text and the count.
const HEADER: usize = 84;
/// Bytes of a triangle: normal, three corners, two bytes without meaning.
const RECORD: usize = 50;

/// Reads an STL file, text or binary; coordinates are multiplied by `scaling` (0.001 for a file in mm).
///
/// Corners at equal coordinates become one vertex. The normals of the file are not looked at: the order of the corners
/// tells the front. All solids of a text become one mesh. A file whose size agrees with its count is binary, whatever
/// its first word.
///
/// # Errors
/// [`MeshError::MalformedLine`] of a text, [`MeshError::MalformedByte`] of a binary file, also for a wrong count,
/// [`MeshError::File`] without a triangle, [`MeshError::Transform`] unless the scaling is positive and finite,
/// [`MeshError::Io`].
pub fn import_stl(path: impl AsRef<Path>, scaling: f64) -> Result<MeshData, MeshError> {
    read_file(path.as_ref(), |bytes| parse(bytes, scaling))
}

/// Writes an STL file. As text it gives back every coordinate exactly; binary files hold 32-bit numbers, to which
/// coordinates are rounded. Vertex normals have no place in it.
///
/// # Errors
/// [`MeshError::Encode`] for a binary file if a coordinate is beyond 32-bit numbers, or if there are more triangles
/// than its count can tell; [`MeshError::Io`].
pub fn export_stl(path: impl AsRef<Path>, mesh: &MeshData, encoding: MeshEncoding) -> Result<(), MeshError> {
    let path = path.as_ref();
    match encoding {
        MeshEncoding::Ascii => write_file(path, encode_text(mesh).as_bytes()),
        MeshEncoding::Binary => {
            let encode = |what| MeshError::Encode { path: path.to_owned(), what };
            write_file(path, &encode_binary(mesh).map_err(encode)?)
        }
    }
}

pub(super) fn parse(bytes: &[u8], scaling: f64) -> Result<MeshData, Fault> {
    let mesh = if is_binary(bytes) { parse_binary(bytes, scaling) } else { parse_text(bytes, scaling) };
    Ok(mesh?.weld())
}

/// True if the file has the size that its count asks of a binary one.
pub(super) fn has_size_of_count(bytes: &[u8]) -> bool {
    let count = bytes.get(80..HEADER).and_then(|word| word.first_chunk()).copied().map(u32::from_le_bytes);
    count.is_some_and(|n| bytes.len() as u64 == HEADER as u64 + RECORD as u64 * u64::from(n))
}

/// True unless the file is a text: its count agrees with its size, or it does not begin as a text does.
fn is_binary(bytes: &[u8]) -> bool {
    let begins_as_text = Text::new(bytes).word().is_some_and(|word| word.eq_ignore_ascii_case(b"solid"));
    // A zero among the first bytes is no character: a binary file of wrong size.
    has_size_of_count(bytes) || !begins_as_text || bytes.iter().take(HEADER).any(|&b| b == 0)
}

fn parse_binary(bytes: &[u8], scaling: f64) -> Result<MeshData, Fault> {
    let mut reader = Bytes::new(bytes, 80, false);
    if bytes.len() < HEADER {
        return Err(Fault::Byte(
            bytes.len(),
            "neither a text of STL nor the 84 bytes that begin a binary one".into(),
        ));
    }
    let count = u32::from_le_bytes(reader.little("the number of triangles")?);
    let count = reader.admit(u64::from(count), RECORD, "triangles")?;
    let mut polygons = Polygons::default();
    polygons.vertices.reserve(3 * count);
    for _ in 0..count {
        let place = reader.position();
        reader.take(12, "a normal")?;
        for _ in 0..3 {
            let corner = reader.triple_f32("a corner")?;
            polygons.lone_corner(corner);
        }
        reader.take(2, "a triangle")?;
        polygons.end_polygon(place);
    }
    if reader.remaining() > 0 {
        return Err(reader.fault(format!("{} bytes follow the {count} triangles", reader.remaining())));
    }
    Ok(polygons.finish(scaling, Fault::Byte)?.mesh)
}

fn parse_text(bytes: &[u8], scaling: f64) -> Result<MeshData, Fault> {
    let mut text = Text::new(bytes);
    let mut polygons = Polygons::default();
    while text.peek().is_some() {
        keyword(&mut text, "solid")?;
        // The rest of the line is a name, unless the first facet follows at once.
        let mut rest = text.clone();
        if ["facet", "normal"].iter().any(|expected| keyword(&mut rest, expected).is_err())
            || rest.line_number() != text.line_number()
        {
            text.line();
        }
        while read_facet(&mut text, &mut polygons)? {}
        // The name again.
        text.line();
    }
    Ok(polygons.finish(scaling, Fault::Line)?.mesh)
}

/// Reads a facet; false at the end of the solid.
fn read_facet(text: &mut Text, polygons: &mut Polygons) -> Result<bool, Fault> {
    let word = text.expect("facet or endsolid")?;
    if word.eq_ignore_ascii_case(b"endsolid") {
        return Ok(false);
    }
    let place = text.line_number();
    check(text, word, "facet")?;
    keyword(text, "normal")?;
    for _ in 0..3 {
        text.expect("a component of a normal")?;
    }
    keyword(text, "outer")?;
    keyword(text, "loop")?;
    let mut word = text.expect("vertex")?;
    while word.eq_ignore_ascii_case(b"vertex") {
        let corner = text.triple("a corner")?;
        polygons.lone_corner(corner);
        word = text.expect("vertex or endloop")?;
    }
    check(text, word, "endloop")?;
    keyword(text, "endfacet")?;
    polygons.end_polygon(place);
    Ok(true)
}

fn keyword(text: &mut Text, expected: &str) -> Result<(), Fault> {
    let word = text.expect(expected)?;
    check(text, word, expected)
}

fn check(text: &Text, word: &[u8], expected: &str) -> Result<(), Fault> {
    if word.eq_ignore_ascii_case(expected.as_bytes()) {
        return Ok(());
    }
    Err(text.fault(format!("'{}' where '{expected}' should stand", shown(word))))
}

fn face_normal(mesh: &MeshData, triangle: usize) -> [f64; 3] {
    mesh.face_normal(triangle).map_or([0.0; 3], Normal3D::to_array)
}

fn encode_text(mesh: &MeshData) -> String {
    let mut text = String::from("solid raysect\n");
    for triangle in 0..mesh.triangle_count() {
        let [x, y, z] = face_normal(mesh, triangle);
        let _ = writeln!(text, "facet normal {x:?} {y:?} {z:?}\n outer loop");
        for Point3D { x, y, z } in mesh.corners(triangle) {
            let _ = writeln!(text, "  vertex {x:?} {y:?} {z:?}");
        }
        text.push_str(" endloop\nendfacet\n");
    }
    text.push_str("endsolid raysect\n");
    text
}

fn encode_binary(mesh: &MeshData) -> Result<Vec<u8>, String> {
    let count = u32::try_from(mesh.triangle_count()).map_err(|_| "too many triangles for STL".to_owned())?;
    let mut bytes = format!("{:<80}", "raysect").into_bytes();
    bytes.extend(count.to_le_bytes());
    for triangle in 0..mesh.triangle_count() {
        let corners = mesh.corners(triangle).map(Point3D::to_array);
        for x in face_normal(mesh, triangle).into_iter().chain(corners.into_iter().flatten()) {
            let rounded = x as f32;
            if !rounded.is_finite() {
                return Err(format!("triangle {triangle}: {x} m is beyond the 32-bit numbers of binary STL"));
            }
            bytes.extend(rounded.to_le_bytes());
        }
        bytes.extend([0; 2]);
    }
    Ok(bytes)
}

#[cfg(test)]
#[path = "stl_tests.rs"]
mod tests;
