//! Solids seen from afar: distances, hits and misses against 32 digits.

use raysect::core::{Crossing, Interval, Ray, Scratch};
use raysect::math::Rng;

use super::bodies::Shape;
use super::double_double::dd;
use super::exact::Plain;
use super::wrong::{Fault, Wrong};
use super::{Cell, Tally};

/// Roundings of the distance by which a surface may seem displaced.
const LIMIT: f64 = 4.0;
/// Roundings of the distance by which a line must be clear of the limb to be judged.
const LIMB: f64 = 8.0;

/// Sizes [m], for the torus.
const SCALES: [f64; 3] = [1e-3, 1.0, 1e3];

pub(crate) fn cells() -> Vec<Cell> {
    let mut cells = Vec::new();
    for exponent in 1..=9 {
        for (name, plain) in Plain::all(1.0) {
            if matches!(plain, Plain::Torus(..)) {
                continue;
            }
            let core = [1, 3, 5, 7, 9].contains(&exponent);
            cells.push(cell(name, plain, plain.shape(), exponent, LIMIT).core(core));
        }
    }
    for scale in SCALES {
        for tube in [0.05, 0.4, 0.95] {
            for exponent in 1..=6 {
                let plain = Plain::Torus(scale, tube * scale);
                let name = format!("torus {scale:e} m, tube {tube}");
                cells.push(
                    cell(&name, plain, plain.shape(), exponent, LIMIT).share(0.05).core(exponent % 2 == 0),
                );
            }
        }
    }
    cells
}

pub(crate) fn controls() -> Vec<Cell> {
    let all = |fault: Fault, name: &'static str| {
        Plain::all(1.0).map(move |(kind, plain)| {
            let share = if kind == "torus" { 0.1 } else { 1.0 };
            let shape: Shape = std::sync::Arc::new(Wrong(plain.shape(), fault));
            cell(&format!("{name} {kind}"), plain, shape, 3, LIMIT).share(share)
        })
    };
    let mut cells: Vec<Cell> = all(Fault::Stretches(1e-13), "stretched").into();
    cells.extend(all(Fault::Misses(100), "missed"));
    cells
}

fn cell(name: &str, plain: Plain, shape: Shape, exponent: i32, limit: f64) -> Cell {
    let k = 10f64.powi(exponent);
    Cell::new(format!("{name} from 1e{exponent} sizes [ε distance]"), limit, move |rays, tally| {
        let mut rng = Rng::new(exponent as u64);
        let mut scratch = Scratch::default();
        for _ in 0..rays {
            let ray = plain.aimed(k, &mut rng);
            judge(plain, &shape, &ray, k, &mut scratch, tally);
        }
    })
}

/// Compares one line with 32 digits.
fn judge(plain: Plain, shape: &Shape, ray: &Ray, k: f64, scratch: &mut Scratch, tally: &mut Tally) {
    tally.ray();
    let (exact, mut found) = (plain.crossings(ray), Vec::new());
    shape.crossings(ray, scratch, &mut found);
    let unit = f64::EPSILON * (k + 1.0) * plain.size();
    if exact.len() != found.len() {
        let clear = !plain.is_near_limb(ray, LIMB * unit);
        tally.check(!clear, || format!("{} crossings, not {}: {ray:?}", found.len(), exact.len()));
        return;
    }
    let first = shape.hit(ray, Interval::AHEAD, scratch);
    let same = first.map(|c: Crossing| c.distance) == found.first().map(|c| c.distance);
    tally.check(same, || format!("the first hit {first:?} is not {:?}", found.first()));
    for (crossing, t) in found.iter().zip(exact) {
        let off = (dd(crossing.distance) - t).value().abs();
        // A line along the surface has no sharper place than rounding of its height allows.
        let cosine = plain.normal(&ray.into(), t).dot(ray.direction).abs();
        tally.error(off * cosine / unit, || format!("{off:e} m off at {crossing:?}: {ray:?}"));
    }
}
