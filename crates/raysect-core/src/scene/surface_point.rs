use raysect_math::{Normal3D, Point3D};

use crate::{Crossing, Feature};

/// What a ray has hit, before anything is computed about it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Candidate {
    /// Number of the instance in the scene.
    pub instance: u32,
    /// Where.
    pub crossing: Crossing,
}

/// The surface at a hit, in world space.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SurfacePoint {
    /// Number of the instance in the scene.
    pub instance: u32,
    /// The point [m].
    pub point: Point3D,
    /// The point in the local space of the shape [m].
    pub local_point: Point3D,
    /// Outward unit normal of the geometry.
    pub normal: Normal3D,
    /// Outward unit normal to shade with.
    pub shading_normal: Normal3D,
    /// Bound on the error of `point` [m].
    pub bound: f64,
    /// Distance along the ray, in units of its direction's length.
    pub distance: f64,
    /// True if the ray leaves the shape here.
    pub exiting: bool,
    /// Which piece of the surface.
    pub feature: Feature,
}

impl SurfacePoint {
    /// The point moved off the surface by twice its error bound, outward or inward, for code that starts a ray of
    /// its own without saying where it comes from.
    #[doc(alias("inside_point", "outside_point"))]
    pub fn launch_point(&self, outward: bool) -> Point3D {
        let step = self.normal.as_vector() * (2.0 * self.bound);
        if outward { self.point + step } else { self.point - step }
    }
}
