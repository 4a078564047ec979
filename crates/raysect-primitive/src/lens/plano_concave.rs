use super::body::{Body, Form};
use super::measures::one_curved_face;
use crate::PrimitiveError;
use crate::inner::answers_by_inner;

/// A lens with a concave front and a flat back.
///
/// The axis is z. The flat back lies at z = 0, the vertex of the front surface at the centre thickness.
/// Faces: see [`LensFace`](super::LensFace).
///
/// ```
/// use raysect_primitive::PlanoConcave;
/// let lens = PlanoConcave::new(0.0254, 0.002, 0.05)?;
/// assert_eq!(lens.edge_thickness(), 0.002 + lens.curve_thickness());
/// # Ok::<(), raysect_primitive::PrimitiveError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PlanoConcave(Body, f64);

impl PlanoConcave {
    /// Of a diameter, the thickness on the axis and the radius of curvature of the curved surface, all
    /// in metres.
    ///
    /// # Errors
    /// [`PrimitiveError::Dimension`] for a length outside 1e-100 … 1e100 m or a radius of curvature below half the
    /// diameter.
    pub fn new(diameter: f64, centre_thickness: f64, curvature: f64) -> Result<Self, PrimitiveError> {
        let body = Body::new(
            "plano-concave lens",
            diameter,
            centre_thickness,
            Form::Concave(curvature),
            Form::Flat,
        )?;
        Ok(Self(body, curvature))
    }
}

one_curved_face!(PlanoConcave);
answers_by_inner!(PlanoConcave, saved);
