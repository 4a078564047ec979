//! Compares this tracer with recorded numbers: `cargo run --release --example differential -- FILES`.

#[path = "../common/comparison.rs"]
mod comparison;
#[path = "../common/cornell.rs"]
mod cornell;
#[path = "../common/crossings.rs"]
mod crossings;
#[path = "../common/finding.rs"]
mod finding;
#[path = "../common/json.rs"]
mod json;
#[path = "../common/recorded_shape.rs"]
mod recorded_shape;
#[path = "../common/reference.rs"]
mod reference;
#[path = "../common/values/mod.rs"]
mod values;

use std::fs::File;
use std::io::{self, BufReader, Read};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::{Parser, ValueEnum};
use cornell::Variant;
use finding::Finding;
use serde_json::{Value, json};

/// Compares with frames of the Cornell box (`.npz` with `xyz_mean` and `xyz_error`, [row, column, XYZ]), with crossings
/// of rays with shapes (`.jsonl`, a case a line), and with values of functions and maps (`.json`, an object of sections).
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
    /// Sections and parts of them that cannot be compared.
    skipped: usize,
    refused: usize,
}

/// So many mismatches of a case are described.
const DESCRIBED: usize = 5;

fn main() -> ExitCode {
    let arguments = Arguments::parse();
    let mut tally = Tally::default();
    for file in &arguments.files {
        let done = match kind(file) {
            Ok(Kind::Frame) => frame(&arguments, file, &mut tally),
            Ok(Kind::Crossings) => crossings(&arguments, file, &mut tally),
            Ok(Kind::Values(content)) => values(&arguments, &content, &mut tally),
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
        let skipped = if tally.skipped > 0 { format!(", {} skipped", tally.skipped) } else { String::new() };
        println!("{} cases, {} mismatches{skipped}{refused}", tally.cases, tally.mismatches);
    }
    if tally.mismatches + tally.refused == 0 { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}

/// What a file holds, whatever its name.
enum Kind {
    Frame,
    Crossings,
    Values(Value),
}

/// A `.npz` is a ZIP archive; the first object of any other file tells what it is.
fn kind(file: &Path) -> io::Result<Kind> {
    let mut beginning = Vec::new();
    File::open(file)?.take(2).read_to_end(&mut beginning)?;
    if beginning == b"PK" {
        return Ok(Kind::Frame);
    }
    let text = BufReader::new(File::open(file)?);
    let first = serde_json::Deserializer::from_reader(text).into_iter::<Value>().next();
    Ok(match first {
        Some(Ok(content)) if content.get(values::TOLERANCE).is_some() => Kind::Values(content),
        _ => Kind::Crossings,
    })
}

/// Compares with a file of values.
fn values(arguments: &Arguments, content: &Value, tally: &mut Tally) -> Result<(), String> {
    let report = values::compare_all(content)?;
    for found in &report.findings {
        tally.cases += 1;
        tally.mismatches += found.mismatches.len();
        print(arguments, found);
    }
    tally.skipped += report.skipped.len();
    for name in report.skipped {
        match arguments.json {
            true => println!(
                "{}",
                json!({"id": name, "compared": 0, "mismatches": 0, "max_error": 0.0, "skipped": true})
            ),
            false => println!("{name} skipped: nothing here can compare it"),
        }
    }
    Ok(())
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
    let Finding { id, compared, mismatches, max_error } = found;
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
        false => println!("{id} {compared} {mismatches} {max_error:.2e}"),
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
