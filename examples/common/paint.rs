//! Coloured paints.

use raysect::prelude::*;

/// A matt paint from its reflectivities in the red, the green and the blue, 0 to 1, with soft steps between.
pub(crate) fn paint(red: f64, green: f64, blue: f64) -> raysect::Result<Lambert> {
    let wavelengths = [375.0, 480.0, 510.0, 570.0, 600.0, 740.0];
    Ok(Lambert::new(InterpolatedSf::new(wavelengths, [blue, blue, green, green, red, red])?))
}
