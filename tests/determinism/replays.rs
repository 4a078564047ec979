//! One sample followed again, from nothing but its numbers.

use raysect::observer::ObserverError;
use raysect::prelude::*;

/// Columns and rows, samples of a pixel (more than one block of strata), and bins.
const PIXELS: (usize, usize) = (3, 2);
const SAMPLES: u64 = 70;
const BINS: usize = 6;

/// Glass that disperses, a rough metal, fog, and a lamp that is looked for.
fn world() -> World {
    let mut world = World::new();
    let floor = Cuboid::new(Point3D::new(-5.0, -2.0, -5.0), Point3D::new(5.0, -1.0, 5.0)).unwrap();
    let ball = |radius| Sphere::new(radius).unwrap();
    let fog = UniformVolume::new().absorption(0.05).scattering(0.3, HenyeyGreenstein::new(0.4).unwrap());
    for node in [
        floor.material(Lambert::new(|w: f64| w / 1000.0)).name("floor"),
        ball(0.7).material(schott("SF11").unwrap()).transform(translate(0.7, 0.0, 0.0)).name("glass"),
        ball(0.7)
            .material(RoughConductor::new(1.0, 4.0, 0.3).unwrap())
            .transform(translate(-0.8, 0.0, 0.3))
            .name("metal"),
        ball(1.5).material(fog).transform(translate(0.0, 0.5, 2.0)).name("fog"),
        ball(0.5)
            .material(UniformSurfaceEmitter::new(1.0, 9.0))
            .transform(translate(0.0, 4.0, -1.0))
            .name("lamp"),
    ] {
        world.add(node).unwrap();
    }
    world
}

fn set_up<S: Sensor>(observer: Observer<S>) -> Observer<S> {
    observer.wavelengths(400.0, 700.0).spectral_bins(BINS).pixel_samples(SAMPLES).engine(Serial).quiet(true)
}

fn camera() -> PinholeCamera {
    set_up(PinholeCamera::new(PIXELS, 40.0).unwrap().transform(translate(0.0, 0.2, -4.0)))
}

/// The mean of weight × radiance over all samples of a pixel, replayed.
fn replayed<S: Sensor>(observer: &Observer<S>, world: &World, pixel: usize) -> Vec<f64> {
    let mut means = vec![0.0; BINS];
    for sample in 0..SAMPLES {
        for Replay { offset, weight, path, .. } in observer.replay(world, pixel, sample).unwrap() {
            let bins = means[offset..].iter_mut().zip(&path.radiance);
            bins.for_each(|(mean, radiance)| *mean += weight * radiance / SAMPLES as f64);
        }
    }
    means
}

/// The largest relative difference of two spectra.
fn off(one: &[f64], other: &[f64]) -> f64 {
    one.iter().zip(other).map(|(a, b)| (a - b).abs() / b.abs().max(1e-300)).fold(0.0, f64::max)
}

/// Observes, replays some pixels, and answers with what was seen at each.
fn judge<S: Sensor>(observer: &Observer<S>, pixels: impl IntoIterator<Item = usize>) -> Vec<Vec<f64>> {
    let (world, mut radiance) = (world(), SpectralRadiancePipeline2D::new());
    observer.observe(&world, &mut radiance).unwrap();
    let seen = pixels.into_iter().map(|pixel| {
        let (spectrum, again) = (radiance.spectrum(pixel), replayed(observer, &world, pixel));
        assert!(spectrum.iter().all(|r| *r > 0.0), "pixel {pixel}: {spectrum:?}");
        assert!(off(&again, &spectrum) < 1e-12, "pixel {pixel}: {again:?} for {spectrum:?}");
        spectrum
    });
    seen.collect()
}

#[test]
fn the_samples_of_a_pixel_make_its_mean() {
    let one = judge(&camera(), 0..6);
    let other = judge(&camera().lane(2, 4).unwrap(), [4]);
    let sliced = judge(&camera().spectral_rays(4), [4, 5]);
    // Other samples, and so nothing that would agree by chance.
    assert!(off(&other[0], &one[4]) > 1e-6 && off(&sliced[0], &one[4]) > 1e-6);
}

#[test]
fn masks_and_seeds_are_those_of_the_observation() {
    let region = camera().region(1..3, 1..2).unwrap();
    let (part, whole) = (judge(&region, [4, 5]), judge(&camera(), [4, 5]));
    assert_eq!(part, whole);
    assert!(off(&judge(&camera().seed(7), [4])[0], &whole[0]) > 1e-6);
}

#[test]
fn weights_of_sensors_are_told() {
    let pixel = Pixel::new(0.3, 0.2).unwrap().transform(translate(0.0, 0.2, -4.0));
    judge(&set_up(pixel.clone()), [0]);
    let lamp = Target::sphere(Point3D::new(0.0, 3.8, 3.0), 0.6).unwrap();
    let aimed = set_up(pixel.targets([lamp], 0.7).unwrap());
    judge(&aimed, [0]);
    let weights: Vec<f64> =
        (0..9).map(|sample| aimed.replay(&world(), 0, sample).unwrap()[0].weight).collect();
    assert!(weights.iter().any(|w| *w != weights[0]), "{weights:?}");
}

#[test]
fn a_continued_observation_is_replayed_with_its_number_of_samples() {
    let (world, mut radiance) = (world(), SpectralRadiancePipeline2D::new());
    let half = camera().pixel_samples(SAMPLES / 2);
    half.observe(&world, &mut radiance).unwrap();
    half.observe(&world, &mut radiance).unwrap();
    let all = half.pixel_samples(radiance.frame().samples(3));
    assert!(off(&replayed(&all, &world, 3), &radiance.spectrum(3)) < 1e-12);
}

#[test]
fn replays_tell_names_and_slices() {
    let (world, camera) = (world(), camera().spectral_rays(4));
    let all = camera.replay(&world, 4, 11).unwrap();
    assert_eq!(all.iter().map(|r| (r.slice, r.offset)).collect::<Vec<_>>(), [(0, 0), (1, 2), (2, 3), (3, 4)]);
    assert_eq!(all.iter().map(|r| r.path.radiance.len()).sum::<usize>(), BINS);
    let names = all.iter().flat_map(|r| &r.path.vertices).filter_map(|v| v.hit.as_ref());
    assert!(names.clone().count() > 0 && names.clone().all(|hit| !hit.name.is_empty()));
    assert!(all == camera.replay(&world, 4, 11).unwrap() && all != camera.replay(&world, 4, 12).unwrap());
}

#[test]
fn what_was_never_observed_is_refused() {
    let (world, camera) = (world(), camera());
    let refusal = |camera: &PinholeCamera, pixel, sample| camera.replay(&world, pixel, sample).unwrap_err();
    let error = refusal(&camera, 6, 0);
    assert!(matches!(error, ObserverError::NoPixel { pixel: 6, .. }));
    assert!(error.to_string().starts_with("pixel 6 of 3×2 pixels"), "{error}");
    let error = refusal(&camera, 5, SAMPLES);
    assert!(matches!(error, ObserverError::NoSample { sample: 70, samples: 70 }));
    assert!(error.to_string().starts_with("sample 70 of 70 a pixel"), "{error}");
    let masked = refusal(&camera.clone().region(1..3, 1..2).unwrap(), 0, 0);
    assert!(matches!(masked, ObserverError::MaskedPixel { pixel: 0 }));
    assert!(camera.replay(&world, 5, SAMPLES - 1).is_ok());
}
