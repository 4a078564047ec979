//! Functions of one, two and three variables.

mod arg;
mod blend;
mod components;
mod contract;
mod expression;
mod interpolate;
mod of;
pub mod operator;
mod place;
mod sample;
#[cfg(test)]
mod tests;
mod value;

pub use arg::Arg;
pub use blend::{Blend, blend};
pub use components::{Components, components};
pub use contract::{
    Function, Function1D, Function2D, Function3D, VectorFunction1D, VectorFunction2D, VectorFunction3D,
};
pub use expression::{Expression, function, function1d, function2d, function3d};
pub use interpolate::{
    Extrapolation, Extrapolation1D, Interpolation, Interpolation1D, Interpolator1DArray, Interpolator2DArray,
    Interpolator3DArray,
};
pub use of::Of;
pub use place::Place;
pub use sample::{GridAxis, GridSamples, sample_path, sample_points, sample1d, sample2d, sample3d};
pub use value::Value;
