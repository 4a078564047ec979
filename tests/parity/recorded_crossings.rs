//! Rays through shapes of all kinds against crossings recorded elsewhere, and what is a little wrong is told exactly.

use std::path::PathBuf;

use serde_json::{Value, json};

use crate::crossings::compare_all;
use crate::finding::Finding;

/// The lines of the recorded file.
fn recorded() -> String {
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/data/crossings.jsonl");
    std::fs::read_to_string(path).unwrap()
}

fn compare(text: &str) -> Result<Vec<Finding>, String> {
    let mut all = Vec::new();
    compare_all(text.as_bytes(), |finding| all.push(finding))?;
    Ok(all)
}

fn mismatches(text: &str) -> Vec<String> {
    let of_case = |f: Finding| f.mismatches.into_iter().map(move |what| format!("{}: {what}", f.id));
    compare(text).unwrap().into_iter().flat_map(of_case).collect()
}

/// The recorded file after a change of its cases.
fn changed(change: impl FnOnce(&mut [Value])) -> String {
    let mut cases: Vec<Value> = recorded().lines().map(|l| serde_json::from_str(l).unwrap()).collect();
    change(&mut cases);
    cases.iter().map(|case| format!("{case}\n")).collect()
}

/// All recorded crossings.
fn crossings(cases: &mut [Value]) -> impl Iterator<Item = &mut Value> {
    let rays = cases.iter_mut().flat_map(|case| case["crossings"].as_array_mut().unwrap());
    rays.flat_map(|ray| ray.as_array_mut().unwrap())
}

#[test]
fn all_shapes_cross_rays_where_recorded() {
    let all = compare(&recorded()).unwrap();
    for Finding { id, compared, mismatches, max_error } in &all {
        println!("{id} {compared} {} {max_error:.1e}", mismatches.len());
    }
    let wrong: Vec<_> = all.iter().flat_map(|f| f.mismatches.iter().map(|m| (&f.id, m))).collect();
    assert!(wrong.is_empty(), "{wrong:#?}");
    assert_eq!(all.len(), 52);
    let kinds = recorded();
    for kind in [
        "sphere",
        "box",
        "cylinder",
        "cone",
        "parabola",
        "torus",
        "union",
        "intersect",
        "subtract",
        "biconvex",
        "biconcave",
        "planoconvex",
        "planoconcave",
        "meniscus",
        "mesh",
    ] {
        assert!(kinds.contains(&format!("\"kind\":\"{kind}\"")), "{kind}");
    }
}

#[test]
fn each_wrong_number_is_told() {
    let mut count = 0;
    let text = changed(|cases| {
        // One distance in a hundred by a millionth, among those that are not small beside the shape: a distance near
        // zero times a millionth is within the tolerance.
        let long = crossings(cases).filter(|c| c[0].as_f64().unwrap() > 0.05);
        for crossing in long.step_by(100) {
            crossing[0] = json!(crossing[0].as_f64().unwrap() * (1.0 + 1e-6));
            count += 1;
        }
        for index in [7, 1001] {
            let crossing = crossings(cases).nth(index).unwrap();
            crossing[4] = json!(1 - crossing[4].as_u64().unwrap());
        }
        let inside = &mut cases[40]["inside"][3];
        *inside = json!(1 - inside.as_u64().unwrap());
    });
    let told = mismatches(&text);
    let of = |word: &str| told.iter().filter(|sentence| sentence.contains(word)).count();
    assert!(count > 20, "{count}");
    assert_eq!(of("distance"), count);
    assert_eq!(of("exiting"), 2);
    assert_eq!(of("inside"), 1);
    assert_eq!(told.len(), count + 3, "{told:#?}");
}

#[test]
fn a_wrong_normal_and_a_missing_crossing_are_told() {
    let text = changed(|cases| {
        let crossing = crossings(cases).nth(5).unwrap();
        crossing[1] = json!(crossing[1].as_f64().unwrap() + 1e-6);
    });
    let told = mismatches(&text);
    assert!(told.len() == 1 && told[0].contains("normal"), "{told:?}");
    let text = changed(|cases| {
        let rays = cases.iter_mut().flat_map(|case| case["crossings"].as_array_mut().unwrap());
        let ray = rays.filter(|ray| ray.as_array().unwrap().len() == 2).nth(50).unwrap();
        ray.as_array_mut().unwrap().pop();
    });
    let told = mismatches(&text);
    assert!(told.len() == 1 && told[0].contains("2 crossings"), "{told:?}");
}

#[test]
fn a_wrong_shape_or_place_is_told() {
    let larger = changed(|cases| {
        let radius = &mut cases[0]["shape"]["radius"];
        *radius = json!(radius.as_f64().unwrap() * 1.001);
    });
    assert!(mismatches(&larger).iter().all(|m| m.starts_with("sphere-0")) && !mismatches(&larger).is_empty());
    let moved = changed(|cases| {
        let place = &mut cases[30]["shape"]["a"]["transform"][3];
        *place = json!(place.as_f64().unwrap() + 1e-4);
    });
    assert!(!mismatches(&moved).is_empty());
}

#[test]
fn malformed_lines_are_refused_with_their_number() {
    let good = recorded();
    let third = |change: &dyn Fn(&mut Value)| changed(|cases| change(&mut cases[2]));
    let entry =
        |list: &'static str, value: Value| third(&move |case: &mut Value| case[list][1] = value.clone());
    let shape = |value: Value| third(&move |case: &mut Value| case["shape"] = value.clone());
    let mut texts = vec![
        (good.lines().take(2).map(|l| format!("{l}\n")).collect::<String>() + "{\"id\": \"x\",", "JSON"),
        (entry("rays", json!([0.0, 1.0, 2.0, 3.0, 4.0])), "rays: entry 1"),
        (entry("rays", json!([0.0, 1.0, 2.0, 0.0, 0.0, 0.0])), "rays: entry 1"),
        (entry("crossings", json!([[1.0, 0.0, 0.0, 1.0, 2]])), "crossings: entry 1: entry 0"),
        (entry("crossings", json!([[1.0, 0.0, 0.0]])), "crossings: entry 1: entry 0"),
        (entry("inside", json!(2)), "inside: entry 1"),
        (entry("points", json!("here")), "points: entry 1"),
        (shape(json!({"kind": "teapot"})), "teapot"),
        (shape(json!({"kind": "sphere"})), "radius"),
        (shape(json!({"kind": "sphere", "radius": -1.0})), "-1"),
        (shape(json!({"kind": "sphere", "radius": 1.0, "transform": []})), "only operands"),
        (shape(json!({"kind": "union", "a": {"kind": "sphere", "radius": 1.0}})), "'b'"),
        (shape(json!({"kind": "mesh", "vertices": [[0.0, 0.0, 0.0]], "triangles": [[0, 1, 2]]})), "vert"),
    ];
    for list in ["rays", "crossings", "points", "inside"] {
        texts.push((
            third(&move |case: &mut Value| drop(case[list].as_array_mut().unwrap().pop())),
            "entries",
        ));
    }
    for key in ["id", "shape", "transform", "rays", "crossings", "points", "inside"] {
        texts.push((third(&move |case: &mut Value| drop(case.as_object_mut().unwrap().remove(key))), key));
    }
    for (text, what) in texts {
        let message = compare(&text).err().unwrap_or_default();
        assert!(message.starts_with("line 3: ") && message.contains(what), "{what}: {message:?}");
    }
    assert!(compare("\n").is_err());
}
