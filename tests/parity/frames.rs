//! Our pictures, and the recorded ones of the same pixels.

use std::path::PathBuf;
use std::sync::OnceLock;

use crate::comparison::{Comparison, Picture, compare};
use crate::cornell::Variant;
use crate::reference;

/// Median relative error of our pictures.
pub(crate) const ERROR: f64 = 0.03;
/// Bins of the recorded frames.
pub(crate) const BINS: usize = 15;

/// The recorded frame of a variant.
pub(crate) fn recorded(variant: Variant) -> Picture {
    let name = match variant {
        Variant::Glass => "cornell_glass.npz",
        Variant::Diffuse => "cornell_diffuse.npz",
    };
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/data").join(name);
    assert_eq!(reference::variant_of(&path), Some(variant));
    reference::load(&path).unwrap()
}

/// Our frame of so many columns and rows.
pub(crate) fn ours(variant: Variant, columns: usize, rows: usize, seed: u64) -> Picture {
    reference::render(variant, columns, rows, BINS, seed, ERROR).unwrap()
}

/// Our frame of the diffuse box of the size of the recorded one, rendered once for all tests.
pub(crate) fn diffuse() -> &'static Picture {
    static PICTURE: OnceLock<Picture> = OnceLock::new();
    PICTURE.get_or_init(|| ours(Variant::Diffuse, 24, 24, 1))
}

/// Compares two pictures, and writes what is found.
pub(crate) fn judge(what: &str, ours: &Picture, theirs: &Picture) -> Comparison {
    let found = compare(ours, theirs).unwrap();
    println!("{what}: {found}");
    for (criterion, holds) in found.criteria(ERROR) {
        println!("  {} {criterion}", if holds { "ok  " } else { "FAIL" });
    }
    found
}

/// Asserts that two pictures agree.
#[track_caller]
pub(crate) fn assert_agree(what: &str, ours: &Picture, theirs: &Picture) {
    let found = judge(what, ours, theirs);
    let failures = found.criteria(ERROR).into_iter().filter(|(_, holds)| !holds);
    assert!(found.holds(ERROR), "{what}: {:?}", failures.collect::<Vec<_>>());
}

#[test]
fn glass_agrees_with_the_recorded_frame() {
    let theirs = recorded(Variant::Glass);
    assert_agree("glass", &ours(Variant::Glass, theirs.columns, theirs.rows, 1), &theirs);
}

#[test]
fn diffuse_agrees_with_the_recorded_frame() {
    assert_agree("diffuse", diffuse(), &recorded(Variant::Diffuse));
}
