//! Which shapes contain the points of a plane: `world_contains.csv` and `.png`. No light is involved.

#[path = "../common/arguments.rs"]
mod arguments;
#[path = "../common/canvas.rs"]
mod canvas;
#[path = "../common/nested_shapes.rs"]
mod nested_shapes;

use std::fs::File;
use std::io::{BufWriter, Write};
use std::path::PathBuf;

use canvas::Canvas;
use clap::Parser;
use raysect::math::Point3D;

/// Cuts through a scene along a plane z = const and asks at each point what is there.
#[derive(Parser)]
struct Arguments {
    /// Columns and rows of points, and of the picture.
    #[arg(long, default_value = "400x400", value_parser = arguments::pixels)]
    pixels: (usize, usize),
    /// Height of the plane [m].
    #[arg(long, default_value_t = 0.0, allow_negative_numbers = true)]
    z: f64,
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
    let mut canvas = Canvas::new(arguments.pixels);
    let pitch = 2.5 * nested_shapes::RADIUS / canvas.columns.min(canvas.rows) as f64;

    std::fs::create_dir_all(&arguments.out)?;
    let table = arguments.out.join("world_contains.csv");
    let mut file = BufWriter::new(File::create(&table)?);
    writeln!(file, "x_m,y_m,shapes")?;
    let mut inside = 0;
    for row in 0..canvas.rows {
        for column in 0..canvas.columns {
            let x = pitch * (0.5 * canvas.columns as f64 - (column as f64 + 0.5));
            let y = pitch * (0.5 * canvas.rows as f64 - (row as f64 + 0.5));
            let shapes = world.contains(Point3D::new(x, y, arguments.z))?;
            let names: Vec<&str> = shapes.iter().map(|&node| world.name(node)).collect::<Result<_, _>>()?;
            writeln!(file, "{x},{y},{}", names.join("+"))?;
            // Where shapes overlap, their colours add up.
            canvas.add(column, row, [0.012, 0.014, 0.022], 1.0);
            for &node in &shapes {
                canvas.add(column, row, nested_shapes::colour(&world, node)?, 1.0);
            }
            inside += usize::from(!shapes.is_empty());
        }
    }
    file.flush()?;
    let picture = table.with_extension("png");
    canvas.save(&picture)?;
    if !arguments.quiet {
        println!("{inside} of {} points lie within a shape", canvas.columns * canvas.rows);
        println!("wrote {}, .png", table.display());
    }
    Ok(())
}
