//! Samples where they are needed: which pixels get how many, decided by samples that do not count.

mod noise;
mod plan;
mod reduction;

pub(crate) use noise::Noise;
pub(crate) use plan::SamplePlan;
use raysect_math::MathError;
pub use reduction::SpectralReduction;

use crate::{Frame, ObserverError};

/// How the samples of an observation are distributed among its pixels.
///
/// Samples that decide about their own number are biased: a pixel that happens to have missed a rare bright sample
/// looks accurate and is left alone, one that has hit it is given more samples until the hit is averaged away. With
/// samples that are bright once in a thousand such a rule has read 12.6 ± 1.6 % too little. Here the pixels'
/// numbers of samples are decided by a *pilot*, samples of its own that are thrown away, so that they are fixed before
/// the first sample that counts is taken: whatever the pilot saw, the mean of each pixel is that of a fixed number of
/// samples, without bias, and its standard error means what it says.
///
/// The pilot has a sixteenth of the average number of samples of every pixel (32 of them at least, or a quarter if that is
/// less) and goes on to a sixteenth of what a pixel is to have: in all less than an eighth of the samples from an average
/// of 512 on, and 5/16 at most. The same observation makes the same decisions, on any number of threads and after it was
/// interrupted.
///
/// A few samples tell little of a variance, least of all if they are equal. Half of what counts is therefore the variance
/// of the pixels around a pixel, and that of the average pixel is added, divided by the number of pilot samples: a pixel
/// in which nothing has been seen yet is not taken for accurate.
///
/// The first of the observer's pipelines decides; the others see the same samples.
///
/// ```
/// # use raysect_math::translate;
/// # use raysect_optical::{UniformSurfaceEmitter, WithMaterial, World};
/// # use raysect_primitive::Sphere;
/// use raysect_observer::{AdaptiveSampling, PinholeCamera, RgbPipeline2D};
/// # let mut world = World::new();
/// # world.add(Sphere::new(1.0)?.material(UniformSurfaceEmitter::new(1.0, 1.0)))?;
/// let camera = PinholeCamera::new((16, 16), 45.0)?.transform(translate(0.0, 0.0, -5.0));
/// // 250 samples a pixel in the mean, and none for those that are known to 2 %.
/// let adaptive = AdaptiveSampling::rgb(250).cutoff(0.02)?;
/// camera.observe_adaptive(&world, &mut RgbPipeline2D::new(), &adaptive)?;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
#[doc(alias("MaskedMonoAdaptiveSampler2D", "MaskedRGBAdaptiveSampler2D"))]
pub struct AdaptiveSampling {
    /// Of a pixel, in the mean over those observed.
    samples: u64,
    rule: Rule,
    figure: Figure,
    fraction: f64,
    ratio: f64,
    /// A quarter of the average if there is none.
    min_samples: Option<u64>,
    cutoff: f64,
}

/// What the samples are distributed for.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Rule {
    /// Again and again to the pixels of the largest relative errors.
    Worst,
    /// In proportion to the relative variances.
    Equal,
    /// In proportion to the standard deviations over the root of the costs.
    Total,
}

/// The number of each pixel that is looked at.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Figure {
    /// The first channel.
    First,
    /// The worst of three channels.
    Colour,
    /// All channels after the first.
    Bins(SpectralReduction),
}

impl AdaptiveSampling {
    fn new(samples: u64, rule: Rule, figure: Figure) -> Self {
        Self { samples, rule, figure, fraction: 0.2, ratio: 10.0, min_samples: None, cutoff: 0.0 }
    }

    /// Pass by pass to the pixels in which the first channel has the largest relative error, until there are so many
    /// samples a pixel in the mean: at first a quarter of them for every pixel, then for a fifth of the pixels at a
    /// time, none more than ten times as many as another.
    #[doc(alias("MonoAdaptiveSampler1D", "MonoAdaptiveSampler2D"))]
    pub fn mono(samples: u64) -> Self {
        Self::new(samples, Rule::Worst, Figure::First)
    }

    /// As [`mono`](Self::mono), by the largest of the relative errors of X, Y and Z: for an
    /// [`RgbPipeline2D`](crate::RgbPipeline2D).
    #[doc(alias = "RGBAdaptiveSampler2D")]
    pub fn rgb(samples: u64) -> Self {
        Self::new(samples, Rule::Worst, Figure::Colour)
    }

