//! A lamp of spectral lines in a spectrometer with three channels: spectra with error bands as CSV, NPZ and SVG,
//! rewritten while it observes, and the power of each line.

use std::path::PathBuf;

use clap::Parser;
use raysect::prelude::*;

/// Observes a mercury lamp in front of a white wall: the wall beside it, its edge, and its middle.
#[derive(Parser)]
struct Arguments {
    /// Relative standard error of the power of each line, at which to stop.
    #[arg(long, default_value_t = 0.01)]
    error: f64,
    /// Bins of the spectrum, 400 to 620 nm.
    #[arg(long, default_value_t = 220)]
    bins: usize,
    /// Minutes after which to stop in any case.
    #[arg(long, default_value_t = 1.0)]
    minutes: f64,
    /// Folder of the results.
    #[arg(long, default_value = ".")]
    out: PathBuf,
}

/// Wavelength in air [nm] and relative strength of the strongest visible lines of mercury (J. E. Sansonetti, W. C.
/// Martin, *Handbook of Basic Atomic Spectroscopic Data*, J. Phys. Chem. Ref. Data 34, 2005, rounded).
const LINES: [(&str, f64, f64); 4] =
    [("violet", 404.7, 0.45), ("blue", 435.8, 1.0), ("green", 546.1, 0.9), ("yellow", 578.0, 0.6)];

/// Standard deviation of a line [nm].
const WIDTH: f64 = 0.8;

/// A weak continuum and Gaussian lines [W/m²/sr/nm].
fn lamp(wavelength: f64) -> f64 {
    let line = |centre: f64| (-0.5 * ((wavelength - centre) / WIDTH).powi(2)).exp();
    0.02 + LINES.iter().map(|(_, centre, strength)| strength * line(*centre)).sum::<f64>()
}

fn world() -> raysect::Result<World> {
    let mut world = World::new();
    let tube = Cylinder::new(0.01, 0.2)?.material(UniformSurfaceEmitter::new(lamp, 1.0)).name("lamp");
    world.add(tube.transform(translate(0.0, -0.1, 1.0) * rotate_x(-90.0)))?;
    let wall = Cuboid::new(Point3D::new(-1.0, -1.0, 1.2), Point3D::new(1.0, 1.0, 1.3))?;
    world.add(wall.material(Lambert::new(0.7)).name("wall"))?;
    Ok(world)
}

fn main() -> raysect::Result<()> {
    let arguments = Arguments::parse();
    std::fs::create_dir_all(&arguments.out)?;
    let file = |name: &str| arguments.out.join(name);

    let spectrometer = PinholeCamera::new((3, 1), 4.0)?
        .aperture(1e-6)?
        .wavelengths(400.0, 620.0)
        .spectral_bins(arguments.bins)
        .transform(translate(0.012, 0.0, 0.0));
    let mut power = SpectralPowerPipeline1D::new().preview(file("spectrometer.svg"));
    let mut radiance = SpectralRadiancePipeline1D::new();
    let mut lines = FunctionalPipeline::power();
    for (name, centre, _) in LINES {
        lines = lines.band(name, centre - 4.0 * WIDTH, centre + 4.0 * WIDTH)?;
    }
    let stop = Stop::relative_error(arguments.error).or_after(minutes(arguments.minutes));
    let report = spectrometer.observe_until(&world()?, &mut (&mut power, &mut radiance, &mut lines), stop)?;
    println!("{report}");

    for pixel in 0..3 {
        println!("pixel {pixel}: {} W, {} W/m²/sr", power.total(pixel), radiance.total(pixel));
        for (channel, (name, centre, _)) in LINES.iter().enumerate() {
            println!("  {name:<7} {centre} nm  {} W", lines.frame().pixel(pixel, channel));
        }
    }
    power.save(file("spectrometer.csv"))?;
    power.save(file("spectrometer.npz"))?;
    radiance.save_plot(file("wall.svg"), &[0])?;
    lines.save(file("lines.csv"))?;
    println!("wrote spectrometer.csv, .npz, .svg, wall.svg and lines.csv in {}", arguments.out.display());
    Ok(())
}
