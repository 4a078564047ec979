//! Points, vectors, transforms, random sampling and statistics of the raysect ray tracer.
#![doc = ""]

mod affine;
mod barycentric;
mod components;
mod error;
pub mod error_free;
mod frame;
pub mod function;
mod mesh_function;
mod normal;
mod orientation;
mod point;
mod polygon;
mod quadrature;
mod quaternion;
mod random;
mod roots;
pub mod sampling;
pub mod spatial;
mod stats;
mod transform;
mod triple;
pub mod units;
mod vector;

pub use affine::AffineMatrix3D;
pub use barycentric::{tetrahedron_shares, triangle_shares};
pub use error::MathError;
pub use frame::Frame;
pub use mesh_function::{Discrete2DMesh, Discrete3DMesh, Interpolator2DMesh};
pub use normal::Normal3D;
pub use point::{Point2D, Point3D};
pub use polygon::Polygon2D;
pub use quadrature::integrate;
pub use quaternion::Quaternion;
pub use random::{Rng, Stratum, StreamKey};
pub use roots::{Bracket, Roots, find_root, solve_cubic, solve_quadratic, solve_quartic};
pub use sampling::cone::{Cone, ConeCosineSampler, ConeUniformSampler};
pub use sampling::disk::DiskSampler3D;
pub use sampling::hemisphere::{HemisphereCosineSampler, HemisphereUniformSampler};
pub use sampling::sphere::SphereSampler;
pub use sampling::square::RectangleSampler3D;
pub use sampling::triangle::TriangleSampler3D;
pub use sampling::{
    SphericalDiskSampler, SphericalRectangleSampler, SphericalTriangleSampler, TargetSphere,
    TargetedHemisphereSampler, TargetedSphereSampler,
};
pub use stats::{BlockStatistics, Statistics, StatisticsArray, format_with_error};
pub use transform::{
    extract_rotation, extract_rotation_z_up, extract_translation, from_cylindrical, rotate, rotate_basis,
    rotate_vector, rotate_x, rotate_y, rotate_z, to_cylindrical, translate,
};
pub use vector::{Vector2D, Vector3D};
