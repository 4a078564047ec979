use raysect::optical::Facts;
use raysect::prelude::*;

/// An absorbing surface that tells where a ray comes from and goes to: what it emits against a ray is a number made of
/// the point of arrival [m] and the direction, in world space.
pub(super) struct Beacon<F>(pub(super) F);

impl<F: Fn(Point3D, Vector3D) -> f64 + Send + Sync + 'static> Material for Beacon<F> {
    fn emit(&self, hit: &SurfaceHit, _: Context<'_>, out: &mut [f64]) -> bool {
        out.fill((self.0)(hit.surface.point, hit.direction));
        true
    }
    fn surface(&self, _: &SurfaceHit, _: &mut Path<'_>) -> Scatter {
        Scatter::Absorbed
    }
    fn facts(&self) -> Facts {
        Facts::emitter("beacon")
    }
}

/// The angle between two directions [deg], however small.
pub(super) fn angle(a: Vector3D, b: Vector3D) -> f64 {
    a.cross(b).length().atan2(a.dot(b)).to_degrees()
}
