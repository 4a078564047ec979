//! Sums, blends and tilted normals: unbiased, whatever part a path follows and however it looks for light.

use std::sync::Arc;

use raysect::math::Statistics;
use raysect::optical::{
    AbsorbingSurface, Add, Blend, Context, Facts, Lambert, LightSampling, Material, Path,
    PerfectReflectingSurface, RoughConductor, Roughen, Scatter, SurfaceHit, UnitySurfaceEmitter,
};

use crate::check::{Demand, EVERY, Probe, Reading, accept, agree, expected, refuse};
use crate::scenes::{EYE, VIEW, ball, ball_lamp, dome, lamp, plate, world};

type Shared = Arc<dyn Material>;

fn matt(reflectivity: f64) -> Shared {
    Arc::new(Lambert::new(reflectivity))
}

fn mirror() -> Shared {
    Arc::new(PerfectReflectingSurface)
}

fn metal() -> Shared {
    Arc::new(RoughConductor::new(0.9, 2.0, 0.4).unwrap())
}

fn blend(first: Shared, second: Shared, ratio: f64) -> Shared {
    Arc::new(Blend::new(first, second, ratio).unwrap())
}

fn furnace(material: Shared, sampling: LightSampling) -> Reading {
    let world = world([dome(), ball([0.0; 3], 1.0, material)]);
    Probe::new(100_000).seed(81).light(sampling).along(&world, [0.3, 0.1, -5.0], [0.0, 0.0, 1.0])
}

#[test]
fn a_furnace_reads_the_sum_and_the_mean_of_reflectivities() {
    for sampling in EVERY {
        let mixed = blend(matt(0.8), blend(matt(0.4), mirror(), 0.5), 0.25);
        accept(format!("blend {sampling:?}"), 0.775, Demand::Mean, &furnace(mixed, sampling));
        let sum = Arc::new(Add::new(matt(0.5), matt(0.3)));
        accept(format!("sum {sampling:?}"), 0.8, Demand::Mean, &furnace(sum, sampling));
    }
}

#[test]
fn r08_the_sum_of_a_matt_and_a_shining_surface_is_a_glowing_room() {
    let glowing: Shared = Arc::new(Add::new(matt(0.9), Arc::new(UnitySurfaceEmitter::new().importance(1.0))));
    let room = world([ball([0.0; 3], 1.0, glowing)]);
    let reading = Probe::new(1000).without_roulette().along(&room, [0.1, 0.2, 0.3], [0.3, 0.1, 1.0]);
    accept("R08 as a sum", expected("R08"), Demand::Exact, &reading);
}

/// What a plate under a lamp ball reads.
fn lit(material: Shared, sampling: LightSampling, count: u64) -> Reading {
    let world = world([plate(material), ball_lamp(0.8, 2.0, 30.0)]);
    Probe::new(count).seed(82).light(sampling).along(&world, EYE, VIEW)
}

/// The weighted sum of two readings.
fn together(a: &Reading, x: f64, b: &Reading, y: f64) -> (f64, f64) {
    let (a, b): (Statistics, Statistics) = (a.radiance, b.radiance);
    (x * a.mean() + y * b.mean(), (x * a.error()).hypot(y * b.error()))
}

#[track_caller]
fn same(case: String, reading: &Reading, (mean, error): (f64, f64)) {
    let (own, uncertain) = (reading.radiance.mean(), reading.radiance.error());
    let z = (own - mean) / uncertain.hypot(error);
    println!("{case:<44} {own} ± {uncertain:.1e} and {mean} ± {error:.1e}: z {z:+.2}");
    assert!(uncertain < 0.005 * own && error < 0.005 * mean, "{case}: too noisy");
    assert!(z.abs() < 4.0, "{case}: {z} standard errors");
}

