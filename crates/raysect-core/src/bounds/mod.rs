//! Boxes and spheres that enclose things.

mod box2d;
mod box3d;
mod sphere;

pub use box2d::BoundingBox2D;
pub use box3d::BoundingBox3D;
pub use sphere::BoundingSphere3D;
