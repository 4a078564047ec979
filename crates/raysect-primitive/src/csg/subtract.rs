use raysect_core::save::{SaveError, Saved, SceneWriter};

use super::Operand;
use super::composite::{Composite, Operation};
use crate::PrimitiveError;
use crate::inner::answers_by_inner;

/// The first of two bodies without the second.
///
/// A face that both have in common leaves no skin. The surface of the second body counts as outside.
///
/// ```
/// use raysect_math::{Point3D, translate};
/// use raysect_core::Primitive;
/// use raysect_primitive::{Cuboid, Place, Sphere, Subtract};
///
/// let dented = Subtract::new(
///     Cuboid::centred(2.0, 2.0, 2.0)?,
///     Sphere::new(0.5)?.placed(translate(0.0, 0.0, 1.0)),
/// )?;
/// assert!(dented.contains(Point3D::ORIGIN));
/// assert!(!dented.contains(Point3D::new(0.0, 0.0, 0.8)));
/// # Ok::<(), raysect_primitive::PrimitiveError>(())
/// ```
#[derive(Clone, Debug)]
pub struct Subtract(pub(super) Composite);

impl Subtract {
    /// Of two solid shapes, each where it is or [`placed`](super::Place::placed): `a` without `b`.
    ///
    /// # Errors
    /// [`PrimitiveError::OpenOperand`] for a shape that encloses nothing, [`PrimitiveError::OperandTransform`] for a
    /// transform without inverse.
    pub fn new(a: impl Into<Operand>, b: impl Into<Operand>) -> Result<Self, PrimitiveError> {
        Composite::new(Operation::Subtract, a.into(), b.into()).map(Self)
    }
}

impl Subtract {
    fn saved(&self, writer: &mut SceneWriter) -> Result<Saved, SaveError> {
        self.0.saved(Saved::new("Subtract"), writer)
    }
}

answers_by_inner!(Subtract, saved);
