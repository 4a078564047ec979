//! Triangle meshes: their data, their state of health and their files.

mod areas;
mod block;
mod builder;
mod data;
mod error;
mod health;
pub mod io;
#[allow(clippy::module_inception)]
mod mesh;
mod search;
mod solids;
mod triangle;
mod weld;

pub use builder::MeshBuilder;
pub use data::MeshData;
pub use error::MeshError;
pub use health::MeshHealth;
pub use mesh::Mesh;
