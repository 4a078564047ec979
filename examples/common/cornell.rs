//! The Cornell box of Raysect's demonstration: measured walls, a lamp in the ceiling, two blocks.

use std::path::Path;

use raysect::prelude::*;

/// What the two blocks are made of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Variant {
    /// N-BK7.
    Glass,
    /// The white of the walls.
    Diffuse,
}

/// The wall spectra lie in `assets/spectra` of the project.
fn wall(name: &str) -> raysect::Result<SpectralTable> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/spectra").join(name);
    Ok(InterpolatedSf::from_csv(path)?.into())
}

/// Builds the box: 2 m wide, open towards −z, its floor at y = −1.
pub(crate) fn cornell_box(variant: Variant) -> raysect::Result<World> {
    let (white, green, red) =
        (wall("cornell_white.csv")?, wall("cornell_green.csv")?, wall("cornell_red.csv")?);
    let mut world = World::new();
    let room = world.add(Node::group().name("room"))?;
    let side = Cuboid::new(Point3D::new(-1.0, -1.0, 0.0), Point3D::new(1.0, 1.0, 0.0))?;
    for (name, place, colour) in [
        ("back", translate(0.0, 0.0, 1.0), &white),
        ("floor", translate(0.0, -1.0, 0.0) * rotate(0.0, -90.0, 0.0), &white),
        ("ceiling", translate(0.0, 1.0, 0.0) * rotate(0.0, 90.0, 0.0), &white),
        ("left", translate(1.0, 0.0, 0.0) * rotate(-90.0, 0.0, 0.0), &red),
        ("right", translate(-1.0, 0.0, 0.0) * rotate(90.0, 0.0, 0.0), &green),
    ] {
        world.add(side.material(Lambert::new(colour.clone())).transform(place).parent(room).name(name))?;
    }
    let lamp = Cuboid::new(Point3D::new(-0.4, -0.4, -0.01), Point3D::new(0.4, 0.4, 0.0))?;
    let light = InterpolatedSf::new([400.0, 500.0, 600.0, 700.0], [0.0, 8.0, 15.6, 18.4])?;
    let place = translate(0.0, 1.0, 0.0) * rotate(0.0, 90.0, 0.0);
    world.add(
        lamp.material(UniformSurfaceEmitter::new(light, 2.0)).transform(place).parent(room).name("lamp"),
    )?;

    let block = Cuboid::new(Point3D::new(-0.4, 0.0, -0.4), Point3D::new(0.3, 1.4, 0.3))?;
    let ball = Sphere::new(0.4)?;
    // A micrometre above the floor, as in the demonstration.
    let (block_place, ball_place) =
        (translate(0.4, -1.0 + 1e-6, 0.4) * rotate(30.0, 0.0, 0.0), translate(-0.4, -0.6 + 1e-6, -0.4));
    let (block, ball) = match variant {
        Variant::Glass => (block.material(schott("N-BK7")?), ball.material(schott("N-BK7")?)),
        Variant::Diffuse => (block.material(Lambert::new(white.clone())), ball.material(Lambert::new(white))),
    };
    world.add(block.transform(block_place).name("block"))?;
    world.add(ball.transform(ball_place).name("ball"))?;
    Ok(world)
}

/// Where the camera stands: at z = −3.3, looking in. Glass has one index a slice, its mean, as in Raysect.
pub(crate) fn camera(pixels: (usize, usize)) -> raysect::Result<PinholeCamera> {
    Ok(PinholeCamera::new(pixels, 45.0)?
        .transform(translate(0.0, 0.0, -3.3))
        .paths(PathSettings::default().dispersion(Dispersion::Mean)))
}
