use raysect_core::Feature;

/// The surfaces of a lens. `Feature::face` of a crossing is the number of one of them.
///
/// ```
/// use raysect_core::{Interval, Primitive, Ray, Scratch};
/// use raysect_math::{Point3D, Vector3D};
/// use raysect_primitive::{LensFace, PlanoConvex};
///
/// let lens = PlanoConvex::new(0.025, 0.004, 0.05)?;
/// let ray = Ray::new(Point3D::new(0.001, 0.0, 1.0), -Vector3D::Z);
/// let hit = lens.hit(&ray, Interval::AHEAD, &mut Scratch::default()).unwrap();
/// assert_eq!(LensFace::of(&hit.feature), Some(LensFace::Front));
/// # Ok::<(), raysect_primitive::PrimitiveError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[repr(u32)]
pub enum LensFace {
    /// The surface of greatest z.
    Front = 0,
    /// The surface through the origin.
    Back = 1,
    /// The cylinder about the axis.
    Barrel = 2,
}

impl LensFace {
    /// The surface of a lens that a crossing names; none if it is not of a lens.
    pub fn of(feature: &Feature) -> Option<Self> {
        [Self::Front, Self::Back, Self::Barrel].into_iter().find(|face| *face as u32 == feature.face)
    }
}
