use raysect_core::Ray;
use raysect_math::error_free::add_product;
use raysect_math::{Bracket, Point3D, Vector3D};

/// The radii of a torus in a unit of its own, and where lines cross it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Tube {
    /// The power of two in which lengths are measured, so that nothing over- or underflows [m].
    pub(super) unit: f64,
    /// Of the circle in the middle, 1 … 2.
    pub(super) major: f64,
    /// Of the tube.
    pub(super) minor: f64,
}

/// The line of a ray, measured from its closest approach to the centre, in units of the tube.
pub(super) struct Line {
    /// The point of closest approach.
    miss: Vector3D,
    /// Unit vector.
    direction: Vector3D,
    /// The point of closest approach along the ray, as a sum of a large and a small part.
    closest: (f64, f64),
    /// The unit vector in units of the ray's direction.
    stretch: f64,
    unit: f64,
}

/// The crossings of a line, not yet computed: one in each bracket.
pub(super) struct Brackets {
    all: [Bracket; 4],
    count: usize,
    /// The places between which the depth is monotonic.
    level: [f64; 3],
}

impl Line {
    #[inline]
    fn at(&self, s: f64) -> Vector3D {
        self.miss + self.direction * s
    }

    /// Distance along the ray of a place on the line.
    #[inline]
    pub(super) fn distance(&self, s: f64) -> f64 {
        (self.closest.0 + (self.closest.1 + s * self.stretch)) * self.unit
    }

    /// The place on the line where the ray begins.
    fn start(&self) -> f64 {
        -(self.closest.0 + self.closest.1) / self.stretch
    }
}

impl Brackets {
    #[inline]
    pub(super) fn iter(&self) -> impl Iterator<Item = Bracket> + '_ {
        self.all[..self.count].iter().copied()
    }
}

impl Tube {
    pub(super) fn new(major_radius: f64, minor_radius: f64) -> Self {
        let exponent = 0x7ff0_0000_0000_0000;
        let unit = f64::from_bits(major_radius.to_bits() & exponent);
        Self { unit, major: major_radius / unit, minor: minor_radius / unit }
    }

    /// The line of a ray, unless it is clear of the bounding sphere.
    ///
    /// The point of closest approach is summed without rounding on the way, so that it is as good from afar as from
    /// near.
    #[inline]
    pub(super) fn line(&self, ray: &Ray) -> Option<Line> {
        let d = ray.direction;
        let o = ray.origin.to_vector() * (1.0 / self.unit);
        let squared = d.length_squared();
        let closest = -o.dot(d) / squared;
        let rough = o + d * closest;
        let reach = (self.major + self.minor) * 1.000_001 + 16.0 * f64::EPSILON * o.max_abs();
        if rough.length_squared() > reach * reach {
            return None;
        }
        let miss = Vector3D::new(
            add_product(o.x, d.x, closest),
            add_product(o.y, d.y, closest),
            add_product(o.z, d.z, closest),
        );
        let rest = -miss.dot(d) / squared;
        let stretch = 1.0 / squared.sqrt();
        let (miss, direction) = (miss + d * rest, d * stretch);
        Some(Line { miss, direction, closest: (closest, rest), stretch, unit: self.unit })
    }

    /// Where a line can meet the torus: its piece in the bounding sphere and between the planes that touch the
    /// torus, unless that lies in the hole. Both ends are outside, with a margin far above rounding.
    #[inline]
    fn chord(&self, line: &Line) -> Option<(f64, f64)> {
        let margin = 1e-9 * self.minor + 8.0 * f64::EPSILON * self.major;
        let reach = self.major + self.minor + margin;
        let squared = reach * reach - line.miss.length_squared();
        if squared <= 0.0 {
            return None;
        }
        let half = squared.sqrt();
        let (mut low, mut high) = (-half, half);
        let (height, z, dz) = (self.minor + margin, line.miss.z, line.direction.z);
        if dz != 0.0 {
            let (a, b) = ((-height - z) / dz, (height - z) / dz);
            low = low.max(a.min(b));
            high = high.min(a.max(b));
        } else if z.abs() > height {
            return None;
        }
        if low >= high {
            return None;
        }
        let hole = self.major - self.minor - margin;
        let in_hole = |s: f64| {
            let p = line.at(s);
            p.x * p.x + p.y * p.y < hole * hole
        };
        (hole <= 0.0 || !in_hole(low) || !in_hole(high)).then_some((low, high))
    }

