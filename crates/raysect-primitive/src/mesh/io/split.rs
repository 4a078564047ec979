use std::collections::HashMap;

use raysect_math::{Normal3D, Point3D};

use super::super::MeshData;

/// A mesh whose vertices have one normal each, or none at all.
#[derive(Debug)]
pub(super) struct Split {
    pub(super) vertices: Vec<Point3D>,
    pub(super) normals: Vec<Normal3D>,
    pub(super) triangles: Vec<[u32; 3]>,
}

/// For formats in which normals belong to vertices: a vertex with several normals becomes several.
pub(super) fn split_by_normal(mesh: &MeshData) -> Result<Split, String> {
    let mut split = Split {
        vertices: mesh.vertices().to_vec(),
        normals: Vec::new(),
        triangles: mesh.triangles().to_vec(),
    };
    let (Some(normals), Some(indices)) = (mesh.vertex_normals(), mesh.normal_indices()) else {
        return Ok(split);
    };
    let mut normal_of: Vec<Option<u32>> = vec![None; mesh.vertex_count()];
    let mut twins = HashMap::new();
    for (vertex, &normal) in split.triangles.iter_mut().flatten().zip(indices.iter().flatten()) {
        let first = *normal_of[*vertex as usize].get_or_insert(normal);
        if first != normal {
            let next =
                u32::try_from(split.vertices.len()).map_err(|_| "the normals make too many vertices")?;
            let twin = *twins.entry((*vertex, normal)).or_insert(next);
            if twin == next {
                split.vertices.push(mesh.vertices()[*vertex as usize]);
                normal_of.push(Some(normal));
            }
            *vertex = twin;
        }
    }
    split.normals =
        normal_of.iter().map(|n| n.map_or_else(Normal3D::default, |n| normals[n as usize])).collect();
    Ok(split)
}
