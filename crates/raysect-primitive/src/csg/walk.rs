use std::ops::ControlFlow;

use raysect_core::{Crossing, Feature, Interval, Ray};
use raysect_math::Point3D;

use super::flat::Flat;
use super::operand::Probe;
use super::truth::{LEAVES, Truth};
use crate::select::{larger, smaller};

/// A line on its way through the leaves of a composite.
pub(super) struct Walk<'a> {
    flat: &'a Flat,
    ray: &'a Ray,
    /// Crossings that are nearer to each other may be one event.
    close: f64,
    /// How far a coordinate changes at most between such crossings [m].
    margin: f64,
    /// Where nothing is left to be found before and behind.
    first: f64,
    last: f64,
    /// Of the chords that are known: distances and faces of both ends.
    ends: [[f64; 2]; LEAVES],
    faces: [[u32; 2]; LEAVES],
    /// Leaves whose chords have still to be asked for, as bits.
    missing: u32,
    /// The last of the entries into leaves that the body is within, the one before, and the first of the exits.
    entry: (f64, usize),
    before: f64,
    exit: f64,
}

impl<'a> Walk<'a> {
    /// Before any leaf has been asked. Nothing if numbers overflow.
    #[inline]
    pub(super) fn new(flat: &'a Flat, ray: &'a Ray, within: Interval) -> Option<Self> {
        let margin = flat.close[0] * greatest(ray.origin.to_array()) + flat.close[1];
        let close = margin / greatest(ray.direction.to_array());
        if close.is_nan() || close == f64::INFINITY {
            return None;
        }
        Some(Self {
            flat,
            ray,
            close,
            margin,
            first: within.min - close,
            last: within.max + close,
            ends: [[f64::INFINITY; 2]; LEAVES],
            faces: [[0; 2]; LEAVES],
            missing: flat.others,
            entry: (f64::NEG_INFINITY, 0),
            before: f64::NEG_INFINITY,
            exit: f64::INFINITY,
        })
    }

    /// Asks the leaves that the body is within. False if the line does not meet the body in the interval.
    #[inline(always)]
    pub(super) fn meets(&mut self) -> bool {
        let mut needed = self.flat.needed;
        while needed != 0 {
            let number = needed.trailing_zeros() as usize;
            needed &= needed - 1;
            if !self.ask(number) {
                return false;
            }
            let [near, far] = self.ends[number];
            self.before = larger(self.before, smaller(near, self.entry.0));
            self.entry = if near > self.entry.0 { (near, number) } else { self.entry };
            self.exit = smaller(self.exit, far);
            self.first = larger(self.first, near - self.close);
            self.last = smaller(self.last, far + self.close);
        }
        true
    }

    /// Asks a leaf for its chord. False if it has none that matters.
    #[inline(always)]
    fn ask(&mut self, number: usize) -> bool {
        self.missing &= !(1 << number);
        let Some(chord) = self.flat.leaves[number].chord(self.ray) else { return false };
        self.ends[number] = [chord.near, chord.far];
        self.faces[number] = [chord.entry, chord.exit];
        chord.far >= self.first && chord.near <= self.last
    }

    #[inline]
    fn crossing(&self, distance: f64, leaf: usize, by_exit: bool, exiting: bool) -> Crossing {
        let face = self.faces[leaf][usize::from(by_exit)];
        Crossing { distance, feature: Feature { part: leaf as u32, face, ..Feature::default() }, exiting }
    }

