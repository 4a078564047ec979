use raysect_core::{Crossing, Feature, Interval};

/// Where a line runs within a convex body, and by which faces it comes and goes.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Chord {
    /// Distance at which it enters.
    pub(crate) near: f64,
    /// Distance at which it leaves.
    pub(crate) far: f64,
    /// Face by which it enters.
    pub(crate) entry: u32,
    /// Face by which it leaves.
    pub(crate) exit: u32,
}

/// The features of faces. They are looked up, since a feature that is put together is written in smaller pieces than it
/// is read in, and who reads it then waits until all of them have reached memory.
const FACES: [Feature; 8] = {
    let mut all = [Feature { part: 0, face: 0, uv: [0.0; 2] }; 8];
    let mut number = 1;
    while number < all.len() {
        all[number].face = number as u32;
        number += 1;
    }
    all
};

impl Chord {
    /// Both crossings, in order.
    #[inline]
    pub(crate) fn crossings(&self) -> [Crossing; 2] {
        [Self::crossing(self.near, self.entry, false), Self::crossing(self.far, self.exit, true)]
    }

    /// The first of the two within an interval.
    #[inline]
    pub(crate) fn first(&self, within: Interval) -> Option<Crossing> {
        if within.contains(self.near) {
            return Some(Self::crossing(self.near, self.entry, false));
        }
        within.contains(self.far).then(|| Self::crossing(self.far, self.exit, true))
    }

    #[inline]
    pub(crate) fn crossing(distance: f64, face: u32, exiting: bool) -> Crossing {
        Crossing { distance, feature: FACES[face as usize % FACES.len()], exiting }
    }
}
