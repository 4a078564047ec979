//! Tristimulus values, photons and sRGB.
//!
//! Colours were recorded with the matching functions at 5 nm, and are compared with ours of the same table: that at 1 nm,
//! which is the default, differs by up to 4e-3 for coarse bins.

use raysect::optical::colour::{CieObserver, ciexyz_to_ciexyy, ciexyz_to_srgb, srgb_to_ciexyz};
use raysect::optical::{OpticalError, Slicing, photon_energy};
use raysect::prelude::*;
use serde_json::Value;

use super::grid::numbers_of;
use super::group::compare_group;
use super::{Report, Section};
use crate::finding::Finding;
use crate::json::{field, list, number, numbers};

const RESAMPLED: &str = "resample_ciexyz_375_740_15";

/// Compares spectra and colours, the resampled matching functions and the energy of a photon.
pub(crate) fn compare(section: &Section<'_>, report: &mut Report) -> Result<(), String> {
    let cases = field(section.content, "cases", |v| list(v, |case| Ok(case.clone())))?;
    for (position, case) in cases.iter().enumerate() {
        let mut finding = section.finding(position);
        compare_case(section, case, &mut finding).map_err(|e| format!("case {position}: {e}"))?;
        report.findings.push(finding);
    }
    if section.content.get(RESAMPLED).is_some() {
        let recorded = field(section.content, RESAMPLED, |v| list(v, numbers::<3>))?;
        let slicing = Slicing::new(375.0, 740.0, 15, 1).map_err(|e| e.to_string())?;
        let ours = CieObserver::FiveNanometres.resample(&slicing);
        let mut finding = section.finding(RESAMPLED);
        let tolerance = field(section.tolerance, "resample_ciexyz", number)?;
        for (channel, name) in ["x", "y", "z"].into_iter().enumerate() {
            let of = |rows: &[[f64; 3]]| rows.iter().map(|row| row[channel]).collect::<Vec<_>>();
            compare_group(&mut finding, name, &of(&ours), &of(&recorded), tolerance)?;
        }
        report.findings.push(finding);
    }
    if section.content.get("photon_energy_500").is_some() {
        let recorded = field(section.content, "photon_energy_500", number)?;
        let ours = photon_energy(500.0).map_err(|e| e.to_string())?;
        let mut finding = section.finding("photon_energy_500");
        let tolerance = field(section.tolerance, "photons", number)?;
        compare_group(&mut finding, "photon_energy_500", &[ours], &[recorded], tolerance)?;
        report.findings.push(finding);
    }
    section.skip_others(section.content, &["cases", RESAMPLED, "photon_energy_500"], report);
    Ok(())
}

fn compare_case(section: &Section<'_>, case: &Value, finding: &mut Finding) -> Result<(), String> {
    let (min, max) = (field(case, "min", number)?, field(case, "max", number)?);
    let wrong = |e: OpticalError| e.to_string();
    let spectrum = Spectrum::from_samples(min, max, numbers_of(case, "samples")?).map_err(wrong)?;
    let xyz = CieObserver::FiveNanometres.tristimulus(&spectrum);
    let to_xyz = srgb_to_ciexyz(field(case, "srgb_in", numbers::<3>)?);
    for (name, tolerance, ours) in [
        ("ciexyz", "ciexyz", xyz.to_vec()),
        ("ciexyy", "ciexyz", ciexyz_to_ciexyy(xyz).to_vec()),
        ("photons", "photons", spectrum.to_photons()),
        ("srgb_to_xyz", "srgb", to_xyz.to_vec()),
        ("xyz_to_srgb_of_that", "srgb", ciexyz_to_srgb(to_xyz).to_vec()),
    ] {
        let tolerance = field(section.tolerance, tolerance, number)?;
        compare_group(finding, name, &ours, &numbers_of(case, name)?, tolerance)?;
    }
    let total = field(case, "total", number)?;
    compare_group(finding, "total", &[spectrum.total()], &[total], field(section.tolerance, "total", number)?)
}
