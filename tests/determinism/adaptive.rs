//! Samples that are distributed among the pixels: the same on any engine, and after whatever happened in between.

use raysect::observer::{ObserverError, SpectralReduction, Statepoint};
use raysect::prelude::*;

use crate::bits::{CASES, COUNT, Case, Pictures, assert_pixels_are_undivided, counts, distinct_counts};
use crate::engines::Cancelling;
use crate::folder::Folder;

const CASE: Case = CASES[2];
/// Samples of a pixel in the mean.
const SAMPLES: u64 = 200;

/// Every rule that an RGB pipeline can decide by.
fn rules() -> [AdaptiveSampling; 4] {
    [
        AdaptiveSampling::rgb(SAMPLES),
        AdaptiveSampling::mono(SAMPLES).cutoff(0.1).unwrap(),
        AdaptiveSampling::equal_errors(SAMPLES),
        AdaptiveSampling::total(SAMPLES),
    ]
}

fn adapt(pictures: &mut Pictures, camera: &PinholeCamera, sampling: &AdaptiveSampling) -> RenderReport {
    camera.observe_adaptive(&CASE.world(), &mut pictures.both(), sampling).unwrap()
}

/// An undisturbed observation.
fn adapted(sampling: &AdaptiveSampling) -> Pictures {
    let mut pictures = Pictures::default();
    adapt(&mut pictures, &CASE.camera(1), sampling);
    pictures
}

#[test]
fn every_engine_distributes_samples_alike() {
    for sampling in rules() {
        let whole = adapted(&sampling);
        assert!(distinct_counts(whole.rgb.frame()).len() > 1, "{sampling:?}");
        for threads in [1, 2, 7] {
            let mut pictures = Pictures::default();
            adapt(&mut pictures, &CASE.camera(1).threads(threads).unwrap(), &sampling);
            assert!(pictures.bits() == whole.bits(), "{threads} threads, {sampling:?}");
        }
    }
}

#[test]
fn each_pixel_has_the_bits_of_as_many_samples() {
    let pictures = adapted(&AdaptiveSampling::total(SAMPLES));
    assert_eq!(counts(pictures.rgb.frame()), counts(pictures.radiance.frame()));
    assert_pixels_are_undivided(pictures.radiance.frame(), |samples| {
        let mut undivided = Pictures::default();
        undivided.observe(&CASE.camera(samples), &CASE.world());
        undivided.radiance.frame().clone()
    });
}

#[test]
fn samples_are_as_many_as_allowed_and_the_pilot_is_bounded() {
    for sampling in rules() {
        let mut pictures = Pictures::default();
        let report = adapt(&mut pictures, &CASE.camera(1), &sampling);
        let (taken, allowed) = (pictures.rgb.frame().total_samples(), SAMPLES * COUNT as u64);
        assert_eq!(report.samples, taken);
        assert!(taken <= allowed && report.pilot_samples <= taken / 16 * 5, "{report}");
        match report.convergence {
            None => assert!(taken + COUNT as u64 > allowed, "{taken} of {allowed}"),
            Some(convergence) => assert_eq!(convergence.elements, COUNT),
        }
        let least = counts(pictures.rgb.frame()).into_iter().min();
        assert!(least >= Some(SAMPLES / 4), "{least:?}");
    }
}

#[test]
fn what_is_there_already_is_counted_in() {
    let sampling = AdaptiveSampling::rgb(SAMPLES);
    let whole = adapted(&sampling);
    let mut pictures = Pictures::default();
    pictures.observe(&CASE.camera(37), &CASE.world());
    adapt(&mut pictures, &CASE.camera(1), &sampling);
    assert!(pictures.bits() == whole.bits());
    // Nothing is missing any more.
    assert_eq!(adapt(&mut pictures, &CASE.camera(1), &sampling).samples, 0);
    assert!(pictures.bits() == whole.bits());
}

