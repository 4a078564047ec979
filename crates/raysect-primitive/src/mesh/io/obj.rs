use std::fmt::Write;
use std::path::Path;

use super::super::{MeshData, MeshError};
use super::fault::Fault;
use super::polygons::Polygons;
use super::text::{Text, finite, integer, shown, words};
use super::{read_file, write_file};

/// Reads a Wavefront OBJ file; coordinates are multiplied by `scaling` (0.001 for a file in mm).
///
/// All groups and objects become one mesh. Faces of any number of corners are cut into triangles, concave ones too.
/// Vertex normals are read and made units; a corner without one gets that of its face. Texture coordinates,
/// materials, lines and points are passed over.
///
/// # Errors
/// [`MeshError::MalformedLine`], [`MeshError::File`] without a face, [`MeshError::Transform`] unless the scaling is
/// positive and finite, [`MeshError::Io`].
pub fn import_obj(path: impl AsRef<Path>, scaling: f64) -> Result<MeshData, MeshError> {
    read_file(path.as_ref(), |bytes| parse(bytes, scaling))
}

/// Writes a Wavefront OBJ file; the digits give back every coordinate exactly.
///
/// # Errors
/// [`MeshError::Io`].
pub fn export_obj(path: impl AsRef<Path>, mesh: &MeshData) -> Result<(), MeshError> {
    write_file(path.as_ref(), encode(mesh).as_bytes())
}

pub(super) fn parse(bytes: &[u8], scaling: f64) -> Result<MeshData, Fault> {
    let mut reader = Reader { text: Text::new(bytes), polygons: Polygons::default(), unknown: None };
    let mut statement = Vec::new();
    while reader.next_statement(&mut statement) {
        if let [keyword, arguments @ ..] = statement.as_slice() {
            reader.obey(keyword, arguments)?;
        }
    }
    match reader.unknown {
        Some(fault) if reader.polygons.len() == 0 => Err(fault),
        _ => Ok(reader.polygons.finish(scaling, Fault::Line)?.mesh),
    }
}

struct Reader<'a> {
    text: Text<'a>,
    polygons: Polygons,
    /// The first keyword that means nothing.
    unknown: Option<Fault>,
}

impl<'a> Reader<'a> {
    /// The words of the next statement: lines that end in a backslash go on in the next.
    fn next_statement(&mut self, statement: &mut Vec<&'a [u8]>) -> bool {
        statement.clear();
        let mut is_read = false;
        while let Some(line) = self.text.line() {
            is_read = true;
            let line = line.split(|&b| b == b'#').next().unwrap_or(line).trim_ascii_end();
            let (line, goes_on) = line.strip_suffix(b"\\").map_or((line, false), |line| (line, true));
            statement.extend(words(line));
            if !goes_on {
                break;
            }
        }
        is_read
    }

    fn obey(&mut self, keyword: &[u8], arguments: &[&[u8]]) -> Result<(), Fault> {
        match keyword {
            b"v" => {
                let point = self.triple(arguments, "coordinates of a vertex")?;
                self.polygons.vertices.push(point.into());
            }
            b"vn" => {
                let normal = self.triple(arguments, "components of a normal")?;
                self.polygons.normals.push(normal.into());
            }
            b"f" | b"fo" => {
                for word in arguments {
                    let (vertex, normal) = self.corner(word).map_err(|what| self.text.fault(what))?;
                    self.polygons.corner(vertex, normal);
                }
                self.polygons.end_polygon(self.text.line_number());
            }
            b"surf" => {
                return Err(self.text.fault("free-form surfaces are not read, triangulate them first"));
            }
            b"vt" | b"vp" | b"g" | b"o" | b"s" | b"l" | b"p" | b"usemtl" | b"mtllib" | b"mg" | b"lod" => {}
            _ if self.unknown.is_none() => {
                self.unknown = Some(self.text.fault(format!("'{}' is no keyword of OBJ", shown(keyword))));
            }
            _ => {}
        }
        Ok(())
    }

    fn triple(&self, words: &[&[u8]], what: &str) -> Result<[f64; 3], Fault> {
        let [x, y, z, ..] = words else {
            return Err(self.text.fault(format!("three {what} are needed, {} follow", words.len())));
        };
        let number = |word: &[u8]| finite(word, what).map_err(|what| self.text.fault(what));
        Ok([number(x)?, number(y)?, number(z)?])
    }

    /// `v`, `v/vt`, `v//vn` or `v/vt/vn`, counted from 0.
    fn corner(&self, word: &[u8]) -> Result<(u32, Option<u32>), String> {
        let mut parts = word.split(|&b| b == b'/');
        let vertex = parts.next().unwrap_or_default();
        let vertex = absolute(vertex, self.polygons.vertices.len(), "vertex")?;
        let normal = match (parts.next(), parts.next(), parts.next()) {
            (_, None | Some(b""), None) => None,
            (_, Some(normal), None) => Some(absolute(normal, self.polygons.normals.len(), "normal")?),
            _ => return Err(format!("the corner '{}' has more than three parts", shown(word))),
        };
        Ok((vertex, normal))
    }
}

/// An index of the file, counted from 1 or, if negative, back from the last element, as one counted from 0.
fn absolute(word: &[u8], count: usize, what: &str) -> Result<u32, String> {
    let index: i64 = integer(word, what)?;
    let absolute =
        if index < 0 { i64::try_from(count).ok().map(|count| count + index) } else { Some(index - 1) };
    let absolute = absolute.and_then(|index| u32::try_from(index).ok()).filter(|&index| index != u32::MAX);
    absolute.ok_or_else(|| format!("{what} {index} is named after {count} of them (counted from 1)"))
}

pub(super) fn encode(mesh: &MeshData) -> String {
    let mut text = String::from("# raysect\n");
    let mut triple = |keyword, [x, y, z]: [f64; 3]| {
        let _ = writeln!(text, "{keyword} {x:?} {y:?} {z:?}");
    };
    mesh.vertices().iter().for_each(|p| triple("v", p.to_array()));
    mesh.vertex_normals().unwrap_or_default().iter().for_each(|n| triple("vn", n.to_array()));
    let indices = mesh.normal_indices();
    for (triangle, vertices) in mesh.triangles().iter().enumerate() {
        let [a, b, c] = vertices.map(|v| u64::from(v) + 1);
        let _ = match indices.map(|i| i[triangle].map(|n| u64::from(n) + 1)) {
            Some([na, nb, nc]) => writeln!(text, "f {a}//{na} {b}//{nb} {c}//{nc}"),
            None => writeln!(text, "f {a} {b} {c}"),
        };
    }
    text
}

#[cfg(test)]
#[path = "obj_tests.rs"]
mod tests;
