//! Rays that leave a surface meet neither that surface again nor pass the next one by.

use raysect::core::{Leaving, Node, Ray, Scene, Scratch, SurfacePoint, World};
use raysect::math::{AffineMatrix3D, Normal3D, Rng, SphereSampler, Vector3D, rotate, translate};

use super::bodies::{self, Body};
use super::wrong::{Fault, Wrong};
use super::{Cell, Tally};

/// Sizes [m].
const SCALES: [f64; 7] = [1e-9, 1e-6, 1e-3, 1.0, 1e3, 1e6, 1e9];
/// Bodies whose gaps or chords, where these are as thin as the rounding of their place, are not always seen.
const SHY: [&str; 12] = [
    "mesh cube",
    "mesh ball",
    "intersect",
    "cone",
    "parabola",
    "mesh bracket",
    "union",
    "subtract",
    "drilled ball",
    "biconcave lens",
    "meniscus",
    "plano-concave lens",
];
/// Distance of the node from the origin of the world, in sizes.
const OFFSETS: [f64; 6] = [0.0, 1.0, 1e3, 1e6, 1e8, 1e10];

/// How a ray begins.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Start {
    /// From the hit point, which it knows that it leaves.
    Leaving,
    /// From a point moved by a fixed distance [m] along the normal.
    Moved(f64),
}

/// Where rays go from a surface.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Habit {
    /// Into the solid, by the cosine.
    Diffuse,
    /// To both sides, one in four almost along the surface.
    Any,
}

pub(crate) fn cells() -> Vec<Cell> {
    let mut cells = Vec::new();
    for (i, scale) in SCALES.into_iter().enumerate() {
        for (j, offset) in OFFSETS.into_iter().enumerate() {
            for (n, body) in bodies::all(scale).into_iter().enumerate() {
                for habit in [Habit::Any, Habit::Diffuse] {
                    // In the test-suite each body is asked at every size and at every offset, not at every pair.
                    let turn = usize::from(habit == Habit::Diffuse);
                    let core = (i + j + n + turn).is_multiple_of(6);
                    let name = match habit {
                        Habit::Any => "either side",
                        Habit::Diffuse => "diffuse chain",
                    };
                    let name = format!("{} {scale:e} m, {offset:e} sizes off, {name}", body.name);
                    cells.push(cell(name, body.clone(), offset, habit, Start::Leaving).core(core));
                }
            }
        }
    }
    cells
}

pub(crate) fn controls() -> Vec<Cell> {
    let forgets = ["sphere", "cylinder", "torus", "mesh ball", "union", "meniscus"].map(|name| {
        let body = bodies::named(name, 1.0);
        let wrong = body.with_shape(Wrong(body.shape.clone(), Fault::Forgets));
        cell(format!("forgetful {name}"), wrong, 1e3, Habit::Diffuse, Start::Leaving)
    });
    let moved = [(1e-10, 0.0), (1.0, 1e8)].map(|(scale, offset)| {
        let name = format!("start moved by 1e-9 m, {scale:e} m, {offset:e} sizes off");
        cell(name, bodies::named("cuboid", scale), offset, Habit::Diffuse, Start::Moved(1e-9))
    });
    forgets.into_iter().chain(moved).collect()
}

fn cell(name: String, body: Body, offset: f64, habit: Habit, start: Start) -> Cell {
    Cell::new(name, 0.0, move |rays, tally| {
        let world = world(&body, offset);
        let scene = world.scene().unwrap();
        let mut walk = Walk { body: &body, scene, offset, habit, start, rng: Rng::new(5) };
        while tally.rays < rays {
            walk.chain(rays, tally);
        }
    })
}

/// The body, turned, so many of its sizes from the origin.
fn world(body: &Body, offset: f64) -> World<()> {
    let shift = Vector3D::new(0.6, -0.64, 0.48) * (offset * body.size);
    let place = translate(shift.x, shift.y, shift.z) * rotate(31.0, -64.0, 12.0);
    let mut world = World::<()>::new();
    world.add(Node::of(body.shape.clone(), ()).transform(place)).unwrap();
    world
}

struct Walk<'a> {
    body: &'a Body,
    scene: &'a Scene<()>,
    offset: f64,
    habit: Habit,
    start: Start,
    rng: Rng,
}

