//! Pictures of the Cornell box as bits.

use std::collections::BTreeMap;

use raysect::prelude::*;

use crate::cornell::{self, Variant};

/// Columns and rows of the pictures.
pub(crate) const PIXELS: (usize, usize) = (12, 10);
/// The number of pixels.
pub(crate) const COUNT: usize = PIXELS.0 * PIXELS.1;
/// Samples of a pixel: one complete block of statistics and an open one.
pub(crate) const SAMPLES: u64 = 200;

/// A scene and how many rays share the bins.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Case(pub(crate) Variant, pub(crate) usize);

/// Every kind of path: through glass with and without dispersion, and between diffuse surfaces.
pub(crate) const CASES: [Case; 3] =
    [Case(Variant::Glass, 1), Case(Variant::Glass, 3), Case(Variant::Diffuse, 1)];

impl Case {
    /// Its world.
    pub(crate) fn world(self) -> World {
        cornell::cornell_box(self.0).unwrap()
    }

    /// Its camera, for a number of samples, on the calling thread.
    pub(crate) fn camera(self, samples: u64) -> PinholeCamera {
        camera(samples).spectral_rays(self.1)
    }
}

/// The camera of all pictures, for a number of samples, on the calling thread.
pub(crate) fn camera(samples: u64) -> PinholeCamera {
    cornell::camera(PIXELS).unwrap().pixel_samples(samples).engine(Serial).quiet(true)
}

/// Colours and radiance of the same rays.
#[derive(Debug, Default)]
pub(crate) struct Pictures {
    pub(crate) rgb: RgbPipeline2D,
    pub(crate) radiance: RadiancePipeline2D,
}

impl Pictures {
    /// Goes on with a camera's samples.
    pub(crate) fn observe(&mut self, camera: &PinholeCamera, world: &World) -> RenderReport {
        camera.observe(world, &mut self.both()).unwrap()
    }

    /// The two as what an observer takes.
    pub(crate) fn both(&mut self) -> (&mut RgbPipeline2D, &mut RadiancePipeline2D) {
        (&mut self.rgb, &mut self.radiance)
    }

    /// Every number of one observation.
    pub(crate) fn of(camera: &PinholeCamera, world: &World) -> Vec<u64> {
        let mut pictures = Self::default();
        pictures.observe(camera, world);
        pictures.bits()
    }

    /// Every number of both frames.
    pub(crate) fn bits(&self) -> Vec<u64> {
        let all = [self.rgb.frame(), self.radiance.frame()];
        all.into_iter().flat_map(|frame| (0..COUNT).flat_map(|pixel| pixel_bits(frame, pixel))).collect()
    }
}

/// Mean and error of each channel of a pixel, and its number of samples, as bits.
pub(crate) fn pixel_bits(frame: &Frame, pixel: usize) -> Vec<u64> {
    let estimates = (0..frame.channels().len()).map(|channel| frame.pixel(pixel, channel));
    let numbers = estimates.flat_map(|e| [e.value.to_bits(), e.error.to_bits()]);
    numbers.chain([frame.samples(pixel)]).collect()
}

/// What a frame has of a pixel, as bits, whatever the others have seen: the error of a pixel is not among it, since the
/// other pixels of the frame make it longer.
pub(crate) fn own_bits(frame: &Frame, pixel: usize) -> Vec<u64> {
    let means = (0..frame.channels().len()).map(|channel| frame.pixel(pixel, channel).value);
    let moments = means.chain([frame.variance_of_variance(pixel), frame.largest(pixel)]);
    moments.map(f64::to_bits).chain([frame.contributing(pixel), frame.samples(pixel)]).collect()
}

/// The samples of every pixel.
pub(crate) fn counts(frame: &Frame) -> Vec<u64> {
    (0..frame.shape().pixels()).map(|pixel| frame.samples(pixel)).collect()
}

/// The numbers of samples that pixels have, without repetition.
pub(crate) fn distinct_counts(frame: &Frame) -> Vec<u64> {
    let mut all = counts(frame);
    all.sort_unstable();
    all.dedup();
    all
}

/// Asserts that each pixel has the bits of an undivided observation of as many samples; `undivided` makes one.
#[track_caller]
pub(crate) fn assert_pixels_are_undivided(frame: &Frame, undivided: impl Fn(u64) -> Frame) {
    let references: BTreeMap<u64, Frame> =
        distinct_counts(frame).into_iter().filter(|&n| n > 0).map(|n| (n, undivided(n))).collect();
    for pixel in 0..frame.shape().pixels() {
        let samples = frame.samples(pixel);
        if let Some(reference) = references.get(&samples) {
            let (ours, theirs) = (own_bits(frame, pixel), own_bits(reference, pixel));
            assert_eq!(ours, theirs, "pixel {pixel} with {samples} samples");
        }
    }
}
