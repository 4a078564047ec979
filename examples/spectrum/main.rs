//! The spectrum that arrives along a single ray, without any camera: `spectrum.csv` and `spectrum.png`.

#[path = "../common/chart.rs"]
mod chart;
#[path = "../common/quickstart_scene.rs"]
mod quickstart_scene;

use std::fs::File;
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

use chart::Chart;
use clap::Parser;
use raysect::optical::SampledSpectrum;
use raysect::prelude::*;

/// Follows a ray into the glass ball of the quickstart scene: once, and many times for an error bar.
#[derive(Parser)]
struct Arguments {
    /// Paths that the mean is taken over.
    #[arg(long, default_value_t = 10_000, value_parser = clap::value_parser!(u64).range(2..))]
    samples: u64,
    /// Bins of the spectrum, 375 to 785 nm.
    #[arg(long, default_value_t = 100)]
    bins: usize,
    /// The same seed gives the same bits; for about half of all seeds, the single path carries no light.
    #[arg(long, default_value_t = 5)]
    seed: u64,
    /// Folder of the results.
    #[arg(long, default_value = ".")]
    out: PathBuf,
}

fn main() -> raysect::Result<()> {
    let arguments = Arguments::parse();
    let world = quickstart_scene::world()?;

    let viewpoint = quickstart_scene::viewpoint();
    let ray = Ray::new(viewpoint * Point3D::ORIGIN, viewpoint * Vector3D::Z)
        .spectrum(375.0, 785.0, arguments.bins)
        .seed(arguments.seed);
    let single = ray.trace(&world)?;
    let sampled = ray.sample(&world, arguments.samples)?;

    println!("one path     {:.3} W/m²/sr", single.total());
    println!("{} paths  {} W/m²/sr", sampled.samples, sampled.total);

    std::fs::create_dir_all(&arguments.out)?;
    let (table, picture) = (arguments.out.join("spectrum.csv"), arguments.out.join("spectrum.png"));
    write_table(&table, &single, &sampled)?;
    draw(&picture, &single, &sampled)?;
    println!("wrote {}, {}", table.display(), picture.display());
    Ok(())
}

/// One line for each bin: its centre [nm] and spectral radiances [W/m²/sr/nm].
fn write_table(path: &Path, single: &Spectrum, sampled: &SampledSpectrum) -> io::Result<()> {
    let mut file = BufWriter::new(File::create(path)?);
    writeln!(file, "wavelength_nm,single_trace,mean,standard_error")?;
    for (bin, wavelength) in single.wavelengths().iter().enumerate() {
        let (one, mean, error) = (single.samples()[bin], sampled.mean.samples()[bin], sampled.error[bin]);
        writeln!(file, "{wavelength:.3},{one},{mean},{error}")?;
    }
    file.flush()
}

fn draw(path: &Path, single: &Spectrum, sampled: &SampledSpectrum) -> io::Result<()> {
    let mean = sampled.mean.samples();
    let (title, wavelengths) = ("Light that comes through the glass ball", single.wavelengths());
    Chart::new(title, "wavelength [nm]", "spectral radiance [W/m²/sr/nm]", wavelengths)
        .band("± standard error", "#b0c4de", mean, &sampled.error)
        .curve(&format!("mean of {} paths", sampled.samples), "steelblue", mean)
        .curve("a single path", "darkorange", single.samples())
        .save(path)
}
