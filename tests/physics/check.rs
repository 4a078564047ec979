//! The measurement of every case, and the one judge of all of them.

use std::fmt;

use raysect::core::Ray;
use raysect::math::{Point3D, Rng, Statistics, StreamKey, Vector3D};
use raysect::optical::{Ledger, LightSampling, Path, PathSettings, Slicing, World};

/// Standard errors by which a mean may lie off.
const SIGMAS: f64 = 4.0;
/// Largest relative standard error with which a mean says anything.
const NOISE: f64 = 0.003;
/// Relative error of a value without noise.
const ROUNDING: f64 = 1e-12;

/// All ways in which paths look for light.
pub(crate) const EVERY: [LightSampling; 3] =
    [LightSampling::Lights, LightSampling::BoundingSpheres, LightSampling::Off];

/// What many paths have read.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Reading {
    pub(crate) radiance: Statistics,
    pub(crate) lowest: f64,
    pub(crate) highest: f64,
    pub(crate) ledger: Ledger,
}

/// How many paths are sent out, and how.
#[derive(Debug, Clone)]
pub(crate) struct Probe {
    pub(crate) settings: PathSettings,
    pub(crate) seed: u64,
    pub(crate) count: u64,
}

impl Probe {
    /// A number of paths with the settings of a new user.
    pub(crate) fn new(count: u64) -> Self {
        Self { settings: PathSettings::default(), seed: 1, count }
    }

    /// With another search for light.
    pub(crate) fn light(self, sampling: LightSampling) -> Self {
        Self { settings: self.settings.light_sampling(sampling), ..self }
    }

    /// With another share of paths that are aimed at what is important.
    pub(crate) fn aim(self, share: f64) -> Self {
        Self { settings: self.settings.important_path_weight(share).unwrap(), ..self }
    }

    /// With another seed.
    pub(crate) fn seed(self, seed: u64) -> Self {
        Self { seed, ..self }
    }

    /// With roulette below another throughput.
    pub(crate) fn roulette(self, threshold: f64) -> Self {
        Self { settings: self.settings.roulette_threshold(threshold).unwrap(), ..self }
    }

    /// Without roulette.
    pub(crate) fn without_roulette(self) -> Self {
        self.roulette(0.0)
    }

    /// With another greatest depth.
    pub(crate) fn max_depth(self, depth: u32) -> Self {
        Self { settings: self.settings.max_depth(depth), ..self }
    }

    /// Reads what arrives at a point from a direction.
    pub(crate) fn along(&self, world: &World, origin: [f64; 3], direction: [f64; 3]) -> Reading {
        let ray = Ray::new(Point3D::from(origin), Vector3D::from(direction));
        self.each(world, |_| ray)
    }

    /// Reads what arrives along rays that are drawn one by one.
    pub(crate) fn each(&self, world: &World, draw: impl Fn(&mut Rng) -> Ray) -> Reading {
        let slices = Slicing::new(500.0, 501.0, 1, 1).unwrap().slices();
        let mut path = Path::new(world.scene().unwrap(), &slices[0], &self.settings);
        let (mut lowest, mut highest) = (f64::INFINITY, f64::NEG_INFINITY);
        let mut radiance = Statistics::new();
        for sample in 0..self.count {
            let mut rng = Rng::keyed(StreamKey { seed: self.seed, sample, ..StreamKey::default() });
            let ray = draw(&mut rng);
            let value = path.follow(&ray, rng)[0];
            assert!(value.is_finite() && value >= 0.0, "path {sample} of seed {} reads {value}", self.seed);
            (lowest, highest) = (value.min(lowest), value.max(highest));
            radiance.add(value);
        }
        let ledger = *path.ledger();
        assert_eq!(unaccounted(&ledger), 0, "{ledger:?}");
        assert_eq!((ledger.paths, ledger.inconsistencies), (self.count, 0), "{ledger:?}");
        Reading { radiance, lowest, highest, ledger }
    }
}

/// Paths without exactly one fate: fewer fates than paths count positive, more negative.
pub(crate) fn unaccounted(ledger: &Ledger) -> i64 {
    let fates = ledger.absorbed + ledger.escaped + ledger.killed + ledger.truncated + ledger.lost;
    ledger.paths as i64 - fates as i64
}

