//! Thermal radiation and colours: nothing is traced.

use raysect::optical::Slicing;
use raysect::optical::colour::{CieObserver, d65_white, xyz_to_linear_srgb};
use raysect::prelude::*;

use super::scenes::{Bench, wrong};
use super::{Case, Reading};

pub(super) fn measure(case: &Case, _: Bench) -> Option<Result<Reading, String>> {
    Some(match case.kind.as_str() {
        "planck" => black_body(case, |body| Ok(body.evaluate(case.number("wavelength_nm")?))),
        "planck_band" => black_body(case, |body| Ok(body.integrate(case.number("lo")?, case.number("hi")?))),
        "planck_total" => black_body(case, |body| Ok(body.integrate(0.0, f64::INFINITY))),
        "sellmeier" => sellmeier(case),
        "d65_srgb" => white().map(|xyz| Reading::exact(farthest_from(1.0, &xyz_to_linear_srgb(xyz)))),
        "d65_xy" => chromaticity(case),
        _ => return None,
    })
}

fn black_body(case: &Case, value: impl FnOnce(&BlackBody) -> Result<f64, String>) -> Result<Reading, String> {
    let body = BlackBody::new(case.number("T")?).map_err(wrong)?;
    value(&body).map(Reading::exact)
}

fn sellmeier(case: &Case) -> Result<Reading, String> {
    let wavelength = case.number("wavelength_nm")?;
    let index = Sellmeier::new(case.numbers("B")?, case.numbers("C")?).map_err(wrong)?.evaluate(wavelength);
    // A glass that is named must be that of the library, too.
    if let Ok(name) = case.text("glass") {
        let library = schott(&name).map_err(wrong)?.index().function().evaluate(wavelength);
        return Ok(Reading::exact(farthest_from(case.expected, &[index, library])));
    }
    Ok(Reading::exact(index))
}

/// The worst of some values that should all be the same.
fn farthest_from(expected: f64, values: &[f64]) -> f64 {
    let off = |v: &f64| (v - expected).abs();
    values.iter().copied().max_by(|a, b| off(a).total_cmp(&off(b))).unwrap_or(f64::NAN)
}

/// Tristimulus values of D65, by tables at 5 nm, for Y = 1.
fn white() -> Result<[f64; 3], String> {
    let slicing = Slicing::new(375.0, 785.0, 410, 1).map_err(wrong)?;
    let (min, max) = (slicing.min_wavelength(), slicing.max_wavelength());
    let samples = d65_white().sample(min, max, slicing.bins());
    let spectrum = Spectrum::from_samples(min, max, samples).map_err(wrong)?;
    let xyz = CieObserver::FiveNanometres.tristimulus(&spectrum);
    Ok(xyz.map(|v| v / xyz[1]))
}

fn chromaticity(case: &Case) -> Result<Reading, String> {
    let [x, y, z] = white()?;
    let sum = x + y + z;
    // y must be right as well.
    let other = case.number("y");
    match other {
        Ok(expected) if (y / sum - expected).abs() > case.tolerance * expected => {
            Err(format!("y is {} instead of {expected}", y / sum))
        }
        _ => Ok(Reading::exact(x / sum)),
    }
}
