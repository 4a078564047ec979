//! Pipelines and sensors of a user.

use raysect::core::Ray;
use raysect::math::Rng;
use raysect::observer::{FrameShape, Measurement};
use raysect::optical::Slicing;
use raysect::prelude::*;

/// The radiance of some bins of the spectrum, a channel each.
#[derive(Debug)]
pub(crate) struct Bins {
    range: std::ops::Range<usize>,
    frame: Frame,
}

impl Bins {
    /// Of these bins.
    pub(crate) fn new(range: std::ops::Range<usize>) -> Self {
        Self { range, frame: Frame::new("bins", "W/m²/sr/nm") }
    }
}

impl Pipeline for Bins {
    fn channels(&self, _: &Slicing) -> Vec<String> {
        self.range.clone().map(|bin| format!("bin {bin}")).collect()
    }

    fn measure(&self, sample: &Measurement<'_>, out: &mut [f64]) {
        for (bin, radiance) in (sample.slice.offset..).zip(sample.radiance) {
            if self.range.contains(&bin) {
                out[bin - self.range.start] += radiance;
            }
        }
    }

    fn frame(&self) -> &Frame {
        &self.frame
    }

    fn frame_mut(&mut self) -> &mut Frame {
        &mut self.frame
    }
}

/// First, second and third powers of the radiance in every bin, and of that of the whole spectrum: for one ray a
/// sample only.
#[derive(Debug)]
pub(crate) struct Moments(Frame);

impl Moments {
    /// Empty.
    pub(crate) fn new() -> Self {
        Self(Frame::new("moments", "1"))
    }

    /// Mean, its error, and skewness of the samples of a pixel in a bin; of the whole spectrum after the last bin. The
    /// error is that without regard to skewness, which third powers have in plenty.
    pub(crate) fn of(&self, pixel: usize, bin: usize) -> (Estimate, f64) {
        let squared_error = self.0.variance()[pixel * self.0.channels().len() + 3 * bin];
        let samples = self.0.samples(pixel) as f64;
        let moment = |power: usize| self.0.pixel(pixel, 3 * bin + power);
        let (a, b, c) = (moment(0).value, moment(1).value, moment(2).value);
        let variance = b - a * a;
        let skewness = (c - 3.0 * a * b + 2.0 * a * a * a) / variance.powf(1.5);
        let mean = Estimate { error: (squared_error / samples).sqrt(), ..moment(0) };
        (mean, if variance > 0.0 { skewness } else { 0.0 })
    }
}

impl Pipeline for Moments {
    fn channels(&self, slicing: &Slicing) -> Vec<String> {
        (0..3 * (slicing.bins() + 1)).map(|i| format!("moment {} of {}", i % 3 + 1, i / 3)).collect()
    }

    fn measure(&self, sample: &Measurement<'_>, out: &mut [f64]) {
        let whole = sample.radiance.iter().sum::<f64>() * sample.slice.bin_width();
        for (out, x) in out.chunks_exact_mut(3).zip(sample.radiance.iter().copied().chain([whole])) {
            out.copy_from_slice(&[x, x * x, x * x * x]);
        }
    }

    fn frame(&self) -> &Frame {
        &self.0
    }

    fn frame_mut(&mut self) -> &mut Frame {
        &mut self.0
    }
}

/// Looks ahead with a small probability, and back otherwise.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Glimpse {
    pub(crate) probability: f64,
    pub(crate) shape: FrameShape,
}

impl Sensor for Glimpse {
    fn shape(&self) -> FrameShape {
        self.shape
    }

    fn sample_ray(&self, _: usize, rng: &mut Rng) -> Ray {
        let ahead = rng.uniform() < self.probability;
        Ray::new(Point3D::ORIGIN, if ahead { Vector3D::Z } else { -Vector3D::Z })
    }

    fn pdf(&self, _: usize, _: Point3D, _: Vector3D) -> Option<f64> {
        None
    }

    fn etendue(&self, _: usize) -> Option<f64> {
        None
    }
}

/// An observer of one pixel, one bin of 1 nm, on the calling thread, whose samples look ahead with a probability.
pub(crate) fn glimpse(probability: f64) -> Observer<Glimpse> {
    glimpses(probability, FrameShape::Single)
}

/// The same of several pixels.
pub(crate) fn glimpses(probability: f64, shape: FrameShape) -> Observer<Glimpse> {
    let observer = Observer::with_sensor(Glimpse { probability, shape });
    observer.wavelengths(500.0, 501.0).spectral_bins(1).engine(Serial).quiet(true)
}

/// A world with one small lamp of a radiance, ahead of the origin or behind it.
pub(crate) fn lamp_at(z: f64, radiance: f64) -> World {
    let mut world = World::new();
    let lamp = Sphere::new(0.1).unwrap().material(UniformSurfaceEmitter::new(1.0, radiance));
    world.add(lamp.transform(translate(0.0, 0.0, z))).unwrap();
    world
}
