//! The Cornell box before and after.

use raysect::prelude::*;
use raysect::save::{SavedScene, SceneWriter, registry};

use crate::cornell::{self, Variant};
use crate::{read, text_of};

/// The numbers of a small picture, as bits.
fn bits(camera: &PinholeCamera, world: &World) -> Vec<u64> {
    let (mut rgb, mut radiance) = (RgbPipeline2D::new(), RadiancePipeline2D::new());
    camera.observe(world, &mut (&mut rgb, &mut radiance)).unwrap();
    let frames = [rgb.frame(), radiance.frame()];
    frames.into_iter().flat_map(|f| f.mean().into_iter().chain(f.error())).map(f64::to_bits).collect()
}

fn camera() -> PinholeCamera {
    cornell::camera((12, 10)).unwrap().pixel_samples(40).spectral_rays(3).quiet(true)
}

#[test]
fn what_is_read_is_written_as_the_same_text() {
    for variant in [Variant::Glass, Variant::Diffuse] {
        let text = text_of(&cornell::cornell_box(variant).unwrap());
        let once = read(&text).unwrap().world;
        assert_eq!(text_of(&once), text);
    }
}

#[test]
fn pictures_are_the_same_to_the_last_bit() {
    for variant in [Variant::Glass, Variant::Diffuse] {
        let world = cornell::cornell_box(variant).unwrap();
        let mut writer = SceneWriter::new(&world).unwrap();
        writer.keep("camera", &camera()).unwrap();
        let scene = read(&writer.to_json()).unwrap();
        assert_eq!(scene.world.tree(), world.tree());
        let expected = bits(&camera(), &world);
        assert_eq!(bits(&scene.get("camera").unwrap(), &scene.world), expected);
    }
}

#[test]
fn one_changed_number_is_seen() {
    let world = cornell::cornell_box(Variant::Glass).unwrap();
    let text = text_of(&world);
    // The radius of the ball, the first place of the lamp, the scale of its spectrum.
    for (old, new) in
        [("\"radius\": 0.4", "\"radius\": 0.4000001"), ("\"scale\": 2.0", "\"scale\": 2.0000001")]
    {
        assert_eq!(text.matches(old).count(), 1, "{old} in {text}");
        let changed = read(&text.replace(old, new)).unwrap().world;
        assert_ne!(bits(&camera(), &changed), bits(&camera(), &world), "{old}");
    }
}

#[test]
fn nodes_are_found_again() {
    let world = cornell::cornell_box(Variant::Glass).unwrap();
    let scene = read(&text_of(&world)).unwrap();
    let names = |world: &World| -> Vec<String> {
        world.primitives().into_iter().map(|node| world.name(node).unwrap().to_owned()).collect()
    };
    assert_eq!(names(&scene.world), names(&world));
    for name in ["room", "ball", "lamp"] {
        let (before, after) = (world.find(name).unwrap(), scene.world.find(name).unwrap());
        assert_eq!(world.transform(before).unwrap(), scene.world.transform(after).unwrap());
        // Ids belong to their world.
        assert!(world.transform(after).is_err());
    }
    assert_eq!(scene.node(0), Some(scene.world.root()));
    assert_eq!((scene.node(1), scene.node(99)), (scene.world.find("room"), None));
}

#[test]
fn files_are_written_and_read() {
    let path = std::env::temp_dir().join(format!("raysect-saving-{}.json", std::process::id()));
    let world = cornell::cornell_box(Variant::Diffuse).unwrap();
    let writer = SceneWriter::new(&world).unwrap();
    writer.save(&path).unwrap();
    let read = SavedScene::load(&path, &registry()).unwrap();
    assert_eq!(text_of(&read.world), writer.to_json());

    std::fs::write(&path, "{\n\"format\": \"raysect scene\",\n\"version\": }").unwrap();
    let message = SavedScene::load(&path, &registry()).unwrap_err().to_string();
    assert!(message.starts_with(&format!("{}: line 3, column 12: ", path.display())), "{message}");
    std::fs::remove_file(&path).unwrap();
    let message = SavedScene::load(&path, &registry()).unwrap_err().to_string();
    assert!(message.starts_with(&path.display().to_string()), "{message}");
}
