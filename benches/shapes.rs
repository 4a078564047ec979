//! Rays against worlds of shapes: this tracer and Raysect 0.9.1, the same worlds and the same rays, in turn in one run.
//!
//! `cargo bench --bench shapes [-- NAME …]`; the other side runs if `RAYSECT_PYTHON` names a Python that has it (see
//! `benches/peers/README.md`).

#[path = "../examples/common/rays.rs"]
mod rays;

use std::hint::black_box;
use std::path::Path;
use std::process::Command;
use std::time::Instant;

use rays::Order;
use raysect::core::{Node, Ray, Scratch, World};
use raysect::prelude::{
    Cone, Cuboid, Cylinder, Intersect, Parabola, Place, Point3D, Sphere, Subtract, Torus, Union, rotate,
    translate,
};

const WORLDS: [&str; 6] = ["sphere", "cylinder", "cone", "parabola", "torus", "composites"];

/// A world, and the place from which it is looked at with the size of what there is to see.
fn world(name: &str) -> raysect::Result<World<()>> {
    let mut world = World::new();
    match name {
        "sphere" => drop(world.add(Sphere::new(1.0)?)?),
        "cylinder" => drop(world.add(Cylinder::new(0.7, 1.2)?)?),
        "cone" => drop(world.add(Cone::new(0.7, 1.2)?)?),
        "parabola" => drop(world.add(Parabola::new(0.7, 1.2)?)?),
        "torus" => drop(world.add(Torus::new(0.7, 0.3)?)?),
        _ => composites(&mut world)?,
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
    for ray in rays {
        black_box(scene.hit(ray, None, &mut scratch).map(|hit| scene.finish(ray, &hit)));
    }
    Ok(rays.len() as f64 / start.elapsed().as_secs_f64())
}

fn theirs(python: &str, name: &str, sets: &[Vec<Ray>; 2], count: usize) -> Result<[f64; 2], String> {
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
    rates.try_into().map_err(|_| format!("not two numbers: {text}"))
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
        let (world, sets) = (world(name)?, sets(name, count));
        let mut rates: [[Vec<f64>; 2]; 2] = Default::default();
        for _ in 0..rounds {
            for (rates, rays) in rates[0].iter_mut().zip(&sets) {
                rates.push(ours(&world, rays)?);
            }
            match python.as_ref().map(|python| theirs(python, name, &sets, 30_000)) {
                Some(Ok(found)) => rates[1].iter_mut().zip(found).for_each(|(rates, rate)| rates.push(rate)),
                Some(Err(what)) => println!("{name}: the other side did not run: {what}"),
                None => {}
            }
        }
        let [mine, other] = rates.map(|pair| pair.map(median));
        for (order, (a, b)) in ["coherent", "incoherent"].iter().zip(mine.into_iter().zip(other)) {
            let ratio =
                if b.is_nan() { String::new() } else { format!("   Raysect {b:.3e}   ratio {:.1}", a / b) };
            println!("{name:<11} {order:<11} {a:.3e} hits/s{ratio}");
        }
    }
    Ok(())
}
