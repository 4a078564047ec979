//! Curves and surfaces through values on grids.

mod axis;
mod grid_axis;
mod hermite;
mod interpolator1d;
mod interpolator2d;
mod interpolator3d;
mod kind;
mod nodes;
mod slopes;
mod structure;
#[cfg(test)]
mod tests1d;
#[cfg(test)]
mod tests_grid;

pub(super) use axis::{check_knots, check_values};
pub use interpolator1d::Interpolator1DArray;
pub use interpolator2d::Interpolator2DArray;
pub use interpolator3d::Interpolator3DArray;
pub use kind::{Extrapolation, Extrapolation1D, Interpolation, Interpolation1D};
