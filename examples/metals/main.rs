//! Gold, copper, silver and titanium, from polished to rough, and ground glass: `metals.png`.

#[path = "../common/arguments.rs"]
mod arguments;
#[path = "../common/shot.rs"]
mod shot;
#[path = "../common/studio.rs"]
mod studio;

use clap::Parser;
use raysect::prelude::*;

/// Renders balls of four metals and of glass in rows of growing roughness.
#[derive(Parser)]
struct Arguments {
    #[command(flatten)]
    shot: shot::Shot,
}

/// Wavelengths [nm] of the tables below.
const WAVELENGTHS: [f64; 6] = [400.0, 450.0, 500.0, 550.0, 600.0, 700.0];

/// Name, refractive indices and extinctions: figures for a picture, close to those of P. Johnson and R. Christy (Phys.
/// Rev. B 6, 4370, 1972, and 9, 5056, 1974), and no substitute for them.
const METALS: [(&str, [f64; 6], [f64; 6]); 4] = [
    ("gold", [1.47, 1.38, 0.97, 0.43, 0.25, 0.13], [1.95, 1.92, 1.87, 2.46, 3.07, 4.10]),
    ("copper", [1.18, 1.15, 1.13, 1.04, 0.30, 0.21], [2.21, 2.40, 2.56, 2.59, 3.24, 4.16]),
    ("silver", [0.05, 0.04, 0.05, 0.06, 0.06, 0.04], [2.10, 2.66, 3.13, 3.59, 4.01, 4.84]),
    ("titanium", [2.08, 2.27, 2.44, 2.54, 2.67, 3.03], [2.95, 3.04, 3.17, 3.34, 3.52, 3.65]),
];

/// From front to back.
const ROUGHNESSES: [f64; 3] = [0.0, 0.15, 0.4];

fn main() -> raysect::Result<()> {
    let arguments = Arguments::parse();
    let mut world = studio::studio()?;
    for (column, (name, index, extinction)) in METALS.into_iter().enumerate() {
        let index = SpectralTable::new(InterpolatedSf::new(WAVELENGTHS, index)?);
        let extinction = SpectralTable::new(InterpolatedSf::new(WAVELENGTHS, extinction)?);
        for (row, roughness) in ROUGHNESSES.into_iter().enumerate() {
            let ball = Sphere::new(0.6)?;
            let node = if roughness == 0.0 {
                ball.material(Conductor::new(index.clone(), extinction.clone()))
            } else {
                ball.material(RoughConductor::new(index.clone(), extinction.clone(), roughness)?)
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
