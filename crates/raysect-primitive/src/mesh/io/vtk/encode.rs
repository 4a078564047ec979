use super::super::split::split_by_normal;
use super::super::{MeshEncoding, are_f32};
use super::TriangleScalars;
use crate::mesh::MeshData;

pub(super) fn encode(
    mesh: &MeshData,
    scalars: &[TriangleScalars],
    encoding: MeshEncoding,
) -> Result<Vec<u8>, String> {
    let split = split_by_normal(mesh)?;
    let (vertices, triangles) = (split.vertices.len(), split.triangles.len());
    if i32::try_from(vertices.max(4 * triangles)).is_err() {
        return Err("more vertices or triangles than legacy VTK can name".into());
    }
    let mut out = Out { bytes: Vec::new(), is_text: encoding == MeshEncoding::Ascii };
    let form = if out.is_text { "ASCII" } else { "BINARY" };
    let is_single = are_f32(&split.vertices);
    let real = if is_single { "float" } else { "double" };
    out.line(&format!("# vtk DataFile Version 2.0\nraysect\n{form}\nDATASET UNSTRUCTURED_GRID"));
    out.line(&format!("POINTS {vertices} {real}"));
    split.vertices.iter().for_each(|p| out.reals(&p.to_array(), is_single));
    out.end_array();
    out.line(&format!("CELLS {triangles} {}", 4 * triangles));
    split.triangles.iter().for_each(|&[a, b, c]| out.integers(&[3, a, b, c]));
    out.end_array();
    out.line(&format!("CELL_TYPES {triangles}"));
    (0..triangles).for_each(|_| out.integers(&[5]));
    out.end_array();
    if !split.normals.is_empty() {
        out.line(&format!("POINT_DATA {vertices}\nNORMALS normals double"));
        split.normals.iter().for_each(|n| out.reals(&n.to_array(), false));
        out.end_array();
    }
    if !scalars.is_empty() {
        out.line(&format!("CELL_DATA {triangles}"));
    }
    for s in scalars {
        out.line(&format!("SCALARS {} double 1\nLOOKUP_TABLE default", encoded(&s.name)?));
        s.values.iter().for_each(|&value| out.reals(&[value], false));
        out.end_array();
    }
    Ok(out.bytes)
}

struct Out {
    bytes: Vec<u8>,
    is_text: bool,
}

impl Out {
    fn line(&mut self, line: &str) {
        self.bytes.extend(line.bytes());
        self.bytes.push(b'\n');
    }

    /// Numbers of 32 bits if `is_single`, otherwise of 64.
    fn reals(&mut self, values: &[f64], is_single: bool) {
        if self.is_text {
            let words: Vec<String> = values.iter().map(|x| format!("{x:?}")).collect();
            self.line(&words.join(" "));
        } else if is_single {
            self.bytes.extend(values.iter().flat_map(|&x| (x as f32).to_be_bytes()));
        } else {
            self.bytes.extend(values.iter().flat_map(|x| x.to_be_bytes()));
        }
    }

    fn integers(&mut self, values: &[u32]) {
        if self.is_text {
            let words: Vec<String> = values.iter().map(u32::to_string).collect();
            self.line(&words.join(" "));
        } else {
            self.bytes.extend(values.iter().flat_map(|x| x.to_be_bytes()));
        }
    }

    /// Bytes are parted from the next line.
    fn end_array(&mut self) {
        if !self.is_text {
            self.bytes.push(b'\n');
        }
    }
}

/// A name as one word: odd characters become % and two hexadecimal digits.
fn encoded(name: &str) -> Result<String, String> {
    if name.is_empty() {
        return Err("values without a name".into());
    }
    let plain = |b: u8| b.is_ascii_graphic() && b != b'%' && b != b'"';
    Ok(name.bytes().map(|b| if plain(b) { char::from(b).to_string() } else { format!("%{b:02X}") }).collect())
}
