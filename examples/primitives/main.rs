//! The basic shapes, each in its own paint, and one of glass: `primitives.png`.

#[path = "../common/arguments.rs"]
mod arguments;
#[path = "../common/paint.rs"]
mod paint;
#[path = "../common/shot.rs"]
mod shot;
#[path = "../common/studio.rs"]
mod studio;

use clap::Parser;
use paint::paint;
use raysect::prelude::*;

/// Renders sphere, cuboid, cylinder, cone, parabola, torus and mesh.
#[derive(Parser)]
struct Arguments {
    #[command(flatten)]
    shot: shot::Shot,
}

fn main() -> raysect::Result<()> {
    let arguments = Arguments::parse();
    let mut world = studio::studio()?;

    // The axes of cylinder, cone, parabola and torus are z; here they stand upright or lie.
    let upright = rotate(0.0, 90.0, 0.0);
    let cylinder = Cylinder::new(0.55, 1.5)?.material(paint(0.1, 0.45, 0.75)?);
    world.add(cylinder.transform(translate(2.9, 0.0, 1.2) * upright).name("cylinder"))?;
    let cone = Cone::new(0.75, 1.8)?.material(paint(0.9, 0.6, 0.1)?);
    world.add(cone.transform(translate(1.0, 0.0, 1.5) * upright).name("cone"))?;
    let parabola = Parabola::new(0.75, 1.5)?.material(paint(0.45, 0.2, 0.6)?);
    world.add(parabola.transform(translate(-1.0, 0.0, 1.5) * upright).name("parabola"))?;
    let cuboid = Cuboid::centred(1.1, 1.1, 1.1)?.material(paint(0.75, 0.15, 0.12)?);
    world.add(cuboid.transform(translate(-2.9, 0.55, 1.2) * rotate(30.0, 0.0, 0.0)).name("cuboid"))?;

    let torus = Torus::new(0.6, 0.22)?.material(paint(0.1, 0.6, 0.3)?);
    world.add(torus.transform(translate(1.75, 0.22, -0.7) * upright).name("torus"))?;
    world.add(
        Sphere::new(0.65)?.material(schott("N-BK7")?).transform(translate(0.0, 0.65, -0.9)).name("sphere"),
    )?;
    let mesh = Mesh::new(MeshData::icosphere(1, 0.65)?)?.material(paint(0.8, 0.8, 0.75)?);
    world.add(mesh.transform(translate(-1.75, 0.6, -0.7)).name("mesh"))?;

    arguments.shot.take("primitives", &world, shot::viewpoint(11.0, 0.55, 20.0), 37.0)
}
