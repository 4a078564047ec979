use std::path::Path;

use raysect_math::spatial::{KdItem, KdTree3D, KdTreeSettings};
use raysect_math::{MathError, Normal3D, Point3D};

use super::super::{MeshData, MeshError};
use super::bytes::Bytes;
use super::fault::Fault;
use super::polygons::Polygons;
use super::{read_file, write_file};

const MAGIC: &[u8] = b"RSM";
/// The share of the mesh's size by which the boxes of triangles are enlarged; Raysect takes that of the triangle, and
/// 1 µm at least.
const PADDING: f64 = 1e-6;

/// What a Raysect mesh file says of its mesh besides the triangles.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct RsmFlags {
    /// Shading normals are interpolated between the vertex normals.
    pub smoothing: bool,
    /// The mesh is the surface of a solid.
    pub closed: bool,
}

impl Default for RsmFlags {
    /// Raysect's defaults: both.
    fn default() -> Self {
        Self { smoothing: true, closed: true }
    }
}

/// Reads a Raysect mesh file (`.rsm`, version 1.0); coordinates are multiplied by `scaling` (0.001 for a file in mm).
///
/// Its tree is passed over: trees are built anew.
///
/// # Errors
/// [`MeshError::MalformedByte`], [`MeshError::File`] without a triangle, [`MeshError::Transform`] unless the scaling is
/// positive and finite, [`MeshError::Io`].
#[doc(alias = "from_file")]
pub fn import_rsm(path: impl AsRef<Path>, scaling: f64) -> Result<(MeshData, RsmFlags), MeshError> {
    read_file(path.as_ref(), |bytes| parse(bytes, scaling))
}

/// Writes a Raysect mesh file (`.rsm`, version 1.0), with a tree of Raysect's default settings.
///
/// The format holds 32-bit numbers, to which coordinates are rounded. Triangles that have no area, or lose it by that,
/// are left out, as Raysect cannot hold them.
///
/// # Errors
/// [`MeshError::Encode`] if a coordinate is beyond 32-bit numbers, if no triangle is left, or if there are 2³¹ or more
/// of anything; [`MeshError::Io`].
#[doc(alias = "save")]
pub fn export_rsm(path: impl AsRef<Path>, mesh: &MeshData, flags: RsmFlags) -> Result<(), MeshError> {
    let path = path.as_ref();
    let bytes = encode(mesh, flags).map_err(|what| MeshError::Encode { path: path.to_owned(), what })?;
    write_file(path, &bytes)
}

pub(super) fn parse(bytes: &[u8], scaling: f64) -> Result<(MeshData, RsmFlags), Fault> {
    let mut reader = Bytes::new(bytes, 0, false);
    if !bytes.starts_with(MAGIC) {
        return Err(reader.fault("not a Raysect mesh file: the letters RSM are missing"));
    }
    reader.take(MAGIC.len(), "letters")?;
    let version = [reader.u8("the version")?, reader.u8("the version")?];
    if version != [1, 0] {
        return Err(Fault::Byte(3, format!("version {}.{} of RSM: 1.0 is read", version[0], version[1])));
    }
    let flags = RsmFlags { smoothing: flag(&mut reader)?, closed: flag(&mut reader)? };
    let has_tree = flag(&mut reader)?;
    let polygons = read_triangles(&mut reader)?;
    if has_tree {
        pass_tree(&mut reader)?;
    }
    if reader.remaining() > 0 {
        return Err(reader.fault(format!("{} bytes follow the end", reader.remaining())));
    }
    Ok((polygons.finish(scaling, Fault::Byte)?.mesh, flags))
}

fn flag(reader: &mut Bytes) -> Result<bool, Fault> {
    let start = reader.position();
    match reader.u8("a flag")? {
        0 => Ok(false),
        1 => Ok(true),
        other => Err(Fault::Byte(start, format!("a flag is 0 or 1, not {other}"))),
    }
}

fn count(reader: &mut Bytes, what: &str) -> Result<u64, Fault> {
    let start = reader.position();
    let count = reader.i32(what)?;
    u64::try_from(count).map_err(|_| Fault::Byte(start, format!("{what}: {count} is negative")))
}

fn read_triangles(reader: &mut Bytes) -> Result<Polygons, Fault> {
    let vertices = count(reader, "the number of vertices")?;
    let normals = count(reader, "the number of normals")?;
    let triangles = count(reader, "the number of triangles")?;
    let mut polygons = Polygons::default();
    for _ in 0..reader.admit(vertices, 12, "vertices")? {
        polygons.vertices.push(Point3D::from(reader.triple_f32("a vertex")?));
    }
    let normals = reader.admit(normals, 12, "normals")?;
    for _ in 0..normals {
        polygons.normals.push(Normal3D::from(reader.triple_f32("a normal")?));
    }
    let size = if normals > 0 { 24 } else { 12 };
    for _ in 0..reader.admit(triangles, size, "triangles")? {
        let place = reader.position();
        let vertices = indices(reader)?;
        let normals = if normals > 0 { indices(reader)?.map(Some) } else { [None; 3] };
        vertices.into_iter().zip(normals).for_each(|(v, n)| polygons.corner(v, n));
        polygons.end_polygon(place);
    }
    Ok(polygons)
}

