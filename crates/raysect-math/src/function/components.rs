use super::{Expression, Function, Place};
use crate::Vector3D;

/// A vector out of three functions; made by [`components`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Components<X, Y, Z> {
    x: X,
    y: Y,
    z: Z,
}

/// The function whose vectors have the values of three functions as components.
///
/// ```
/// use raysect_math::Vector3D;
/// use raysect_math::function::{Arg, Function, components};
/// let field = components(-Arg::Y, Arg::X, 0.5) / 2.0;
/// assert_eq!(field.evaluate((3.0, 4.0)), Vector3D::new(-2.0, 1.5, 0.25));
/// ```
#[doc(alias = "FloatToVector3DFunction1D")]
#[doc(alias = "FloatToVector3DFunction2D")]
#[doc(alias = "FloatToVector3DFunction3D")]
pub fn components<X, Y, Z>(x: X, y: Y, z: Z) -> Expression<Components<X, Y, Z>> {
    Expression(Components { x, y, z })
}

impl<P, X, Y, Z> Function<P> for Components<X, Y, Z>
where
    P: Place,
    X: Function<P, Value = f64>,
    Y: Function<P, Value = f64>,
    Z: Function<P, Value = f64>,
{
    type Value = Vector3D;
    #[inline]
    fn evaluate(&self, at: P) -> Vector3D {
        Vector3D::new(self.x.evaluate(at), self.y.evaluate(at), self.z.evaluate(at))
    }
}
