//! The scene-graph and the compiled scene, with geometry alone.

use raysect_core::testing::Ball;
use raysect_core::{Acceleration, CoreError, Node, NodeKind, Ray, World};
use raysect_math::{AffineMatrix3D, Point3D, Rng, Vector3D, rotate, rotate_y, translate};

fn far_ball(world: &mut World<()>) -> raysect_core::NodeId {
    world.add(Node::of(Ball::new(1.0), ()).transform(translate(0.0, 0.0, 10.0))).unwrap()
}

fn distance(world: &World<()>) -> Option<f64> {
    world.hit(&Ray::default()).unwrap().map(|h| h.distance())
}

#[test]
fn frames_compose_from_the_root_down() {
    let mut world = World::<()>::new();
    let a = world.add(Node::group().transform(translate(1.0, 2.0, 3.0)).name("a")).unwrap();
    let b = world.add(Node::group().transform(rotate_y(90.0)).parent(a)).unwrap();
    let c = world.add(Node::group().transform(translate(0.0, 0.0, 1.0))).unwrap();
    let p = world.to_root(b).unwrap() * Point3D::new(0.0, 0.0, 1.0);
    assert!(p.distance_to(Point3D::new(2.0, 2.0, 3.0)) < 1e-15);
    let there = world.to(b, c).unwrap() * Point3D::new(0.0, 0.0, 1.0);
    assert!(there.distance_to(Point3D::new(2.0, 2.0, 2.0)) < 1e-15);
    let back = world.to_local(b).unwrap() * p;
    assert!(back.distance_to(Point3D::new(0.0, 0.0, 1.0)) < 1e-15);
    assert_eq!((world.parent(b).unwrap(), world.children(a).unwrap()), (Some(a), vec![b]));
    assert_eq!((world.name(a).unwrap(), world.find("a")), ("a", Some(a)));
}

#[test]
fn cycles_foreign_nodes_and_the_root_are_refused() {
    let (mut world, mut other) = (World::<()>::new(), World::<()>::new());
    let a = world.add(Node::group()).unwrap();
    let b = world.add(Node::group().parent(a)).unwrap();
    let foreign = other.add(Node::group()).unwrap();
    assert!(matches!(world.set_parent(a, b), Err(CoreError::Cycle { .. })));
    assert!(matches!(world.set_parent(a, a), Err(CoreError::Cycle { .. })));
    assert!(matches!(world.set_parent(a, foreign), Err(CoreError::UnknownNode(_))));
    assert!(matches!(world.set_parent(world.root(), a), Err(CoreError::Root)));
    assert!(matches!(world.add(Node::group().parent(foreign)), Err(CoreError::UnknownNode(_))));
    let flat = AffineMatrix3D::from_axes(Vector3D::X, Vector3D::Y, Vector3D::X, Point3D::ORIGIN);
    assert!(matches!(world.add(Node::group().transform(flat)), Err(CoreError::Transform { .. })));
}

#[test]
fn detached_branches_are_not_part_of_the_scene() {
    let mut world = World::<()>::new();
    let group = world.add(Node::group()).unwrap();
    let ball = far_ball(&mut world);
    world.set_parent(ball, group).unwrap();
    assert_eq!(distance(&world), Some(9.0));
    world.detach(group).unwrap();
    assert_eq!(distance(&world), None);
    assert!(matches!(world.to(ball, world.root()), Err(CoreError::Unconnected(..))));
    world.set_parent(group, world.root()).unwrap();
    assert_eq!(distance(&world), Some(9.0));
    world.remove(group).unwrap();
    assert!(matches!(world.to_root(ball), Err(CoreError::UnknownNode(_))));
    let again = far_ball(&mut world);
    assert_ne!(again, ball);
    assert_eq!(world.primitives(), vec![again]);
}

#[test]
fn only_changes_of_shapes_drop_the_compiled_scene() {
    let mut world = World::<()>::new();
    let ball = far_ball(&mut world);
    assert!(!world.is_compiled());
    assert_eq!(distance(&world), Some(9.0));
    let camera = world.add(Node::observer().name("camera")).unwrap();
    world.set_transform(camera, translate(0.0, 1.0, 0.0)).unwrap();
    assert!(world.is_compiled());
    assert_eq!((world.observers(), world.kind(camera).unwrap()), (vec![camera], NodeKind::Observer));
    world.set_transform(ball, translate(0.0, 0.0, 20.0)).unwrap();
    assert!(!world.is_compiled());
    assert_eq!(distance(&world), Some(19.0));
    world.rebuild().unwrap();
    assert!(world.is_compiled());
}

