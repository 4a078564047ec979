//! The quartic of a line and a torus.

/// A quarter of a quartic without a cubic term, s⁴/4 + p s²/2 + q s + `rest`; its slope is s³ + p s + q.
#[derive(Debug, Clone, Copy)]
pub(super) struct Quartic {
    pub(super) p: f64,
    pub(super) q: f64,
    pub(super) rest: f64,
}

impl Quartic {
    /// A step of Halley's method: from beside a convex piece with two roots at any distance towards the nearer one.
    #[inline]
    pub(super) fn halley(&self, s: f64) -> f64 {
        let squared = s * s;
        let value = squared * (0.25 * squared + 0.5 * self.p) + (self.q * s + self.rest);
        let slope = s * (squared + self.p) + self.q;
        let half_bend = 1.5 * squared + 0.5 * self.p;
        s - value * slope / (slope * slope - value * half_bend)
    }

    /// True if a root at which the quartic falls is the first of all, or the last of all for one at which it rises: it
    /// is convex from there to the end.
    #[inline]
    pub(super) fn is_outermost(&self, s: f64, rising: bool) -> bool {
        self.p >= 0.0 || ((s > 0.0) == rising && 3.0 * s * s + self.p > 0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A quarter of (s² − 1)² − (3/4)²: roots ± 1/2 and ± √7/2, bent inward within ± 1/√3.
    const SAMPLE: Quartic = Quartic { p: -1.0, q: 0.0, rest: 7.0 / 64.0 };

    #[test]
    fn steps_come_to_the_nearer_root() {
        let (inner, outer) = (0.5, 0.875f64.sqrt() * 2f64.sqrt());
        for (mut s, root) in [(-2.0, -outer), (2.5, outer), (0.3, inner), (-0.4, -inner)] {
            for _ in 0..6 {
                s = SAMPLE.halley(s);
            }
            assert!((s - root).abs() < 1e-15, "{s} {root}");
        }
    }

    #[test]
    fn the_outermost_roots_are_known() {
        let outer = 1.75f64.sqrt();
        assert!(SAMPLE.is_outermost(-outer, false) && SAMPLE.is_outermost(outer, true));
        assert!(!SAMPLE.is_outermost(outer, false) && !SAMPLE.is_outermost(-outer, true));
        assert!(!SAMPLE.is_outermost(-0.5, false) && !SAMPLE.is_outermost(0.5, true));
        let bowl = Quartic { p: 0.5, ..SAMPLE };
        assert!(bowl.is_outermost(0.1, false) && bowl.is_outermost(-0.1, true));
    }
}
