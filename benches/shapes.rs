//! Rays against worlds of shapes: this tracer and Raysect 0.9.1, the same worlds and the same rays, in turn in one run.
//!
//! A miss costs Raysect little more than the call; since many rays of the sets miss, those that hit are measured besides.
//! Its `World.hit` asks one ray at a time; so does this tracer here, but for the last two ways, which give all rays to
//! `Scene::hit_all` at once, on all processors.
//!
//! `cargo bench --bench shapes [-- NAME …]`; the other side runs if `RAYSECT_PYTHON` names a Python that has it (see
//! `benches/peers/README.md`).

#[path = "../examples/common/rays.rs"]
mod rays;

use std::hint::black_box;
use std::path::Path;
use std::process::Command;
use std::sync::Arc;
use std::time::Instant;

use rays::Order;
use raysect::core::{Interval, Node, Primitive, Ray, Scratch, World};
use raysect::prelude::{
    Cone, Cuboid, Cylinder, Intersect, Parabola, Place, Point3D, Sphere, Subtract, Torus, Union, rotate,
    translate,
};

const WORLDS: [&str; 7] = ["sphere", "cuboid", "cylinder", "cone", "parabola", "torus", "composites"];

/// Puts a shape into a world, and has it besides.
fn add(world: &mut World<()>, shape: impl Primitive + Clone) -> raysect::Result<Single> {
    world.add(shape.clone())?;
    Ok(Some(Arc::new(shape)))
}

/// The shape that a world has by itself.
type Single = Option<Arc<dyn Primitive>>;

/// A world by its name, and its shape.
fn world(name: &str) -> raysect::Result<(World<()>, Single)> {
    let mut world = World::new();
    let shape = match name {
        "sphere" => add(&mut world, Sphere::new(1.0)?)?,
        "cuboid" => add(&mut world, Cuboid::centred(1.0, 1.2, 0.8)?)?,
        "cylinder" => add(&mut world, Cylinder::new(0.7, 1.2)?)?,
        "cone" => add(&mut world, Cone::new(0.7, 1.2)?)?,
        "parabola" => add(&mut world, Parabola::new(0.7, 1.2)?)?,
        "torus" => add(&mut world, Torus::new(0.7, 0.3)?)?,
        _ => {
            composites(&mut world)?;
            None
        }
    };
    Ok((world, shape))
}

/// Four bodies of a ball, a cube and three drillings, and a lens of two balls, in a large box: the scene of Raysect's
/// demonstration `csg.py`.
fn composites(world: &mut World<()>) -> raysect::Result<()> {
    let drilling = Cylinder::new(1.0, 4.2)?;
    let along = |a: f64, b: f64| drilling.placed(rotate(a, b, 0.0) * translate(0.0, 0.0, -2.1));
    let drillings = Union::new(Union::new(along(90.0, 0.0), along(0.0, 90.0))?, along(0.0, 0.0))?;
    let body = Intersect::new(Sphere::new(2.0)?, Subtract::new(Cuboid::centred(3.0, 3.0, 3.0)?, drillings)?)?;
    for (x, y, a, b) in [
        (-2.1, 2.1, 30.0, -20.0),
        (2.1, 2.1, -30.0, -20.0),
        (2.1, -2.1, -30.0, 20.0),
        (-2.1, -2.1, 30.0, 20.0),
    ] {
        world.add(Node::of(body.clone(), ()).transform(translate(x, y, 2.5) * rotate(a, b, 0.0)))?;
    }
    let lens = Intersect::new(
        Sphere::new(1.0)?.placed(translate(0.0, 0.0, 0.99)),
        Sphere::new(0.5)?.placed(translate(0.0, 0.0, -0.49)),
    )?;
    world.add(Node::of(lens, ()).transform(translate(0.0, 0.0, -3.6) * rotate(50.0, 50.0, 0.0)))?;
    world.add(Cuboid::new(Point3D::new(-50.0, -50.0, 50.0), Point3D::new(50.0, 50.0, 50.1))?)?;
    world.add(Cuboid::centred(200.0, 200.0, 200.0)?)?;
    Ok(())
}

/// The ways in which a world is asked: all rays of both orders, those of them that hit, the shape alone, and all rays of
/// both orders at once, to which the other side has the first two as an answer.
const WAYS: [&str; 8] = [
    "coherent",
    "incoherent",
    "coherent, hits",
    "incoherent, hits",
    "coherent, alone",
    "incoherent, alone",
    "coherent, at once",
    "incoherent, at once",
];

/// The rays of the first four ways.
fn sets(name: &str, world: &World<()>, count: usize) -> raysect::Result<[Vec<Ray>; 4]> {
    let (centre, radius) = if name == "composites" { (Point3D::ORIGIN, 4.0) } else { (Point3D::ORIGIN, 1.0) };
    let [coherent, incoherent] =
        [Order::Coherent, Order::Incoherent].map(|order| rays::rays(order, centre, radius, count));
    let scene = world.scene()?;
    let mut scratch = Scratch::default();
    let mut hitting = |rays: &[Ray]| {
        rays.iter().copied().filter(|ray| scene.hit(ray, None, &mut scratch).is_some()).collect()
    };
    let hits = [hitting(&coherent), hitting(&incoherent)];
    let [first, second] = hits;
    Ok([coherent, incoherent, first, second])
}

/// Hits per second of a set of rays, each with the surface that was hit, as Raysect's `World.hit` answers.
fn ours(world: &World<()>, rays: &[Ray]) -> raysect::Result<f64> {
    let scene = world.scene()?;
    let mut scratch = Scratch::default();
    Ok(rate(rays, |ray| {
        let hit = scene.hit(ray, None, &mut scratch);
        hit.as_ref().map_or(0.0, |hit| scene.finish(ray, hit).bound)
    }))
}

