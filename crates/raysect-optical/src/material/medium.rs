use raysect_core::Ray;
use raysect_math::{AffineMatrix3D, Point3D, Vector3D};

use super::PhaseFunction;
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

impl Refraction {
    /// True if refraction depends on the wavelength.
    pub fn disperses(&self) -> bool {
        !(self.index.function().is_constant() && self.external_index.function().is_constant())
    }
}

/// Where a medium is asked for its coefficients.
#[derive(Debug, Clone, Copy)]
pub struct MediumPoint<'a> {
    /// A point of the path in the medium, in world space [m]; the middle of the piece for a homogeneous medium.
    pub point: Point3D,
    /// Unit vector in which the light travels, in world space.
    pub direction: Vector3D,
    /// The map from world space to that of the shape that is filled.
    pub to_local: &'a AffineMatrix3D,
    /// The bins.
    pub at: Context<'a>,
}

impl MediumPoint<'_> {
    /// The point in the space of the shape.
    #[inline]
    pub fn local_point(&self) -> Point3D {
        self.to_local.transform_point(self.point)
    }

    /// The direction of the light in the space of the shape, a unit vector.
    #[inline]
    pub fn local_direction(&self) -> Vector3D {
        self.to_local.transform_vector(self.direction).normalise_unchecked()
    }
}

/// What a medium does to light per metre of world space, bin by bin. Media in the same place add to the same numbers.
#[derive(Debug)]
pub struct Coefficients<'a> {
    /// Emission j [W/m³/sr/nm].
    pub emission: &'a mut [f64],
    /// Attenuation α [1/m]: everything that a beam loses, by absorption and by scattering.
    pub attenuation: &'a mut [f64],
    /// Scattering σ [1/m], which is part of the attenuation.
    pub scattering: &'a mut [f64],
}

/// How the coefficients of a medium change along a ray. No rule can see what it has not sampled: structure is
/// declared, not guessed.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum Structure {
    /// They are constant along a straight piece, though they may depend on its direction: solved exactly.
    #[default]
    Homogeneous,
    /// They change over lengths no shorter than this, in metres of the shape's own space, and between
    /// [breakpoints](Medium::breakpoints): solved by adaptive quadrature to a tolerance.
    Smooth {
        /// The shortest length of change [m].
        length_scale: f64,
    },
    /// Nothing is known. The medium only emits; its emission is sampled at one random point in each step of about this
    /// length: without bias, and what the steps miss shows as variance.
    Unknown {
        /// Length of a step, in metres of the shape's own space.
        step: f64,
    },
    /// The medium only emits, and the trapezium rule with steps of this length is taken for good: Raysect's way, with
    /// an error that nobody knows.
    Trapezium {
        /// Length of a step at most, in metres of the shape's own space.
        step: f64,
        /// Points at least, both ends included; 2 or more.
        points: u32,
    },
}

/// What fills a volume: the path integrator solves dL/ds = j − α L along a ray from its local coefficients, and
/// scatters paths in it.
pub trait Medium: Send + Sync {
    /// The refractive index; none for a medium that does not refract.
    fn refraction(&self) -> Option<&Refraction> {
        None
    }

    /// How its coefficients change along a ray.
    fn structure(&self) -> Structure {
        Structure::Homogeneous
    }

    /// Adds the distances at which the coefficients jump along a ray in the space of the shape, in units of the
    /// length of its direction, which is not a unit vector. Order and repetition do not matter, nor do places beyond
    /// its ends. A cell between two of them is solved by itself.
    fn breakpoints(&self, _ray: &Ray, _out: &mut Vec<f64>) {}

    /// Adds what this medium does at a point.
    fn coefficients(&self, at: &MediumPoint<'_>, out: &mut Coefficients<'_>);

    /// How it scatters; none for a medium that does not, whose scattering coefficient is 0 everywhere.
    fn phase_function(&self) -> Option<&dyn PhaseFunction> {
        None
    }

    /// The parts of a mixture, each with its share: the coefficients of the mixture are the sum of theirs, times the
    /// shares. It scatters by the phase function of one of them, chosen anew at each scattering; and along a ray each is
    /// solved by its own structure, unless that of the mixture is declared.
    fn parts(&self) -> Option<[(f64, &dyn Medium); 2]> {
        None
    }

    /// A bound on the attenuation [1/m] in all bins and everywhere, of a medium that is not homogeneous. It is asked for
    /// where something scatters; without a bound no path can be followed there.
    fn majorant(&self, _at: Context<'_>) -> f64 {
        f64::INFINITY
    }
}

/// True if a medium or a part of it scatters.
pub(crate) fn scatters(medium: &dyn Medium) -> bool {
    medium.phase_function().is_some()
        || medium.parts().is_some_and(|parts| parts.iter().any(|(_, part)| scatters(*part)))
}