#[test]
fn an_interrupted_observation_goes_on_from_its_file() {
    let (folder, world) = (Folder::new("adaptive"), CASE.world());
    let sampling = AdaptiveSampling::rgb(SAMPLES);
    let whole = adapted(&sampling);
    let mut places = [0; 2];
    // After more and more work items, until there are no more.
    for items in (2..).step_by(7) {
        let token = CancelToken::new();
        let path = folder.join(&format!("state{items}"));
        let camera = CASE.camera(1).statepoint(&path);
        let stopped = camera.clone().engine(Cancelling::after(items, &token)).cancelled_by(&token);
        let report = adapt(&mut Pictures::default(), &stopped, &sampling);
        if !report.cancelled {
            break;
        }
        // In the pilot, there is no file yet.
        assert_eq!(path.exists(), report.samples > 0, "{items}: {report}");
        places[usize::from(path.exists())] += 1;
        let mut pictures = Pictures::default();
        assert_eq!(camera.resume(&world, &mut pictures.both()).unwrap(), path.exists());
        assert_eq!(pictures.rgb.frame().total_samples(), report.samples);
        adapt(&mut pictures, &camera, &sampling);
        assert!(pictures.bits() == whole.bits(), "{items}");
        let mut again = Pictures::default();
        Statepoint::load(&path).unwrap().restore(&camera, &world, &mut again.both()).unwrap();
        assert!(again.bits() == whole.bits(), "{items}");
    }
    assert!(places.iter().all(|&count| count > 1), "{places:?}");
}

#[test]
fn lanes_and_regions_put_together_have_the_bits_of_the_whole() {
    let (world, sampling) = (CASE.world(), AdaptiveSampling::total(SAMPLES));
    let lane = |number: u64| {
        let (mut pictures, camera) = (Pictures::default(), CASE.camera(1).lane(number, 2).unwrap());
        adapt(&mut pictures, &camera, &sampling);
        Statepoint::of(&camera, &world, &mut pictures.both()).unwrap()
    };
    let mut whole = Pictures::default();
    for number in [0, 1] {
        adapt(&mut whole, &CASE.camera(1).lane(number, 2).unwrap(), &sampling);
    }
    let mut merged = lane(1);
    merged.merge(&lane(0)).unwrap();
    let mut pictures = Pictures::default();
    merged.restore(&CASE.camera(1).lane(0, 2).unwrap(), &world, &mut pictures.both()).unwrap();
    assert!(pictures.bits() == whole.bits());
    assert!(distinct_counts(whole.rgb.frame()).len() > 3);
    // A part of the picture distributes its own samples, and the rest has none.
    let camera = CASE.camera(1).region(3..9, 2..7).unwrap();
    let mut part = Pictures::default();
    let report = adapt(&mut part, &camera, &sampling);
    assert!(report.samples <= 30 * SAMPLES && report.samples > 30 * (SAMPLES - 1));
    assert_eq!(counts(part.rgb.frame()).iter().filter(|&&n| n > 0).count(), 30);
}

#[test]
fn what_cannot_decide_is_refused() {
    let (world, camera) = (CASE.world(), CASE.camera(1));
    let mut radiance = RadiancePipeline2D::new();
    for sampling in [AdaptiveSampling::rgb(10), AdaptiveSampling::spectral(10, SpectralReduction::default())]
    {
        let error = camera.observe_adaptive(&world, &mut radiance, &sampling).unwrap_err();
        assert!(matches!(error, ObserverError::Adaptive { channels: 1, .. }), "{error}");
    }
    let none = camera.observe_adaptive(&world, &mut radiance, &AdaptiveSampling::mono(0)).unwrap_err();
    assert!(none.to_string().contains("samples"), "{none}");
    let mono = AdaptiveSampling::mono(10);
    for wrong in [mono.fraction(0.0), mono.fraction(1.1), mono.fraction(f64::NAN), mono.ratio(0.9)] {
        assert!(wrong.is_err());
    }
    assert!(mono.cutoff(-0.1).is_err() && mono.cutoff(1.1).is_err() && mono.min_samples(0).is_err());
    let mut spectral = SpectralRadiancePipeline2D::new();
    let reduction = SpectralReduction::Percentile(101.0);
    let sampling = AdaptiveSampling::spectral(10, reduction);
    assert!(camera.observe_adaptive(&world, &mut spectral, &sampling).is_err());
}

#[test]
fn spectra_decide_by_their_bins() {
    let (world, camera) = (CASE.world(), CASE.camera(1));
    let counts_by = |reduction: SpectralReduction| {
        let mut spectral = SpectralRadiancePipeline2D::new();
        let sampling = AdaptiveSampling::spectral(64, reduction);
        camera.observe_adaptive(&world, &mut spectral, &sampling).unwrap();
        counts(spectral.frame())
    };
    let worst = counts_by(SpectralReduction::Percentile(100.0));
    assert!(worst == counts_by(SpectralReduction::PowerPercentile(100.0)));
    assert!(worst != counts_by(SpectralReduction::Weighted));
}
