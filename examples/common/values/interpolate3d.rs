//! Interpolators of three variables.

use raysect::math::function::{Function, Interpolator3DArray};

use super::grid::{KINDS, flat, numbers_of};
use super::group::compare_group;
use super::{Report, Section};
use crate::json::{field, list, numbers};

/// Compares one function in both interpolations.
pub(crate) fn compare(section: &Section<'_>, report: &mut Report) -> Result<(), String> {
    let (content, tolerance) = (section.content, section.one_tolerance()?);
    let (x, y, z) = (numbers_of(content, "x")?, numbers_of(content, "y")?, numbers_of(content, "z")?);
    let f = field(content, "f", |v| flat(v, &[("x", x.len()), ("y", y.len()), ("z", z.len())]))?;
    let at = field(content, "at", |v| list(v, numbers::<3>))?;
    for (name, kind) in KINDS {
        let function = Interpolator3DArray::new(&x, &y, &z, &f, kind).map_err(|e| e.to_string())?;
        let ours: Vec<f64> = at.iter().map(|&[x, y, z]| function.evaluate((x, y, z))).collect();
        let mut finding = section.finding(name);
        compare_group(&mut finding, name, &ours, &numbers_of(content, name)?, tolerance)?;
        report.findings.push(finding);
    }
    section.skip_others(content, &["x", "y", "z", "f", "at", "linear", "cubic"], report);
    Ok(())
}
