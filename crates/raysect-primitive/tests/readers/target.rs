//! What every reader must hold to for any bytes; the fuzz targets call it too.

use raysect_primitive::MeshData;
use raysect_primitive::mesh::io::MeshFormat;

/// Reads bytes, and tests the mesh if there is one: nothing panics, nothing grows beyond what was given.
pub(crate) fn read_anything(format: MeshFormat, bytes: &[u8]) -> bool {
    let Ok(mesh) = MeshData::from_bytes(bytes, format, 1.0) else { return false };
    assert!(mesh.triangle_count() <= bytes.len() && mesh.vertex_count() <= bytes.len());
    assert!(mesh.vertices().iter().all(|p| p.is_finite()));
    let count = mesh.vertex_count() as u32;
    assert!(mesh.triangles().iter().flatten().all(|&v| v < count));
    if let (Some(normals), Some(indices)) = (mesh.vertex_normals(), mesh.normal_indices()) {
        assert!(normals.iter().all(|n| (n.length() - 1.0).abs() < 1e-15));
        assert!(indices.iter().flatten().all(|&n| (n as usize) < normals.len()));
        assert_eq!(indices.len(), mesh.triangle_count());
    }
    let health = mesh.health();
    assert!(health.to_string().contains("watertight"));
    assert_eq!(mesh.weld().triangle_count(), health.triangles);
    true
}
