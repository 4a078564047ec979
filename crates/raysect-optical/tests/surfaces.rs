//! Surfaces that are simple enough for exact answers.

use std::sync::Arc;

use raysect_core::Node;
use raysect_math::{AffineMatrix3D, Point3D, Vector3D, rotate, translate};
use raysect_optical::*;
use raysect_primitive::{Cuboid, Sphere};

fn world(nodes: impl IntoIterator<Item = Node<Optics>>) -> World {
    let mut world = World::new();
    for node in nodes {
        world.add(node).unwrap();
    }
    world
}

fn seen(world: &World, origin: [f64; 3], direction: [f64; 3]) -> f64 {
    let ray = Ray::new(Point3D::from(origin), Vector3D::from(direction)).spectrum(500.0, 501.0, 1);
    ray.trace(world).unwrap().samples()[0]
}

/// A large plate whose upper side is the plane z = 0.
fn plate(material: impl Material) -> Node<Optics> {
    let shape = Cuboid::new(Point3D::new(-50.0, -50.0, -1.0), Point3D::new(50.0, 50.0, 0.0)).unwrap();
    shape.material(material)
}

fn dome(material: impl Material) -> Node<Optics> {
    Sphere::new(900.0).unwrap().material(material)
}

#[test]
fn metals_reflect_by_the_law_that_was_asked_for() {
    for (degrees, index, extinction, expected) in
        [(75.0, 2.9, 3.0, 0.507_185_472_488_460_4), (80.0, 1.5, 0.1, 0.391_527_035_980_585_8)]
    {
        let (sine, cosine) = f64::to_radians(degrees).sin_cos();
        let look = |material: Conductor| {
            let scene = world([dome(UnitySurfaceEmitter::new()), plate(material)]);
            seen(&scene, [-sine, 0.0, cosine], [sine, 0.0, -cosine])
        };
        let exact = look(Conductor::new(index, extinction));
        assert!((exact - expected).abs() < 1e-12, "{degrees}: {exact}");
        let other = look(Conductor::new(index, extinction).fresnel(FresnelLaw::LargeIndex));
        assert!((other - expected).abs() > 1e-3, "{degrees}: {other}");
    }
}

#[test]
fn a_metal_in_water_reflects_less_than_in_air() {
    let pool = Cuboid::new(Point3D::new(-9.0, -9.0, -9.0), Point3D::new(9.0, 9.0, 9.0)).unwrap();
    let lamp = Cuboid::new(Point3D::new(-8.0, -8.0, 7.0), Point3D::new(8.0, 8.0, 8.0)).unwrap();
    let metal = Cuboid::new(Point3D::new(-8.0, -8.0, -2.0), Point3D::new(8.0, 8.0, 0.0)).unwrap();
    let scene = world([
        pool.material(Dielectric::new(1.33, 1.0).unwrap()),
        lamp.material(UnitySurfaceEmitter::new()),
        metal.material(Conductor::new(1.0, 2.0)),
    ]);
    let reflectance = |n: f64, k: f64| ((n - 1.0).powi(2) + k * k) / ((n + 1.0).powi(2) + k * k);
    let found = seen(&scene, [0.0, 0.0, 1.0], [0.0, 0.0, -1.0]);
    let (water, air) = (reflectance(1.0 / 1.33, 2.0 / 1.33), reflectance(1.0, 2.0));
    assert!((found - water).abs() < 1e-12 && water < air - 0.05, "{found} {water} {air}");
}

#[test]
fn mirrors_reflect_in_world_space_under_any_map() {
    // A block, sheared and stretched: its upper side stays the plane z = 0, whatever its local angles.
    let shear = AffineMatrix3D::from_rows([
        [3.0, 0.0, 0.7, 0.0],
        [0.2, 0.5, 0.4, 0.0],
        [0.0, 0.0, 2.0, 0.0],
        [0.0, 0.0, 0.0, 1.0],
    ])
    .unwrap();
    let spot = Sphere::new(0.01).unwrap().material(UnitySurfaceEmitter::new());
    let scene =
        world([plate(PerfectReflectingSurface).transform(shear), spot.transform(translate(1.5, 0.6, 2.0))]);
    assert_eq!(seen(&scene, [-1.5, -0.6, 2.0], [1.5, 0.6, -2.0]), 1.0);
    assert_eq!(seen(&scene, [-1.5, -0.6, 2.0], [1.5, 0.65, -2.0]), 0.0);
}

