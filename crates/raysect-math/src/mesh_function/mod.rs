//! Functions that are given on a mesh of triangles or tetrahedra.
//!
//! Edges belong to the elements on both sides, and a border is wide enough for the rounding of the coordinates of what
//! lies on it: no point on an edge is lost.

mod discrete2d;
mod discrete3d;
mod field;
mod interpolator2d;
#[cfg(test)]
mod sample_meshes;
mod tetrahedra;
mod triangles;

pub use discrete2d::Discrete2DMesh;
pub use discrete3d::Discrete3DMesh;
pub use interpolator2d::Interpolator2DMesh;
#[cfg(test)]
pub(crate) use sample_meshes::cubes;

use crate::spatial::KdTreeSettings;

/// Those of Raysect's meshes.
const SETTINGS: KdTreeSettings =
    KdTreeSettings { max_depth: 0, min_items: 1, hit_cost: 50.0, empty_bonus: 0.2 };

/// Coordinates beyond it are refused: products of three differences of smaller ones are finite.
const FARTHEST: f64 = 1e100;
