//! Prisms at minimum deviation.

use raysect::prelude::*;

use super::Case;
use super::beacon::{Beacon, angle};
use super::measure::sample;
use super::reading::Reading;
use super::scenes::{Bench, ball, world, wrong};

pub(super) fn measure(case: &Case, bench: Bench) -> Option<Result<Reading, String>> {
    Some(match case.kind.as_str() {
        "prism_deviation" => deviation(case, bench),
        "prism_bin_mean" => bin_mean(case, bench),
        "prism_bin_rms" => bin_spread(case, bench),
        _ => return None,
    })
}

/// A function of a deviation [deg].
type Read = Box<dyn Fn(f64) -> f64 + Send + Sync>;

/// A prism whose apex points along y, and the ray that meets its left face so that light of an index crosses it
/// parallel to its base.
struct Prism {
    shape: Mesh,
    origin: Point3D,
    direction: Vector3D,
}

impl Prism {
    fn new(apex: f64, index: f64) -> Result<Self, String> {
        let half = 0.5 * apex.to_radians();
        let (x, z) = (half.tan(), 5.0);
        let corner = |x: f64, y: f64, z: f64| Point3D::new(x, y, z);
        let corners = [
            corner(-x, 0.0, -z),
            corner(x, 0.0, -z),
            corner(0.0, 1.0, -z),
            corner(-x, 0.0, z),
            corner(x, 0.0, z),
            corner(0.0, 1.0, z),
        ];
        let faces = [[0, 2, 1], [3, 4, 5], [0, 1, 4], [0, 4, 3], [1, 2, 5], [1, 5, 4], [2, 0, 3], [2, 3, 5]];
        let shape = Mesh::new(MeshData::new(corners, faces).map_err(wrong)?).map_err(wrong)?;
        let incidence = (index * half.sin()).asin();
        if incidence.is_nan() {
            return Err(format!("light of index {index} does not cross a prism of {apex} deg"));
        }
        let slope = incidence - half;
        let direction = Vector3D::new(slope.cos(), slope.sin(), 0.0);
        // The middle of the left face.
        let origin = Point3D::new(-0.5 * x, 0.5, 0.1) - direction * 3.0;
        Ok(Self { shape, origin, direction })
    }

    /// A world in which a path along the ray reads a function of its deviation [deg].
    fn world(&self, glass: Dielectric, read: Read) -> Result<World, String> {
        let before = self.direction;
        let beacon = Beacon(move |_, after| read(angle(before, after)));
        world([self.shape.clone().material(glass.transmission_only(true)), ball([0.0; 3], 60.0, beacon)?])
    }
}

fn glass(index: Sellmeier) -> Result<Dielectric, String> {
    Dielectric::new(index, 1.0).map_err(wrong)
}

fn deviation(case: &Case, bench: Bench) -> Result<Reading, String> {
    let index = Sellmeier::new(case.numbers("B")?, case.numbers("C")?).map_err(wrong)?;
    let wavelength = case.number("wavelength_nm")?;
    let prism = Prism::new(case.number("apex_deg")?, index.evaluate(wavelength))?;
    let scene = prism.world(glass(index)?, Box::new(|angle| angle))?;
    let ray = Ray::new(prism.origin, prism.direction).spectrum(wavelength - 1e-7, wavelength + 1e-7, 1);
    sample(bench, &scene, &ray)
}

/// The prism, its glass and the ray through the bin of a case.
fn bin(case: &Case) -> Result<(Prism, Sellmeier, Ray), String> {
    let (b, c) = (case.numbers("sellmeier_B")?, case.numbers("sellmeier_C_um2")?);
    let index = Sellmeier::new(b, c).map_err(wrong)?;
    let tuned = index.evaluate(case.number("minimum_deviation_at_nm")?);
    let prism = Prism::new(case.number("apex_deg")?, tuned)?;
    if case.number_or("bins", 1.0)? != 1.0 {
        return Err("bins: only one is understood".to_owned());
    }
    let ray = Ray::new(prism.origin, prism.direction);
    let ray = ray.spectrum(case.number("min_nm")?, case.number("max_nm")?, 1);
    Ok((prism, index, ray))
}

fn bin_mean(case: &Case, bench: Bench) -> Result<Reading, String> {
    let (prism, index, ray) = bin(case)?;
    sample(bench, &prism.world(glass(index)?, Box::new(|angle| angle))?, &ray.seed(bench.seed))
}

/// The spread of the deviations of single paths, each of which has a wavelength of its own: the root of their mean
/// square about a value near their mean.
fn bin_spread(case: &Case, bench: Bench) -> Result<Reading, String> {
    let (prism, index, ray) = bin(case)?;
    let scene = |read: Read| Ok::<_, String>((prism.world(glass(index)?, read)?, ray.clone()));
    let (plain, ray) = scene(Box::new(|angle| angle))?;
    let middle = ray.sample(&plain, 1000).map_err(wrong)?.mean.samples()[0];
    let (squares, ray) = scene(Box::new(move |angle| (angle - middle).powi(2)))?;
    let (offsets, _) = scene(Box::new(move |angle| angle - middle))?;
    let square = sample(bench, &squares, &ray)?;
    let offset = ray.seed(bench.seed).sample(&offsets, 100_000).map_err(wrong)?.mean.samples()[0];
    let spread = (square.mean - offset * offset).sqrt();
    Ok(Reading::of(spread, 0.5 * square.error / spread))
}
