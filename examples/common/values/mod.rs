//! Recorded values of functions, maps and spectra, and ours of the same arguments.
//!
//! A file is an object of sections. `tolerance` has an entry for each: a relative tolerance, or an object of them by
//! name. To compare another section, write a file with a `compare` like those here, and add it to [`SECTIONS`].

mod colour;
mod grid;
mod group;
mod interpolate1d;
mod interpolate2d;
mod interpolate3d;
mod mesh2d;
mod spectral;
mod traces;
mod transforms;

use serde_json::Value;

use crate::finding::Finding;
use crate::json::{field, number};

/// A section of a file.
pub(crate) struct Section<'a> {
    pub(crate) name: &'a str,
    pub(crate) content: &'a Value,
    /// A number, or an object of numbers.
    pub(crate) tolerance: &'a Value,
}

/// What a file gives.
#[derive(Default)]
pub(crate) struct Report {
    /// One for each case, `section/case`.
    pub(crate) findings: Vec<Finding>,
    /// What nothing here can compare: `section`, or `section/part`.
    pub(crate) skipped: Vec<String>,
}

/// Compares what a section holds. An error is a section that cannot be read.
type Compare = fn(&Section<'_>, &mut Report) -> Result<(), String>;

/// The sections that can be compared.
const SECTIONS: [(&str, Compare); 8] = [
    ("transforms", transforms::compare),
    ("interpolate1d", interpolate1d::compare),
    ("interpolate2d", interpolate2d::compare),
    ("interpolate3d", interpolate3d::compare),
    ("mesh2d", mesh2d::compare),
    ("spectral", spectral::compare),
    ("colour", colour::compare),
    ("traces", traces::compare),
];

/// The entry that is not a section, by which a file of values is known.
pub(crate) const TOLERANCE: &str = "tolerance";

/// Compares all sections of a file.
pub(crate) fn compare_all(file: &Value) -> Result<Report, String> {
    let sections = file.as_object().ok_or("an object of sections is needed")?;
    let mut report = Report::default();
    for (name, content) in sections.iter().filter(|(name, _)| *name != TOLERANCE) {
        let Some((_, compare)) = SECTIONS.iter().find(|(known, _)| known == name) else {
            report.skipped.push(name.clone());
            continue;
        };
        let tolerance = field(file, TOLERANCE, |t| field(t, name, |v| Ok(v.clone())))?;
        let section = Section { name, content, tolerance: &tolerance };
        compare(&section, &mut report).map_err(|e| format!("{name}: {e}"))?;
    }
    if report.findings.is_empty() {
        Err("there is nothing that can be compared".to_owned())
    } else {
        Ok(report)
    }
}

impl Section<'_> {
    /// The one tolerance of the whole section.
    pub(crate) fn one_tolerance(&self) -> Result<f64, String> {
        number(self.tolerance).map_err(|e| format!("tolerance: {e}"))
    }

    /// An empty finding of one case.
    pub(crate) fn finding(&self, case: impl std::fmt::Display) -> Finding {
        Finding::new(format!("{}/{case}", self.name))
    }

    /// Says of all parts of an object that are not among the known ones that they are skipped.
    pub(crate) fn skip_others(&self, object: &Value, known: &[&str], report: &mut Report) {
        let parts = object.as_object().into_iter().flatten().map(|(key, _)| key);
        for part in parts.filter(|part| !known.contains(&part.as_str())) {
            let name = format!("{}/{part}", self.name);
            if !report.skipped.contains(&name) {
                report.skipped.push(name);
            }
        }
    }
}
