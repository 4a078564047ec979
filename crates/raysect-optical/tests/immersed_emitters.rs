//! Emitters in media: they are told the index of the medium that they stand in, whoever looks for them and from where.

use raysect_core::{Node, Ray};
use raysect_math::{Point3D, Rng, Statistics, StreamKey, Vector3D, translate};
use raysect_optical::{
    Add, Context, Dielectric, Facts, HenyeyGreenstein, Lambert, LightSampling, Material, NullMaterial,
    Optics, Path, PathSettings, RoughDielectric, Scatter, Slicing, SurfaceHit, UniformSurfaceEmitter,
    UniformVolume, WithMaterial, World,
};
use raysect_primitive::{Cuboid, Sphere};
use std::sync::Arc;

/// A black body of radiance one in vacuum: in a medium it emits n² as much (Kirchhoff–Clausius).
struct BlackBody;

impl Material for BlackBody {
    fn emit(&self, _: &SurfaceHit, at: Context<'_>, out: &mut [f64]) -> bool {
        out.fill(at.index_in * at.index_in);
        true
    }
    fn surface(&self, _: &SurfaceHit, _: &mut Path<'_>) -> Scatter {
        Scatter::Absorbed
    }
    fn facts(&self) -> Facts {
        Facts { importance: 1.0, ..Facts::emitter("black body") }
    }
}

fn ball(centre: [f64; 3], radius: f64, material: impl Material) -> Node<Optics> {
    Sphere::new(radius).unwrap().material(material).transform(translate(centre[0], centre[1], centre[2]))
}

fn cuboid(lower: [f64; 3], upper: [f64; 3]) -> Cuboid {
    Cuboid::new(Point3D::from(lower), Point3D::from(upper)).unwrap()
}

fn world(nodes: impl IntoIterator<Item = Node<Optics>>) -> World {
    let mut world = World::new();
    for node in nodes {
        world.add(node).unwrap();
    }
    world
}

fn read(world: &World, from: [f64; 3], towards: [f64; 3], sampling: LightSampling, count: u64) -> Statistics {
    let slices = Slicing::new(500.0, 501.0, 1, 1).unwrap().slices();
    let settings = PathSettings::default().light_sampling(sampling);
    let mut path = Path::new(world.scene().unwrap(), &slices[0], &settings);
    let ray = Ray::new(Point3D::from(from), Vector3D::from(towards));
    let mut all = Statistics::new();
    for sample in 0..count {
        all.add(path.follow(&ray, Rng::keyed(StreamKey { seed: 9, sample, ..StreamKey::default() }))[0]);
    }
    assert_eq!(path.ledger().inconsistencies, 0);
    all
}

/// Asserts that lights read the same whether they are looked for or found by chance.
fn agree(case: &str, world: &World, from: [f64; 3], towards: [f64; 3], count: u64) -> f64 {
    let [found, chance] = [LightSampling::Lights, LightSampling::Off]
        .map(|sampling| read(world, from, towards, sampling, count));
    let z = (found.mean() - chance.mean()) / found.error().hypot(chance.error());
    println!("{case}: {found} and {chance}: z {z:+.2}");
    assert!(z.abs() < 4.0, "{case}: {found} and {chance} are {z:.1} standard errors apart");
    assert!(found.error().hypot(chance.error()) < 0.02 * chance.mean(), "{case}: {found} and {chance}");
    found.mean()
}

#[test]
fn radiance_leaves_a_medium_by_the_square_of_its_index() {
    let glass = || Dielectric::new(1.5, 1.0).unwrap().transmission_only(true);
    let block = || cuboid([-9.0, -9.0, 0.0], [9.0, 9.0, 9.0]).material(glass());
    let seen = |lamp: Node<Optics>| {
        read(&world([block(), lamp]), [0.0, 0.0, -5.0], [0.0, 0.0, 1.0], LightSampling::Lights, 3).mean()
    };
    let plain = seen(ball([0.0, 0.0, 4.0], 1.0, UniformSurfaceEmitter::new(1.0, 1.0)));
    let black = seen(ball([0.0, 0.0, 4.0], 1.0, BlackBody));
    assert!((plain * 2.25 - 1.0).abs() < 1e-14 && (black - 1.0).abs() < 1e-14, "{plain} {black}");
}

