use super::body::{Body, Form};
use super::measures::two_curved_faces;
use crate::PrimitiveError;
use crate::inner::answers_by_inner;

/// A lens with two convex surfaces.
///
/// The axis is z. The vertex of the back surface lies at z = 0, that of the front surface at the centre thickness.
/// Faces: see [`LensFace`](super::LensFace).
///
/// ```
/// use raysect_primitive::BiConvex;
/// let lens = BiConvex::new(0.0254, 0.01, 0.05, 0.08)?;
/// let sagittae = lens.front_thickness() + lens.back_thickness();
/// assert!((lens.edge_thickness() - (0.01 - sagittae)).abs() < 1e-15);
/// assert!(BiConvex::new(0.0254, 0.001, 0.05, 0.08).is_err());
/// # Ok::<(), raysect_primitive::PrimitiveError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BiConvex(Body, f64, f64);

impl BiConvex {
    /// Of a diameter, the thickness on the axis and the radii of curvature of the front and the back surface, all
    /// in metres.
    ///
    /// # Errors
    /// [`PrimitiveError::Dimension`] for a length outside 1e-100 … 1e100 m or a radius of curvature below half the
    /// diameter, or if the surfaces meet inside of the barrel.
    pub fn new(
        diameter: f64,
        centre_thickness: f64,
        front_curvature: f64,
        back_curvature: f64,
    ) -> Result<Self, PrimitiveError> {
        let body = Body::new(
            "biconvex lens",
            diameter,
            centre_thickness,
            Form::Convex(front_curvature),
            Form::Convex(back_curvature),
        )?;
        Ok(Self(body, front_curvature, back_curvature))
    }
}

two_curved_faces!(BiConvex);
answers_by_inner!(BiConvex, saved);
