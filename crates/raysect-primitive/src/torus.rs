use raysect_core::{
    BoundingBox3D, BoundingSphere3D, Crossing, Departure, Feature, Interval, Primitive, Ray, Scratch, Surface,
};
use raysect_math::error_free::add_product;
use raysect_math::{AffineMatrix3D, Bracket, MathError, Normal3D, Point3D, Roots, Vector3D, solve_cubic};

use crate::PrimitiveError;

/// A ring: a tube about a circle in the plane z = 0.
///
/// Its axis is z. A tube as wide as the circle (`minor_radius` = `major_radius`) closes the hole to a point.
///
/// ```
/// use raysect_primitive::Torus;
/// let ring = Torus::new(1.0, 0.25)?;
/// assert!((ring.volume() / ring.surface_area() - 0.125).abs() < 1e-15);
/// assert!(Torus::new(1.0, 1.5).is_err());
/// # Ok::<(), raysect_primitive::PrimitiveError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Torus {
    major_radius: f64,
    minor_radius: f64,
    /// The power of two in which lengths are measured inside, so that nothing over- or underflows [m].
    unit: f64,
    /// The radii in this unit; the major one lies in 1 … 2.
    major: f64,
    minor: f64,
}

impl Default for Torus {
    /// Major radius 1 m, minor radius 0.5 m.
    fn default() -> Self {
        Self { major_radius: 1.0, minor_radius: 0.5, unit: 1.0, major: 1.0, minor: 0.5 }
    }
}

/// The line of a ray, measured from its closest approach to the centre, in units of the torus.
struct Line {
    /// The point of closest approach.
    miss: Vector3D,
    /// Unit vector.
    direction: Vector3D,
    /// The point of closest approach along the ray, as a sum of a large and a small part.
    closest: (f64, f64),
    /// The length of the unit in units of the ray's direction.
    stretch: f64,
}

/// The crossings of a line, not yet computed: one in each bracket.
#[derive(Default)]
struct Brackets {
    all: [Option<Bracket>; 4],
    /// The places between which the depth is monotonic.
    critical: Roots<3>,
}

impl Torus {
    /// From the radius of the circle in the middle of the tube and the radius of the tube [m].
    ///
    /// # Errors
    /// [`PrimitiveError::Dimension`] unless the major radius lies in 1e-100 … 1e100 m, and the minor radius in
    /// 1e-9 … 1 times the major radius: a thinner tube would be as wide as the rounding of coordinates.
    pub fn new(major_radius: f64, minor_radius: f64) -> Result<Self, PrimitiveError> {
        let refuse = |source| PrimitiveError::Dimension { shape: "torus", source };
        let admitted = (1e-100..=1e100).contains(&major_radius);
        MathError::check(admitted, major_radius, "major_radius", "m", "1e-100 … 1e100 m").map_err(refuse)?;
        let admitted = minor_radius >= 1e-9 * major_radius && minor_radius <= major_radius;
        MathError::check(admitted, minor_radius, "minor_radius", "m", "1e-9 … 1 times major_radius")
            .map_err(refuse)?;
        let exponent = 0x7ff0_0000_0000_0000;
        let unit = f64::from_bits(major_radius.to_bits() & exponent);
        let (major, minor) = (major_radius / unit, minor_radius / unit);
        Ok(Self { major_radius, minor_radius, unit, major, minor })
    }

    /// The radius of the circle in the middle of the tube [m].
    pub fn major_radius(&self) -> f64 {
        self.major_radius
    }

    /// The radius of the tube [m].
    pub fn minor_radius(&self) -> f64 {
        self.minor_radius
    }

    /// The volume, 2 π² R r² [m³].
    pub fn volume(&self) -> f64 {
        0.5 * self.minor_radius * self.surface_area()
    }

    /// The area of the surface, 4 π² R r [m²].
    pub fn surface_area(&self) -> f64 {
        let circumferences = std::f64::consts::TAU * std::f64::consts::TAU;
        circumferences * self.major_radius * self.minor_radius
    }

