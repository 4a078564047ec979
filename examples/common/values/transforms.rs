//! Rotations about axes, by angles and by directions, inverses, quaternions. Angles in degrees, matrices row by row.

use raysect::math::{
    AffineMatrix3D, MathError, Quaternion, Vector3D, rotate, rotate_basis, rotate_vector, rotate_x, rotate_y,
    rotate_z,
};
use serde_json::Value;

use super::group::compare_group;
use super::{Report, Section};
use crate::finding::Finding;
use crate::json::{field, list, number, numbers};

/// What a case is made of, and what is compared.
const KNOWN: [&str; 17] = [
    "yaw",
    "pitch",
    "roll",
    "angle",
    "axis",
    "forward",
    "up",
    "rotate",
    "rotate_x",
    "rotate_y",
    "rotate_z",
    "rotate_vector",
    "rotate_basis",
    "m",
    "m_inverse",
    "quaternion_xyzs",
    "quaternion_matrix",
];

/// Compares a list of cases.
pub(crate) fn compare(section: &Section<'_>, report: &mut Report) -> Result<(), String> {
    let tolerance = section.one_tolerance()?;
    for (number, case) in list(section.content, |case| Ok(case.clone()))?.iter().enumerate() {
        let mut finding = section.finding(number);
        compare_case(case, tolerance, &mut finding).map_err(|e| format!("entry {number}: {e}"))?;
        section.skip_others(case, &KNOWN, report);
        report.findings.push(finding);
    }
    Ok(())
}

fn compare_case(case: &Value, tolerance: f64, finding: &mut Finding) -> Result<(), String> {
    let angle = |key| field(case, key, number);
    let vector = |key| field(case, key, numbers::<3>).map(|[x, y, z]| Vector3D::new(x, y, z));
    let (yaw, pitch, roll, turn) = (angle("yaw")?, angle("pitch")?, angle("roll")?, angle("angle")?);
    let (axis, forward, up) = (vector("axis")?, vector("forward")?, vector("up")?);
    let m = field(case, "m", numbers::<16>)?;
    let quaternion = Quaternion::from_axis_angle(axis, turn).map_err(refused("quaternion_xyzs"))?;

    let matrices = [
        ("rotate", Ok(rotate(yaw, pitch, roll))),
        ("rotate_x", Ok(rotate_x(turn))),
        ("rotate_y", Ok(rotate_y(turn))),
        ("rotate_z", Ok(rotate_z(turn))),
        ("rotate_vector", rotate_vector(turn, axis)),
        ("rotate_basis", rotate_basis(forward, up)),
        ("m_inverse", AffineMatrix3D::from_row_major(m).and_then(|m| m.inverse())),
        ("quaternion_matrix", quaternion.to_matrix()),
    ];
    for (name, ours) in matrices {
        let ours = ours.map_err(refused(name))?.to_rows().concat();
        compare_group(finding, name, &ours, &field(case, name, numbers::<16>)?, tolerance)?;
    }
    let name = "quaternion_xyzs";
    let ours = [quaternion.x, quaternion.y, quaternion.z, quaternion.s];
    compare_group(finding, name, &ours, &field(case, name, numbers::<4>)?, tolerance)
}

fn refused(name: &str) -> impl Fn(MathError) -> String {
    move |e| format!("{name}: {e}")
}
