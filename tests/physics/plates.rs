//! A Lambert plate and what lights it: the cosine law, boxes of nothing, absorbers and glowing volumes.

use raysect::core::Node;
use raysect::optical::LightSampling::{BoundingSpheres, Lights, Off};
use raysect::optical::{Dielectric, Lambert, LightSampling, NullMaterial, Optics, WithMaterial, World};
use std::f64::consts::PI;

use crate::check::{Demand, EVERY, Probe, Reading, accept, check, expected};
use crate::materials::{Fog, Screen};
use crate::scenes::{EYE, VIEW, ball, ball_lamp, cuboid, lit_plate, plate, world};

/// Reads the plate at the origin.
fn look(world: &World, sampling: LightSampling, count: u64) -> Reading {
    Probe::new(count).light(sampling).along(world, EYE, VIEW)
}

/// What the plate reflects of a ball lamp well above its horizon.
fn reflected(radius: f64, distance: f64, degrees: f64) -> f64 {
    0.7 * (radius / distance).powi(2) * degrees.to_radians().cos()
}

/// Asserts a value in every way of looking for light, with enough paths for a lamp of a solid angle about one.
fn accept_all(case: &str, value: f64, world: &World) {
    for (sampling, count) in EVERY.into_iter().zip([250_000, 400_000, 500_000]) {
        accept(format!("{case} {sampling:?}"), value, Demand::Mean, &look(world, sampling, count));
    }
}

#[test]
fn v03_the_irradiance_of_a_ball_follows_the_cosine() {
    for (id, degrees) in [("V03", 0.0), ("V03t", 50.0)] {
        let value = 0.7 * expected(id) / PI;
        assert!((value - reflected(0.5, 2.0, degrees)).abs() < 1e-12);
        let world = world(lit_plate(0.5, 2.0, degrees));
        for (sampling, count) in EVERY.into_iter().zip([100_000, 400_000, 3_000_000]) {
            let reading = look(&world, sampling, count);
            accept(format!("{id} {sampling:?}"), value, Demand::Mean, &reading);
        }
    }
}

#[test]
fn v03t_holds_for_many_seeds() {
    let world = world(lit_plate(0.5, 2.0, 50.0));
    let value = reflected(0.5, 2.0, 50.0);
    let far = |seed| {
        let reading = Probe::new(20_000).seed(seed).along(&world, EYE, VIEW);
        assert_eq!(check(value, Demand::Mean, &reading), Ok(()), "seed {seed}");
        (reading.radiance.mean() - value) / reading.radiance.error()
    };
    let all: Vec<f64> = (100..150).map(far).collect();
    // The errors are honest: z scatters about 0 with a variance of 1.
    let mean = all.iter().sum::<f64>() / 50.0;
    let variance = all.iter().map(|z| z * z).sum::<f64>() / 50.0;
    println!("V03t, 50 seeds: mean z {mean:.2}, variance {variance:.2}");
    assert!(mean.abs() < 4.0 / 50f64.sqrt() && (variance - 1.0).abs() < 4.0 * (2.0 / 50f64).sqrt());
}

#[test]
fn v09_a_small_distant_ball_lights_a_plate() {
    let world = world(lit_plate(0.5, 10.0, 60.0));
    for (sampling, count) in [(Lights, 100_000), (BoundingSpheres, 400_000)] {
        let reading = look(&world, sampling, count);
        accept(format!("V09 {sampling:?}"), expected("V09"), Demand::Mean, &reading);
    }
    let near = crate::scenes::world(lit_plate(3.0, 5.0, 40.0));
    accept_all("V09 near", reflected(3.0, 5.0, 40.0), &near);
}

/// A box of nothing.
fn void(lower: [f64; 3], upper: [f64; 3]) -> Node<Optics> {
    cuboid(lower, upper).material(NullMaterial)
}

#[test]
fn x08_boxes_of_nothing_change_nothing() {
    let around_the_point = void([-0.5; 3], [0.5; 3]);
    let world = world([lit_plate(0.5, 10.0, 60.0), vec![around_the_point]].into_iter().flatten());
    for (sampling, count) in [(Lights, 100_000), (BoundingSpheres, 400_000)] {
        let reading = look(&world, sampling, count);
        accept(format!("X08 {sampling:?}"), expected("X08"), Demand::Mean, &reading);
    }
}

