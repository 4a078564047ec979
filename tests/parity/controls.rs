//! Frames that are a little wrong are refused, by their values and not for want of samples.

use crate::comparison::{Picture, compare};
use crate::cornell::Variant;
use crate::frames::{ERROR, diffuse, judge, ours, recorded};

/// What a mean is multiplied by, according to row, column and channel.
type Factor = dyn Fn(usize, usize, usize) -> f64;

/// A picture with means that are off. Those without noise, which a rounding error would give away, stay as they are.
fn spoilt(picture: &Picture, factor: &Factor) -> Picture {
    let mut wrong = picture.clone();
    for (i, (mean, error)) in wrong.mean.iter_mut().zip(&picture.error).enumerate() {
        let (pixel, channel) = (i / picture.channels, i % picture.channels);
        if *error > 1e-6 * *mean {
            *mean *= factor(pixel / picture.columns, pixel % picture.columns, channel);
        }
    }
    wrong
}

/// Asserts that a picture is refused.
#[track_caller]
fn refuse(what: &str, ours: &Picture, theirs: &Picture) {
    assert!(!judge(what, ours, theirs).holds(f64::INFINITY), "{what}: accepted");
}

#[test]
fn wrong_values_are_refused() {
    let theirs = recorded(Variant::Diffuse);
    assert!(judge("as it is", diffuse(), &spoilt(&theirs, &|_, _, _| 1.0)).holds(ERROR));
    let block = |row, column| (8..12).contains(&row) && (12..16).contains(&column);
    let wrong: [(&str, &Factor); 5] = [
        ("3 % too bright", &|_, _, _| 1.03),
        ("3 % too dark", &|_, _, _| 0.97),
        ("blue 5 % too bright", &|_, _, channel| if channel == 2 { 1.05 } else { 1.0 }),
        ("one block 20 % too bright", &move |row, column, _| if block(row, column) { 1.2 } else { 1.0 }),
        ("one block 20 % too dark", &move |row, column, _| if block(row, column) { 0.8 } else { 1.0 }),
    ];
    for (what, factor) in wrong {
        refuse(what, diffuse(), &spoilt(&theirs, factor));
    }
}

#[test]
fn wrong_errors_are_refused() {
    let with_errors = |picture: &Picture, factor: f64| {
        let error = picture.error.iter().map(|e| e * factor).collect();
        Picture { error, ..picture.clone() }
    };
    let theirs = recorded(Variant::Diffuse);
    refuse("errors halved", &with_errors(diffuse(), 0.5), &with_errors(&theirs, 0.5));
    refuse("errors doubled", &with_errors(diffuse(), 2.0), &with_errors(&theirs, 2.0));
}

/// A picture upside down, or with left and right swapped.
fn mirrored(picture: &Picture, upside_down: bool) -> Picture {
    let mut mirrored = picture.clone();
    for i in 0..picture.mean.len() {
        let (pixel, channel) = (i / picture.channels, i % picture.channels);
        let (row, column) = (pixel / picture.columns, pixel % picture.columns);
        let (row, column) = match upside_down {
            true => (picture.rows - 1 - row, column),
            false => (row, picture.columns - 1 - column),
        };
        let from = (row * picture.columns + column) * picture.channels + channel;
        (mirrored.mean[i], mirrored.error[i]) = (picture.mean[from], picture.error[from]);
    }
    mirrored
}

#[test]
fn other_scenes_and_orientations_are_refused() {
    let theirs = recorded(Variant::Diffuse);
    refuse("glass for diffuse", diffuse(), &recorded(Variant::Glass));
    refuse("upside down", diffuse(), &mirrored(&theirs, true));
    refuse("left and right swapped", diffuse(), &mirrored(&theirs, false));
}

#[test]
fn other_shapes_cannot_be_compared() {
    let wide = ours(Variant::Diffuse, 3, 2, 1);
    assert!(compare(diffuse(), &wide).is_err() && compare(&wide, diffuse()).is_err());
}
