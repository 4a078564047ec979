use std::ops::ControlFlow;

use raysect_core::accel::{Slabs, slabs};
use raysect_core::save::{SaveError, Saved, SceneWriter};
use raysect_core::{
    BoundingBox3D, BoundingSphere3D, Crossing, Departure, Feature, Interval, Primitive, Ray, Scratch, Surface,
};
use raysect_math::{AffineMatrix3D, Normal3D, Point3D};

use super::Operand;
use super::flat::Flat;
use super::operand::{Member, Probe};
use super::tie::{EXAMINED, TieRule};
use crate::PrimitiveError;
use crate::select::larger;

/// What is made of two bodies A and B.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Operation {
    /// What is in A or B.
    Union,
    /// What is in A and B.
    Intersect,
    /// What is in A and not in B.
    Subtract,
}

impl Operation {
    pub(super) fn apply(self, in_a: bool, in_b: bool) -> bool {
        match self {
            Self::Union => in_a || in_b,
            Self::Intersect => in_a && in_b,
            Self::Subtract => in_a && !in_b,
        }
    }

    /// What it answers, one bit for each of the four cases: their number is 1 if in A, plus 2 if in B.
    fn truth(self) -> u8 {
        (0..4).filter(|case| self.apply(case & 1 != 0, case & 2 != 0)).map(|case| 1 << case).sum()
    }

    fn name(self) -> &'static str {
        match self {
            Self::Union => "union",
            Self::Intersect => "intersect",
            Self::Subtract => "subtract",
        }
    }
}

/// All distances.
const LINE: Interval = Interval::new(f64::NEG_INFINITY, f64::INFINITY);

/// A body made of two others.
///
/// Both operands report all crossings of the whole line, on one scale of distances. Outside both at minus infinity, the
/// walk along the merged crossings toggles what it is inside of; where the Boolean value changes, there is a surface.
///
/// Crossings of A and B that rounding cannot tell apart are one event: both toggle before the value is looked at, so
/// that faces in common leave neither gap nor skin. The position of a surface is uncertain by δ across itself, and a
/// crossing therefore by δ / |d·n| along the ray; two crossings are one event if their uncertainties overlap. An event
/// takes at most one crossing of each operand, and where two of them change the value, both change it in
/// the same sense.
///
/// Composites of few convex leaves look at the ends of all chords at once, which is the same wherever no two crossings
/// are so close to each other that they might be one event; see [`Flat`].
///
/// This regularises the result (A. Requicha, *Representations for Rigid Solids*, ACM Computing Surveys 12, 1980).
#[derive(Clone)]
pub(super) struct Composite {
    pub(super) operation: Operation,
    /// The same as bits; see [`Operation::truth`].
    truth: u8,
    pub(super) a: Member,
    pub(super) b: Member,
    /// Leaves of A, and of both.
    parts: [u32; 2],
    /// Greatest coordinate of either operand that enters the arithmetic [m].
    pub(super) reach: f64,
    convex: bool,
    /// In its own space.
    bounds: BoundingBox3D,
    /// Boxes that a line must meet for either operand to matter, where to ask saves time.
    tests: [Option<Slabs>; 2],
    /// The leaves, if they are few and convex.
    pub(super) flat: Option<Flat>,
    /// Off in tests that show what it is good for.
    #[cfg(test)]
    pub(super) ties: bool,
}

impl Composite {
    /// Adds what is to be saved of both operands.
    pub(super) fn saved(&self, saved: Saved, writer: &mut SceneWriter) -> Result<Saved, SaveError> {
        let with_a = self.a.saved(saved, "a", writer)?;
        self.b.saved(with_a, "b", writer)
    }

