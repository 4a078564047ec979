//! Rays per second that find the nearest triangle of a mesh, the time to build its tree, and its memory.

#[path = "../common/rays.rs"]
mod rays;

use std::hint::black_box;
use std::path::PathBuf;
use std::time::Instant;

use clap::Parser;
use rays::Order;
use raysect::core::{Ray, Scene, Scratch, World};
use raysect::primitive::{Mesh, MeshData};

/// Measures how fast rays find the nearest triangle of a mesh.
#[derive(Parser)]
struct Arguments {
    /// A mesh: OBJ, STL, PLY, VTK or RSM.
    mesh: PathBuf,
    /// How rays follow each other; both by default.
    #[arg(long, value_enum)]
    rays: Option<Order>,
    /// Threads that share the rays.
    #[arg(long, default_value_t = 1)]
    threads: usize,
    /// Rays of each measurement.
    #[arg(long, default_value_t = 1 << 20)]
    count: usize,
    /// Measurements, of which the median counts.
    #[arg(long, default_value_t = 5)]
    rounds: usize,
    /// One JSON object instead of a table.
    #[arg(long)]
    json: bool,
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}

/// Seconds that all rays take on some threads, and the share of them that hit.
fn measure(scene: &Scene<()>, rays: &[Ray], threads: usize) -> (f64, f64) {
    let start = Instant::now();
    let hits: usize = std::thread::scope(|scope| {
        let workers: Vec<_> = rays
            .chunks(rays.len().div_ceil(threads).max(1))
            .map(|mine| {
                scope.spawn(move || {
                    let mut scratch = Scratch::default();
                    mine.iter().filter(|ray| black_box(scene.hit(ray, None, &mut scratch)).is_some()).count()
                })
            })
            .collect();
        workers.into_iter().map(|w| w.join().unwrap_or(0)).sum()
    });
    (start.elapsed().as_secs_f64(), hits as f64 / rays.len() as f64)
}

fn main() -> raysect::Result<()> {
    let arguments = Arguments::parse();
    let data = MeshData::load(&arguments.mesh, 1.0)?;
    let mut builds = Vec::new();
    let mut mesh = None;
    for _ in 0..arguments.rounds.max(1) {
        let data = data.clone();
        let start = Instant::now();
        mesh = Some(Mesh::builder(data).closed(true).build()?);
        builds.push(start.elapsed().as_secs_f64());
    }
    let Some(mesh) = mesh else { return Ok(()) };
    let (triangles, bytes, build) = (mesh.data().triangle_count(), mesh.bytes(), median(builds));
    let centre = mesh.data().bounding_box().centre();
    let radius = mesh.data().vertices().iter().map(|p| p.distance_to(centre)).fold(0.0, f64::max);
    let mut world = World::<()>::new();
    world.add(mesh)?;
    let scene = world.scene()?;
    let mut report = vec![
        ("triangles", triangles as f64),
        ("build_seconds", build),
        ("bytes", bytes as f64),
        ("bytes_per_triangle", bytes as f64 / triangles as f64),
    ];
    for (order, names) in [
        (Order::Coherent, ["coherent_rays_per_second", "coherent_hit_fraction"]),
        (Order::Incoherent, ["incoherent_rays_per_second", "incoherent_hit_fraction"]),
    ] {
        if arguments.rays.is_some_and(|wanted| wanted != order) {
            continue;
        }
        let rays = rays::rays(order, centre, radius, arguments.count.max(1));
        let rounds: Vec<(f64, f64)> =
            (0..arguments.rounds.max(1)).map(|_| measure(scene, &rays, arguments.threads.max(1))).collect();
        let seconds = median(rounds.iter().map(|r| r.0).collect());
        report.extend([(names[0], rays.len() as f64 / seconds), (names[1], rounds[0].1)]);
    }
    if arguments.json {
        let fields: Vec<String> = report.iter().map(|(name, value)| format!("\"{name}\": {value}")).collect();
        println!("{{{}}}", fields.join(", "));
    } else {
        report.iter().for_each(|(name, value)| println!("{name:<28} {value:.6}"));
    }
    Ok(())
}
