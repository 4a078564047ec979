//! placeholder
pub mod file;
