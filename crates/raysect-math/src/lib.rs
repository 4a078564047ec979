//! Points, vectors, transforms, random sampling and statistics of the raysect ray tracer.
#![doc = ""]

mod affine;
mod error;
mod normal;
mod point;
mod random;
mod transform;
mod triple;
pub mod units;
mod vector;

pub use affine::AffineMatrix3D;
pub use error::MathError;
pub use normal::Normal3D;
pub use point::{Point2D, Point3D};
pub use random::{Rng, StreamKey};
pub use transform::{
    extract_rotation, extract_rotation_z_up, extract_translation, from_cylindrical, rotate, rotate_basis,
    rotate_vector, rotate_x, rotate_y, rotate_z, to_cylindrical, translate,
};
pub use vector::{Vector2D, Vector3D};
