use std::ops::Range;

use raysect_core::{CoreError, EngineError};
use raysect_math::MathError;
use raysect_optical::OpticalError;
use thiserror::Error;

use crate::file::FileError;
use crate::{FrameShape, StatepointError};

/// What can go wrong with an observation.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum ObserverError {
    /// The scene is wrong.
    #[error(transparent)]
    Core(#[from] CoreError),
    /// A material or the spectral range is wrong.
    #[error(transparent)]
    Optical(#[from] OpticalError),
    /// A parameter lies outside its range.
    #[error(transparent)]
    Math(#[from] MathError),
    /// The work has ended early.
    #[error(transparent)]
    Engine(#[from] EngineError),
    /// A file could not be written or read.
    #[error(transparent)]
    File(#[from] FileError),
    /// There is nothing to observe with.
    #[error("an observation needs at least one pipeline")]
    NoPipelines,
    /// Pipelines that are observed together have seen different samples.
    #[error(
        "pipeline '{first}' has {first_samples} samples a pixel and '{second}' {second_samples}: those observed together must have seen the same rays"
    )]
    UnequalPipelines {
        /// Name of one pipeline.
        first: String,
        /// Its samples a pixel.
        first_samples: u64,
        /// Name of another.
        second: String,
        /// Its samples a pixel.
        second_samples: u64,
    },
    /// Pipelines whose state is kept together cannot be told apart.
    #[error(
        "two pipelines are called '{0}' [{1}]: give them names, so that each finds its own samples in the statepoint"
    )]
    SameName(String, String),
    /// A pipeline has accumulated something else before.
    #[error(
        "pipeline '{name}' has accumulated {before}, which cannot be continued with {now}: use a new pipeline, or clear its frame"
    )]
    OtherFrame {
        /// Name of the pipeline.
        name: String,
        /// What it has.
        before: String,
        /// What is to be added.
        now: String,
    },
    /// Power was asked of a sensor that has no étendue.
    #[error(
        "pipeline '{pipeline}' measures power, but pixel {pixel} of this {sensor} has no étendue: give it one [m² sr], or measure radiance"
    )]
    NoEtendue {
        /// Name of the pipeline.
        pipeline: String,
        /// What the sensor is.
        sensor: &'static str,
        /// The first pixel without.
        pixel: usize,
    },
    /// A region of interest reaches beyond the picture.
    #[error("columns {columns:?} and rows {rows:?} do not lie within {shape}")]
    Region {
        /// Columns asked for.
        columns: Range<usize>,
        /// Rows asked for.
        rows: Range<usize>,
        /// The pixels that there are.
        shape: FrameShape,
    },
    /// A pixel that there is none of.
    #[error(
        "pixel {pixel} of {shape}: pixels are counted from 0, row by row, and must be less than their number"
    )]
    NoPixel {
        /// Its number.
        pixel: usize,
        /// The pixels that there are.
        shape: FrameShape,
    },
    /// A pixel that is not observed.
    #[error("pixel {pixel} is not observed: the mask leaves it out")]
    MaskedPixel {
        /// Its number.
        pixel: usize,
    },
    /// Numbers of samples that are not one for each pixel.
    #[error("{found} numbers of samples for {pixels} pixels: there must be one for each, row by row")]
    PixelNumbers {
        /// How many were given.
        found: usize,
        /// How many pixels there are.
        pixels: usize,
    },
    /// A sample that an observation does not take.
    #[error(
        "sample {sample} of {samples} a pixel: samples are counted from 0 and must be less than their number; an \
         observation that was continued has more, which pixel_samples must say"
    )]
    NoSample {
        /// Its number.
        sample: u64,
        /// Samples a pixel of the observer.
        samples: u64,
    },
    /// A mask or a region of interest leaves nothing.
    #[error("the mask leaves no pixel to observe")]
    NoPixels,
    /// Two frames have the same samples, which must not be counted twice.
    #[error(
        "frame '{name}': both have samples of pixel {pixel} in lane {lane}, and samples must not be counted twice"
    )]
    Overlap {
        /// Name of the frame.
        name: String,
        /// The lane.
        lane: u64,
        /// The first pixel that both have.
        pixel: usize,
    },
    /// A statepoint cannot be used.
    #[error(transparent)]
    Statepoint(#[from] StatepointError),
    /// A lane that there is none of.
    #[error("lane {lane} of {of}: lanes are counted from 0 and must be less than their number")]
    Lane {
        /// Its number.
        lane: u64,
        /// How many there are.
        of: u64,
    },
    /// A frame has nothing to show yet.
    #[error("frame '{0}' has no samples yet")]
    EmptyFrame(String),
    /// A stop rule that would never stop, or stops at nothing.
    #[error("stop rule: {0}")]
    Stop(&'static str),
    /// Samples that cannot be distributed by what the first pipeline gathers.
    #[error(
        "adaptive sampling: the first pipeline '{pipeline}' has {channels} channels, and should have {needs}"
    )]
    Adaptive {
        /// Name of the pipeline.
        pipeline: String,
        /// How many channels it has.
        channels: usize,
        /// What would suit.
        needs: &'static str,
    },
    /// A number of values that does not fit the pixels.
    #[error("{what}: {found} values for {expected} pixels")]
    PixelCount {
        /// What was given.
        what: &'static str,
        /// How many values were given.
        found: usize,
        /// How many pixels there are.
        expected: usize,
    },
    /// A corner of a pixel that the distortion of a lens reaches twice or not at all.
    #[error(
        "the upper left corner of the pixel in column {column}, row {row} cannot be undistorted: the picture is folded there or before"
    )]
    Distortion {
        /// Column, counted from 0; one after the last for the right border.
        column: usize,
        /// Row, counted from 0; one after the last for the lower border.
        row: usize,
    },
    /// A sensor that cannot be aimed.
    #[error("pixel {pixel} of this {sensor} does not say how its directions are spread: it cannot be aimed")]
    OneWay {
        /// What the sensor is.
        sensor: &'static str,
        /// The first such pixel.
        pixel: usize,
    },
    /// A node that should be a shape.
    #[error("{0} has no shape to aim at")]
    NoShape(String),
}
