use raysect_core::save::{SaveError, Saved, SceneWriter};

use super::body::{Body, Form};
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

    /// The diameter [m].
    pub fn diameter(&self) -> f64 {
        self.0.diameter
    }

    /// Thickness on the axis [m].
    #[doc(alias = "center_thickness")]
    pub fn centre_thickness(&self) -> f64 {
        self.0.centre_thickness
    }

    /// Thickness at the edge: length of the barrel [m].
    pub fn edge_thickness(&self) -> f64 {
        self.0.edge_thickness
    }

    /// Radius of curvature of the curved surface [m].
    pub fn curvature(&self) -> f64 {
        self.1
    }

    /// Depth of the cap of the curved surface, its sagitta [m].
    pub fn curve_thickness(&self) -> f64 {
        self.0.front_sag()
    }

    /// Volume [m³].
    pub fn volume(&self) -> f64 {
        self.0.volume()
    }

    /// Area of both surfaces and the barrel [m²].
    pub fn surface_area(&self) -> f64 {
        self.0.surface_area()
    }
}

impl PlanoConvex {
    fn saved(&self, _: &mut SceneWriter) -> Result<Saved, SaveError> {
        Ok(Saved::new("PlanoConvex")
            .number("diameter", self.diameter())
            .number("centre_thickness", self.centre_thickness())
            .number("curvature", self.curvature()))
    }
}

answers_by_inner!(PlanoConvex, saved);
