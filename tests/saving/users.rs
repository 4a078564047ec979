//! Shapes, materials and functions of a user's own.

use std::sync::Arc;

use raysect::core::testing::Ball;
use raysect::math::AffineMatrix3D;
use raysect::prelude::*;
use raysect::save::{
    MaterialRegistry, OpticalEntry, Registry, SaveError, Saved, SavedScene, SceneWriter, registry,
};
use raysect::{core, optical};

use crate::text_of;

/// A ball of another name, in which another shape is remembered.
struct Shell {
    ball: Ball,
    radius: f64,
    core: Arc<dyn Primitive>,
}

impl Primitive for Shell {
    fn bounding_box(&self, m: &AffineMatrix3D) -> core::BoundingBox3D {
        self.ball.bounding_box(m)
    }
    fn contains(&self, point: Point3D) -> bool {
        self.ball.contains(point)
    }
    fn crossings(&self, ray: &core::Ray, scratch: &mut core::Scratch, out: &mut Vec<core::Crossing>) {
        self.ball.crossings(ray, scratch, out);
    }
    fn surface(&self, ray: &core::Ray, crossing: &core::Crossing) -> core::Surface {
        self.ball.surface(ray, crossing)
    }
    fn save(&self, writer: &mut SceneWriter) -> Result<Saved, SaveError> {
        let saved = Saved::new("Shell").number("radius", self.radius);
        Ok(saved.reference("core", writer.shared_object(&self.core)?))
    }
}

/// Emits a spectrum of its own kind; says how it is saved.
struct Glow(SpectralTable);

impl Material for Glow {
    fn surface(&self, _: &SurfaceHit, _: &mut Path) -> Scatter {
        Scatter::Absorbed
    }
    fn save(&self, writer: &mut SceneWriter) -> Result<Saved, SaveError> {
        Ok(Saved::new("Glow").reference("spectrum", writer.object(&self.0)?))
    }
}

/// A straight line.
struct Slope(f64);

impl SpectralFunction for Slope {
    fn evaluate(&self, wavelength: f64) -> f64 {
        self.0 * wavelength
    }
    fn save(&self, _: &mut SceneWriter) -> Result<Saved, SaveError> {
        Ok(Saved::new("Slope").number("rise", self.0))
    }
}

/// Says nothing about files.
struct Dumb;

impl Material for Dumb {
    fn surface(&self, _: &SurfaceHit, _: &mut Path) -> Scatter {
        Scatter::Absorbed
    }
}

fn shell(radius: f64, core: Arc<dyn Primitive>) -> Shell {
    Shell { ball: Ball::new(radius), radius, core }
}

#[test]
fn one_line_of_the_registry_reads_a_type_of_the_users_own() {
    let mut world = World::new();
    let core: Arc<dyn Primitive> = Arc::new(Sphere::new(0.125).unwrap());
    for radius in [0.5, 0.25] {
        world.add(shell(radius, core.clone()).material(Glow(Slope(0.1).into())).name("shell")).unwrap();
    }
    world.add(core.clone().material(AbsorbingSurface)).unwrap();
    let text = text_of(&world);
    assert_eq!(text.matches("\"Sphere\"").count(), 1, "{text}");

    let mut registry = registry();
    let refusal = |registry: &Registry| SavedScene::from_json(&text, registry).unwrap_err().to_string();
    let message = refusal(&registry);
    assert!(message.contains("no shape of the kind 'Shell'") && message.contains("Sphere"), "{message}");
    registry.primitive("Shell", |entry| Ok(shell(entry.number("radius")?, entry.object("core")?)));
    let message = refusal(&registry);
    assert!(message.contains("function of the kind 'Slope'") && message.contains("Sellmeier"), "{message}");
    registry.function("Slope", |entry| Ok(Slope(entry.number("rise")?)));
    registry.material("Glow", |entry| Ok(Glow(entry.function("spectrum")?)));
    let read = SavedScene::from_json(&text, &registry).unwrap().world;
    assert_eq!(text_of(&read), text);
    assert_eq!(read.tree(), world.tree());
}

#[test]
fn what_does_not_say_how_it_is_saved_is_named_with_its_node() {
    let refusal = |node: Node<optical::Optics>| {
        let mut world = World::new();
        world.add(Sphere::default().material(NullMaterial).name("fine")).unwrap();
        world.add(node.name("here")).unwrap();
        SceneWriter::new(&world).unwrap_err().to_string()
    };
    let message = refusal(Sphere::default().material(Dumb));
    assert_eq!(
        message,
        "node 'here (Sphere)': a material of the kind Dumb cannot be saved: it does not say how"
    );
    let message = refusal(Sphere::default().material(Arc::new(Dumb)));
    assert!(message.contains("kind Dumb"), "{message}");
    let message = refusal(Sphere::default().material(Lambert::new(|_: f64| 0.5)));
    assert_eq!(
        message,
        "node 'here (Sphere)': a spectral function of the kind closure cannot be saved: it does not say how"
    );
    let message = refusal(Sphere::default().material(Lambert::new(f64::NAN)));
    assert!(message.starts_with("node 'here (Sphere)': Constant with value = NaN"), "{message}");
    let message = refusal(Sphere::default().material(NullMaterial).meta("notes", vec![1, 2]));
    assert!(message.contains("node 'here (Sphere)': the user's value 'notes'"), "{message}");
}

/// Another material under another name.
struct Coat(Arc<dyn Material>);

impl Material for Coat {
    fn surface(&self, hit: &SurfaceHit, path: &mut Path) -> Scatter {
        self.0.surface(hit, path)
    }
    fn save(&self, writer: &mut SceneWriter) -> Result<Saved, SaveError> {
        Ok(Saved::new("Coat").reference("base", writer.shared_object(&self.0)?))
    }
}

#[test]
fn materials_hold_materials() {
    let mut world = World::new();
    let base: Arc<dyn Material> = Arc::new(Lambert::new(0.125));
    world.add(Sphere::default().material(Coat(base.clone()))).unwrap();
    world.add(Sphere::default().material(base)).unwrap();
    let text = text_of(&world);
    assert_eq!(text.matches("\"Lambert\"").count(), 1, "{text}");
    let mut registry = registry();
    registry.material("Coat", |entry| Ok(Coat(entry.material("base")?)));
    let read = SavedScene::from_json(&text, &registry).unwrap().world;
    assert_eq!(text_of(&read), text);
}

#[test]
fn a_field_is_given_once() {
    struct Twice;
    impl Material for Twice {
        fn surface(&self, _: &SurfaceHit, _: &mut Path) -> Scatter {
            Scatter::Absorbed
        }
        fn save(&self, _: &mut SceneWriter) -> Result<Saved, SaveError> {
            Ok(Saved::new("Twice").number("a", 1.0).number("a", 2.0))
        }
    }
    let mut world = World::new();
    world.add(Sphere::default().material(Twice)).unwrap();
    assert!(SceneWriter::new(&world).unwrap_err().to_string().contains("'a' twice"));
}
