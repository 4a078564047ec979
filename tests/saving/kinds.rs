//! Every kind that the library registers comes back as it was: a new one belongs into these lists.

use std::collections::BTreeSet;
use std::sync::Arc;

use raysect::optical::Optics;
use raysect::prelude::*;

use crate::{read, refusal, text_of};

fn shapes() -> Vec<Arc<dyn Primitive>> {
    vec![
        Arc::new(Sphere::new(0.1).unwrap()),
        Arc::new(Cuboid::new(Point3D::new(-0.1, -0.2, 0.3), Point3D::new(0.1, 1.0 / 3.0, 0.3)).unwrap()),
        Arc::new(Cylinder::new(0.1, 1.0 / 7.0).unwrap()),
        Arc::new(Cone::new(0.3, 0.2).unwrap()),
        Arc::new(Parabola::new(0.3, 0.7).unwrap()),
        Arc::new(Torus::new(0.3, 0.1).unwrap()),
        Arc::new(BiConvex::new(0.0254, 0.01, 0.05, 0.08).unwrap()),
        Arc::new(BiConcave::new(0.0254, 0.01, 0.05, 0.08).unwrap()),
        Arc::new(Meniscus::new(0.0254, 0.003, 0.05, 0.08).unwrap()),
        Arc::new(PlanoConvex::new(0.0254, 0.01, 0.05).unwrap()),
        Arc::new(PlanoConcave::new(0.0254, 0.01, 0.05).unwrap()),
        Arc::new(composite()),
        Arc::new(Mesh::new(smooth_ball()).unwrap()),
        Arc::new(Mesh::builder(smooth_ball()).smoothing(false).closed(false).build().unwrap()),
    ]
}

/// All three kinds, one within the other, with an operand that is used twice.
fn composite() -> Subtract {
    let ball = Arc::new(Sphere::new(0.5).unwrap());
    let both = Union::new(ball.clone(), ball.placed(translate(0.1, 1.0 / 3.0, 0.0))).unwrap();
    let cut = Intersect::new(both, Cuboid::default().placed(rotate(10.0, 20.0, 30.0))).unwrap();
    Subtract::new(cut, Cylinder::new(0.1, 2.0).unwrap()).unwrap()
}

fn smooth_ball() -> MeshData {
    let ball = MeshData::icosphere(1, 0.3).unwrap();
    let normals: Vec<[f64; 3]> = ball.vertices().iter().map(|p| p.to_array()).collect();
    let indices = ball.triangles().to_vec();
    ball.with_normals(normals, indices).unwrap()
}

fn materials() -> Vec<Optics> {
    let table = InterpolatedSf::new([400.0, 500.5], [0.1, 0.9]).unwrap();
    let sellmeier =
        Sellmeier::new([1.03961212, 0.231792344, 1.01046945], [0.00600069867, 0.0200179144, 103.560653])
            .unwrap();
    let lamp = BlackBody::new(2856.1).unwrap().emissivity(table.clone()).scaled(0.1).unwrap();
    let glass = Dielectric::new(sellmeier, table.clone()).unwrap().external_index(1.33).priority(-3);
    let board = Checkerboard::new(0.3).unwrap().spectra((table.clone(), 0.1), (0.7, 0.2)).importance(0.4);
    let glass = glass.transmission_only(true).importance(0.5).named("flint \"7\"");
    let light = DebugLight::new(Vector3D::new(0.1, -1.0, 0.3)).unwrap().intensity(0.7).unwrap();
    let mut all = vec![
        Optics::new(AbsorbingSurface),
        Optics::new(NullMaterial),
        Optics::new(UniformVolume::emitter(table.clone()).absorption(0.3).importance(0.2)),
        Optics::new(UniformVolume::new().scattering(table.clone(), HenyeyGreenstein::new(-0.4).unwrap())),
        Optics::new(UniformVolume::emitter(0.2).scattering(0.3, Rayleigh)),
        Optics::new(
            VolumeTransform::new(
                Arc::new(UniformVolume::emitter(0.1)),
                rotate_x(30.0) * translate(0.1, 0.2, 1.0 / 3.0),
            )
            .unwrap(),
        ),
        Optics::new(PerfectReflectingSurface),
        Optics::new(Lambert::new(table.clone())),
        Optics::new(UniformSurfaceEmitter::new(table.clone(), 1.5).importance(3.0)),
        Optics::new(UnitySurfaceEmitter::new().importance(0.1)),
        Optics::new(light.spectrum(table.clone())),
        Optics::new(board),
        Optics::new(Lambert::new(Spectrum::from_samples(400.0, 500.5, vec![0.1, 1.0 / 3.0]).unwrap())),
        Optics::new(Lambert::new(TopHat::new(400.0, 500.5, 1.0 / 3.0).unwrap())),
        Optics::new(UniformSurfaceEmitter::new(GaussianLine::new(588.995, 0.1, 1.0 / 3.0).unwrap(), 1.0)),
        Optics::new(UniformSurfaceEmitter::new(lamp, 1.0)),
        Optics::new(RoughDielectric::of(glass.clone(), 0.3).unwrap()),
        Optics::new(glass),
    ];
    let rough = RoughConductor::new(table.clone(), 3.0, 0.1).unwrap();
    let smooth = Conductor::new(table, 2.9);
    for law in [FresnelLaw::Exact, FresnelLaw::LargeIndex] {
        all.push(Optics::new(smooth.clone().fresnel(law)));
        for masking in [Masking::Separable, Masking::HeightCorrelated] {
            all.push(Optics::new(rough.clone().fresnel(law).masking(masking)));
        }
    }
    all.extend(modifiers(Arc::new(smooth), Arc::new(rough)));
    all
}

