//! Triangle meshes: their data and their state of health.

mod data;
mod error;

pub use data::MeshData;
pub use error::MeshError;
