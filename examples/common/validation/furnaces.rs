//! Enclosures of uniform radiance, and what stands in them.

use raysect::math::Rng;
use raysect::optical::{Facts, PathSettings};
use raysect::prelude::*;

use super::measure::{along, with_settings};
use super::scenes::{Bench, ball, cuboid, dome, lamp, tilted, times, world, wrong};
use super::{Case, Reading};

pub(super) fn measure(case: &Case, bench: Bench) -> Option<Result<Reading, String>> {
    Some(match case.kind.as_str() {
        "furnace_lambert" => lambert(case, bench),
        "furnace_closed" => closed(case, bench),
        "furnace_glass" => glass(case, bench),
        "furnace_glass_b" => glass_at(case, bench),
        "furnace_conductor" => conductor(case, bench),
        "furnace_ggx" => rough_mirror(case, bench),
        "closed_diffuse_emitter" => glowing_room(case, bench),
        "integrating_sphere_port" => integrating_sphere(case, bench),
        _ => return None,
    })
}

/// Where rays come from that meet a ball of radius 1 about the origin.
const OUTSIDE: f64 = -5.0;

/// Random impact parameters up to nearly the radius, and the worst reading of them.
fn anywhere(bench: Bench, scene: &World, expected: f64) -> Result<Reading, String> {
    let mut rng = Rng::new(bench.seed);
    let mut worst = along(bench, scene, [0.0, 0.0, OUTSIDE], [0.0, 0.0, 1.0])?;
    for _ in 0..20 {
        let (x, y) = (rng.range(-0.7, 0.7), rng.range(-0.7, 0.7));
        let found = along(bench, scene, [x, y, OUTSIDE], [0.0, 0.0, 1.0])?;
        let off = |r: &Reading| (r.mean - expected).abs() + r.error;
        if off(&found) > off(&worst) || found.mean.is_nan() {
            worst = found;
        }
    }
    Ok(worst)
}

fn lambert(case: &Case, bench: Bench) -> Result<Reading, String> {
    let sphere = ball([0.0; 3], 1.0, bench.lambert(case.number("rho")?))?;
    anywhere(bench, &world([dome(1.0)?, sphere])?, case.expected)
}

fn closed(case: &Case, bench: Bench) -> Result<Reading, String> {
    let radius = case.number("radius")?;
    let scene = world([ball([0.0; 3], radius, lamp())?])?;
    let mut rng = Rng::new(bench.seed);
    let mut worst = Reading::exact(1.0);
    for _ in 0..100 {
        let origin = [0; 3].map(|_| rng.range(-0.57, 0.57) * radius);
        let direction = [0; 3].map(|_| rng.range(-1.0, 1.0));
        let found = along(bench, &scene, origin, direction)?;
        if (found.mean - 1.0).abs() + found.error >= (worst.mean - 1.0).abs() + worst.error {
            worst = found;
        }
    }
    Ok(worst)
}

fn glass(case: &Case, bench: Bench) -> Result<Reading, String> {
    let material = bench.glass(case.number("n")?, case.number_or("trans", 1.0)?)?;
    anywhere(bench, &world([dome(1.0)?, ball([0.0; 3], 1.0, material)?])?, case.expected)
}

fn glass_at(case: &Case, bench: Bench) -> Result<Reading, String> {
    let radius = case.number("radius")?;
    let material = bench.glass(case.number("n")?, case.number("trans")?)?;
    let scene = world([dome(radius)?, ball([0.0; 3], radius, material)?])?;
    along(bench, &scene, [case.number("b")?, 0.0, OUTSIDE * radius], [0.0, 0.0, 1.0])
}

/// A ray that meets a ball of radius 1 at an angle of incidence.
fn at_an_angle(case: &Case, bench: Bench, material: impl Material) -> Result<Reading, String> {
    let scene = world([dome(1.0)?, cuboid([-9.0, -9.0, -1.0], [9.0, 9.0, 0.0])?.material(material)])?;
    let direction = tilted(case.number("deg")?);
    along(bench, &scene, times(direction, 5.0), times(direction, -1.0))
}

fn conductor(case: &Case, bench: Bench) -> Result<Reading, String> {
    at_an_angle(case, bench, Conductor::new(case.number("n")?, case.number("k")?))
}

fn rough_mirror(case: &Case, bench: Bench) -> Result<Reading, String> {
    let masking = match case.text("masking")?.as_str() {
        "separable" => Masking::Separable,
        "height_correlated" => Masking::HeightCorrelated,
        other => return Err(format!("masking: nothing is known as '{other}'")),
    };
    let mirror = RoughConductor::new(0.0, 1.0, case.number("alpha")?).map_err(wrong)?;
    at_an_angle(case, bench, mirror.masking(masking))
}

/// A Lambert surface that emits a radiance of one as well.
struct Glowing<M>(M);

impl<M: Material> Material for Glowing<M> {
    fn emit(&self, _: &SurfaceHit, _: Context<'_>, out: &mut [f64]) -> bool {
        out.fill(1.0);
        true
    }
    fn surface(&self, hit: &SurfaceHit, path: &mut Path<'_>) -> Scatter {
        self.0.surface(hit, path)
    }
    fn facts(&self) -> Facts {
        Facts { emits: true, importance: 1.0, ..Facts::named("glowing") }
    }
}

fn glowing_room(case: &Case, bench: Bench) -> Result<Reading, String> {
    let reflectivity = case.number("rho")?;
    let scene = world([ball([0.0; 3], 1.0, Glowing(bench.lambert(reflectivity)))?])?;
    // Without roulette nothing is left to chance; after so many reflections nothing is left of the light.
    let depth = (1e-14f64.ln() / reflectivity.ln()).ceil() as u32;
    let settings = PathSettings::default().roulette_threshold(0.0).map_err(wrong)?.max_depth(depth.max(1));
    with_settings(bench, &scene, [0.1, 0.2, 0.3], [0.3, -0.2, 0.5], settings)
}

fn integrating_sphere(case: &Case, bench: Bench) -> Result<Reading, String> {
    let height = case.number("h")?;
    let port = cuboid([-1.1, -1.1, height], [1.1, 1.1, 1.1])?.material(lamp());
    let scene = world([ball([0.0; 3], 1.0, bench.lambert(case.number("rho")?))?, port])?;
    // From below the port, however deep it lies.
    let below = 0.5 * (height - 1.0);
    let off = 0.1 * (1.0 - below * below).max(0.0).sqrt();
    along(bench, &scene, [off, 0.4 * off, below], [0.2, -0.1, -1.0])
}
