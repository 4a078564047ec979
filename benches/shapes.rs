//! Rays against worlds of shapes: this tracer and Raysect 0.9.1, the same worlds and the same rays, in turn in one run.
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

/// A shape that a world has by itself.
fn shape(name: &str) -> raysect::Result<Option<Arc<dyn Primitive>>> {
    Ok(Some(match name {
        "sphere" => Arc::new(Sphere::new(1.0)?),
        "cuboid" => Arc::new(Cuboid::centred(1.0, 1.2, 0.8)?),
        "cylinder" => Arc::new(Cylinder::new(0.7, 1.2)?),
        "cone" => Arc::new(Cone::new(0.7, 1.2)?),
        "parabola" => Arc::new(Parabola::new(0.7, 1.2)?),
        "torus" => Arc::new(Torus::new(0.7, 0.3)?),
        _ => return Ok(None),
    }))
}

fn world(name: &str) -> raysect::Result<World<()>> {
    let mut world = World::new();
    match shape(name)? {
        Some(shape) => drop(world.add(shape)?),
        None => composites(&mut world)?,
    }
    Ok(world)
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

fn sets(name: &str, count: usize) -> [Vec<Ray>; 2] {
    let (centre, radius) = if name == "composites" { (Point3D::ORIGIN, 4.0) } else { (Point3D::ORIGIN, 1.0) };
    [Order::Coherent, Order::Incoherent].map(|order| rays::rays(order, centre, radius, count))
}

/// Hits per second of a set of rays, each with the surface that was hit, as Raysect's `World.hit` answers.
fn ours(world: &World<()>, rays: &[Ray]) -> raysect::Result<f64> {
    let scene = world.scene()?;
    let mut scratch = Scratch::default();
    let start = Instant::now();
    let mut sum = 0.0;
    for ray in rays {
        let hit = scene.hit(ray, None, &mut scratch);
        sum += hit.map_or(0.0, |hit| scene.finish(ray, &hit).bound);
    }
    black_box(sum);
    Ok(rays.len() as f64 / start.elapsed().as_secs_f64())
}

/// The same of a shape alone, in its own space.
fn alone(shape: &dyn Primitive, rays: &[Ray]) -> f64 {
    let mut scratch = Scratch::default();
    let start = Instant::now();
    let mut sum = 0.0;
    for ray in rays {
        let hit = black_box(shape).hit(ray, Interval::AHEAD, &mut scratch);
        sum += hit.map_or(0.0, |hit| shape.surface(ray, &hit).bound);
    }
    black_box(sum);
    rays.len() as f64 / start.elapsed().as_secs_f64()
}

/// Hits per second of both sets, in a world and, of a single shape, alone.
fn theirs(python: &str, name: &str, sets: &[Vec<Ray>; 2], count: usize) -> Result<[f64; 4], String> {
    let path = std::env::temp_dir().join(format!("raysect-rays-{}", std::process::id()));
    let numbers = |rays: &[Ray]| -> Vec<u8> {
        let chosen = rays.iter().step_by(rays.len().div_ceil(count));
        chosen
            .flat_map(|r| r.origin.to_array().into_iter().chain(r.direction.to_array()))
            .flat_map(f64::to_le_bytes)
            .collect()
    };
    let files = ["coherent", "incoherent"].map(|order| path.with_extension(order));
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
    let rates: Vec<f64> = text.split_whitespace().filter_map(|x| x.parse().ok()).collect();
    rates.try_into().map_err(|_| format!("not four numbers: {text}"))
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied().unwrap_or(f64::NAN)
}

fn main() -> raysect::Result<()> {
    // `cargo test --benches` only wants to know that it runs.
    let test = std::env::args().any(|a| a == "--test");
    let (count, rounds) = if test { (1 << 8, 1) } else { (1 << 18, 5) };
    let python = std::env::var("RAYSECT_PYTHON").ok().filter(|_| !test);
    let wanted: Vec<String> = std::env::args().skip(1).filter(|a| !a.starts_with('-')).collect();
    for name in WORLDS.into_iter().filter(|n| wanted.is_empty() || wanted.iter().any(|w| w == n)) {
        let (world, shape, sets) = (world(name)?, shape(name)?, sets(name, count));
        let mut rates: [[Vec<f64>; 4]; 2] = Default::default();
        for _ in 0..rounds {
            for (set, rays) in sets.iter().enumerate() {
                rates[0][set].push(ours(&world, rays)?);
                rates[0][2 + set].push(shape.as_ref().map_or(f64::NAN, |shape| alone(shape, rays)));
            }
            match python.as_ref().map(|python| theirs(python, name, &sets, 30_000)) {
                Some(Ok(found)) => rates[1].iter_mut().zip(found).for_each(|(rates, rate)| rates.push(rate)),
                Some(Err(what)) => println!("{name}: the other side did not run: {what}"),
                None => {}
            }
        }
        let [mine, other] = rates.map(|all| all.map(median));
        let ways = ["coherent", "incoherent", "coherent, alone", "incoherent, alone"];
        for (way, (a, b)) in ways.iter().zip(mine.into_iter().zip(other)).filter(|(_, (a, _))| !a.is_nan()) {
            let ratio =
                if b.is_nan() { String::new() } else { format!("   Raysect {b:.3e}   ratio {:.1}", a / b) };
            println!("{name:<11} {way:<18} {a:.3e} hits/s{ratio}");
        }
    }
    Ok(())
}
