//! Spectral functions, colours and spectra along single rays against recorded ones, and what is a little wrong is told.

use std::path::PathBuf;

use serde_json::{Value, json};

use crate::values::{Report, compare_all};

/// The sections of this file, after a change.
fn changed(change: impl FnOnce(&mut Value)) -> Report {
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/data/values.json");
    let mut file: Value = serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap();
    let sections = ["tolerance", "spectral", "colour", "traces"];
    file.as_object_mut().unwrap().retain(|name, _| sections.contains(&name.as_str()));
    change(&mut file);
    compare_all(&file).unwrap()
}

fn mismatches(report: &Report) -> Vec<&String> {
    report.findings.iter().flat_map(|f| &f.mismatches).collect()
}

/// How many cases of a section were compared.
fn cases(report: &Report, section: &str) -> usize {
    report.findings.iter().filter(|f| f.id.split('/').next() == Some(section)).count()
}

#[test]
fn spectra_and_colours_have_the_recorded_values() {
    let report = changed(|_| ());
    for found in &report.findings {
        println!("{} {} {} {:.1e}", found.id, found.compared, found.mismatches.len(), found.max_error);
    }
    assert!(mismatches(&report).is_empty(), "{:#?}", mismatches(&report));
    assert_eq!((cases(&report, "spectral"), cases(&report, "colour")), (65, 12));
    assert!(cases(&report, "traces") >= 12);
}

#[test]
fn each_wrong_value_is_told() {
    // By three tolerances of the function or kind.
    let worse =
        |value: &mut Value, tolerance: f64| *value = json!(value.as_f64().unwrap() * (1.0 + 3.0 * tolerance));
    let report = changed(|file| {
        let tolerance = file["tolerance"]["spectral"].clone();
        for case in file["spectral"]["cases"].as_array_mut().unwrap() {
            let tolerance = tolerance[case["function"].as_str().unwrap()].as_f64().unwrap();
            worse(&mut case["average"], tolerance.max(1e-12));
        }
    });
    assert_eq!(mismatches(&report).len(), 65);
    let report = changed(|file| {
        for case in file["colour"]["cases"].as_array_mut().unwrap() {
            worse(&mut case["ciexyz"][1], 3e-3);
            worse(&mut case["photons"][3], 1e-6);
            worse(&mut case["srgb_to_xyz"][2], 1e-6);
        }
        worse(&mut file["colour"]["photon_energy_500"], 1e-6);
    });
    assert_eq!(mismatches(&report).len(), 31);
    let report = changed(|file| {
        for case in file["traces"].as_array_mut().unwrap() {
            if case["scene"]["kind"] == "checkerboard" {
                worse(&mut case["samples"][1], 1e-4);
            }
        }
    });
    assert_eq!(mismatches(&report).len(), 8);
}

#[test]
fn unknown_functions_and_scenes_are_skipped() {
    let report = changed(|file| {
        file["spectral"]["cases"][0]["function"] = json!("unobtainium_n");
        file["traces"][0]["scene"]["kind"] = json!("black hole");
    });
    for name in ["spectral/unobtainium_n", "traces/black hole"] {
        assert!(report.skipped.iter().any(|s| s == name), "{name}: {:?}", report.skipped);
    }
}
