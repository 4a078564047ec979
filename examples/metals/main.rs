//! Gold, copper, silver and titanium, from polished to rough, and ground glass: `metals.png`.

#[path = "../common/arguments.rs"]
mod arguments;
#[path = "../common/shot.rs"]
mod shot;
#[path = "../common/studio.rs"]
mod studio;

use clap::Parser;
use raysect::optical::library::{metal, rough_metal};
use raysect::prelude::*;

/// Renders balls of four metals and of glass in rows of growing roughness.
#[derive(Parser)]
struct Arguments {
    #[command(flatten)]
    shot: shot::Shot,
}

/// From left to right.
const METALS: [&str; 4] = ["Gold", "Copper", "Silver", "Titanium"];

/// From front to back.
const ROUGHNESSES: [f64; 3] = [0.0, 0.15, 0.4];

fn main() -> raysect::Result<()> {
    let arguments = Arguments::parse();
    let mut world = studio::studio()?;
    for (column, name) in METALS.into_iter().enumerate() {
        for (row, roughness) in ROUGHNESSES.into_iter().enumerate() {
            let ball = Sphere::new(0.6)?;
            let node = if roughness == 0.0 {
                ball.material(metal(name)?)
            } else {
                ball.material(rough_metal(name, roughness)?)
            };
            world.add(node.transform(place(column, row)).name(format!("{name} {roughness}")))?;
        }
    }
    for (row, roughness) in ROUGHNESSES.into_iter().enumerate() {
        let (ball, glass) = (Sphere::new(0.6)?, schott("N-BK7")?);
        let node = if roughness == 0.0 {
            ball.material(glass)
        } else {
            ball.material(RoughDielectric::of(glass.importance(0.0), roughness)?)
        };
        world.add(node.transform(place(METALS.len(), row)).name(format!("glass {roughness}")))?;
    }
    arguments.shot.take("metals", &world, shot::viewpoint(11.0, 0.6, 24.0), 42.0)
}

fn place(column: usize, row: usize) -> AffineMatrix3D {
    translate(2.9 - 1.45 * column as f64, 0.6, -1.2 + 1.5 * row as f64)
}
