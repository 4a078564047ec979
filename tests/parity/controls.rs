//! Frames that are a little wrong are refused.

use crate::comparison::Picture;
use crate::cornell::Variant;
use crate::frames::{judge, ours, recorded};
use crate::reference;

/// A picture with every mean multiplied by a factor that depends on row, column and channel.
fn times(picture: &Picture, factor: impl Fn(usize, usize, usize) -> f64) -> Picture {
    let mut wrong = picture.clone();
    for (i, mean) in wrong.mean.iter_mut().enumerate() {
        let (pixel, channel) = (i / picture.channels, i % picture.channels);
        *mean *= factor(pixel / picture.columns, pixel % picture.columns, channel);
    }
    wrong
}

/// Asserts that our diffuse frame agrees with the recorded one, and with none that has been spoilt.
fn refuse(spoilt: &[(&str, &dyn Fn(usize, usize, usize) -> f64)]) {
    let theirs = recorded(Variant::Diffuse);
    let ours = ours(Variant::Diffuse, theirs.columns, theirs.rows, 2);
    assert!(judge("as it is", &ours, &theirs).holds(crate::frames::ERROR));
    for (what, factor) in spoilt {
        let found = judge(what, &ours, &times(&theirs, factor));
        let values = found.criteria(f64::INFINITY).into_iter().filter(|(_, holds)| !holds).count();
        assert!(values > 0, "{what} is accepted");
    }
}

#[test]
fn wrong_values_are_refused() {
    let inside = |row, column| (8..12).contains(&row) && (12..16).contains(&column);
    refuse(&[
        ("3 % too bright", &|_, _, _| 1.03),
        ("3 % too dark", &|_, _, _| 0.97),
        ("blue 5 % too bright", &|_, _, channel| if channel == 2 { 1.05 } else { 1.0 }),
        ("one block 20 % too bright", &|row, column, _| if inside(row, column) { 1.2 } else { 1.0 }),
        ("one block 20 % too dark", &|row, column, _| if inside(row, column) { 0.8 } else { 1.0 }),
    ]);
}

#[test]
fn wrong_errors_are_refused() {
    let theirs = recorded(Variant::Diffuse);
    let ours = ours(Variant::Diffuse, theirs.columns, theirs.rows, 3);
    let with_errors = |picture: &Picture, factor: f64| {
        let error = picture.error.iter().map(|e| e * factor).collect();
        Picture { error, ..picture.clone() }
    };
    for factor in [0.5, 2.0] {
        let found = judge("errors", &with_errors(&ours, factor), &with_errors(&theirs, factor));
        assert!(!found.holds(f64::INFINITY), "errors times {factor} are accepted");
    }
}

#[test]
fn other_variants_and_orientations_are_refused() {
    let ours = ours(Variant::Diffuse, 24, 24, 4);
    assert!(!judge("the other variant", &ours, &recorded(Variant::Glass)).holds(f64::INFINITY));
    let theirs = recorded(Variant::Diffuse);
    let mirrored = |rows: bool, columns: bool| {
        let mut mirrored = theirs.clone();
        for i in 0..theirs.mean.len() {
            let (pixel, channel) = (i / 3, i % 3);
            let (row, column) = (pixel / theirs.columns, pixel % theirs.columns);
            let row = if rows { theirs.rows - 1 - row } else { row };
            let column = if columns { theirs.columns - 1 - column } else { column };
            let from = (row * theirs.columns + column) * 3 + channel;
            (mirrored.mean[i], mirrored.error[i]) = (theirs.mean[from], theirs.error[from]);
        }
        mirrored
    };
    assert!(judge("the same", &ours, &mirrored(false, false)).holds(crate::frames::ERROR));
    assert!(!judge("upside down", &ours, &mirrored(true, false)).holds(f64::INFINITY));
    assert!(!judge("left and right swapped", &ours, &mirrored(false, true)).holds(f64::INFINITY));
}

#[test]
fn other_shapes_cannot_be_compared() {
    let (square, wide) = (
        reference::render(Variant::Diffuse, 2, 2, 1, 1, 0.5),
        reference::render(Variant::Diffuse, 3, 2, 1, 1, 0.5),
    );
    assert!(crate::comparison::compare(&square.unwrap(), &wide.unwrap()).is_err());
}
