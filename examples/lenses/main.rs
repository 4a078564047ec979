//! The five lenses in front of a chequered wall, which they enlarge or reduce: `lenses.png`.

#[path = "../common/arguments.rs"]
mod arguments;
#[path = "../common/shot.rs"]
mod shot;

use clap::Parser;
use raysect::optical::colour::d65_white;
use raysect::prelude::*;

/// Renders five lenses of N-BK7: above biconvex, plano-convex and meniscus, below plano-concave and biconcave.
#[derive(Parser)]
struct Arguments {
    #[command(flatten)]
    shot: shot::Shot,
}

fn main() -> raysect::Result<()> {
    let arguments = Arguments::parse();
    let mut world = World::new();

    // A luminous wall of squares of 8 cm, 35 cm behind the lenses.
    let wall = Cuboid::new(Point3D::new(-20.0, -20.0, 0.0), Point3D::new(20.0, 20.0, 0.1))?;
    let blue = InterpolatedSf::new([375.0, 470.0, 500.0, 740.0], [0.12, 0.12, 0.02, 0.01])?;
    let squares = Checkerboard::new(0.08)?.spectra((blue, 1.5), (d65_white(), 0.55));
    world.add(wall.material(squares).transform(translate(0.04, 0.04, 0.35)).name("wall"))?;

    // Discs of 40 cm, their fronts towards the camera.
    let (diameter, radius) = (0.4, 0.6);
    let glass = || schott("N-BK7");
    for (lens, x, y) in [
        (BiConvex::new(diameter, 0.09, radius, radius)?.material(glass()?).name("biconvex"), 0.5, 0.22),
        (PlanoConvex::new(diameter, 0.05, radius)?.material(glass()?).name("plano-convex"), 0.0, 0.22),
        (Meniscus::new(diameter, 0.05, 0.4, 0.8)?.material(glass()?).name("meniscus"), -0.5, 0.22),
        (PlanoConcave::new(diameter, 0.02, radius)?.material(glass()?).name("plano-concave"), 0.25, -0.22),
        (BiConcave::new(diameter, 0.02, radius, radius)?.material(glass()?).name("biconcave"), -0.25, -0.22),
    ] {
        world.add(lens.transform(translate(x, y, 0.0) * rotate_y(180.0)))?;
    }
    arguments.shot.take("lenses", &world, shot::viewpoint(6.0, 0.0, 0.0), 15.5)
}
