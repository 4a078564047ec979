//! Where lines cross a torus: one bracket about each crossing, and the root in it.

use raysect_math::Bracket;

use super::cubic::roots_of_depressed_cubic;
use super::tube::{Line, Span, Tube};

/// Where the depth along a line vanishes.
struct Root {
    s: f64,
    /// True if the line dips below the surface there by far more than rounding.
    is_clear: bool,
}

/// The crossings of a line, not yet computed: one in each bracket.
pub(super) struct Brackets {
    all: [Bracket; 4],
    count: usize,
    /// The places between which the depth is monotonic.
    level: [f64; 3],
}

impl Brackets {
    #[inline]
    pub(super) fn iter(&self) -> impl Iterator<Item = Bracket> + '_ {
        self.all[..self.count].iter().copied()
    }
}

impl Tube {
    /// One bracket about each crossing, in order.
    ///
    /// Between two places where the quartic is level lies one crossing or none. They need not be exact, since the
    /// quartic is flat there; what counts are the signs, and they come from `depth`.
    pub(super) fn brackets(&self, line: &Line, span: &Span) -> Brackets {
        let Span { first, last, quartic } = *span;
        let nowhere = Bracket { low: 0.0, high: 0.0, rising: false };
        let mut found =
            Brackets { all: [nowhere; 4], count: 0, level: roots_of_depressed_cubic(quartic.p, quartic.q) };
        let (mut low, mut outside) = (first, true);
        for high in found.level {
            if high > first && high < last {
                let out = self.depth(line.at(high)).0 > 0.0;
                if out != outside {
                    found.all[found.count] = Bracket { low, high, rising: out };
                    found.count += 1;
                }
                (low, outside) = (high, out);
            }
        }
        if !outside {
            found.all[found.count] = Bracket { low, high: last, rising: true };
            found.count += 1;
        }
        found
    }

    /// Distance along the ray of the crossing in a bracket, by steps on `depth`, which is well conditioned where the
    /// coefficients of the quartic are not.
    pub(super) fn crossing(&self, line: &Line, span: &Span, bracket: Bracket) -> f64 {
        line.distance(self.root(line, span, bracket).unwrap_or_else(|| self.safe_root(line, bracket)))
    }

    /// The root in a bracket, from the end of the span if it begins there, if it is found without being held.
    fn root(&self, line: &Line, span: &Span, bracket: Bracket) -> Option<f64> {
        let begins = if bracket.rising { bracket.high == span.last } else { bracket.low == span.first };
        let from_end = if begins { self.end_root(line, span, bracket.rising) } else { None };
        let root = from_end.map(|root| root.s).filter(|&s| s > bracket.low && s < bracket.high);
        root.or_else(|| self.inner_root(line, bracket))
    }

    /// Distance along the ray of the first crossing, if that can be told without the brackets: where the quartic is
    /// convex from the first end to a crossing that is no touch. It is what [`crossing`](Self::crossing) says of the
    /// first bracket.
    #[inline]
    pub(super) fn clear_entry(&self, line: &Line, span: &Span) -> Option<f64> {
        let root = self.end_root(line, span, false)?;
        (root.is_clear && span.quartic.is_outermost(root.s, false)).then(|| line.distance(root.s))
    }

    /// What a ray that begins on the surface meets next, if that can be told without the brackets: where the quartic is
    /// convex all the way onward, and the ray is not along the surface. Who goes outward meets nothing then, and who goes
    /// inward leaves at the distance that is given.
    #[inline]
    pub(super) fn clear_next(&self, line: &Line, span: &Span, inward: bool) -> Option<Option<f64>> {
        let (start, d) = (line.start(), line.direction);
        if !span.quartic.is_outermost(start, true) {
            return None;
        }
        let p = line.at(start);
        let rho = self.depth(p).1;
        let slope = (rho - self.major) * (p.x * d.x + p.y * d.y) + rho * (p.z * d.z);
        let is_clear = slope * slope >= self.around.clear * rho * (rho + self.major);
        if !is_clear || (slope < 0.0) != inward {
            return None;
        }
        if !inward {
            return Some(None);
        }
        let root = self.end_root(line, span, true)?;
        (root.s > start).then(|| Some(line.distance(root.s).max(0.0)))
    }

    /// The root that two steps on the quartic and some on the depth find from an end of a span.
    #[inline]
    fn end_root(&self, line: &Line, span: &Span, rising: bool) -> Option<Root> {
        let Span { first, last, quartic } = span;
        let near = quartic.halley(quartic.halley(if rising { *last } else { *first }));
        self.swift_root(line, near, Bracket { low: *first, high: *last, rising })
    }

    /// The root in a bracket from a parabola through both ends with its vertex at the inner one, where the depth is
    /// extremal.
    #[inline(never)]
    fn inner_root(&self, line: &Line, bracket: Bracket) -> Option<f64> {
        let Bracket { low, high, rising } = bracket;
        let (inner, outer) = if rising { (low, high) } else { (high, low) };
        let (inside, outside) = (self.depth(line.at(inner)).0, self.depth(line.at(outer)).0);
        let near = inner + (outer - inner) * (inside / (inside - outside)).sqrt();
        self.swift_root(line, near, bracket).map(|root| root.s)
    }

