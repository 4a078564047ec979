//! Where rays go in and out of shapes within shapes: `intersection_points.csv`, `.ply` and `.png`. No light is involved.

#[path = "../common/arguments.rs"]
mod arguments;
#[path = "../common/canvas.rs"]
mod canvas;
#[path = "../common/nested_shapes.rs"]
mod nested_shapes;

use std::fs::File;
use std::io::{BufWriter, Write};
use std::path::{Path, PathBuf};

use canvas::Canvas;
use clap::Parser;
use raysect::core::{Intersection, Ray, World};
use raysect::math::{Point3D, Rng, Vector3D, rotate};

/// Sends rays through a scene from all sides and keeps all of their crossings.
#[derive(Parser)]
struct Arguments {
    /// Rays.
    #[arg(long, default_value_t = 20_000)]
    rays: usize,
    /// Columns and rows of the picture.
    #[arg(long, default_value = "600x600", value_parser = arguments::pixels)]
    pixels: (usize, usize),
    /// The same seed gives the same rays.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Folder of the results.
    #[arg(long, default_value = ".")]
    out: PathBuf,
    /// Prints nothing but errors.
    #[arg(long)]
    quiet: bool,
}

fn main() -> raysect::Result<()> {
    let arguments = Arguments::parse();
    let world = nested_shapes::world()?;

    let mut rng = Rng::new(arguments.seed);
    let mut all = Vec::new();
    for number in 0..arguments.rays {
        let ray = chord(&mut rng);
        all.extend(world.crossings(&ray)?.into_iter().map(|crossing| (number, crossing)));
    }

    std::fs::create_dir_all(&arguments.out)?;
    let table = arguments.out.join("intersection_points.csv");
    let (cloud, picture) = (table.with_extension("ply"), table.with_extension("png"));
    write_table(&table, &world, &all)?;
    write_cloud(&cloud, &world, &all)?;
    draw(&picture, arguments.pixels, &world, &all)?;
    if !arguments.quiet {
        println!("{} rays cross {} surfaces", arguments.rays, all.len());
        println!("wrote {}, .ply, .png", table.display());
    }
    Ok(())
}

/// A ray between two random points of a sphere around the scene: such chords meet all surfaces equally often per area.
fn chord(rng: &mut Rng) -> Ray {
    let mut point = || {
        let (z, phi) = (rng.range(-1.0, 1.0), rng.range(0.0, std::f64::consts::TAU));
        let r = f64::sqrt(1.0 - z * z);
        Point3D::ORIGIN + Vector3D::new(r * phi.cos(), r * phi.sin(), z) * (1.3 * nested_shapes::RADIUS)
    };
    let (from, to) = (point(), point());
    Ray::new(from, from.vector_to(to).normalise_unchecked())
}

/// One line for each crossing.
fn write_table(path: &Path, world: &World<()>, all: &[(usize, Intersection)]) -> raysect::Result<()> {
    let mut file = BufWriter::new(File::create(path)?);
    writeln!(file, "ray,shape,exiting,distance_m,x_m,y_m,z_m,nx,ny,nz")?;
    for (ray, crossing) in all {
        let (name, [x, y, z]) = (world.name(crossing.node)?, crossing.point().to_array());
        let (way, distance) = (u8::from(crossing.exiting()), crossing.distance());
        let [nx, ny, nz] = crossing.normal().to_array();
        writeln!(file, "{ray},{name},{way},{distance},{x},{y},{z},{nx},{ny},{nz}")?;
    }
    Ok(file.flush()?)
}

/// A cloud of coloured points with normals, for viewers of meshes and scans.
fn write_cloud(path: &Path, world: &World<()>, all: &[(usize, Intersection)]) -> raysect::Result<()> {
    let mut file = BufWriter::new(File::create(path)?);
    writeln!(file, "ply\nformat ascii 1.0\nelement vertex {}", all.len())?;
    for name in ["x", "y", "z", "nx", "ny", "nz"] {
        writeln!(file, "property double {name}")?;
    }
    writeln!(file, "property uchar red\nproperty uchar green\nproperty uchar blue\nend_header")?;
    for (_, crossing) in all {
        let ([x, y, z], [nx, ny, nz]) = (crossing.point().to_array(), crossing.normal().to_array());
        let [r, g, b] = nested_shapes::colour(world, crossing.node)?.map(|c| (255.0 * c) as u8);
        writeln!(file, "{x} {y} {z} {nx} {ny} {nz} {r} {g} {b}")?;
    }
    Ok(file.flush()?)
}

/// All points as seen from afar, in the colours of their shapes; what lies behind shines through.
fn draw(
    path: &Path,
    size: (usize, usize),
    world: &World<()>,
    all: &[(usize, Intersection)],
) -> raysect::Result<()> {
    let mut canvas = Canvas::new(size);
    let (width, height) = (canvas.columns as f64, canvas.rows as f64);
    let view = rotate(25.0, -20.0, 0.0);
    let scale = width.min(height) / (2.5 * nested_shapes::RADIUS);
    let radius = width.min(height) / 500.0;
    // As much light in all, however many points and pixels there are.
    let amount = 0.09 * width * height / (radius * radius * all.len() as f64);
    for (_, crossing) in all {
        let p = view * crossing.point();
        let place = [0.5 * width - scale * p.x, 0.5 * height - scale * p.y];
        // What is far is dimmer; and the shell, which is large, so that the inside is seen.
        let near = 0.5 - 0.5 * p.z / (1.3 * nested_shapes::RADIUS);
        let share = if world.name(crossing.node)? == "shell" { 0.3 } else { 1.0 };
        let colour = nested_shapes::colour(world, crossing.node)?;
        dot(&mut canvas, place, radius, colour, amount * share * (0.15 + 1.7 * near * near));
    }
    canvas.save(path)?;
    Ok(())
}

/// Adds a soft dot about a place, in pixels from the upper left corner; `radius` is its standard deviation.
fn dot(canvas: &mut Canvas, [x, y]: [f64; 2], radius: f64, colour: [f64; 3], amount: f64) {
    let around = |centre: f64, end: usize| {
        let reach = 3.0 * radius;
        (centre - reach).max(0.0) as usize..((centre + reach).max(0.0) as usize + 1).min(end)
    };
    for row in around(y, canvas.rows) {
        for column in around(x, canvas.columns) {
            let squared = (column as f64 + 0.5 - x).powi(2) + (row as f64 + 0.5 - y).powi(2);
            canvas.add(column, row, colour, amount * (-0.5 * squared / (radius * radius)).exp());
        }
    }
}
