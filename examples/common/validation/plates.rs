//! A diffuse plate at the origin and what lights it.

use raysect::core::Node;
use raysect::optical::Optics;
use raysect::prelude::*;

use super::measure::along;
use super::scenes::{Bench, ball, cuboid, lamp, tilted, times, world};
use super::{Case, Reading};

pub(super) fn measure(case: &Case, bench: Bench) -> Option<Result<Reading, String>> {
    Some(match case.kind.as_str() {
        "lambert_plate" => bare(case, bench),
        "null_box_plate" => boxed(case, bench),
        "absorber_plate" => absorbed(case, bench),
        "volume_lit_plate" => glowing(case, bench),
        _ => return None,
    })
}

/// Where a plate is looked at from.
const EYE: [f64; 3] = [-0.8, 0.3, 1.1];

fn plate(case: &Case, bench: Bench) -> Result<Node<Optics>, String> {
    let shape = cuboid([-1.0, -1.0, -0.01], [1.0, 1.0, 0.0])?;
    Ok(shape.material(bench.lambert(case.number("rho")?)))
}

/// The ball of the case of a plate without anything else, unless the case says otherwise.
fn lamp_of(case: &Case) -> Result<Node<Optics>, String> {
    let (radius, distance) = (case.number_or("r", 0.5)?, case.number_or("D", 10.0)?);
    ball(times(tilted(case.number_or("deg", 60.0)?), distance), radius, lamp())
}

fn look(bench: Bench, nodes: impl IntoIterator<Item = Node<Optics>>) -> Result<Reading, String> {
    along(bench, &world(nodes)?, EYE, times(EYE, -1.0))
}

fn bare(case: &Case, bench: Bench) -> Result<Reading, String> {
    look(bench, [plate(case, bench)?, lamp_of(case)?])
}

fn boxed(case: &Case, bench: Bench) -> Result<Reading, String> {
    let nothing = cuboid([-0.5; 3], [0.5; 3])?.material(NullMaterial);
    look(bench, [plate(case, bench)?, lamp_of(case)?, nothing])
}

/// The viewer stands outside the absorber.
fn absorbed(case: &Case, bench: Bench) -> Result<Reading, String> {
    let radius = case.number("radius")?;
    let absorption = -case.number("transmission_per_m")?.ln();
    let absorber = ball([0.0; 3], radius, UniformVolume::new().absorption(absorption))?;
    let scene = world([plate(case, bench)?, lamp_of(case)?, absorber])?;
    let eye = times(EYE, 2.0 * radius);
    along(bench, &scene, eye, times(eye, -1.0))
}

fn glowing(case: &Case, bench: Bench) -> Result<Reading, String> {
    let (radius, distance) = (case.number_or("r", 0.5)?, case.number_or("d", 2.0)?);
    let glow = ball([0.0, 0.0, distance], radius, UniformVolume::emitter(1.0))?;
    look(bench, [plate(case, bench)?, glow])
}
