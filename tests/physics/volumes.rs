//! Volumes: line integrals through structure, and scattering.

use std::f64::consts::TAU;
use std::sync::Arc;

use raysect::math::{
    AffineMatrix3D, Point3D, Rng, Statistics, StreamKey, Vector3D, rotate, rotate_x, translate,
};
use raysect::optical::{
    Add, Blend, Context, HenyeyGreenstein, HomogeneousVolumeEmitter, InhomogeneousVolumeEmitter,
    LightSampling, Material, Path, PathSettings, ProfileVolume, Rayleigh, Slicing, UniformVolume,
    VolumeTransform, WithMaterial, World,
};
use raysect::primitive::Sphere;

use crate::check::{Demand, Probe, accept};
use crate::scenes::{ball, cuboid, dome, lamp, tilted, world};

/// A box of 1 m, whose axis is that of the paths.
fn metre_box(emitter: impl raysect::optical::Material) -> World {
    world([cuboid([-0.5, -0.5, 0.0], [0.5, 0.5, 1.0]).material(emitter)])
}

/// Statistics of paths along the axis.
fn read(world: &World, count: u64, seed: u64) -> Statistics {
    let slices = Slicing::new(500.0, 501.0, 1, 1).unwrap().slices();
    let settings = PathSettings::default();
    let mut path = Path::new(world.scene().unwrap(), &slices[0], &settings);
    let ray = raysect::core::Ray::new(Point3D::new(0.0, 0.0, -0.3), Vector3D::Z);
    let mut all = Statistics::new();
    for sample in 0..count {
        all.add(path.follow(&ray, Rng::keyed(StreamKey { seed, sample, ..StreamKey::default() }))[0]);
    }
    assert_eq!(path.ledger().unresolved, 0);
    all
}

#[test]
fn declared_attenuation_and_emission_are_solved_together() {
    // Along the axis of the box the density is 1 + cos(2 π z): ∫ = 1 m, and j/α is constant: L = (j/α)(1 − e^−τ).
    let uniform = UniformVolume::emitter(6.0).absorption(3.0);
    let density = |p: Point3D| 1.0 + (TAU * p.z).cos();
    let profile = ProfileVolume::new(uniform, density, 2.0, 0.2).unwrap();
    let found = read(&metre_box(profile), 1, 1).mean();
    assert!((found / (2.0 * (1.0 - (-3.0f64).exp())) - 1.0).abs() < 1e-6, "{found}");
}

/// A ball of fog in a furnace of radiance one: whatever scatters without loss reads one.
fn furnace(fog: impl raysect::optical::Material) -> World {
    world([dome(), ball([0.0; 3], 1.0, fog)])
}

#[test]
fn scattering_in_a_furnace_keeps_the_radiance() {
    let even = UniformVolume::new().scattering(2.0, HenyeyGreenstein::isotropic());
    let forward = UniformVolume::new().scattering(5.0, HenyeyGreenstein::new(0.8).unwrap());
    let rayleigh = UniformVolume::new().scattering(1.0, Rayleigh);
    // In equilibrium with the furnace: emission j = α L.
    let warm = UniformVolume::new().emission(0.7).absorption(0.7).scattering(2.0, Rayleigh);
    let cloud = |p: Point3D| 0.5 + 0.5 * (5.0 * p.x).sin() * (4.0 * p.z).cos();
    let profile = ProfileVolume::new(warm.clone(), cloud, 1.0, 0.1).unwrap();
    let probe = Probe::new(20_000);
    for (name, scene) in [
        ("even", furnace(even)),
        ("forward", furnace(forward)),
        ("Rayleigh", furnace(rayleigh)),
        ("warm", furnace(warm)),
        ("cloud", furnace(profile)),
    ] {
        for light in [LightSampling::Off, LightSampling::Lights] {
            let found = probe.clone().light(light).along(&scene, [0.1, 0.2, -5.0], [0.0, 0.02, 1.0]);
            accept(format!("{name} {light:?}"), 1.0, Demand::Mean, &found);
        }
    }
}

