//! Cameras.

mod ccd;
pub(crate) mod etendue;
mod gauss;
mod opencv;
mod opencv_model;
mod orthographic;
mod pinhole;
pub(crate) mod raster;
mod sightlines;
mod thin_lens;
pub(crate) mod vector;

pub use ccd::{Ccd, CcdArray, TargetedCcdArray};
pub use opencv::{OpenCv, OpenCvCamera};
pub use orthographic::{Orthographic, OrthographicCamera};
pub use pinhole::{Pinhole, PinholeCamera};
pub use sightlines::{Sightline, SightlineArray, Sightlines};
pub use thin_lens::{ThinLens, ThinLensCamera};
pub use vector::{VectorCamera, Vectors};