    pub(super) fn new(operation: Operation, a: Operand, b: Operand) -> Result<Self, PrimitiveError> {
        let a = Member::new(a, operation.name(), "first")?;
        let b = Member::new(b, operation.name(), "second")?;
        let parts = [a.shape.parts(), a.shape.parts().saturating_add(b.shape.parts())];
        let convex = operation == Operation::Intersect && a.shape.is_convex() && b.shape.is_convex();
        let mut composite = Self {
            operation,
            truth: operation.truth(),
            parts,
            reach: a.reach.max(b.reach),
            convex,
            bounds: BoundingBox3D::EMPTY,
            tests: [None; 2],
            flat: None,
            a,
            b,
            #[cfg(test)]
            ties: true,
        };
        composite.bounds = composite.combined_box(&AffineMatrix3D::IDENTITY);
        composite.tests = composite.box_tests();
        composite.flat = Flat::made_of(operation, &composite.a, &composite.b, &composite.bounds);
        Ok(composite)
    }

    /// See `tests`.
    fn box_tests(&self) -> [Option<Slabs>; 2] {
        let (a, b) = (&self.a, &self.b);
        let of = |member: &Member| member.costly.then(|| slabs(&member.bounds));
        let surrounds = b.bounds.contains(a.bounds.lower) && b.bounds.contains(a.bounds.upper);
        match self.operation {
            Operation::Union => [of(a), of(b)],
            // A line through the first operand's box meets a box around it, too.
            Operation::Subtract => [of(a), of(b).filter(|_| !surrounds)],
            Operation::Intersect => [Some(slabs(&self.bounds)), None],
        }
    }

    /// From the boxes of the operands under the same map.
    fn combined_box(&self, m: &AffineMatrix3D) -> BoundingBox3D {
        let a = self.a.bounding_box(m);
        match self.operation {
            Operation::Union => a.union(&self.b.bounding_box(m)),
            Operation::Subtract => a,
            Operation::Intersect => a.intersection(&self.b.bounding_box(m)),
        }
    }

    /// The face of an operand, among those that go through the origin of the ray, which ends what the ray is in.
    #[cold]
    fn leave_at_once(&self, ray: &Ray, departure: &Departure, scratch: &mut Scratch) -> Option<Crossing> {
        let mut both = scratch.take();
        self.a.crossings(ray, scratch, &mut both);
        let first_of_b = both.len();
        self.b.crossings(ray, scratch, &mut both);
        let all = both.iter().enumerate().map(|(index, c)| self.as_own(c, index >= first_of_b));
        let steepness = |c: &Crossing| self.surface(ray, c).normal.dot(ray.direction).abs();
        let nearest = all
            .filter(|c| c.exiting == departure.inward && departure.goes_through(c, steepness))
            .min_by(|a, b| a.distance.abs().total_cmp(&b.distance.abs()));
        scratch.give_back(both);
        nearest.map(|c| Crossing { distance: 0.0, ..c })
    }

    /// Appends the crossings as the operands tell them.
    fn merged(&self, ray: &Ray, within: Interval, scratch: &mut Scratch, out: &mut Vec<Crossing>) {
        self.visit(ray, within, scratch, |crossing| {
            out.push(crossing);
            ControlFlow::Continue(())
        });
    }

    /// Lends the crossings of the composite one by one, in order: all that lie in an interval, and such others that what
    /// is inside there comes out right.
    ///
    /// Where the first operand is passed is all that matters of the second one, unless they are united. The intervals
    /// are wider than they need be by what crossings can be apart that are one event.
    #[inline]
    fn visit(
        &self,
        ray: &Ray,
        within: Interval,
        scratch: &mut Scratch,
        mut emit: impl FnMut(Crossing) -> ControlFlow<()>,
    ) {
        let probe = Probe::new(ray);
        let doubt = probe.distance_of(self.reach);
        let widened = |first: f64, last: f64| {
            Interval::new(first - EXAMINED * (doubt + first.abs()), last + EXAMINED * (doubt + last.abs()))
        };
        let within = widened(within.min, within.max);
        let mut both = scratch.take();
        if self.tests[0].as_ref().is_none_or(|bounds| probe.meets(bounds, within.min, within.max)) {
            self.a.crossings_within(ray, within, scratch, &mut both);
        }
        let first_of_b = both.len();
        let of_b = match (both.first(), both.last()) {
            _ if self.operation == Operation::Union => within,
            (Some(first), Some(last)) if first.distance <= within.max && last.distance >= within.min => {
                let passed = widened(first.distance, last.distance);
                Interval::new(larger(passed.min, within.min), -larger(-passed.max, -within.max))
            }
            _ => return scratch.give_back(both),
        };
        if self.tests[1].as_ref().is_none_or(|bounds| probe.meets(bounds, of_b.min, of_b.max)) {
            self.b.crossings_within(ray, of_b, scratch, &mut both);
        }
        let (a, b) = both.split_at(first_of_b);
        let _ = self.merge(ray, doubt, a, b, &mut emit);
        scratch.give_back(both);
    }