#[test]
fn a_phase_function_that_does_not_integrate_to_one_is_found_out() {
    struct Bright;
    impl raysect::optical::PhaseFunction for Bright {
        fn sample(&self, incoming: Vector3D, rng: &mut Rng) -> Vector3D {
            HenyeyGreenstein::isotropic().sample(incoming, rng)
        }
        fn pdf(&self, _: Vector3D, outgoing: Vector3D) -> f64 {
            (1.0 + 0.3 * outgoing.z) / (2.0 * TAU)
        }
    }
    // Seen along z from a lamp in a small part of the sky the density claimed is not that of the samples.
    let scene = world([
        ball([0.0, 0.0, 5.0], 2.0, lamp()),
        ball([0.0; 3], 1.0, UniformVolume::new().scattering(2.0, Bright)),
    ]);
    let right = world([
        ball([0.0, 0.0, 5.0], 2.0, lamp()),
        ball([0.0; 3], 1.0, UniformVolume::new().scattering(2.0, HenyeyGreenstein::isotropic())),
    ]);
    let probe = Probe::new(40_000);
    let read = |s: &World, l| probe.clone().light(l).along(s, [0.0, -5.0, 0.0], [0.0, 1.0, 0.0]);
    let (lights, off) = (read(&scene, LightSampling::Lights), read(&scene, LightSampling::Off));
    let error = lights.radiance.error().hypot(off.radiance.error());
    assert!(
        (lights.radiance.mean() - off.radiance.mean()).abs() > 4.0 * error,
        "{} {}",
        lights.radiance,
        off.radiance
    );
    let (lights, off) = (read(&right, LightSampling::Lights), read(&right, LightSampling::Off));
    let error = lights.radiance.error().hypot(off.radiance.error());
    let difference = lights.radiance.mean() - off.radiance.mean();
    assert!(error < 0.03 * off.radiance.mean(), "{} {}", lights.radiance, off.radiance);
    assert!(difference.abs() < 4.0 * error, "{} {}", lights.radiance, off.radiance);
}

#[test]
fn single_scattering_of_a_thin_ball_has_its_closed_form() {
    // A lamp of radiance 1 far away lights a thin ball: L = σ s p E, with E = π (R/d)².
    let sigma = 1e-3;
    let scene = world([
        ball([0.0, 0.0, 50.0], 1.0, lamp()),
        ball([0.0; 3], 1.0, UniformVolume::new().scattering(sigma, Rayleigh)),
    ]);
    // Half of the paths of 2 m would be unscattered 500 times: the fog is looked at by its share.
    let found = Probe::new(3_000_000).along(&scene, [0.0, -5.0, 0.0], [0.0, 1.0, 0.0]);
    let irradiance = std::f64::consts::PI / 2500.0;
    let phase = 3.0 / (16.0 * std::f64::consts::PI);
    let expected = sigma * 2.0 * phase * irradiance;
    let z = (found.radiance.mean() / expected - 1.0) / (found.radiance.error() / expected);
    assert!(found.radiance.error() < 0.02 * expected, "{}", found.radiance);
    assert!(z.abs() < 4.0 + 0.002 * expected / found.radiance.error(), "{} {expected}", found.radiance);
}

