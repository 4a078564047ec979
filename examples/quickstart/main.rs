//! A first picture, a glass ball in front of a luminous wall: `quickstart.png`, `.exr` and `.npz`.

#[path = "../common/arguments.rs"]
mod arguments;
#[path = "../common/quickstart_scene.rs"]
mod quickstart_scene;

use std::path::PathBuf;

use clap::Parser;
use raysect::prelude::*;

/// Renders the scene of Raysect's quickstart, with an error bar on every number.
#[derive(Parser)]
struct Arguments {
    /// Columns and rows of the picture.
    #[arg(long, default_value = "384x384", value_parser = arguments::pixels)]
    pixels: (usize, usize),
    /// Samples of each pixel.
    #[arg(long, default_value_t = 200)]
    samples: u64,
    /// Bins of the spectrum, 375 to 740 nm.
    #[arg(long, default_value_t = 15)]
    bins: usize,
    /// The same seed gives the same bits.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Threads; all processors by default.
    #[arg(long)]
    threads: Option<usize>,
    /// Folder of the results.
    #[arg(long, default_value = ".")]
    out: PathBuf,
    /// Prints nothing but errors.
    #[arg(long)]
    quiet: bool,
}

fn main() -> raysect::Result<()> {
    let arguments = Arguments::parse();
    let world = quickstart_scene::world()?;
    let camera = camera(&arguments)?;
    if !arguments.quiet {
        println!("{}\n", camera.plan(&world)?);
    }

    // Exposed for the ground: white is 0.4 W/m²/sr/nm, and the bright squares of the wall are far beyond it.
    let mut rgb = RgbPipeline2D::new().sensitivity(2.5)?;
    let report = camera.observe(&world, &mut rgb)?;

    std::fs::create_dir_all(&arguments.out)?;
    let picture = arguments.out.join("quickstart.png");
    for extension in ["png", "exr", "npz"] {
        rgb.save(picture.with_extension(extension))?;
    }
    if !arguments.quiet {
        println!("{report}\n");
        println!("mean luminance {} W/m²/sr/nm", rgb.frame().average_of(1));
        println!("wrote {}, .exr, .npz", picture.display());
    }
    Ok(())
}

fn camera(arguments: &Arguments) -> raysect::Result<PinholeCamera> {
    let camera = PinholeCamera::new(arguments.pixels, 45.0)?
        .transform(quickstart_scene::viewpoint())
        .spectral_bins(arguments.bins)
        .pixel_samples(arguments.samples)
        .seed(arguments.seed)
        .quiet(arguments.quiet);
    Ok(match arguments.threads {
        Some(threads) => camera.threads(threads)?,
        None => camera,
    })
}
