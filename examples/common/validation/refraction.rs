//! Reflection and transmission by flat pieces of glass.

use raysect::core::Node;
use raysect::optical::Optics;
use raysect::prelude::*;

use super::measure::along;
use super::scenes::{Bench, ball, cuboid, lamp, tilted, times, world, wrong};
use super::{Case, Reading};

pub(super) fn measure(case: &Case, bench: Bench) -> Option<Result<Reading, String>> {
    Some(match case.kind.as_str() {
        "dielectric_R" => reflectance(case, bench),
        "critical_angle" => critical_angle(case, bench),
        "slab_T" => slab(case, bench),
        _ => return None,
    })
}

/// A lamp that encloses everything.
fn sky() -> Result<Node<Optics>, String> {
    ball([0.0; 3], 3000.0, lamp())
}

/// Glass that fills the lower half of space, with something black in it.
fn reflectance(case: &Case, bench: Bench) -> Result<Reading, String> {
    let glass = bench.glass(case.number("n")?, 1.0)?;
    let glass = cuboid([-400.0, -400.0, -200.0], [400.0, 400.0, 0.0])?.material(glass);
    let sink = cuboid([-390.0, -390.0, -190.0], [390.0, 390.0, -1.0])?.material(AbsorbingSurface);
    let [x, y, z] = tilted(case.number("deg")?);
    along(bench, &world([glass, sink, sky()?])?, times([x, y, -z], -3.0), [x, y, -z])
}

/// The angle [deg] up to which rays leave glass, by bisection.
fn critical_angle(case: &Case, bench: Bench) -> Result<Reading, String> {
    let glass = Dielectric::new(case.number("n")?, 1.0).map_err(wrong)?.transmission_only(true);
    let glass = cuboid([-400.0, -400.0, -200.0], [400.0, 400.0, 0.0])?.material(glass);
    let scene = world([glass, sky()?])?;
    let passes = |degrees: f64| {
        let direction = tilted(degrees);
        let once = Ray::new(Point3D::from(times(direction, -1.0)), Vector3D::from(direction));
        let found = once.spectrum(500.0, 501.0, 1).seed(bench.seed).trace(&scene).map_err(wrong)?;
        Ok::<_, String>(found.samples()[0] > 0.0)
    };
    let (mut low, mut high) = (0.0, 89.9);
    if !passes(low)? || passes(high)? {
        return Err("no angle parts rays that pass from others".to_owned());
    }
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if passes(middle)? { low = middle } else { high = middle }
    }
    Ok(Reading::exact(low))
}

fn slab(case: &Case, bench: Bench) -> Result<Reading, String> {
    let thickness = case.number("thickness")?;
    let glass = bench.glass(case.number("n")?, case.number("trans")?)?;
    let slab = cuboid([-400.0, -400.0, 0.0], [400.0, 400.0, thickness])?.material(glass);
    let above = cuboid([-900.0, -900.0, 50.0 + thickness], [900.0, 900.0, 60.0 + thickness])?;
    let direction = tilted(case.number("deg")?);
    let [x, y, z] = times(direction, -3.0);
    along(bench, &world([slab, above.material(lamp())])?, [x + 0.3, y + 0.2, z], direction)
}
