//! Samples that are distributed among the pixels: without bias, with right error bars, and where they are needed.

use raysect::math::Rng;
use raysect::observer::{FrameShape, RadiancePipeline};
use raysect::prelude::*;

use crate::score::Averages;
use crate::seeds::each_seed;
use crate::sensors::{glimpses, lamp_at};

/// Pixels of the pictures, all alike.
const PIXELS: usize = 64;
/// Probability of a bright sample, and samples a pixel: so many that a picture has a hundred bright ones.
const CASES: [(f64, u64); 3] = [(0.1, 100), (0.01, 300), (0.001, 2000)];
const SEEDS: u64 = 1000;

/// Averages over pictures of samples of 1 / `probability` with this probability, and 0 otherwise: their mean is 1.
fn averages(probability: f64, seeds: u64, observe: impl Fn(&World, u64) -> Frame + Sync) -> Averages {
    let world = lamp_at(5.0, 1.0 / probability);
    let all = each_seed(1..seeds + 1, |seed| {
        let frame = observe(&world, seed);
        (frame.average_of(0), frame.total_samples())
    });
    Averages::of(&all, 1.0)
}

/// Pictures whose samples the library distributes.
fn adaptive(probability: f64, sampling: AdaptiveSampling) -> Averages {
    averages(probability, SEEDS, |world, seed| {
        let mut radiance = RadiancePipeline::new();
        let observer = glimpses(probability, FrameShape::Line(PIXELS)).seed(seed);
        observer.observe_adaptive(world, &mut radiance, &sampling).unwrap();
        radiance.frame().clone()
    })
}

/// Asserts that pictures have no bias and right error bars.
#[track_caller]
fn assert_unbiased(probability: f64, sampling: AdaptiveSampling) {
    let averages = adaptive(probability, sampling);
    println!("one in {:<5} {averages}\n  by {sampling:?}", 1.0 / probability);
    assert!(averages.holds(), "one in {}: {averages}\n{sampling:?}", 1.0 / probability);
}

#[test]
fn pictures_of_rare_bright_samples_have_no_bias() {
    for (probability, samples) in CASES {
        assert_unbiased(probability, AdaptiveSampling::mono(samples));
    }
    // The rarest take longest.
    for (probability, samples) in &CASES[..2] {
        assert_unbiased(*probability, AdaptiveSampling::equal_errors(*samples));
        assert_unbiased(*probability, AdaptiveSampling::total(*samples));
    }
}

#[test]
fn an_end_by_the_cutoff_makes_no_bias() {
    let averages = adaptive(0.1, AdaptiveSampling::mono(300).cutoff(0.3).unwrap());
    println!("cutoff: {averages}");
    assert!(averages.holds(), "{averages}");
    // Nine times the variance of the mean, for 30 %: a hundred samples a pixel.
    let samples = averages.samples.mean() / PIXELS as f64;
    assert!((90.0..150.0).contains(&samples), "{samples}");
}

/// A pass over the fifth of the pixels that look worst, by the samples that count: those without light look perfect.
fn worst_pixels(frame: &Frame) -> Vec<bool> {
    let error = |pixel: usize| {
        let estimate = frame.pixel(pixel, 0);
        if estimate.value > 0.0 { estimate.relative_error() } else { 0.0 }
    };
    let errors: Vec<f64> = (0..PIXELS).map(error).collect();
    let mut sorted = errors.clone();
    sorted.sort_by(f64::total_cmp);
    let level = sorted[PIXELS - PIXELS / 5 - 1];
    errors.into_iter().map(|error| error > level).collect()
}

#[test]
fn deciding_by_the_samples_that_count_is_found_out() {
    for ((probability, samples), seeds) in CASES.into_iter().zip([200, SEEDS, 300]) {
        let averages = averages(probability, seeds, |world, seed| {
            let mut radiance = RadiancePipeline::new();
            let observer =
                glimpses(probability, FrameShape::Line(PIXELS)).seed(seed).pixel_samples(samples / 16);
            observer.clone().pixel_samples(samples / 4).observe(world, &mut radiance).unwrap();
            while radiance.frame().total_samples() < samples * PIXELS as u64 {
                let mask = worst_pixels(radiance.frame());
                if !mask.contains(&true) {
                    break;
                }
                observer.clone().mask(mask).unwrap().observe(world, &mut radiance).unwrap();
            }
            radiance.frame().clone()
        });
        println!("one in {:<5} by what counts: {averages}", 1.0 / probability);
        assert!(averages.z().abs() > 4.0 && !averages.holds(), "one in {}: {averages}", 1.0 / probability);
    }
}

