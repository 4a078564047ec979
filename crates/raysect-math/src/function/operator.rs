//! The operations of expressions, each a type without size, and the two nodes that apply them.

use std::ops::{Add, Div, Mul, Neg, Rem, Sub};

use super::{Function, Place, Value};

/// An operation on one value.
pub trait UnaryOperator<X>: Send + Sync {
    /// What comes out.
    type Output: Value;
    /// The result for one value.
    fn apply(x: X) -> Self::Output;
}

/// An operation on two values.
pub trait BinaryOperator<X, Y>: Send + Sync {
    /// What comes out.
    type Output: Value;
    /// The result for two values.
    fn apply(x: X, y: Y) -> Self::Output;
}

/// An operation applied to the value of a function.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Unary<O, A> {
    pub(super) operator: O,
    pub(super) operand: A,
}

impl<P: Place, O: UnaryOperator<A::Value>, A: Function<P>> Function<P> for Unary<O, A> {
    type Value = O::Output;
    #[inline]
    fn evaluate(&self, at: P) -> O::Output {
        O::apply(self.operand.evaluate(at))
    }
}

/// An operation applied to the values of two functions.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Binary<O, A, B> {
    pub(super) operator: O,
    pub(super) left: A,
    pub(super) right: B,
}

impl<P, O, A, B> Function<P> for Binary<O, A, B>
where
    P: Place,
    A: Function<P>,
    B: Function<P>,
    O: BinaryOperator<A::Value, B::Value>,
{
    type Value = O::Output;
    #[inline]
    fn evaluate(&self, at: P) -> O::Output {
        O::apply(self.left.evaluate(at), self.right.evaluate(at))
    }
}

/// Operators of the language, for numbers and vectors alike: documentation, name, trait and its method.
macro_rules! arithmetic {
    ($($text:literal $name:ident: $operator:ident $method:ident;)*) => {$(
        #[doc = $text]
        #[derive(Debug, Clone, Copy, PartialEq)]
        pub struct $name;
        impl<X: $operator<Y>, Y> BinaryOperator<X, Y> for $name
        where
            X::Output: Value,
        {
            type Output = X::Output;
            #[inline]
            fn apply(x: X, y: Y) -> X::Output {
                x.$method(y)
            }
        }
    )*};
}

/// Operations on one number.
macro_rules! of_one_number {
    ($($text:literal $name:ident: $apply:expr;)*) => {$(
        #[doc = $text]
        #[derive(Debug, Clone, Copy, PartialEq)]
        pub struct $name;
        impl UnaryOperator<f64> for $name {
            type Output = f64;
            #[inline]
            fn apply(x: f64) -> f64 {
                ($apply)(x)
            }
        }
    )*};
}

/// Operations on two numbers.
macro_rules! of_two_numbers {
    ($($text:literal $name:ident: $apply:expr;)*) => {$(
        #[doc = $text]
        #[derive(Debug, Clone, Copy, PartialEq)]
        pub struct $name;
        impl BinaryOperator<f64, f64> for $name {
            type Output = f64;
            #[inline]
            fn apply(x: f64, y: f64) -> f64 {
                ($apply)(x, y)
            }
        }
    )*};
}

/// Comparisons that yield 1 if they hold and 0 if not.
macro_rules! comparison {
    ($($text:literal $name:ident: $bound:ident $method:ident;)*) => {$(
        #[doc = $text]
        #[derive(Debug, Clone, Copy, PartialEq)]
        pub struct $name;
        impl<X: $bound> BinaryOperator<X, X> for $name {
            type Output = f64;
            #[inline]
            fn apply(x: X, y: X) -> f64 {
                f64::from(x.$method(&y))
            }
        }
    )*};
}

arithmetic! {
    "a + b" Plus: Add add;
    "a − b" Minus: Sub sub;
    "a b" Times: Mul mul;
    "a / b" Over: Div div;
    "The remainder of a / b with the sign of a" Remainder: Rem rem;
}

of_one_number! {
    "The absolute value" Abs: f64::abs;
    "The square root; NaN of a negative number" Sqrt: f64::sqrt;
    "e to the power" Exp: f64::exp;
    "The natural logarithm; NaN of a negative number, −∞ of 0" Ln: f64::ln;
    "The sine of an angle [rad]" Sin: f64::sin;
    "The cosine of an angle [rad]" Cos: f64::cos;
    "The tangent of an angle [rad]" Tan: f64::tan;
    "The angle of a sine [rad]; NaN outside −1 … 1" Asin: f64::asin;
    "The angle of a cosine [rad]; NaN outside −1 … 1" Acos: f64::acos;
    "The angle of a tangent [rad], in −π/2 … π/2" Atan: f64::atan;
    "The error function 2/√π ∫ exp(−t²) dt from 0" Erf: libm::erf;
}

of_two_numbers! {
    "a to the power b; NaN for a negative a with a b that is no integer" Power: f64::powf;
    "The angle of the point (b, a) [rad], in −π … π" Atan2: f64::atan2;
}

comparison! {
    "1 where a = b, else 0" Equal: PartialEq eq;
    "1 where a ≠ b, else 0" NotEqual: PartialEq ne;
    "1 where a < b, else 0" Less: PartialOrd lt;
    "1 where a ≤ b, else 0" LessEqual: PartialOrd le;
    "1 where a > b, else 0" Greater: PartialOrd gt;
    "1 where a ≥ b, else 0" GreaterEqual: PartialOrd ge;
}

/// −a
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Negative;

impl<X: Neg> UnaryOperator<X> for Negative
where
    X::Output: Value,
{
    type Output = X::Output;
    #[inline]
    fn apply(x: X) -> X::Output {
        -x
    }
}
