//! Surfaces that emit.

mod anisotropic;
mod checkerboard;
mod debug_light;
mod uniform;
mod unity;

pub use anisotropic::AnisotropicSurfaceEmitter;
pub use checkerboard::Checkerboard;
pub use debug_light::DebugLight;
pub use uniform::UniformSurfaceEmitter;
pub use unity::UnitySurfaceEmitter;