    /// (ρ − R)² + z² − r² with ρ = √(x² + y²), negative inside; and ρ.
    #[inline]
    pub(super) fn depth(&self, p: Vector3D) -> (f64, f64) {
        let rho = (p.x * p.x + p.y * p.y).sqrt();
        let across = rho - self.major;
        (across * across - (self.minor - p.z) * (self.minor + p.z), rho)
    }

    /// Outward from the circle in the middle through a point [m], in units of the tube.
    pub(super) fn gradient(&self, point: Point3D) -> Vector3D {
        let p = point.to_vector() * (1.0 / self.unit);
        let rho = (p.x * p.x + p.y * p.y).sqrt();
        let stretch = if rho > 0.0 { (rho - self.major) / rho } else { 0.0 };
        Vector3D::new(p.x * stretch, p.y * stretch, p.z)
    }

    /// Distance from the surface, negative inside.
    fn height(&self, p: Vector3D) -> f64 {
        let (depth, rho) = self.depth(p);
        let across = rho - self.major;
        depth / ((across * across + p.z * p.z).sqrt() + self.minor)
    }

    /// One bracket about each crossing, in order.
    ///
    /// Along the line |p|² = s² + m². The quartic (s² + m² + R² − r²)² − 4 R² ρ² has the sign of `depth`, and a quarter
    /// of its derivative is s³ + p s + q: between two roots of this cubic lies one crossing or none. The roots need not
    /// be exact, since the quartic is flat there; what counts are the signs, and they come from `depth`.
    #[inline]
    pub(super) fn brackets(&self, line: &Line) -> Brackets {
        let nowhere = Bracket { low: 0.0, high: 0.0, rising: false };
        let mut found = Brackets { all: [nowhere; 4], count: 0, level: [f64::NAN; 3] };
        let Some((first, last)) = self.chord(line) else { return found };
        let squared = self.major * self.major;
        let (m, dz) = (line.miss.length(), line.direction.z);
        let p = (m - self.major) * (m + self.major) - self.minor * self.minor + 2.0 * squared * dz * dz;
        let q = 2.0 * squared * line.miss.z * dz;
        found.level = roots_of_depressed_cubic(p, q);
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

    /// Distance along the ray of the crossing in a bracket, by Newton's method on `depth`, which is well conditioned
    /// where the coefficients of the quartic are not.
    #[inline]
    pub(super) fn crossing(&self, line: &Line, bracket: Bracket) -> f64 {
        line.distance(self.swift_root(line, bracket).unwrap_or_else(|| self.safe_root(line, bracket)))
    }

    /// The root in a bracket, if Newton's method comes to it without being held.
    ///
    /// It begins on a parabola through both ends with its vertex at the inner one, where the depth is extremal. The
    /// second derivative of the depth along the line is at most 2 (1 + R/ρ) in size, so that half of that, times the
    /// square of a step, over the slope bounds the error that the step leaves.
    #[inline]
    fn swift_root(&self, line: &Line, bracket: Bracket) -> Option<f64> {
        const STEPS: usize = 8;
        let (inner, outer) =
            if bracket.rising { (bracket.low, bracket.high) } else { (bracket.high, bracket.low) };
        let (inside, outside) = (self.depth(line.at(inner)).0, self.depth(line.at(outer)).0);
        let d = line.direction;
        let tolerance = 0.0625 * f64::EPSILON * self.major;
        let mut s = inner + (outer - inner) * (inside / (inside - outside)).sqrt();
        for _ in 0..STEPS {
            let p = line.at(s);
            let (depth, rho) = self.depth(p);
            // Half the slope, times ρ.
            let slope = (rho - self.major) * (p.x * d.x + p.y * d.y) + rho * (p.z * d.z);
            let step = 0.5 * depth * rho / slope;
            s -= step;
            let within = s > bracket.low && s < bracket.high;
            if !within {
                return None;
            }
            if step * step * (rho + self.major) <= tolerance * slope.abs() {
                return Some(s);
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

/// A number at most an eighth above the cube root, and not below it: a third of the exponent, with the fraction taken as
/// part of it (W. Kahan, K. Ng, 1991, in the comments of the C library's `cbrt`: wrong by 5 % at most).
#[inline]
fn above_cube_root(x: f64) -> f64 {
    if x < 1e-290 {
        return x.cbrt();
    }
    1.0625 * f64::from_bits(x.to_bits() / 3 + (715_094_163 << 32))
}

/// The real roots of s³ + p s + q in ascending order, to some roundings, with NaN for those that are not there; of a
/// double root two or none.
///
/// The root of the largest size is alone on its side of 0, so that Newton's method comes down to it from any bound
/// without a detour; the other two have a sum and a product that follow from it without cancellation.
#[inline]
fn roots_of_depressed_cubic(p: f64, q: f64) -> [f64; 3] {
    let size = q.abs();
    let single = p >= 0.0 || 27.0 * q * q > -4.0 * p * p * p;
    // Upper bounds on the root a of a³ + p a − |q|.
    let mut a = match single {
        false => 2.0 * (-p / 3.0).sqrt(),
        true if p > 0.0 => above_cube_root(size).min(size / p),
        true => above_cube_root(size) + (-p).sqrt(),
    };
    for _ in 0..60 {
        let step = (a * (a * a + p) - size) / (3.0 * a * a + p);
        // A triple root at 0 makes it NaN.
        if step.is_nan() {
            break;
        }
        a -= step;
        // Since a² ≥ −p, one and a half times the square of a step bounds the error that it leaves, in units of a.
        if step <= 1e-8 * a {
            break;
        }
    }
    let discriminant = a * a - 4.0 * size / a;
    if discriminant.is_nan() || discriminant < 0.0 {
        return [-a.copysign(q), f64::NAN, f64::NAN];
    }
    let far = 0.5 * (a + discriminant.sqrt());
    let near = size / a / far;
    if q >= 0.0 { [-a, near, far] } else { [-far, -near, a] }
}

#[cfg(test)]
mod tests {
    use super::*;
    use raysect_math::{Rng, solve_cubic};

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
                let Some(line) = tube.line(&ray) else { continue };
                for bracket in tube.brackets(&line).iter() {
                    all += 1;
                    let Some(root) = tube.swift_root(&line, bracket) else { continue };
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

    #[test]
    fn depressed_cubics_as_the_general_solver_has_them() {
        let mut rng = Rng::new(2);
        for number in 0..30_000 {
            let orders = 10f64.powf(rng.range(-12.0, 0.0));
            let p = rng.range(-1.0, 1.0) * if number % 2 == 0 { 1.0 } else { orders };
            let q = rng.range(-1.0, 1.0) * if number % 3 == 0 { orders } else { p.abs().powf(1.5) };
            let exact = solve_cubic(1.0, 0.0, p, q);
            let found = roots_of_depressed_cubic(p, q).into_iter().filter(|s| !s.is_nan());
            let found: Vec<f64> = found.collect();
            let double = (4.0 * p.powi(3) + 27.0 * q * q).abs() < 1e-13 * q * q;
            assert!(found.len() == exact.len() || double, "{p} {q}: {found:?} {exact:?}");
            for (a, b) in found.iter().zip(exact.iter()).filter(|_| !double) {
                // The slope at the smaller two vanishes at a double root.
                let slope = (3.0 * b * b + p).abs() / (3.0 * b * b + p.abs());
                assert!((a - b).abs() <= 1e-14 * b.abs() / slope.max(1e-6), "{p} {q}: {found:?} {exact:?}");
            }
        }
        assert_eq!(roots_of_depressed_cubic(-1.0, 0.0), [-1.0, 0.0, 1.0]);
        assert_eq!(roots_of_depressed_cubic(0.0, -8.0)[0], 2.0);
        for (p, q) in [(0.0, 0.0), (1.0, 0.0), (1e-300, -0.0)] {
            assert_eq!(
                roots_of_depressed_cubic(p, q).into_iter().filter(|&s| s == 0.0).count(),
                1,
                "{p} {q}"
            );
        }
    }
}
