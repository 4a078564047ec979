//! Measured data: glasses, as files with their source, read at first use.

mod glass;
pub(crate) mod table;

pub use glass::{schott, schott_list};
