//! Materials made of others.

mod add;
mod blend;
mod buffers;
mod mixture;
mod parts;
mod roughen;
mod volume_transform;

pub use add::Add;
pub use blend::Blend;
pub(crate) use mixture::add_share;
pub use roughen::Roughen;
pub use volume_transform::VolumeTransform;
