//! Triangle meshes: their data, their state of health and their files.

mod data;
mod error;
mod health;
pub mod io;
mod weld;

pub use data::MeshData;
pub use error::MeshError;
pub use health::MeshHealth;
