//! What is shared stays shared, and is written once.

use std::sync::Arc;

use raysect::prelude::*;

use crate::{read, text_of};

fn count(text: &str, what: &str) -> usize {
    text.matches(what).count()
}

#[test]
fn equal_objects_are_written_once_and_shared_after_reading() {
    let mut world = World::new();
    let ball = Sphere::new(0.25).unwrap();
    let glass = Arc::new(schott("N-BK7").unwrap());
    let shared: Arc<dyn Primitive> = Arc::new(Sphere::new(0.75).unwrap());
    for x in 0..3 {
        let place = translate(f64::from(x), 0.0, 0.0);
        world.add(ball.material(glass.clone()).transform(place)).unwrap();
        world.add(shared.clone().material(schott("N-BK7").unwrap()).transform(place)).unwrap();
    }
    let text = text_of(&world);
    assert_eq!((count(&text, "\"Sphere\""), count(&text, "\"Dielectric\"")), (2, 1));
    assert_eq!((count(&text, "\"Sellmeier\""), count(&text, "\"InterpolatedSf\"")), (1, 1));

    let read = read(&text).unwrap().world;
    let shapes: Vec<Arc<dyn Primitive>> =
        read.primitives().iter().map(|&n| read.primitive(n).unwrap().unwrap().clone()).collect();
    assert!(Arc::ptr_eq(&shapes[0], &shapes[2]) && Arc::ptr_eq(&shapes[1], &shapes[5]));
    assert!(!Arc::ptr_eq(&shapes[0], &shapes[1]));
    let instances = &read.scene().unwrap().instances;
    assert!(Arc::ptr_eq(&instances[0].attached, &instances[5].attached));
    assert_eq!(text_of(&read), text);
}

#[test]
fn objects_that_differ_by_a_sign_of_zero_stay_apart() {
    let mut world = World::new();
    for zero in [0.0, -0.0] {
        world.add(Sphere::default().material(UniformSurfaceEmitter::new(zero, 1.0))).unwrap();
    }
    let text = text_of(&world);
    assert_eq!((count(&text, "\"value\": 0.0}"), count(&text, "\"value\": -0.0}")), (1, 1), "{text}");
    assert_eq!(text_of(&read(&text).unwrap().world), text);
}
