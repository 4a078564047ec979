//! The structure of profiles about a point or an axis: each edge becomes a sphere or a cylinder.

use super::super::{CoaxialMapper, SphericalMapper};
use super::{Structured1D, Structured3D};
use crate::{Point3D, Vector3D};

/// The bend of a distance is not resolved below this part of the length scale: what happens there does not matter.
const FINEST: f64 = 1e-4;

/// How a line passes a point or an axis: its distance is √(least² + (speed (t − at))²).
pub(super) struct Pass {
    /// Where it is nearest, in lengths of the direction.
    pub(super) at: f64,
    /// The distance there.
    pub(super) least: f64,
    /// Length of the direction, of what is perpendicular to the axis.
    pub(super) speed: f64,
}

impl Pass {
    /// Of the vector to the origin of the line and its direction; none if the distance is the same all along.
    pub(super) fn new(from: Vector3D, direction: Vector3D) -> Option<Self> {
        let squared = direction.dot(direction);
        let at = -from.dot(direction) / squared;
        at.is_finite().then(|| Self { at, least: (from + direction * at).length(), speed: squared.sqrt() })
    }

    /// Adds the two places at a distance; none if the line does not come so near.
    fn cross(&self, distance: f64, out: &mut Vec<f64>) {
        if distance >= self.least {
            // The difference of the squares, without cancellation.
            let half = ((distance - self.least) * (distance + self.least)).sqrt() / self.speed;
            out.extend([self.at - half, self.at + half]);
        }
    }

    /// The distance bends within its least value: adds places at once, twice, four times … that from the nearest one, up
    /// to the length over which a function of it changes.
    pub(super) fn bend(&self, length_scale: f64, out: &mut Vec<f64>) {
        out.push(self.at);
        let mut away = self.least.max(FINEST * length_scale);
        while away < length_scale {
            out.extend([self.at - away / self.speed, self.at + away / self.speed]);
            away *= 2.0;
        }
    }

    /// Adds what a profile of the distance has on the line.
    fn add_breaks(&self, profile: &impl Structured1D, out: &mut Vec<f64>) {
        profile.each_edge(&mut |edge| self.cross(edge, out));
        if !profile.is_stepped() {
            self.bend(profile.length_scale(), out);
        }
    }
}

impl<F: Structured1D> Structured3D for SphericalMapper<F> {
    fn length_scale(&self) -> f64 {
        self.profile().length_scale()
    }

    fn add_breaks(&self, origin: Point3D, direction: Vector3D, out: &mut Vec<f64>) {
        if let Some(pass) = Pass::new(self.centre().vector_to(origin), direction) {
            pass.add_breaks(self.profile(), out);
        }
    }
}

impl<F: Structured1D> Structured3D for CoaxialMapper<F> {
    fn length_scale(&self) -> f64 {
        self.profile().length_scale()
    }

    fn add_breaks(&self, origin: Point3D, direction: Vector3D, out: &mut Vec<f64>) {
        let from = self.across(self.point().vector_to(origin));
        if let Some(pass) = Pass::new(from, self.across(direction)) {
            pass.add_breaks(self.profile(), out);
        }
    }
}
