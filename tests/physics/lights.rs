//! Lights of all kinds over a plate: sampled by their shape, through bounding spheres, or found by chance.

use raysect::core::Node;
use raysect::math::{AffineMatrix3D, Point3D, Vector3D, rotate, translate};
use raysect::optical::LightSampling::{BoundingSpheres, Lights, Off};
use raysect::optical::{Dielectric, Lambert, LightSampling, Optics, WithMaterial, World};
use raysect::primitive::{Cuboid, Sphere, Torus};

use crate::check::{Demand, EVERY, Probe, Reading, accept, agree};
use crate::irradiance::{ball_factor, box_factor};
use crate::scenes::{ball, cuboid, lamp, plate, world};

/// Where the plate is looked at from in these scenes: low, and close enough for nothing to come between.
const EYE: [f64; 3] = [-1e-2, 0.0, 0.4e-2];
const VIEW: [f64; 3] = [1.0, 0.0, -0.4];

/// A world of a Lambert plate, reflectivity 0.7, and lights.
pub(crate) fn over_a_plate(lights: impl IntoIterator<Item = Node<Optics>>) -> World {
    world([plate(Lambert::new(0.7))].into_iter().chain(lights))
}

/// Reads the plate at the origin.
pub(crate) fn look(world: &World, sampling: LightSampling, count: u64) -> Reading {
    Probe::new(count).seed(31).light(sampling).aim(0.5).without_roulette().along(world, EYE, VIEW)
}

/// Asserts the closed form of a factor, in every way of looking for light.
pub(crate) fn accept_all(case: &str, factor: f64, world: &World, counts: [u64; 3]) {
    for (sampling, count) in EVERY.into_iter().zip(counts).filter(|(_, count)| *count > 0) {
        accept(format!("{case} {sampling:?}"), 0.7 * factor, Demand::Mean, &look(world, sampling, count));
    }
}

/// A scale about the origin.
fn scale(x: f64, y: f64, z: f64) -> AffineMatrix3D {
    AffineMatrix3D::from_axes(Vector3D::X * x, Vector3D::Y * y, Vector3D::Z * z, Point3D::ORIGIN)
}

/// A map that is no similarity.
pub(crate) fn shear() -> AffineMatrix3D {
    AffineMatrix3D::from_axes(
        Vector3D::new(0.9, 0.1, 0.0),
        Vector3D::new(0.5, 0.8, 0.2),
        Vector3D::new(-0.3, 0.4, 0.6),
        Point3D::ORIGIN,
    )
}

#[test]
fn boxes_under_every_affine_map() {
    let up = |x, y, z| translate(x, y, z) * rotate(30.0, 40.0, 20.0);
    for (name, map) in [
        ("rotated", up(0.3, -0.2, 1.5)),
        ("scaled down", up(0.1, 0.2, 0.6) * scale(0.4, 0.4, 0.4)),
        ("scaled up", up(2.0, -1.0, 6.0) * scale(5.0, 5.0, 5.0)),
        ("sheared", translate(0.2, 0.0, 1.3) * shear()),
        ("sheared and mirrored", up(-0.2, 0.1, 1.2) * shear() * scale(1.0, -1.0, 1.0)),
    ] {
        let world = over_a_plate([Cuboid::default().material(lamp()).transform(map)]);
        accept_all(name, box_factor(&Cuboid::default(), &map), &world, [80_000, 640_000, 750_000]);
    }
}

#[test]
fn boxes_in_nested_frames() {
    let (outer, inner) =
        (translate(0.0, 0.0, 1.2) * shear(), rotate(10.0, 70.0, 30.0) * scale(1.2, 0.7, 0.5));
    let mut world = over_a_plate([]);
    let group = world.add(Node::group().transform(outer)).unwrap();
    world.add(Cuboid::default().material(lamp()).transform(inner).parent(group)).unwrap();
    let factor = box_factor(&Cuboid::default(), &(outer * inner));
    accept_all("nested frames", factor, &world, [80_000, 600_000, 900_000]);
}

