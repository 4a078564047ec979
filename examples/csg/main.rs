//! Constructive solid geometry: a body from a cube, a sphere and three cylinders, and its steps: `csg.png`.

#[path = "../common/arguments.rs"]
mod arguments;
#[path = "../common/paint.rs"]
mod paint;
#[path = "../common/shot.rs"]
mod shot;
#[path = "../common/studio.rs"]
mod studio;

use std::sync::Arc;

use clap::Parser;
use paint::paint;
use raysect::prelude::*;

/// Renders a body made by union, intersection and subtraction, with what it is made of behind it.
#[derive(Parser)]
struct Arguments {
    #[command(flatten)]
    shot: shot::Shot,
}

fn main() -> raysect::Result<()> {
    let arguments = Arguments::parse();

    // A cube with rounded corners, bored through along its three axes.
    let rounded = Arc::new(Intersect::new(Cuboid::centred(2.0, 2.0, 2.0)?, Sphere::new(1.35)?)?);
    let bore = Arc::new(Cylinder::new(0.6, 3.0)?);
    let along_z = translate(0.0, 0.0, -1.5);
    let along_x = rotate_y(90.0) * along_z;
    let along_y = rotate_x(90.0) * along_z;
    let two = Union::new(bore.clone().placed(along_x), bore.clone().placed(along_y))?;
    let cross = Arc::new(Union::new(two, bore.placed(along_z))?);
    let body = Arc::new(Subtract::new(rounded.clone(), cross.clone())?);

    let (red, blue, gold) = (paint(0.75, 0.15, 0.12)?, paint(0.1, 0.4, 0.75)?, paint(0.9, 0.6, 0.15)?);
    let mut world = studio::studio()?;
    let turned = rotate(35.0, 0.0, 0.0);
    let place = |x: f64, y: f64, z: f64| translate(x, y, z) * turned;
    world.add(body.clone().material(gold).transform(place(0.0, 1.0, -0.4)).name("body"))?;
    world.add(Sphere::new(0.5)?.material(schott("N-BK7")?).transform(place(0.0, 1.0, -0.4)).name("ball"))?;
    world.add(rounded.material(red).transform(place(3.0, 1.0, 1.6)).name("rounded cube"))?;
    world.add(cross.material(blue).transform(place(-3.0, 1.5, 1.6)).name("bores"))?;

    arguments.shot.take("csg", &world, shot::viewpoint(12.0, 1.0, 20.0), 40.0)
}
