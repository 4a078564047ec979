//! Closed meshes lose no ray, however often it is reflected inside them.

use std::sync::Arc;

use raysect::core::{Leaving, Node, Primitive, Ray, Scratch, World};
use raysect::math::{AffineMatrix3D, Point3D, Rng, SphereSampler, Vector3D, rotate, translate};
use raysect::primitive::{Mesh, MeshData};

use super::Cell;
use super::bodies::{Shape, bracket};
use super::wrong::{Fault, Wrong};

/// Half-sizes [m].
const SIZES: [f64; 5] = [1e-3, 1.0, 10.0, 100.0, 1e4];
/// Bounces of one chain.
const CHAIN: u64 = 1000;

type Maker = fn(f64) -> MeshData;

const KINDS: [(&str, Maker); 3] = [
    ("cube", |half| MeshData::cube(half).unwrap()),
    ("icosphere", |radius| MeshData::icosphere(3, radius).unwrap()),
    ("bracket", bracket),
];

pub(crate) fn cells() -> Vec<Cell> {
    let mut cells = Vec::new();
    for (name, make) in KINDS {
        for size in SIZES {
            for offset in [0.0, 1e3, 1e8] {
                let shape: Shape = Arc::new(Mesh::new(make(size)).unwrap());
                let title = format!("{name} {size:e} m, {offset:e} sizes off");
                cells.push(cell(title, shape, size, offset).share(10.0).core(offset == 0.0 || size == 10.0));
            }
        }
    }
    cells
}

pub(crate) fn controls() -> Vec<Cell> {
    let faults = [("forgetful", Fault::Forgets), ("leaking one in 1e4", Fault::Misses(10_000))];
    let wrong = faults.map(|(name, fault)| {
        let mesh = Mesh::new(MeshData::icosphere(3, 10.0).unwrap()).unwrap();
        cell(name.to_owned(), Arc::new(Wrong(mesh, fault)), 10.0, 1e3).share(10.0)
    });
    let whole = MeshData::icosphere(3, 10.0).unwrap();
    let all_but_one = whole.triangles()[1..].iter().copied();
    let open = MeshData::new(whole.vertices().iter().copied(), all_but_one).unwrap();
    let open = Mesh::builder(open).closed(true).build().unwrap();
    wrong
        .into_iter()
        .chain([cell("a triangle missing".to_owned(), Arc::new(open), 10.0, 0.0).share(10.0)])
        .collect()
}

fn cell(name: String, shape: Shape, size: f64, offset: f64) -> Cell {
    Cell::new(name, 0.0, move |rays, tally| {
        let shift = Vector3D::new(0.6, -0.64, 0.48) * (offset * size);
        let place = translate(shift.x, shift.y, shift.z) * rotate(10.0, 20.0, 30.0);
        let mut world = World::<()>::new();
        world.add(Node::of(shape.clone(), ()).transform(place)).unwrap();
        let scene = world.scene().unwrap();
        let around = shape.bounding_box(&AffineMatrix3D::IDENTITY);
        let (mut rng, mut scratch) = (Rng::new(21), Scratch::default());
        while tally.rays < rays {
            let inside = place * (Point3D::ORIGIN + Vector3D::new(0.2, 0.2, 0.2) * size);
            let mut ray = Ray::new(inside, SphereSampler.sample(&mut rng));
            let mut leaving: Option<Leaving> = None;
            for _ in 0..CHAIN.min(rays) {
                tally.ray();
                let Some(hit) = scene.hit(&ray, leaving.as_ref(), &mut scratch) else {
                    tally.fail(|| format!("lost: {ray:?}"));
                    break;
                };
                let surface = scene.finish(&ray, &hit);
                let outside = !around.contains(surface.local_point);
                // Far from the origin of the world an edge may be as near as that.
                let stuck = surface.distance == 0.0 && offset <= 1e3;
                if !surface.exiting || outside || stuck {
                    tally.fail(|| format!("wrong surface {surface:?}: {ray:?}"));
                    break;
                }
                let v = SphereSampler.sample(&mut rng) * (1.0 - 1e-9);
                let towards = (v - surface.normal.as_vector()).normalise_unchecked();
                leaving = Some(Leaving::new(&surface, ray.direction, towards, leaving.as_ref()));
                ray = Ray::new(surface.point, towards);
            }
        }
    })
}
