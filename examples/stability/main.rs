//! Asks where geometry fails: `cargo run --release --example stability`.
//!
//! Every cell of the grids of `tests/stability`, those included that the test-suite leaves out, against exact arithmetic and
//! closed forms. With the rays of a cell not given, one cell in eight, chosen by its name and `ROTATION`, is asked ten
//! times as much as the others.

#[path = "../common/stability/mod.rs"]
mod judges;

use std::process::ExitCode;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

use clap::Parser;
use judges::{Cell, FAMILIES, Tally};

/// Which cells are asked with more rays; another number picks others.
const ROTATION: u64 = 1;
/// Rays of a cell, and of one that is chosen.
const RAYS: [u64; 2] = [100_000, 1_000_000];

/// Where geometry fails: tables of cells, rays, failures and the worst error.
#[derive(Parser)]
struct Arguments {
    /// Rays of each cell; without it 1e5, and 1e6 for one cell in eight.
    #[arg(long)]
    rays: Option<u64>,
    /// Only families whose name contains this, or cells of them whose name does.
    #[arg(long)]
    only: Option<String>,
    /// One JSON object a cell instead of tables.
    #[arg(long)]
    json: bool,
    /// Only the cells of the test-suite.
    #[arg(long)]
    core: bool,
}

fn main() -> ExitCode {
    let arguments = Arguments::parse();
    let (mut asked, mut failed) = (0, 0);
    for family in FAMILIES {
        let wanted = |cell: &Cell| {
            let named = |only: &String| family.name.contains(only) || cell.name.contains(only);
            arguments.only.as_ref().is_none_or(named) && (cell.core || !arguments.core)
        };
        let cells: Vec<Cell> = (family.cells)().into_iter().filter(wanted).collect();
        if cells.is_empty() {
            continue;
        }
        let controls = (family.controls)();
        let rays = |cell: &Cell| arguments.rays.unwrap_or(RAYS[usize::from(is_chosen(&cell.name))]);
        let answers = ask(&cells, rays);
        let refused = ask(&controls, |_| arguments.rays.map_or(10_000, |rays| rays.max(10_000)));
        let missed: Vec<&Cell> =
            controls.iter().zip(&refused).filter(|(_, t)| t.failures == 0).map(|(c, _)| c).collect();
        asked += cells.len();
        failed += answers.iter().filter(|t| !t.holds()).count() + missed.len();
        if arguments.json {
            cells.iter().zip(&answers).for_each(|(cell, tally)| json(family.name, cell, tally));
        } else {
            table(family.name, &cells, &answers);
            println!("{} controls, {} not refused", controls.len(), missed.len());
            missed.iter().for_each(|cell| println!("  NOT REFUSED {}", cell.name));
        }
    }
    if !arguments.json {
        println!("\n{asked} cells, {failed} failures");
    }
    if failed == 0 && asked > 0 { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}

/// One name in eight, by a hash of it (FNV-1a).
fn is_chosen(name: &str) -> bool {
    let mix = |hash: u64, byte: u8| (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
    let hash = name.bytes().fold(0xcbf2_9ce4_8422_2325 ^ ROTATION, mix);
    (hash >> 32).is_multiple_of(8)
}

/// Asks all cells, on as many threads as there are processors; each has random numbers of its own.
fn ask(cells: &[Cell], rays: impl Fn(&Cell) -> u64 + Sync) -> Vec<Tally> {
    let next = AtomicUsize::new(0);
    let answers = Mutex::new(vec![None; cells.len()]);
    let work = || {
        while let Some((number, cell)) =
            Some(next.fetch_add(1, Ordering::Relaxed)).and_then(|n| Some((n, cells.get(n)?)))
        {
            let tally = cell.run(rays(cell));
            answers.lock().unwrap()[number] = Some(tally);
        }
    };
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    std::thread::scope(|scope| (0..threads).for_each(|_| drop(scope.spawn(work))));
    answers.into_inner().unwrap().into_iter().flatten().collect()
}

fn verdict(tally: &Tally) -> &'static str {
    if tally.holds() { "ok" } else { "FAIL" }
}

fn table(family: &str, cells: &[Cell], answers: &[Tally]) {
    println!("\n{family}");
    println!("{:<72} {:>9} {:>9} {:>10} {:>9}", "cell", "rays", "failures", "worst", "limit");
    for (cell, tally) in cells.iter().zip(answers) {
        let Tally { rays, failures, worst, limit, first } = tally;
        println!("{:<72} {rays:>9} {failures:>9} {worst:>10.2e} {limit:>9.1e} {}", cell.name, verdict(tally));
        if let Some(first) = first {
            println!("    first: {first}");
        }
    }
}

fn json(family: &str, cell: &Cell, tally: &Tally) {
    let finite = |x: f64| if x.is_finite() { format!("{x:e}") } else { "null".to_owned() };
    println!(
        "{{\"family\":{family:?},\"cell\":{:?},\"rays\":{},\"failures\":{},\"worst\":{},\"limit\":{},\"verdict\":{:?}}}",
        cell.name,
        tally.rays,
        tally.failures,
        finite(tally.worst),
        finite(tally.limit),
        verdict(tally)
    );
}
