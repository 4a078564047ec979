//! Interpolators of one variable, between and beyond their knots.

use raysect::math::function::{Extrapolation1D, Function, Interpolation1D, Interpolator1DArray};

use super::grid::numbers_of;
use super::group::compare_group;
use super::{Report, Section};
use crate::json::{list, number};

/// So far beyond the knots the recorded interpolators go on.
const RANGE: f64 = 1.0;

/// Compares one curve in all its interpolations and extrapolations.
pub(crate) fn compare(section: &Section<'_>, report: &mut Report) -> Result<(), String> {
    let (content, tolerance) = (section.content, section.one_tolerance()?);
    let (x, f) = (numbers_of(content, "x")?, numbers_of(content, "f")?);
    let build = |kind| Interpolator1DArray::new(&x, &f, kind).map_err(|e| e.to_string());
    let mut judge = |name: &str, case: &str, curve: Interpolator1DArray, at: &[f64], recorded: &[f64]| {
        let ours: Vec<f64> = at.iter().map(|&x| curve.evaluate(x)).collect();
        let mut finding = section.finding(case);
        compare_group(&mut finding, name, &ours, recorded, tolerance)?;
        report.findings.push(finding);
        Ok::<_, String>(())
    };

    let at = numbers_of(content, "at")?;
    for name in ["linear", "cubic"] {
        judge(name, name, build(interpolation(name)?)?, &at, &numbers_of(content, name)?)?;
    }
    if let Some(beyond) = content.get("extrapolate") {
        let at = numbers_of(content, "extrapolate_at")?;
        for (name, recorded) in beyond.as_object().ok_or("extrapolate: an object is needed")? {
            let (kind, beyond) = kinds(name).map_err(|e| format!("extrapolate: {e}"))?;
            let curve = build(kind)?.extrapolate(beyond, RANGE).map_err(|e| e.to_string())?;
            let recorded = list(recorded, number).map_err(|e| format!("extrapolate: {name}: {e}"))?;
            judge(name, &format!("extrapolate/{name}"), curve, &at, &recorded)?;
        }
    }
    section.skip_others(
        content,
        &["x", "f", "at", "linear", "cubic", "extrapolate_at", "extrapolate"],
        report,
    );
    Ok(())
}

/// Interpolation and extrapolation as in `cubic/linear`.
fn kinds(name: &str) -> Result<(Interpolation1D, Extrapolation1D), String> {
    let (inside, beyond) = name.split_once('/').ok_or_else(|| format!("'{name}' is no pair of kinds"))?;
    let beyond = match beyond {
        "nearest" => Extrapolation1D::Nearest,
        "linear" => Extrapolation1D::Linear,
        "quadratic" => Extrapolation1D::Quadratic,
        _ => return Err(format!("'{beyond}' is no known extrapolation")),
    };
    Ok((interpolation(inside)?, beyond))
}

fn interpolation(name: &str) -> Result<Interpolation1D, String> {
    match name {
        "linear" => Ok(Interpolation1D::Linear),
        "cubic" => Ok(Interpolation1D::Cubic),
        _ => Err(format!("'{name}' is no known interpolation")),
    }
}
