//! Negative controls: wrong materials must not pass, and right ones written the same way must.

use raysect::optical::LightSampling::{BoundingSpheres, Lights, Off};
use raysect::optical::{
    AbsorbingSurface, Lambert, LightSampling, Material, UniformSurfaceEmitter, WithMaterial,
};

use crate::check::{Demand, Probe, Reading, Rejection, accept, check, expected, refuse};
use crate::scenes::{EYE, VIEW, ball, ball_lamp, cuboid, dome, lamp, plate, tilted, times, world};
use crate::wrong::{Diffuse, DiffuseFault, Glass, GlassFault};

/// R01 with a surface of one's own.
fn furnace(material: impl Material, sampling: LightSampling) -> Reading {
    let world = world([dome(), ball([0.0; 3], 1.0, material)]);
    Probe::new(100_000).seed(42).light(sampling).along(&world, [0.2, 0.1, -5.0], [0.0, 0.0, 1.0])
}

/// A plate of reflectivity 0.7 and a lamp of one's own, as V03t with a larger ball.
fn tilted_plate(material: impl Material, radiance: f64, sampling: LightSampling) -> Reading {
    let lamp = ball(times(tilted(40.0), 5.0), 3.0, UniformSurfaceEmitter::new(radiance, 1.0));
    let probe = Probe::new(400_000).seed(41).light(sampling).aim(0.6).without_roulette();
    probe.along(&world([plate(material), lamp]), EYE, VIEW)
}

/// What that plate reflects.
fn tilted_plate_value() -> f64 {
    0.7 * 0.36 * 40f64.to_radians().cos()
}

#[test]
fn wrong_diffuse_surfaces_are_found_in_the_furnace() {
    let surface = |fault| Diffuse { reflectivity: 0.8, fault };
    for sampling in [Lights, BoundingSpheres, Off] {
        let right = furnace(surface(DiffuseFault::None), sampling);
        accept(format!("right surface {sampling:?}"), expected("R01"), Demand::Mean, &right);
        // The others are for the lamp below: without a cosine the variance is infinite, and uniform samples are right
        // in a uniform room.
        for fault in [DiffuseFault::NoPi, DiffuseFault::NoReflectivity, DiffuseFault::UniformDensity] {
            let reading = furnace(surface(fault), sampling);
            let demand = if reading.radiance.error() == 0.0 { Demand::Exact } else { Demand::Mean };
            refuse(format!("{fault:?} in the furnace {sampling:?}"), expected("R01"), demand, &reading);
        }
    }
}

#[test]
fn wrong_diffuse_surfaces_are_found_under_a_lamp() {
    let surface = |fault| Diffuse { reflectivity: 0.7, fault };
    for sampling in [Lights, BoundingSpheres] {
        let right = tilted_plate(surface(DiffuseFault::None), 1.0, sampling);
        accept(format!("right surface {sampling:?}"), tilted_plate_value(), Demand::Mean, &right);
        for fault in [DiffuseFault::NoCosine, DiffuseFault::NoPi, DiffuseFault::NoReflectivity] {
            let reading = tilted_plate(surface(fault), 1.0, sampling);
            refuse(
                format!("{fault:?} under a lamp {sampling:?}"),
                tilted_plate_value(),
                Demand::Mean,
                &reading,
            );
        }
    }
    // Light sampling hides most of a wrong density; paths that find the lamp by chance see it.
    for fault in [DiffuseFault::UniformDensity, DiffuseFault::UniformSamples] {
        let reading = tilted_plate(surface(fault), 1.0, Off);
        refuse(format!("{fault:?} under a lamp Off"), tilted_plate_value(), Demand::Mean, &reading);
    }
}

#[test]
fn one_per_cent_too_much_light_is_found() {
    let bright = || UniformSurfaceEmitter::new(1.01, 1.0);
    let world = world([ball([0.0; 3], 60.0, bright()), ball([0.0; 3], 1.0, Lambert::new(0.8))]);
    let reading = Probe::new(1000).along(&world, [0.2, 0.1, -5.0], [0.0, 0.0, 1.0]);
    refuse("1 % more in the furnace", expected("R01"), Demand::Exact, &reading);
    for sampling in [Lights, BoundingSpheres] {
        let reading = tilted_plate(Lambert::new(0.7), 1.01, sampling);
        refuse(format!("1 % more over a plate {sampling:?}"), tilted_plate_value(), Demand::Mean, &reading);
    }
}

