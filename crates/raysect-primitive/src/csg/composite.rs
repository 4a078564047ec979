use std::ops::ControlFlow;

use raysect_core::{
    BoundingBox3D, BoundingSphere3D, Crossing, Departure, Feature, Interval, Primitive, Ray, Scratch, Surface,
};
use raysect_math::{AffineMatrix3D, Normal3D, Point3D};

use super::Operand;
use super::operand::{Member, inverse_direction};
use crate::PrimitiveError;

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
    #[inline]
    fn apply(self, in_a: bool, in_b: bool) -> bool {
        match self {
            Self::Union => in_a || in_b,
            Self::Intersect => in_a && in_b,
            Self::Subtract => in_a && !in_b,
        }
    }

    fn name(self) -> &'static str {
        match self {
            Self::Union => "union",
            Self::Intersect => "intersect",
            Self::Subtract => "subtract",
        }
    }
}

/// Rays flatter than one over this to a surface are not examined for faces that coincide, unless the crossings agree
/// to rounding as they are.
const GRAZING: f64 = 16_777_216.0;

/// The boxes of intersections are enlarged by this part of their distance from the origin, which is what the
/// crossings of rays from some tens of sizes away may lie beside.
const MARGIN: f64 = 4096.0 * f64::EPSILON;

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
/// This regularises the result (A. Requicha, *Representations for Rigid Solids*, ACM Computing Surveys 12, 1980).
#[derive(Clone)]
pub(super) struct Composite {
    operation: Operation,
    a: Member,
    b: Member,
    /// Leaves of A, and of both.
    parts: [u32; 2],
    reach: f64,
    convex: bool,
    /// In its own space.
    bounds: BoundingBox3D,
    /// Off in tests that show what it is good for.
    #[cfg(test)]
    pub(super) ties: bool,
}

impl Composite {
    pub(super) fn new(operation: Operation, a: Operand, b: Operand) -> Result<Self, PrimitiveError> {
        let a = Member::new(a, operation.name(), "first")?;
        let b = Member::new(b, operation.name(), "second")?;
        let parts = [a.shape.parts(), a.shape.parts() + b.shape.parts()];
        let convex = operation == Operation::Intersect && a.shape.is_convex() && b.shape.is_convex();
        let mut composite = Self {
            operation,
            parts,
            reach: a.reach.max(b.reach),
            convex,
            bounds: BoundingBox3D::EMPTY,
            a,
            b,
            #[cfg(test)]
            ties: true,
        };
        composite.bounds = composite.combined_box(&AffineMatrix3D::IDENTITY);
        Ok(composite)
    }

    /// From the boxes of the operands under the same map.
    fn combined_box(&self, m: &AffineMatrix3D) -> BoundingBox3D {
        let a = self.a.bounding_box(m);
        match self.operation {
            Operation::Union => a.union(&self.b.bounding_box(m)),
            Operation::Subtract => a,
            Operation::Intersect => {
                let mut common = a.intersection(&self.b.bounding_box(m));
                if !common.is_empty() {
                    common.pad(MARGIN * common.lower.max_abs().max(common.upper.max_abs()));
                }
                common
            }
        }
    }

    /// The face of an operand, among those that go through the origin of the ray, which ends what the ray is in.
    #[cold]
    fn leave_at_once(&self, ray: &Ray, departure: &Departure, scratch: &mut Scratch) -> Option<Crossing> {
        let (a, b) = self.operand_crossings(ray, scratch);
        let of_b = b.iter().map(|c| self.as_own(c, true));
        let nearest = (a.iter().copied().chain(of_b))
            .filter(|c| c.exiting == departure.inward && c.distance.abs() <= 4.0 * departure.bound)
            .min_by(|a, b| a.distance.abs().total_cmp(&b.distance.abs()));
        scratch.give_back(a);
        scratch.give_back(b);
        nearest.map(|c| Crossing { distance: 0.0, ..c })
    }

    /// All crossings of both operands; none of the second where they cannot matter.
    #[inline]
    fn operand_crossings(&self, ray: &Ray, scratch: &mut Scratch) -> (Vec<Crossing>, Vec<Crossing>) {
        let inverse = inverse_direction(ray.direction);
        let (mut a, mut b) = (scratch.take(), scratch.take());
        self.a.crossings(ray, inverse, scratch, &mut a);
        if !a.is_empty() || self.operation == Operation::Union {
            self.b.crossings(ray, inverse, scratch, &mut b);
        }
        (a, b)
    }

    /// Lends the crossings of the composite one by one, in order.
    #[inline]
    fn visit(&self, ray: &Ray, scratch: &mut Scratch, mut emit: impl FnMut(Crossing) -> ControlFlow<()>) {
        let (a, b) = self.operand_crossings(ray, scratch);
        let _ = self.merge(ray, &a, &b, &mut emit);
        scratch.give_back(b);
        scratch.give_back(a);
    }