    /// The first crossing within an interval, if it can be told soon: where the line has entered all leaves that the body is
    /// within, or where it comes out of one that the body is beside. Of the other leaves it is enough to know on which side
    /// they have that place; their chords are not asked for.
    #[inline]
    pub(super) fn entry(&mut self, within: Interval) -> Option<Option<Crossing>> {
        let close = self.close;
        let (mut t, mut leaf) = self.entry;
        let mut by_exit = false;
        if !(t - within.min > close && t - self.before > close) {
            return None;
        }
        'passed: loop {
            if t > smaller(within.max, self.exit) + close {
                return Some(None);
            }
            if t > within.max || t + close >= self.exit {
                return None;
            }
            let (mut state, mut others) = (self.flat.needed as usize, self.flat.others);
            let place = self.ray.point_at(t);
            while others != 0 {
                let number = others.trailing_zeros() as usize;
                others &= others - 1;
                if by_exit && number == leaf {
                    continue;
                }
                if self.is_inside(number, t, place)? {
                    state |= 1 << number;
                    if self.flat.truth.is_beside(number) {
                        if self.missing >> number & 1 != 0 && !self.ask(number) {
                            return None;
                        }
                        let far = self.ends[number][1];
                        if far - t <= close {
                            return None;
                        }
                        (t, leaf, by_exit) = (far, number, true);
                        continue 'passed;
                    }
                }
            }
            return self.flat.truth.is_inside(state).then(|| Some(self.crossing(t, leaf, by_exit, false)));
        }
    }

    /// If a place on the line is inside of a leaf. Nothing if an end of its chord is close to it.
    #[inline(always)]
    fn is_inside(&self, number: usize, t: f64, place: Point3D) -> Option<bool> {
        if self.missing >> number & 1 != 0 {
            return self.flat.leaves[number].is_inside(place, 2.0 * self.margin);
        }
        let [near, far] = self.ends[number];
        let apart = (near - t).abs() > self.close && (far - t).abs() > self.close;
        apart.then_some(near < t && t < far)
    }

    /// Lends the crossings within an interval one by one, in order, as long as they are wanted. False if a tie rule may have
    /// to decide: then some may be missing.
    #[inline]
    pub(super) fn visit(
        &mut self,
        within: Interval,
        mut emit: impl FnMut(Crossing) -> ControlFlow<()>,
    ) -> bool {
        let probe = Probe::new(self.ray);
        if self.flat.bounds.as_ref().is_some_and(|bounds| !probe.meets(bounds, self.first, self.last)) {
            return true;
        }
        let mut truth = self.flat.truth;
        let mut others = self.flat.others;
        while others != 0 {
            let number = others.trailing_zeros() as usize;
            others &= others - 1;
            if !truth.depends_on(number) {
                self.ends[number] = [f64::INFINITY; 2];
            } else if self.missing >> number & 1 != 0
                && !(self.flat.leaves[number].may_meet(&probe, self.first, self.last) && self.ask(number))
            {
                self.ends[number] = [f64::INFINITY; 2];
                truth = truth.outside_of(number);
                if truth.is_constant() {
                    return true;
                }
            }
        }
        self.events(truth, within, &mut emit)
    }

    #[inline]
    fn events(
        &self,
        truth: Truth,
        within: Interval,
        emit: &mut impl FnMut(Crossing) -> ControlFlow<()>,
    ) -> bool {
        // The next end of each chord, and what is inside before it.
        let (mut next, mut state) = ([f64::INFINITY; LEAVES], 0);
        for (number, (next, [near, far])) in next.iter_mut().zip(&self.ends).enumerate() {
            let (begun, ended) = (*near < self.first, *far < self.first);
            state |= usize::from(begun & !ended) << number;
            let end = if begun { *far } else { *near };
            *next = if ended { f64::INFINITY } else { end };
        }
        let mut inside = truth.is_inside(state);
        let (mut number, mut t) = least(&next);
        while t <= within.max && t < f64::INFINITY {
            state ^= 1 << number;
            let enters = (state >> number) & 1 != 0;
            next[number] = if enters { self.ends[number][1] } else { f64::INFINITY };
            let after = least(&next);
            if after.1 - t <= self.close {
                return false;
            }
            let now = truth.is_inside(state);
            if now != inside && t >= within.min && emit(self.crossing(t, number, !enters, !now)).is_break() {
                return true;
            }
            inside = now;
            (number, t) = after;
        }
        true
    }
}

/// The greatest magnitude.
#[inline(always)]
fn greatest([x, y, z]: [f64; 3]) -> f64 {
    larger(larger(x.abs(), y.abs()), z.abs())
}

/// The first of the least numbers, and where it is.
#[inline(always)]
fn least(of: &[f64; LEAVES]) -> (usize, f64) {
    let (mut place, mut least) = (0, of[0]);
    for (number, &value) in of.iter().enumerate().skip(1) {
        place = if value < least { number } else { place };
        least = if value < least { value } else { least };
    }
    (place, least)
}
