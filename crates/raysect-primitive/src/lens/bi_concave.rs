use super::body::{Body, Form};
use super::measures::two_curved_faces;
use crate::PrimitiveError;
use crate::inner::answers_by_inner;

/// A lens with two concave surfaces.
///
/// The axis is z. The vertex of the back surface lies at z = 0, that of the front surface at the centre thickness.
/// Faces: see [`LensFace`](super::LensFace).
///
/// ```
/// use raysect_core::Primitive;
/// use raysect_math::Point3D;
/// use raysect_primitive::BiConcave;
/// let lens = BiConcave::new(0.0254, 0.002, 0.05, 0.08)?;
/// assert!(lens.edge_thickness() > lens.centre_thickness());
/// assert!(lens.contains(Point3D::new(0.0126, 0.0, -0.0005)));
/// # Ok::<(), raysect_primitive::PrimitiveError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BiConcave(Body, f64, f64);

impl BiConcave {
    /// Of a diameter, the thickness on the axis and the radii of curvature of the front and the back surface, all
    /// in metres.
    ///
    /// # Errors
    /// [`PrimitiveError::Dimension`] for a length outside 1e-100 … 1e100 m or a radius of curvature below half the
    /// diameter.
    pub fn new(
        diameter: f64,
        centre_thickness: f64,
        front_curvature: f64,
        back_curvature: f64,
    ) -> Result<Self, PrimitiveError> {
        let body = Body::new(
            "biconcave lens",
            diameter,
            centre_thickness,
            Form::Concave(front_curvature),
            Form::Concave(back_curvature),
        )?;
        Ok(Self(body, front_curvature, back_curvature))
    }
}

two_curved_faces!(BiConcave);
answers_by_inner!(BiConcave, saved);
