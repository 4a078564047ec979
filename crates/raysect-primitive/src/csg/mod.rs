//! Constructive solid geometry: bodies made of two others, nested to any depth.

mod composite;
mod flat;
mod intersect;
mod leaf;
mod operand;
mod subtract;
mod tie;
mod truth;
mod union;
mod walk;

#[cfg(test)]
mod tests;

pub use intersect::Intersect;
pub use operand::{Operand, Place};
pub use subtract::Subtract;
pub use union::Union;