    #[inline]
    fn merge(
        &self,
        ray: &Ray,
        reach: f64,
        a: &[Crossing],
        b: &[Crossing],
        emit: &mut impl FnMut(Crossing) -> ControlFlow<()>,
    ) -> ControlFlow<()> {
        let [Some(ends_of_a), Some(ends_of_b)] = [ends(a), ends(b)] else {
            // Nothing to be taken away or added, or nothing in common. Only a union comes here without the first operand.
            let kept = if self.operation == Operation::Intersect { &[] } else { a };
            kept.iter().copied().try_for_each(&mut *emit)?;
            return b.iter().try_for_each(|c| emit(self.as_own(c, true)));
        };
        let farthest = larger(ends_of_a, ends_of_b);
        let ties = TieRule::new(self, ray, reach + farthest);
        let (mut i, mut j) = (0, 0);
        // Selections and no branches: whose crossing comes next cannot be foretold.
        let (mut state, mut inside, mut last) = (0, false, f64::NEG_INFINITY);
        loop {
            let (more_of_a, more_of_b) = (i < a.len(), j < b.len());
            if !(more_of_a | more_of_b) {
                return ControlFlow::Continue(());
            }
            let (x, y) = (&a[i.min(a.len() - 1)], &b[j.min(b.len() - 1)]);
            let mut of_b = !more_of_a | (more_of_b & (y.distance < x.distance));
            let (mut steps_a, mut steps_b) = (!of_b, of_b);
            if more_of_a
                && more_of_b
                && let Some(second) = ties.one_event(x, y)
            {
                (of_b, steps_a, steps_b) = (second, true, true);
            }
            i += usize::from(steps_a);
            j += usize::from(steps_b);
            state ^= u8::from(steps_a) | (u8::from(steps_b) << 1);
            let now = (self.truth >> state) & 1 != 0;
            if now == inside {
                continue;
            }
            inside = now;
            let crossing = if of_b { y } else { x };
            // Events come in order; the crossings that speak for them may be swapped by rounding.
            last = larger(crossing.distance, last);
            let own = Crossing { distance: last, exiting: !now, feature: self.own_feature(crossing, of_b) };
            emit(own)?;
        }
    }

    /// The feature of an operand as one of the composite.
    #[inline]
    fn own_feature(&self, crossing: &Crossing, of_b: bool) -> Feature {
        let before = if of_b { self.parts[0] } else { 0 };
        Feature { part: crossing.feature.part.saturating_add(before), ..crossing.feature }
    }

    /// A crossing of an operand as one of the composite.
    #[inline]
    fn as_own(&self, crossing: &Crossing, of_b: bool) -> Crossing {
        let inverted = of_b && self.operation == Operation::Subtract;
        let feature = self.own_feature(crossing, of_b);
        Crossing { feature, exiting: crossing.exiting != inverted, ..*crossing }
    }
}

/// How far the first or the last of crossings in order is, if there are any.
#[inline]
fn ends(crossings: &[Crossing]) -> Option<f64> {
    Some(larger(crossings.first()?.distance.abs(), crossings.last()?.distance.abs()))
}

impl std::fmt::Debug for Composite {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}, {}", self.a.shape.kind(), self.b.shape.kind())
    }
}

impl Primitive for Composite {
    fn bounding_box(&self, m: &AffineMatrix3D) -> BoundingBox3D {
        let combined = self.combined_box(m);
        match self.operation {
            // What the operands have in common may be smaller than the corner that their turned boxes share.
            Operation::Intersect => combined.intersection(&self.bounds.transformed(m)),
            _ => combined,
        }
    }

