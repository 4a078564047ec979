//! The Cornell box against Raysect 0.9.1: paths per second, error against time, and scaling, both sides in one run.
//!
//! `cargo bench --bench cornell`; the other side runs if `RAYSECT_PYTHON` names a Python that has it (see
//! `benches/peers/README.md`).

#[path = "../examples/common/cornell.rs"]
mod cornell;

use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Instant;

use cornell::Variant;
use raysect::observer::file::{NpyData, load_npz};
use raysect::optical::colour::CieObserver;
use raysect::prelude::*;

const PIXELS: usize = 128;
const THREADS: usize = 2;

/// One rendering: luminances, and the time it took [s].
struct Rendering {
    luminance: Vec<f64>,
    seconds: f64,
    paths: f64,
}

fn ours(world: &World, samples: u64, threads: usize, seed: u64) -> raysect::Result<Rendering> {
    let camera =
        cornell::camera((PIXELS, PIXELS))?.pixel_samples(samples).seed(seed).quiet(true).threads(threads)?;
    let mut rgb = RgbPipeline2D::new().observer(CieObserver::FiveNanometres);
    let start = Instant::now();
    let report = camera.observe(world, &mut rgb)?;
    let seconds = start.elapsed().as_secs_f64();
    let luminance = rgb.frame().mean().iter().skip(1).step_by(3).copied().collect();
    Ok(Rendering { luminance, seconds, paths: report.samples as f64 })
}

fn theirs(python: &str, variant: Variant, samples: u64, seed: u64) -> Result<Rendering, String> {
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("benches/peers/cornell_raysect.py");
    let output: PathBuf = std::env::temp_dir().join(format!("raysect-peer-{}.npz", std::process::id()));
    let (samples, pixels) = (samples.to_string(), PIXELS.to_string());
    let name = if variant == Variant::Glass { "glass" } else { "diffuse" };
    let run = Command::new(python)
        .arg(script)
        .args(["--variant", name, "--pixels", &pixels, "--samples", &samples, "--bins", "15"])
        .args(["--processes", &THREADS.to_string(), "--seed", &seed.to_string(), "--output"])
        .arg(&output)
        .output()
        .map_err(|e| format!("{python}: {e}"))?;
    if !run.status.success() {
        return Err(String::from_utf8_lossy(&run.stderr).into_owned());
    }
    let text = String::from_utf8_lossy(&run.stdout);
    let number = |key: &str| -> Result<f64, String> {
        let rest = text.split(&format!("\"{key}\":")).nth(1).ok_or(format!("no {key} in {text}"))?;
        let end = rest.find([',', '}']).ok_or("unfinished JSON")?;
        rest[..end].trim().parse().map_err(|e| format!("{key}: {e}"))
    };
    let (seconds, rate) = (number("wall_seconds")?, number("paths_per_s")?);
    let arrays = load_npz(&output).map_err(|e| e.to_string())?;
    let _ = std::fs::remove_file(&output);
    match arrays.get("xyz_mean").map(|a| &a.data) {
        Some(NpyData::F64(xyz)) => {
            let luminance = xyz.iter().skip(1).step_by(3).copied().collect();
            Ok(Rendering { luminance, seconds, paths: rate * seconds })
        }
        _ => Err("no xyz_mean".to_owned()),
    }
}

/// Mean square of the relative difference from a reference, without the reference's own noise.
fn error_squared(r: &Rendering, reference: &Rendering, noise: f64) -> f64 {
    let n = reference.luminance.len() as f64;
    let mean = reference.luminance.iter().sum::<f64>() / n;
    let sum: f64 = r.luminance.iter().zip(&reference.luminance).map(|(a, b)| (a - b).powi(2)).sum();
    sum / n / (mean * mean) - noise
}

fn compare(variant: Variant, rounds: u64) -> raysect::Result<()> {
    let world = cornell::cornell_box(variant)?;
    let name = if variant == Variant::Glass { "glass" } else { "diffuse" };
    // Halves of a long run tell the noise of the whole.
    let halves = [ours(&world, 800, THREADS, 1001)?, ours(&world, 800, THREADS, 1002)?];
    let mean = halves[0].luminance.iter().zip(&halves[1].luminance).map(|(a, b)| 0.5 * (a + b)).collect();
    let reference = Rendering { luminance: mean, seconds: 0.0, paths: 0.0 };
    let noise = 0.25 * error_squared(&halves[0], &halves[1], 0.0);
    let (our_samples, their_samples) = (64, 16);
    let python = std::env::var("RAYSECT_PYTHON").ok();
    let (mut rates, mut efficiencies) = (Vec::new(), Vec::new());
    for round in 0..rounds {
        let a = ours(&world, our_samples, THREADS, round + 1)?;
        let squared = error_squared(&a, &reference, noise);
        let (rate, efficiency) = (a.paths / a.seconds, 1.0 / (squared * a.seconds));
        println!(
            "{name} raysect-rs    {rate:.3e} paths/s, rmse {:.4}, 1/(rmse² s) {efficiency:.1}",
            squared.sqrt()
        );
        let Some(python) = &python else { continue };
        match theirs(python, variant, their_samples, round + 1) {
            Ok(b) => {
                let squared = error_squared(&b, &reference, noise);
                let (their_rate, their_efficiency) = (b.paths / b.seconds, 1.0 / (squared * b.seconds));
                println!(
                    "{name} Raysect 0.9.1 {their_rate:.3e} paths/s, rmse {:.4}, 1/(rmse² s) {their_efficiency:.1}",
                    squared.sqrt()
                );
                rates.push(rate / their_rate);
                efficiencies.push(efficiency / their_efficiency);
            }
            Err(what) => println!("{name}: the other side did not run: {what}"),
        }
    }
    let median = |v: &mut Vec<f64>| {
        v.sort_by(f64::total_cmp);
        v.get(v.len() / 2).copied()
    };
    if let (Some(rate), Some(efficiency)) = (median(&mut rates), median(&mut efficiencies)) {
        println!(
            "{name}: {rate:.2} times the paths per second, {efficiency:.1} times the efficiency (medians)\n"
        );
    } else {
        println!("{name}: set RAYSECT_PYTHON to measure Raysect 0.9.1 in the same run\n");
    }
    Ok(())
}

/// From one thread to two, in interleaved rounds; the best of each, since other work only ever slows down.
fn scaling(rounds: usize) -> raysect::Result<()> {
    let world = cornell::cornell_box(Variant::Diffuse)?;
    let mut best = [0.0f64; THREADS];
    for round in 0..rounds {
        for threads in 1..=THREADS {
            let r = ours(&world, 16 * threads as u64, threads, round as u64)?;
            best[threads - 1] = best[threads - 1].max(r.paths / r.seconds);
        }
    }
    println!("one thread {:.3e} paths/s, two {:.3e}: {:.2} times", best[0], best[1], best[1] / best[0]);
    Ok(())
}

fn main() -> raysect::Result<()> {
    // `cargo test --benches` only wants to know that it runs.
    let (rounds, repeats) = if std::env::args().any(|a| a == "--test") { (1, 1) } else { (5, 10) };
    scaling(repeats)?;
    compare(Variant::Diffuse, rounds)?;
    compare(Variant::Glass, rounds)
}