/// What is asked of a reading.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Demand {
    /// Every single path reads the value to rounding.
    Exact,
    /// The mean does, within its error, and the error is small enough to mean something.
    Mean,
}

/// Why a reading is not accepted.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Rejection {
    /// The mean or its error is not a number.
    NotFinite,
    /// The relative standard error is too large for a verdict.
    Noisy(f64),
    /// The mean is so many standard errors off.
    MeanOff(f64),
    /// A single path has read this.
    PathOff(f64),
}

impl fmt::Display for Rejection {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotFinite => f.write_str("not finite"),
            Self::Noisy(error) => write!(f, "relative standard error {error:.1e}: too noisy"),
            Self::MeanOff(z) => write!(f, "mean off by {z:.1} standard errors"),
            Self::PathOff(value) => write!(f, "a single path reads {value}"),
        }
    }
}

/// Judges a reading against the value that it should have. All cases and all negative controls go through here.
pub(crate) fn check(expected: f64, demand: Demand, reading: &Reading) -> Result<(), Rejection> {
    let (mean, error) = (reading.radiance.mean(), reading.radiance.error());
    if !mean.is_finite() || error.is_nan() {
        return Err(Rejection::NotFinite);
    }
    let rounding = ROUNDING * expected.abs();
    if demand == Demand::Exact {
        let off = [reading.lowest, reading.highest].into_iter().find(|v| (v - expected).abs() > rounding);
        return off.map_or(Ok(()), |v| Err(Rejection::PathOff(v)));
    }
    let relative = error / mean.abs().max(expected.abs());
    if relative > NOISE {
        return Err(Rejection::Noisy(relative));
    }
    if (mean - expected).abs() > SIGMAS * error + rounding {
        return Err(Rejection::MeanOff((mean - expected) / error));
    }
    Ok(())
}

/// Asserts that a reading passes, and writes a line of the report that `--nocapture` shows.
#[track_caller]
pub(crate) fn accept(case: impl fmt::Display, expected: f64, demand: Demand, reading: &Reading) {
    let (mean, error) = (reading.radiance.mean(), reading.radiance.error());
    let z = if error > ROUNDING * expected { (mean - expected) / error } else { 0.0 };
    println!(
        "{case:<44} {expected:<12.9} {mean:<12.9} ± {error:.1e} ({:.2} %)  z {z:+.2}",
        1e2 * error / mean
    );
    if let Err(rejection) = check(expected, demand, reading) {
        panic!("{case}: expected {expected}, read {mean} ± {error}: {rejection}");
    }
}

/// Asserts that a reading is judged wrong: not for want of paths, but by its value.
#[track_caller]
pub(crate) fn refuse(case: impl fmt::Display, expected: f64, demand: Demand, reading: &Reading) {
    let verdict = check(expected, demand, reading);
    println!("{case:<44} refused: {verdict:?}");
    assert!(
        matches!(verdict, Err(Rejection::MeanOff(_) | Rejection::PathOff(_))),
        "{case} should be judged wrong, but: {verdict:?}, {reading:?}"
    );
}

/// Asserts that two readings of the same quantity agree within their errors.
#[track_caller]
pub(crate) fn agree(case: impl fmt::Display, a: &Reading, b: &Reading) {
    let (a, b) = (a.radiance, b.radiance);
    let error = a.error().hypot(b.error());
    let z = (a.mean() - b.mean()) / error;
    println!("{case:<44} {a} and {b}: z {z:+.2}");
    assert!(a.error() < 0.01 * a.mean() && b.error() < 0.01 * b.mean(), "{case}: too noisy, {a:?} {b:?}");
    assert!(z.abs() <= SIGMAS, "{case}: {a} and {b} differ by {z:.1} standard errors");
}

/// The value of a case of the table of closed forms.
pub(crate) fn expected(id: &str) -> f64 {
    let table = include_str!("../data/analytic_cases.txt");
    let row = table.lines().find(|l| l.split(" | ").next() == Some(id));
    row.and_then(|r| r.split(" | ").nth(1)).and_then(|v| v.parse().ok()).expect(id)
}
