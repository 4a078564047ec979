//! What is made of the spectra that a sensor sees.

mod bayer;
mod functional;
mod output;
mod power;
mod radiance;
mod rgb;
mod spectral;
mod spectral_files;

pub use bayer::BayerPipeline2D;
pub use functional::FunctionalPipeline;
pub use power::{PowerPipeline, PowerPipeline0D, PowerPipeline1D, PowerPipeline2D};
pub use radiance::{RadiancePipeline, RadiancePipeline0D, RadiancePipeline1D, RadiancePipeline2D};
use raysect_optical::{Slice, Slicing};
pub use rgb::RgbPipeline2D;
pub use spectral::{
    SpectralPipeline, SpectralPowerPipeline, SpectralPowerPipeline0D, SpectralPowerPipeline1D,
    SpectralPowerPipeline2D, SpectralRadiancePipeline, SpectralRadiancePipeline0D,
    SpectralRadiancePipeline1D, SpectralRadiancePipeline2D,
};

use crate::{Frame, FrameShape, ObserverError};

/// One spectrum, or the slice of it that one ray carries, as a pipeline gets it.
#[derive(Debug, Clone, Copy)]
pub struct Measurement<'a> {
    /// Number of the pixel, row by row.
    pub pixel: usize,
    /// The bins, with the tables of every spectral function.
    pub slice: &'a Slice,
    /// Radiance in the medium of the sensor, a value a bin [W/m²/sr/nm].
    pub radiance: &'a [f64],
    /// Étendue of the pixel [m² sr]; NaN for a sensor that has none, which pipelines that
    /// [need it](Pipeline::needs_etendue) never see.
    pub etendue: f64,
}

/// A linear functional of a sample's spectrum: power, radiance, colour, or a user's own.
///
/// A pipeline only reduces one sample to a few numbers. Means, errors, merging and files are the business of its
/// [`Frame`], which it owns and lends.
#[doc(alias("Pipeline0D", "Pipeline1D", "Pipeline2D", "PixelProcessor"))]
pub trait Pipeline: Send + Sync {
    /// The names of the numbers that it makes of a sample.
    fn channels(&self, slicing: &Slicing) -> Vec<String>;

    /// Called when an observation begins, for what depends on the pixels and bins: which filter a pixel has, for
    /// example.
    fn begin(&mut self, _shape: FrameShape, _slicing: &Slicing) {}

    /// Adds its numbers for one slice of a sample's spectrum to `out`.
    fn measure(&self, sample: &Measurement<'_>, out: &mut [f64]);

    /// True if it cannot do without the étendue of a pixel.
    fn needs_etendue(&self) -> bool {
        false
    }

    /// What it has gathered.
    fn frame(&self) -> &Frame;

    /// What it has gathered, for the observer to add to.
    fn frame_mut(&mut self) -> &mut Frame;

    /// The unit of its first channel, if it is another one than that of its frame.
    fn total_unit(&self) -> &str {
        self.frame().unit()
    }

    /// Called after each pass over the pixels: to write a preview, for example. As long as nothing that counts has been
    /// seen, that is also after each pass of a pilot, whose samples the frame then holds for the time of the call.
    ///
    /// # Errors
    /// Whatever went wrong; it ends the observation.
    fn pass_finished(&mut self) -> Result<(), ObserverError> {
        Ok(())
    }
}

/// One pipeline or several that are to see the same rays: a pipeline, a tuple of `&mut` to some, or a vector of
/// boxed ones.
pub trait Pipelines {
    /// Puts each pipeline into the list.
    fn each<'p>(&'p mut self, list: &mut Vec<&'p mut dyn Pipeline>);
}

impl<P: Pipeline> Pipelines for P {
    fn each<'p>(&'p mut self, list: &mut Vec<&'p mut dyn Pipeline>) {
        list.push(self);
    }
}

impl Pipelines for Vec<Box<dyn Pipeline>> {
    fn each<'p>(&'p mut self, list: &mut Vec<&'p mut dyn Pipeline>) {
        for pipeline in self {
            list.push(&mut **pipeline);
        }
    }
}

macro_rules! tuples {
    ($($name:ident)+) => {
        impl<$($name: Pipelines + ?Sized),+> Pipelines for ($(&mut $name,)+) {
            fn each<'p>(&'p mut self, list: &mut Vec<&'p mut dyn Pipeline>) {
                #[allow(non_snake_case)]
                let ($($name,)+) = self;
                $($name.each(list);)+
            }
        }
    };
}
tuples!(A B);
tuples!(A B C);
tuples!(A B C D);
tuples!(A B C D E);

#[cfg(test)]
mod tests;
