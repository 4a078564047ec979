//! Spectra along single rays through described scenes in which nothing is left to chance.

use raysect::optical::library::{d65_white, metal_index, schott};
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
    // As recorded: one index for all bins.
    let settings = PathSettings::default().dispersion(Dispersion::Mean);
    let ray = Ray::new(Point3D::new(x, y, z), direction).spectrum(min, max, bins).settings(settings);
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
        "mirror-box" => {
            let name = field(scene, "metal", text)?;
            let (n, k) = metal_index(&capitalised(&name)).map_err(wrong)?;
            // As recorded: by the law for a large index.
            let metal = Conductor::new(n, k).fresnel(FresnelLaw::LargeIndex);
            world.add(field(scene, "box", cuboid)?.material(metal)).map_err(wrong)?;
            add_emitter(&mut world, scene)?;
        }
        "mirror-table" => {
            let wavelengths = numbers_of(scene, "wavelengths")?;
            let table =
                |key: &str| InterpolatedSf::new(wavelengths.clone(), numbers_of(scene, key)?).map_err(wrong);
            let law = match field(scene, "fresnel", text)?.as_str() {
                "raysect-approximation" => FresnelLaw::LargeIndex,
                "exact" => FresnelLaw::Exact,
                other => return Err(format!("no law of reflection is known as '{other}'")),
            };
            let metal = Conductor::new(table("n")?, table("k")?).fresnel(law);
            world.add(field(scene, "box", cuboid)?.material(metal)).map_err(wrong)?;
            add_emitter(&mut world, scene)?;
        }
        "volume-emitter" => {
            let (emission, scale) = (field(scene, "emission", spectrum)?, field(scene, "scale", number)?);
            let scaled = move |wavelength: f64| scale * emission.evaluate(wavelength);
            add_volume(&mut world, scene, UniformVolume::emitter(scaled))?;
        }
        "unity-volume" => add_volume(&mut world, scene, UniformVolume::emitter(1.0))?,
        "debug-light" => {
            let [x, y, z] = field(scene, "light_direction", numbers::<3>)?;
            let light = DebugLight::new(Vector3D::new(x, y, z)).map_err(wrong)?;
            let light = light.intensity(field(scene, "intensity", number)?).map_err(wrong)?;
            let sphere = Sphere::new(field(scene, "sphere_radius", number)?).map_err(wrong)?;
            world.add(sphere.material(light)).map_err(wrong)?;
        }
        _ => return Ok(None),
    }
    Ok(Some(world))
}

/// The shape of a recorded volume, by its name, filled and put in its place.
fn add_volume(world: &mut World, scene: &Value, volume: UniformVolume) -> Result<(), String> {
    let place = field(scene, "transform", |v| {
        let m = numbers::<16>(v)?;
        AffineMatrix3D::from_row_major(m).map_err(wrong)
    })?;
    let node = match field(scene, "shape", text)?.as_str() {
        "sphere" => Sphere::new(1.0).map_err(wrong)?.material(volume),
        "box" => Cuboid::new(Point3D::new(-1.0, -0.7, -0.5), Point3D::new(0.8, 0.9, 1.0))
            .map_err(wrong)?
            .material(volume),
        "cylinder" => Cylinder::new(0.8, 1.5).map_err(wrong)?.material(volume),
        "cone" => Cone::new(0.9, 1.4).map_err(wrong)?.material(volume),
        "subtract" => {
            let hole = Cylinder::new(0.4, 4.0).map_err(wrong)?.placed(translate(0.0, 0.0, -2.0));
            Subtract::new(Sphere::new(1.0).map_err(wrong)?, hole).map_err(wrong)?.material(volume)
        }
        other => return Err(format!("no shape is known as '{other}'")),
    };
    world.add(node.transform(place)).map_err(wrong)?;
    Ok(())
}

fn capitalised(name: &str) -> String {
    let mut letters = name.chars();
    letters
        .next()
        .map(|first| first.to_uppercase().collect::<String>() + letters.as_str())
        .unwrap_or_default()
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
