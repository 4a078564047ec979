//! Observers come and go, and the compiled scene stays.

use raysect::prelude::*;

use crate::bits::{CASES, Pictures, camera};

#[test]
fn observing_compiles_once() {
    let world = CASES[0].world();
    assert!(!world.is_compiled());
    Pictures::of(&camera(1), &world);
    assert!(world.is_compiled());
    let scene: *const _ = world.scene().unwrap();
    Pictures::of(&camera(1).transform(translate(0.0, 0.1, -3.3)), &world);
    assert!(std::ptr::eq(scene, world.scene().unwrap()));
}

#[test]
fn places_of_observers_rebuild_nothing() {
    let mut world = CASES[0].world();
    let still = Pictures::of(&camera(5), &world);
    let cart = world.add(Node::group().name("cart")).unwrap();
    assert!(world.is_compiled(), "adding a place");
    let arm = world.add(Node::group().parent(cart).transform(translate(0.0, 0.0, -3.3))).unwrap();
    let riding = camera(5).transform(AffineMatrix3D::IDENTITY).parent(arm);
    assert!(Pictures::of(&riding, &world) == still);

    world.set_transform(cart, translate(0.2, 0.0, 0.0)).unwrap();
    assert!(world.is_compiled(), "moving a place");
    let moved = camera(5).transform(translate(0.2, 0.0, -3.3));
    assert!(Pictures::of(&riding, &world) == Pictures::of(&moved, &world));
    world.remove(cart).unwrap();
    assert!(world.is_compiled(), "removing a place");
    assert!(Pictures::of(&camera(5), &world) == still);
}

#[test]
fn moving_a_shape_rebuilds() {
    let mut world = CASES[2].world();
    let before = Pictures::of(&camera(5), &world);
    let ball = world.add(Sphere::new(0.2).unwrap().material(Lambert::new(0.5))).unwrap();
    assert!(!world.is_compiled());
    assert!(Pictures::of(&camera(5), &world) != before);
    world.remove(ball).unwrap();
    assert!(!world.is_compiled());
    assert!(Pictures::of(&camera(5), &world) == before);
}