#[test]
fn sums_and_blends_are_what_separate_pictures_are_together() {
    for sampling in EVERY {
        let count = match sampling {
            LightSampling::Lights => 40_000,
            LightSampling::BoundingSpheres => 100_000,
            LightSampling::Off => 250_000,
        };
        let (one, two) = (lit(matt(0.7), sampling, count), lit(metal(), sampling, count));
        let mixed = lit(blend(matt(0.7), metal(), 0.3), sampling, 2 * count);
        same(format!("blend {sampling:?}"), &mixed, together(&one, 0.7, &two, 0.3));
        let sum = lit(Arc::new(Add::new(matt(0.7), metal())), sampling, 2 * count);
        same(format!("sum {sampling:?}"), &sum, together(&one, 1.0, &two, 1.0));
        let nested = Arc::new(Add::new(metal(), blend(Arc::new(AbsorbingSurface), matt(0.7), 0.4)));
        same(
            format!("nested {sampling:?}"),
            &lit(nested, sampling, 2 * count),
            together(&one, 0.4, &two, 1.0),
        );
    }
}

#[test]
fn a_blend_with_a_lamp_lights_as_its_share_of_it() {
    for sampling in [LightSampling::Lights, LightSampling::BoundingSpheres] {
        let shining = blend(Arc::new(lamp()), Arc::new(AbsorbingSurface), 0.25);
        let world = world([plate(Lambert::new(0.7)), ball([0.0, 0.0, 3.0], 1.0, shining)]);
        let reading = Probe::new(60_000).seed(83).light(sampling).aim(0.8).along(&world, EYE, VIEW);
        accept(format!("a lamp at three quarters {sampling:?}"), 0.75 * 0.7 / 9.0, Demand::Mean, &reading);
    }
}

#[test]
fn every_search_for_light_reads_the_same_off_a_roughened_surface() {
    let rough = || -> Shared { Arc::new(Roughen::new(matt(0.7), 0.4).unwrap()) };
    let off = lit(rough(), LightSampling::Off, 200_000);
    for sampling in [LightSampling::Lights, LightSampling::BoundingSpheres] {
        agree(format!("roughened {sampling:?} and Off"), &lit(rough(), sampling, 100_000), &off);
    }
    let none: Shared = Arc::new(Roughen::new(matt(0.7), 0.0).unwrap());
    agree(
        "not roughened",
        &lit(none, LightSampling::Lights, 50_000),
        &lit(matt(0.7), LightSampling::Lights, 50_000),
    );
}

/// A sum that forgets the weight of the part it follows.
struct HalfSum(Shared, Shared);

impl Material for HalfSum {
    fn emit(&self, hit: &SurfaceHit, at: Context<'_>, out: &mut [f64]) -> bool {
        self.0.emit(hit, at, out)
    }
    fn surface(&self, hit: &SurfaceHit, path: &mut Path<'_>) -> Scatter {
        let first = path.rng().probability(0.5);
        if first { self.0.surface(hit, path) } else { self.1.surface(hit, path) }
    }
    fn facts(&self) -> Facts {
        self.0.facts()
    }
}

/// A blend that follows parts by one share and weighs them by another.
struct WrongBlend(Shared, Shared);

impl Material for WrongBlend {
    fn surface(&self, hit: &SurfaceHit, path: &mut Path<'_>) -> Scatter {
        let first = path.rng().probability(0.27);
        if first { self.0.surface(hit, path) } else { self.1.surface(hit, path) }
    }
}

#[test]
fn wrong_sums_and_blends_are_found() {
    for sampling in EVERY {
        let half = furnace(Arc::new(HalfSum(matt(0.5), matt(0.3))), sampling);
        refuse(format!("sum without weight {sampling:?}"), 0.8, Demand::Mean, &half);
        let wrong = furnace(Arc::new(WrongBlend(matt(0.4), matt(0.8))), sampling);
        refuse(format!("wrong share {sampling:?}"), 0.7, Demand::Mean, &wrong);
    }
}
