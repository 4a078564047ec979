//! The Cornell box with measured walls and two blocks of glass: `cornell_box.png`, `.exr` and `.npz`.

#[path = "../common/arguments.rs"]
mod arguments;
#[path = "../common/cornell.rs"]
mod cornell;

use std::path::PathBuf;

use clap::{Parser, ValueEnum};
use cornell::Variant;
use raysect::optical::colour::CieObserver;
use raysect::prelude::*;

/// Renders the Cornell box of Raysect's demonstration, with an error bar on every number.
#[derive(Parser)]
struct Arguments {
    /// Columns and rows of the picture.
    #[arg(long, default_value = "256x256", value_parser = arguments::pixels)]
    pixels: (usize, usize),
    /// Samples of each pixel.
    #[arg(long, default_value_t = 100)]
    samples: u64,
    /// Bins of the spectrum, 375 to 740 nm.
    #[arg(long, default_value_t = 15)]
    bins: usize,
    /// Rays that share the bins; more of them resolve the dispersion of the glass.
    #[arg(long, default_value_t = 1)]
    spectral_rays: usize,
    /// The same seed gives the same bits.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Threads; all processors by default.
    #[arg(long)]
    threads: Option<usize>,
    /// What the two blocks are made of.
    #[arg(long, value_enum, default_value_t = Blocks::Glass)]
    variant: Blocks,
    /// How the glass disperses: by its mean index, as in Raysect, or by a wavelength of each path.
    #[arg(long, value_enum, default_value_t = Glass::Mean)]
    dispersion: Glass,
    /// Goes on until the mean colour has this relative standard error, instead of a number of samples.
    #[arg(long)]
    stop_error: Option<f64>,
    /// Takes more of the samples where the colours are noisy.
    #[arg(long, conflicts_with = "stop_error")]
    adaptive: bool,
    /// Goes on from `cornell_box.statepoint` in the folder of the results, if there is one, and writes it after each
    /// pass, so that a run that is killed can be resumed by the same command.
    #[arg(long)]
    resume: bool,
    /// Folder of the results.
    #[arg(long, default_value = ".")]
    out: PathBuf,
    /// Prints nothing but errors.
    #[arg(long)]
    quiet: bool,
}

#[derive(Clone, Copy, ValueEnum)]
enum Blocks {
    Glass,
    Diffuse,
}

#[derive(Clone, Copy, ValueEnum)]
enum Glass {
    Mean,
    Sampled,
}

fn main() -> raysect::Result<()> {
    let arguments = Arguments::parse();
    let variant = match arguments.variant {
        Blocks::Glass => Variant::Glass,
        Blocks::Diffuse => Variant::Diffuse,
    };
    let world = cornell::cornell_box(variant)?;
    let mut camera = cornell::camera(arguments.pixels)?
        .spectral_bins(arguments.bins)
        .spectral_rays(arguments.spectral_rays)
        .pixel_samples(arguments.samples)
        .seed(arguments.seed)
        .quiet(arguments.quiet);
    if let Glass::Sampled = arguments.dispersion {
        camera = camera.paths(PathSettings::default().dispersion(Dispersion::Sampled));
    }
    if let Some(threads) = arguments.threads {
        camera = camera.threads(threads)?;
    }
    std::fs::create_dir_all(&arguments.out)?;
    let file = |extension: &str| arguments.out.join(format!("cornell_box.{extension}"));
    let mut rgb = RgbPipeline2D::new()
        .observer(CieObserver::FiveNanometres)
        .unsaturated_fraction(0.96)?
        .preview(file("png"));
    let mut radiance = RadiancePipeline2D::new();
    if !arguments.quiet {
        println!("{}\n", camera.plan(&world)?);
    }
    let mut pipelines = (&mut rgb, &mut radiance);
    if arguments.resume {
        camera = camera.statepoint(file("statepoint"));
        if camera.resume(&world, &mut pipelines)? && !arguments.quiet {
            println!("going on from {}", file("statepoint").display());
        }
    }
    let report = if arguments.adaptive {
        camera.observe_adaptive(&world, &mut pipelines, &AdaptiveSampling::rgb(arguments.samples))?
    } else {
        let stop = arguments.stop_error.map_or(Stop::samples(arguments.samples), Stop::relative_error);
        camera.observe_until(&world, &mut pipelines, stop)?
    };
    for extension in ["png", "exr", "npz"] {
        rgb.save(file(extension))?;
    }
    if !arguments.quiet {
        println!("{report}\n");
        for (channel, name) in ["X", "Y", "Z"].iter().enumerate() {
            println!("mean {name}         {} W/m²/sr/nm", rgb.frame().average_of(channel));
        }
        println!("mean radiance  {} W/m²/sr", radiance.frame().average_of(0));
        println!("total radiance {} W/m²/sr over all pixels", radiance.frame().total());
        println!("wrote {}, .exr, .npz", file("png").display());
    }
    Ok(())
}
