//! The Cornell box against recorded frames of Raysect, and against itself in other formats.
//!
//! `tests/data/cornell_glass.npz` and `cornell_diffuse.npz` were rendered with Raysect 0.9.1: 24×24 pixels, 15 bins over
//! 375 to 740 nm, a field of view of 45 degrees from z = −3.3, and without the factor cos θ of its pinhole camera.

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
