//! Lenses and curved mirrors.

use raysect::prelude::*;

use super::beacon::Beacon;
use super::measure::along;
use super::scenes::{Bench, ball, world, wrong};
use super::{Case, Reading};

pub(super) fn measure(case: &Case, bench: Bench) -> Option<Result<Reading, String>> {
    Some(match case.kind.as_str() {
        "lens_bfl" | "lens_real_ray" => crossing(case, bench),
        "parabola_focus" => focus(case, bench),
        _ => return None,
    })
}

/// Where a ray along the axis of a lens, at a height, crosses the axis: its distance from the back vertex.
///
/// Radii count as those of a biconvex lens: negative ones are concave.
fn crossing(case: &Case, bench: Bench) -> Result<Reading, String> {
    let (front, back) = (case.number("R1")?, case.number("R2")?);
    let (thickness, diameter) = (case.number("t")?, case.number("diameter")?);
    let glass = Dielectric::new(case.number("n")?, 1.0).map_err(wrong)?.transmission_only(true);
    // In the plane y = 0; the back vertex is the origin, the light comes down the z axis.
    let read = |p: Point3D, d: Vector3D| p.x / d.x * d.z - p.z;
    let beacon = ball([0.0; 3], 60.0 * diameter, Beacon(read))?;
    let lens = match (front > 0.0, back > 0.0) {
        (true, true) => BiConvex::new(diameter, thickness, front, back).map_err(wrong)?.material(glass),
        (false, false) => BiConcave::new(diameter, thickness, -front, -back).map_err(wrong)?.material(glass),
        (true, false) => Meniscus::new(diameter, thickness, front, -back).map_err(wrong)?.material(glass),
        (false, true) => {
            return Err("R1, R2: a meniscus is understood with its convex side in front".to_owned());
        }
    };
    along(bench, &world([lens, beacon])?, [case.number("y")?, 0.0, 2.0 * diameter], [0.0, 0.0, -1.0])
}

/// Parallel rays inside a mirrored paraboloid, and the greatest distance of any from the focus.
fn focus(case: &Case, bench: Bench) -> Result<Reading, String> {
    let (radius, height) = (case.number("radius")?, case.number("height")?);
    let focal = radius * radius / (4.0 * height);
    let focus = Point3D::new(0.0, 0.0, height - focal);
    let mirror = Parabola::new(radius, height).map_err(wrong)?.material(PerfectReflectingSurface);
    let read = move |p: Point3D, d: Vector3D| p.vector_to(focus).cross(d).length();
    let small = 0.05 * focal.min(radius);
    let beacon = ball([0.0, 0.0, focus.z], small, Beacon(read))?;
    let scene = world([mirror, beacon])?;
    let mut worst = Reading::exact(0.0);
    for i in 0..20 {
        let (sine, cosine) = (0.9 * f64::from(i)).sin_cos();
        // Past the beacon on the way up, and up to nearly the rim.
        let distance = 1.5 * small + (0.9 * radius - 1.5 * small) * f64::from(i) / 19.0;
        // Below the mirror there, within the solid.
        let bottom = 0.5 * height * (1.0 - (distance / radius).powi(2));
        let bottom = bottom.min(0.1 * height);
        let found = along(bench, &scene, [distance * cosine, distance * sine, bottom], [0.0, 0.0, 1.0])?;
        if found.mean.is_nan() || found.mean > worst.mean {
            worst = found;
        }
    }
    Ok(worst)
}
