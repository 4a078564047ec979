//! Every class of sensor by its name, with parameters of its own and with the usual ones.

use crate::validation::{Case, measure, read_cases};
use crate::{have_their_answers_and_no_others, validation};

const CASES: &str = include_str!("../data/sensors.json");

/// What Raysect calls its sensors, and the classes that it does not have.
const CLASSES: [&str; 15] = [
    "CCDArray",
    "FibreOptic",
    "MeshCamera",
    "MeshPixel",
    "OpenCVCamera",
    "OrthographicCamera",
    "PinholeCamera",
    "Pixel",
    "SightLine",
    "SightlineArray",
    "TargetedCCDArray",
    "TargetedMeshPixel",
    "TargetedPixel",
    "ThinLensCamera",
    "VectorCamera",
];

fn cases() -> Vec<Case> {
    read_cases(CASES).unwrap()
}

#[test]
fn every_class_of_sensor_has_its_answers_and_no_others() {
    let names: Vec<String> = cases().iter().map(|case| case.text("sensor").unwrap()).collect();
    for class in CLASSES {
        assert!(names.iter().any(|name| name == class), "{class}");
    }
    have_their_answers_and_no_others(cases());
}

/// The first case with a text of it changed.
fn changed(old: &str, new: &str) -> Case {
    let text = CASES.replacen(old, new, 1);
    assert!(CASES.contains(old));
    read_cases(&text).unwrap().remove(0)
}

#[test]
fn names_in_any_spelling_are_one_sensor_and_unknown_ones_are_not_read() {
    let reading = |name: &str| {
        let case = changed("\"sensor\": \"Pixel\"", &format!("\"sensor\": \"{name}\""));
        measure(&case, 1, None).map(|reading| reading.unwrap())
    };
    let pixel: Option<validation::Reading> = reading("pixel");
    assert!(pixel.is_some() && reading("PIXEL") == pixel && reading("pi_xel") == pixel);
    for unknown in ["PlenopticCamera", "TargetedSightLine", "TargetedOrthographicCamera", "Targeted", ""] {
        assert_eq!(reading(unknown), None, "{unknown}");
    }
}

#[test]
fn quantities_that_no_sensor_reads_are_not_read() {
    let quantity = |name: &str| {
        let case = changed("\"quantity\": \"power\"", &format!("\"quantity\": \"{name}\""));
        measure(&case, 1, None).map(|reading| reading.unwrap().mean)
    };
    assert_eq!(quantity("colour"), None);
    assert!(quantity("radiance of any pixel").is_some_and(|radiance| (radiance - 1.0).abs() < 1e-12));
    assert_eq!(quantity("total power"), quantity("power"));
}

#[test]
fn parameters_that_no_sensor_has_are_refused() {
    let case = changed("\"x_width\": 0.003", "\"x_width\": -0.003");
    assert!(measure(&case, 1, None).unwrap().is_err());
}
