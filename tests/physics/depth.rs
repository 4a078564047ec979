//! Long paths, how they end, and the book that is kept of it.

use std::thread;

use raysect::core::{Node, Ray};
use raysect::math::sampling::{sphere, uniforms};
use raysect::math::{Point3D, Rng, StreamKey, Vector3D};
use raysect::optical::{
    AbsorbingSurface, Dielectric, Lambert, LightSampling, Material, Optics, Path, PathSettings, Slicing,
    WithMaterial, World,
};

use crate::check::{Demand, EVERY, Probe, Reading, accept, unaccounted};
use crate::glass::fresnel;
use crate::materials::{GlowingLambert, Screen};
use crate::scenes::{ball, cuboid, dome, lamp, plate, tilted, world};

/// Runs something on a stack of 128 KiB.
fn on_a_small_stack<T: Send>(work: impl FnOnce() -> T + Send) -> T {
    let builder = thread::Builder::new().stack_size(128 * 1024);
    thread::scope(|scope| builder.spawn_scoped(scope, work).unwrap().join().unwrap())
}

/// Lossless glass.
fn glass() -> Dielectric {
    Dielectric::new(1.5, 1.0).unwrap()
}

#[test]
fn a_trapped_path_ends_at_the_greatest_depth() {
    // Along a diagonal every face reflects totally, for ever.
    let reading = on_a_small_stack(|| {
        let world = world([dome(), cuboid([-0.5, -0.4, -0.3], [0.5, 0.6, 0.7]).material(glass())]);
        Probe::new(5).max_depth(200_000).along(&world, [0.1, 0.2, 0.05], [1.0, 1.01, 0.98])
    });
    let ledger = reading.ledger;
    assert_eq!((ledger.truncated, ledger.truncated_throughput, reading.highest), (5, 5.0, 0.0));
    assert_eq!(ledger.rays, 5 * 200_000);
}

#[test]
fn a_light_guide_carries_light_through_a_thousand_reflections() {
    let (refraction, width) = (fresnel(45.0, 1.0, 1.5), 1e-3);
    let length = 1000.0 * width / refraction.1.to_radians().tan();
    let reading = on_a_small_stack(|| {
        let rod = cuboid([0.0, -0.4, 0.0], [width, 0.4, length]).material(glass());
        let far = cuboid([-90.0, -90.0, length + 1.0], [90.0, 90.0, length + 2.0]).material(lamp());
        let sides = [-1.0, 1.0].map(|side| {
            cuboid([0.5 * side, -0.5, -0.1], [0.5 * side + 0.1, 0.5, length]).material(AbsorbingSurface)
        });
        let world = world([rod, far].into_iter().chain(sides));
        let [x, _, z] = tilted(45.0);
        Probe::new(14_000).max_depth(100_000).along(&world, [0.3 * width - x, 0.0, -z], [x, 0.0, z])
    });
    let r = refraction.0;
    accept("light guide", (1.0 - r) / (1.0 + r), Demand::Mean, &reading);
    assert!(reading.ledger.rays > 14_000 * 900 && reading.ledger.truncated == 0);
}

#[test]
fn a_white_room_ends_every_path_at_the_greatest_depth_and_says_so() {
    let room = || cuboid([-1.0, -2.0, -3.0], [1.5, 2.5, 3.5]);
    for depth in [1, 2, 50, 1000] {
        for rho in [1.0f64, 0.5] {
            let world = world([room().material(Lambert::new(rho))]);
            let probe = Probe::new(200).max_depth(depth).without_roulette();
            let ledger = probe.each(&world, anywhere).ledger;
            let left = 200.0 * rho.powi(depth as i32);
            assert_eq!((ledger.truncated, ledger.rays), (200, 200 * u64::from(depth)));
            assert!((ledger.truncated_throughput - left).abs() <= 1e-12 * left, "{depth} {ledger:?}");
        }
    }
}

/// A ray from about the middle in any direction.
fn anywhere(rng: &mut Rng) -> Ray {
    Ray::new(Point3D::new(0.1, 0.2, 0.3), sphere::sample(uniforms(rng)))
}

