//! Runs the judges of a family with as many rays as a test-suite can afford.

use crate::judges::{Cell, FAMILIES, Family};

/// Rays of an ordinary cell.
const RAYS: u64 = 10_000;

fn family(name: &str) -> &'static Family {
    FAMILIES.iter().find(|f| f.name == name).unwrap()
}

/// Asserts that every cell holds.
pub(crate) fn accept(name: &str) {
    let mut wrong = Vec::new();
    let cells: Vec<Cell> = (family(name).cells)().into_iter().filter(|c| c.core).collect();
    assert!(!cells.is_empty());
    for cell in &cells {
        let tally = cell.run(RAYS);
        println!(
            "{:<70} {:>8} rays, {} wrong, {:.3e} of {:.1e}",
            cell.name, tally.rays, tally.failures, tally.worst, tally.limit
        );
        if !tally.holds() {
            wrong.push(format!("{}: {} of {}, {:?}", cell.name, tally.failures, tally.rays, tally.first));
        }
    }
    assert!(wrong.is_empty(), "{} of {} cells:\n{}", wrong.len(), cells.len(), wrong.join("\n"));
}

/// Asserts that what is wrong on purpose is refused, every cell of it.
pub(crate) fn refuse(name: &str) {
    let cells = (family(name).controls)();
    assert!(!cells.is_empty());
    for cell in &cells {
        let tally = cell.run(RAYS);
        println!("{:<70} {:>8} rays, {} wrong: {:?}", cell.name, tally.rays, tally.failures, tally.first);
        assert!(tally.rays > 0 && tally.failures > 0, "{name}: \"{}\" is not refused", cell.name);
    }
}