/// The same of a shape alone, in its own space. The crossing is lent where it lies: a copy, which is read in larger pieces
/// than it has been written in, would wait for memory.
fn alone(shape: &dyn Primitive, rays: &[Ray]) -> f64 {
    let mut scratch = Scratch::default();
    rate(rays, |ray| {
        let hit = black_box(shape).hit(ray, Interval::AHEAD, &mut scratch);
        hit.as_ref().map_or(0.0, |hit| shape.surface(ray, hit).bound)
    })
}

/// The same of all rays at once, on all processors.
fn at_once(world: &World<()>, rays: &[Ray]) -> raysect::Result<f64> {
    let scene = world.scene()?;
    let pass = |_| {
        let start = Instant::now();
        black_box(scene.hit_all(rays));
        rays.len() as f64 / start.elapsed().as_secs_f64()
    };
    Ok((0..PASSES).map(pass).fold(0.0, f64::max))
}

/// Calls per second: the best of some passes, which other work on the machine disturbs least.
fn rate(rays: &[Ray], mut call: impl FnMut(&Ray) -> f64) -> f64 {
    let pass = |_| {
        let start = Instant::now();
        black_box(rays.iter().map(&mut call).sum::<f64>());
        rays.len() as f64 / start.elapsed().as_secs_f64()
    };
    (0..PASSES).map(pass).fold(0.0, f64::max)
}

/// How often either side goes through a set in a round.
const PASSES: usize = 5;

/// Hits per second of each way, and how many rays of the first two sets hit the world.
fn theirs(python: &str, name: &str, sets: &[Vec<Ray>; 4]) -> Result<([f64; 6], [usize; 2]), String> {
    let path = std::env::temp_dir().join(format!("raysect-rays-{}", std::process::id()));
    let numbers = |rays: &[Ray]| -> Vec<u8> {
        let each = rays.iter().flat_map(|r| r.origin.to_array().into_iter().chain(r.direction.to_array()));
        each.flat_map(f64::to_le_bytes).collect()
    };
    let files = ["0", "1", "2", "3"].map(|number| path.with_extension(number));
    for (file, rays) in files.iter().zip(sets) {
        std::fs::write(file, numbers(rays)).map_err(|e| e.to_string())?;
    }
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("benches/peers/shapes_raysect.py");
    let run = Command::new(python).arg(script).arg(name).args(&files).output().map_err(|e| e.to_string())?;
    files.iter().for_each(|file| drop(std::fs::remove_file(file)));
    if !run.status.success() {
        return Err(String::from_utf8_lossy(&run.stderr).into_owned());
    }
    let text = String::from_utf8_lossy(&run.stdout);
    let wrong = || format!("not six numbers and two counts: {text}");
    let mut words = text.split_whitespace();
    let rates: Vec<f64> = words.by_ref().take(6).filter_map(|x| x.parse().ok()).collect();
    let counts: Vec<usize> = words.filter_map(|x| x.parse().ok()).collect();
    Ok((rates.try_into().map_err(|_| wrong())?, counts.try_into().map_err(|_| wrong())?))
}

/// The best of all rounds.
fn best(rates: Vec<f64>) -> f64 {
    rates.into_iter().reduce(f64::max).unwrap_or(f64::NAN)
}

fn main() -> raysect::Result<()> {
    // `cargo test --benches` only wants to know that it runs.
    let test = std::env::args().any(|a| a == "--test");
    let (count, rounds) = if test { (1 << 8, 1) } else { (1 << 15, 5) };
    let python = std::env::var("RAYSECT_PYTHON").ok().filter(|_| !test);
    let wanted: Vec<String> = std::env::args().skip(1).filter(|a| !a.starts_with('-')).collect();
    for name in WORLDS.into_iter().filter(|n| wanted.is_empty() || wanted.iter().any(|w| w == n)) {
        let (world, shape) = world(name)?;
        let sets = sets(name, &world, count)?;
        let counts = [sets[2].len(), sets[3].len()];
        let share = |set: usize| 100.0 * counts[set] as f64 / sets[set].len() as f64;
        println!("{name:<11} hit by {:.1} % and {:.1} % of the rays", share(0), share(1));
        let mut rates: [[Vec<f64>; 8]; 2] = Default::default();
        for _ in 0..rounds {
            for (way, rays) in sets.iter().enumerate() {
                rates[0][way].push(ours(&world, rays)?);
            }
            for way in 0..2 {
                rates[0][4 + way].push(shape.as_ref().map_or(f64::NAN, |shape| alone(shape, &sets[way])));
                rates[0][6 + way].push(at_once(&world, &sets[way])?);
            }
            match python.as_ref().map(|python| theirs(python, name, &sets)) {
                Some(Ok((found, theirs))) => {
                    let found = found.into_iter().chain([found[0], found[1]]);
                    rates[1].iter_mut().zip(found).for_each(|(rates, rate)| rates.push(rate));
                    if theirs != counts {
                        println!("{name:<11} {counts:?} rays hit here, {theirs:?} there");
                    }
                }
                Some(Err(what)) => println!("{name}: the other side did not run: {what}"),
                None => {}
            }
        }
        let [mine, other] = rates.map(|all| all.map(best));
        for (way, (a, b)) in WAYS.iter().zip(mine.into_iter().zip(other)).filter(|(_, (a, _))| !a.is_nan()) {
            let ratio =
                if b.is_nan() { String::new() } else { format!("   Raysect {b:.3e}   ratio {:.1}", a / b) };
            println!("{name:<11} {way:<19} {a:.3e} hits/s{ratio}");
        }
    }
    Ok(())
}
