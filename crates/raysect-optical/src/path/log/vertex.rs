use raysect_math::Point3D;

use super::{PathEvent, VertexHit};

/// A place where something happens to a path.
#[derive(Debug, Clone, PartialEq)]
pub struct PathVertex {
    /// Where, in world space [m]. A path that escapes has no such place: it is drawn to the end that was set to its ray,
    /// else to a point outside of everything.
    pub point: Point3D,
    /// What is there; none where a path starts or escapes, or a volume was to scatter it and nothing did.
    pub hit: Option<VertexHit>,
    /// What happens.
    pub event: PathEvent,
    /// The throughput with which the path arrives, bin by bin, after the media on its way.
    pub before: Vec<f64>,
    /// The throughput with which it goes on, bin by bin, after roulette: nothing if it is absorbed or killed, and what it
    /// still has if it escapes, is cut off or lost.
    pub after: Vec<f64>,
    /// The radiance that media on the piece of the path before the vertex add to the path's [W/m²/sr/nm], bin by bin. It
    /// is that of the whole piece up to the next surface, also if the path is scattered on the way.
    pub along: Vec<f64>,
    /// The radiance that the vertex adds to the path's [W/m²/sr/nm], bin by bin: what the surface emits, and the light
    /// that is looked for from there, both as they count in the sum.
    pub radiance: Vec<f64>,
}

impl PathVertex {
    /// The mean of [`before`](Self::before) over the bins.
    pub fn mean_before(&self) -> f64 {
        mean(&self.before)
    }

    /// The mean of [`after`](Self::after) over the bins.
    pub fn mean_after(&self) -> f64 {
        mean(&self.after)
    }

    /// The mean of [`along`](Self::along) over the bins [W/m²/sr/nm].
    pub fn mean_along(&self) -> f64 {
        mean(&self.along)
    }

    /// The mean of [`radiance`](Self::radiance) over the bins [W/m²/sr/nm].
    pub fn mean_radiance(&self) -> f64 {
        mean(&self.radiance)
    }
}

fn mean(bins: &[f64]) -> f64 {
    bins.iter().sum::<f64>() / bins.len() as f64
}
