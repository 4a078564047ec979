//! The sun's light through a prism onto a row of pixels: `prism.png`, the strip of colours, and `prism.csv`.

mod spectrograph;

use std::path::PathBuf;

use clap::Parser;
use raysect::observer::file::{save_csv, save_png_rgb8};
use raysect::prelude::*;
use spectrograph::Spectrograph;

/// Spreads sunlight by a prism, and compares the angles with Snell's law.
///
/// The screen itself is the sensor: its pixels look back at the prism, and paths draw their wavelengths there.
#[derive(Parser)]
struct Arguments {
    /// One of Schott's glasses.
    #[arg(long, default_value = "SF11")]
    glass: String,
    /// Pixels of the screen.
    #[arg(long, default_value_t = 480)]
    columns: usize,
    /// Samples of each pixel.
    #[arg(long, default_value_t = 8192)]
    samples: u64,
    /// The same seed gives the same bits.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Folder of the results.
    #[arg(long, default_value = ".")]
    out: PathBuf,
    /// Prints nothing but errors.
    #[arg(long)]
    quiet: bool,
}

/// What the screen sees [nm], and in how many bins.
const RANGE: (f64, f64) = (385.0, 715.0);
const BINS: usize = 33;

/// Wavelengths whose angles are printed [nm], each in the middle of a bin. At shorter ones flint glass absorbs so much that
/// the light comes through nearer to the apex.
const WAVELENGTHS: [f64; 7] = [420.0, 450.0, 490.0, 520.0, 550.0, 600.0, 680.0];

/// Height of the strip [pixels]: the row is drawn so often.
const HEIGHT: usize = 96;

fn main() -> raysect::Result<()> {
    let arguments = Arguments::parse();
    std::fs::create_dir_all(&arguments.out)?;
    let room = Spectrograph::new(&arguments.glass, RANGE)?;
    let screen = room
        .screen(arguments.columns)?
        .wavelengths(RANGE.0, RANGE.1)
        .spectral_bins(BINS)
        .pixel_samples(arguments.samples)
        .seed(arguments.seed)
        .quiet(arguments.quiet);
    let (mut rgb, mut power) = (RgbPipeline2D::new(), SpectralPowerPipeline2D::new());
    let report = screen.observe(&room.world, &mut (&mut rgb, &mut power))?;

    let strip = rgb.to_srgb().repeat(HEIGHT);
    save_png_rgb8(arguments.out.join("prism.png"), arguments.columns, HEIGHT, &strip)?;
    let pitch = screen.sensor().inner().width() / arguments.columns as f64;
    // x is to the left.
    let places: Vec<f64> =
        (0..arguments.columns).map(|c| pitch * (0.5 * arguments.columns as f64 - c as f64 - 0.5)).collect();
    save_table(&arguments, &power, &places)?;
    if !arguments.quiet {
        println!("{report}\n");
        compare(&room, &power, &places)?;
        println!("\nwrote prism.png and prism.csv in {}", arguments.out.display());
    }
    Ok(())
}

/// The light on the screen, a line for each pixel that some has reached.
fn save_table(arguments: &Arguments, power: &SpectralPowerPipeline2D, places: &[f64]) -> raysect::Result<()> {
    let wavelengths = power.wavelengths();
    let lit = places.iter().enumerate().filter(|(pixel, _)| power.total(*pixel).value > 0.0);
    let rows = lit.map(|(pixel, place)| {
        let (total, bins) = (power.total(pixel), power.spectrum(pixel));
        let mean = bins.iter().zip(&wavelengths).map(|(p, w)| p * w).sum::<f64>() / bins.iter().sum::<f64>();
        vec![1e3 * place, total.value, total.error, mean]
    });
    let titles = ["place [mm]", "power [W]", "standard error [W]", "mean wavelength [nm]"];
    save_csv(arguments.out.join("prism.csv"), &titles, &rows.collect::<Vec<_>>())?;
    Ok(())
}

/// Prints the angles and places of some wavelengths: by Snell's law, of a single path, and of the light on the screen.
fn compare(room: &Spectrograph, power: &SpectralPowerPipeline2D, places: &[f64]) -> raysect::Result<()> {
    println!("λ [nm]  index     deviation [deg]   of a path − law   place [mm]   on the screen");
    for wavelength in WAVELENGTHS {
        let (law, (traced, _)) = (room.deviation(wavelength)?, room.trace(wavelength)?);
        let width = (RANGE.1 - RANGE.0) / BINS as f64;
        let bin = ((wavelength - RANGE.0) / width) as usize;
        let expected = mean_place(room, wavelength, width)?;
        let seen = centroid(power, places, bin);
        println!(
            "{wavelength:<7} {:.6}  {law:<16.6}  {:<16.1e}  {:<11.3}  {:.3} ± {:.3}",
            room.index(wavelength),
            traced - law,
            1e3 * expected,
            1e3 * seen.value,
            1e3 * seen.error
        );
    }
    Ok(())
}

/// Where the light of a bin meets the screen on average [m]: within it all wavelengths are as bright, since lamps and glass
/// count as their averages over a bin.
fn mean_place(room: &Spectrograph, wavelength: f64, width: f64) -> raysect::Result<f64> {
    const PARTS: usize = 11;
    let mut sum = 0.0;
    for part in 0..PARTS {
        sum += room.trace(wavelength + width * ((part as f64 + 0.5) / PARTS as f64 - 0.5))?.1;
    }
    Ok(sum / PARTS as f64)
}

/// The centre of the light of a bin on the screen, with its standard error [m].
fn centroid(power: &SpectralPowerPipeline2D, places: &[f64], bin: usize) -> Estimate {
    let light: Vec<Estimate> = (0..places.len()).map(|pixel| power.bin(pixel, bin)).collect();
    let total: f64 = light.iter().map(|p| p.value).sum();
    let value = light.iter().zip(places).map(|(p, x)| p.value * x).sum::<f64>() / total;
    let variance: f64 = light.iter().zip(places).map(|(p, x)| ((x - value) * p.error).powi(2)).sum();
    Estimate { value, error: variance.sqrt() / total }
}
