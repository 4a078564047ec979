//! Integrals, averages and bins of spectral functions by name.

use raysect::optical::OpticalError;
use raysect::optical::library::{d65_white, metal_index, schott_sheet};
use raysect::prelude::*;
use serde_json::Value;

use super::grid::numbers_of;
use super::group::compare_group;
use super::{Report, Section};
use crate::json::{field, index, list, number, text};

/// Compares each case with the tolerance of its function.
pub(crate) fn compare(section: &Section<'_>, report: &mut Report) -> Result<(), String> {
    let table = field(section.content, "interpolated", |v| Ok(v.clone()))?;
    let cases = field(section.content, "cases", |v| list(v, |case| Ok(case.clone())))?;
    for (number, case) in cases.iter().enumerate() {
        compare_case(section, number, case, &table, report).map_err(|e| format!("case {number}: {e}"))?;
    }
    section.skip_others(section.content, &["interpolated", "cases"], report);
    Ok(())
}

fn compare_case(
    section: &Section<'_>,
    position: usize,
    case: &Value,
    table: &Value,
    report: &mut Report,
) -> Result<(), String> {
    let name = field(case, "function", text)?;
    let Some(function) = function(&name, table)? else {
        let part = format!("{}/{name}", section.name);
        if !report.skipped.contains(&part) {
            report.skipped.push(part);
        }
        return Ok(());
    };
    let tolerance = field(section.tolerance, &name, number)?;
    let (min, max) = (field(case, "min", number)?, field(case, "max", number)?);
    let bins = field(case, "bins", index)? as usize;
    let mut finding = section.finding(format!("{position} {name}"));
    for (kind, ours) in [
        ("integrate", vec![function.integrate(min, max)]),
        ("average", vec![function.average(min, max)]),
        ("sample", function.sample(min, max, bins)),
    ] {
        let recorded = match kind {
            "sample" => numbers_of(case, kind)?,
            _ => vec![field(case, kind, number)?],
        };
        let rule = if name.starts_with("sellmeier_") {
            error_of_cells(&*function, min, max, ours.len())
        } else {
            0.0
        };
        compare_group(&mut finding, kind, &ours, &recorded, tolerance + rule)?;
    }
    report.findings.push(finding);
    Ok(())
}

/// Indices were recorded as averages of the midpoints of cells of at most 10 nm. What this rule is wrong by comes on top
/// of the tolerance, or the exact averages would fail: the largest relative error of bins.
fn error_of_cells(function: &dyn SpectralFunction, min: f64, max: f64, bins: usize) -> f64 {
    let edge = |i: usize| min + (max - min) * (i as f64 / bins as f64);
    let error = |i: usize| {
        let (low, high) = (edge(i), edge(i + 1));
        (midpoints(function, low, high, 10.0) / function.average(low, high) - 1.0).abs()
    };
    (0..bins).map(error).fold(0.0, f64::max)
}

/// The average of the midpoints of equal cells that are at most so wide [nm].
fn midpoints(function: &dyn SpectralFunction, min: f64, max: f64, width: f64) -> f64 {
    let cells = ((max - min) / width).ceil().max(1.0);
    let at = |i: usize| function.evaluate(min + (max - min) * ((i as f64 + 0.5) / cells));
    (0..cells as usize).map(at).sum::<f64>() / cells
}

/// The function of a name; none for a name that nothing here knows.
///
/// Besides those of the recorded file any temperature and emissivity, `blackbody_3000` or `blackbody_5778_e0.7`, any
/// metal, `gold_n`, and any glass without its hyphens, `sellmeier_nbk7`, `transmission_sf11`.
fn function(name: &str, table: &Value) -> Result<Option<Box<dyn SpectralFunction>>, String> {
    let wrong = |e: OpticalError| e.to_string();
    let interpolated = || {
        let (wavelengths, values) = (numbers_of(table, "wavelengths")?, numbers_of(table, "samples")?);
        InterpolatedSf::new(wavelengths, values).map_err(wrong)
    };
    Ok(match name {
        "interpolated" => Some(Box::new(interpolated()?)),
        "interpolated_normalised" => Some(Box::new(interpolated()?.normalised().map_err(wrong)?)),
        // Raysect's constant of the recorded file.
        "constant" => Some(Box::new(2.5)),
        "d65" => Some(Box::new(d65_white())),
        _ => black_body(name).or_else(|| glass(name)).or_else(|| metal(name)),
    })
}

fn black_body(name: &str) -> Option<Box<dyn SpectralFunction>> {
    let rest = name.strip_prefix("blackbody_")?;
    let (temperature, emissivity) = rest.split_once("_e").unwrap_or((rest, "1"));
    let body = BlackBody::new(temperature.parse().ok()?).ok()?;
    Some(Box::new(body.emissivity(emissivity.parse::<f64>().ok()?)))
}

fn glass(name: &str) -> Option<Box<dyn SpectralFunction>> {
    let (kind, wanted) = name.split_once('_')?;
    let plain = |name: &str| name.replace('-', "").to_lowercase();
    let name = raysect::optical::library::schott_list().find(|known| plain(known) == wanted)?;
    let sheet = schott_sheet(name).ok()?;
    match kind {
        "sellmeier" => Some(Box::new(sheet.index())),
        "transmission" => Some(Box::new(sheet.transmission().clone())),
        _ => None,
    }
}

fn metal(name: &str) -> Option<Box<dyn SpectralFunction>> {
    let (wanted, kind) = name.rsplit_once('_')?;
    let name = raysect::optical::library::metal_list().find(|known| known.to_lowercase() == wanted)?;
    let (n, k) = metal_index(name).ok()?;
    match kind {
        "n" => Some(Box::new(n)),
        "k" => Some(Box::new(k)),
        _ => None,
    }
}
