//! Cameras.

mod pinhole;

pub use pinhole::{Pinhole, PinholeCamera};
