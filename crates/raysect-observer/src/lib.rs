//! Cameras, sensors, pipelines, frames and images of raysect.
//!
//! An [`Observer`] is a [`Sensor`] in its place with everything that says how it observes. What it sees goes to
//! pipelines that the user owns and lends; each keeps a [`Frame`] of means with their standard errors.
//!
//! ```
//! use raysect_math::translate;
//! use raysect_observer::{PinholeCamera, PowerPipeline2D, RgbPipeline2D, Stop};
//! use raysect_optical::{UniformSurfaceEmitter, WithMaterial, World};
//! use raysect_primitive::Sphere;
//!
//! let mut world = World::new();
//! world.add(Sphere::new(10.0)?.material(UniformSurfaceEmitter::new(1.0, 1.0)))?;
//!
//! let camera = PinholeCamera::new((8, 8), 45.0)?.etendue(1e-9)?.wavelengths(500.0, 501.0).spectral_bins(1);
//! let (mut rgb, mut power) = (RgbPipeline2D::new(), PowerPipeline2D::new());
//! camera.observe_until(&world, &mut (&mut rgb, &mut power), Stop::samples(10))?;
//!
//! // 64 pixels of 1e-9 m² sr see 1 W/m²/sr/nm over 1 nm, without noise.
//! let total = power.frame().total();
//! assert!((total.value - 64e-9).abs() < 1e-20 && total.error < 1e-20);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Your own pipeline
//! A [`Pipeline`] reduces one sample's spectrum to a few numbers, by a linear rule; the rest is done for it:
//!
//! ```
//! use raysect_observer::{Frame, Measurement, Pipeline};
//! use raysect_optical::Slicing;
//!
//! /// Photons per second, through the whole spectrum.
//! struct Photons(Frame);
//!
//! impl Pipeline for Photons {
//!     fn channels(&self, _: &Slicing) -> Vec<String> {
//!         vec!["photons".to_owned()]
//!     }
//!     fn measure(&self, sample: &Measurement, out: &mut [f64]) {
//!         let energy = 1.986e-25 / (0.5e-9 * (sample.slice.min + sample.slice.max));
//!         let sum: f64 = sample.radiance.iter().sum();
//!         out[0] += sample.etendue * sum * sample.slice.bin_width() / energy;
//!     }
//!     fn needs_etendue(&self) -> bool {
//!         true
//!     }
//!     fn frame(&self) -> &Frame {
//!         &self.0
//!     }
//!     fn frame_mut(&mut self) -> &mut Frame {
//!         &mut self.0
//!     }
//! }
//! ```

mod adaptive;
mod display;
mod error;
pub mod file;
mod frame;
mod frame_files;
mod imaging;
mod nonimaging;
mod observe;
mod observer;
mod pipeline;
mod plan;
#[cfg(feature = "plot")]
pub mod plot;
mod progress;
mod reading;
mod report;
mod sensor;
mod statepoint;
mod stop;
mod strata;
mod target;
mod target_shape;
mod targeted;
pub mod testing;

pub use adaptive::{AdaptiveSampling, SpectralReduction};
pub use display::{ColourMap, MonoDisplay};
pub use error::ObserverError;
pub use frame::{BLOCK, Estimate, Frame};
pub use frame_files::Shown;
pub use imaging::{
    Ccd, CcdArray, OpenCv, OpenCvCamera, Orthographic, OrthographicCamera, Pinhole, PinholeCamera, Sightline,
    SightlineArray, Sightlines, TargetedCcdArray, ThinLens, ThinLensCamera, VectorCamera, Vectors,
};
pub(crate) use nonimaging::etendue_of_cone;
pub use nonimaging::{
    Fibre, FibreOptic, Line, MeshCamera, MeshPatches, MeshPixel, MeshWhole, Pixel, Rectangle, SightLine,
    TargetedPixel,
};
pub use observe::Replay;
pub use observer::{CancelToken, Observer};
pub use pipeline::{
    BayerPipeline2D, FunctionalPipeline, Measurement, Pipeline, Pipelines, PowerPipeline, PowerPipeline0D,
    PowerPipeline1D, PowerPipeline2D, RadiancePipeline, RadiancePipeline0D, RadiancePipeline1D,
    RadiancePipeline2D, RgbPipeline2D, SpectralPipeline, SpectralPowerPipeline, SpectralPowerPipeline0D,
    SpectralPowerPipeline1D, SpectralPowerPipeline2D, SpectralRadiancePipeline, SpectralRadiancePipeline0D,
    SpectralRadiancePipeline1D, SpectralRadiancePipeline2D,
};
pub use plan::Plan;
pub use progress::Progress;
pub use reading::Reading;
pub use report::{Convergence, RenderReport};
pub use sensor::{FrameShape, Sensor};
pub use statepoint::{Statepoint, StatepointError};
pub use stop::{Scope, Stop, minutes, seconds};
pub use target::Target;
pub use targeted::Targeted;
