//! A Lambert plate and what lights it: the cosine law, boxes of nothing, absorbers and glowing volumes.

use raysect::core::Node;
use raysect::optical::LightSampling::{BoundingSpheres, Lights, Off};
use raysect::optical::{Dielectric, Lambert, LightSampling, NullMaterial, Optics, WithMaterial, World};
use std::f64::consts::PI;

use crate::check::{Demand, EVERY, Probe, Reading, accept, agree, check, expected};
use crate::materials::{Fog, Screen};
use crate::scenes::{EYE, VIEW, ball, cuboid, lit_plate, plate, world};

/// Reads the plate at the origin.
fn look(world: &World, sampling: LightSampling, count: u64) -> Reading {
    Probe::new(count).seed(11).light(sampling).aim(0.6).without_roulette().along(world, EYE, VIEW)
}

/// Radius, distance and angle off the normal [deg] of a ball lamp so near that it is often found by chance.
const NEAR: [f64; 3] = [3.0, 5.0, 40.0];

/// What the plate reflects of a ball lamp well above its horizon.
fn reflected([radius, distance, degrees]: [f64; 3]) -> f64 {
    0.7 * (radius / distance).powi(2) * degrees.to_radians().cos()
}

/// The plate, its lamp, and what else there is.
fn lit([radius, distance, degrees]: [f64; 3], more: impl IntoIterator<Item = Node<Optics>>) -> World {
    world(lit_plate(radius, distance, degrees).into_iter().chain(more))
}

#[test]
fn v03_the_irradiance_of_a_ball_follows_the_cosine() {
    for (id, degrees, off) in [("V03", 0.0, 0), ("V03t", 50.0, 2_900_000)] {
        let value = 0.7 * expected(id) / PI;
        assert!((value - reflected([0.5, 2.0, degrees])).abs() < 1e-12);
        let world = lit([0.5, 2.0, degrees], []);
        for (sampling, count) in EVERY.into_iter().zip([20_000, 150_000, off]).filter(|(_, n)| *n > 0) {
            let reading = look(&world, sampling, count);
            accept(format!("{id} {sampling:?}"), value, Demand::Mean, &reading);
        }
    }
}

#[test]
fn v03t_holds_for_many_seeds() {
    let world = lit([0.5, 2.0, 50.0], []);
    let value = reflected([0.5, 2.0, 50.0]);
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
    let far = lit([0.5, 10.0, 60.0], []);
    for (sampling, count) in [(Lights, 20_000), (BoundingSpheres, 150_000)] {
        let reading = look(&far, sampling, count);
        accept(format!("V09 {sampling:?}"), expected("V09"), Demand::Mean, &reading);
    }
    let (near, value) = (lit(NEAR, []), reflected(NEAR));
    for (sampling, count) in EVERY.into_iter().zip([60_000, 150_000, 350_000]) {
        accept(format!("V09 near {sampling:?}"), value, Demand::Mean, &look(&near, sampling, count));
    }
}

#[test]
fn roulette_spares_paths_that_are_aimed() {
    // They carry little because there are many of them, not because there is little light where they go.
    let world = lit([0.5, 10.0, 60.0], []);
    let probe = Probe::new(50_000).seed(14).light(BoundingSpheres);
    let without = probe.clone().without_roulette().along(&world, EYE, VIEW).radiance;
    let with = probe.along(&world, EYE, VIEW).radiance;
    println!("aimed at a small lamp, with roulette {with}, without {without}");
    assert!(with.error() < 1.5 * without.error(), "{with} with roulette, {without} without");
}

/// A box of nothing.
fn void(lower: [f64; 3], upper: [f64; 3]) -> Node<Optics> {
    cuboid(lower, upper).material(NullMaterial)
}