#[test]
fn sheets_and_strips() {
    let identity = AffineMatrix3D::IDENTITY;
    for (name, lower, upper, counts) in [
        ("square sheet", [-0.4, -0.4, 0.7], [0.4, 0.4, 0.7], [40_000, 300_000, 400_000]),
        // Points inside the bounding sphere of a light: it is aimed at in vain.
        ("strip", [-2.0, -0.01, 1.0], [2.0, 0.01, 1.0], [150_000, 0, 0]),
        ("near sheet", [-2.0, -2.0, 0.2], [2.0, 2.0, 0.2], [60_000, 150_000, 60_000]),
        ("distant sheet", [20.0, 20.0, 80.0], [21.0, 21.0, 80.0], [20_000, 300_000, 0]),
    ] {
        let sheet = cuboid(lower, upper);
        let world = over_a_plate([sheet.material(lamp())]);
        accept_all(name, box_factor(&sheet, &identity), &world, counts);
    }
}

#[test]
fn lights_that_touch_the_plate() {
    let block = cuboid([0.05, -0.5, 0.0], [0.6, 0.6, 0.8]);
    let factor = box_factor(&block, &AffineMatrix3D::IDENTITY);
    let blocks = over_a_plate([block.material(lamp())]);
    accept_all("block on the plate", factor, &blocks, [130_000, 400_000, 160_000]);
    let tangent = over_a_plate([ball([0.4, 0.0, 0.3], 0.3, lamp())]);
    assert!((ball_factor(0.3, 0.5, 0.8f64.asin()) - 0.216).abs() < 1e-12);
    accept_all("ball on the plate", 0.216, &tangent, [40_000, 150_000, 450_000]);
    let sunk = over_a_plate([ball([0.4, 0.0, 0.0], 0.3, lamp())]);
    let factor = ball_factor(0.3, 0.4, 90f64.to_radians());
    accept_all("ball sunk in the plate", factor, &sunk, [200_000, 400_000, 1_200_000]);
}

#[test]
fn balls_from_tiny_to_all_but_touching() {
    let limit = [(1e-6, 0), (1e-3, 0), (0.01, 0), (0.1, 0), (0.5, 400_000), (0.9, 40_000), (0.99, 10_000)];
    for (ratio, off) in limit.into_iter().chain([(0.999, 10_000), (1.0 - 1e-8, 0)]) {
        let world = over_a_plate([ball([0.0, 0.0, 1.0], ratio, lamp())]);
        let view = [0.94, 0.0, -0.342];
        let eye = view.map(|x| -1e-10 * x);
        for (sampling, count) in EVERY.into_iter().zip([30_000, 120_000, off]).filter(|(_, n)| *n > 0) {
            let reading = Probe::new(count)
                .seed(32)
                .light(sampling)
                .aim(0.6)
                .without_roulette()
                .along(&world, eye, view);
            let case = format!("ball, r/d = {ratio} {sampling:?}");
            accept(case, 0.7 * ratio * ratio, Demand::Mean, &reading);
        }
    }
}

#[test]
fn several_lights_add_up() {
    let map = translate(1.0, 0.8, 1.0) * rotate(20.0, 50.0, 0.0) * shear();
    let sheet = cuboid([-1.6, -0.5, 0.6], [-0.9, 0.5, 0.6]);
    let world = over_a_plate([
        // One that is left to chance.
        Cuboid::default().material(lamp().importance(0.0)).transform(map),
        ball([0.0, 0.0, 2.0], 0.5, lamp()),
        ball([0.3, -1.2, 0.9], 0.4, lamp().importance(3.0)),
        sheet.material(lamp().importance(0.2)),
    ]);
    let distance = (0.09f64 + 1.44 + 0.81).sqrt();
    let factor = box_factor(&Cuboid::default(), &map)
        + box_factor(&sheet, &AffineMatrix3D::IDENTITY)
        + ball_factor(0.5, 2.0, 0.0)
        + ball_factor(0.4, distance, (0.9 / distance).acos());
    accept_all("four lights", factor, &world, [250_000, 500_000, 400_000]);
}

#[test]
fn lights_that_hide_one_another() {
    let world = over_a_plate([
        ball([0.0, 0.0, 1.5], 0.7, lamp()),
        cuboid([-0.3, -0.3, 0.4], [0.5, 0.2, 0.5])
            .material(raysect::optical::UniformSurfaceEmitter::new(3.0, 1.0)),
        cuboid([-0.6, 0.1, 0.6], [0.1, 0.7, 0.6]).material(Lambert::new(0.4)),
    ]);
    all_agree("hidden lights", &world, [80_000, 200_000, 200_000]);
}

