//! Statepoints give every bit back, and nothing else is taken for one.

use std::fs;

use raysect::observer::{ObserverError, Statepoint, StatepointError};
use raysect::prelude::*;

use crate::bits::{CASES, Case, Pictures, SAMPLES, camera};
use crate::folder::Folder;

const CASE: Case = CASES[2];

/// A world, and the file of a picture of 50 samples of it.
fn begun(folder: &Folder) -> (World, PinholeCamera, std::path::PathBuf) {
    let (world, path) = (CASE.world(), folder.join("state"));
    let camera = CASE.camera(50).statepoint(&path);
    Pictures::default().observe(&camera, &world);
    (world, camera, path)
}

fn refusal(path: &std::path::Path) -> StatepointError {
    match Statepoint::load(path) {
        Err(ObserverError::Statepoint(error)) => error,
        other => panic!("{other:?}"),
    }
}

#[test]
fn an_observation_goes_on_from_the_file_with_the_same_bits() {
    let folder = Folder::new("resume");
    let (world, camera, _) = begun(&folder);
    let mut pictures = Pictures::default();
    assert!(camera.resume(&world, &mut pictures.both()).unwrap());
    assert_eq!(pictures.rgb.frame().samples(0), 50);
    camera.observe_until(&world, &mut pictures.both(), Stop::samples(SAMPLES)).unwrap();
    assert!(pictures.bits() == Pictures::of(&CASE.camera(SAMPLES), &world));
    // The file has followed.
    let mut again = Pictures::default();
    assert!(camera.resume(&world, &mut again.both()).unwrap());
    assert!(again.bits() == pictures.bits());
}

#[test]
fn without_a_file_nothing_is_resumed() {
    let folder = Folder::new("none");
    let mut pictures = Pictures::default();
    let camera = CASE.camera(1).statepoint(folder.join("state"));
    assert!(!camera.resume(&CASE.world(), &mut pictures.both()).unwrap());
    assert!(pictures.rgb.frame().is_empty());
}

#[test]
fn truncated_files_are_refused_at_any_length() {
    let folder = Folder::new("truncated");
    let (_, _, path) = begun(&folder);
    let whole = fs::read(&path).unwrap();
    for length in [8, 9, 11, 12, 19, 20, 24, 100, whole.len() / 2, whole.len() - 1] {
        fs::write(&path, &whole[..length]).unwrap();
        let error = refusal(&path);
        assert!(matches!(error, StatepointError::Length { .. }), "{length} bytes: {error}");
    }
    fs::write(&path, [&whole[..], &[0]].concat()).unwrap();
    assert!(matches!(refusal(&path), StatepointError::Length { .. }));
    fs::write(&path, &whole).unwrap();
    assert!(Statepoint::load(&path).is_ok());
}

#[test]
fn foreign_and_damaged_files_are_refused() {
    let folder = Folder::new("foreign");
    let (_, _, path) = begun(&folder);
    let whole = fs::read(&path).unwrap();
    for other in [&b""[..], b"P", b"PK\x03\x04 an archive", b"\x89PNG\r\n\x1a\n"] {
        fs::write(&path, other).unwrap();
        assert!(matches!(refusal(&path), StatepointError::Foreign { .. }));
    }
    let mut next = whole.clone();
    next[8] += 1;
    fs::write(&path, &next).unwrap();
    assert!(matches!(refusal(&path), StatepointError::Version { found: 3, known: 2, .. }));
    for at in (20..whole.len()).step_by(whole.len() / 23) {
        for bit in [0, 7] {
            let mut damaged = whole.clone();
            damaged[at] ^= 1 << bit;
            fs::write(&path, &damaged).unwrap();
            assert!(matches!(refusal(&path), StatepointError::Checksum { .. }), "byte {at}");
        }
    }
}

