//! A panic in a user's material ends the observation and loses nothing.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use raysect::core::{Engine, EngineError};
use raysect::observer::ObserverError;
use raysect::prelude::*;

use crate::bits::{assert_pixels_are_undivided, counts};

/// A diffuse surface that can be broken.
struct Fragile {
    lambert: Lambert,
    broken: Arc<AtomicBool>,
}

impl Material for Fragile {
    fn surface(&self, hit: &SurfaceHit, path: &mut Path<'_>) -> Scatter {
        assert!(!self.broken.load(Ordering::Relaxed), "the glaze has come off");
        self.lambert.surface(hit, path)
    }
}

/// A wall that fills the picture, its lower half fragile, before a ball lamp that only the upper half cannot see
/// the lower one by.
fn world(broken: &Arc<AtomicBool>) -> World {
    let mut world = World::new();
    let half =
        |bottom, top| Cuboid::new(Point3D::new(-3.0, bottom, 2.0), Point3D::new(3.0, top, 2.1)).unwrap();
    let lambert = Lambert::new(0.7);
    let fragile = Fragile { lambert: lambert.clone(), broken: broken.clone() };
    world.add(half(0.0, 3.0).material(lambert)).unwrap();
    world.add(half(-3.0, 0.0).material(fragile)).unwrap();
    let lamp = Sphere::new(0.5).unwrap().material(UniformSurfaceEmitter::new(1.0, 1.0));
    world.add(lamp.transform(translate(2.0, 0.0, -0.5))).unwrap();
    world
}

/// Eight rows, of which the upper four see the sound half of the wall.
fn camera(samples: u64) -> PinholeCamera {
    PinholeCamera::new((6, 8), 60.0)
        .unwrap()
        .spectral_bins(2)
        .pixel_samples(samples)
        .engine(Serial)
        .quiet(true)
}

/// The undivided observation of a number of samples.
fn undivided(samples: u64, world: &World) -> Frame {
    let mut radiance = RadiancePipeline2D::new();
    camera(samples).observe(world, &mut radiance).unwrap();
    radiance.frame().clone()
}

/// Breaks a material between two observations, and repairs it for a third.
fn break_and_repair(engine: impl Engine + 'static) {
    let broken = Arc::new(AtomicBool::new(false));
    let world = world(&broken);
    let breaking = camera(300).engine(engine);
    let mut radiance = RadiancePipeline2D::new();
    camera(20).observe(&world, &mut radiance).unwrap();

    broken.store(true, Ordering::Relaxed);
    let outcome = breaking.observe(&world, &mut radiance);
    let Err(ObserverError::Engine(EngineError::Panicked { message, .. })) = outcome else {
        panic!("{outcome:?}")
    };
    assert!(message.contains("the glaze has come off"), "{message}");
    let after = counts(radiance.frame());
    assert!(after[0] > 20, "the first row was finished: {after:?}");
    assert!(after[24..].iter().all(|&n| n == 20), "the lower half was not: {after:?}");

    broken.store(false, Ordering::Relaxed);
    assert_pixels_are_undivided(radiance.frame(), |n| undivided(n, &world));
    breaking.observe(&world, &mut radiance).unwrap();
    assert!(counts(radiance.frame()).iter().zip(&after).all(|(now, then)| *now == then + 300));
    assert_pixels_are_undivided(radiance.frame(), |n| undivided(n, &world));
}

#[test]
fn a_panic_is_an_error_and_keeps_finished_work() {
    break_and_repair(Serial);
    break_and_repair(Multicore::with_threads(2).unwrap());
}

#[test]
fn a_panic_in_a_pilot_keeps_everything() {
    let broken = Arc::new(AtomicBool::new(false));
    let world = world(&broken);
    let mut radiance = RadiancePipeline2D::new();
    camera(20).observe(&world, &mut radiance).unwrap();
    let before = radiance.frame().clone();
    broken.store(true, Ordering::Relaxed);
    let outcome = camera(1).observe_until(&world, &mut radiance, Stop::relative_error(1e-3));
    assert!(matches!(outcome, Err(ObserverError::Engine(EngineError::Panicked { .. }))), "{outcome:?}");
    assert_eq!(*radiance.frame(), before);
}