    #[inline]
    fn merge(
        &self,
        ray: &Ray,
        a: &[Crossing],
        b: &[Crossing],
        emit: &mut impl FnMut(Crossing) -> ControlFlow<()>,
    ) -> ControlFlow<()> {
        if b.is_empty() && self.operation != Operation::Intersect {
            return a.iter().copied().try_for_each(emit);
        }
        let ties = TieRule::new(self, ray);
        let (mut a, mut b) = (a.iter().peekable(), b.iter().peekable());
        let (mut in_a, mut in_b, mut inside, mut last) = (false, false, false, f64::NEG_INFINITY);
        loop {
            let (crossing, of_b) = match (a.peek(), b.peek()) {
                (None, None) => return ControlFlow::Continue(()),
                (Some(&&x), Some(&&y)) => match ties.judge(&x, &y) {
                    Order::First => (x, false),
                    Order::Second => (y, true),
                    Order::Together { second } => {
                        // One of the two speaks for the event; the other only toggles.
                        if second {
                            (in_a, _) = (!in_a, a.next())
                        } else {
                            (in_b, _) = (!in_b, b.next())
                        }
                        if second { (y, true) } else { (x, false) }
                    }
                },
                (Some(&&x), None) => (x, false),
                (None, Some(&&y)) => (y, true),
            };
            if of_b {
                (in_b, _) = (!in_b, b.next());
            } else {
                (in_a, _) = (!in_a, a.next());
            }
            let now = self.operation.apply(in_a, in_b);
            if now == inside {
                continue;
            }
            inside = now;
            // Events come in order; the crossings that speak for them may be swapped by rounding.
            last = crossing.distance.max(last);
            emit(Crossing { distance: last, exiting: !now, ..self.as_own(&crossing, of_b) })?;
        }
    }

    /// A crossing of an operand as one of the composite.
    #[inline]
    fn as_own(&self, crossing: &Crossing, of_b: bool) -> Crossing {
        if !of_b {
            return *crossing;
        }
        let feature = Feature { part: crossing.feature.part + self.parts[0], ..crossing.feature };
        let inverted = self.operation == Operation::Subtract;
        Crossing { feature, exiting: crossing.exiting != inverted, ..*crossing }
    }
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
        self.visit(ray, scratch, |crossing| {
            out.push(crossing);
            ControlFlow::Continue(())
        });
    }

    fn hit(&self, ray: &Ray, within: Interval, scratch: &mut Scratch) -> Option<Crossing> {
        let mut first = None;
        self.visit(ray, scratch, |crossing| {
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
        self.crossings(ray, scratch, &mut all);
        let left = all
            .iter()
            .enumerate()
            .filter(|(_, c)| c.exiting != departure.inward && c.distance.abs() <= departure.bound)
            .min_by(|a, b| a.1.distance.abs().total_cmp(&b.1.distance.abs()))
            .map(|(index, _)| index);
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
        let surface = self.b.surface(ray, &Crossing { feature, exiting, ..*crossing });
        if !inverted {
            return surface;
        }
        let turned = |n: Normal3D| Normal3D::from(-n.as_vector());
        Surface { normal: turned(surface.normal), shading_normal: turned(surface.shading_normal), ..surface }
    }

    fn is_convex(&self) -> bool {
        self.convex
    }

    fn parts(&self) -> u32 {
        self.parts[1]
    }
}

/// Which of two crossings comes first, one of each operand.
enum Order {
    First,
    Second,
    /// They are one event, for which the first or the second speaks.
    Together {
        second: bool,
    },
}

/// Tells crossings apart, or not.
struct TieRule<'a> {
    composite: &'a Composite,
    ray: &'a Ray,
    /// Length of the direction, and the largest length besides the distance that enters [m].
    speed: f64,
    reach: f64,
}

impl<'a> TieRule<'a> {
    #[inline]
    fn new(composite: &'a Composite, ray: &'a Ray) -> Self {
        let reach = ray.origin.max_abs() + composite.reach;
        Self { composite, ray, speed: ray.direction.length(), reach }
    }

    #[inline]
    fn judge(&self, a: &Crossing, b: &Crossing) -> Order {
        let gap = (a.distance - b.distance).abs() * self.speed;
        let lengths = self.reach + a.distance.abs().max(b.distance.abs()) * self.speed;
        let doubt = (self.composite.a.rounding + self.composite.b.rounding) * lengths;
        if gap <= GRAZING * doubt
            && let Some(together) = self.together(a, b, gap, lengths)
        {
            return together;
        }
        if a.distance <= b.distance { Order::First } else { Order::Second }
    }

    /// With the slopes of both surfaces. The one that the ray meets more steeply knows better where it is.
    #[cold]
    fn together(&self, a: &Crossing, b: &Crossing, gap: f64, lengths: f64) -> Option<Order> {
        #[cfg(test)]
        if !self.composite.ties {
            return None;
        }
        let slope = |member: &Member, crossing: &Crossing| {
            let normal = member.surface(self.ray, crossing).normal;
            (normal.dot(self.ray.direction) / self.speed).abs()
        };
        let (first, second) = (&self.composite.a, &self.composite.b);
        let (slope_a, slope_b) = (slope(first, a), slope(second, b));
        let doubt = first.rounding * lengths / slope_a + second.rounding * lengths / slope_b;
        (gap <= doubt).then_some(Order::Together { second: slope_b > slope_a })
    }
}