    /// The line of a ray, unless it is clear of the bounding sphere.
    ///
    /// The point of closest approach is summed without rounding on the way, so that it is as good from afar as from
    /// near.
    #[inline]
    fn line(&self, ray: &Ray) -> Option<Line> {
        let d = ray.direction;
        let o = ray.origin.to_vector() * (1.0 / self.unit);
        let squared = d.length_squared();
        let closest = -o.dot(d) / squared;
        let rough = o + d * closest;
        let reach = (self.major + self.minor) * 1.000_001 + 8.0 * f64::EPSILON * o.max_abs();
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
        Some(Line { miss: miss + d * rest, direction: d * stretch, closest: (closest, rest), stretch })
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
    fn depth(&self, p: Vector3D) -> (f64, f64) {
        let rho = (p.x * p.x + p.y * p.y).sqrt();
        let across = rho - self.major;
        (across * across - (self.minor - p.z) * (self.minor + p.z), rho)
    }

    /// One bracket about each crossing, in order.
    ///
    /// Along the line |p|² = s² + m². The quartic (s² + m² + R² − r²)² − 4 R² ρ² has the sign of `depth`, and a quarter
    /// of its derivative is s³ + p s + q: between two roots of this cubic lies one crossing or none. The roots need not
    /// be exact, since the quartic is flat there; what counts are the signs, and they come from `depth`.
    #[inline]
    fn brackets(&self, line: &Line) -> Brackets {
        let mut found = Brackets::default();
        let Some((first, last)) = self.chord(line) else { return found };
        let squared = self.major * self.major;
        let (m, dz) = (line.miss.length(), line.direction.z);
        let p = (m - self.major) * (m + self.major) - self.minor * self.minor + 2.0 * squared * dz * dz;
        let q = 2.0 * squared * line.miss.z * dz;
        found.critical = solve_cubic(1.0, 0.0, p, q);
        let within = found.critical.iter().copied().filter(|&s| s > first && s < last);
        let (mut low, mut outside, mut count) = (first, true, 0);
        for high in within {
            let out = self.depth(line.at(high)).0 > 0.0;
            if out != outside {
                found.all[count] = Some(Bracket { low, high, rising: out });
                count += 1;
            }
            (low, outside) = (high, out);
        }
        if !outside {
            found.all[count] = Some(Bracket { low, high: last, rising: true });
        }
        found
    }

    /// The crossing in a bracket, by Newton's method on `depth`, which is well conditioned where the coefficients of
    /// the quartic are not.
    #[inline]
    fn crossing(&self, line: &Line, bracket: Bracket) -> Crossing {
        let rounding = f64::EPSILON * self.major;
        let d = line.direction;
        let root = bracket.newton(rounding, |s| {
            let p = line.at(s);
            let (depth, rho) = self.depth(p);
            let slope = 2.0 * ((rho - self.major) * (p.x * d.x + p.y * d.y) / rho + p.z * d.z);
            // Below the rounding of coordinates there is nothing left to find.
            (if depth.abs() <= rounding * self.minor { 0.0 } else { depth }, slope)
        });
        self.crossing_at(self.distance(line, root), bracket.rising)
    }

    #[inline]
    fn crossing_at(&self, distance: f64, exiting: bool) -> Crossing {
        Crossing { distance, feature: Feature::default(), exiting }
    }

    /// Distance from the surface, negative inside.
    fn height(&self, p: Vector3D) -> f64 {
        let (depth, rho) = self.depth(p);
        let across = rho - self.major;
        depth / ((across * across + p.z * p.z).sqrt() + self.minor)
    }

    /// True if a line, from where a ray leaves the surface to the start of a bracket, goes no farther from the surface
    /// than it is: then the crossing in this bracket is the one that is being left.
    ///
    /// If the rounded origin lies on the wrong side, the way to that crossing leads towards the surface. Only where
    /// the direction itself is along the surface to rounding can it go away from it first, by far less than that.
    #[cold]
    fn clings(&self, line: &Line, critical: &[f64], bracket: Bracket) -> bool {
        let start = -(line.closest.0 + line.closest.1) / line.stretch;
        let error = 4.0 * self.height(line.at(start)).abs() + 16.0 * f64::EPSILON * (self.major + self.minor);
        let mut between = critical.iter().filter(|&&s| s > start && s <= bracket.low);
        between.all(|&s| self.height(line.at(s)).abs() <= error)
    }

    /// Distance along the ray of a place on its line.
    #[inline]
    fn distance(&self, line: &Line, s: f64) -> f64 {
        (line.closest.0 + (line.closest.1 + s * line.stretch)) * self.unit
    }
}

impl Line {
    #[inline]
    fn at(&self, s: f64) -> Vector3D {
        self.miss + self.direction * s
    }
}

impl Brackets {
    #[inline]
    fn iter(&self) -> impl Iterator<Item = Bracket> + '_ {
        self.all.iter().map_while(|b| *b)
    }
}

