//! Acceptance of line integrals: thin sheets of emission at 10 000 random places and tilts in a path of one metre.

use std::f64::consts::{SQRT_2, TAU};
use std::ops::Range;
use std::thread;

use raysect_core::Ray;
use raysect_math::{Point3D, Rng, Statistics, StreamKey, Vector3D};
use raysect_optical::{
    Context, InhomogeneousVolumeEmitter, Material, Path, PathSettings, Slicing, WithMaterial, World,
};
use raysect_primitive::Cuboid;

/// How many sheets are asked.
const SHEETS: u64 = 10_000;

/// A sheet of emission in a box of 1 m: Gaussian of standard deviation `width`, or a top hat that wide.
#[derive(Debug, Clone, Copy)]
struct Sheet {
    place: f64,
    width: f64,
    tilt: Vector3D,
    gaussian: bool,
}

impl Sheet {
    /// From 0.3 to 20 mm, anywhere in the box, tilted by up to 84°.
    fn draw(rng: &mut Rng) -> Self {
        let cosine = rng.range(0.1, 1.0);
        let (sine, angle) = ((1.0 - cosine * cosine).sqrt(), TAU * rng.uniform());
        Self {
            place: rng.range(0.02, 0.98),
            width: 10f64.powf(rng.range(0.3e-3f64.log10(), 20e-3f64.log10())),
            tilt: Vector3D::new(sine * angle.cos(), sine * angle.sin(), cosine),
            gaussian: rng.probability(0.5),
        }
    }

    /// Distance from the middle of the sheet, in widths.
    fn depth(&self, p: Point3D) -> f64 {
        (p.x * self.tilt.x + p.y * self.tilt.y + (p.z - self.place) * self.tilt.z) / self.width
    }

    fn value(&self, p: Point3D) -> f64 {
        let t = self.depth(p);
        if self.gaussian { (-0.5 * t * t).exp() } else { f64::from(u8::from(t.abs() < 0.5)) }
    }

    /// The integral along the axis of the box, between its ends.
    fn expected(&self) -> f64 {
        let along = self.width / self.tilt.z;
        let (low, high) = (-self.place / along, (1.0 - self.place) / along);
        if self.gaussian {
            along * (0.5 * TAU).sqrt() / SQRT_2 * (libm::erf(high / SQRT_2) - libm::erf(low / SQRT_2))
        } else {
            along * (high.min(0.5) - low.max(-0.5))
        }
    }

    fn emission(self) -> impl Fn(Point3D, Vector3D, Context<'_>, &mut [f64]) + Send + Sync + 'static {
        move |p, _, _, bins| bins.iter_mut().for_each(|b| *b += self.value(p))
    }

    /// Where a ray passes the faces of a top hat.
    fn breaks(self) -> impl Fn(&Ray, &mut Vec<f64>) + Send + Sync + 'static {
        move |ray, out| {
            let (from, rate) = (self.depth(ray.origin), self.tilt.dot(ray.direction) / self.width);
            out.extend([(-0.5 - from) / rate, (0.5 - from) / rate]);
        }
    }
}

fn sheets(seed: u64, count: u64) -> impl Iterator<Item = Sheet> {
    let mut rng = Rng::new(seed);
    (0..count).map(move |_| Sheet::draw(&mut rng))
}

/// Statistics of paths along the axis of a box of the emitter, none of which has been given up.
fn read(emitter: impl Material, count: u64, seed: u64) -> Statistics {
    let mut world = World::new();
    let cuboid = Cuboid::new(Point3D::new(-0.5, -0.5, 0.0), Point3D::new(0.5, 0.5, 1.0)).unwrap();
    world.add(cuboid.material(emitter)).unwrap();
    let slices = Slicing::new(500.0, 501.0, 1, 1).unwrap().slices();
    let settings = PathSettings::default();
    let mut path = Path::new(world.scene().unwrap(), &slices[0], &settings);
    let ray = Ray::new(Point3D::new(0.0, 0.0, -0.3), Vector3D::Z);
    let mut all = Statistics::new();
    for sample in 0..count {
        all.add(path.follow(&ray, Rng::keyed(StreamKey { seed, sample, ..StreamKey::default() }))[0]);
    }
    assert_eq!(path.ledger().unresolved, 0);
    all
}

