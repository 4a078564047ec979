//! Worlds of geometry alone as files.

use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

use raysect_core::save::{Entry, MakeError, Registry, SaveError, Saved, SavedScene, SceneWriter};
use raysect_core::testing::Ball;
use raysect_core::{Acceleration, BoundingBox3D, Crossing, Node, Primitive, Ray, Scratch, Surface, World};
use raysect_math::{AffineMatrix3D, Point3D, rotate, translate};

fn registry() -> Registry {
    let mut registry = Registry::new();
    registry.primitive("Ball", |entry: &Entry| -> Result<Ball, MakeError> {
        Ok(Ball::new(entry.number("radius")?))
    });
    registry
}

fn text_of(world: &World<()>) -> String {
    SceneWriter::new(world).unwrap().to_json()
}

fn read(text: &str) -> World<()> {
    SavedScene::from_json(text, &registry()).unwrap_or_else(|error| panic!("{error}\n{text}")).world
}

#[test]
fn trees_come_back_in_their_order() {
    let mut world = World::<()>::new();
    let (a, b) = (world.add(Node::group().name("a")).unwrap(), world.add(Node::group().name("b")).unwrap());
    let place = rotate(0.1, 0.2, 0.3) * translate(1.0 / 3.0, -0.0, 1e-310);
    for (parent, name) in [(b, "b1"), (a, "a1"), (b, "b2"), (a, "é \"quoted\" \\ \u{7}")] {
        world.add(Node::of(Ball::new(0.1), ()).parent(parent).name(name).transform(place)).unwrap();
    }
    let gone = world.add(Node::group()).unwrap();
    world.add(Node::observer().parent(a).name("seat")).unwrap();
    world.remove(gone).unwrap();
    world.add(Node::group().name("late")).unwrap();
    world.set_name(world.root(), "hall").unwrap();
    world.set_acceleration(Acceleration::Tree);

    let text = text_of(&world);
    let read = read(&text);
    assert_eq!(read.tree(), world.tree());
    assert_eq!(text_of(&read), text);
    assert!(text.contains("\"acceleration\": \"Tree\"") && text.contains("\"name\": \"hall\""));
    let bits = |world: &World<()>| {
        let rows = world.transform(world.find("b2").unwrap()).unwrap().to_rows();
        rows.map(|row| row.map(f64::to_bits))
    };
    assert_eq!(bits(&read), bits(&world));
    assert_eq!(read.observers().len(), 1);
}

#[test]
fn plain_values_of_users_come_back_with_their_types() {
    let mut world = World::<()>::new();
    let node = world.add(Node::group().name("n")).unwrap();
    world.set_meta(node, "label", "divertor".to_owned()).unwrap();
    world.set_meta(node, "yes", true).unwrap();
    world.set_meta(node, "x", 0.1 + 0.2).unwrap();
    world.set_meta(node, "small", -7_i32).unwrap();
    world.set_meta(node, "large", u64::MAX).unwrap();
    world.set_meta(world.root(), "shot", 12_345_usize).unwrap();
    let text = text_of(&world);
    let read = read(&text);
    assert_eq!(text_of(&read), text);
    let n = read.find("n").unwrap();
    assert_eq!(read.meta::<String>(n, "label").unwrap().map(String::as_str), Some("divertor"));
    assert_eq!(read.meta::<bool>(n, "yes").unwrap(), Some(&true));
    assert_eq!(read.meta::<f64>(n, "x").unwrap(), Some(&(0.1 + 0.2)));
    assert_eq!(read.meta::<i32>(n, "small").unwrap(), Some(&-7));
    assert_eq!(read.meta::<u64>(n, "large").unwrap(), Some(&u64::MAX));
    assert_eq!(read.meta::<usize>(read.root(), "shot").unwrap(), Some(&12_345));
}

#[test]
fn nothing_is_left_out_without_a_word() {
    let refusal = |change: &dyn Fn(&mut World<()>)| {
        let mut world = World::<()>::new();
        change(&mut world);
        SceneWriter::new(&world).unwrap_err().to_string()
    };
    let detached = refusal(&|world| {
        let node = world.add(Node::group().name("spare")).unwrap();
        world.detach(node).unwrap();
    });
    assert_eq!(detached, "the detached node 'spare (Group)' cannot be saved");
    let custom = refusal(&|world| {
        world.set_acceleration(Acceleration::Custom(Arc::new(|boxes| Acceleration::List.build(boxes))));
    });
    assert_eq!(custom, "an acceleration structure of the user's own cannot be saved");
    let value = refusal(&|world| {
        world.add(Node::group().name("n").meta("list", vec![1.0])).unwrap();
    });
    assert!(value.starts_with("node 'n (Group)': the user's value 'list'"), "{value}");
    let value = refusal(&|world| {
        world.add(Node::group().name("n").meta("x", f64::NAN)).unwrap();
    });
    assert!(value.contains("not finite"), "{value}");
    let radius = refusal(&|world| {
        world.add(Node::of(Ball::new(f64::INFINITY), ()).name("n")).unwrap();
    });
    assert_eq!(
        radius,
        "node 'n (Ball)': Ball with radius = inf cannot be saved: a file holds finite numbers only"
    );
}

/// A ball that counts how often it was saved.
struct Counted(Ball, AtomicUsize);

impl Primitive for Counted {
    fn bounding_box(&self, m: &AffineMatrix3D) -> BoundingBox3D {
        self.0.bounding_box(m)
    }
    fn contains(&self, point: Point3D) -> bool {
        self.0.contains(point)
    }
    fn crossings(&self, ray: &Ray, scratch: &mut Scratch, out: &mut Vec<Crossing>) {
        self.0.crossings(ray, scratch, out);
    }
    fn surface(&self, ray: &Ray, crossing: &Crossing) -> Surface {
        self.0.surface(ray, crossing)
    }
    fn save(&self, writer: &mut SceneWriter) -> Result<Saved, SaveError> {
        self.1.fetch_add(1, Ordering::Relaxed);
        self.0.save(writer)
    }
}

#[test]
fn shapes_that_share_memory_are_looked_at_once() {
    let shared = Arc::new(Counted(Ball::new(0.25), AtomicUsize::new(0)));
    let mut world = World::<()>::new();
    for x in [0.0, 1.0] {
        world.add(Node::of(shared.clone(), ()).transform(translate(x, 0.0, 0.0))).unwrap();
    }
    let text = text_of(&world);
    assert_eq!((text.matches("\"Ball\"").count(), shared.1.load(Ordering::Relaxed)), (1, 1));
    let read = read(&text);
    let shapes: Vec<_> =
        read.primitives().iter().map(|&n| read.primitive(n).unwrap().unwrap().clone()).collect();
    assert!(Arc::ptr_eq(&shapes[0], &shapes[1]));
    assert_eq!(text_of(&read), text);
}

#[test]
fn writers_of_wrappers_cannot_add_to_what_is_shared() {
    let shared: Arc<dyn Primitive> = Arc::new(Ball::new(0.25));
    let mut world = World::<()>::new();
    world.add(Node::of(shared.clone(), ())).unwrap();
    let mut writer = SceneWriter::new(&world).unwrap();
    struct Wrapper(Arc<dyn Primitive>);
    impl raysect_core::save::SceneObject for Wrapper {
        const ROLE: &'static str = "shape";
        fn save(&self, writer: &mut SceneWriter) -> Result<Saved, SaveError> {
            Ok(writer.shared(&self.0, |ball, writer| ball.save(writer))?.number("more", 1.0))
        }
    }
    assert!(matches!(writer.object(&Wrapper(shared)), Err(SaveError::NoPlace(_))));
}