    /// The root in a bracket from a place near it, if Halley's method comes to it without being held.
    ///
    /// With f′ and f″ of the depth f along the line the error that a step x leaves is about x³ times (f″/2f′)² − f‴/6f′.
    /// The derivatives are at most 2 (1 + R/ρ) and 12/5 R/ρ² in size. Slope and bend are f′/2 and f″/2, times ρ and ρ³.
    #[inline(always)]
    fn swift_root(&self, line: &Line, near: f64, bracket: Bracket) -> Option<Root> {
        const STEPS: usize = 8;
        let d = line.direction;
        let flat = d.x * d.x + d.y * d.y;
        let tolerance = 0.0625 * f64::EPSILON * self.major;
        let mut s = near;
        for _ in 0..STEPS {
            let p = line.at(s);
            let (depth, rho) = self.depth(p);
            let outward = p.x * d.x + p.y * d.y;
            let slope = (rho - self.major) * outward + rho * (p.z * d.z);
            let squared = rho * rho;
            let bend = depth * (rho * squared - self.major * (flat * squared - outward * outward));
            let steep = slope * slope * rho;
            let step = 2.0 * depth * squared * slope / (4.0 * steep - bend);
            s -= step;
            let within = s > bracket.low && s < bracket.high && (slope > 0.0) == bracket.rising;
            if !within {
                return None;
            }
            let wide = rho + self.major;
            let error = (step * step * step).abs() * (wide * wide * rho + 0.2 * self.major * slope.abs());
            if bend.abs() < steep && error <= tolerance * steep {
                return Some(Root { s, is_clear: steep >= self.around.clear * squared * wide });
            }
        }
        None
    }

    /// The root in a bracket, however flat the depth is there.
    #[cold]
    fn safe_root(&self, line: &Line, bracket: Bracket) -> f64 {
        let rounding = f64::EPSILON * self.major;
        let d = line.direction;
        bracket.newton(rounding, |s| {
            let p = line.at(s);
            let (depth, rho) = self.depth(p);
            let slope = 2.0 * ((rho - self.major) * (p.x * d.x + p.y * d.y) / rho + p.z * d.z);
            // Below the rounding of coordinates there is nothing left to find.
            (if depth.abs() <= rounding * self.minor { 0.0 } else { depth }, slope)
        })
    }

    /// True if a line, from where a ray leaves the surface to the start of a bracket, goes no farther from the surface
    /// than it is: then the crossing in this bracket is the one that is being left.
    ///
    /// If the rounded origin lies on the wrong side, the way to that crossing leads towards the surface. Only where
    /// the direction itself is along the surface to rounding can it go away from it first, by far less than that.
    #[cold]
    pub(super) fn clings(&self, line: &Line, brackets: &Brackets, bracket: Bracket) -> bool {
        let start = line.start();
        let error = 4.0 * self.height(line.at(start)).abs() + 16.0 * f64::EPSILON * (self.major + self.minor);
        let mut between = brackets.level.iter().filter(|&&s| s > start && s <= bracket.low);
        between.all(|&s| self.height(line.at(s)).abs() <= error)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use raysect_core::Ray;
    use raysect_math::{Point3D, Rng, Vector3D};

    #[test]
    fn the_swift_way_finds_the_roots_of_the_safe_one() {
        let mut rng = Rng::new(3);
        for minor in [1e-6, 0.1, 0.43, 1.0] {
            let tube = Tube::new(1.0, minor);
            let (mut swift, mut all) = (0, 0);
            let mut draw = |size: f64| {
                Vector3D::new(rng.range(-size, size), rng.range(-size, size), rng.range(-size, size))
            };
            for _ in 0..20_000 {
                let beside = draw(1.0).normalise_unchecked() * minor;
                let ray = Ray::new(Point3D::new(1.0, 0.0, 0.0) + beside * 0.9, draw(1.0));
                let line = tube.line(&ray);
                let Some(span) = tube.span(&line) else { continue };
                for bracket in tube.brackets(&line, &span).iter() {
                    all += 1;
                    let Some(root) = tube.root(&line, &span, bracket) else { continue };
                    swift += 1;
                    let safe = tube.safe_root(&line, bracket);
                    // Rounding across the surface, which a line along it crosses over a longer way.
                    let slope =
                        (tube.gradient(Point3D::ORIGIN + line.at(safe) * tube.unit).dot(line.direction)
                            / minor)
                            .abs();
                    let doubt = 8.0 * f64::EPSILON * (tube.major + minor) / slope;
                    assert!((root - safe).abs() <= doubt, "{minor}: {root} {safe} {slope}");
                }
            }
            assert!(all > 30_000 && swift as f64 > 0.9 * all as f64, "{minor}: {swift} of {all}");
        }
    }

    /// What is told without brackets is what the first bracket says, to the bit, and most of what is met is told so.
    #[test]
    fn clear_entries_are_the_first_of_all() {
        let mut rng = Rng::new(4);
        for (minor, share) in [(1e-9, 0.0), (1e-6, 0.5), (0.1, 0.7), (0.43, 0.7), (1.0, 0.7)] {
            let tube = Tube::new(1.0, minor);
            let (mut clear, mut all) = (0, 0);
            for _ in 0..40_000 {
                let mut draw =
                    || Vector3D::new(rng.range(-1.0, 1.0), rng.range(-1.0, 1.0), rng.range(-1.0, 1.0));
                let beside = draw().normalise_unchecked() * (1.2 * minor);
                let line = tube.line(&Ray::new(Point3D::new(1.0, 0.0, 0.0) + beside, draw()));
                let Some(span) = tube.span(&line) else { continue };
                let first = tube.brackets(&line, &span).iter().next();
                all += usize::from(first.is_some());
                let Some(entry) = tube.clear_entry(&line, &span) else { continue };
                clear += 1;
                assert_eq!(first.map(|b| tube.crossing(&line, &span, b)), Some(entry), "{minor}");
            }
            assert!(all > 20_000 && clear as f64 >= share * all as f64, "{minor}: {clear} of {all}");
        }
    }
}
