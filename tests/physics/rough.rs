//! Rough metal and glass in closed enclosures and under lamps.

use raysect::core::{Node, Ray};
use raysect::math::{Point3D, Rng, Vector3D};
use raysect::optical::{
    Bsdf, Conductor, Context, Dielectric, Lambert, LightSampling, Material, Optics, Path, RoughConductor,
    RoughDielectric, Scatter, SurfaceHit, UniformSurfaceEmitter, WithMaterial,
};

use crate::check::{Demand, EVERY, Probe, Reading, accept, agree, expected, refuse};
use crate::scenes::{ball, ball_lamp, cuboid, dome, plate, tilted, times, world};

/// Albedos of a lossless surface by quadrature: roughness, angle [deg], share that is scattered once.
const LOSSLESS: [(f64, f64, f64); 3] = [
    (0.1, 0.0, 0.988_298_921_906_500_8),
    (0.3, 70.0, 0.806_167_117_088_083_2),
    (0.6, 45.0, 0.602_148_765_766_418_7),
];

fn lossless(roughness: f64) -> RoughConductor {
    RoughConductor::new(0.0, 1.0, roughness).unwrap()
}

/// What a plate in the furnace reads at an angle [deg].
fn furnace(material: impl Material, degrees: f64, sampling: LightSampling, count: u64) -> Reading {
    let [x, y, z] = tilted(degrees);
    let world = world([dome(), plate(material)]);
    Probe::new(count).seed(71).light(sampling).along(&world, times([x, y, z], 2.0), [-x, -y, -z])
}

#[test]
fn r07_lossless_rough_metal_in_a_furnace_reads_its_albedo() {
    for sampling in EVERY {
        for (roughness, degrees, albedo) in LOSSLESS {
            let reading = furnace(lossless(roughness), degrees, sampling, 70_000);
            accept(format!("R07 {roughness} {degrees} {sampling:?}"), albedo, Demand::Mean, &reading);
        }
    }
}

/// Rough metal with a mistake.
#[derive(Clone, Copy, Debug)]
enum Fault {
    None,
    NoMasking,
    Density,
    NoCosine,
}

struct Mutant(RoughConductor, Fault);

impl Bsdf for Mutant {
    fn sample(&self, incoming: Vector3D, at: Context<'_>, rng: &mut Rng) -> Vector3D {
        self.0.sample(incoming, at, rng)
    }
    fn pdf(&self, incoming: Vector3D, outgoing: Vector3D, at: Context<'_>) -> f64 {
        let right = self.0.pdf(incoming, outgoing, at);
        if matches!(self.1, Fault::Density) { right * 1.02 } else { right }
    }
    fn evaluate(&self, incoming: Vector3D, outgoing: Vector3D, at: Context<'_>, out: &mut [f64]) {
        self.0.evaluate(incoming, outgoing, at, out);
        let masking = |v: Vector3D| {
            let tangent = self.0.roughness() * v.x.hypot(v.y) / v.z;
            2.0 / (1.0 + (1.0 + tangent * tangent).sqrt())
        };
        let factor = match self.1 {
            Fault::NoMasking => 1.0 / masking(outgoing),
            Fault::NoCosine => 1.0 / outgoing.z.max(0.05),
            Fault::None | Fault::Density => 1.0,
        };
        out.iter_mut().filter(|f| **f > 0.0).for_each(|f| *f *= factor);
    }
}

impl Material for Mutant {
    fn surface(&self, hit: &SurfaceHit, path: &mut Path<'_>) -> Scatter {
        path.scatter(self, hit)
    }
}

#[test]
fn wrong_rough_metal_is_found_in_the_furnace() {
    let (roughness, degrees, albedo) = LOSSLESS[1];
    let reading = |fault, sampling| furnace(Mutant(lossless(roughness), fault), degrees, sampling, 60_000);
    for sampling in [LightSampling::BoundingSpheres, LightSampling::Off] {
        accept("right rough metal", albedo, Demand::Mean, &reading(Fault::None, sampling));
        for fault in [Fault::NoMasking, Fault::Density, Fault::NoCosine] {
            let found = reading(fault, sampling);
            refuse(format!("{fault:?} {sampling:?}"), albedo, Demand::Mean, &found);
        }
    }
}

/// A block of rough glass filled by a lamp whose radiance in glass is that of the furnace outside.
fn ground_block(roughness: f64) -> [Node<Optics>; 2] {
    let glass = RoughDielectric::new(1.5, 1.0, roughness).unwrap();
    let core = cuboid([-0.999, -0.999, -0.9], [0.999, 0.999, -1e-4]);
    [
        cuboid([-1.0, -1.0, -1.0], [1.0, 1.0, 0.0]).material(glass),
        core.material(UniformSurfaceEmitter::new(2.25, 1.0)),
    ]
}

#[test]
fn rough_glass_between_furnaces_reads_its_albedo_from_both_sides() {
    for sampling in EVERY {
        for (roughness, degrees, albedo) in [(0.1, 0.0, 0.998_836), (0.3, 70.0, 0.917_636)] {
            let world = world([dome()].into_iter().chain(ground_block(roughness)));
            let [x, y, z] = tilted(degrees);
            let probe = Probe::new(60_000).seed(72).light(sampling);
            let reading = probe.along(&world, times([x, y, z], 2.0), [-x, -y, -z]);
            accept(format!("into rough glass {roughness} {sampling:?}"), albedo, Demand::Mean, &reading);
        }
        for (roughness, degrees, albedo) in [(0.3, 30.0, 0.870_057), (0.5, 60.0, 0.642_701)] {
            let world = world([dome()].into_iter().chain(ground_block(roughness)));
            let [x, _, z] = tilted(degrees);
            let probe = Probe::new(60_000).seed(73).light(sampling);
            let reading = probe.along(&world, [0.0, 0.0, -5e-5], [x, 0.0, z]);
            let value = 2.25 * albedo;
            accept(format!("out of rough glass {roughness} {sampling:?}"), value, Demand::Mean, &reading);
        }
    }
}

