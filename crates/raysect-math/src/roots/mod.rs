//! Real roots of polynomials up to the fourth degree, and of functions.

#[cfg(test)]
mod adversarial_tests;
mod bracket;
mod find;
mod polynomial;
mod quadratic;
mod scaling;
#[cfg(test)]
mod tests;

use std::ops::Deref;

pub use bracket::Bracket;
pub use find::find_root;
pub use polynomial::{solve_cubic, solve_quartic};
pub use quadratic::solve_quadratic;

/// Up to `N` real roots in ascending order; it reads like a slice.
///
/// ```
/// let roots = raysect_math::solve_quadratic(1.0, -3.0, 2.0);
/// assert_eq!(roots[..], [1.0, 2.0]);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Roots<const N: usize> {
    values: [f64; N],
    count: usize,
}

impl<const N: usize> Default for Roots<N> {
    /// None.
    fn default() -> Self {
        Self { values: [0.0; N], count: 0 }
    }
}

impl<const N: usize> Roots<N> {
    /// Puts a root in its place, unless it is infinite.
    #[inline]
    fn insert(&mut self, root: f64) {
        if !root.is_finite() || self.count == N {
            return;
        }
        let place = self.iter().take_while(|&&r| r <= root).count();
        self.values.copy_within(place..self.count, place + 1);
        self.values[place] = root;
        self.count += 1;
    }

    /// The same roots where there is room for as many or more.
    fn widen<const M: usize>(&self) -> Roots<M> {
        let mut wide = Roots::default();
        self.iter().for_each(|&r| wide.insert(r));
        wide
    }

    /// These roots and 0.
    fn with_zero<const M: usize>(&self) -> Roots<M> {
        let mut wide = self.widen();
        wide.insert(0.0);
        wide
    }
}

impl<const N: usize> Deref for Roots<N> {
    type Target = [f64];

    #[inline]
    fn deref(&self) -> &[f64] {
        &self.values[..self.count]
    }
}
