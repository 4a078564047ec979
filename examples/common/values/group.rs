//! How values of a group are compared.

use crate::finding::Finding;
use crate::json::same_length;

/// A value is near zero below this share of the largest of its group.
const NEAR_ZERO: f64 = 1e-3;

/// Compares our values with recorded ones: relative to the recorded value, or to the largest of the group if the
/// value is near zero.
pub(crate) fn compare_group(
    finding: &mut Finding,
    name: &str,
    ours: &[f64],
    recorded: &[f64],
    tolerance: f64,
) -> Result<(), String> {
    same_length("ours", ours.len(), name, recorded.len())?;
    let largest = recorded.iter().fold(0.0, |largest: f64, v| largest.max(v.abs()));
    for (number, (&ours, &recorded)) in ours.iter().zip(recorded).enumerate() {
        let size = if recorded.abs() < NEAR_ZERO * largest { largest } else { recorded.abs() };
        let difference = (ours - recorded).abs();
        // A group of zeros has no size: any difference is one.
        let error = if difference == 0.0 { 0.0 } else { difference / size };
        finding
            .measure(error, tolerance, || format!("{name}, value {number}: {ours:?}, recorded {recorded:?}"));
    }
    Ok(())
}