#[test]
fn user_values_stay_with_their_node() {
    let mut world = World::<()>::new();
    let node = world.add(Node::group().meta("channel", 7_u32)).unwrap();
    world.set_meta(node, "label", "divertor".to_owned()).unwrap();
    assert_eq!(world.meta::<u32>(node, "channel").unwrap(), Some(&7));
    assert_eq!(world.meta::<String>(node, "label").unwrap().map(String::as_str), Some("divertor"));
    assert_eq!(world.meta::<f64>(node, "label").unwrap(), None);
}

#[test]
fn the_tree_prints_with_a_mark() {
    let mut world = World::<()>::new();
    let room = world.add(Node::group().name("room")).unwrap();
    let ball = world.add(Node::of(Ball::new(1.0), ()).parent(room).name("lamp")).unwrap();
    world.add(Node::observer()).unwrap();
    let expected = "world (Group)\n├─ room (Group)\n│  └─ lamp (Ball)  <\n└─ Observer\n";
    assert_eq!(world.tree_marking(ball).unwrap(), expected);
    assert_eq!(world.tree(), expected.replace("  <", ""));
}

#[test]
fn rays_that_lead_nowhere_are_refused() {
    let world = World::<()>::new();
    let refused = |ray: Ray| matches!(world.hit(&ray), Err(CoreError::Ray(_)));
    assert!(refused(Ray::new(Point3D::ORIGIN, Vector3D::ZERO)));
    assert!(refused(Ray::new(Point3D::new(f64::NAN, 0.0, 0.0), Vector3D::Z)));
    assert!(refused(Ray::default().with_max_distance(-1.0)));
}

#[test]
fn every_acceleration_gives_the_same_hits() {
    let mut rng = Rng::new(9);
    let mut worlds: Vec<World<()>> = (0..4).map(|_| World::new()).collect();
    let custom = Acceleration::Custom(std::sync::Arc::new(|boxes| Acceleration::List.build(boxes)));
    for (world, choice) in
        worlds.iter_mut().zip([Acceleration::List, Acceleration::Tree, Acceleration::Automatic, custom])
    {
        world.set_acceleration(choice);
    }
    for _ in 0..200 {
        let (x, y, z) = (rng.range(-9.0, 9.0), rng.range(-9.0, 9.0), rng.range(-9.0, 9.0));
        let (size, turn) = (rng.range(0.1, 2.0), rng.range(0.0, 360.0));
        for world in &mut worlds {
            let place = translate(x, y, z) * rotate(turn, 0.0, 0.0);
            world.add(Node::of(Ball::new(size), ()).transform(place)).unwrap();
        }
    }
    for _ in 0..3000 {
        let mut u = || rng.range(-1.0, 1.0);
        let ray = Ray::new(Point3D::new(10.0 * u(), 10.0 * u(), 10.0 * u()), Vector3D::new(u(), u(), u()));
        let answers: Vec<_> = worlds
            .iter()
            .map(|w| {
                let hit = w.hit(&ray).unwrap().map(|h| (h.surface.instance, h.distance().to_bits()));
                let line: Vec<u64> =
                    w.crossings(&ray).unwrap().iter().map(|c| c.distance().to_bits()).collect();
                let inside = w.contains(ray.origin).unwrap().len();
                (hit, line, inside)
            })
            .collect();
        assert!(answers.windows(2).all(|a| a[0] == a[1]));
    }
}

#[test]
fn both_launch_points_lie_on_their_side() {
    let mut world = World::<()>::new();
    world.add(Node::of(Ball::new(1e-3), ()).transform(translate(1e3, 0.0, 10.0))).unwrap();
    let hit = world.hit(&Ray::new(Point3D::new(1e3, 2e-4, 0.0), Vector3D::Z)).unwrap().unwrap();
    let local = |p: Point3D| (hit.to_local * p).to_vector().length();
    assert!(local(hit.inside_point()) < 1e-3 && local(hit.outside_point()) > 1e-3);
    assert!(hit.inside_point().distance_to(hit.outside_point()) < 1e-10);
    assert!(!hit.exiting() && hit.local_point().z < 0.0);
    assert!((hit.to_world * hit.local_point()).distance_to(hit.point()) < 1e-12);
}
