//! Spectra along single rays through described scenes in which nothing is left to chance.

use raysect::optical::library::{d65_white, schott};
use raysect::prelude::*;
use serde_json::Value;

use super::grid::numbers_of;
use super::group::compare_group;
use super::{Report, Section};
use crate::json::{field, index, list, number, numbers, text};

/// Compares each ray with the tolerance of its kind of scene.
pub(crate) fn compare(section: &Section<'_>, report: &mut Report) -> Result<(), String> {
    let cases = list(section.content, |case| Ok(case.clone()))?;
    for (position, case) in cases.iter().enumerate() {
        compare_case(section, position, case, report).map_err(|e| format!("entry {position}: {e}"))?;
    }
    Ok(())
}

fn compare_case(
    section: &Section<'_>,
    position: usize,
    case: &Value,
    report: &mut Report,
) -> Result<(), String> {
    let scene = field(case, "scene", |v| Ok(v.clone()))?;
    let kind = field(&scene, "kind", text)?;
    let Some(world) = world(&kind, &scene).map_err(|e| format!("scene: {e}"))? else {
        let part = format!("{}/{kind}", section.name);
        if !report.skipped.contains(&part) {
            report.skipped.push(part);
        }
        return Ok(());
    };
    let (min, max) = (field(case, "min", number)?, field(case, "max", number)?);
    let bins = field(case, "bins", index)? as usize;
    let [x, y, z] = field(case, "origin", numbers::<3>)?;
    let [dx, dy, dz] = field(case, "direction", numbers::<3>)?;
    let direction = Vector3D::new(dx, dy, dz).normalise().map_err(|e| format!("direction: {e}"))?;
    let ray = Ray::new(Point3D::new(x, y, z), direction).spectrum(min, max, bins);
    let ours = ray.trace(&world).map_err(wrong)?.samples().to_vec();
    let mut finding = section.finding(format!("{position} {kind}"));
    let tolerance = field(section.tolerance, &kind, number)?;
    compare_group(&mut finding, "samples", &ours, &numbers_of(case, "samples")?, tolerance)?;
    report.findings.push(finding);
    Ok(())
}

fn wrong(error: impl std::fmt::Display) -> String {
    error.to_string()
}

/// The scene of a kind; none for a kind that nothing here can build.
fn world(kind: &str, scene: &Value) -> Result<Option<World>, String> {
    let mut world = World::new();
    match kind {
        "checkerboard" => {
            let white = |key: &str| field(scene, key, spectrum);
            let (first, second) = (field(scene, "scale_a", number)?, field(scene, "scale_b", number)?);
            let board = Checkerboard::new(field(scene, "width", number)?).map_err(wrong)?;
            let board = board.spectra((white("a")?, first), (white("b")?, second));
            world.add(field(scene, "box", cuboid)?.material(board)).map_err(wrong)?;
        }
        "transmission-slab" => {
            let glass = field(scene, "glass", |v| schott(&text(v)?).map_err(wrong))?;
            let only =
                field(scene, "transmission_only", |v| v.as_bool().ok_or("true or false is needed".into()))?;
            let thickness = field(scene, "thickness", number)?;
            let (low, high) = (Point3D::new(-5.0, -5.0, 0.0), Point3D::new(5.0, 5.0, thickness));
            let slab = Cuboid::new(low, high).map_err(wrong)?;
            world.add(slab.material(glass.transmission_only(only))).map_err(wrong)?;
            add_emitter(&mut world, scene)?;
        }
        _ => return Ok(None),
    }
    Ok(Some(world))
}

/// The sphere that shines on the rest from all around.
fn add_emitter(world: &mut World, scene: &Value) -> Result<(), String> {
    field(scene, "emitter", |emitter| {
        let sphere = Sphere::new(field(emitter, "radius", number)?).map_err(wrong)?;
        let (spectrum, scale) = (field(emitter, "spectrum", spectrum)?, field(emitter, "scale", number)?);
        world.add(sphere.material(UniformSurfaceEmitter::new(spectrum, scale))).map_err(wrong)?;
        Ok(())
    })
}

fn spectrum(value: &Value) -> Result<InterpolatedSf, String> {
    match text(value)?.as_str() {
        "d65" => Ok(d65_white()),
        other => Err(format!("no spectrum is known as '{other}'")),
    }
}

/// Of two opposite corners.
fn cuboid(value: &Value) -> Result<Cuboid, String> {
    let corners = list(value, numbers::<3>)?;
    let [[a, b, c], [d, e, f]] = corners[..] else { return Err("two corners are needed".to_owned()) };
    Cuboid::new(Point3D::new(a, b, c), Point3D::new(d, e, f)).map_err(wrong)
}
