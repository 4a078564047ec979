//! Compares this tracer with recorded numbers: `cargo run --release --example differential -- FILES`.

#[path = "../common/comparison.rs"]
mod comparison;
#[path = "../common/cornell.rs"]
mod cornell;
#[path = "../common/reference.rs"]
mod reference;

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::{Parser, ValueEnum};
use cornell::Variant;

/// Compares with frames of the Cornell box (`.npz` with `xyz_mean` and `xyz_error`, [row, column, XYZ]).
#[derive(Parser)]
struct Arguments {
    /// Files of recorded numbers.
    #[arg(required = true)]
    files: Vec<PathBuf>,
    /// What the blocks are made of, where the file's name does not tell.
    #[arg(long, value_enum)]
    variant: Option<Blocks>,
    /// Bins of the spectrum, 375 to 740 nm.
    #[arg(long, default_value_t = 15)]
    bins: usize,
    /// Seed of our samples.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Median relative error of our picture.
    #[arg(long, default_value_t = 0.01)]
    error: f64,
    /// One JSON object a file instead of sentences.
    #[arg(long)]
    json: bool,
}

#[derive(Clone, Copy, ValueEnum)]
enum Blocks {
    Glass,
    Diffuse,
}

fn main() -> ExitCode {
    let arguments = Arguments::parse();
    let mut failures = 0;
    for file in &arguments.files {
        match frame(&arguments, file) {
            Ok(true) => {}
            Ok(false) => failures += 1,
            Err(what) => {
                eprintln!("{}: {what}", file.display());
                failures += 1;
            }
        }
    }
    if !arguments.json {
        println!("{} files, {failures} mismatches", arguments.files.len());
    }
    if failures == 0 { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}

/// Compares with one frame; `false` if a criterion does not hold.
fn frame(arguments: &Arguments, file: &Path) -> Result<bool, String> {
    let variant = match arguments.variant {
        Some(Blocks::Glass) => Variant::Glass,
        Some(Blocks::Diffuse) => Variant::Diffuse,
        None => reference::variant_of(file)
            .ok_or("the name says neither 'glass' nor 'diffuse': add --variant glass or --variant diffuse")?,
    };
    let theirs = reference::load(file)?;
    let (bins, seed, error) = (arguments.bins, arguments.seed, arguments.error);
    let ours = reference::render(variant, theirs.columns, theirs.rows, bins, seed, error);
    let found = comparison::compare(&ours.map_err(|e| e.to_string())?, &theirs)?;
    let holds = found.holds(error);
    if arguments.json {
        println!(
            "{{\"id\":{:?},\"compared\":{},\"mismatches\":{},\"outliers\":{},\"mean_z\":{},\"sd_z\":{},\"worst_block\":{},\"worst_total\":{},\"median_error\":{}}}",
            file.display().to_string(),
            found.elements,
            usize::from(!holds),
            found.outliers,
            found.mean_z,
            found.deviation_z,
            found.worst_block,
            found.worst_total,
            found.median_error
        );
        return Ok(holds);
    }
    println!("{}: {}x{} pixels, {found}", file.display(), theirs.columns, theirs.rows);
    for (criterion, holds) in found.criteria(error) {
        println!("  {} {criterion}", if holds { "ok  " } else { "FAIL" });
    }
    Ok(holds)
}
