//! Composites of bodies with faces in common: what lies inside along a line is the sum of exact pieces, without gap or skin.

use std::sync::Arc;

use raysect::core::{Crossing, Primitive, Ray, Scratch};
use raysect::math::{AffineMatrix3D, Point3D, Rng, SphereSampler, rotate, translate};
use raysect::primitive::{Intersect, Place, Subtract, Union};

use super::Cell;
use super::bodies::{Shape, map};
use super::double_double::{Dd, dd};
use super::exact::{Line, Plain};
use super::wrong::{Fault, Wrong};

/// Error of a length inside [m].
const LIMIT: f64 = 1e-8;
/// Shorter stretches and gaps are not told from none [m].
const SLIVER: f64 = 1e-9;

#[derive(Debug, Clone, Copy, PartialEq)]
enum Operation {
    Union,
    Intersect,
    Subtract,
}

use Operation::{Intersect as Both, Subtract as Without, Union as Either};

impl Operation {
    fn keeps(self, a: bool, b: bool) -> bool {
        match self {
            Either => a || b,
            Both => a && b,
            Without => a && !b,
        }
    }
}

/// A plain solid, moved by exact numbers, or two of them.
#[derive(Debug, Clone)]
enum Part {
    Plain(Plain, [f64; 3]),
    Of(Operation, Box<(Part, Part)>),
}

fn at(plain: Plain, x: f64, y: f64, z: f64) -> Part {
    Part::Plain(plain, [x, y, z])
}

fn of(operation: Operation, a: Part, b: Part) -> Part {
    Part::Of(operation, Box::new((a, b)))
}

fn slab(low: f64, high: f64) -> Part {
    at(Plain::Cuboid([-1.0, -1.0, low], [1.0, 1.0, high]), 0.0, 0.0, 0.0)
}

impl Part {
    fn shape(&self, frame: &AffineMatrix3D) -> Shape {
        match self {
            Self::Plain(plain, [x, y, z]) => {
                let whole = plain.shape().placed(*frame * translate(*x, *y, *z));
                // A body united with itself is that body; all parts are placed by maps of their own.
                Arc::new(Union::new(whole.clone(), whole).unwrap())
            }
            Self::Of(operation, pair) => {
                let (a, b) = (pair.0.shape(frame), pair.1.shape(frame));
                match operation {
                    Either => Arc::new(Union::new(a, b).unwrap()),
                    Both => Arc::new(Intersect::new(a, b).unwrap()),
                    Without => Arc::new(Subtract::new(a, b).unwrap()),
                }
            }
        }
    }

    /// The stretches of a line that lie inside.
    fn stretches(&self, line: &Line) -> Vec<[Dd; 2]> {
        match self {
            Self::Plain(plain, shift) => {
                let from = [0, 1, 2].map(|i| line.from[i] - dd(shift[i]));
                let ends = plain.crossings_of(&Line { from, ..*line });
                ends.chunks_exact(2).map(|pair| [pair[0], pair[1]]).collect()
            }
            Self::Of(operation, pair) => {
                combine(*operation, &pair.0.stretches(line), &pair.1.stretches(line))
            }
        }
    }
}

/// Pieces between all ends, kept if their middle is; pieces that touch become one.
fn combine(operation: Operation, a: &[[Dd; 2]], b: &[[Dd; 2]]) -> Vec<[Dd; 2]> {
    let mut ends: Vec<Dd> = a.iter().chain(b).flatten().copied().collect();
    ends.sort_by(|x, y| x.partial_cmp(y).unwrap());
    let mut out: Vec<[Dd; 2]> = Vec::new();
    for pair in ends.windows(2) {
        let middle = (pair[0] + pair[1]) * dd(0.5);
        let within = |list: &[[Dd; 2]]| list.iter().any(|s| s[0] <= middle && middle <= s[1]);
        if pair[0] >= pair[1] || !operation.keeps(within(a), within(b)) {
            continue;
        }
        match out.last_mut() {
            Some(last) if last[1] == pair[0] => last[1] = pair[1],
            _ => out.push([pair[0], pair[1]]),
        }
    }
    out
}

fn ball(radius: f64, z: f64) -> Part {
    at(Plain::Sphere(radius), 0.0, 0.0, z)
}

