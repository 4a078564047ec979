//! Measured data: glasses, metals, illuminants and coloured spectra, as files with their source, each read at its
//! first use.

mod coloured;
mod glass;
mod glass_sheet;
mod illuminant;
mod metal;
pub(crate) mod table;

pub use coloured::{coloured, coloured_list};
pub use glass::{schott, schott_list, schott_sheet};
pub use glass_sheet::GlassSheet;
pub use illuminant::{d65_white, illuminant_a, illuminant_e};
pub use metal::{complex_index_from_csv, metal, metal_index, metal_list, rough_metal};
