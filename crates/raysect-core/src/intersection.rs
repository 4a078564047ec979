use raysect_math::{AffineMatrix3D, Normal3D, Point3D};

use crate::{NodeId, Ray, SurfacePoint};

/// Where a ray meets a shape: what [`World::hit`](crate::World::hit) answers.
#[derive(Debug, Clone, Copy)]
pub struct Intersection {
    /// The ray, in world space.
    pub ray: Ray,
    /// The node of the shape.
    #[doc(alias = "primitive")]
    pub node: NodeId,
    /// Point, normals, face and error bound, in world space.
    pub surface: SurfacePoint,
    /// From the world to the space of the shape.
    #[doc(alias = "world_to_primitive")]
    pub to_local: AffineMatrix3D,
    /// From the space of the shape to the world.
    #[doc(alias = "primitive_to_world")]
    pub to_world: AffineMatrix3D,
}

impl Intersection {
    /// Distance along the ray, in units of its direction's length.
    #[doc(alias = "ray_distance")]
    pub fn distance(&self) -> f64 {
        self.surface.distance
    }

    /// The point in world space [m]. (Raysect's `hit_point` is [`local_point`](Self::local_point).)
    pub fn point(&self) -> Point3D {
        self.surface.point
    }

    /// The point in the space of the shape [m].
    #[doc(alias = "hit_point")]
    pub fn local_point(&self) -> Point3D {
        self.surface.local_point
    }

    /// Outward unit normal of the geometry, in world space.
    pub fn normal(&self) -> Normal3D {
        self.surface.normal
    }

    /// True if the ray leaves the shape here.
    pub fn exiting(&self) -> bool {
        self.surface.exiting
    }

    /// The point moved off the surface to its inside, in world space [m]; see [`SurfacePoint::launch_point`].
    pub fn inside_point(&self) -> Point3D {
        self.surface.launch_point(false)
    }

    /// The point moved off the surface to its outside, in world space [m]; see [`SurfacePoint::launch_point`].
    pub fn outside_point(&self) -> Point3D {
        self.surface.launch_point(true)
    }
}
