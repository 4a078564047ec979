//! Sensors of one pixel, and of the triangles of a mesh.

mod counting;
mod fibre_optic;
mod mesh_camera;
mod mesh_pixel;
mod mesh_surface;
mod pixel;
mod sight_line;

pub(crate) use counting::{Counting, counting_setting};
pub use fibre_optic::{Fibre, FibreOptic};
pub use mesh_camera::{MeshCamera, MeshPatches};
pub use mesh_pixel::{MeshPixel, MeshWhole};
pub use pixel::{Pixel, Rectangle, TargetedPixel};
pub use sight_line::{Line, SightLine};

/// ∫ cos θ dΩ over a circular cone of a half angle up to 90° [deg]: π sin² θ [sr].
pub(crate) fn etendue_of_cone(half_angle: f64) -> f64 {
    let sin = half_angle.to_radians().sin();
    std::f64::consts::PI * sin * sin
}
