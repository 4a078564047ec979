//! Integrals along lines of sight through what glows and absorbs.

use raysect::core::Node;
use raysect::optical::{Coefficients, Medium, MediumPoint, Optics, Refraction};
use raysect::prelude::*;

use super::measure::along;
use super::scenes::{Bench, ball, cuboid, lamp, world, wrong};
use super::{Case, Reading};

pub(super) fn measure(case: &Case, bench: Bench) -> Option<Result<Reading, String>> {
    Some(match case.kind.as_str() {
        "chord_uniform_sphere" => sphere(case, bench),
        "chord_uniform_cylinder" => cylinder(case, bench),
        "gauss_sphere" => gaussian(case, bench),
        "volume_overlap" => overlap(case, bench),
        "glass_emission_sphere" => glowing_glass(case, bench),
        "beer_lambert" => beer(case, bench),
        _ => return None,
    })
}

fn sphere(case: &Case, bench: Bench) -> Result<Reading, String> {
    let radius = case.number("R")?;
    let scene = world([ball([0.0; 3], radius, UniformVolume::emitter(1.0))?])?;
    along(bench, &scene, [case.number("b")?, 0.0, -3.0 * radius], [0.0, 0.0, 1.0])
}

fn cylinder(case: &Case, bench: Bench) -> Result<Reading, String> {
    let (radius, angle) = (case.number("r")?, case.number("phi_deg")?.to_radians());
    let length = 20.0 * radius / angle.tan().abs().min(1.0);
    let shape = Cylinder::new(radius, length).map_err(wrong)?;
    let place = translate(0.0, 0.0, -0.5 * length);
    let scene = world([shape.material(UniformVolume::emitter(1.0)).transform(place)])?;
    let direction = [angle.sin(), 0.0, angle.cos()];
    let [x, _, z] = direction.map(|d| -3.0 * radius / angle.sin() * d);
    along(bench, &scene, [x, case.number("b")?, z], direction)
}

fn gaussian(case: &Case, bench: Bench) -> Result<Reading, String> {
    let (radius, sigma) = (case.number("R")?, case.number("sigma")?);
    let profile = move |p: Point3D, _: Vector3D, _: Context<'_>, bins: &mut [f64]| {
        let squared = p.to_vector().length_squared() / (sigma * sigma);
        bins.iter_mut().for_each(|b| *b += (-0.5 * squared).exp());
    };
    let emitter = InhomogeneousVolumeEmitter::length_scale(sigma, profile).map_err(wrong)?;
    let scene = world([ball([0.0; 3], radius, emitter)?])?;
    along(bench, &scene, [case.number("b")?, 0.0, -3.0 * radius], [0.0, 0.0, 1.0])
}

fn slab([from, to]: [f64; 2], volume: UniformVolume) -> Result<Node<Optics>, String> {
    Ok(cuboid([from, -9.0, -9.0], [to, 9.0, 9.0])?.material(volume))
}

/// Both orders of creation must read the same.
fn overlap(case: &Case, bench: Bench) -> Result<Reading, String> {
    let (emitter, absorber) = (case.numbers("emitter")?, case.numbers("absorber")?);
    let absorption = -case.number("transmission_per_m")?.ln();
    let side = match case.text("viewer_side")?.as_str() {
        "+x" => 1.0,
        "-x" => -1.0,
        other => return Err(format!("viewer_side: no side is known as '{other}'")),
    };
    let read = |absorber_first: bool| {
        let glow = slab(emitter, UniformVolume::emitter(1.0))?;
        let dim = slab(absorber, UniformVolume::new().absorption(absorption))?;
        let scene = world(if absorber_first { [dim, glow] } else { [glow, dim] })?;
        along(bench, &scene, [side * 1e3, 0.1, 0.2], [-side, 0.0, 0.0])
    };
    let (first, second) = (read(false)?, read(true)?);
    let same = (first.mean - second.mean).abs() <= case.tolerance * case.expected.abs();
    if same { Ok(first) } else { Err(format!("{} and {}, by order of creation", first.mean, second.mean)) }
}

/// Glass whose volume glows.
struct GlowingGlass(Dielectric);

impl Material for GlowingGlass {
    fn surface(&self, hit: &SurfaceHit, path: &mut Path<'_>) -> Scatter {
        self.0.surface(hit, path)
    }
    fn medium(&self) -> Option<&dyn Medium> {
        Some(self)
    }
}

impl Medium for GlowingGlass {
    fn refraction(&self) -> Option<&Refraction> {
        self.0.refraction()
    }
    fn coefficients(&self, _: &MediumPoint<'_>, out: &mut Coefficients<'_>) {
        out.emission.iter_mut().for_each(|e| *e += 1.0);
    }
}

fn glowing_glass(case: &Case, bench: Bench) -> Result<Reading, String> {
    let radius = case.number("radius")?;
    let glass = GlowingGlass(Dielectric::new(case.number("n")?, 1.0).map_err(wrong)?);
    let scene = world([ball([0.0; 3], radius, glass)?])?;
    along(bench, &scene, [case.number("b")?, 0.0, -5.0 * radius], [0.0, 0.0, 1.0])
}

fn beer(case: &Case, bench: Bench) -> Result<Reading, String> {
    let length = case.number("length")?;
    let glass = bench.glass(1.0, case.number("trans")?)?;
    let slab = cuboid([-9.0, -9.0, 0.0], [9.0, 9.0, length])?.material(glass);
    let behind = cuboid([-9.0, -9.0, length + 1.0], [9.0, 9.0, length + 2.0])?.material(lamp());
    along(bench, &world([slab, behind])?, [0.1, 0.2, -1.0], [0.0, 0.0, 1.0])
}