/// Looks at the lamp with a probability that some pixels have, and always or never with others.
#[derive(Debug, Clone, Copy)]
struct Uneven {
    noisy: usize,
}

/// How often a noisy pixel and a quiet one look at the lamp.
const OFTEN: [f64; 2] = [0.3, 0.999];

impl Sensor for Uneven {
    fn shape(&self) -> FrameShape {
        FrameShape::Line(PIXELS)
    }
    fn sample_ray(&self, pixel: usize, rng: &mut Rng) -> raysect::core::Ray {
        // The first two numbers are spread evenly; a third is not.
        let (_, _, chance) = (rng.uniform(), rng.uniform(), rng.uniform());
        let ahead = chance < OFTEN[usize::from(pixel >= self.noisy)];
        raysect::core::Ray::new(Point3D::ORIGIN, if ahead { Vector3D::Z } else { -Vector3D::Z })
    }
    fn pdf(&self, _: usize, _: Point3D, _: Vector3D) -> Option<f64> {
        None
    }
    fn etendue(&self, _: usize) -> Option<f64> {
        None
    }
}

/// What an observation of uneven pixels costs, and its true errors: the largest relative one of a pixel, the mean of
/// them, and that of the sum.
struct Outcome {
    samples: f64,
    largest: f64,
    mean: f64,
    total: f64,
}

fn outcome(noisy: usize, sampling: Option<AdaptiveSampling>) -> Outcome {
    let (world, mut radiance) = (lamp_at(5.0, 1.0), RadiancePipeline::new());
    let observer = Observer::with_sensor(Uneven { noisy }).wavelengths(500.0, 501.0).spectral_bins(1);
    let observer = observer.engine(Serial).quiet(true).pixel_samples(1024);
    let report = match sampling {
        Some(sampling) => observer.observe_adaptive(&world, &mut radiance, &sampling).unwrap(),
        None => observer.observe(&world, &mut radiance).unwrap(),
    };
    let often = |pixel: usize| OFTEN[usize::from(pixel >= noisy)];
    let variance =
        |pixel: usize| often(pixel) * (1.0 - often(pixel)) / radiance.frame().samples(pixel) as f64;
    let relative: Vec<f64> = (0..PIXELS).map(|pixel| variance(pixel).sqrt() / often(pixel)).collect();
    Outcome {
        samples: (report.samples + report.pilot_samples) as f64,
        largest: relative.iter().copied().fold(0.0, f64::max),
        mean: relative.iter().sum::<f64>() / PIXELS as f64,
        total: (0..PIXELS).map(variance).sum::<f64>().sqrt(),
    }
}

/// How many times as many samples a uniform observation needs for the same error; samples of the pilot are counted.
fn gain(noisy: usize, sampling: AdaptiveSampling, error: impl Fn(&Outcome) -> f64) -> f64 {
    let (uniform, adaptive) = (outcome(noisy, None), outcome(noisy, Some(sampling)));
    (error(&uniform) / error(&adaptive)).powi(2) * uniform.samples / adaptive.samples
}

#[test]
fn samples_are_saved_where_the_noise_is_uneven() {
    for (noisy, largest, mean, total) in [(PIXELS / 2, 1.05, 1.3, 1.4), (PIXELS / 8, 2.5, 1.4, 2.5)] {
        let mono = AdaptiveSampling::mono(1024);
        let equal = AdaptiveSampling::equal_errors(1024).min_samples(64).unwrap().ratio(100.0).unwrap();
        let sum = AdaptiveSampling::total(1024).min_samples(64).unwrap();
        for sampling in [mono, equal] {
            let found = gain(noisy, sampling, |o| o.largest);
            let found_mean = gain(noisy, sampling, |o| o.mean);
            println!(
                "{noisy} of {PIXELS} noisy: largest error ×{found:.2}, mean ×{found_mean:.2} by {sampling:?}"
            );
            assert!(found > largest && found_mean > mean, "{found} {found_mean}");
        }
        let found = gain(noisy, sum, |o| o.total);
        println!("{noisy} of {PIXELS} noisy: error of the total ×{found:.2}");
        assert!(found > total, "{found}");
    }
}
