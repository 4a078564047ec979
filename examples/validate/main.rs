//! Solves problems that have an answer in closed form: `cargo run --release --example validate`.

// It has readers for other examples, too.
#[allow(dead_code)]
#[path = "../common/json.rs"]
mod json;
#[path = "../common/validation/mod.rs"]
mod validation;

use std::path::PathBuf;
use std::process::ExitCode;

use clap::Parser;
use rayon::prelude::*;
use raysect::math::Statistics;
use serde_json::json;
use validation::{Case, Fault, Reading, Verdict, judge, measure, read_cases};

/// Furnaces, slabs, prisms, lenses, form factors, line integrals, colours and sensors against closed forms.
///
/// What is left to chance must lie within 4 of its own standard errors, which must be at most 2e-3 of the value;
/// everything else within the tolerance of its case. Ends with exit code 1 if a case fails.
#[derive(Parser)]
struct Arguments {
    /// Another file of cases.
    #[arg(long)]
    cases: Option<PathBuf>,
    /// Only the cases whose names begin like this.
    #[arg(long, default_value = "")]
    filter: String,
    /// One JSON object a line instead of a table.
    #[arg(long)]
    json: bool,
    /// The first seed.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// So many seeds, one after the other: are the errors honest?
    #[arg(long, default_value_t = 1)]
    seeds: u64,
    /// Makes a material wrong on purpose: some cases must fail.
    #[arg(long, value_enum)]
    fault: Option<Fault>,
}

/// The cases that come with the program.
const OWN: &str = include_str!("../../tests/data/cases.json");

/// The readings of a case, one a seed; none if its kind is not known.
type Readings = Option<Vec<Result<Reading, String>>>;

fn main() -> ExitCode {
    let arguments = Arguments::parse();
    match run(&arguments) {
        Ok(0) => ExitCode::SUCCESS,
        Ok(_) => ExitCode::FAILURE,
        Err(what) => {
            eprintln!("{what}");
            ExitCode::FAILURE
        }
    }
}

/// Runs the cases; how many have failed.
fn run(arguments: &Arguments) -> Result<usize, String> {
    let cases = match &arguments.cases {
        None => read_cases(OWN)?,
        Some(file) => {
            let content = std::fs::read_to_string(file).map_err(|e| format!("{}: {e}", file.display()))?;
            read_cases(&content).map_err(|e| format!("{}: {e}", file.display()))?
        }
    };
    let chosen: Vec<&Case> = cases.iter().filter(|c| c.id.starts_with(&arguments.filter)).collect();
    if !arguments.json {
        println!("{:<12} {:>16} {:>26} {:>10} {:>7}  verdict", "id", "expected", "measured", "off", "z");
    }
    let read = |case: &&Case| readings(case, arguments);
    let all: Vec<Readings> = chosen.par_iter().map(read).collect();
    let (mut failed, mut skipped) = (0, 0);
    for (case, readings) in chosen.iter().zip(&all) {
        match readings {
            None => {
                skipped += 1;
                print_skipped(arguments, case);
            }
            Some(readings) => failed += readings.iter().filter(|r| !print(arguments, case, r)).count(),
        }
    }
    if arguments.seeds > 1 {
        print_honesty(&chosen, &all);
    }
    if !arguments.json {
        println!("{} cases, {failed} failed, {skipped} skipped", chosen.len());
    }
    Ok(failed)
}

/// Reads a case once for each seed, and once only if nothing is left to chance.
fn readings(case: &Case, arguments: &Arguments) -> Readings {
    let read = |seed: u64| measure(case, seed, arguments.fault);
    let mut all = vec![read(arguments.seed)?];
    let noisy = all[0].as_ref().is_ok_and(|r| r.error > 0.0);
    let more = if noisy { arguments.seed + 1..arguments.seed + arguments.seeds } else { 0..0 };
    all.extend(more.filter_map(read));
    Some(all)
}

fn print_skipped(arguments: &Arguments, case: &Case) {
    if arguments.json {
        println!("{}", json!({"id": case.id, "expected": case.expected, "skipped": true}));
    } else {
        println!(
            "{:<12} skipped: nothing here knows the kind '{}' with these parameters",
            case.id, case.kind
        );
    }
}

/// Prints a reading and what is to be said of it; `false` unless it passes.
fn print(arguments: &Arguments, case: &Case, reading: &Result<Reading, String>) -> bool {
    let (reading, verdict, why) = match reading {
        Ok(reading) => (*reading, judge(case, reading), String::new()),
        Err(why) => (Reading::exact(f64::NAN), Verdict::Failed, format!(": {why}")),
    };
    let Reading { mean, error } = reading;
    let passed = verdict == Verdict::Passed;
    if arguments.json {
        println!(
            "{}",
            json!({"id": case.id, "expected": case.expected, "mean": mean, "stderr": error,
                   "skipped": false, "passed": passed})
        );
        return passed;
    }
    let scale = if case.expected == 0.0 { 1.0 } else { case.expected.abs() };
    let off = (mean - case.expected) / scale;
    let z = reading.z(case.expected).map_or(String::from("-"), |z| format!("{z:+.2}"));
    let measured = if error > 0.0 { format!("{mean:.8e} ± {error:.1e}") } else { format!("{mean:.12e}") };
    let word = match verdict {
        Verdict::Passed => "ok",
        Verdict::Failed => "FAILED",
        Verdict::Noisy => "FAILED: too noisy",
    };
    println!("{:<12} {:>16.9e} {measured:>26} {off:>+10.1e} {z:>7}  {word}{why}", case.id, case.expected);
    passed
}

/// Says how the readings of many seeds scatter, and how much they claim to scatter.
fn print_honesty(cases: &[&Case], all: &[Readings]) {
    let mut scores = Statistics::new();
    let (mut claimed, mut scattered, mut count) = (0.0, 0.0, 0);
    for (case, readings) in cases.iter().zip(all) {
        let readings: Vec<&Reading> = readings.iter().flatten().flatten().filter(|r| r.error > 0.0).collect();
        if readings.len() < 2 {
            continue;
        }
        let mut values = Statistics::new();
        for reading in &readings {
            values.add(reading.mean);
            scores.add((reading.mean - case.expected) / reading.error);
        }
        let mean_square = readings.iter().map(|r| r.error * r.error).sum::<f64>() / readings.len() as f64;
        // In units of the claimed variance, so that all cases count alike.
        claimed += 1.0;
        scattered += values.variance() / mean_square;
        count += 1;
    }
    println!(
        "z of {} readings of {count} cases: mean {:+.3}, standard deviation {:.3}; claimed errors are {:.3} of the scatter",
        scores.count(),
        scores.mean(),
        scores.variance().sqrt(),
        (claimed / f64::max(scattered, f64::MIN_POSITIVE)).sqrt(),
    );
}
