//! Values of functions, maps and meshes against recorded ones, and what is a little wrong is told exactly.

use std::path::PathBuf;

use serde_json::{Value, json};

use crate::values::{Report, compare_all};

/// The recorded file.
fn recorded() -> Value {
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/data/values.json");
    serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap()
}

/// What a recorded file gives after a change.
fn changed(change: impl FnOnce(&mut Value)) -> Result<Report, String> {
    let mut file = recorded();
    change(&mut file);
    compare_all(&file)
}

/// The file with these sections only.
fn only(sections: &[&str]) -> Value {
    let mut file = recorded();
    file.as_object_mut().unwrap().retain(|name, _| name == "tolerance" || sections.contains(&name.as_str()));
    file
}

fn mismatches(report: &Report) -> Vec<&String> {
    report.findings.iter().flat_map(|f| &f.mismatches).collect()
}

const MATHEMATICS: [&str; 5] = ["transforms", "interpolate1d", "interpolate2d", "interpolate3d", "mesh2d"];

#[test]
fn maps_interpolators_and_meshes_have_the_recorded_values() {
    let report = compare_all(&only(&MATHEMATICS)).unwrap();
    for found in &report.findings {
        println!("{} {} {} {:.1e}", found.id, found.compared, found.mismatches.len(), found.max_error);
    }
    assert!(mismatches(&report).is_empty(), "{:#?}", mismatches(&report));
    assert!(report.skipped.is_empty(), "{:?}", report.skipped);
    let count = |section: &str| {
        let of = |id: &str| id.split('/').next() == Some(section);
        let found = report.findings.iter().filter(|f| of(&f.id));
        found.fold((0, 0), |(cases, compared), f| (cases + 1, compared + f.compared))
    };
    let counts = MATHEMATICS.map(count);
    assert_eq!(counts, [(20, 20 * 132), (7, 2 * 39 + 5 * 4), (2, 80), (2, 80), (2, 120)]);
}

/// The lists of recorded values of the mathematics, each with the largest of its magnitudes.
fn groups(file: &mut Value) -> Vec<(&mut Vec<Value>, f64)> {
    let mut groups = Vec::new();
    for (section, content) in file.as_object_mut().unwrap() {
        let names: &[&str] = match section.as_str() {
            "transforms" => &["rotate", "rotate_vector", "rotate_basis", "m_inverse", "quaternion_xyzs"],
            "interpolate1d" | "interpolate2d" | "interpolate3d" => &["linear", "cubic"],
            "mesh2d" => &["linear", "discrete"],
            _ => continue,
        };
        let cases: Vec<&mut Value> = match content {
            Value::Array(cases) => cases.iter_mut().collect(),
            one => vec![one],
        };
        for case in cases {
            let parts = case.as_object_mut().unwrap().iter_mut();
            for (_, list) in parts.filter(|(name, _)| names.contains(&name.as_str())) {
                let list = list.as_array_mut().unwrap();
                let largest = list.iter().map(|v| v.as_f64().unwrap().abs()).fold(0.0, f64::max);
                groups.push((list, largest));
            }
        }
    }
    groups
}

#[test]
fn each_wrong_value_is_told() {
    let mut count = 0;
    let mut file = only(&MATHEMATICS);
    let mut all = Vec::new();
    for (list, largest) in groups(&mut file) {
        all.extend(list.iter_mut().map(|value| (value, largest)));
    }
    // One value in a hundred, by a hundred tolerances of the coarsest section.
    for (value, largest) in all.into_iter().skip(7).step_by(100) {
        *value = json!(value.as_f64().unwrap() + 1e-7 * largest);
        count += 1;
    }
    let report = compare_all(&file).unwrap();
    assert_eq!(count, 18);
    assert_eq!(mismatches(&report).len(), count);
}

#[test]
fn wrong_arguments_are_told() {
    let small = |value: &mut Value| *value = json!(value.as_f64().unwrap() * (1.0 + 1e-6));
    let mut wrong = 0;
    for (section, argument) in
        [("interpolate1d", "/f/3"), ("interpolate2d", "/f/2/3"), ("interpolate3d", "/f/2/3/1")]
    {
        let report = changed(|file| small(file[section].pointer_mut(argument).unwrap())).unwrap();
        assert!(report.findings.iter().all(|f| f.mismatches.is_empty() || f.id.starts_with(section)));
        wrong += usize::from(!mismatches(&report).is_empty());
    }
    assert_eq!(wrong, 3);
    let report = changed(|file| small(&mut file["transforms"][4]["roll"])).unwrap();
    let of: Vec<_> = report.findings.iter().filter(|f| !f.mismatches.is_empty()).map(|f| &f.id).collect();
    assert_eq!(of, ["transforms/4"]);
    let report = changed(|file| file["mesh2d"]["outside_value"] = json!(-1.001)).unwrap();
    assert!(mismatches(&report).len() > 20);
}

#[test]
fn what_cannot_be_compared_is_reported_as_skipped() {
    let report = changed(|file| {
        file["sounds"] = json!([1.0]);
        file["mesh2d"]["quadratic"] = json!([1.0]);
        file["transforms"][3]["rotate_w"] = json!([1.0]);
    });
    let skipped = report.unwrap().skipped;
    for name in ["sounds", "mesh2d/quadratic", "transforms/rotate_w"] {
        assert!(skipped.iter().any(|s| s == name), "{name}: {skipped:?}");
    }
    assert!(compare_all(&only(&[])).is_err());
}

type Change = Box<dyn Fn(&mut Value)>;

#[test]
fn malformed_sections_are_refused_with_their_name() {
    let set = |pointer: &'static str, value: Value| {
        move |file: &mut Value| *file.pointer_mut(pointer).unwrap() = value.clone()
    };
    let changes: [(&str, Change); 9] = [
        (
            "tolerance: there is no 'mesh2d'",
            Box::new(|f| drop(f["tolerance"].as_object_mut().unwrap().remove("mesh2d"))),
        ),
        ("mesh2d: tolerance: a number", Box::new(set("/tolerance/mesh2d", json!("small")))),
        ("transforms: entry 2: rotate", Box::new(set("/transforms/2/rotate", json!([1.0, 2.0])))),
        ("interpolate1d: x: entry 1", Box::new(set("/interpolate1d/x/1", json!("here")))),
        (
            "interpolate1d: extrapolate: 'cubic'",
            Box::new(set("/interpolate1d/extrapolate", json!({"cubic": []}))),
        ),
        (
            "interpolate1d: ours and linear",
            Box::new(|f| drop(f["interpolate1d"]["linear"].as_array_mut().unwrap().pop())),
        ),
        (
            "interpolate2d: f: entry 3: the list and y",
            Box::new(|f| drop(f["interpolate2d"]["f"][3].as_array_mut().unwrap().pop())),
        ),
        (
            "interpolate3d: there is no 'z'",
            Box::new(|f| drop(f["interpolate3d"].as_object_mut().unwrap().remove("z"))),
        ),
        ("mesh2d: triangles: entry 0: entry 1", Box::new(set("/mesh2d/triangles/0/1", json!(-1)))),
    ];
    for (what, change) in changes {
        let message = changed(change).err().unwrap_or_default();
        assert!(message.starts_with(what), "{what}: {message:?}");
    }
    assert!(compare_all(&json!([1.0])).is_err());
}
