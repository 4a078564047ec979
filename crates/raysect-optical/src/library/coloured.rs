use std::path::Path;

use super::table::{proven, row, wrong};
use crate::{InterpolatedSf, OpticalError};

/// Width of the flat top and of each ramp [nm].
const TOP: f64 = 5.0;
const RAMP: f64 = 1.0;

/// A saturated colour by its name, as Raysect has ten of them: a top hat of 5 nm with ramps of 1 nm on either side and
/// unit integral.
///
/// ```
/// use raysect_optical::SpectralFunction;
/// use raysect_optical::library::coloured;
/// let green = coloured("green")?;
/// assert!((green.evaluate(538.5) - 1.0 / 6.0).abs() < 1e-15);
/// # Ok::<(), raysect_optical::OpticalError>(())
/// ```
///
/// # Errors
/// [`OpticalError::Unknown`], which lists the names there are.
#[doc(alias(
    "purple",
    "blue",
    "light_blue",
    "cyan",
    "green",
    "yellow",
    "orange",
    "red_orange",
    "red",
    "maroon"
))]
pub fn coloured(name: &str) -> Result<InterpolatedSf, OpticalError> {
    let Some((_, centre)) = list().find(|(known, _)| *known == name) else {
        return Err(OpticalError::unknown("coloured spectrum", name, coloured_list()));
    };
    let (inner, outer) = (0.5 * TOP, 0.5 * TOP + RAMP);
    let height = 1.0 / (TOP + RAMP);
    InterpolatedSf::new([-outer, -inner, inner, outer].map(|d| centre + d), [0.0, height, height, 0.0])
}

/// The names that [`coloured`] knows, from short to long wavelengths.
pub fn coloured_list() -> impl Iterator<Item = &'static str> {
    list().map(|(name, _)| name)
}

/// Names and centres [nm].
fn list() -> impl Iterator<Item = (&'static str, f64)> {
    let lines = include_str!("../../data/spectrum/coloured.csv").lines().zip(1..);
    lines.filter(|(line, _)| !line.starts_with('#')).map(|(line, number)| proven(entry(line, number)))
}

fn entry(line: &str, number: usize) -> Result<(&str, f64), OpticalError> {
    let path = Path::new("coloured spectra");
    let (name, centre) = line
        .split_once(',')
        .ok_or_else(|| wrong(path, number, "a name and a centre belong here".to_owned()))?;
    Ok((name, row::<1>(centre).map_err(|what| wrong(path, number, what))?[0]))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::SpectralFunction;

    #[test]
    fn all_ten_have_unit_integral_and_ramps() {
        assert_eq!(coloured_list().count(), 10);
        for name in coloured_list() {
            let colour = coloured(name).unwrap();
            assert!((colour.integrate(375.0, 785.0) - 1.0).abs() < 1e-12, "{name}");
        }
        let red = coloured("red").unwrap();
        assert!((red.evaluate(630.8 + 3.0) - 1.0 / 12.0).abs() < 1e-12);
        assert_eq!((red.evaluate(630.8 + 3.6), red.evaluate(600.0)), (0.0, 0.0));
        assert!(coloured("pink").unwrap_err().to_string().contains("it has purple, blue"));
    }
}