#[test]
fn nearly_smooth_rough_surfaces_are_smooth_ones() {
    let glass = RoughDielectric::new(1.5, 0.5, 1e-5).unwrap();
    let furnace = world([dome(), ball([0.0; 3], 1.0, glass)]);
    for (id, impact) in [("R04a", 0.0), ("R04b", 0.6)] {
        let reading = Probe::new(120_000).seed(4).along(&furnace, [impact, 0.0, -5.0], [0.0, 0.0, 1.0]);
        accept(format!("{id} rough"), expected(id), Demand::Mean, &reading);
    }
    let centre = |rng: &mut Rng| {
        let u = raysect::math::sampling::uniforms(rng);
        Ray::new(Point3D::ORIGIN, raysect::math::sampling::sphere::sample(u))
    };
    let clear = world([dome(), ball([0.0; 3], 1.0, RoughDielectric::new(1.5, 1.0, 1e-5).unwrap())]);
    let reading = Probe::new(30_000).seed(5).each(&clear, centre);
    accept("X03 rough", expected("X03"), Demand::Mean, &reading);
    for degrees in [0.0, 60.0, 85.0] {
        let smooth = furnace_value(Conductor::new(0.2, 3.3), degrees);
        let rough = furnace_value(RoughConductor::new(0.2, 3.3, 1e-5).unwrap(), degrees);
        assert!((smooth - rough).abs() < 1e-4 * smooth, "{degrees}: {smooth} {rough}");
        let rougher = furnace_value(RoughConductor::new(0.2, 3.3, 0.3).unwrap(), degrees);
        assert!((smooth - rougher).abs() > 1e-2 * smooth, "{degrees}: {smooth} {rougher}");
    }
}

fn furnace_value(material: impl Material, degrees: f64) -> f64 {
    furnace(material, degrees, LightSampling::Off, 10_000).radiance.mean()
}

#[test]
fn rough_glass_of_the_index_around_it_is_not_there() {
    let world = world([dome(), ball([0.0; 3], 1.0, RoughDielectric::new(1.0, 1.0, 0.4).unwrap())]);
    let reading = Probe::new(1000).along(&world, [0.3, 0.0, -5.0], [0.0, 0.0, 1.0]);
    accept("index 1", 1.0, Demand::Exact, &reading);
}

#[test]
fn every_search_for_light_reads_the_same_off_rough_surfaces() {
    let metal = || RoughConductor::new(0.9, 2.0, 0.3).unwrap();
    let look = |material: RoughConductor, sampling| {
        let world = world([plate(material), ball_lamp(0.5, 2.0, 35.0)]);
        let [x, y, z] = tilted(-40.0);
        Probe::new(120_000).seed(74).light(sampling).along(&world, times([x, y, z], 3.0), [-x, -y, -z])
    };
    let off = look(metal(), LightSampling::Off);
    for sampling in [LightSampling::Lights, LightSampling::BoundingSpheres] {
        agree(format!("rough metal {sampling:?} and Off"), &look(metal(), sampling), &off);
    }
}

/// A lamp behind a pane of rough glass on a matt plate below, seen through the pane: light is found through rough
/// surfaces from inside, and by chance from outside.
#[test]
fn every_search_for_light_reads_the_same_through_rough_glass() {
    let look = |sampling| {
        let pane = cuboid([-3.0, -3.0, 0.4], [3.0, 3.0, 0.5]);
        let glass = RoughDielectric::new(1.5, 0.2, 0.4).unwrap();
        let world = world([
            plate(Lambert::new(0.7)),
            pane.material(glass),
            ball([0.0, 0.0, 3.0], 1.0, crate::scenes::lamp()),
        ]);
        let probe = Probe::new(250_000).seed(75).light(sampling).without_roulette();
        probe.along(&world, [1.5, 0.3, 2.0], [-1.5, -0.3, -2.0])
    };
    let off = look(LightSampling::Off);
    for sampling in [LightSampling::Lights, LightSampling::BoundingSpheres] {
        agree(format!("through rough glass {sampling:?} and Off"), &look(sampling), &off);
    }
}

/// A lamp in water under rough glass that lies on it: where the two touch there is one interface, for rays towards
/// the lamp as for paths.
#[test]
fn every_search_for_light_reads_the_same_where_rough_glass_touches_water() {
    let look = |sampling| {
        let glass = cuboid([-3.0, -3.0, -0.5], [3.0, 3.0, 0.0]);
        let water = cuboid([-2.9, -2.9, -2.5], [2.9, 2.9, -0.5]);
        let world = world([
            glass.material(RoughDielectric::new(1.5, 1.0, 0.4).unwrap()),
            water.material(Dielectric::new(1.33, 1.0).unwrap().importance(0.0)),
            ball([0.0, 0.0, -1.5], 0.5, crate::scenes::lamp()),
        ]);
        Probe::new(150_000).seed(76).light(sampling).along(&world, [0.3, 0.2, 1.0], [0.0, 0.0, -1.0])
    };
    let off = look(LightSampling::Off);
    for sampling in [LightSampling::Lights, LightSampling::BoundingSpheres] {
        agree(format!("rough glass on water {sampling:?} and Off"), &look(sampling), &off);
    }
}