    fn bounding_sphere(&self, m: &AffineMatrix3D) -> BoundingSphere3D {
        let around_box = self.bounding_box(m).enclosing_sphere();
        let of = |member: &Member| member.shape.bounding_sphere(&member.placed_by(m));
        let smaller = |s: BoundingSphere3D, t: BoundingSphere3D| if t.radius < s.radius { t } else { s };
        match self.operation {
            Operation::Union => smaller(around_box, of(&self.a).union(&of(&self.b))),
            Operation::Subtract => smaller(around_box, of(&self.a)),
            Operation::Intersect => smaller(around_box, smaller(of(&self.a), of(&self.b))),
        }
    }

    fn contains(&self, point: Point3D) -> bool {
        // The second operand is asked only if it matters.
        match (self.operation, self.a.contains(point)) {
            (Operation::Union, true) => true,
            (Operation::Intersect | Operation::Subtract, false) => false,
            (operation, in_a) => operation.apply(in_a, self.b.contains(point)),
        }
    }

    fn crossings(&self, ray: &Ray, scratch: &mut Scratch, out: &mut Vec<Crossing>) {
        if !self.flat.as_ref().is_some_and(|flat| flat.list(ray, LINE, f64::INFINITY, out)) {
            self.merged(ray, LINE, scratch, out);
        }
    }

    fn crossings_within(&self, ray: &Ray, within: Interval, scratch: &mut Scratch, out: &mut Vec<Crossing>) {
        // An operand within another composite: most lines are soon done with, by the boxes of its own operands.
        self.merged(ray, within, scratch, out);
    }

    fn hit(&self, ray: &Ray, within: Interval, scratch: &mut Scratch) -> Option<Crossing> {
        if let Some(found) = self.flat.as_ref().and_then(|flat| flat.hit(ray, within)) {
            return found;
        }
        let mut first = None;
        self.visit(ray, within, scratch, |crossing| {
            if within.contains(crossing.distance) {
                first = Some(crossing);
                return ControlFlow::Break(());
            }
            ControlFlow::Continue(())
        });
        first
    }

    /// As every shape does by default; but where the body or the gap is thinner than rounding, so that the crossing
    /// that is being left cannot be found, what must come next comes at once.
    fn hit_after(
        &self,
        ray: &Ray,
        departure: &Departure,
        max_distance: f64,
        scratch: &mut Scratch,
    ) -> Option<Crossing> {
        let mut all = scratch.take();
        // One of these is being left, and another one follows it.
        let (ahead, bound) = (Interval::new(-departure.bound, f64::INFINITY), departure.bound);
        if !self.flat.as_ref().is_some_and(|flat| flat.list(ray, ahead, bound, &mut all)) {
            self.merged(ray, LINE, scratch, &mut all);
        }
        let steepness = |c: &Crossing| self.surface(ray, c).normal.dot(ray.direction).abs();
        let left = departure.left_among(all.iter().copied(), steepness);
        let next = match left {
            Some(index) => all.get(index + 1).copied(),
            None => all.iter().copied().find(|c| c.distance > 0.0),
        };
        scratch.give_back(all);
        let next = match next {
            Some(crossing) if crossing.exiting == departure.inward => next,
            None if !departure.inward => next,
            _ => self.leave_at_once(ray, departure, scratch).or(next),
        };
        let next = next.map(|c| Crossing { distance: c.distance.max(0.0), ..c });
        next.filter(|c| c.distance <= max_distance)
    }

    fn surface(&self, ray: &Ray, crossing: &Crossing) -> Surface {
        let Some(part) = crossing.feature.part.checked_sub(self.parts[0]) else {
            return self.a.surface(ray, crossing);
        };
        let feature = Feature { part, ..crossing.feature };
        let inverted = self.operation == Operation::Subtract;
        let exiting = crossing.exiting != inverted;
        let mut surface = self.b.surface(ray, &Crossing { feature, exiting, ..*crossing });
        if inverted {
            let turned = |n: Normal3D| Normal3D::from(-n.as_vector());
            surface.normal = turned(surface.normal);
            surface.shading_normal = turned(surface.shading_normal);
        }
        surface
    }

    fn is_convex(&self) -> bool {
        self.convex
    }

    fn parts(&self) -> u32 {
        self.parts[1]
    }
}
