//! Rays against a mesh of triangles: this tracer and Embree 4, the same mesh and the same rays, in turn in one run.
//!
//! `cargo bench --bench mesh [-- MESH.obj …]`; a bumpy ball of 82 thousand triangles without arguments. The other
//! side runs if `RAYSECT_PYTHON` names a Python that has `embreex` (see `benches/peers/README.md`).

#[path = "../examples/common/rays.rs"]
mod rays;

use std::hint::black_box;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Instant;

use rays::Order;
use raysect::core::{Ray, Scene, Scratch, World};
use raysect::math::Point3D;
use raysect::primitive::{Mesh, MeshData};

/// Seconds of the parts of one round.
#[derive(Debug, Clone, Copy)]
struct Round {
    build: f64,
    coherent: f64,
    incoherent: f64,
}

fn median(values: impl Iterator<Item = f64>) -> f64 {
    let mut values: Vec<f64> = values.collect();
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied().unwrap_or(f64::NAN)
}

/// A ball of radius 0.8 with bumps of several sizes.
fn bumpy_ball(splits: u32) -> raysect::Result<MeshData> {
    let sphere = MeshData::icosphere(splits, 1.0)?;
    let bumps = |p: &Point3D| {
        let (x, y, z) = (p.x, p.y, p.z);
        let radius = 0.82
            + 0.12 * (3.0 * x + 1.0).sin() * (4.0 * y).cos()
            + 0.06 * (9.0 * y + 4.0 * z).sin() * (7.0 * z - 5.0 * x).cos()
            + 0.02 * (31.0 * x + 17.0 * z).sin() * (29.0 * y).sin()
            + 0.006 * (83.0 * z + 61.0 * y).sin() * (71.0 * x).sin();
        p.to_array().map(|c| f64::from((c * radius) as f32))
    };
    Ok(MeshData::new(sphere.vertices().iter().map(bumps), sphere.triangles().iter().copied())?)
}

fn seconds(scene: &Scene<()>, rays: &[Ray]) -> f64 {
    let mut scratch = Scratch::default();
    let start = Instant::now();
    for ray in rays {
        black_box(scene.hit(ray, None, &mut scratch));
    }
    start.elapsed().as_secs_f64()
}

fn ours(data: &MeshData, sets: &[Vec<Ray>; 2]) -> raysect::Result<Round> {
    let data = data.clone();
    let start = Instant::now();
    let mesh = Mesh::builder(data).closed(true).build()?;
    let build = start.elapsed().as_secs_f64();
    let mut world = World::<()>::new();
    world.add(mesh)?;
    let scene = world.scene()?;
    Ok(Round { build, coherent: seconds(scene, &sets[0]), incoherent: seconds(scene, &sets[1]) })
}

/// Numbers as the other side reads them.
fn write(path: &Path, bytes: impl Iterator<Item = [u8; 4]>) -> std::io::Result<()> {
    std::fs::write(path, bytes.flatten().collect::<Vec<u8>>())
}

fn hand_over(folder: &Path, data: &MeshData, sets: &[Vec<Ray>; 2]) -> std::io::Result<()> {
    let single = |x: f64| (x as f32).to_le_bytes();
    write(&folder.join("vertices"), data.vertices().iter().flat_map(|p| p.to_array()).map(single))?;
    write(&folder.join("triangles"), data.triangles().iter().flatten().map(|i| i.to_le_bytes()))?;
    for (name, rays) in ["coherent", "incoherent"].iter().zip(sets) {
        let origins = rays.iter().flat_map(|r| r.origin.to_array());
        let directions = rays.iter().flat_map(|r| r.direction.to_array());
        write(&folder.join(name), origins.chain(directions).map(single))?;
    }
    Ok(())
}

fn theirs(python: &str, folder: &Path) -> Result<Round, String> {
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("benches/peers/mesh_embree.py");
    let run = Command::new(python).arg(script).arg(folder).output().map_err(|e| format!("{python}: {e}"))?;
    if !run.status.success() {
        return Err(String::from_utf8_lossy(&run.stderr).into_owned());
    }
    let text = String::from_utf8_lossy(&run.stdout);
    let numbers: Vec<f64> = text.split_whitespace().filter_map(|x| x.parse().ok()).collect();
    match numbers[..] {
        [build, coherent, incoherent] => Ok(Round { build, coherent, incoherent }),
        _ => Err(format!("not three numbers: {text}")),
    }
}

fn compare(name: &str, data: &MeshData, count: usize, rounds: usize) -> raysect::Result<()> {
    let centre = data.bounding_box().centre();
    let radius = data.vertices().iter().map(|p| p.distance_to(centre)).fold(0.0, f64::max);
    let sets = [Order::Coherent, Order::Incoherent].map(|order| rays::rays(order, centre, radius, count));
    let folder = std::env::temp_dir().join(format!("raysect-mesh-{}", std::process::id()));
    std::fs::create_dir_all(&folder)?;
    hand_over(&folder, data, &sets)?;
    let python = std::env::var("RAYSECT_PYTHON").ok();
    let (mut mine, mut other) = (Vec::new(), Vec::new());
    for _ in 0..rounds {
        mine.push(ours(data, &sets)?);
        match python.as_ref().map(|python| theirs(python, &folder)) {
            Some(Ok(round)) => other.push(round),
            Some(Err(what)) => println!("{name}: the other side did not run: {what}"),
            None => {}
        }
    }
    std::fs::remove_dir_all(&folder)?;
    println!("{name}: {} triangles, medians of {rounds} rounds on one thread", data.triangle_count());
    for (part, what) in ["coherent [rays/s]", "incoherent [rays/s]", "builds [1/s]"].into_iter().enumerate() {
        let amount = sets.get(part).map_or(1.0, |rays| rays.len() as f64);
        let seconds = |round: &Round| [round.coherent, round.incoherent, round.build][part];
        let rate = |rounds: &[Round]| amount / median(rounds.iter().map(seconds));
        let (a, b) = (rate(&mine), rate(&other));
        if other.is_empty() {
            println!("  {what:<20} {a:.4e}");
        } else {
            println!("  {what:<20} {a:.4e}   Embree {b:.4e}   ratio {:.3}", a / b);
        }
    }
    if python.is_none() {
        println!("  set RAYSECT_PYTHON to measure Embree in the same run");
    }
    Ok(())
}

fn main() -> raysect::Result<()> {
    // `cargo test --benches` only wants to know that it runs.
    let test = std::env::args().any(|a| a == "--test");
    let (count, rounds, splits) = if test { (1 << 10, 1, 2) } else { (1 << 20, 5, 6) };
    let files: Vec<PathBuf> =
        std::env::args().skip(1).filter(|a| !a.starts_with('-')).map(PathBuf::from).collect();
    if files.is_empty() {
        return compare("bumpy ball", &bumpy_ball(splits)?, count, rounds);
    }
    for file in files {
        compare(&file.display().to_string(), &MeshData::load(&file, 1.0)?, count, rounds)?;
    }
    Ok(())
}