fn indices(reader: &mut Bytes) -> Result<[u32; 3], Fault> {
    let mut indices = [0; 3];
    for index in &mut indices {
        let start = reader.position();
        let value = reader.i32("an index")?;
        *index =
            u32::try_from(value).map_err(|_| Fault::Byte(start, format!("the index {value} is negative")))?;
    }
    Ok(indices)
}

/// Goes past a tree, in the layout that [`KdTree3D::write`] describes.
fn pass_tree(reader: &mut Bytes) -> Result<(), Fault> {
    reader.take(4 + 4 + 8 + 8 + 6 * 8, "settings and bounds of the tree")?;
    let nodes = count(reader, "the number of nodes")?;
    for _ in 0..reader.admit(nodes, 8, "nodes")? {
        let start = reader.position();
        match reader.i32("a node")? {
            -1 => {
                let items = count(reader, "the number of triangles of a leaf")?;
                let items = reader.admit(items, 4, "triangles of a leaf")?;
                reader.take(4 * items, "the triangles of a leaf")?;
            }
            0..=2 => {
                reader.take(8 + 4, "a branch")?;
            }
            other => return Err(Fault::Byte(start, format!("a node that is divided along axis {other}"))),
        }
    }
    Ok(())
}

fn encode(mesh: &MeshData, flags: RsmFlags) -> Result<Vec<u8>, String> {
    let rounded = round(mesh)?;
    let mut bytes = MAGIC.to_vec();
    bytes.extend([1, 0, u8::from(flags.smoothing), u8::from(flags.closed), 1]);
    let normals = rounded.vertex_normals().unwrap_or_default();
    for count in [rounded.vertex_count(), normals.len(), rounded.triangle_count()] {
        bytes.extend(signed(count)?.to_le_bytes());
    }
    let vertices = rounded.vertices().iter().flat_map(|p| p.to_array());
    let components = normals.iter().flat_map(|n| n.to_array());
    bytes.extend(vertices.chain(components).flat_map(|x| (x as f32).to_le_bytes()));
    let indices = rounded.normal_indices();
    for (triangle, vertices) in rounded.triangles().iter().enumerate() {
        bytes.extend(vertices.iter().flat_map(|v| v.to_le_bytes()));
        let normals = indices.map(|i| i[triangle]);
        bytes.extend(normals.iter().flatten().flat_map(|n| n.to_le_bytes()));
    }
    let tree = tree(&rounded).map_err(|error| error.to_string())?;
    tree.write(&mut bytes).map_err(|error| error.to_string())?;
    Ok(bytes)
}

/// The mesh with coordinates of 32 bits.
fn round(mesh: &MeshData) -> Result<MeshData, String> {
    let single = |x: f64| f64::from(x as f32);
    let vertices: Vec<Point3D> =
        mesh.vertices().iter().map(|p| Point3D::new(single(p.x), single(p.y), single(p.z))).collect();
    if let Some(vertex) = vertices.iter().position(|p| !p.is_finite()) {
        return Err(format!("vertex {vertex} is beyond the 32-bit numbers of RSM"));
    }
    let rounded = mesh.clone().moved_to(vertices);
    let (rounded, _) =
        rounded.without_degenerate().map_err(|_| "no triangle has an area in 32-bit numbers")?;
    Ok(rounded)
}

fn signed(count: usize) -> Result<i32, String> {
    i32::try_from(count).map_err(|_| format!("{count} vertices, normals or triangles: RSM holds 2147483647"))
}

fn tree(mesh: &MeshData) -> Result<KdTree3D, MathError> {
    let image = mesh.bounding_box();
    let padding = PADDING * image.largest_extent();
    let item = |triangle: usize| {
        let mut image = raysect_core::BoundingBox3D::around(mesh.corners(triangle));
        image.pad(padding);
        KdItem::new(triangle as u32, image.lower.to_array(), image.upper.to_array())
    };
    let items = (0..mesh.triangle_count()).map(item).collect::<Result<Vec<_>, _>>()?;
    KdTree3D::with_settings(
        items,
        &KdTreeSettings { hit_cost: 5.0, empty_bonus: 0.25, ..KdTreeSettings::default() },
    )
}

#[cfg(test)]
#[path = "rsm_tests.rs"]
mod tests;
