use super::{Function, Place};

/// A function of one variable at the value of another function; made by [`Expression::of`](super::Expression::of).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Of<A, B> {
    pub(super) outer: A,
    pub(super) inner: B,
}

impl<P: Place, A: Function<f64>, B: Function<P, Value = f64>> Function<P> for Of<A, B> {
    type Value = A::Value;
    #[inline]
    fn evaluate(&self, at: P) -> A::Value {
        self.outer.evaluate(self.inner.evaluate(at))
    }
}
