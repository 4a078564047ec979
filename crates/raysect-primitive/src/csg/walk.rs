use std::ops::ControlFlow;

use raysect_core::{Crossing, Feature, Interval, Ray};

use super::flat::Flat;
use super::truth::{LEAVES, Truth};
use crate::select::{larger, smaller};

/// A line on its way through the leaves of a composite.
pub(super) struct Walk<'a> {
    flat: &'a Flat,
    ray: &'a Ray,
    /// Crossings that are nearer to each other may be one event.
    close: f64,
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
    /// With the chords of the leaves that the body is within. Nothing if numbers overflow, nothing within if the line does
    /// not meet the body in the interval.
    #[inline]
    pub(super) fn new(flat: &'a Flat, ray: &'a Ray, within: Interval) -> Option<Option<Self>> {
        let close = flat.close_length(ray) / greatest(ray.direction.to_array());
        if close.is_nan() || close == f64::INFINITY {
            return None;
        }
        let mut walk = Self {
            flat,
            ray,
            close,
            first: within.min - close,
            last: within.max + close,
            ends: [[f64::INFINITY; 2]; LEAVES],
            faces: [[0; 2]; LEAVES],
            missing: flat.others,
            entry: (f64::NEG_INFINITY, 0),
            before: f64::NEG_INFINITY,
            exit: f64::INFINITY,
        };
        let mut needed = flat.needed;
        while needed != 0 {
            let number = needed.trailing_zeros() as usize;
            needed &= needed - 1;
            if !walk.ask(number) {
                return Some(None);
            }
            let [near, far] = walk.ends[number];
            walk.before = larger(walk.before, smaller(near, walk.entry.0));
            walk.entry = if near > walk.entry.0 { (near, number) } else { walk.entry };
            walk.exit = smaller(walk.exit, far);
            walk.first = larger(walk.first, near - close);
            walk.last = smaller(walk.last, far + close);
        }
        Some(Some(walk))
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
    fn crossing(&self, distance: f64, leaf: usize, leaves: bool, exiting: bool) -> Crossing {
        let face = self.faces[leaf][usize::from(leaves)];
        Crossing { distance, feature: Feature { part: leaf as u32, face, ..Feature::default() }, exiting }
    }

    /// The first crossing within an interval, if it can be told from the leaves that are met there: the ray enters all that
    /// the body is within, and passes through those that the body is beside. Of most others it is enough to know on which
    /// side they have that place.
    #[inline]
    pub(super) fn entry(&mut self, within: Interval) -> Option<Option<Crossing>> {
        let close = self.close;
        let (mut t, mut leaf) = self.entry;
        let mut leaves = false;
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
                if leaves && number == leaf {
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
                        (t, leaf, leaves) = (far, number, true);
                        continue 'passed;
                    }
                }
            }
            return self.flat.truth.is_inside(state).then(|| Some(self.crossing(t, leaf, leaves, false)));
        }
    }

    /// If a place on the line is inside of a leaf. Nothing if an end of its chord is close to it.
    #[inline(always)]
    fn is_inside(&self, number: usize, t: f64, place: raysect_math::Point3D) -> Option<bool> {
        if self.missing >> number & 1 != 0 {
            return self.flat.leaves[number].is_inside(place, 2.0 * self.flat.close_length(self.ray));
        }
        let [near, far] = self.ends[number];
        let apart = (near - t).abs() > self.close && (far - t).abs() > self.close;
        apart.then_some(near < t && t < far)
    }

    /// Lends the crossings within an interval one by one, in order, as long as they are wanted. False if a tie rule may have
    /// to decide: what has been lent is right, but there may be more.
    #[inline]
    pub(super) fn visit(
        &mut self,
        within: Interval,
        mut emit: impl FnMut(Crossing) -> ControlFlow<()>,
    ) -> bool {
        let mut truth = self.flat.truth;
        let mut others = self.flat.others;
        while others != 0 {
            let number = others.trailing_zeros() as usize;
            others &= others - 1;
            if !truth.depends_on(number) {
                self.ends[number] = [f64::INFINITY; 2];
            } else if self.missing >> number & 1 != 0 && !self.ask(number) {
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
pub(super) fn greatest([x, y, z]: [f64; 3]) -> f64 {
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
