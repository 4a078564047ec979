/// Leaves that a table has room for.
pub(super) const LEAVES: usize = 6;

/// For each leaf, the states outside of it.
const OUTSIDE: [u64; LEAVES] = [
    0x5555_5555_5555_5555,
    0x3333_3333_3333_3333,
    0x0f0f_0f0f_0f0f_0f0f,
    0x00ff_00ff_00ff_00ff,
    0x0000_ffff_0000_ffff,
    0x0000_0000_ffff_ffff,
];

/// What is inside of a body made of a few leaves, one bit for each state. The number of a state has one bit for each leaf,
/// set inside of it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Truth(u64);

impl Truth {
    /// Of one leaf alone, by its number.
    pub(super) fn of(leaf: usize) -> Self {
        Self(!OUTSIDE[leaf])
    }

    /// From whether each state is inside.
    pub(super) fn from_states(inside: impl Fn(usize) -> bool) -> Self {
        Self((0..64).filter(|&state| inside(state)).map(|state| 1 << state).sum())
    }

    /// True if a state is inside of the body.
    #[inline]
    pub(super) fn is_inside(self, state: usize) -> bool {
        (self.0 >> (state & 63)) & 1 != 0
    }

    /// True if it matters anywhere whether one is inside of a leaf.
    #[inline]
    pub(super) fn depends_on(self, leaf: usize) -> bool {
        (self.0 ^ (self.0 >> (1u32 << leaf))) & OUTSIDE[leaf] != 0
    }

    /// True if nothing outside of a leaf is inside of the body.
    #[inline]
    pub(super) fn is_within(self, leaf: usize) -> bool {
        self.0 & OUTSIDE[leaf] == 0
    }

    /// What is left where one is outside of a leaf.
    #[inline]
    pub(super) fn outside_of(self, leaf: usize) -> Self {
        let outside = self.0 & OUTSIDE[leaf];
        Self(outside | (outside << (1u32 << leaf)))
    }

    /// True if nothing inside of a leaf is inside of the body.
    #[inline]
    pub(super) fn is_beside(self, leaf: usize) -> bool {
        self.0 & !OUTSIDE[leaf] == 0
    }

    /// True if no state is inside, or all are.
    #[inline]
    pub(super) fn is_constant(self) -> bool {
        self.0 == 0 || self.0 == u64::MAX
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn any(seed: u64) -> impl Fn(usize) -> bool {
        move |state| (seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) >> (state % 64)) & 1 != 0
    }

    #[test]
    fn questions_are_answered_as_by_going_through_all_states() {
        for seed in 0..200 {
            // Some leaves matter, others do not.
            let used = (seed as usize) % 64;
            let inside = |state: usize| any(seed)(state & used);
            let table = Truth::from_states(inside);
            for leaf in 0..LEAVES {
                let bit = 1 << leaf;
                let states = || (0..64).filter(|state| state & bit == 0);
                assert_eq!(table.depends_on(leaf), states().any(|s| inside(s) != inside(s | bit)));
                assert_eq!(table.is_within(leaf), !states().any(inside));
                assert_eq!(table.is_beside(leaf), !states().any(|s| inside(s | bit)));
                let left = table.outside_of(leaf);
                assert!((0..64).all(|s| left.is_inside(s) == inside(s & !bit)));
                assert!(!left.depends_on(leaf));
            }
            assert!((0..64).all(|s| table.is_inside(s) == inside(s)));
            assert_eq!(table.is_constant(), (0..64).all(|s| inside(s) == inside(0)));
        }
    }

    #[test]
    fn a_leaf_alone_is_itself() {
        for leaf in 0..LEAVES {
            assert_eq!(Truth::of(leaf), Truth::from_states(|state| state >> leaf & 1 != 0));
            assert!(Truth::of(leaf).is_within(leaf) && Truth::of(leaf).outside_of(leaf).is_constant());
        }
    }
}
