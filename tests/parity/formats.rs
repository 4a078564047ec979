//! Pictures that are not square, against parts of square ones.

use std::ops::Range;

use crate::comparison::Picture;
use crate::cornell::Variant;
use crate::frames::{assert_agree, ours, recorded};

/// The part of a picture with these rows and columns.
fn part(picture: &Picture, rows: Range<usize>, columns: Range<usize>) -> Picture {
    let mut part = Picture {
        rows: rows.len(),
        columns: columns.len(),
        channels: picture.channels,
        mean: Vec::new(),
        error: Vec::new(),
    };
    for row in rows {
        let start = (row * picture.columns + columns.start) * picture.channels;
        let range = start..start + columns.len() * picture.channels;
        part.mean.extend_from_slice(&picture.mean[range.clone()]);
        part.error.extend_from_slice(&picture.error[range]);
    }
    part
}

/// A picture of half as many pixels to each side: the averages of four.
fn halved(picture: &Picture) -> Picture {
    let (rows, columns, channels) = (picture.rows / 2, picture.columns / 2, picture.channels);
    let (mut mean, mut error) = (Vec::new(), Vec::new());
    for i in 0..rows * columns * channels {
        let (row, column, channel) = (i / channels / columns, i / channels % columns, i % channels);
        let places = [(0, 0), (0, 1), (1, 0), (1, 1)]
            .map(|(r, c)| ((2 * row + r) * picture.columns + 2 * column + c) * channels + channel);
        mean.push(places.iter().map(|&p| picture.mean[p]).sum::<f64>() / 4.0);
        error.push(places.iter().map(|&p| picture.error[p].powi(2)).sum::<f64>().sqrt() / 4.0);
    }
    Picture { rows, columns, channels, mean, error }
}

#[test]
fn a_wide_picture_is_the_middle_of_the_square_one() {
    let theirs = part(&recorded(Variant::Diffuse), 6..18, 0..24);
    assert_agree("24x12", &ours(Variant::Diffuse, 24, 12, 1), &theirs);
}

#[test]
fn a_tall_picture_is_the_middle_of_the_square_one() {
    let theirs = part(&recorded(Variant::Diffuse), 0..24, 8..16);
    assert_agree("8x24", &ours(Variant::Diffuse, 8, 24, 1), &theirs);
}

#[test]
fn an_odd_number_of_rows_is_centred() {
    // 16 pixels across are 32 of half the size; 9 down are 18, from the 7th of 32 on.
    let square = ours(Variant::Diffuse, 32, 32, 2);
    let expected = halved(&part(&square, 7..25, 0..32));
    let wide = ours(Variant::Diffuse, 16, 9, 1);
    assert_agree("16x9", &wide, &expected);
    // A picture that is off by one small row is not the same.
    let off = halved(&part(&square, 8..26, 0..32));
    let found = crate::frames::judge("16x9, off by half a row", &wide, &off);
    assert!(!found.holds(f64::INFINITY));
}
