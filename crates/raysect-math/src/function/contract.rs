use std::sync::Arc;

use super::{Place, Value};
use crate::{MathError, Vector3D};

/// A function of one, two or three variables, the coordinates of a [`Place`], that yields a number or a vector.
///
/// Closures and `fn`s of one to three `f64` are functions, a number or vector is a constant one, and an
/// [`Arc`] of a function, also of `dyn Function1D` and its like, is that function. A table that is only borrowed goes
/// into a closure: `|x: f64| table.evaluate(x)`. What may be missing is a value: see [`evaluate`](Self::evaluate).
///
/// ```
/// use raysect_math::function::Function;
/// struct Step;
/// impl Function<f64> for Step {
///     type Value = f64;
///     fn evaluate(&self, x: f64) -> f64 {
///         if x < 0.0 { 0.0 } else { 1.0 }
///     }
/// }
/// assert_eq!((Step.evaluate(3.0), f64::sqrt.evaluate(9.0), 2.5.evaluate((0.0, 1.0))), (1.0, 3.0, 2.5));
/// assert!(f64::sqrt.evaluate(-1.0).is_nan());
/// assert_eq!(f64::sqrt.checked(-1.0).unwrap_err().to_string(), "f(-1) = NaN is not finite");
/// ```
#[doc(alias = "PythonFunction1D")]
#[doc(alias = "PythonFunction2D")]
#[doc(alias = "PythonFunction3D")]
#[doc(alias = "Constant1D")]
#[doc(alias = "Constant2D")]
#[doc(alias = "Constant3D")]
#[doc(alias = "autowrap")]
pub trait Function<P: Place>: Send + Sync {
    /// What the function yields.
    type Value: Value;

    /// The value at a place.
    ///
    /// By the rules of IEEE 754: outside the domain of the function the value is NaN, at a pole infinite, and both
    /// spread to what is computed from them. No function panics.
    fn evaluate(&self, at: P) -> Self::Value;

    /// The value at a place where the function must have one.
    ///
    /// # Errors
    /// [`MathError::Undefined`] for a value that is infinite or NaN; interpolators answer
    /// [`MathError::OutsideGrid`] beyond their range.
    fn checked(&self, at: P) -> Result<Self::Value, MathError> {
        finite(at, self.evaluate(at))
    }
}

/// The value at a place, or the error that there is none.
pub(super) fn finite<P: Place, V: Value>(at: P, value: V) -> Result<V, MathError> {
    if value.is_finite() {
        return Ok(value);
    }
    Err(MathError::Undefined { at: at.coordinates(), value: value.components() })
}

impl<F, V> Function<f64> for F
where
    F: Fn(f64) -> V + Send + Sync,
    V: Value,
{
    type Value = V;
    #[inline]
    fn evaluate(&self, x: f64) -> V {
        self(x)
    }
}

impl<F, V> Function<(f64, f64)> for F
where
    F: Fn(f64, f64) -> V + Send + Sync,
    V: Value,
{
    type Value = V;
    #[inline]
    fn evaluate(&self, (x, y): (f64, f64)) -> V {
        self(x, y)
    }
}

impl<F, V> Function<(f64, f64, f64)> for F
where
    F: Fn(f64, f64, f64) -> V + Send + Sync,
    V: Value,
{
    type Value = V;
    #[inline]
    fn evaluate(&self, (x, y, z): (f64, f64, f64)) -> V {
        self(x, y, z)
    }
}

impl<P: Place> Function<P> for f64 {
    type Value = f64;
    #[inline]
    fn evaluate(&self, _: P) -> f64 {
        *self
    }
}

impl<P: Place> Function<P> for Vector3D {
    type Value = Vector3D;
    #[inline]
    fn evaluate(&self, _: P) -> Vector3D {
        *self
    }
}

impl<P: Place, T: Function<P> + ?Sized> Function<P> for Arc<T> {
    type Value = T::Value;
    #[inline]
    fn evaluate(&self, at: P) -> T::Value {
        (**self).evaluate(at)
    }

    fn checked(&self, at: P) -> Result<T::Value, MathError> {
        (**self).checked(at)
    }
}

/// Names the functions of certain variables and values, as bounds and for `Arc<dyn …>`.
macro_rules! named {
    ($($(#[$text:meta])* $name:ident: $place:ty => $value:ty;)*) => {$(
        $(#[$text])*
        pub trait $name: Function<$place, Value = $value> {}
        impl<T: Function<$place, Value = $value> + ?Sized> $name for T {}
    )*};
}

named! {
    /// A number for each x; every such [`Function`] is one.
    Function1D: f64 => f64;
    /// A number for each (x, y); every such [`Function`] is one.
    Function2D: (f64, f64) => f64;
    /// A number for each (x, y, z); every such [`Function`] is one.
    Function3D: (f64, f64, f64) => f64;
    /// A vector for each x; every such [`Function`] is one.
    VectorFunction1D: f64 => Vector3D;
    /// A vector for each (x, y); every such [`Function`] is one.
    VectorFunction2D: (f64, f64) => Vector3D;
    /// A vector for each (x, y, z); every such [`Function`] is one.
    VectorFunction3D: (f64, f64, f64) => Vector3D;
}