#[test]
fn roulette_kills_in_fair_play() {
    let world = world([ball([0.0; 3], 1.0, GlowingLambert(Lambert::new(0.5)))]);
    for threshold in [0.05, 0.5, 1.0] {
        let mut probe = Probe::new(400_000);
        probe.settings = probe.settings.roulette_threshold(threshold).unwrap();
        let reading = probe.each(&world, anywhere);
        accept(format!("roulette below {threshold}"), 2.0, Demand::Mean, &reading);
        assert_eq!((reading.ledger.killed, reading.ledger.truncated), (400_000, 0));
    }
}

/// A scene in which paths end in every way.
fn mixed() -> World {
    let glass = Dielectric::new(1.5, 0.6).unwrap();
    let boxed = |x: f64, material: Node<Optics>| (x, material).1;
    world([
        plate(Lambert::new(0.9)),
        boxed(0.0, ball([0.3, 0.2, 0.6], 0.4, glass)),
        ball([-0.5, 0.0, 0.8], 0.2, lamp()),
        cuboid([-1.0, -1.0, 1.3], [1.0, 1.0, 1.4]).material(Lambert::new(0.95)),
        cuboid([0.9, -1.0, 0.0], [1.0, 1.0, 1.0]).material(Screen(0.5)),
    ])
}

#[test]
fn every_path_has_one_fate() {
    let world = mixed();
    for sampling in EVERY {
        for depth in [1, 3, 500] {
            let reading = Probe::new(20_000)
                .light(sampling)
                .max_depth(depth)
                .each(&world, |rng| Ray::new(Point3D::new(-0.2, -0.9, 0.5), sphere::sample(uniforms(rng))));
            let ledger = reading.ledger;
            println!("{sampling:?}, depth {depth}: {ledger:?}");
            assert_eq!(unaccounted(&ledger), 0);
            let shadowed = sampling == LightSampling::Lights && depth > 1;
            assert!(ledger.absorbed > 0 && ledger.escaped > 0 && (ledger.shadow_rays > 0 || !shadowed));
            assert!((depth > 3 || ledger.truncated > 0) && (depth < 4 || ledger.killed > 0));
        }
    }
}

/// Follows paths that start on the surface of a ball and go outward.
fn from_the_surface(material: impl Material, radius: f64) -> Reading {
    let world = world([dome(), ball([0.0; 3], radius, material)]);
    Probe::new(20_000).each(&world, |rng| {
        let direction = sphere::sample(uniforms(rng));
        Ray::new(Point3D::ORIGIN + direction * radius, direction)
    })
}

#[test]
fn paths_that_start_on_a_surface_have_one_fate_as_well() {
    let reading = from_the_surface(AbsorbingSurface, 0.7);
    assert_eq!(reading.ledger.paths, 20_000);
    for (transmission, radius) in [(1.0, 0.7), (0.5, 1.3)] {
        let reading = from_the_surface(Dielectric::new(1.5, transmission).unwrap(), radius);
        assert_eq!(reading.ledger.lost, 0, "{:?}", reading.ledger);
    }
}

#[test]
fn the_same_key_gives_the_same_path() {
    let (world, settings) = (mixed(), PathSettings::default());
    let slices = Slicing::new(400.0, 700.0, 3, 1).unwrap().slices();
    let mut path = Path::new(world.scene().unwrap(), &slices[0], &settings);
    let mut follow = |sample| {
        let rng = Rng::keyed(StreamKey { seed: 7, sample, ..StreamKey::default() });
        path.follow(&Ray::new(Point3D::new(-0.2, -0.9, 0.5), Vector3D::new(0.3, 1.0, 0.1)), rng).to_vec()
    };
    let first: Vec<_> = (0..200).map(&mut follow).collect();
    let again: Vec<_> = (0..200).rev().map(&mut follow).collect();
    assert!(first.iter().eq(again.iter().rev()) && first.iter().any(|r| r[0] > 0.0));
}
