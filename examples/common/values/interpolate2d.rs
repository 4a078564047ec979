//! Interpolators of two variables.

use raysect::math::function::{Function, Interpolator2DArray};

use super::grid::{KINDS, flat, numbers_of};
use super::group::compare_group;
use super::{Report, Section};
use crate::json::{field, list, numbers};

/// Compares one surface in both interpolations.
pub(crate) fn compare(section: &Section<'_>, report: &mut Report) -> Result<(), String> {
    let (content, tolerance) = (section.content, section.one_tolerance()?);
    let (x, y) = (numbers_of(content, "x")?, numbers_of(content, "y")?);
    let f = field(content, "f", |v| flat(v, &[("x", x.len()), ("y", y.len())]))?;
    let at = field(content, "at", |v| list(v, numbers::<2>))?;
    for (name, kind) in KINDS {
        let surface = Interpolator2DArray::new(&x, &y, &f, kind).map_err(|e| e.to_string())?;
        let ours: Vec<f64> = at.iter().map(|&[x, y]| surface.evaluate((x, y))).collect();
        let mut finding = section.finding(name);
        compare_group(&mut finding, name, &ours, &numbers_of(content, name)?, tolerance)?;
        report.findings.push(finding);
    }
    section.skip_others(content, &["x", "y", "f", "at", "linear", "cubic"], report);
    Ok(())
}
