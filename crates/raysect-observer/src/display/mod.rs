//! How numbers become brightness and colour.

mod colour_map;
mod mono;

pub use colour_map::ColourMap;
pub use mono::MonoDisplay;
pub(crate) use mono::{check_fraction, unsaturated_value};
