//! Compares this tracer with recorded numbers: `cargo run --release --example differential -- FILES`.

#[path = "../common/comparison.rs"]
mod comparison;
#[path = "../common/cornell.rs"]
mod cornell;
#[path = "../common/crossings.rs"]
mod crossings;
#[path = "../common/json.rs"]
mod json;
#[path = "../common/recorded_shape.rs"]
mod recorded_shape;
#[path = "../common/reference.rs"]
mod reference;

use std::fs::File;
use std::io::{self, BufReader, Read};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::{Parser, ValueEnum};
use cornell::Variant;
use crossings::Finding;
use serde_json::json;

/// Compares with frames of the Cornell box (`.npz` with `xyz_mean` and `xyz_error`, [row, column, XYZ]), and with
/// crossings of rays with shapes (`.jsonl`, a case a line).
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
    /// One JSON object a line for each case instead of sentences.
    #[arg(long)]
    json: bool,
}

#[derive(Clone, Copy, ValueEnum)]
enum Blocks {
    Glass,
    Diffuse,
}

/// How many cases were compared, and how much of them differs.
#[derive(Default)]
struct Tally {
    cases: usize,
    mismatches: usize,
    refused: usize,
}

/// So many mismatches of a case are described.
const DESCRIBED: usize = 5;

fn main() -> ExitCode {
    let arguments = Arguments::parse();
    let mut tally = Tally::default();
    for file in &arguments.files {
        let done = match is_archive(file) {
            Ok(true) => frame(&arguments, file, &mut tally),
            Ok(false) => crossings(&arguments, file, &mut tally),
            Err(e) => Err(e.to_string()),
        };
        if let Err(what) = done {
            eprintln!("{}: {what}", file.display());
            tally.refused += 1;
        }
    }
    if !arguments.json {
        let refused = match tally.refused {
            0 => String::new(),
            1 => ", 1 file refused".to_owned(),
            files => format!(", {files} files refused"),
        };
        println!("{} cases, {} mismatches{refused}", tally.cases, tally.mismatches);
    }
    if tally.mismatches + tally.refused == 0 { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}

/// True for a `.npz`, which is a ZIP archive, under whatever name.
fn is_archive(file: &Path) -> io::Result<bool> {
    let mut beginning = Vec::new();
    File::open(file)?.take(2).read_to_end(&mut beginning)?;
    Ok(beginning == b"PK")
}

/// Compares with a file of crossings.
fn crossings(arguments: &Arguments, file: &Path, tally: &mut Tally) -> Result<(), String> {
    let text = BufReader::new(File::open(file).map_err(|e| e.to_string())?);
    crossings::compare_all(text, |found| {
        tally.cases += 1;
        tally.mismatches += found.mismatches.len();
        print(arguments, &found);
    })
}

fn print(arguments: &Arguments, found: &Finding) {
    let Finding { id, rays, compared, mismatches, max_error } = found;
    for sentence in mismatches.iter().take(DESCRIBED) {
        eprintln!("{id}: {sentence}");
    }
    if mismatches.len() > DESCRIBED {
        eprintln!("{id}: and {} more", mismatches.len() - DESCRIBED);
    }
    let mismatches = mismatches.len();
    match arguments.json {
        true => println!(
            "{}",
            json!({"id": id, "compared": compared, "mismatches": mismatches, "max_error": max_error})
        ),
        false => println!("{id} {rays} {mismatches} {max_error:.2e}"),
    }
}

/// Compares with one frame.
fn frame(arguments: &Arguments, file: &Path, tally: &mut Tally) -> Result<(), String> {
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
    tally.cases += 1;
    tally.mismatches += usize::from(!holds);
    if arguments.json {
        let line = json!({
            "id": file.display().to_string(),
            "compared": found.elements,
            "mismatches": usize::from(!holds),
            "outliers": found.outliers,
            "mean_z": found.mean_z,
            "sd_z": found.deviation_z,
            "worst_block": found.worst_block,
            "worst_total": found.worst_total,
            "median_error": found.median_error,
        });
        println!("{line}");
        return Ok(());
    }
    println!("{}: {}x{} pixels, {found}", file.display(), theirs.columns, theirs.rows);
    for (criterion, holds) in found.criteria(error) {
        println!("  {} {criterion}", if holds { "ok  " } else { "FAIL" });
    }
    Ok(())
}
