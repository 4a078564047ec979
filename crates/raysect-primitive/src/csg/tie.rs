use raysect_core::{Crossing, Ray};

use super::composite::Composite;
use super::operand::Member;

/// Error of a crossing across its surface, as a part of the lengths that enter: the roundings of the map to the operand's
/// space and of the solution there, some ten, and twice as many in reserve. Coincident faces of plain shapes in turned and
/// scaled frames were found apart by a thirtieth of what two of these allow (`the_tie_rule_has_room_to_spare`).
const ROUNDING: f64 = 32.0 * f64::EPSILON;

/// Crossings so many times farther apart than rounding alone allows are not examined: faces that coincide are told from
/// others down to slopes of one over this.
const GRAZING: f64 = 16_777_216.0;

/// Crossings that are farther apart than this part of the lengths that enter are told apart by their distances alone.
pub(super) const EXAMINED: f64 = 4.0 * GRAZING * ROUNDING;

/// Tells crossings apart, or not.
pub(super) struct TieRule<'a> {
    composite: &'a Composite,
    ray: &'a Ray,
    /// Crossings farther apart than this are not looked at, in units of the direction's length.
    near: f64,
}

impl<'a> TieRule<'a> {
    /// `lengths` is how far what enters reaches, in units of the direction's length.
    #[inline]
    pub(super) fn new(composite: &'a Composite, ray: &'a Ray, lengths: f64) -> Self {
        Self { composite, ray, near: EXAMINED * lengths }
    }

    /// If two crossings, one of each operand, are one event: true if the second speaks for it.
    #[inline]
    pub(super) fn one_event(&self, a: &Crossing, b: &Crossing) -> Option<bool> {
        if (a.distance - b.distance).abs() <= self.near { self.examined(a, b) } else { None }
    }

    /// With the slopes of both surfaces. The one that the ray meets more steeply knows better where it is.
    #[cold]
    fn examined(&self, a: &Crossing, b: &Crossing) -> Option<bool> {
        #[cfg(test)]
        if !self.composite.ties {
            return None;
        }
        let speed = self.ray.direction.length();
        let gap = (a.distance - b.distance).abs() * speed;
        let reach = self.ray.origin.max_abs() + self.composite.reach;
        let lengths = reach + a.distance.abs().max(b.distance.abs()) * speed;
        // What happens to a crossing further down, in operands of operands, shows in the bound of its point.
        let slope_and_doubt = |member: &Member, crossing: &Crossing| {
            let surface = member.surface(self.ray, crossing);
            let slope = (surface.normal.dot(self.ray.direction) / speed).abs();
            (slope, (ROUNDING + surface.bound / self.composite.reach) * lengths / slope)
        };
        let (slope_a, doubt_a) = slope_and_doubt(&self.composite.a, a);
        let (slope_b, doubt_b) = slope_and_doubt(&self.composite.b, b);
        let doubt = doubt_a + doubt_b;
        (gap <= doubt).then_some(slope_b > slope_a)
    }
}
