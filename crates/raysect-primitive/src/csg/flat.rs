use std::ops::ControlFlow;

use raysect_core::accel::{Slabs, slabs};
use raysect_core::{BoundingBox3D, Crossing, Interval, Ray};

use super::composite::Operation;
use super::leaf::{Leaf, known, unwrapped};
use super::operand::Member;
use super::tie::EXAMINED;
use super::truth::{LEAVES, Truth};
use super::walk::Walk;
use super::{Intersect, Subtract, Union};
use crate::select::larger;

/// A composite as the list of its leaves, if they are few and convex: each has a chord of a line at most, and where their
/// ends change what the truth table says, there is a surface.
///
/// Where ends of different leaves come so close to each other that the tie rule of any composite on the way might look at
/// them, it does not answer: composites then ask each other, which is always right. What it answers is the same to the bit.
#[derive(Clone)]
pub(super) struct Flat {
    pub(super) leaves: Vec<Leaf>,
    pub(super) truth: Truth,
    /// Leaves that the body is within, as bits, and the others.
    pub(super) needed: u32,
    pub(super) others: u32,
    /// Box around the body if it is not within any of its leaves, one of which would tell as soon which lines pass it by.
    pub(super) bounds: Option<Slabs>,
    /// How far apart crossings may be that a tie rule looks at, times the greatest component of the direction: a part of
    /// the greatest coordinate of the origin, and a length [m].
    pub(super) close: [f64; 2],
    /// Greatest coordinate of any leaf [m].
    reach: f64,
}

/// What is added to bounds for the rounding of their own computation and of the crossings.
const MARGIN: f64 = 1.0 + 1e-6;

impl Flat {
    /// Of an operand in the space of its composite.
    fn of(member: &Member) -> Option<Self> {
        let shape = unwrapped(&*member.shape);
        let composite = known::<Union>(shape)
            .map(|s| &s.0)
            .or_else(|| known::<Intersect>(shape).map(|s| &s.0))
            .or_else(|| known::<Subtract>(shape).map(|s| &s.0));
        let mut flat = match composite {
            Some(composite) => composite.flat.clone()?,
            None => {
                let leaves = vec![Leaf::of(shape)?];
                return Some(Self {
                    leaves: leaves.into_iter().map(|leaf| member.placed_leaf(leaf)).collect(),
                    truth: Truth::of(0),
                    needed: 1,
                    others: 0,
                    bounds: None,
                    close: [0.0; 2],
                    reach: member.reach,
                });
            }
        };
        flat.leaves = flat.leaves.into_iter().map(|leaf| member.placed_leaf(leaf)).collect();
        (flat.close, flat.reach) = member.placed_lengths(flat.close, flat.reach);
        Some(flat)
    }

    /// What is made of two operands, which lies in a box.
    pub(super) fn made_of(
        operation: Operation,
        a: &Member,
        b: &Member,
        bounds: &BoundingBox3D,
    ) -> Option<Self> {
        let (a, b) = (Self::of(a)?, Self::of(b)?);
        let count = a.leaves.len();
        if count + b.leaves.len() > LEAVES {
            return None;
        }
        let inside =
            |state: usize| operation.apply(a.truth.is_inside(state), b.truth.is_inside(state >> count));
        let reach = larger(a.reach, b.reach);
        // The tie rule adds how far the origin or the bodies reach and how far the farthest crossing is, which is in them.
        let own = [2.0 * EXAMINED * MARGIN, 2.0 * EXAMINED * MARGIN * reach];
        let close = [0, 1].map(|i| larger(own[i], larger(a.close[i], b.close[i])));
        let truth = Truth::from_states(inside);
        let leaves: Vec<_> = a.leaves.into_iter().chain(b.leaves).collect();
        let needed: u32 = (0..leaves.len()).filter(|&leaf| truth.is_within(leaf)).map(|leaf| 1 << leaf).sum();
        let others = ((1 << leaves.len()) - 1) & !needed;
        let bounds = (needed == 0).then(|| slabs(bounds));
        Some(Self { leaves, truth, needed, others, bounds, close, reach })
    }

    /// The first crossing within an interval; nothing if a tie rule may have to decide.
    #[inline]
    pub(super) fn hit(&self, ray: &Ray, within: Interval) -> Option<Option<Crossing>> {
        let mut walk = Walk::new(self, ray, within)?;
        if !walk.meets() {
            return Some(None);
        }
        if let Some(found) = walk.entry(within) {
            return Some(found);
        }
        let mut first = None;
        let decided = walk.visit(within, |crossing| {
            first = Some(crossing);
            ControlFlow::Break(())
        });
        decided.then_some(first)
    }

    /// Appends the crossings within an interval, in order, as far as the first one beyond `enough`. False, and nothing is
    /// appended, if a tie rule may have to decide.
    pub(super) fn list(&self, ray: &Ray, within: Interval, enough: f64, out: &mut Vec<Crossing>) -> bool {
        let before = out.len();
        let push = |crossing: Crossing| {
            out.push(crossing);
            if crossing.distance > enough { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        };
        let decided =
            Walk::new(self, ray, within).is_some_and(|mut walk| !walk.meets() || walk.visit(within, push));
        if !decided {
            out.truncate(before);
        }
        decided
    }
}

#[cfg(test)]
impl Flat {
    /// Turns the answer for what is inside of all leaves into its opposite.
    pub(super) fn spoil_table(&mut self) {
        let (truth, all) = (self.truth, (1 << self.leaves.len()) - 1);
        self.truth = Truth::from_states(|state| truth.is_inside(state) != (state & all == all));
    }

    /// Takes no two crossings for one event.
    pub(super) fn trust_blindly(&mut self) {
        self.close = [0.0; 2];
    }
}
