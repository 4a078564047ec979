//! Materials made of others.

mod add;
mod blend;
mod buffers;
mod parts;
mod roughen;

pub use add::Add;
pub use blend::Blend;
pub use roughen::Roughen;