/// A glowing glass ball seen through its centre, as in X01.
fn glowing_ball(fault: GlassFault) -> Reading {
    let world = world([ball([0.0; 3], 1.0, Glass::new(1.0, 1.0, fault))]);
    Probe::new(100_000).seed(43).along(&world, [0.6, 0.0, -5.0], [0.0, 0.0, 1.0])
}

/// The reflectance of glass at an angle [deg], as in O05.
fn reflectance(fault: GlassFault, degrees: f64, count: u64) -> Reading {
    let glass = cuboid([-400.0, -400.0, -200.0], [400.0, 400.0, 0.0]).material(Glass::new(0.0, 1.0, fault));
    let sink = cuboid([-390.0, -390.0, -190.0], [390.0, 390.0, -1.0]).material(AbsorbingSurface);
    let world = world([glass, sink, ball([0.0; 3], 3000.0, lamp())]);
    let [x, y, z] = tilted(degrees);
    Probe::new(count).seed(44).along(&world, times([x, y, -z], -3.0), [x, y, -z])
}

/// An absorbing glass ball in the furnace, off its centre, as in R04b.
fn absorbing_ball(fault: GlassFault) -> Reading {
    let world = world([dome(), ball([0.0; 3], 1.0, Glass::new(0.0, 0.5, fault))]);
    Probe::new(150_000).seed(45).along(&world, [0.6, 0.0, -5.0], [0.0, 0.0, 1.0])
}

#[test]
fn wrong_glass_is_found() {
    let fine = GlassFault::None;
    accept("right glass, glowing", expected("X02"), Demand::Mean, &glowing_ball(fine));
    accept("right glass, absorbing", expected("R04b"), Demand::Mean, &absorbing_ball(fine));
    let squared = GlassFault::SquaredReflectance;
    refuse("no n², glowing", expected("X02"), Demand::Mean, &glowing_ball(GlassFault::NoSquaredIndex));
    refuse("R squared, absorbing", expected("R04b"), Demand::Mean, &absorbing_ball(squared));
    refuse("no attenuation", expected("R04b"), Demand::Mean, &absorbing_ball(GlassFault::NoAttenuation));
}

#[test]
fn wrong_reflectance_is_found() {
    let (brewster, value) = (1.5f64.atan().to_degrees(), expected("O06"));
    let right = reflectance(GlassFault::None, brewster, 1_450_000);
    accept("right glass, Fresnel", value, Demand::Mean, &right);
    let normal = reflectance(GlassFault::NormalReflectance, brewster, 900_000);
    refuse("R of normal incidence", value, Demand::Mean, &normal);
    let squared = reflectance(GlassFault::SquaredReflectance, 0.0, 200_000);
    refuse("R squared", expected("O05"), Demand::Mean, &squared);
}

#[test]
fn a_furnace_cannot_tell_wrong_glass_apart_and_its_inside_can() {
    let inside = |fault| {
        let world = world([dome(), ball([0.0; 3], 1.0, Glass::new(0.0, 1.0, fault))]);
        let outer = Probe::new(1000).along(&world, [0.6, 0.0, -5.0], [0.0, 0.0, 1.0]);
        assert_eq!(check(1.0, Demand::Exact, &outer), Ok(()), "{fault:?}");
        Probe::new(1000).along(&world, [0.0; 3], [0.1, 0.2, 1.0])
    };
    accept("right glass, inside", expected("X03"), Demand::Exact, &inside(GlassFault::None));
    refuse("no n², inside", expected("X03"), Demand::Exact, &inside(GlassFault::NoSquaredIndex));
}

#[test]
fn too_few_paths_are_no_verdict() {
    let world = world([plate(Lambert::new(0.7)), ball_lamp(0.5, 2.0, 50.0)]);
    let reading = Probe::new(1000).light(Off).along(&world, EYE, VIEW);
    assert!(matches!(check(tilted_plate_value(), Demand::Mean, &reading), Err(Rejection::Noisy(_))));
}
