//! What does not belong together is not added up.

use raysect::observer::ObserverError;
use raysect::prelude::*;

use crate::bits::{CASES, PIXELS, Pictures, camera};
use crate::cornell;

/// A world, and a picture of ten samples of it.
fn begun() -> (World, RgbPipeline2D) {
    let world = CASES[2].world();
    let mut rgb = RgbPipeline2D::new();
    camera(10).observe(&world, &mut rgb).unwrap();
    (world, rgb)
}

#[test]
fn a_late_pipeline_is_refused() {
    let (world, mut rgb) = begun();
    let before = rgb.frame().clone();
    let mut late = RadiancePipeline2D::new();
    let refusal = camera(10).observe(&world, &mut (&mut rgb, &mut late));
    let Err(ObserverError::UnequalPipelines { first, first_samples, second, second_samples }) = refusal
    else {
        panic!("{refusal:?}")
    };
    assert_eq!((first.as_str(), first_samples), ("xyz", 10));
    assert_eq!((second.as_str(), second_samples), ("radiance", 0));
    assert_eq!(*rgb.frame(), before);
    let stopping = camera(1).observe_until(&world, &mut (&mut late, &mut rgb), Stop::samples(20));
    assert!(matches!(stopping, Err(ObserverError::UnequalPipelines { .. })), "{stopping:?}");
    assert_eq!(*rgb.frame(), before);
}

#[test]
fn a_late_pipeline_may_catch_up() {
    let (world, rgb) = begun();
    let mut pictures = Pictures { rgb, radiance: RadiancePipeline2D::new() };
    camera(10).observe(&world, &mut pictures.radiance).unwrap();
    pictures.observe(&camera(10), &world);
    assert!(pictures.bits() == Pictures::of(&camera(20), &world));
}

#[test]
fn a_refused_pipeline_is_still_new() {
    let (world, mut rgb) = begun();
    let mut late = RadiancePipeline2D::new();
    camera(10).observe(&world, &mut (&mut late, &mut rgb)).unwrap_err();
    assert!(
        late.frame().is_empty(),
        "{:?} with {} samples",
        late.frame().shape(),
        late.frame().total_samples()
    );
    camera(10).seed(2).observe(&world, &mut late).unwrap();
}

/// Asserts that a used pipeline is not continued by another observer, and keeps what it has.
#[track_caller]
fn assert_other(what: &str, other: PinholeCamera) {
    let (world, mut rgb) = begun();
    let before = rgb.frame().clone();
    let refusal = other.observe(&world, &mut rgb);
    assert!(matches!(refusal, Err(ObserverError::OtherFrame { .. })), "{what}: {refusal:?}");
    assert_eq!(*rgb.frame(), before, "{what}");
    rgb = RgbPipeline2D::new();
    other.observe(&world, &mut rgb).unwrap();
}

#[test]
fn another_spectrum_is_refused() {
    assert_other("range", camera(10).wavelengths(400.0, 740.0));
    assert_other("bins", camera(10).spectral_bins(16));
    assert_other("slices", camera(10).spectral_rays(2));
}

#[test]
fn another_place_is_refused() {
    assert_other("place", camera(10).transform(translate(0.0, 0.0, -3.2)));
    assert_other("direction", camera(10).transform(translate(0.0, 0.0, -3.3) * rotate(1.0, 0.0, 0.0)));
}

#[test]
fn other_pixels_and_seeds_are_refused() {
    let of = |pixels| cornell::camera(pixels).unwrap().pixel_samples(10).engine(Serial).quiet(true);
    assert_other("pixels", of((10, 12)));
    assert_other("fewer pixels", of((6, 5)));
    assert_other("seed", camera(10).seed(2));
}

#[test]
fn another_field_of_view_is_refused() {
    let place = translate(0.0, 0.0, -3.3);
    let other = PinholeCamera::new(PIXELS, 40.0).unwrap().transform(place);
    assert_other("field of view", other.pixel_samples(10).engine(Serial).quiet(true));
}

#[test]
fn another_etendue_is_refused() {
    let world = CASES[2].world();
    let mut power = PowerPipeline2D::new();
    camera(1).etendue(1e-9).unwrap().observe(&world, &mut power).unwrap();
    let refusal = camera(1).etendue(2e-9).unwrap().observe(&world, &mut power);
    assert!(matches!(refusal, Err(ObserverError::OtherFrame { .. })), "{refusal:?}");
}

#[test]
fn the_same_place_by_another_parent_is_the_same() {
    let (mut world, mut rgb) = begun();
    let cart = world.add(Node::group().transform(translate(0.0, 0.0, -3.3))).unwrap();
    let same = camera(10).transform(AffineMatrix3D::IDENTITY).parent(cart);
    same.observe(&world, &mut rgb).unwrap();
    let mut whole = RgbPipeline2D::new();
    camera(20).observe(&world, &mut whole).unwrap();
    assert_eq!(rgb.frame(), whole.frame());
}

#[test]
fn a_cleared_pipeline_takes_anything() {
    let (world, mut rgb) = begun();
    rgb.frame_mut().clear();
    camera(10).seed(2).observe(&world, &mut rgb).unwrap();
    assert_eq!(rgb.frame().total_samples(), 10 * 120);
}