#[test]
fn x08_nor_do_nested_ones_or_such_that_touch() {
    let scenes: [(&str, Vec<Node<Optics>>); 5] = [
        ("the light in a box", vec![void([0.1, -3.5, 0.3], [7.0, 3.5, 7.0])]),
        ("everything in a box", vec![void([-12.0; 3], [12.0; 3])]),
        ("nested boxes", (1..6).map(|i| void([-0.1 * i as f64; 3], [0.1 * i as f64; 3])).collect()),
        ("a box on the plate", vec![void([-0.5, -0.5, 0.0], [0.5, 0.5, 0.5])]),
        (
            "two boxes with a common face",
            vec![void([-2.0; 3], [0.0, 2.0, 2.0]), void([0.0, -2.0, -2.0], [2.0; 3])],
        ),
    ];
    for (name, boxes) in scenes {
        let world = world([lit_plate(3.0, 5.0, 40.0), boxes].into_iter().flatten());
        for (sampling, count) in EVERY.into_iter().zip([100_000, 250_000, 1_500_000]) {
            let reading = look(&world, sampling, count);
            accept(format!("X08 {name} {sampling:?}"), reflected(3.0, 5.0, 40.0), Demand::Mean, &reading);
        }
    }
}

#[test]
fn x09_a_matched_absorber_dims_by_its_transmission() {
    let glass = Dielectric::new(1.0, 0.5).unwrap();
    let solid = world([lit_plate(0.5, 10.0, 60.0), vec![ball([0.0; 3], 1.0, glass)]].into_iter().flatten());
    let reading = look(&solid, BoundingSpheres, 500_000);
    accept("X09 dielectric BoundingSpheres", expected("X09"), Demand::Mean, &reading);
    let fog = ball([0.0; 3], 1.0, Fog::dark(0.5));
    let fog = world([lit_plate(0.5, 10.0, 60.0), vec![fog]].into_iter().flatten());
    for (sampling, count) in [(Lights, 100_000), (BoundingSpheres, 400_000)] {
        accept(format!("X09 fog {sampling:?}"), expected("X09"), Demand::Mean, &look(&fog, sampling, count));
    }
}

#[test]
fn x09_absorbers_dim_a_near_lamp_in_every_way_of_looking_for_it() {
    let value = 0.25 * reflected(3.0, 5.0, 40.0);
    let glass = Dielectric::new(1.0, 0.5).unwrap().importance(0.0);
    let solid = [lit_plate(3.0, 5.0, 40.0), vec![ball([0.0; 3], 1.0, glass)]];
    accept_all("X09 near, dielectric", value, &world(solid.into_iter().flatten()));
    // The same in shells: what overlaps adds up.
    let shells = [0.5, 1.0].map(|radius| ball([0.0; 3], radius, Fog::dark(0.5f64.powf(1.0 / 1.5))));
    let fog = [lit_plate(3.0, 5.0, 40.0), shells.into()];
    accept_all("X09 near, fog", value, &world(fog.into_iter().flatten()));
}

#[test]
fn a_screen_with_holes_dims_by_its_holes() {
    let screen = cuboid([-2.0, -2.0, 0.3], [2.0, 2.0, 0.3]).material(Screen(0.6));
    let nodes = [vec![plate(Lambert::new(0.7)), ball_lamp(1.5, 4.0, 20.0)], vec![screen]];
    // Through the screen twice, from the eye and to the lamp.
    let value = 0.36 * reflected(1.5, 4.0, 20.0);
    let world = world(nodes.into_iter().flatten());
    for (sampling, count) in EVERY.into_iter().zip([2_000_000, 1_500_000, 3_000_000]) {
        accept(format!("screen {sampling:?}"), value, Demand::Mean, &look(&world, sampling, count));
    }
}

#[test]
fn x10_a_glowing_volume_lights_a_plate() {
    let world = world([plate(Lambert::new(0.7)), ball([0.0, 0.0, 2.0], 0.5, Fog::bright())]);
    assert!((expected("X10") - 0.7 * expected("V08") / PI).abs() < 1e-12);
    for (sampling, count) in EVERY.into_iter().zip([400_000, 400_000, 3_000_000]) {
        let mut probe = Probe::new(count).light(sampling);
        if sampling == Lights {
            probe.settings = probe.settings.important_path_weight(0.75).unwrap();
        }
        let reading = probe.along(&world, [0.9, 0.0, 0.8], [-0.9, 0.0, -0.8]);
        accept(format!("X10 {sampling:?}"), expected("X10"), Demand::Mean, &reading);
    }
}

#[test]
fn a_camera_in_the_fog_sees_what_is_left_of_the_plate() {
    let fog = cuboid([-3.0, -3.0, -0.5], [3.0, 3.0, 2.0]).material(Fog::dark(0.4));
    let world = world([lit_plate(0.8, 3.0, 0.0), vec![fog]].into_iter().flatten());
    let dimmed = |count| look(&world, Lights, count);
    // To the eye over its distance; to the lamp over 2 m / cos θ, which varies over the lamp by little.
    let reading = dimmed(100_000);
    let off = look(&world, Off, 2_000_000);
    crate::check::agree("eye in the fog: Lights and Off", &reading, &off);
}
