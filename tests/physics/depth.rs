//! Long paths, how they end, and the book that is kept of it.

use std::thread;

use raysect::core::{Node, Ray};
use raysect::math::sampling::{sphere, uniforms};
use raysect::math::{AffineMatrix3D, Point3D, Rng, StreamKey, Vector3D, rotate};
use raysect::optical::{
    Dielectric, Lambert, Ledger, LightSampling, Optics, Path, PathSettings, Slicing, WithMaterial, World,
};

use raysect::primitive::Sphere;

use crate::check::{Demand, EVERY, Probe, accept, unaccounted};
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

/// A rod of glass along z, 1 mm thick, and a ray from below that is reflected so often on its way up.
fn light_guide(reflections: f64) -> (Node<Optics>, f64, Ray) {
    let (degrees, width) = (30.0, 1e-3);
    let length = reflections * width / fresnel(degrees, 1.0, 1.5).1.to_radians().tan();
    let rod = cuboid([0.0, -0.4, 0.0], [width, 0.4, length]).material(glass());
    let [x, y, z] = tilted(degrees);
    (rod, length, Ray::new(Point3D::new(0.3 * width - x, 0.0, -z), Vector3D::new(x, y, z)))
}

#[test]
fn a_light_guide_carries_light_to_its_end() {
    let (rod, length, ray) = light_guide(100.0);
    let far = cuboid([-90.0, -90.0, length + 1.0], [90.0, 90.0, length + 2.0]).material(lamp());
    let reading = Probe::new(10_500).each(&world([rod, far]), |_| ray);
    let r = fresnel(30.0, 1.0, 1.5).0;
    accept("light guide", (1.0 - r) / (1.0 + r), Demand::Mean, &reading);
}

#[test]
fn a_thousand_reflections_need_no_stack() {
    let reading = on_a_small_stack(|| {
        let (rod, _, ray) = light_guide(1000.0);
        Probe::new(300).max_depth(100_000).each(&world([dome(), rod]), |_| ray)
    });
    accept("light guide in a furnace", 1.0, Demand::Exact, &reading);
    assert!(reading.ledger.rays > 250 * 1000 && reading.ledger.truncated == 0);
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

#[test]
fn turned_and_sheared_white_rooms_do_not_leak() {
    let shear = AffineMatrix3D::from_axes(
        Vector3D::new(0.9, 0.1, 0.0),
        Vector3D::new(0.5, 0.8, 0.2),
        Vector3D::new(-0.3, 0.4, 0.6),
        Point3D::new(0.1, 0.2, 0.3),
    );
    let map = rotate(20.0, 30.0, 40.0) * shear;
    let rooms = [
        Sphere::new(1.0).unwrap().material(Lambert::new(1.0)).transform(map),
        cuboid([-1.0, -2.0, -0.5], [1.5, 0.5, 1.0]).material(Lambert::new(1.0)).transform(map),
    ];
    for room in rooms {
        let origin = map * Point3D::new(0.1, 0.0, 0.2);
        let probe = Probe::new(200).max_depth(1000);
        let reading = probe.each(&world([room]), |rng| Ray::new(origin, sphere::sample(uniforms(rng))));
        assert_eq!((reading.ledger.truncated, reading.ledger.rays), (200, 200_000));
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
        let reading = Probe::new(120_000).roulette(threshold).each(&world, anywhere);
        accept(format!("roulette below {threshold}"), 2.0, Demand::Mean, &reading);
        assert_eq!((reading.ledger.killed, reading.ledger.truncated), (120_000, 0));
    }
}

/// A scene in which paths end in every way.
fn mixed() -> World {
    let glass = Dielectric::new(1.5, 0.6).unwrap();
    world([
        plate(Lambert::new(0.9)),
        ball([0.3, 0.2, 0.6], 0.4, glass),
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
            let probe = Probe::new(20_000).light(sampling).max_depth(depth).roulette(0.5);
            let origin = Point3D::new(-0.2, -0.9, 0.5);
            let reading = probe.each(&world, |rng| Ray::new(origin, sphere::sample(uniforms(rng))));
            let ledger = reading.ledger;
            println!("{sampling:?}, depth {depth}: {ledger:?}");
            assert_eq!(unaccounted(&ledger), 0);
            let shadowed = sampling == LightSampling::Lights && depth > 1;
            assert!(ledger.absorbed > 0 && ledger.escaped > 0 && (ledger.shadow_rays > 0 || !shadowed));
            assert!((depth > 3 || ledger.truncated > 0) && (depth < 4 || ledger.killed > 0));
        }
    }
}

/// Follows paths that start on the surface of a ball at the origin and go straight away from it.
fn away_from(radius: f64, world: &World, mut judge: impl FnMut(f64)) -> Ledger {
    let slices = Slicing::new(500.0, 501.0, 1, 1).unwrap().slices();
    let settings = PathSettings::default();
    let mut path = Path::new(world.scene().unwrap(), &slices[0], &settings);
    for seed in 0..20_000 {
        let mut rng = Rng::new(seed);
        let direction = sphere::sample(uniforms(&mut rng));
        judge(path.follow(&Ray::new(Point3D::ORIGIN + direction * radius, direction), rng)[0]);
    }
    *path.ledger()
}

#[test]
fn a_path_that_starts_on_glass_is_either_inside_or_outside() {
    // So little glass that its attenuation is not seen, unless it is taken to fill the room.
    let world = world([dome(), ball([0.0; 3], 1e-3, Dielectric::new(1.5, 0.5).unwrap())]);
    let ledger = away_from(1e-3, &world, |value| {
        assert!((value - 1.0).abs() < 0.03 || (value - 2.25).abs() < 0.03, "{value}");
    });
    assert_eq!(unaccounted(&ledger), 0);
}

#[test]
fn a_path_that_starts_on_lonely_glass_has_one_fate() {
    for radius in [1e-3, 0.7, 1.3] {
        let world = world([ball([0.0; 3], radius, glass())]);
        let ledger = away_from(radius, &world, |value| assert_eq!(value, 0.0));
        assert_eq!((ledger.paths, unaccounted(&ledger)), (20_000, 0), "{ledger:?}");
    }
}

#[test]
fn the_same_key_gives_the_same_path() {
    let (world, settings) = (mixed(), PathSettings::default());
    let slices = Slicing::new(400.0, 700.0, 3, 1).unwrap().slices();
    let mut path = Path::new(world.scene().unwrap(), &slices[0], &settings);
    let mut follow = |sample| {
        let rng = Rng::keyed(StreamKey { seed: 7, sample, ..StreamKey::default() });
        path.follow(&Ray::new(Point3D::new(-0.2, -0.9, 0.5), Vector3D::new(-0.1, 1.0, -0.5)), rng).to_vec()
    };
    let first: Vec<_> = (0..200).map(&mut follow).collect();
    let again: Vec<_> = (0..200).rev().map(&mut follow).collect();
    assert!(first.iter().eq(again.iter().rev()) && first.iter().any(|r| r[0] > 0.0));
}
