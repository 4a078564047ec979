use super::{Expression, Function, Place, Value};

/// A passage from one function to another; made by [`blend`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Blend<A, B, M> {
    first: A,
    second: B,
    mask: M,
}

/// The first function where the mask is 0 or less, the second where it is 1 or more, between them a mixture.
///
/// Numbers are mixed linearly, `(1 − mask) first + mask second`; vectors are turned by
/// [`Vector3D::slerp`](crate::Vector3D::slerp), or mixed linearly if one of them is the null vector. Where one
/// function does not count, it is not evaluated.
///
/// ```
/// use raysect_math::function::{Arg, Function, blend};
/// let f = blend(|x: f64| x.sqrt(), 7.0, -1.0 * Arg::X);
/// assert_eq!((f.evaluate(4.0), f.evaluate(-4.0)), (2.0, 7.0));
/// ```
#[doc(alias = "Blend1D")]
#[doc(alias = "Blend2D")]
#[doc(alias = "Blend3D")]
pub fn blend<A, B, M>(first: A, second: B, mask: M) -> Expression<Blend<A, B, M>> {
    Expression(Blend { first, second, mask })
}

impl<P, A, B, M> Function<P> for Blend<A, B, M>
where
    P: Place,
    A: Function<P>,
    B: Function<P, Value = A::Value>,
    M: Function<P, Value = f64>,
{
    type Value = A::Value;
    fn evaluate(&self, at: P) -> A::Value {
        let t = self.mask.evaluate(at);
        if t <= 0.0 {
            self.first.evaluate(at)
        } else if t >= 1.0 {
            self.second.evaluate(at)
        } else {
            self.first.evaluate(at).blend(self.second.evaluate(at), t)
        }
    }
}
