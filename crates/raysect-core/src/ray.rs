use raysect_math::{Point3D, Vector3D};

use crate::CoreError;

/// A half-line in space.
///
/// Distances along it are counted in units of the length of `direction`: metres for a unit direction.
#[derive(Debug, Clone, Copy, PartialEq)]
// In this order x and y of both lie where pairs of numbers are stored and loaded at once: a pair that is loaded across two
// stores has to wait for both.
#[repr(C)]
pub struct Ray {
    /// Where it begins [m].
    pub origin: Point3D,
    /// Where it ends, in units of the direction's length; infinity by default.
    pub max_distance: f64,
    /// Where it goes; need not be of unit length.
    pub direction: Vector3D,
}

impl Default for Ray {
    /// From the origin along z, without end.
    fn default() -> Self {
        Self::new(Point3D::ORIGIN, Vector3D::Z)
    }
}

impl Ray {
    /// A ray without end.
    #[inline]
    pub const fn new(origin: Point3D, direction: Vector3D) -> Self {
        Self { origin, direction, max_distance: f64::INFINITY }
    }

    /// The same ray with an end, in units of the direction's length.
    #[inline]
    pub const fn with_max_distance(self, max_distance: f64) -> Self {
        Self { max_distance, ..self }
    }

    /// The point `origin + t · direction` [m].
    #[inline]
    #[doc(alias = "point_on")]
    pub fn point_at(&self, t: f64) -> Point3D {
        self.origin + self.direction * t
    }

    /// Refuses a ray that leads nowhere.
    ///
    /// # Errors
    /// [`CoreError::Ray`] for an origin or direction that is not finite, a zero direction, or a negative or NaN
    /// `max_distance`.
    pub fn check(&self) -> Result<(), CoreError> {
        let wrong = |what: &str| Err(CoreError::Ray(what.to_owned()));
        if !self.origin.is_finite() {
            return wrong(&format!("origin {:?} m", self.origin.to_array()));
        }
        if self.direction.normalise().is_err() {
            return wrong(&format!("direction {:?}", self.direction.to_array()));
        }
        if self.max_distance.is_nan() || self.max_distance < 0.0 {
            return wrong(&format!("max_distance {}", self.max_distance));
        }
        Ok(())
    }
}

/// A closed range of distances along a ray.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Interval {
    /// Where it begins.
    pub min: f64,
    /// Where it ends.
    pub max: f64,
}

impl Interval {
    /// All distances ahead of the origin.
    pub const AHEAD: Self = Self { min: 0.0, max: f64::INFINITY };

    /// From its ends.
    #[inline]
    pub const fn new(min: f64, max: f64) -> Self {
        Self { min, max }
    }

    /// True if `t` lies in the interval, ends included.
    #[inline]
    pub fn contains(&self, t: f64) -> bool {
        t >= self.min && t <= self.max
    }
}
