//! The Cornell box against recorded frames of Raysect, and against itself in other formats.

#[path = "../../examples/common/comparison.rs"]
mod comparison;
#[path = "../../examples/common/cornell.rs"]
mod cornell;
#[path = "../../examples/common/reference.rs"]
mod reference;

mod controls;
mod formats;
mod frames;
mod spectra;