#[test]
fn the_back_of_an_anisotropic_emitter_is_its_inside() {
    let emitter = || {
        AnisotropicSurfaceEmitter::new(|slice, cosine, back, out| {
            assert_eq!((slice.bins, out.len()), (1, 1));
            out.fill(if back { 10.0 + cosine } else { cosine });
        })
    };
    let scene = world([Sphere::new(1.0).unwrap().material(emitter())]);
    assert!((seen(&scene, [0.6, 0.0, -5.0], [0.0, 0.0, 1.0]) - 0.8).abs() < 1e-12);
    assert!((seen(&scene, [0.6, 0.0, 0.0], [0.0, 0.0, 1.0]) - 10.8).abs() < 1e-12);
    assert_eq!(emitter().importance(0.3).facts().importance, 0.3);
}

#[test]
fn a_debug_light_shades_the_outer_side() {
    let light = DebugLight::new(Vector3D::new(0.0, 0.0, -4.0)).unwrap().intensity(0.5).unwrap().spectrum(3.0);
    let scene = world([Sphere::new(1.0).unwrap().material(light.clone())]);
    assert!((seen(&scene, [0.6, 0.0, 5.0], [0.0, 0.0, -1.0]) - 0.5 * 3.0 * 0.8).abs() < 1e-12);
    assert_eq!(seen(&scene, [0.6, 0.0, -5.0], [0.0, 0.0, 1.0]), 0.0);
    assert_eq!(seen(&scene, [0.6, 0.0, 0.0], [0.0, 0.0, 1.0]), 0.0);
    let negative = light.intensity(-0.1).unwrap_err().to_string();
    assert!(negative.contains("intensity") && negative.contains("-0.1"), "{negative}");
    assert!(DebugLight::new(Vector3D::ZERO).is_err());
}

#[test]
fn impossible_parameters_are_refused() {
    assert!(RoughConductor::new(1.0, 1.0, 0.0).is_err() && RoughDielectric::new(1.5, 1.0, 1.1).is_err());
    let null: Arc<dyn Material> = Arc::new(NullMaterial);
    assert!(Blend::new(null.clone(), null.clone(), 0.0).is_err());
    assert!(Blend::new(null.clone(), null.clone(), 1.0).is_err());
    assert!(Roughen::new(null.clone(), -0.1).is_err() && Roughen::new(null.clone(), f64::NAN).is_err());
    let sum = || Add::new(null.clone(), null.clone());
    let both = sum().surface_only().unwrap().volume_only().unwrap_err().to_string();
    assert!(both.contains("surface_only and volume_only"), "{both}");
    assert!(sum().volume_only().unwrap().surface_only().is_err());
    let refused = |n: f64, k: f64| {
        let scene = world([plate(Conductor::new(n, k))]);
        let ray = Ray::new(Point3D::new(0.0, 0.0, 1.0), -Vector3D::Z).spectrum(500.0, 501.0, 1);
        ray.trace(&scene).map(|_| ()).unwrap_err().to_string()
    };
    assert!(refused(1.0, -0.5).contains("extinction"));
    assert!(refused(f64::NAN, 1.0).contains("index") && refused(0.0, 0.0).contains("index"));
}

