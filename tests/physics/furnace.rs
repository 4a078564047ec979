//! Closed enclosures: the white furnace and its relatives.

use raysect::core::{Node, Ray};
use raysect::math::sampling::{sphere, uniforms};
use raysect::math::{Point3D, Rng, Vector3D};
use raysect::optical::{Dielectric, Lambert, LightSampling, Optics, WithMaterial};

use crate::check::{Demand, EVERY, Probe, accept, check, expected};
use crate::materials::GlowingLambert;
use crate::scenes::{ball, cuboid, dome, lamp, tilted, times, world};

/// A ray upwards from below, somewhere through the middle of the unit ball.
fn upwards(rng: &mut Rng) -> Ray {
    Ray::new(Point3D::new(rng.range(-0.6, 0.6), rng.range(-0.6, 0.6), -5.0), Vector3D::Z)
}

/// A ray from a point inside the unit ball in any direction.
fn anywhere(rng: &mut Rng) -> Ray {
    Ray::new(Point3D::new(0.1, 0.2, 0.3), sphere::sample(uniforms(rng)))
}

/// The unit ball of a material.
fn unit_ball(material: impl raysect::optical::Material) -> Node<Optics> {
    ball([0.0; 3], 1.0, material)
}

#[test]
fn r01_a_lambert_ball_in_a_furnace_reads_its_reflectivity() {
    let world = world([dome(), unit_ball(Lambert::new(0.8))]);
    for sampling in [LightSampling::Lights, LightSampling::Off] {
        let reading = Probe::new(100_000).light(sampling).each(&world, upwards);
        accept(format!("R01 {sampling:?}"), expected("R01"), Demand::Exact, &reading);
    }
    let reading = Probe::new(150_000).seed(8).light(LightSampling::BoundingSpheres).each(&world, upwards);
    accept("R01 BoundingSpheres", expected("R01"), Demand::Mean, &reading);
}

#[test]
fn r01_holds_in_every_bin_of_a_spectrum() {
    let world = world([dome(), unit_ball(Lambert::new(|wavelength: f64| wavelength / 1000.0))]);
    let ray = raysect::optical::Ray::new(Point3D::new(0.3, 0.1, -5.0), Vector3D::Z).spectrum(400.0, 800.0, 8);
    let seen = ray.sample(&world, 1000).unwrap();
    for (i, radiance) in seen.mean.samples().iter().enumerate() {
        let reflectivity = 0.425 + 0.05 * i as f64;
        assert!((radiance - reflectivity).abs() < 1e-9 && seen.error[i] < 1e-12, "{i}: {radiance}");
    }
    assert_eq!(ray.trace(&world).unwrap().bins(), 8);
}

#[test]
fn r02_a_closed_emitter_does_not_leak() {
    let furnaces = [unit_ball(lamp()), cuboid([-1.0, -0.5, -2.0], [1.0, 0.7, 0.9]).material(lamp())];
    for (furnace, count) in furnaces.into_iter().zip([1_000_000, 1_000_000]) {
        let reading = Probe::new(count).each(&world([furnace]), anywhere);
        accept("R02", expected("R02"), Demand::Exact, &reading);
        assert_eq!(reading.ledger.escaped, 0);
    }
}

#[test]
fn r03_lossless_glass_vanishes_in_a_furnace() {
    let glass = || Dielectric::new(1.5, 1.0).unwrap();
    let brick = cuboid([-0.7, -0.8, -0.9], [0.8, 0.7, 0.6]).material(glass());
    for body in [unit_ball(glass()), brick] {
        let world = world([dome(), body]);
        for sampling in EVERY {
            let reading = Probe::new(100_000).light(sampling).each(&world, upwards);
            accept(format!("R03 {sampling:?}"), expected("R03"), Demand::Exact, &reading);
        }
    }
}

