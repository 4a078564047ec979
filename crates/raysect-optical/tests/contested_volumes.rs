//! Refracting volumes of equal priority: paths find out where they overlap, and not where they only touch.

use raysect_core::{Node, Ray};
use raysect_math::{Point3D, Rng, StreamKey, rotate, translate};
use raysect_optical::{
    Dielectric, Ledger, NullMaterial, Optics, Path, PathSettings, Slicing, UniformSurfaceEmitter,
    WithMaterial, World,
};
use raysect_primitive::{BiConvex, Cuboid, Meniscus, Sphere, Subtract};

/// Glass of an index and a priority.
fn glass(index: f64, priority: i32) -> Dielectric {
    Dielectric::new(index, 0.9).unwrap().priority(priority)
}

fn ball(z: f64, radius: f64) -> Node<Optics> {
    ball_of(z, radius, glass(1.5, 0))
}

fn ball_of(z: f64, radius: f64, material: impl raysect_optical::Material) -> Node<Optics> {
    Sphere::new(radius).unwrap().material(material).transform(translate(0.0, 0.0, z))
}

/// What has become of paths from all around, and from within, that are aimed at a ball about the origin.
fn follow(nodes: impl IntoIterator<Item = Node<Optics>>, reach: f64, count: u64) -> Ledger {
    let mut world = World::new();
    for node in nodes {
        world.add(node).unwrap();
    }
    world.add(Sphere::new(50.0).unwrap().material(UniformSurfaceEmitter::new(1.0, 0.0))).unwrap();
    let slices = Slicing::new(500.0, 501.0, 1, 1).unwrap().slices();
    let settings = PathSettings::default();
    let mut path = Path::new(world.scene().unwrap(), &slices[0], &settings);
    for sample in 0..count {
        let mut rng = Rng::keyed(StreamKey { seed: 5, sample, ..StreamKey::default() });
        let mut point = |size: f64| {
            let mut coordinate = || rng.range(-size, size);
            Point3D::new(coordinate(), coordinate(), coordinate())
        };
        let (from, to) = (point(if sample % 2 == 0 { 10.0 * reach } else { reach }), point(reach));
        path.follow(&Ray::new(from, from.vector_to(to)), rng);
    }
    *path.ledger()
}

#[test]
fn overlapping_balls_are_found_and_named() {
    let found = follow([ball(-0.3, 1.0), ball(0.3, 1.0), ball(9.0, 1.0)], 1.0, 2000);
    assert!(found.contested > 500 && found.inconsistencies == 0, "{found:?}");
    assert_eq!(found.contestants, Some([0, 1]));
}

#[test]
fn a_path_that_begins_in_an_overlap_finds_it() {
    let found = follow([ball(0.0, 40.0), ball(0.0, 30.0)], 0.1, 10);
    assert!(found.contested >= 10, "{found:?}");
}

#[test]
fn priorities_settle_it() {
    let overlap = [ball_of(-0.3, 1.0, glass(1.5, 0)), ball_of(0.3, 1.0, glass(1.7, 1))];
    let found = follow(overlap, 1.0, 2000);
    assert_eq!((found.contested, found.contestants, found.inconsistencies), (0, None, 0), "{found:?}");
}

#[test]
fn what_a_third_one_hides_is_not_contested() {
    let hidden = [ball(-0.3, 1.0), ball(0.3, 1.0), ball_of(0.0, 1.5, glass(1.7, 1))];
    assert_eq!(follow(hidden, 1.5, 2000).contested, 0);
    // A smaller one hides it only where it is.
    let bare = [ball(-0.3, 1.0), ball(0.3, 1.0), ball_of(0.0, 0.4, glass(1.7, 1))];
    let found = follow(bare, 1.0, 2000);
    assert!(found.contested > 500, "{found:?}");
    assert_eq!(found.contestants, Some([0, 1]));
}

#[test]
fn volumes_of_one_material_are_one() {
    let shared = std::sync::Arc::new(glass(1.5, 0));
    let parts = [ball_of(-0.3, 1.0, shared.clone()), ball_of(0.3, 1.0, shared)];
    assert_eq!(follow(parts, 1.0, 2000).contested, 0);
}

#[test]
fn what_does_not_refract_contests_nothing() {
    assert_eq!(follow([ball(-0.3, 1.0), ball_of(0.3, 1.0, NullMaterial)], 1.0, 2000).contested, 0);
}

/// A crown and a flint lens with one common face, a distance [m] apart along their axis, in turned frames.
fn doublet(gap: f64) -> Vec<Node<Optics>> {
    let turn = rotate(17.0, 23.0, 5.0);
    let crown = BiConvex::new(0.1, 0.03, 0.08, 0.11).unwrap();
    // The back of the flint is concave: its vertex at z = 0 is that of the convex front of the crown.
    let flint = Meniscus::new(0.1, 0.02, 0.15, 0.08).unwrap();
    let place = turn * translate(0.0, 0.0, 0.03 + gap);
    vec![crown.material(glass(1.5, 0)).transform(turn), flint.material(glass(1.7, 0)).transform(place)]
}

#[test]
fn the_parts_of_a_cemented_lens_touch() {
    for turned in [false, true] {
        let lens = |gap| {
            let mut nodes = doublet(gap);
            if turned {
                nodes.reverse();
            }
            follow(nodes, 0.06, 40_000)
        };
        let cemented = lens(0.0);
        assert_eq!((cemented.contested, cemented.inconsistencies), (0, 0), "{cemented:?}");
        // A micrometre into each other they do not.
        let pressed = lens(-1e-6);
        assert!(pressed.contested > 1000, "{pressed:?}");
    }
}

#[test]
fn what_fills_a_hole_touches_its_wall() {
    let block = || Cuboid::centred(2.0, 2.0, 2.0).unwrap();
    for size in [1.0, 1.0 + 1e-7] {
        let hole = Subtract::new(block(), Sphere::new(0.7).unwrap()).unwrap().material(glass(1.5, 0));
        let nodes = [hole, ball_of(0.0, 0.7 * size, glass(1.7, 0))];
        let found = follow(nodes, 1.0, 20_000);
        assert_eq!(found.contested > 0, size > 1.0, "{size}: {found:?}");
    }
}