/// Every modifier, one within the other.
fn modifiers(first: Arc<dyn Material>, second: Arc<dyn Material>) -> [Optics; 5] {
    let blend = || Blend::new(first.clone(), second.clone(), 0.1).unwrap();
    let rough: Arc<dyn Material> = Arc::new(Roughen::new(Arc::new(blend()), 0.3).unwrap());
    let sum = || Add::new(rough.clone(), first.clone());
    [
        Optics::new(blend().surface_only().unwrap()),
        Optics::new(blend().volume_only().unwrap()),
        Optics::new(sum()),
        Optics::new(sum().surface_only().unwrap()),
        Optics::new(sum().volume_only().unwrap()),
    ]
}

/// Asserts that a world comes back, and that its text has every kind of a role that is registered.
#[track_caller]
fn has_every_kind(world: &World, role: &str) {
    let text = text_of(world);
    assert_eq!(text_of(&read(&text).unwrap().world), text);
    let lead = format!("\"role\": \"{role}\", \"kind\": \"");
    let there: BTreeSet<&str> = text.split(&lead).skip(1).filter_map(|rest| rest.split('"').next()).collect();
    let unknown = refusal(&text.replace(&lead, &format!("{lead}No ")));
    let known = unknown.rsplit("there are: ").next().unwrap();
    assert_eq!(there, known.split(", ").collect(), "{role}");
}

#[test]
fn every_shape_comes_back() {
    let mut world = World::new();
    for shape in shapes() {
        world.add(shape.material(NullMaterial)).unwrap();
    }
    has_every_kind(&world, "shape");
}

/// A field that says another size than the shape has would come back as it was written.
#[test]
fn shapes_come_back_with_their_size() {
    for scale in [1.0, 2.0, 3.0] {
        let mut world = World::new();
        for shape in shapes().into_iter().chain([Arc::new(Torus::new(scale, 0.1).unwrap()) as Arc<_>]) {
            world.add(shape.material(NullMaterial)).unwrap();
        }
        let back = read(&text_of(&world)).unwrap().world;
        let boxes = |world: &World| -> Vec<_> {
            let scene = world.scene().unwrap();
            scene.instances.iter().map(|i| i.primitive.bounding_box(&AffineMatrix3D::IDENTITY)).collect()
        };
        assert_eq!(boxes(&back), boxes(&world));
    }
}

#[test]
fn every_material_and_spectral_function_comes_back() {
    let mut world = World::new();
    for material in materials() {
        world.add(Node::of(Sphere::default(), material)).unwrap();
    }
    has_every_kind(&world, "material");
    has_every_kind(&world, "function");
    has_every_kind(&world, "phase");
}

#[test]
#[should_panic(expected = "material")]
fn a_kind_that_is_not_tried_is_found() {
    let mut world = World::new();
    world.add(Sphere::default().material(NullMaterial)).unwrap();
    has_every_kind(&world, "material");
}