/// Along the axis, from both ends: the length inside is known to the last digit.
fn axis_cases() -> Vec<(&'static str, Part, f64)> {
    let chain =
        (1..10).fold(slab(0.0, 1.0), |body, i| of(Either, body, slab(f64::from(i), f64::from(i + 1))));
    let rod = at(Plain::Cylinder(0.75, 1.0), 0.0, 0.0, 0.0);
    let spike = at(Plain::Cone(0.75, 1.0), 0.0, 0.0, 1.0);
    vec![
        ("union, face in common", of(Either, slab(0.0, 1.0), slab(1.0, 2.0)), 2.0),
        ("union of twins", of(Either, slab(0.0, 1.0), slab(0.0, 1.0)), 1.0),
        ("intersection of twins", of(Both, slab(0.0, 1.0), slab(0.0, 1.0)), 1.0),
        ("difference of twins", of(Without, slab(0.0, 1.0), slab(0.0, 1.0)), 0.0),
        ("lower half off", of(Without, slab(0.0, 2.0), slab(0.0, 1.0)), 1.0),
        ("upper half off", of(Without, slab(0.0, 2.0), slab(1.0, 2.0)), 1.0),
        ("middle off", of(Without, slab(0.0, 3.0), slab(1.0, 2.0)), 2.0),
        ("intersection, face in common", of(Both, slab(0.0, 1.0), slab(1.0, 2.0)), 0.0),
        ("difference, face in common", of(Without, slab(0.0, 1.0), slab(1.0, 2.0)), 1.0),
        ("ten boxes", chain, 10.0),
        ("ball without a ball that touches from inside", of(Without, ball(1.0, 0.0), ball(0.5, 0.5)), 1.0),
        ("two balls that touch", of(Either, ball(1.0, 0.0), ball(1.0, 2.0)), 4.0),
        ("a cone on a rod", of(Either, rod, spike), 2.0),
    ]
}