#[test]
fn x08_boxes_of_nothing_change_nothing() {
    let around_the_point = void([-0.5; 3], [0.5; 3]);
    let world = lit([0.5, 10.0, 60.0], [around_the_point]);
    for (sampling, count) in [(Lights, 20_000), (BoundingSpheres, 150_000)] {
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
    let bare = lit(NEAR, []);
    for (name, boxes) in scenes {
        let world = lit(NEAR, boxes);
        for sampling in EVERY {
            // The same random numbers lead to the same light, path by path.
            let (with, without) = (look(&world, sampling, 30_000), look(&bare, sampling, 30_000));
            let ratio = with.radiance.mean() / without.radiance.mean();
            assert!((ratio - 1.0).abs() < 1e-12, "{name} {sampling:?}: {ratio}");
        }
    }
}

#[test]
fn x09_a_matched_absorber_dims_by_its_transmission() {
    let glass = Dielectric::new(1.0, 0.5).unwrap();
    let solid = lit([0.5, 10.0, 60.0], [ball([0.0; 3], 1.0, glass)]);
    let reading = look(&solid, BoundingSpheres, 400_000);
    accept("X09 dielectric BoundingSpheres", expected("X09"), Demand::Mean, &reading);
    let fog = ball([0.0; 3], 1.0, Fog::dark(0.5));
    let fog = lit([0.5, 10.0, 60.0], [fog]);
    for (sampling, count) in [(Lights, 20_000), (BoundingSpheres, 150_000)] {
        accept(format!("X09 fog {sampling:?}"), expected("X09"), Demand::Mean, &look(&fog, sampling, count));
    }
}

#[test]
fn x09_absorbers_dim_a_near_lamp_in_every_way_of_looking_for_it() {
    let value = 0.25 * reflected(NEAR);
    // A dielectric hides the lamp from light sampling even if it does not refract: it is found by chance.
    let glass = ball([0.0; 3], 1.0, Dielectric::new(1.0, 0.5).unwrap().importance(0.0));
    let solid = lit(NEAR, [glass]);
    for (sampling, count) in EVERY.into_iter().zip([350_000, 150_000, 350_000]) {
        let reading = look(&solid, sampling, count);
        accept(format!("X09 near, dielectric {sampling:?}"), value, Demand::Mean, &reading);
    }
    // The same in shells of fog: what overlaps adds up.
    let shells = [0.5, 1.0].map(|radius| ball([0.0; 3], radius, Fog::dark(0.5f64.powf(1.0 / 1.5))));
    let fog = lit(NEAR, shells);
    for (sampling, count) in [(Lights, 60_000), (BoundingSpheres, 150_000)] {
        accept(format!("X09 near, fog {sampling:?}"), value, Demand::Mean, &look(&fog, sampling, count));
    }
}

#[test]
fn a_screen_with_holes_dims_by_its_holes() {
    // It is no transparent surface: light sampling must leave the lamp behind it to chance.
    let screen = cuboid([-2.0, -2.0, 0.3], [2.0, 2.0, 0.3]).material(Screen(0.6));
    let world = lit(NEAR, [screen]);
    for (sampling, count) in EVERY.into_iter().zip([650_000, 300_000, 650_000]) {
        let probe = Probe::new(count).seed(13).light(sampling).aim(0.6).without_roulette();
        let reading = probe.along(&world, [-0.2, 0.1, 0.2], [0.2, -0.1, -0.2]);
        accept(format!("screen {sampling:?}"), 0.6 * reflected(NEAR), Demand::Mean, &reading);
    }
}

#[test]
fn x10_a_glowing_volume_lights_a_plate() {
    let world = world([plate(Lambert::new(0.7)), ball([0.0, 0.0, 2.0], 0.5, Fog::bright())]);
    assert!((expected("X10") - 0.7 * expected("V08") / PI).abs() < 1e-12);
    for (sampling, count) in EVERY.into_iter().zip([120_000, 120_000, 2_000_000]) {
        let probe = Probe::new(count).seed(12).light(sampling).aim(0.6).without_roulette();
        let reading = probe.along(&world, [0.9, 0.0, 0.8], [-0.9, 0.0, -0.8]);
        accept(format!("X10 {sampling:?}"), expected("X10"), Demand::Mean, &reading);
    }
}

#[test]
fn a_lamp_in_the_medium_of_the_plate_is_dimmed_alike_in_every_way_of_looking_for_it() {
    let medium = |glass: bool| {
        let space = cuboid([-3.0, -3.0, -0.5], [3.0, 3.0, 4.5]);
        if glass {
            space.material(Dielectric::new(1.5, 0.4).unwrap())
        } else {
            space.material(Fog::dark(0.4))
        }
    };
    for glass in [false, true] {
        let world = lit([1.2, 3.0, 20.0], [medium(glass)]);
        let [lights, spheres, off] =
            [(Lights, 30_000), (BoundingSpheres, 150_000), (Off, 150_000)].map(|(s, n)| look(&world, s, n));
        agree(format!("in one medium, glass {glass}: Lights, Off"), &lights, &off);
        agree(format!("in one medium, glass {glass}: Lights, BoundingSpheres"), &lights, &spheres);
    }
}
