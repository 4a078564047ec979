use std::ops::{Add, Div, Mul, Neg, Rem, Sub};

use super::operator as op;
use super::operator::{Binary, Unary};
use super::{Function, Of, Place};
use crate::{MathError, Vector3D};

/// A function with arithmetic.
///
/// Operators and methods build a larger expression out of this one and of anything that is a [`Function`] of the same
/// variables: numbers, vectors, closures, interpolators, other expressions. The parts are held by value and the
/// whole is one type, which the compiler sees through; nothing is allocated. What does not fit together (a vector
/// divided by a vector, variables that do not exist) is found when the whole is evaluated, by the compiler. An
/// expression may begin with a number or vector; other functions are made expressions by [`function`] first.
///
/// Domains are those of the operations on `f64`: see [`Function::evaluate`].
///
/// ```
/// use raysect_math::function::{Arg, Function, function1d};
/// let line = 1.0 / (1.0 + (Arg::X - 3.0).pow(2.0));
/// let f = 2.0 * line + function1d(|x| x.cos()) - |x: f64| x;
/// assert_eq!(f.evaluate(0.0), 0.2 + 1.0);
/// assert_eq!((Arg::X.abs().sqrt() % 2.0).evaluate(-9.0), 1.0);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Expression<T>(pub(super) T);

/// Any function as an [`Expression`]: a number, a vector, an interpolator, an `Arc` of a function.
///
/// The variables of a closure must be written with their type here; [`function1d`], [`function2d`] and
/// [`function3d`] know them.
pub fn function<T>(function: T) -> Expression<T> {
    Expression(function)
}

/// A closure of one variable as an [`Expression`].
#[doc(alias = "autowrap_function1d")]
pub fn function1d<V, F: Fn(f64) -> V>(function: F) -> Expression<F> {
    Expression(function)
}

/// A closure of two variables as an [`Expression`].
#[doc(alias = "autowrap_function2d")]
pub fn function2d<V, F: Fn(f64, f64) -> V>(function: F) -> Expression<F> {
    Expression(function)
}

/// A closure of three variables as an [`Expression`].
#[doc(alias = "autowrap_function3d")]
pub fn function3d<V, F: Fn(f64, f64, f64) -> V>(function: F) -> Expression<F> {
    Expression(function)
}

impl<P: Place, T: Function<P>> Function<P> for Expression<T> {
    type Value = T::Value;
    #[inline]
    fn evaluate(&self, at: P) -> T::Value {
        self.0.evaluate(at)
    }

    fn checked(&self, at: P) -> Result<T::Value, MathError> {
        self.0.checked(at)
    }
}

/// Operators with any function on the right, and with a number or vector on the left.
macro_rules! operators {
    ($($operator:ident $method:ident $node:ident;)*) => {$(
        impl<A, B> $operator<B> for Expression<A> {
            type Output = Expression<Binary<op::$node, A, B>>;
            fn $method(self, right: B) -> Self::Output {
                Expression(Binary { operator: op::$node, left: self.0, right })
            }
        }

        impl<B> $operator<Expression<B>> for f64 {
            type Output = Expression<Binary<op::$node, f64, B>>;
            fn $method(self, right: Expression<B>) -> Self::Output {
                Expression(Binary { operator: op::$node, left: self, right: right.0 })
            }
        }

        impl<B> $operator<Expression<B>> for Vector3D {
            type Output = Expression<Binary<op::$node, Vector3D, B>>;
            fn $method(self, right: Expression<B>) -> Self::Output {
                Expression(Binary { operator: op::$node, left: self, right: right.0 })
            }
        }
    )*};
}

operators! {
    Add add Plus;
    Sub sub Minus;
    Mul mul Times;
    Div div Over;
    Rem rem Remainder;
}

impl<A> Neg for Expression<A> {
    type Output = Expression<Unary<op::Negative, A>>;
    fn neg(self) -> Self::Output {
        Expression(Unary { operator: op::Negative, operand: self.0 })
    }
}

/// Methods that apply an operation to the value of the expression.
macro_rules! unary_methods {
    ($($text:literal $alias:literal $method:ident $node:ident;)*) => {
        impl<A> Expression<A> {$(
            #[doc = $text]
            #[doc(alias = $alias)]
            pub fn $method(self) -> Expression<Unary<op::$node, A>> {
                Expression(Unary { operator: op::$node, operand: self.0 })
            }
        )*}
    };
}

unary_methods! {
    "The absolute value." "Abs1D" abs Abs;
    "The square root; NaN of negative values." "Sqrt1D" sqrt Sqrt;
    "e to the power of the value." "Exp1D" exp Exp;
    "The natural logarithm; NaN of negative values, −∞ of 0." "log" ln Ln;
    "The sine of the value [rad]." "Sin1D" sin Sin;
    "The cosine of the value [rad]." "Cos1D" cos Cos;
    "The tangent of the value [rad]." "Tan1D" tan Tan;
    "The angle [rad] whose sine is the value; NaN outside −1 … 1." "Asin1D" asin Asin;
    "The angle [rad] whose cosine is the value; NaN outside −1 … 1." "Acos1D" acos Acos;
    "The angle [rad] whose tangent is the value." "Atan1D" atan Atan;
    "The error function 2/√π ∫ exp(−t²) dt, from 0 to the value." "Erf1D" erf Erf;
}

/// Methods that apply an operation to the values of the expression and of another function.
macro_rules! binary_methods {
    ($($text:literal $alias:literal $method:ident $node:ident;)*) => {
        impl<A> Expression<A> {$(
            #[doc = $text]
            #[doc(alias = $alias)]
            pub fn $method<B>(self, other: B) -> Expression<Binary<op::$node, A, B>> {
                Expression(Binary { operator: op::$node, left: self.0, right: other })
            }
        )*}
    };
}

binary_methods! {
    "To the power of the other; NaN for negative values where the exponent is no integer." "**" pow Power;
    "The angle [rad] of the point with the other as abscissa and this as ordinate." "Atan4Q1D" atan2 Atan2;
    "1 where it equals the other, else 0." "==" equal Equal;
    "1 where it differs from the other, else 0." "!=" not_equal NotEqual;
    "1 where it is less than the other, else 0." "<" less Less;
    "1 where it is less than the other or equal, else 0." "<=" less_equal LessEqual;
    "1 where it is greater than the other, else 0." ">" greater Greater;
    "1 where it is greater than the other or equal, else 0." ">=" greater_equal GreaterEqual;
}

impl<A> Expression<A> {
    /// This function of one variable at the value of another: a profile over a map of magnetic flux, say.
    #[doc(alias = "IsoMapper2D")]
    #[doc(alias = "IsoMapper3D")]
    pub fn of<B>(self, inner: B) -> Expression<Of<A, B>> {
        Expression(Of { outer: self.0, inner })
    }
}
