//! Rays without a camera: what became of their paths is said with what they read.

use raysect_core::Ray as Line;
use raysect_math::{Point3D, Vector3D};
use raysect_optical::{
    AnisotropicSurfaceEmitter, Lambert, Ledger, Material, Path, PathSettings, Ray, Scatter, SurfaceHit,
    UniformSurfaceEmitter, WithMaterial, World,
};
use raysect_primitive::Sphere;

fn room(material: impl Material) -> World {
    let mut world = World::new();
    world.add(Sphere::new(1.0).unwrap().material(material)).unwrap();
    world
}

fn inside() -> Ray {
    Ray::new(Point3D::new(0.2, 0.1, 0.0), Vector3D::Z).spectrum(500.0, 501.0, 2)
}

fn ended(ledger: &Ledger) -> u64 {
    ledger.absorbed + ledger.escaped + ledger.killed + ledger.truncated + ledger.lost
}

#[test]
fn paths_that_are_cut_off_are_told() {
    let settings = PathSettings::default().max_depth(10);
    let found = inside().settings(settings).sample(&room(Lambert::new(1.0)), 100).unwrap();
    assert_eq!((found.ledger.paths, found.ledger.truncated, found.ledger.collected), (100, 100, 0));
    assert!((found.ledger.truncated_throughput - 100.0).abs() < 1e-9, "{:?}", found.ledger);
    let lit = inside().sample(&room(UniformSurfaceEmitter::new(1.0, 1.0)), 100).unwrap();
    assert_eq!((lit.ledger.absorbed, lit.ledger.collected, lit.invalid), (100, 100, 0));
}

#[test]
fn samples_that_are_no_numbers_are_counted_and_left_out() {
    let faulty = AnisotropicSurfaceEmitter::new(|_, _, _, out| {
        out[0] = f64::NAN;
        out[1] = 3.0;
    });
    let found = inside().sample(&room(faulty), 50).unwrap();
    assert_eq!((found.invalid, found.mean.samples(), found.total.mean()), (50, &[0.0, 0.0][..], 0.0));
}

/// A mirror that follows its reflections by itself.
struct Recursive;

impl Material for Recursive {
    fn emit(&self, _: &SurfaceHit, _: raysect_optical::Context<'_>, out: &mut [f64]) -> bool {
        out.fill(0.5);
        true
    }
    fn surface(&self, hit: &SurfaceHit, path: &mut Path<'_>) -> Scatter {
        let mut found = vec![0.0; path.slice().bins];
        let direction = hit.mirrored();
        // From a little inside, as a program may do that does not know better.
        path.trace(&Line::new(hit.surface.point + direction * 1e-9, direction), &mut found);
        assert!(found.iter().all(|radiance| *radiance >= 0.0));
        Scatter::Absorbed
    }
    fn facts(&self) -> raysect_optical::Facts {
        raysect_optical::Facts::emitter("recursive")
    }
}

#[test]
fn paths_within_paths_are_accounted_for() {
    let settings = PathSettings::default().max_depth(6);
    let found = inside().settings(settings).sample(&room(Recursive), 10).unwrap();
    let ledger = found.ledger;
    // Each follows five within, and is cut off at the sixth.
    assert_eq!((ledger.paths, ledger.absorbed, ledger.truncated), (70, 60, 10), "{ledger:?}");
    assert_eq!((ended(&ledger), ledger.collected, ledger.rays), (70, 60, 60), "{ledger:?}");
}

#[test]
fn settings_of_a_ray_can_be_read_back() {
    let (origin, direction) = (Point3D::new(1.0, 2.0, 3.0), Vector3D::new(0.0, 3.0, 4.0));
    let ray = Ray::new(origin, direction);
    let known = ray.slicing().unwrap();
    assert_eq!(
        (known.min_wavelength(), known.max_wavelength(), known.bins(), ray.seed_value()),
        (375.0, 785.0, 40, 1)
    );
    assert_eq!(ray.path_settings(), &PathSettings::default());
    let settings = PathSettings::default().max_depth(7);
    let ray = ray.spectrum(400.0, 500.0, 5).seed(9).max_distance(2.5).settings(settings.clone());
    let known = ray.slicing().unwrap();
    assert_eq!(
        (known.min_wavelength(), known.max_wavelength(), known.bins(), ray.seed_value()),
        (400.0, 500.0, 5, 9)
    );
    assert_eq!(ray.path_settings(), &settings);
    let geometry = ray.geometry();
    assert_eq!((geometry.origin, geometry.direction, geometry.max_distance), (origin, direction, 2.5));
    assert!(ray.spectrum(500.0, 400.0, 5).slicing().is_err());
}
