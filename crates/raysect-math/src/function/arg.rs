use super::{Expression, Function};

/// The variables themselves, the beginnings of expressions.
///
/// [`Arg::X`] is a function of one, two or three variables, [`Arg::Y`] of two or three, [`Arg::Z`] of three; a variable
/// that does not exist does not compile.
///
/// ```
/// use raysect_math::function::{Arg, Function};
/// let radius = (Arg::X * Arg::X + Arg::Y * Arg::Y).sqrt();
/// assert_eq!((radius.evaluate((3.0, 4.0)), radius.evaluate((3.0, 4.0, 7.0))), (5.0, 5.0));
/// ```
#[doc(alias = "Arg1D")]
#[doc(alias = "Arg2D")]
#[doc(alias = "Arg3D")]
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Arg<const INDEX: usize>;

impl Arg<0> {
    /// The first variable.
    pub const X: Expression<Arg<0>> = Expression(Arg);
    /// The second variable.
    pub const Y: Expression<Arg<1>> = Expression(Arg);
    /// The third variable.
    pub const Z: Expression<Arg<2>> = Expression(Arg);
}

impl Function<f64> for Arg<0> {
    type Value = f64;
    #[inline]
    fn evaluate(&self, x: f64) -> f64 {
        x
    }
}

impl Function<(f64, f64)> for Arg<0> {
    type Value = f64;
    #[inline]
    fn evaluate(&self, at: (f64, f64)) -> f64 {
        at.0
    }
}

impl Function<(f64, f64)> for Arg<1> {
    type Value = f64;
    #[inline]
    fn evaluate(&self, at: (f64, f64)) -> f64 {
        at.1
    }
}

impl Function<(f64, f64, f64)> for Arg<0> {
    type Value = f64;
    #[inline]
    fn evaluate(&self, at: (f64, f64, f64)) -> f64 {
        at.0
    }
}

impl Function<(f64, f64, f64)> for Arg<1> {
    type Value = f64;
    #[inline]
    fn evaluate(&self, at: (f64, f64, f64)) -> f64 {
        at.1
    }
}

impl Function<(f64, f64, f64)> for Arg<2> {
    type Value = f64;
    #[inline]
    fn evaluate(&self, at: (f64, f64, f64)) -> f64 {
        at.2
    }
}
