//! What is set to an observer can be read back.

use raysect_core::Node;
use raysect_math::{AffineMatrix3D, translate};
use raysect_observer::PinholeCamera;
use raysect_optical::{PathSettings, World};

#[test]
fn settings_of_an_observer_can_be_read_back() {
    let camera = PinholeCamera::new((2, 2), 40.0).unwrap();
    assert_eq!((camera.samples_per_observation(), camera.seed_value()), (100, 1));
    assert_eq!((camera.chosen_transform(), camera.chosen_parent()), (&AffineMatrix3D::IDENTITY, None));
    assert_eq!((camera.chosen_mask(), camera.path_settings()), (None, &PathSettings::default()));
    let mut world = World::new();
    let node = world.add(Node::group()).unwrap();
    let (place, paths) = (translate(1.0, 2.0, 3.0), PathSettings::default().max_depth(7));
    let camera = camera.pixel_samples(30).seed(8).transform(place).parent(node).paths(paths.clone());
    let camera = camera.region(0..2, 1..2).unwrap();
    assert_eq!((camera.samples_per_observation(), camera.seed_value()), (30, 8));
    assert_eq!((camera.chosen_transform(), camera.chosen_parent()), (&place, Some(node)));
    assert_eq!(camera.chosen_mask(), Some(&[false, false, true, true][..]));
    assert_eq!(camera.path_settings(), &paths);
}
