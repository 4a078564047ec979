//! A prism and a diamond before a chequered sky: bins of a wide spectrum are as bright as their nanometres are alone.

use std::f64::consts::TAU;

use raysect::math::{AffineMatrix3D, Point3D, Vector3D, rotate_basis, translate};
use raysect::observer::{Estimate, PinholeCamera, SpectralRadiancePipeline};
use raysect::optical::{Checkerboard, Dielectric, Dispersion, PathSettings, Sellmeier, WithMaterial, World};
use raysect::prelude::Serial;
use raysect::primitive::{Mesh, MeshData};

use crate::scenes::{ball, world};

/// The spectrum [nm], and how many bins and nanometres it has.
const RANGE: (f64, f64) = (380.0, 745.0);
const BINS: usize = 5;
const SLICES: usize = 365;

/// A solid in the midst of a sphere of 5 m that shines in cubes of a width [m]: lamps with edges on all sides.
fn under_squares(solid: Mesh, index: Sellmeier, width: f64) -> World {
    let glass = Dielectric::new(index, 1.0).unwrap();
    let sky = Checkerboard::new(width).unwrap().spectra((1.0, 0.1), (1.0, 1.0)).importance(0.0);
    world([solid.material(glass), ball([0.0; 3], 5.0, sky)])
}

/// A mesh of corners and triangles.
fn mesh(corners: Vec<Point3D>, faces: Vec<[u32; 3]>) -> Mesh {
    let mesh = Mesh::new(MeshData::new(corners, faces).unwrap()).unwrap();
    assert!(mesh.is_closed());
    mesh
}

/// A prism of heavy flint with an apex of 60° along y and edges along z, of faces of 1 m.
fn prism() -> World {
    let flint = Sellmeier::new([1.73759695, 0.313747346, 1.89878101], [0.013188707, 0.0623068142, 155.23629]);
    let corner = |x: f64, y: f64, z: f64| Point3D::new(x, y - 0.4, z);
    let apex = 0.75f64.sqrt();
    let ends = [-0.5, 0.5].map(|z| [corner(-0.5, 0.0, z), corner(0.5, 0.0, z), corner(0.0, apex, z)]);
    let faces = [[0, 2, 1], [3, 4, 5], [0, 1, 4], [0, 4, 3], [1, 2, 5], [1, 5, 4], [2, 0, 3], [2, 3, 5]];
    under_squares(mesh(ends.concat(), faces.to_vec()), flint.unwrap(), 0.1)
}

/// A diamond of eight sides: a table, a crown to the girdle of 1 m radius in the plane z = 0, a pavilion to its tip.
/// Its index is that of F. Peter, Z. Phys. 15, 358 (1923).
fn diamond() -> World {
    let index = Sellmeier::new([4.3356, 0.3306, 0.0], [0.1060f64.powi(2), 0.1750f64.powi(2), 0.0]).unwrap();
    let ring = |radius: f64, z: f64, turn: f64| {
        (0..8u32).map(move |i| {
            let (sine, cosine) = (TAU * (f64::from(i) + turn) / 8.0).sin_cos();
            Point3D::new(radius * cosine, radius * sine, z)
        })
    };
    let corners = ring(0.57, 0.3, 0.0).chain(ring(1.0, 0.0, 0.5)).chain([Point3D::new(0.0, 0.0, -0.86)]);
    let mut faces: Vec<[u32; 3]> = (1..7).map(|i| [0, i, i + 1]).collect();
    for i in 0..8 {
        let next = (i + 1) % 8;
        faces.extend([[i, 8 + i, next], [next, 8 + i, 8 + next], [8 + next, 8 + i, 16]]);
    }
    under_squares(mesh(corners.collect(), faces), index, 0.4)
}

/// What a camera of a single pixel of a few tenths of a degree reads in bins, looking from one point to another: a mean
/// over the edges of the sky as well, so that slices of a nanometre are narrow enough.
fn look(
    world: &World,
    (from, to): (Point3D, Point3D),
    dispersion: Dispersion,
    (min, max, bins): (f64, f64, usize),
    samples: u64,
) -> Vec<Estimate> {
    let frame: AffineMatrix3D = translate(from.x, from.y, from.z)
        * rotate_basis(from.vector_to(to), Vector3D::new(0.1, 0.2, 1.0)).unwrap();
    let camera = PinholeCamera::new((1, 1), 0.3).unwrap().transform(frame);
    let camera = camera.wavelengths(min, max).spectral_bins(bins).pixel_samples(samples).seed(min as u64);
    let camera = camera.paths(PathSettings::default().dispersion(dispersion)).engine(Serial).quiet(true);
    let mut radiance = SpectralRadiancePipeline::new();
    camera.observe(world, &mut radiance).unwrap();
    (0..bins).map(|bin| radiance.bin(0, bin)).collect()
}

/// The mean over the slices of one nanometre of each bin.
fn by_the_nanometre(world: &World, view: (Point3D, Point3D), samples: u64) -> Vec<Estimate> {
    let slice = |i: usize| {
        let min = RANGE.0 + i as f64;
        look(world, view, Dispersion::Mean, (min, min + 1.0, 1), samples)[0]
    };
    let slices: Vec<Estimate> = (0..SLICES).map(slice).collect();
    let mean = |of: &[Estimate]| {
        let (count, variance) = (of.len() as f64, of.iter().map(|e| e.error * e.error).sum::<f64>());
        Estimate { value: of.iter().map(|e| e.value).sum::<f64>() / count, error: variance.sqrt() / count }
    };
    slices.chunks(SLICES / BINS).map(mean).collect()
}

/// Asserts that bins with sampled wavelengths are right, each to about a per cent, and that those of one mean index are
/// found out.
#[track_caller]
fn assert_bins(name: &str, world: &World, view: (Point3D, Point3D), samples: (u64, u64)) {
    let all = (RANGE.0, RANGE.1, BINS);
    let sampled = look(world, view, Dispersion::Sampled, all, samples.0);
    let mean = look(world, view, Dispersion::Mean, all, samples.0);
    let right = by_the_nanometre(world, view, samples.1);
    let scores = |found: &[Estimate]| -> Vec<f64> {
        let pairs = found.iter().zip(&right);
        pairs.map(|(a, b)| (a.value - b.value) / a.error.hypot(b.error)).collect()
    };
    let (z, off) = (scores(&sampled), scores(&mean));
    println!("{name}: {sampled:?} {right:?}\n  z {z:.2?}, of one index {off:.1?}");
    for estimate in sampled.iter().chain(&right) {
        assert!(estimate.relative_error() < 0.01, "{name}: {estimate:?}");
    }
    assert!(z.iter().all(|z| z.abs() < 4.0), "{name}: {z:?}");
    assert!(off.iter().any(|z| z.abs() > 10.0), "{name}: {off:?}");
}

#[test]
fn bins_behind_a_prism_are_those_of_their_nanometres() {
    let view = (Point3D::new(-2.85, -1.467, 0.05), Point3D::new(-0.25, 0.033, 0.05));
    assert_bins("prism", &prism(), view, (120_000, 300));
}

#[test]
fn bins_in_a_diamond_are_those_of_their_nanometres() {
    let view = (Point3D::new(0.6, 0.3, 3.0), Point3D::new(0.15, 0.22, 0.3));
    assert_bins("diamond", &diamond(), view, (120_000, 300));
}
