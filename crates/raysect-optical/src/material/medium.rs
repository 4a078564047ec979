use raysect_math::{Point3D, Vector3D};

use crate::{Context, SpectralTable};

/// The refractive index of a medium, and which of two media in the same place counts.
#[derive(Debug, Clone)]
pub struct Refraction {
    /// The index as a function of the vacuum wavelength.
    pub index: SpectralTable,
    /// The index outside, where no other refracting medium is.
    pub external_index: SpectralTable,
    /// Refracting media exclude each other: where several overlap the highest priority counts, of equals the one
    /// that stands later in the tree (C. Schmidt and B. Budge, *Simple Nested Dielectrics in Ray Traced Images*,
    /// JGT 7(2), 2002).
    pub priority: i32,
}

/// Where a medium is asked for its coefficients.
#[derive(Debug, Clone, Copy)]
pub struct MediumPoint<'a> {
    /// The middle of the path's piece in the medium, in world space [m].
    pub point: Point3D,
    /// Unit vector in which the light travels.
    pub direction: Vector3D,
    /// The bins.
    pub at: Context<'a>,
}

/// What a medium does to light per metre, bin by bin. Media in the same place add to the same numbers.
#[derive(Debug)]
pub struct Coefficients<'a> {
    /// Emission j [W/m³/sr/nm].
    pub emission: &'a mut [f64],
    /// Attenuation α [1/m].
    pub attenuation: &'a mut [f64],
}

/// What fills a volume: the path integrator solves dL/ds = j − α L along a ray from its local coefficients.
///
/// The coefficients are constant along a piece of a path, which is solved exactly.
pub trait Medium: Send + Sync {
    /// The refractive index; none for a medium that does not refract.
    fn refraction(&self) -> Option<&Refraction> {
        None
    }

    /// Adds what this medium does.
    fn coefficients(&self, at: &MediumPoint<'_>, out: &mut Coefficients<'_>);
}
