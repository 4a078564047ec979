//! Triangle meshes: their data and their state of health.

mod data;
mod error;
mod health;
mod weld;

pub use data::MeshData;
pub use error::MeshError;
pub use health::MeshHealth;
