//! Whatever happens to a file, reading it never panics.

use std::panic::{AssertUnwindSafe, catch_unwind};

use raysect::math::Rng;
use raysect::prelude::*;
use raysect::save::SceneWriter;

use crate::cornell::{self, Variant};
use crate::{read, text_of};

/// What is put in the place of something else.
const PIECES: [&str; 24] = [
    "0",
    "-1",
    "1e308",
    "-0.0",
    "1e999",
    "18446744073709551615",
    "9223372036854775807",
    "null",
    "true",
    "\"\"",
    "[]",
    "{}",
    "[[]]",
    "\"Sphere\"",
    "\"Cuboid\"",
    "\"shape\"",
    "\"material\"",
    ",",
    ":",
    "}",
    "]",
    "\\",
    "\u{0}",
    "é",
];

/// The scene whose text is damaged: small, with an object of every kind.
fn text() -> String {
    let mut world = World::new();
    let room = world.add(Node::group().name("room").transform(rotate(10.0, 0.0, 0.0))).unwrap();
    let table = InterpolatedSf::new([400.0, 500.0], [0.25, 0.75]).unwrap();
    world.add(Sphere::default().material(Lambert::new(table.clone())).parent(room).meta("x", 1.5)).unwrap();
    let board = Checkerboard::new(0.5).unwrap().spectra((table.clone(), 1.0), (0.5, 2.0));
    world.add(Cuboid::default().material(board).parent(room)).unwrap();
    let sellmeier = Sellmeier::new([1.0, 0.2, 1.0], [0.006, 0.02, 103.0]).unwrap();
    world.add(Cuboid::default().material(Dielectric::new(sellmeier, table).unwrap())).unwrap();
    world.add(Sphere::default().material(UniformSurfaceEmitter::new(1.0, 2.0))).unwrap();
    let camera = world.add(Node::observer().name("seat")).unwrap();
    let mut writer = SceneWriter::new(&world).unwrap();
    let pinhole = PinholeCamera::new((2, 3), 45.0).unwrap().parent(camera);
    writer.keep("camera", &pinhole.etendue_map(vec![1.0; 6]).unwrap()).unwrap();
    writer.keep("rgb", &RgbPipeline2D::new()).unwrap();
    writer.keep("power", &PowerPipeline2D::new().filter(0.5)).unwrap();
    let bands = FunctionalPipeline::power().band("blue", 400.0, 500.0).unwrap().functional("half", 0.5);
    writer.keep("bands", &bands).unwrap();
    writer.keep("bayer", &BayerPipeline2D::new(0.5, 0.25, 1.0)).unwrap();
    writer.to_json()
}

/// True for characters that belong to one word or number.
fn is_word(c: char) -> bool {
    c.is_ascii_alphanumeric() || "_.-+\"".contains(c)
}

/// The text with one or a few random faults.
fn damaged(text: &str, rng: &mut Rng) -> String {
    let mut chars: Vec<char> = text.chars().collect();
    for _ in 0..=(rng.uniform() * 3.0) as usize {
        if chars.is_empty() {
            break;
        }
        let at = |rng: &mut Rng, n: usize| (rng.uniform() * n as f64) as usize;
        let place = at(rng, chars.len());
        let piece: Vec<char> = PIECES[at(rng, PIECES.len())].chars().collect();
        let left = chars[..place].iter().rposition(|&c| !is_word(c)).map_or(0, |i| i + 1);
        let right = chars[place..].iter().position(|&c| !is_word(c)).map_or(chars.len(), |i| place + i);
        match at(rng, 6) {
            // A whole word or number becomes another.
            0..=2 if left < right => drop(chars.splice(left..right, piece)),
            // Something is left out, doubled, or cut off.
            3 => drop(chars.drain(place..(place + at(rng, 40)).min(chars.len()))),
            4 => {
                let copy = chars[place..(place + at(rng, 80)).min(chars.len())].to_vec();
                drop(chars.splice(place..place, copy));
            }
            5 if rng.uniform() < 0.1 => chars.truncate(place),
            _ => chars[place] = char::from(32 + at(rng, 95) as u8),
        }
    }
    chars.into_iter().collect()
}

/// Reads all there is, and writes it again; true if it was a scene.
fn use_up(text: &str) -> bool {
    let Ok(scene) = read(text) else { return false };
    let camera = scene.get::<PinholeCamera>("camera");
    let _ = (scene.get::<RgbPipeline2D>("rgb"), scene.get::<PowerPipeline2D>("power"), scene.world.scene());
    let _ = (scene.get::<FunctionalPipeline>("bands"), scene.get::<BayerPipeline2D>("bayer"));
    if let Ok(camera) = camera {
        let _ = camera.to_root(&scene.world);
    }
    // What was read once can be saved and read again.
    let again = text_of(&scene.world);
    assert_eq!(text_of(&read(&again).unwrap().world), again);
    true
}

/// How many of the damaged texts were still scenes, and the first that panicked.
fn survivors(text: &str, count: usize, seed: u64, reader: impl Fn(&str) -> bool) -> Result<usize, String> {
    let mut rng = Rng::new(seed);
    let mut accepted = 0;
    for _ in 0..count {
        let wrong = damaged(text, &mut rng);
        match catch_unwind(AssertUnwindSafe(|| reader(&wrong))) {
            Ok(scene) => accepted += usize::from(scene),
            Err(_) => return Err(wrong),
        }
    }
    Ok(accepted)
}

#[test]
fn no_damage_makes_reading_panic() {
    let accepted = survivors(&text(), 20_000, 1, use_up).unwrap_or_else(|text| panic!("{text}"));
    // Some faults must get as far as the constructors, and most must be found.
    assert!((20..10_000).contains(&accepted), "{accepted}");
}

#[test]
fn no_damage_to_the_cornell_box_makes_reading_panic() {
    let text = text_of(&cornell::cornell_box(Variant::Glass).unwrap());
    survivors(&text, 1000, 2, use_up).unwrap_or_else(|text| panic!("{text}"));
}

#[test]
fn a_reader_that_panics_is_found() {
    let careless = |text: &str| {
        let scene = read(text);
        assert!(scene.is_ok(), "on purpose");
        true
    };
    assert!(survivors(&text(), 100, 3, careless).is_err());
}