    /// As [`mono`](Self::mono), by the relative errors of the bins: for a
    /// [`SpectralPipeline`](crate::SpectralPipeline).
    #[doc(alias("SpectralAdaptiveSampler1D", "SpectralAdaptiveSampler2D"))]
    pub fn spectral(samples: u64, reduction: SpectralReduction) -> Self {
        Self::new(samples, Rule::Worst, Figure::Bins(reduction))
    }

    /// In proportion to the relative variance of the first channel, so that every pixel has about the same relative
    /// error.
    pub fn equal_errors(samples: u64) -> Self {
        Self::new(samples, Rule::Equal, Figure::First)
    }

    /// For the least error of the sum of the first channel over all pixels: in proportion to its standard deviation
    /// over the root of the number of rays that a sample takes (J. Neyman, *J. R. Stat. Soc.* 97(4), 1934; W. G.
    /// Cochran, *Sampling Techniques*, 3rd ed., § 5.5).
    pub fn total(samples: u64) -> Self {
        Self::new(samples, Rule::Total, Figure::First)
    }

    /// With another share of the pixels in each pass of [`mono`](Self::mono), [`rgb`](Self::rgb) and
    /// [`spectral`](Self::spectral), 0 … 1, without 0.
    ///
    /// # Errors
    /// [`ObserverError::Math`] for another number.
    pub fn fraction(self, fraction: f64) -> Result<Self, ObserverError> {
        let admitted = fraction > 0.0 && fraction <= 1.0;
        MathError::check(admitted, fraction, "fraction", "", "0 … 1, without 0")?;
        Ok(Self { fraction, ..self })
    }

    /// With at most so many times as many samples in one pixel as in another, at least 1.
    ///
    /// # Errors
    /// [`ObserverError::Math`] for a smaller number.
    pub fn ratio(self, ratio: f64) -> Result<Self, ObserverError> {
        MathError::check(ratio >= 1.0, ratio, "ratio", "", "at least 1")?;
        Ok(Self { ratio, ..self })
    }

    /// With at least so many samples of every pixel, as far as there are so many in the mean.
    ///
    /// # Errors
    /// [`ObserverError::Math`] for none.
    pub fn min_samples(self, samples: u64) -> Result<Self, ObserverError> {
        MathError::check(samples > 0, 0.0, "min_samples", "", "at least 1")?;
        Ok(Self { min_samples: Some(samples), ..self })
    }

    /// With no more than the least number of samples for pixels whose relative error, the standard error over the mean,
    /// the pilot foresees to be smaller, 0 … 1: if that holds of all, the observation ends before its number of samples. 0
    /// by default. It has no influence on [`total`](Self::total).
    ///
    /// Raysect's `cutoff` is the same limit of the same number. It is held against the error that a pixel has reached by
    /// the samples that count, before each `observe`, and pixels that were below it by chance stay there; here it is held
    /// against what the pilot foresees, so that the errors that are reached lie about it:
    /// [`RenderReport::convergence`](crate::RenderReport::convergence) says whether the pilot foresaw it for all of them.
    /// With 0, rendering by Raysect's sampler ends with `render_complete` practically never; here the number of samples
    /// is the end.
    ///
    /// # Errors
    /// [`ObserverError::Math`] for another number.
    pub fn cutoff(self, cutoff: f64) -> Result<Self, ObserverError> {
        MathError::check((0.0..=1.0).contains(&cutoff), cutoff, "cutoff", "", "0 … 1")?;
        Ok(Self { cutoff, ..self })
    }

    /// The relative error that is asked of every pixel, if one is.
    pub(crate) fn target(&self) -> Option<f64> {
        (self.rule != Rule::Total && self.cutoff > 0.0).then_some(self.cutoff)
    }

    /// Refuses a number of samples or a pipeline that it cannot work with.
    pub(crate) fn check(&self, frame: &Frame) -> Result<(), ObserverError> {
        MathError::check(self.samples > 0, 0.0, "samples", "", "at least 1")?;
        let channels = frame.channels().len();
        let (suits, needs) = match self.figure {
            Figure::First => (channels > 0, "a channel"),
            Figure::Colour => (channels == 3, "three channels, as of an RgbPipeline2D"),
            Figure::Bins(reduction) => {
                reduction.check()?;
                (channels > 1, "a total and bins, as of a SpectralPipeline")
            }
        };
        if suits {
            return Ok(());
        }
        Err(ObserverError::Adaptive { pipeline: frame.name().to_owned(), channels, needs })
    }

    fn least(&self) -> u64 {
        self.min_samples.unwrap_or(self.samples.div_ceil(4)).min(self.samples)
    }
}