/// What is said when another observation wants to go on.
fn resumed_by(camera: PinholeCamera, world: &World, path: &std::path::Path) -> ObserverError {
    let mut pictures = Pictures::default();
    let result = camera.statepoint(path).resume(world, &mut pictures.both());
    assert!(pictures.rgb.frame().is_empty());
    result.unwrap_err()
}

#[test]
fn other_observations_do_not_go_on() {
    let folder = Folder::new("other");
    let (world, _, path) = begun(&folder);
    for other in
        [CASE.camera(1).seed(2), CASE.camera(1).spectral_bins(14), CASE.camera(1).lane(0, 2).unwrap()]
    {
        assert!(matches!(resumed_by(other, &world, &path), ObserverError::OtherFrame { .. }));
    }
    let is_scene = |error: &ObserverError| {
        matches!(error, ObserverError::Statepoint(StatepointError::OtherScene { .. }))
    };
    let shallow = camera(1).paths(PathSettings::default().max_depth(3));
    assert!(is_scene(&resumed_by(shallow, &world, &path)));
    let mut changed = CASE.world();
    changed.add(Sphere::new(0.01).unwrap().material(Lambert::new(0.5))).unwrap();
    assert!(is_scene(&resumed_by(camera(1), &changed, &path)));
    let mut alone = RgbPipeline2D::new();
    let error = camera(1).statepoint(&path).resume(&world, &mut alone).unwrap_err();
    let names = matches!(error, ObserverError::Statepoint(StatepointError::OtherPipelines { .. }));
    assert!(names, "{error}");
}

#[test]
fn pipelines_of_one_kind_are_told_apart_by_their_names() {
    let folder = Folder::new("names");
    let (world, path) = (CASE.world(), folder.join("state"));
    let camera = CASE.camera(10).statepoint(&path);
    let whole = || RadiancePipeline2D::new();
    let red = || RadiancePipeline2D::new().filter(|w: f64| f64::from(w > 600.0)).named("red");
    let refused = camera.observe(&world, &mut (&mut whole(), &mut red().named("radiance")));
    assert!(matches!(refused, Err(ObserverError::SameName(..))), "{refused:?}");
    assert!(!path.exists());
    camera.observe(&world, &mut (&mut whole(), &mut red())).unwrap();
    let swapped = camera.resume(&world, &mut (&mut red(), &mut whole()));
    let refused = swapped.map_err(|error| error.to_string()).unwrap_err();
    assert!(refused.contains("red [W/m²/sr]"), "{refused}");
    let (mut all, mut part) = (whole(), red());
    assert!(camera.resume(&world, &mut (&mut all, &mut part)).unwrap());
    assert!(part.frame().total().value < all.frame().total().value && part.frame().name() == "red");
}

#[test]
fn a_scene_with_a_closure_in_it_is_known_by_all_else() {
    let folder = Folder::new("closure");
    let world = |white: f64, length: f64| {
        let mut world = CASE.world();
        let ball = Sphere::new(0.1).unwrap().material(Lambert::new(white));
        world.add(ball.transform(translate(0.0, 0.3, 0.0))).unwrap();
        let glow = InhomogeneousVolumeEmitter::length_scale(length, |_, _, _, out| out.fill(1.0)).unwrap();
        let ball = Sphere::new(0.1).unwrap().material(glow);
        world.add(ball.transform(translate(0.0, -0.3, 0.0)).meta("rate", 0.5)).unwrap();
        world
    };
    let camera = CASE.camera(10).statepoint(folder.join("state"));
    camera.observe(&world(0.5, 0.1), &mut RadiancePipeline2D::new()).unwrap();
    let resume = |world: &World| camera.resume(world, &mut RadiancePipeline2D::new());
    assert!(resume(&world(0.5, 0.1)).unwrap());
    let refused = resume(&world(0.6, 0.1)).map_err(|error| error.to_string()).unwrap_err();
    assert!(refused.contains("description"), "{refused}");
    // What the closure does is not known, nor what goes with it.
    assert!(resume(&world(0.5, 0.2)).unwrap());
}
