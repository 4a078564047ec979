//! What lamps send to points and areas: configuration factors.

use raysect::observer::Target;
use raysect::prelude::*;

use super::measure::{Quantity, irradiance, pixels};
use super::scenes::{Bench, ball, cuboid, disk_lamp, lamp, tilted, times, world, wrong};
use super::{Case, Reading};

pub(super) fn measure(case: &Case, bench: Bench) -> Option<Result<Reading, String>> {
    Some(match case.kind.as_str() {
        "disc_disc_power" => disks(case, bench, ["r1", "r2", "h"]),
        "pinhole_etendue" => disks(case, bench, ["r", "r", "d"]),
        "point_disc" => point_disk(case, bench),
        "point_offaxis_disc" => offset_disk(case, bench),
        "point_sphere" => point_sphere(case, bench),
        "point_volume_sphere" => point_volume(case, bench),
        "rect_rect_parallel" => rectangles(case, bench),
        "wall_from_floor" => wall(case, bench),
        "sphere_total_power" => total_power(case, bench),
        _ => return None,
    })
}

fn sphere_target(height: f64, radius: f64) -> Result<Target, String> {
    Target::sphere(Point3D::new(0.0, 0.0, height), radius).map_err(wrong)
}

/// A disk that looks at another one on its axis.
fn disks(case: &Case, bench: Bench, [first, second, distance]: [&str; 3]) -> Result<Reading, String> {
    let (first, second) = (case.number(first)?, case.number(second)?);
    let distance = case.number(distance)?;
    let scene = world([disk_lamp(second, distance, first)?])?;
    let disk = FibreOptic::new(90.0, first).map_err(wrong)?;
    let aimed = disk.targets([sphere_target(distance, second)?], 0.9).map_err(wrong)?;
    Ok(pixels(bench, &scene, aimed, Quantity::Power)?[0])
}

fn point_disk(case: &Case, bench: Bench) -> Result<Reading, String> {
    let (radius, height) = (case.number("R")?, case.number("h")?);
    let scene = world([disk_lamp(radius, height, radius)?])?;
    irradiance(bench, &scene, AffineMatrix3D::IDENTITY, sphere_target(height, radius)?, height)
}

fn offset_disk(case: &Case, bench: Bench) -> Result<Reading, String> {
    let (offset, radius, height) = (case.number("a")?, case.number("r")?, case.number("h")?);
    let scene = world([disk_lamp(radius, height, offset.abs() * 1.01)?])?;
    let target = Target::sphere(Point3D::new(-offset, 0.0, height), radius).map_err(wrong)?;
    irradiance(bench, &scene, translate(offset, 0.0, 0.0), target, height)
}

/// The space of a small plane at the origin that looks at a ball on the z axis, turned away by an angle [deg].
fn turned(degrees: f64) -> AffineMatrix3D {
    rotate_y(degrees)
}

/// A ball at a distance and an angle off the z axis, in the space of the plane.
fn ball_target(case: &Case, radius: &str, degrees: f64) -> Result<Target, String> {
    let centre = times(tilted(-degrees), case.number("d")?);
    Target::sphere(Point3D::from(centre), case.number(radius)?).map_err(wrong)
}

fn point_sphere(case: &Case, bench: Bench) -> Result<Reading, String> {
    let (radius, distance) = (case.number("R")?, case.number("d")?);
    let tilt = case.number_or("tilt_deg", 0.0)?;
    let scene = world([ball([0.0, 0.0, distance], radius, lamp())?])?;
    irradiance(bench, &scene, turned(tilt), ball_target(case, "R", tilt)?, distance - radius)
}

fn point_volume(case: &Case, bench: Bench) -> Result<Reading, String> {
    let (radius, distance) = (case.number("r")?, case.number("d")?);
    let scene = world([ball([0.0, 0.0, distance], radius, UniformVolume::emitter(1.0))?])?;
    irradiance(bench, &scene, turned(0.0), ball_target(case, "r", 0.0)?, distance - radius)
}

fn rectangles(case: &Case, bench: Bench) -> Result<Reading, String> {
    let (width, depth, distance) = (case.number("a")?, case.number("b")?, case.number("c")?);
    let (x, y) = (0.5 * width, 0.5 * depth);
    let sheet = cuboid([-x, -y, distance], [x, y, distance])?.material(lamp());
    let edges = [Vector3D::new(width, 0.0, 0.0), Vector3D::new(0.0, depth, 0.0)];
    let target = Target::rectangle(Point3D::new(-x, -y, distance), edges).map_err(wrong)?;
    let plate = Pixel::new(width, depth).map_err(wrong)?.targets([target], 0.9).map_err(wrong)?;
    Ok(pixels(bench, &world([sheet])?, plate, Quantity::Power)?[0])
}

/// The wall is the plane y = 0, the floor the plane z = 0 with a corner at the origin.
fn wall(case: &Case, bench: Bench) -> Result<Reading, String> {
    let (depth, width, height) = (case.number("a")?, case.number("b")?, case.number("c")?);
    let floor = cuboid([0.0, 0.0, 0.0], [width, depth, 0.0])?.material(lamp());
    // In the space of the point z is the depth, and y points upwards.
    let place = AffineMatrix3D::from_row_major([
        1.0, 0.0, 0.0, 0.0, //
        0.0, 0.0, 1.0, 0.0, //
        0.0, 1.0, 0.0, height, //
        0.0, 0.0, 0.0, 1.0,
    ])
    .map_err(wrong)?;
    let edges = [Vector3D::new(width, 0.0, 0.0), Vector3D::new(0.0, 0.0, depth)];
    let target = Target::rectangle(Point3D::new(0.0, -height, 0.0), edges).map_err(wrong)?;
    irradiance(bench, &world([floor])?, place, target, height)
}

/// Six faces of a cube look at a ball in its middle.
fn total_power(case: &Case, bench: Bench) -> Result<Reading, String> {
    let (radius, side) = (case.number("r")?, case.number("cube")?);
    let sphere = if case.flag("volume")? {
        ball([0.0; 3], radius, UniformVolume::emitter(1.0))?
    } else {
        ball([0.0; 3], radius, lamp())?
    };
    let scene = world([sphere])?;
    let turns =
        [rotate_x(0.0), rotate_x(90.0), rotate_x(180.0), rotate_x(270.0), rotate_y(90.0), rotate_y(-90.0)];
    let (mut power, mut variance) = (0.0, 0.0);
    for (turn, seed) in turns.into_iter().zip(0..) {
        let face = Pixel::new(side, side).map_err(wrong)?;
        let target = sphere_target(0.5 * side, radius)?;
        let face = face.targets([target], 0.9).map_err(wrong)?;
        let bench = Bench { seed: bench.seed.wrapping_add(seed << 32), ..bench };
        let face = face.transform(turn * translate(0.0, 0.0, -0.5 * side));
        let found = pixels(bench, &scene, face, Quantity::Power)?[0];
        power += found.mean;
        variance += found.error * found.error;
    }
    Ok(Reading::of(power, variance.sqrt()))
}
