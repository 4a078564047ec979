use raysect_core::SurfacePoint;
use raysect_math::{Frame, Normal3D, Vector3D};

/// A path at a surface.
#[derive(Debug, Clone, Copy)]
pub struct SurfaceHit {
    /// Where and on what, in world space.
    pub surface: SurfacePoint,
    /// Unit vector along which the path arrives (against the light).
    pub direction: Vector3D,
}

impl SurfaceHit {
    /// True if the path arrives at the inner side of the surface.
    #[inline]
    #[doc(alias = "exiting")]
    pub fn is_inside(&self) -> bool {
        self.surface.exiting
    }

    /// The shading normal on the side from which the path arrives.
    #[inline]
    pub fn normal(&self) -> Normal3D {
        if self.surface.exiting { -self.surface.shading_normal } else { self.surface.shading_normal }
    }

    /// The tangent frame of surface space: z is [`normal`](Self::normal).
    #[inline]
    pub fn frame(&self) -> Frame {
        Frame::from_z(self.normal().as_vector())
    }

    /// Cosine of the angle between the normal and the arriving path, 0 … 1.
    #[inline]
    pub fn cosine(&self) -> f64 {
        self.normal().dot(-self.direction).clamp(0.0, 1.0)
    }

    /// The direction of a perfect mirror, a unit vector.
    #[inline]
    pub fn mirrored(&self) -> Vector3D {
        let n = self.normal().as_vector();
        (self.direction - n * (2.0 * n.dot(self.direction))).normalise_unchecked()
    }

    /// True if a unit vector leads to the other side of the surface.
    #[inline]
    pub fn leads_through(&self, direction: Vector3D) -> bool {
        let outward = self.surface.normal.dot(direction) > 0.0;
        outward == self.surface.exiting
    }
}
