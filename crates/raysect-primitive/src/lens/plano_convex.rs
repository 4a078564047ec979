use super::body::{Body, Form};
use super::measures::one_curved_face;
use crate::PrimitiveError;
use crate::inner::answers_by_inner;

/// A lens with a convex front and a flat back.
///
/// The axis is z. The flat back lies at z = 0, the vertex of the front surface at the centre thickness.
/// Faces: see [`LensFace`](super::LensFace).
///
/// ```
/// use raysect_primitive::PlanoConvex;
/// // Half a ball: the edge is sharp.
/// let dome = PlanoConvex::new(2.0, 1.0, 1.0)?;
/// assert_eq!(dome.edge_thickness(), 0.0);
/// assert!((dome.volume() - 2.0 / 3.0 * std::f64::consts::PI).abs() < 1e-15);
/// # Ok::<(), raysect_primitive::PrimitiveError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PlanoConvex(Body, f64);

impl PlanoConvex {
    /// Of a diameter, the thickness on the axis and the radius of curvature of the curved surface, all
    /// in metres.
    ///
    /// # Errors
    /// [`PrimitiveError::Dimension`] for a length outside 1e-100 … 1e100 m or a radius of curvature below half the
    /// diameter, or if the surfaces meet inside of the barrel.
    pub fn new(diameter: f64, centre_thickness: f64, curvature: f64) -> Result<Self, PrimitiveError> {
        let body =
            Body::new("plano-convex lens", diameter, centre_thickness, Form::Convex(curvature), Form::Flat)?;
        Ok(Self(body, curvature))
    }
}

one_curved_face!(PlanoConvex);
answers_by_inner!(PlanoConvex, saved);
