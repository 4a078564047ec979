//! Sensors in enclosures of uniform radiance.

use raysect::prelude::*;

use super::measure::{Quantity, pixels};
use super::scenes::{Bench, ball, dome, world, wrong};
use super::{Case, Reading};

pub(super) fn measure(case: &Case, bench: Bench) -> Option<Result<Reading, String>> {
    Some(match case.kind.as_str() {
        "sensor_in_furnace" => return in_furnace(case, bench).transpose(),
        "sensor_in_glass" => in_glass(case, bench),
        "fibre_acceptance" => fibre(case, bench),
        _ => return None,
    })
}

/// What a case wants to know: "radiance of any pixel" and the like.
fn quantity(case: &Case) -> Result<Quantity, String> {
    let text = case.text("quantity")?;
    match text.split(' ').next() {
        Some("radiance") => Ok(Quantity::Radiance),
        Some("power") => Ok(Quantity::Power),
        _ => Err(format!("quantity: nothing is known as '{text}'")),
    }
}

/// The pixel that is farthest from what all should read.
fn worst<S: Sensor>(
    case: &Case,
    bench: Bench,
    scene: &World,
    observer: Observer<S>,
) -> Result<Reading, String> {
    let place = translate(0.1, 0.2, 0.3) * rotate(10.0, 20.0, 30.0);
    let all = pixels(bench, scene, observer.transform(place), quantity(case)?)?;
    let off = |r: &Reading| (r.mean - case.expected).abs();
    let worst = all.into_iter().max_by(|a, b| off(a).total_cmp(&off(b)));
    worst.ok_or_else(|| "the sensor has no pixels".to_owned())
}

/// A cube whose half size a case gives; it has twelve triangles.
fn cube(case: &Case) -> Result<MeshData, String> {
    MeshData::cube(case.number("half_size")?).map_err(wrong)
}

/// The reading of a sensor of a name; none for a name that nothing here knows.
fn in_furnace(case: &Case, bench: Bench) -> Result<Option<Reading>, String> {
    let scene = world([dome(1.0)?])?;
    let found = match case.text("sensor")?.as_str() {
        "pixel" => {
            let pixel = Pixel::new(case.number("x_width")?, case.number("y_width")?);
            worst(case, bench, &scene, pixel.map_err(wrong)?)
        }
        "ccd" => {
            let ccd = CcdArray::new(case.pixels()?, case.number("width")?);
            worst(case, bench, &scene, ccd.map_err(wrong)?)
        }
        "fibre_optic" => {
            let fibre = FibreOptic::new(case.number("acceptance_deg")?, case.number("radius")?);
            worst(case, bench, &scene, fibre.map_err(wrong)?)
        }
        "mesh_pixel" => worst(case, bench, &scene, MeshPixel::new(&cube(case)?).map_err(wrong)?),
        "mesh_camera" => worst(case, bench, &scene, MeshCamera::new(&cube(case)?).map_err(wrong)?),
        "pinhole" => {
            let camera = PinholeCamera::new(case.pixels()?, case.number("fov_deg")?);
            worst(case, bench, &scene, camera.map_err(wrong)?)
        }
        "orthographic" => {
            let camera = OrthographicCamera::new(case.pixels()?, case.number("width")?);
            worst(case, bench, &scene, camera.map_err(wrong)?)
        }
        "sight_line" => worst(case, bench, &scene, SightLine::new()),
        _ => return Ok(None),
    };
    found.map(Some)
}

fn in_glass(case: &Case, bench: Bench) -> Result<Reading, String> {
    let side = case.number("side")?;
    let radius = 100.0 * side;
    let glass = bench.glass(case.number("n")?, 1.0)?;
    let scene = world([dome(radius)?, ball([0.0; 3], radius, glass)?])?;
    let found = pixels(bench, &scene, Pixel::new(side, side).map_err(wrong)?, quantity(case)?)?;
    Ok(found[0])
}

fn fibre(case: &Case, bench: Bench) -> Result<Reading, String> {
    let fibre = FibreOptic::new(case.number("deg")?, case.number("a")?).map_err(wrong)?;
    Ok(pixels(bench, &world([dome(1.0)?])?, fibre, Quantity::Power)?[0])
}
