use raysect_core::save::{SaveError, Saved, SceneWriter};

use super::Operand;
use super::composite::{Composite, Operation};
use crate::PrimitiveError;
use crate::inner::answers_by_inner;

/// What is in both of two bodies.
///
/// Bodies that only touch have nothing in common.
///
/// ```
/// use raysect_core::{Interval, Primitive, Ray, Scratch};
/// use raysect_math::{Point3D, Vector3D, translate};
/// use raysect_primitive::{Intersect, Place, Sphere};
///
/// let ball = Sphere::new(1.0)?;
/// let almond = Intersect::new(ball, ball.placed(translate(0.0, 0.0, 1.5)))?;
/// let ray = Ray::new(Point3D::new(0.0, 0.0, -2.0), Vector3D::Z);
/// assert_eq!(almond.hit(&ray, Interval::AHEAD, &mut Scratch::default()).unwrap().distance, 2.5);
/// assert!(almond.is_convex());
/// # Ok::<(), raysect_primitive::PrimitiveError>(())
/// ```
#[derive(Clone, Debug)]
pub struct Intersect(pub(super) Composite);

impl Intersect {
    /// Of two solid shapes, each where it is or [`placed`](super::Place::placed).
    ///
    /// # Errors
    /// [`PrimitiveError::OpenOperand`] for a shape that encloses nothing, [`PrimitiveError::OperandTransform`] for a
    /// transform without inverse.
    pub fn new(a: impl Into<Operand>, b: impl Into<Operand>) -> Result<Self, PrimitiveError> {
        Composite::new(Operation::Intersect, a.into(), b.into()).map(Self)
    }
}

impl Intersect {
    fn saved(&self, writer: &mut SceneWriter) -> Result<Saved, SaveError> {
        self.0.saved(Saved::new("Intersect"), writer)
    }
}

answers_by_inner!(Intersect, saved);
