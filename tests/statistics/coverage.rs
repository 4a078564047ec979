//! 68 % of the intervals of one error to each side, and 95 % of those of 1.96 errors, must cover the truth.
//!
//! A standard error makes such intervals where the mean is normally distributed and the error well known. The samples
//! of a pixel of this scene are skewed (γ = 5 in the median: the ceiling is some twenty times brighter beside the lamp
//! than elsewhere, and few paths come there). Frames make errors longer by what neighbours and the skewness of their
//! samples tell; those that the samples of a pixel alone have miss what they should cover after 64 samples. Whatever the
//! distribution, the mean square of the errors, before they are made longer, must be that of the differences from the
//! truth: this is asked of all elements after any number of samples; and sums over the picture must cover at once.

use crate::pictures::{Kind, Stage, observe};
use crate::score::Scores;

/// By how much error bars are shrunk, and averages shifted by a share of them, for the negative controls.
const SHRUNK: f64 = 0.9;
/// A thousand totals have a scatter of 1.5 % themselves and cannot tell 10 %.
const SHRUNK_TOTAL: f64 = 0.8;
const SHIFTED: f64 = 0.5;

/// Asserts that intervals cover what they should, and that those of error bars too short do not.
#[track_caller]
fn assert_covers(what: &str, scores: &Scores, shrink: f64) {
    println!("{what:<42} {}", scores.coverage(1.0));
    assert!(scores.coverage(1.0).holds(), "{what}: {}", scores.coverage(1.0));
    let (shrunk, shifted) = (scores.coverage(shrink), scores.shifted(SHIFTED).coverage(1.0));
    assert!(!shrunk.holds(), "{what}, shrunk: {shrunk}");
    assert!(!shifted.holds(), "{what}, shifted: {shifted}");
}

/// Asserts that errors are as large as differences in the mean square, and that shrunk ones are not.
#[track_caller]
fn assert_calibrated(what: &str, kind: &Kind) {
    println!("{what:<42} {}; all: {}", kind.scatter, kind.all.coverage(1.0));
    assert!(kind.scatter.holds(), "{what}: {}", kind.scatter);
    assert!(!kind.scatter.with_errors_times(SHRUNK).holds(), "{what}, shrunk");
}

/// Asserts what holds of the elements after any number of samples, and once more of those that are nearly normal after a
/// few hundred.
#[track_caller]
fn assert_elements(samples: u64, stage: &Stage) {
    for (name, kind) in stage.kinds() {
        assert_calibrated(&format!("{samples} samples, {name}"), kind);
        assert_covers(&format!("{samples} samples, {name}, all"), &kind.all, SHRUNK);
        if samples >= 256 {
            assert_covers(&format!("{samples} samples, {name}, by Cochran's rule"), &kind.normal, SHRUNK);
        }
    }
}

/// Asserts it of the total.
#[track_caller]
fn assert_total(samples: u64, stage: &Stage) {
    assert_covers(&format!("{samples} samples, total"), &stage.total, SHRUNK_TOTAL);
    assert_covers(&format!("{samples} samples, total in bin 7"), &stage.bin_total, SHRUNK_TOTAL);
}

#[test]
fn after_64_samples() {
    let [stage] = observe(8, [(64, 1500)]);
    assert_elements(64, &stage);
    assert_total(64, &stage);
}

#[test]
fn after_256_and_1024_samples() {
    // Fewer seeds for 1024 samples, for want of time.
    let [after_256, after_1024] = observe(8, [(256, 400), (1024, 100)]);
    assert_elements(256, &after_256);
    assert_elements(1024, &after_1024);
}

#[test]
fn totals_after_256_and_1024_samples() {
    // Fewer pixels of the same scene, so that there is time for 1500 seeds: 200 totals tell too little.
    let [stage] = observe(4, [(256, 1500)]);
    assert_total(256, &stage);
    let [stage] = observe(2, [(1024, 1500)]);
    assert_total(1024, &stage);
}