/// How far one path is off, relative to what it should read.
fn off(sheet: &Sheet, emitter: impl Material) -> f64 {
    (read(emitter, 1, 1).mean() / sheet.expected() - 1.0).abs()
}

#[test]
fn declared_lengths_are_integrated_to_the_tolerance() {
    let mut worst: f64 = 0.0;
    for sheet in sheets(7, SHEETS) {
        let emitter = InhomogeneousVolumeEmitter::length_scale(sheet.width, sheet.emission()).unwrap();
        let off = off(&sheet, emitter);
        assert!(off < 1e-6, "{sheet:?}: off by {off:e}");
        worst = worst.max(off);
    }
    println!("{SHEETS} sheets with their length scale: off by {worst:.1e} at most");
}

#[test]
fn declared_breakpoints_leave_nothing_but_rounding() {
    let mut worst: f64 = 0.0;
    for sheet in sheets(11, SHEETS).map(|sheet| Sheet { gaussian: false, ..sheet }) {
        let emitter = InhomogeneousVolumeEmitter::length_scale(1.0, sheet.emission()).unwrap();
        let off = off(&sheet, emitter.breaks(sheet.breaks()));
        assert!(off < 1e-11, "{sheet:?}: off by {off:e}");
        worst = worst.max(off);
    }
    println!("{SHEETS} top hats with their breakpoints: off by {worst:.1e} at most");
}

#[test]
fn the_trapezium_rule_misses_sheets_and_a_wrong_declaration_too() {
    let (mut trapezium, mut wrong) = (0, 0);
    for sheet in sheets(7, 100) {
        let steps = InhomogeneousVolumeEmitter::trapezium(0.01, 5, sheet.emission()).unwrap();
        trapezium += usize::from(off(&sheet, steps) > 1e-3);
        let coarse = InhomogeneousVolumeEmitter::length_scale(1.0, sheet.emission()).unwrap();
        wrong += usize::from(off(&sheet, coarse) > 1e-3);
    }
    assert!(trapezium > 30 && wrong > 10, "{trapezium} {wrong}");
}

/// How many paths go through a jittered sheet.
const PATHS: u64 = 400;

/// By how many standard errors each of some jittered sheets is off, by its number. Threads share the work, which is that
/// of millions of paths.
fn scores(of: Range<u64>) -> Vec<f64> {
    let score = |(seed, sheet): (usize, Sheet)| {
        let emitter = InhomogeneousVolumeEmitter::jittered(0.01, sheet.emission()).unwrap();
        let found = read(emitter, PATHS, seed as u64);
        (found.mean() - sheet.expected()) / found.error()
    };
    sheets(8, of.end).enumerate().skip(of.start as usize).map(score).collect()
}

#[test]
fn jittered_sheets_have_no_bias_and_error_bars_that_cover() {
    let all: Vec<f64> = thread::scope(|scope| {
        let halves = [0..SHEETS / 2, SHEETS / 2..SHEETS].map(|half| scope.spawn(|| scores(half)));
        halves.into_iter().flat_map(|half| half.join().unwrap()).collect()
    });
    assert_eq!(all.len() as u64, SHEETS);
    let covered = |factor: f64| all.iter().filter(|z| z.abs() < 1.96 * factor).count() as f64 / SHEETS as f64;
    let mut scores = Statistics::new();
    all.iter().for_each(|z| scores.add(*z));
    println!("{SHEETS} jittered sheets: {:.2} % within 1.96 errors, scores {scores}", 100.0 * covered(1.0));
    assert!((covered(1.0) - 0.95).abs() < 0.01, "{}", covered(1.0));
    assert!(scores.mean().abs() < 4.0 * scores.error(), "{scores}");
    // Error bars that are a tenth too short are told, and so is a bias of a tenth of one.
    assert!((covered(0.9) - 0.95).abs() > 0.01, "{}", covered(0.9));
    assert!(0.1 > 4.0 * scores.error());
}