/// Asserts that all ways of looking for light read the same.
pub(crate) fn all_agree(case: &str, world: &World, counts: [u64; 3]) {
    let [lights, spheres, off] = [0, 1, 2].map(|i| look(world, EVERY[i], counts[i]));
    agree(format!("{case}: {Lights:?}, {Off:?}"), &lights, &off);
    agree(format!("{case}: {BoundingSpheres:?}, {Off:?}"), &spheres, &off);
    agree(format!("{case}: {Lights:?}, {BoundingSpheres:?}"), &lights, &spheres);
}

#[test]
fn ellipsoids_are_aimed_at() {
    let map = translate(0.3, 0.2, 1.0) * shear();
    let world = over_a_plate([Sphere::new(0.8).unwrap().material(lamp()).transform(map)]);
    all_agree("ellipsoid", &world, [150_000, 150_000, 150_000]);
}

/// A level ring at a height above the plate fills the directions between two angles off the normal,
/// ∫ 2 sin θ cos θ dθ = sin 2θ sin 2α about the angle θ of the middle of its tube, α to either side.
#[test]
fn rings_that_hide_parts_of_themselves() {
    for (case, major, minor, height, counts) in [
        ("ring", 0.8, 0.3, 1.0, [150_000, 300_000, 300_000]),
        ("thin ring", 0.8, 0.02, 1.0, [400_000, 0, 0]),
        ("wide ring", 30.0, 8.0, 12.0, [150_000, 300_000, 300_000]),
    ] {
        let ring = Torus::new(major, minor).unwrap().material(lamp()).transform(translate(0.0, 0.0, height));
        let (theta, alpha) = (major.atan2(height), (minor / major.hypot(height)).asin());
        let factor = (2.0 * theta).sin() * (2.0 * alpha).sin();
        accept_all(case, factor, &over_a_plate([ring]), counts);
    }
    let map = translate(0.3, 0.2, 1.2) * rotate(20.0, 70.0, 10.0) * shear();
    let world = over_a_plate([Torus::new(0.5, 0.2).unwrap().material(lamp()).transform(map)]);
    all_agree("sheared ring", &world, [150_000, 150_000, 150_000]);
}

#[test]
fn a_lamp_behind_glass_is_found_through_it() {
    let pane = cuboid([-3.0, -3.0, 0.2], [3.0, 3.0, 0.5]).material(Dielectric::new(1.5, 0.7).unwrap());
    let world = over_a_plate([pane, ball([0.3, 0.0, 2.0], 1.0, lamp())]);
    all_agree("lamp behind glass", &world, [200_000, 200_000, 200_000]);
}

#[test]
fn a_ball_lamp_in_the_middle_of_a_white_ball() {
    let (rho, radius) = (0.8, 0.4f64);
    let world = world([ball([0.0; 3], 1.0, Lambert::new(rho)), ball([0.0; 3], radius, lamp())]);
    let share = radius * radius;
    let value = rho * share / (1.0 - rho * (1.0 - share));
    for (sampling, count) in EVERY.into_iter().zip([60_000, 150_000, 150_000]) {
        let reading =
            Probe::new(count).seed(33).light(sampling).along(&world, [0.0, 0.7, 0.0], [0.3, 0.2, 1.0]);
        accept(format!("ball in a ball {sampling:?}"), value, Demand::Mean, &reading);
    }
}

#[test]
fn lights_of_unlike_brightness_are_looked_for_by_what_they_give() {
    // Of two equal balls at equal distances one is a thousand times brighter.
    let pair = |bright: f64| {
        let lamp = |x: f64, radiance: f64| {
            let lamp = raysect::optical::UniformSurfaceEmitter::new(radiance, 1.0);
            ball([x, 0.3, 1.0], 0.1, lamp)
        };
        over_a_plate([lamp(-0.5, bright), lamp(0.5, 1.0)])
    };
    let (equal, unlike) = (look(&pair(1.0), Lights, 40_000), look(&pair(1000.0), Lights, 40_000));
    let relative = |found: &Reading| found.radiance.error() / found.radiance.mean();
    println!("{} {}", relative(&equal), relative(&unlike));
    // If both were looked for equally often, half of the samples would see next to nothing: an error of one over the
    // root of their number.
    assert!(relative(&unlike) < 0.2 / 200.0, "{}", unlike.radiance);
    let distance = (0.5f64 * 0.5 + 0.3 * 0.3 + 1.0).sqrt();
    let each = ball_factor(0.1, distance, distance.recip().acos());
    accept("unlike lights", 0.7 * each * 1001.0, Demand::Mean, &unlike);
    accept("equal lights", 0.7 * each * 2.0, Demand::Mean, &equal);
}