#[test]
fn modifiers_pass_facts_through() {
    let lambert: Arc<dyn Material> = Arc::new(Lambert::default());
    let lamp: Arc<dyn Material> = Arc::new(UniformSurfaceEmitter::new(1.0, 1.0).importance(3.0));
    assert!(!Dielectric::new(1.5, 1.0).unwrap().facts().disperses);
    let index = |wavelength: f64| 1.5 + 5.0 / wavelength;
    let glass: Arc<dyn Material> = Arc::new(Dielectric::new(index, 1.0).unwrap().importance(0.5));
    let null: Arc<dyn Material> = Arc::new(NullMaterial);
    let facts = Roughen::new(Arc::new(Add::new(lambert.clone(), lamp.clone())), 0.1).unwrap().facts();
    assert!(facts.emits && facts.importance == 3.0 && !facts.absorbs && !facts.transparent);
    assert_eq!(facts.name, "rough (Lambert + UniformSurfaceEmitter)");
    let blend =
        |a: &Arc<dyn Material>, b: &Arc<dyn Material>| Blend::new(a.clone(), b.clone(), 0.25).unwrap();
    assert!(blend(&null, &null).facts().transparent && !blend(&null, &lambert).facts().transparent);
    assert!(blend(&glass, &lambert).facts().disperses && blend(&glass, &lambert).facts().importance == 0.5);
    assert!(blend(&lamp, &lamp).facts().absorbs && !blend(&lamp, &null).facts().absorbs);
    let dark = Add::new(lambert.clone(), lamp.clone()).volume_only().unwrap().facts();
    assert!(!dark.emits);
    let refracts = |m: &dyn Material| m.medium().is_some();
    assert!(refracts(&Add::new(lambert.clone(), glass.clone())));
    assert!(!refracts(&Add::new(lambert.clone(), glass.clone()).surface_only().unwrap()));
    assert!(refracts(&Roughen::new(glass, 0.1).unwrap()));
}

#[test]
fn emission_of_modifiers_is_that_of_their_parts_together() {
    let lamp = |radiance: f64| -> Arc<dyn Material> { Arc::new(UniformSurfaceEmitter::new(radiance, 1.0)) };
    let black: Arc<dyn Material> = Arc::new(AbsorbingSurface);
    let null: Arc<dyn Material> = Arc::new(NullMaterial);
    let blend = |a: Arc<dyn Material>, b: Arc<dyn Material>| Arc::new(Blend::new(a, b, 0.25).unwrap());
    let look = |material: Arc<dyn Material>| {
        let scene = world([dome(UniformSurfaceEmitter::new(16.0, 1.0)), plate(material)]);
        seen(&scene, [0.0, 0.0, 1.0], [0.1, 0.0, -1.0])
    };
    assert_eq!(look(Arc::new(Add::new(lamp(1.0), lamp(2.0)))), 3.0);
    assert_eq!(look(blend(lamp(1.0), lamp(2.0))), 1.25);
    assert_eq!(look(blend(lamp(1.0), black.clone())), 0.75);
    assert_eq!(look(blend(black.clone(), lamp(1.0))), 0.25);
    assert_eq!(
        look(blend(lamp(8.0), blend(lamp(1.0), blend(lamp(4.0), lamp(12.0))))),
        6.0 + 0.25 * (0.75 + 1.5)
    );
    assert_eq!(look(Arc::new(Roughen::new(lamp(2.0), 0.5).unwrap())), 2.0);
    // Beside a black part what scatters is followed always: no single path is off.
    let mirror: Arc<dyn Material> = Arc::new(PerfectReflectingSurface);
    assert_eq!(look(blend(mirror.clone(), black.clone())), 12.0);
    assert_eq!(look(Arc::new(Add::new(black.clone(), mirror.clone()))), 16.0);
    // Nothing and nothing is nothing, a lamp on one of them shines.
    assert_eq!(look(Arc::new(Add::new(null.clone(), null.clone()))), 16.0);
    let volume = Add::new(mirror, lamp(1.0)).volume_only().unwrap();
    assert_eq!(look(Arc::new(volume)), 16.0);
}

#[test]
fn a_roughened_mirror_loses_nothing() {
    let mirror = |roughness| Roughen::new(Arc::new(PerfectReflectingSurface), roughness).unwrap();
    for roughness in [0.0, 0.2, 1.0] {
        let ball = Sphere::new(1.0).unwrap().material(mirror(roughness));
        let scene = world([dome(UnitySurfaceEmitter::new()), ball.transform(rotate(10.0, 20.0, 30.0))]);
        for x in [0.0, 0.5, 0.99] {
            let ray = Ray::new(Point3D::new(x, 0.0, -5.0), Vector3D::Z).spectrum(500.0, 501.0, 1);
            let seen = ray.sample(&scene, 500).unwrap();
            assert!((seen.mean.samples()[0] - 1.0).abs() < 1e-12, "{roughness} {x}: {:?}", seen.mean);
        }
    }
}
