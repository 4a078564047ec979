use std::fmt::Write;

use raysect_math::{Normal3D, Point3D};

use super::super::split::split_by_normal;
use super::super::{MeshEncoding, are_f32};
use crate::mesh::MeshData;

pub(super) fn encode(mesh: &MeshData, encoding: MeshEncoding) -> Result<Vec<u8>, String> {
    let split = split_by_normal(mesh)?;
    let real = if are_f32(&split.vertices) { "float" } else { "double" };
    let mut bytes =
        header(encoding, real, split.vertices.len(), !split.normals.is_empty(), mesh.triangle_count())
            .into_bytes();
    let mut normals = split.normals.iter();
    for vertex in &split.vertices {
        let normal = normals.next();
        match encoding {
            MeshEncoding::Ascii => bytes.extend(row(*vertex, normal.copied()).bytes()),
            MeshEncoding::Binary => {
                for x in vertex.to_array() {
                    // Exact, as `are_f32` has told.
                    if real == "float" {
                        bytes.extend((x as f32).to_le_bytes());
                    } else {
                        bytes.extend(x.to_le_bytes());
                    }
                }
                let components = normal.map_or([0.0; 3], |n| n.to_array());
                let written = if normal.is_some() { components.as_slice() } else { &[] };
                bytes.extend(written.iter().flat_map(|x| x.to_le_bytes()));
            }
        }
    }
    for t in &split.triangles {
        match encoding {
            MeshEncoding::Ascii => bytes.extend(format!("3 {} {} {}\n", t[0], t[1], t[2]).bytes()),
            MeshEncoding::Binary => {
                bytes.push(3);
                bytes.extend(t.iter().flat_map(|v| v.to_le_bytes()));
            }
        }
    }
    Ok(bytes)
}

fn header(
    encoding: MeshEncoding,
    real: &str,
    vertices: usize,
    has_normals: bool,
    triangles: usize,
) -> String {
    let format = match encoding {
        MeshEncoding::Ascii => "ascii",
        MeshEncoding::Binary => "binary_little_endian",
    };
    let mut text = format!("ply\nformat {format} 1.0\ncomment raysect\nelement vertex {vertices}\n");
    for axis in ["x", "y", "z"] {
        let _ = writeln!(text, "property {real} {axis}");
    }
    if has_normals {
        text.push_str("property double nx\nproperty double ny\nproperty double nz\n");
    }
    // Signed indices are what most readers expect; larger ones need the whole range.
    let index = if i32::try_from(vertices).is_ok() { "int" } else { "uint" };
    let _ =
        writeln!(text, "element face {triangles}\nproperty list uchar {index} vertex_indices\nend_header");
    text
}

fn row(Point3D { x, y, z }: Point3D, normal: Option<Normal3D>) -> String {
    match normal {
        Some(n) => format!("{x:?} {y:?} {z:?} {:?} {:?} {:?}\n", n.x, n.y, n.z),
        None => format!("{x:?} {y:?} {z:?}\n"),
    }
}