impl Walk<'_> {
    fn to_world(&self) -> &AffineMatrix3D {
        &self.scene.instances[0].to_world
    }

    /// A chain of rays from a point inside, until one escapes, is lost, or 64 have been judged.
    fn chain(&mut self, rays: u64, tally: &mut Tally) {
        let mut scratch = Scratch::default();
        let mut ray = Ray::new(*self.to_world() * self.body.inside, SphereSampler.sample(&mut self.rng));
        let mut before: Option<Leaving> = None;
        let mut from: Option<SurfacePoint> = None;
        for _ in 0..64 {
            let leaving = if self.start == Start::Leaving { before.as_ref() } else { None };
            let hit = self.scene.hit(&ray, leaving, &mut scratch);
            let next = hit.map(|hit| self.scene.finish(&ray, &hit));
            tally.ray();
            if let Some(what) = self.fault(from.as_ref(), &ray, next.as_ref()) {
                tally.fail(|| format!("{what}: {ray:?} from {from:?} to {next:?}"));
                return;
            }
            let Some(next) = next.filter(|_| tally.rays < rays) else { return };
            let towards = self.direction(next.normal);
            before = Some(Leaving::new(&next, ray.direction, towards, before.as_ref()));
            let origin = match self.start {
                Start::Leaving => next.point,
                Start::Moved(step) => {
                    next.point + next.normal.as_vector() * step.copysign(next.normal.dot(towards))
                }
            };
            ray = Ray::new(origin, towards);
            from = Some(next);
        }
    }

    /// The least cosine of rays along a surface: next to none, or that of an arc as high as the rounding of places.
    fn least_steep(&self) -> f64 {
        if SHY.contains(&self.body.name) {
            (64.0 * f64::EPSILON * (self.offset + 4.0)).sqrt().min(0.05)
        } else {
            1e-15
        }
    }

    fn direction(&mut self, normal: Normal3D) -> Vector3D {
        let (n, v) = (normal.as_vector(), SphereSampler.sample(&mut self.rng));
        if self.habit == Habit::Diffuse {
            return (v * (1.0 - 1e-9) - n).normalise_unchecked();
        }
        let side = if self.rng.uniform() < 0.7 { -1.0 } else { 1.0 };
        let tangent = v - n * v.dot(n);
        let steep = if self.rng.uniform() < 0.25 {
            10f64.powf(self.rng.range(self.least_steep().log10(), -1.0))
        } else {
            v.dot(n).abs()
        };
        let out = (tangent.normalise_unchecked() + n * (side * steep)).normalise_unchecked();
        if out.dot(n) * side > 0.0 { out } else { n * side }
    }

    /// What is wrong with a step: the kind of the hit, its place, its claim about its error, or what lies between.
    fn fault(&self, from: Option<&SurfacePoint>, ray: &Ray, next: Option<&SurfacePoint>) -> Option<String> {
        let inward = from.is_none_or(|s| s.normal.dot(ray.direction) < 0.0);
        let length = match next {
            None if inward => return Some("lost inside".to_owned()),
            None => 4.0 * self.body.size,
            Some(s) if s.exiting != inward => return Some("wrong kind".to_owned()),
            // Far from the origin of the world an edge may be as near as that.
            Some(s) if s.distance == 0.0 && self.habit == Habit::Diffuse && self.offset <= 1e3 => {
                return Some("stuck".to_owned());
            }
            Some(s) => s.distance,
        };
        let local = &self.scene.instances[0].to_local;
        let bounds = [from, next].map(|s| s.map_or(0.0, |s| s.bound));
        // Sixteen roundings of each length that enters, and as many again for what the shape itself rounds.
        let honest = 256.0 * f64::EPSILON * (self.offset + 4.0) * self.body.size;
        if bounds.iter().any(|b| *b > honest) {
            return Some(format!("bound {bounds:?} above {honest:e}"));
        }
        let doubt = 2.0 * (bounds[0] + bounds[1]) + 8.0 * f64::EPSILON * self.body.size;
        if let Some(s) = next {
            let off = self.body.depth(s.local_point);
            if off.abs() > doubt {
                return Some(format!("{off:e} m beside the surface"));
            }
        }
        // Close to both ends, and evenly in between.
        let places = [1e-6, 1e-4, 1e-2, 0.1, 0.25, 0.4, 0.55, 0.7, 0.85, 0.95, 0.99, 0.9999];
        places.into_iter().find_map(|place| {
            let depth = self.body.depth(local.transform_point(ray.point_at(length * place)));
            let depth = if inward { depth } else { -depth };
            (depth < -doubt)
                .then(|| format!("{depth:e} m on the wrong side at {place}, {doubt:e} m in doubt"))
        })
    }
}
