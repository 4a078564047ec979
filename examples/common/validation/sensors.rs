//! Sensors in enclosures of uniform radiance.

use raysect::prelude::*;

use super::instruments::{Stand, by_name, square};
use super::measure::{Quantity, pixels};
use super::scenes::{Bench, dome, world, wrong};
use super::{Case, Reading};

pub(super) fn measure(case: &Case, bench: Bench) -> Option<Result<Reading, String>> {
    match case.kind.as_str() {
        "sensor_in_furnace" => in_furnace(case, bench).transpose(),
        "sensor_in_glass" => in_glass(case, bench).transpose(),
        "fibre_acceptance" => Some(fibre(case, bench)),
        _ => None,
    }
}

/// The reading of a sensor of a name; none for a name that nothing here knows.
fn in_furnace(case: &Case, bench: Bench) -> Result<Option<Reading>, String> {
    let Some(stand) = Stand::new(case, bench, None) else { return Ok(None) };
    by_name(&stand, &case.text("sensor")?)
}

/// The same in the middle of a ball of glass; a square pixel unless there is a name.
fn in_glass(case: &Case, bench: Bench) -> Result<Option<Reading>, String> {
    let Some(stand) = Stand::new(case, bench, Some(case.number("n")?)) else { return Ok(None) };
    if case.has("sensor") { by_name(&stand, &case.text("sensor")?) } else { square(&stand) }
}

fn fibre(case: &Case, bench: Bench) -> Result<Reading, String> {
    let radius = case.number("a")?;
    let fibre = FibreOptic::new(case.number("deg")?, radius).map_err(wrong)?;
    Ok(pixels(bench, &world([dome(radius)?])?, fibre, Quantity::Power)?[0])
}