/// A sheet across the z axis of an emission of 1 in 0.4 … 0.6 m.
fn slab()
-> InhomogeneousVolumeEmitter<impl Fn(Point3D, Vector3D, Context<'_>, &mut [f64]) + Send + Sync + 'static> {
    InhomogeneousVolumeEmitter::length_scale(0.2, |p, _, _, bins| {
        bins.iter_mut().for_each(|b| *b += f64::from((p.z - 0.5).abs() < 0.1));
    })
    .unwrap()
}

#[test]
fn volumes_of_sums_and_blends_are_solved_together() {
    let (absorber, warm) = (UniformVolume::new().absorption(2.0), UniformVolume::emitter(3.0));
    let sum = Add::new(Arc::new(slab()), Arc::new(absorber.clone()));
    // ∫ exp(−2 s) over 0.4 … 0.6 m.
    let expected = ((-0.8f64).exp() - (-1.2f64).exp()) / 2.0;
    let found = read(&metre_box(sum), 1, 1).mean();
    assert!((found / expected - 1.0).abs() < 1e-6, "{found} {expected}");
    let blend = Blend::new(Arc::new(absorber), Arc::new(warm), 0.25).unwrap();
    let expected = 0.75 / 1.5 * (1.0 - (-1.5f64).exp());
    let found = read(&metre_box(blend), 1, 1).mean();
    assert!((found / expected - 1.0).abs() < 1e-12, "{found} {expected}");
}

/// Two materials that fill the same place.
type Pair = [Arc<dyn Material>; 2];

#[test]
fn mixtures_of_unlike_rules_are_what_overlapping_shapes_are() {
    let glow = |p: Point3D, _: Vector3D, _: Context<'_>, bins: &mut [f64]| {
        bins.iter_mut().for_each(|b| *b += (-3.0 * p.z).exp());
    };
    let jittered: Arc<dyn Material> = Arc::new(InhomogeneousVolumeEmitter::jittered(0.1, glow).unwrap());
    let steps: Arc<dyn Material> = Arc::new(InhomogeneousVolumeEmitter::trapezium(0.004, 5, glow).unwrap());
    let absorber: Arc<dyn Material> = Arc::new(UniformVolume::new().absorption(2.0));
    let density = |p: Point3D| 1.0 + (TAU * p.z).cos();
    let cloud = UniformVolume::emitter(1.0).absorption(2.0);
    let cloud: Arc<dyn Material> = Arc::new(ProfileVolume::new(cloud, density, 2.0, 0.2).unwrap());
    // ∫ exp(−5 s) and what a second one adds, over 1 m.
    let (dimmed, both) = ((1.0 - (-5.0f64).exp()) / 5.0, 2.0 * (1.0 - (-3.0f64).exp()) / 3.0);
    // The optical depth of the cloud is 2 s + sin(2 π s) / π; the cloud itself has j / α = 0.5.
    let through = |s: f64| (-(2.0 * s + (TAU * s).sin() / (0.5 * TAU))).exp();
    let parts = 100_000;
    let middle = |i: u32| (f64::from(i) + 0.5) / f64::from(parts);
    let shone =
        (0..parts).map(|i| (-3.0 * middle(i)).exp() * through(middle(i))).sum::<f64>() / f64::from(parts);
    let seen = 0.5 * (1.0 - (-2.0f64).exp()) + shone;
    let pairs: [(&str, Pair, f64); 4] = [
        ("jittered and absorber", [jittered.clone(), absorber.clone()], dimmed),
        ("absorber and steps", [absorber.clone(), steps.clone()], dimmed),
        ("steps and jittered", [steps.clone(), jittered.clone()], both),
        ("cloud and jittered", [cloud.clone(), jittered.clone()], seen),
    ];
    for (name, [one, two], expected) in pairs {
        let place = || cuboid([-0.5, -0.5, 0.0], [0.5, 0.5, 1.0]);
        let apart = world([place().material(one.clone()), place().material(two.clone())]);
        let mixture = metre_box(Add::new(one.clone(), two.clone()));
        let nested = Add::new(Arc::new(Blend::new(one.clone(), one, 0.4).unwrap()), two.clone());
        for (kind, world) in [("apart", apart), ("mixed", mixture), ("nested", metre_box(nested))] {
            let found = read(&world, 6000, 7);
            // The trapezium rule is off by 3e-5 here.
            let z = (found.mean() - expected) / found.error().max(2e-5 * expected);
            println!("{name}, {kind}: {found:?} {expected}, z {z:+.2}");
            assert!(found.error() < 1e-3 * expected, "{name}, {kind}: {found:?}");
            assert!(z.abs() < 4.0, "{name}, {kind}: {found:?} {expected}");
        }
    }
    // Shares count in what is emitted and in what is absorbed.
    let blend = metre_box(Blend::new(jittered.clone(), absorber, 0.25).unwrap());
    let (found, expected) = (read(&blend, 6000, 8), 0.75 * (1.0 - (-3.5f64).exp()) / 3.5);
    assert!(
        (found.mean() - expected).abs() < 4.0 * found.error() && found.error() < 1e-3 * expected,
        "{found:?}"
    );
    // What is moved is asked as one, and has no parts to be solved apart.
    let moved = Add::new(jittered, Arc::new(UniformVolume::new().absorption(2.0)));
    let moved = VolumeTransform::new(Arc::new(moved), translate(0.0, 0.0, 0.1)).unwrap();
    let ray = raysect::optical::Ray::new(Point3D::new(0.0, 0.0, -0.3), Vector3D::Z);
    let refused = ray.trace(&metre_box(moved)).unwrap_err().to_string();
    assert!(refused.contains("different rules cannot be moved"), "{refused}");
}

#[test]
fn a_volume_moves_within_its_shape() {
    let sum = |moved: f64| {
        let absorber = Arc::new(UniformVolume::new().absorption(2.0));
        let slab = VolumeTransform::new(Arc::new(slab()), translate(0.0, 0.0, moved)).unwrap();
        read(&metre_box(Add::new(Arc::new(slab), absorber)), 1, 1).mean()
    };
    let expected = |from: f64| ((-2.0 * from).exp() - (-2.0 * (from + 0.2)).exp()) / 2.0;
    assert!((sum(0.0) / expected(0.4) - 1.0).abs() < 1e-6);
    assert!((sum(-0.3) / expected(0.1) - 1.0).abs() < 1e-6);
}