#[test]
fn r04_an_absorbing_glass_ball_in_a_furnace() {
    let world = world([dome(), unit_ball(Dielectric::new(1.5, 0.5).unwrap())]);
    for (id, impact) in [("R04a", 0.0), ("R04b", 0.6)] {
        let reading = Probe::new(150_000).seed(4).along(&world, [impact, 0.0, -5.0], [0.0, 0.0, 1.0]);
        accept(id, expected(id), Demand::Mean, &reading);
    }
}

#[test]
fn x03_radiance_inside_glass_is_that_outside_times_the_square_of_the_index() {
    let world = world([dome(), unit_ball(Dielectric::new(1.5, 1.0).unwrap())]);
    // From the centre no ray is reflected totally, from elsewhere some are and come back.
    let centre = |rng: &mut Rng| Ray::new(Point3D::ORIGIN, sphere::sample(uniforms(rng)));
    let reading = Probe::new(100_000).each(&world, centre);
    accept("X03 centre", expected("X03"), Demand::Exact, &reading);
    let reading = Probe::new(100_000).each(&world, anywhere);
    accept("X03 elsewhere", expected("X03"), Demand::Exact, &reading);
}

#[test]
fn r08_a_glowing_diffuse_room_is_a_geometric_series() {
    let brick = cuboid([-1.0, -0.5, -2.0], [1.0, 0.7, 0.9]);
    for room in
        [unit_ball(GlowingLambert(Lambert::new(0.9))), brick.material(GlowingLambert(Lambert::new(0.9)))]
    {
        let world = world([room]);
        for sampling in [LightSampling::Lights, LightSampling::Off] {
            let reading = Probe::new(1000).without_roulette().light(sampling).each(&world, anywhere);
            accept(format!("R08 {sampling:?}"), expected("R08"), Demand::Exact, &reading);
            assert_eq!(reading.ledger.truncated, 1000);
        }
        let reading = Probe::new(20_000).seed(88).each(&world, anywhere);
        accept("R08 roulette", expected("R08"), Demand::Mean, &reading);
    }
}

#[test]
fn r08_truncation_leaves_what_is_reported() {
    let world = world([unit_ball(GlowingLambert(Lambert::new(0.9)))]);
    let reading = Probe::new(1000).without_roulette().max_depth(20).each(&world, anywhere);
    let rest = 0.9f64.powi(20);
    accept("R08 depth 20", (1.0 - rest) * expected("R08"), Demand::Exact, &reading);
    let reported = reading.ledger.truncated_throughput / 1000.0;
    assert!((reported - rest).abs() < 1e-12 * rest, "{reported} {rest}");
}

#[test]
fn r09_an_integrating_sphere_with_a_port() {
    let port = cuboid([-0.7, -0.7, 0.8], [0.7, 0.7, 2.0]).material(lamp());
    let world = world([unit_ball(Lambert::new(0.9)), port]);
    let downwards = |rng: &mut Rng| {
        Ray::new(
            Point3D::new(0.05, 0.02, 0.1),
            Vector3D::new(rng.range(-0.5, 0.5), rng.range(-0.5, 0.5), -1.0),
        )
    };
    for (sampling, count) in EVERY.into_iter().zip([60_000, 100_000, 60_000]) {
        let reading = Probe::new(count).seed(9).light(sampling).each(&world, downwards);
        accept(format!("R09 {sampling:?}"), expected("R09"), Demand::Mean, &reading);
    }
}

#[test]
fn five_seeds_of_an_absorbing_glass_ball_all_agree() {
    let world = world([dome(), unit_ball(Dielectric::new(1.5, 0.5).unwrap())]);
    let origin = times(tilted(180.0), 5.0);
    std::thread::scope(|scope| {
        let run = |seed| {
            let reading = Probe::new(100_000).seed(seed).along(&world, origin, [0.0, 0.0, 1.0]);
            check(expected("R04a"), Demand::Mean, &reading)
        };
        let runs: Vec<_> = (10..15).map(|seed| scope.spawn(move || run(seed))).collect();
        for run in runs {
            assert_eq!(run.join().unwrap(), Ok(()));
        }
    });
}
