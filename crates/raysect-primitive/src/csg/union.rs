use raysect_core::save::{SaveError, Saved, SceneWriter};

use super::Operand;
use super::composite::{Composite, Operation};
use crate::PrimitiveError;
use crate::inner::answers_by_inner;

/// What is in one of two bodies or in both. Surfaces inside the other body vanish.
///
/// Bodies that touch in a face become one, without a gap.
///
/// ```
/// use raysect_core::{Primitive, Ray, Scratch};
/// use raysect_math::{Point3D, Vector3D, translate};
/// use raysect_primitive::{Cuboid, Place, Union};
///
/// let brick = Cuboid::centred(1.0, 1.0, 1.0)?;
/// let two = Union::new(brick, brick.placed(translate(0.0, 0.0, 1.0)))?;
/// let mut all = Vec::new();
/// let ray = Ray::new(Point3D::new(0.0, 0.0, -2.0), Vector3D::Z);
/// two.crossings(&ray, &mut Scratch::default(), &mut all);
/// assert_eq!(all.iter().map(|c| c.distance).collect::<Vec<_>>(), [1.5, 3.5]);
/// # Ok::<(), raysect_primitive::PrimitiveError>(())
/// ```
#[derive(Clone, Debug)]
pub struct Union(pub(super) Composite);

impl Union {
    /// Of two solid shapes, each where it is or [`placed`](super::Place::placed).
    ///
    /// # Errors
    /// [`PrimitiveError::OpenOperand`] for a shape that encloses nothing, [`PrimitiveError::OperandTransform`] for a
    /// transform without inverse.
    pub fn new(a: impl Into<Operand>, b: impl Into<Operand>) -> Result<Self, PrimitiveError> {
        Composite::new(Operation::Union, a.into(), b.into()).map(Self)
    }
}

impl Union {
    fn saved(&self, writer: &mut SceneWriter) -> Result<Saved, SaveError> {
        self.0.saved(Saved::new("Union"), writer)
    }
}

answers_by_inner!(Union, saved);