#[test]
fn lengths_are_those_of_the_world() {
    // A box that is stretched four times along the ray holds 4 m, a fifth of it emitting.
    let mut world = World::new();
    let node = cuboid([-0.5, -0.5, 0.0], [0.5, 0.5, 1.0]).material(slab());
    let stretch = raysect::math::AffineMatrix3D::from_rows([
        [1.0, 0.0, 0.0, 0.0],
        [0.0, 1.0, 0.0, 0.0],
        [0.0, 0.0, 4.0, 0.0],
        [0.0, 0.0, 0.0, 1.0],
    ]);
    world.add(node.transform(stretch.unwrap())).unwrap();
    assert!((read(&world, 1, 1).mean() / 0.8 - 1.0).abs() < 1e-6);
}

/// Adds an emission of max(0, direction·z) per metre.
fn forwards(direction: Vector3D, bins: &mut [f64]) {
    bins.iter_mut().for_each(|bin| *bin += direction.z.max(0.0));
}

#[test]
fn emission_by_direction_is_that_of_the_light_in_the_space_of_the_shape() {
    // A ball of 2 m across whose emission goes along its own z axis: it is seen by who looks against that, and at an
    // angle θ from it by cos θ.
    let even = || HomogeneousVolumeEmitter::new(|direction, _, bins| forwards(direction, bins));
    let uneven =
        |_: Point3D, direction: Vector3D, _: Context<'_>, bins: &mut [f64]| forwards(direction, bins);
    let emitters: [(&str, Arc<dyn Material>); 4] = [
        ("homogeneous", Arc::new(even())),
        ("length scale", Arc::new(InhomogeneousVolumeEmitter::length_scale(0.5, uneven).unwrap())),
        ("jittered", Arc::new(InhomogeneousVolumeEmitter::jittered(0.1, uneven).unwrap())),
        ("trapezium", Arc::new(InhomogeneousVolumeEmitter::trapezium(0.1, 5, uneven).unwrap())),
    ];
    let turns = [AffineMatrix3D::IDENTITY, rotate(40.0, 0.0, 0.0), rotate(-70.0, 35.0, 20.0)];
    for (name, emitter) in emitters {
        for (number, turn) in turns.into_iter().enumerate() {
            let mut world = World::new();
            let node = Sphere::new(1.0).unwrap().material(Arc::clone(&emitter));
            world.add(node.transform(translate(0.3, -0.2, 0.5) * turn)).unwrap();
            let (centre, axis) = (Point3D::new(0.3, -0.2, 0.5), turn * Vector3D::Z);
            for degrees in [0.0, 30.0, 80.0, 100.0, 180.0] {
                // From where light arrives that has travelled at such an angle to the axis.
                let travels = turn * Vector3D::from(tilted(degrees));
                let reading =
                    Probe::new(10).along(&world, (centre + travels * 4.0).to_array(), (-travels).to_array());
                let expected = 2.0 * travels.dot(axis).max(0.0);
                assert!((expected - 2.0 * degrees.to_radians().cos().max(0.0)).abs() < 1e-12);
                let found = reading.radiance.mean();
                assert!((found - expected).abs() < 1e-9, "{name}, turn {number}, {degrees} degrees: {found}");
            }
        }
    }
}

#[test]
fn emission_by_direction_keeps_its_direction_in_stretched_and_moved_volumes() {
    // In a shape that is stretched along z a direction leans less than in the world; its length does not count.
    let stretch = AffineMatrix3D::from_axes(Vector3D::X, Vector3D::Y, Vector3D::Z * 3.0, Point3D::ORIGIN);
    let emitter = || HomogeneousVolumeEmitter::new(|direction, _, bins| forwards(direction, bins));
    let mut stretched = World::new();
    stretched.add(Sphere::new(1.0).unwrap().material(emitter()).transform(stretch)).unwrap();
    let read = |world: &World, travels: Vector3D| {
        let from = Point3D::ORIGIN + travels * 9.0;
        Probe::new(1).along(world, from.to_array(), (-travels).to_array()).radiance.mean()
    };
    let travels = Vector3D::new(0.6, 0.0, 0.8);
    let local = Vector3D::new(0.6, 0.0, 0.8 / 3.0);
    let (cosine, chord) = (local.z / local.length(), 2.0 / local.length());
    assert!((read(&stretched, travels) - chord * cosine).abs() < 1e-9, "{}", read(&stretched, travels));
    assert_eq!(read(&stretched, -travels), 0.0);
    // What the base emits along z is emitted along the image of z.
    let turned = VolumeTransform::new(Arc::new(emitter()), rotate_x(60.0)).unwrap();
    let turned = world([ball([0.0; 3], 1.0, turned)]);
    let axis = rotate_x(60.0) * Vector3D::Z;
    assert!((read(&turned, axis) - 2.0).abs() < 1e-9, "{}", read(&turned, axis));
    assert!((read(&turned, Vector3D::Z) - 1.0).abs() < 1e-9);
    assert_eq!(read(&turned, -axis), 0.0);
}
