//! A cancelled observation keeps what is finished, and can be continued.

use raysect::prelude::*;

use crate::bits::{COUNT, Pictures, SAMPLES, assert_pixels_are_undivided, camera, counts, distinct_counts};
use crate::cornell::{self, Variant};
use crate::engines::Cancelling;

/// Where to cancel, in work items: in the first pass, and twice in the second.
const PLACES: [usize; 3] = [3, 25, 31];

/// The diffuse box.
fn world() -> World {
    cornell::cornell_box(Variant::Diffuse).unwrap()
}

/// An observation cancelled after a number of work items.
fn cancelled(items: usize, world: &World) -> Pictures {
    let token = CancelToken::new();
    let camera = camera(SAMPLES).engine(Cancelling::after(items, &token)).cancelled_by(&token);
    let mut pictures = Pictures::default();
    let report = pictures.observe(&camera, world);
    assert!(report.cancelled && token.is_cancelled());
    assert_eq!(report.samples, pictures.rgb.frame().total_samples());
    assert!(report.samples > 0 && report.samples < SAMPLES * COUNT as u64, "{}", report.samples);
    pictures
}

/// The undivided observation of a number of samples.
fn undivided(samples: u64, world: &World) -> Pictures {
    let mut pictures = Pictures::default();
    pictures.observe(&camera(samples), world);
    pictures
}

/// Asserts that both frames hold, pixel by pixel, what undivided observations hold.
#[track_caller]
fn assert_undivided(pictures: &Pictures, world: &World) {
    assert_pixels_are_undivided(pictures.rgb.frame(), |n| undivided(n, world).rgb.frame().clone());
    assert_pixels_are_undivided(pictures.radiance.frame(), |n| undivided(n, world).radiance.frame().clone());
}

#[test]
fn finished_work_is_kept() {
    let world = world();
    for items in PLACES {
        let pictures = cancelled(items, &world);
        assert_eq!(distinct_counts(pictures.rgb.frame()).len(), 2, "{items}");
        assert_eq!(counts(pictures.rgb.frame()), counts(pictures.radiance.frame()));
        assert_undivided(&pictures, &world);
    }
}

#[test]
fn each_pixel_goes_on_where_it_ended() {
    let world = world();
    for items in PLACES {
        let mut pictures = cancelled(items, &world);
        let before = counts(pictures.rgb.frame());
        pictures.observe(&camera(50), &world);
        let after: Vec<u64> = before.iter().map(|n| n + 50).collect();
        assert_eq!(counts(pictures.rgb.frame()), after);
        assert_undivided(&pictures, &world);
    }
}

#[test]
fn a_rule_of_samples_completes_every_pixel() {
    let world = world();
    let whole = undivided(SAMPLES, &world).bits();
    for items in PLACES {
        let mut pictures = cancelled(items, &world);
        camera(1).observe_until(&world, &mut pictures.both(), Stop::samples(SAMPLES)).unwrap();
        assert_eq!(distinct_counts(pictures.rgb.frame()), [SAMPLES], "cancelled after {items} items");
        assert!(pictures.bits() == whole);
    }
}

#[test]
fn threads_keep_what_they_have_finished() {
    let world = world();
    let token = CancelToken::new();
    let handle = token.clone();
    let camera = camera(100_000).threads(2).unwrap().cancelled_by(&token);
    let mut pictures = Pictures::default();
    let report = std::thread::scope(|scope| {
        scope.spawn(move || {
            std::thread::sleep(std::time::Duration::from_millis(300));
            handle.cancel();
        });
        pictures.observe(&camera, &world)
    });
    assert!(report.cancelled);
    assert_eq!(report.samples, pictures.rgb.frame().total_samples());
    assert!(distinct_counts(pictures.rgb.frame()).len() <= 3);
    let before = counts(pictures.rgb.frame());
    pictures.observe(&self::camera(1), &world);
    assert!(counts(pictures.rgb.frame()).iter().zip(&before).all(|(after, before)| *after == before + 1));
}