fn frame_cases() -> Vec<(&'static str, Part)> {
    let rod = |radius: f64, z: f64| at(Plain::Cylinder(radius, 1.0), 0.0, 0.0, z);
    let dish = |z: f64| at(Plain::Parabola(0.75, 1.0), 0.0, 0.0, z);
    let ring = || at(Plain::Torus(1.0, 0.25), 0.0, 0.0, 0.5);
    let mut cases: Vec<(&'static str, Part)> =
        axis_cases().into_iter().map(|(name, part, _)| (name, part)).collect();
    cases.extend([
        ("rod on a slab", of(Either, slab(-1.0, 0.0), rod(0.75, 0.0))),
        ("rod on a rod", of(Either, rod(0.75, 0.0), rod(0.75, 1.0))),
        ("tube", of(Without, rod(0.75, 0.0), rod(0.5, 0.0))),
        ("slab with a hole", of(Without, slab(0.0, 1.0), rod(0.75, 0.0))),
        ("hole filled again", of(Either, of(Without, slab(0.0, 1.0), rod(0.75, 0.0)), rod(0.75, 0.0))),
        ("dish on a slab", of(Either, slab(-1.0, 0.0), dish(0.0))),
        ("ring without itself", of(Without, ring(), ring())),
        ("ring with itself", of(Both, ring(), ring())),
        ("ring on a slab", of(Either, ring(), slab(-0.5, 0.25))),
    ]);
    cases
}

pub(crate) fn cells() -> Vec<Cell> {
    let mut cells: Vec<Cell> = axis_cases()
        .into_iter()
        .map(|(name, part, length)| {
            along_axis(format!("{name}, along the axis [m]"), part, length, |s| s).share(0.01)
        })
        .collect();
    for (name, part) in frame_cases() {
        let share = if name.starts_with("ring") { 0.02 } else { 0.15 };
        cells.push(in_frames(format!("{name}, in random frames [m]"), part, |s| s).share(share));
    }
    cells
}

pub(crate) fn controls() -> Vec<Cell> {
    fn longer(s: Shape) -> Shape {
        Arc::new(Wrong(s, Fault::Stretches(1e-7)))
    }
    fn gap(s: Shape) -> Shape {
        let wedge = Plain::Cuboid([-0.7, -0.7, 1.0 - 1e-7], [0.7, 0.7, 1.0 + 1e-7]).shape();
        Arc::new(Subtract::new(s, wedge).unwrap())
    }
    let two = || of(Either, slab(0.0, 1.0), slab(1.0, 2.0));
    vec![
        along_axis("stretched".to_owned(), two(), 2.0, longer).share(0.01),
        along_axis("a gap of 0.2 µm".to_owned(), two(), 2.0, gap).share(0.01),
        in_frames("stretched, in random frames".to_owned(), two(), longer).share(0.1),
    ]
}

fn total(all: &[Crossing], speed: f64) -> f64 {
    all.chunks(2).map(|pair| (pair[pair.len() - 1].distance - pair[0].distance) * speed).sum()
}

fn along_axis(name: String, part: Part, length: f64, spoil: fn(Shape) -> Shape) -> Cell {
    Cell::new(name, LIMIT, move |rays, tally| {
        let body = spoil(part.shape(&AffineMatrix3D::IDENTITY));
        let (mut scratch, mut all) = (Scratch::default(), Vec::new());
        for i in 0..rays.max(2) {
            let sign = if i % 2 == 0 { 1.0 } else { -1.0 };
            let direction = raysect::math::Vector3D::Z * sign;
            let ray = Ray::new(Point3D::new(0.0, 0.0, 5.0) - direction * (10.0 + i as f64), direction);
            all.clear();
            body.crossings(&ray, &mut scratch, &mut all);
            tally.ray();
            tally.error((total(&all, 1.0) - length).abs(), || format!("{all:?}: {ray:?}"));
            let shortest = all.chunks(2).map(|p| p[p.len() - 1].distance - p[0].distance).fold(1.0, f64::min);
            tally.check(shortest > 1e-3 || part.touches(), || format!("a skin: {all:?}"));
        }
    })
}

impl Part {
    /// True for balls, which may touch in a point.
    fn touches(&self) -> bool {
        match self {
            Self::Plain(plain, _) => matches!(plain, Plain::Sphere(_)),
            Self::Of(_, pair) => pair.0.touches() || pair.1.touches(),
        }
    }
}

fn in_frames(name: String, part: Part, spoil: fn(Shape) -> Shape) -> Cell {
    Cell::new(name, LIMIT, move |rays, tally| {
        let mut rng = Rng::new(71);
        let (mut scratch, mut all) = (Scratch::default(), Vec::new());
        while tally.rays < rays {
            let [x, y, z] = [0, 1, 2].map(|_| rng.range(-3.0, 3.0));
            let s = rng.range(0.5, 2.0);
            let turn = rotate(rng.range(-180.0, 180.0), rng.range(-90.0, 90.0), rng.range(-180.0, 180.0));
            let frame = translate(x, y, z) * turn * map([s, 0.0, 0.0], [0.0, s, 0.0], [0.0, 0.0, s]);
            let body = spoil(part.shape(&frame));
            for _ in 0..15 {
                let direction = SphereSampler.sample(&mut rng);
                let target = [0, 1, 2].map(|_| rng.range(-1.0, 1.0));
                let target = Point3D::new(target[0], target[1], target[2] + 1.0);
                let local = Ray::new(target - direction * 5.0, direction);
                let ray = Ray::new(frame * local.origin, frame * local.direction);
                tally.ray();
                let exact = part.stretches(&(&local).into());
                all.clear();
                body.crossings(&ray, &mut scratch, &mut all);
                let length: f64 = exact.iter().map(|s| (s[1] - s[0]).value()).sum();
                tally.error((total(&all, 1.0) - length).abs(), || format!("{all:?}, not {exact:?}: {ray:?}"));
                // Where a stretch or a gap is next to nothing, rounding decides whether it is.
                let gaps = exact.windows(2).map(|w| (w[1][0] - w[0][1]).value());
                let least = exact.iter().map(|s| (s[1] - s[0]).value()).chain(gaps).fold(1.0, f64::min);
                let counted = all.len() == 2 * exact.len() || least < SLIVER;
                tally.check(counted, || format!("{} crossings, not {exact:?}: {ray:?}", all.len()));
            }
        }
    })
}