#[test]
fn a_plate_in_water_is_lit_by_a_lamp_in_water() {
    // What leaves the sea does not come back.
    let water = Dielectric::new(1.33, 1.0).unwrap().transmission_only(true).importance(0.0);
    let sea = || ball([0.0; 3], 90.0, water.clone());
    let plate = || cuboid([-9.0, -9.0, -1.0], [9.0, 9.0, 0.0]).material(Lambert::new(0.7));
    // Seen from the middle of the plate the ball covers (r/d)² of the cosine-weighted directions.
    let expected = 0.7 * 0.25 * 1.33 * 1.33;
    let scene = world([sea(), plate(), ball([0.0, 0.0, 2.0], 1.0, BlackBody)]);
    let found = agree("in water", &scene, [-0.01, 0.0, 0.004], [1.0, 0.0, -0.4], 200_000);
    assert!((found / expected - 1.0).abs() < 0.005, "{found} {expected}");
}

#[test]
fn lamps_on_both_sides_of_rough_glass() {
    let glass = || RoughDielectric::new(1.5, 0.9, 0.4).unwrap();
    let block = || cuboid([-9.0, -9.0, 0.0], [9.0, 9.0, 9.0]).material(glass());
    let inside = || ball([0.5, 0.0, 4.0], 2.0, BlackBody);
    let outside = || ball([2.0, 0.0, -3.0], 1.5, BlackBody);
    for (case, lamps) in
        [("inside", vec![inside()]), ("outside", vec![outside()]), ("both", vec![inside(), outside()])]
    {
        let scene = world([block()].into_iter().chain(lamps));
        agree(&format!("{case}, from outside"), &scene, [-4.0, 0.0, -4.0], [1.0, 0.0, 1.0], 200_000);
        agree(&format!("{case}, from inside"), &scene, [-2.0, 0.0, 2.0], [1.0, 0.0, -1.0], 200_000);
    }
}

#[test]
fn a_lamp_in_air_is_found_from_fog_behind_glass() {
    // The last surface that the path has met is that of the glass, which does not matter to the lamp.
    let block = cuboid([-9.0, -9.0, -9.0], [9.0, 9.0, 0.0]).material(Dielectric::new(1.5, 1.0).unwrap());
    let fog = UniformVolume::new().scattering(0.2, HenyeyGreenstein::isotropic());
    let scene = world([block, ball([0.0; 3], 8.0, fog), ball([0.0, 3.0, 3.0], 1.5, BlackBody)]);
    agree("fog", &scene, [0.0, 0.0, -0.2], [0.0, -0.1, 1.0], 200_000);
}

#[test]
fn a_lamp_behind_the_clear_surface_of_a_medium_is_told_of_it() {
    // Nothing but a transparent surface stands between plate and lamp; the medium behind it has no index of its own.
    let plate = cuboid([-9.0, -9.0, -1.0], [9.0, 9.0, 0.0]).material(Lambert::new(0.7));
    let scene =
        world([plate, ball([0.0, 0.0, 3.0], 2.0, NullMaterial), ball([0.0, 0.0, 3.0], 1.5, BlackBody)]);
    let found = agree("null", &scene, [-0.01, 0.0, 0.004], [1.0, 0.0, -0.4], 200_000);
    assert!((found / (0.7 * 0.25) - 1.0).abs() < 0.01, "{found}");
}

#[test]
fn glowing_glass_that_a_medium_hides_does_not_shine() {
    // The surface of the glowing glass stands where the water counts: no path meets it, and none must find it.
    let sea = || ball([0.0; 3], 90.0, Dielectric::new(1.33, 1.0).unwrap().priority(1));
    let plate = || cuboid([-9.0, -9.0, -1.0], [9.0, 9.0, 0.0]).material(Lambert::new(0.7));
    let glass = Arc::new(Dielectric::new(1.5, 1.0).unwrap().importance(0.0));
    let glowing =
        || Add::new(glass.clone(), Arc::new(UniformSurfaceEmitter::new(1.0, 1.0))).surface_only().unwrap();
    let lamp = || ball([3.0, 0.0, 2.0], 1.0, UniformSurfaceEmitter::new(1.0, 1.0));
    let seen = |hidden: Vec<Node<Optics>>| {
        let scene = world([sea(), plate(), lamp()].into_iter().chain(hidden));
        agree("hidden", &scene, [-0.01, 0.0, 0.004], [1.0, 0.0, -0.4], 200_000)
    };
    let (without, with) = (seen(vec![]), seen(vec![ball([-3.0, 0.0, 2.0], 1.0, glowing())]));
    assert!((with / without - 1.0).abs() < 0.03, "{with} {without}");
}
