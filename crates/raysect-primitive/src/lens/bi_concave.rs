use raysect_core::save::{SaveError, Saved, SceneWriter};

use super::body::{Body, Form};
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

    /// Radius of curvature of the front surface [m].
    pub fn front_curvature(&self) -> f64 {
        self.1
    }

    /// Depth of the cap of the front surface, its sagitta [m].
    pub fn front_thickness(&self) -> f64 {
        self.0.front_sag()
    }

    /// Radius of curvature of the back surface [m].
    pub fn back_curvature(&self) -> f64 {
        self.2
    }

    /// Depth of the cap of the back surface, its sagitta [m].
    pub fn back_thickness(&self) -> f64 {
        self.0.back_sag()
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

impl BiConcave {
    fn saved(&self, _: &mut SceneWriter) -> Result<Saved, SaveError> {
        Ok(Saved::new("BiConcave")
            .number("diameter", self.diameter())
            .number("centre_thickness", self.centre_thickness())
            .number("front_curvature", self.front_curvature())
            .number("back_curvature", self.back_curvature()))
    }
}

answers_by_inner!(BiConcave, saved);