impl Primitive for Torus {
    fn bounding_box(&self, m: &AffineMatrix3D) -> BoundingBox3D {
        // The circle reaches R times the length of a row's x and y along that axis of the world, the tube r times the
        // length of the whole row.
        let centre = m.origin();
        let mut image = BoundingBox3D { lower: centre, upper: centre };
        for axis in 0..3 {
            let row = Vector3D::new(m.get(axis, 0), m.get(axis, 1), m.get(axis, 2));
            let reach = self.major_radius * Vector3D::new(row.x, row.y, 0.0).length()
                + self.minor_radius * row.length();
            let size = (self.major_radius + self.minor_radius) * row.length();
            image.pad_axis(axis, reach + 8.0 * f64::EPSILON * (size + centre[axis].abs()));
        }
        image
    }

    fn bounding_sphere(&self, m: &AffineMatrix3D) -> BoundingSphere3D {
        match m.similarity_scale() {
            Some(scale) => {
                let radius = (self.major_radius + self.minor_radius) * scale * 1.000_000_001;
                BoundingSphere3D { centre: m.origin(), radius }
            }
            None => self.bounding_box(m).enclosing_sphere(),
        }
    }

    fn contains(&self, point: Point3D) -> bool {
        self.depth(point.to_vector() * (1.0 / self.unit)).0 <= 0.0
    }

    fn crossings(&self, ray: &Ray, _: &mut Scratch, out: &mut Vec<Crossing>) {
        if let Some(line) = self.line(ray) {
            out.extend(self.brackets(&line).iter().map(|b| self.crossing(&line, b)));
        }
    }

    fn hit(&self, ray: &Ray, within: Interval, _: &mut Scratch) -> Option<Crossing> {
        let line = self.line(ray)?;
        let brackets = self.brackets(&line);
        // A bracket that ends before the interval begins need not be searched.
        let mut ahead = brackets.iter().filter(|b| self.distance(&line, b.high) >= within.min);
        let first = ahead.find_map(|b| {
            let c = self.crossing(&line, b);
            (c.distance >= within.min).then_some(c)
        });
        first.filter(|c| c.distance <= within.max)
    }

    /// Who goes inward leaves next, who goes outward enters next. If the line through the rounded origin is on the
    /// wrong side there, it has still to pass the crossing that is being left; unless that has vanished: then it has
    /// been left by less than rounding, and the answer is 0.
    fn hit_after(&self, ray: &Ray, left: &Departure, max_distance: f64, _: &mut Scratch) -> Option<Crossing> {
        let here = Some(self.crossing_at(0.0, left.inward));
        let next = match self.line(ray) {
            None => here.filter(|_| left.inward),
            Some(line) => {
                let brackets = self.brackets(&line);
                let inside = |(index, _): &(usize, _)| index % 2 == 1;
                let crossings = brackets.iter().map(|b| (b, self.crossing(&line, b)));
                let mut ahead = crossings.enumerate().skip_while(|(_, (_, c))| c.distance <= 0.0).peekable();
                let is_inside = ahead.peek().is_some_and(inside);
                let first = ahead.next().map(|(_, c)| c);
                if is_inside == left.inward {
                    first.map(|(_, c)| c)
                } else if first.is_some_and(|(b, _)| self.clings(&line, &brackets.critical, b)) {
                    ahead.next().map(|(_, (_, c))| c)
                } else {
                    here
                }
            }
        };
        next.filter(|c| c.distance <= max_distance)
    }

    fn surface(&self, ray: &Ray, crossing: &Crossing) -> Surface {
        let (o, d, t) = (ray.origin, ray.direction, crossing.distance);
        let p = [add_product(o.x, d.x, t), add_product(o.y, d.y, t), add_product(o.z, d.z, t)];
        let [x, y, z] = p.map(|c| c / self.unit);
        let rho = (x * x + y * y).sqrt();
        // On the axis, which only a closed hole touches, any direction is as good.
        let (cosine, sine) = if rho > 0.0 { (x / rho, y / rho) } else { (1.0, 0.0) };
        let across = rho - self.major;
        let length = (across * across + z * z).sqrt();
        let (out, up) = if length > 0.0 { (across / length, z / length) } else { (0.0, 1.0) };
        let circle = self.major_radius + self.minor_radius * out;
        let normal = Normal3D::new(out * cosine, out * sine, up).normalise_unchecked();
        Surface {
            point: Point3D::new(circle * cosine, circle * sine, self.minor_radius * up),
            normal,
            shading_normal: normal,
            bound: 4.0 * f64::EPSILON * (self.major_radius + self.minor_radius),
        }
    }
}

#[cfg(test)]
mod tests;
