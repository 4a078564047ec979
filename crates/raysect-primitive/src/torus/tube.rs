use raysect_core::Ray;
use raysect_math::{Point3D, Vector3D};

use crate::select::{larger, smaller};

use super::exact;
use super::quartic::Quartic;

/// Square of the distance from which a ray is far, in units of the tube: nearer, the rounding of the distance to the
/// centre is that of coordinates.
const FAR: f64 = 256.0;

/// The radii of a torus in a unit of its own.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Tube {
    /// The power of two in which lengths are measured, so that nothing over- or underflows [m].
    pub(super) unit: f64,
    /// One over it [1/m].
    pub(super) scale: f64,
    /// Of the circle in the middle, 1 … 2.
    pub(super) major: f64,
    /// Of the tube.
    pub(super) minor: f64,
    pub(super) around: Around,
}

/// What is clear of the surface, with a margin far above rounding.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Around {
    /// Square of the radius of the ball around it.
    reach_squared: f64,
    /// Half the distance of the planes above and below.
    height: f64,
    /// Square of the radius of the cylinder in the hole.
    hole_squared: f64,
    /// What the square of the cosine against the normal must exceed, times the square of the tube, for a crossing to
    /// stand clear of a touch.
    pub(super) clear: f64,
}

/// The line of a ray, measured from its closest approach to the centre, in units of the tube.
pub(super) struct Line {
    /// The point of closest approach.
    miss: Vector3D,
    /// Square of its distance from the centre.
    miss_squared: f64,
    /// Unit vector.
    pub(super) direction: Vector3D,
    /// The point of closest approach along the ray, as a sum of a large and a small part.
    closest: (f64, f64),
    /// The unit vector in units of the ray's direction.
    stretch: f64,
    unit: f64,
}

/// The piece of a line that can meet the torus, and its quartic.
pub(super) struct Span {
    /// Both ends are outside.
    pub(super) first: f64,
    pub(super) last: f64,
    pub(super) quartic: Quartic,
}

impl Line {
    #[inline]
    pub(super) fn at(&self, s: f64) -> Vector3D {
        self.miss + self.direction * s
    }

    /// Distance along the ray of a place on the line.
    #[inline]
    pub(super) fn distance(&self, s: f64) -> f64 {
        (self.closest.0 + (self.closest.1 + s * self.stretch)) * self.unit
    }

    /// The place on the line where the ray begins.
    pub(super) fn start(&self) -> f64 {
        -(self.closest.0 + self.closest.1) / self.stretch
    }
}

impl Tube {
    pub(super) fn new(major_radius: f64, minor_radius: f64) -> Self {
        let exponent = 0x7ff0_0000_0000_0000;
        let unit = f64::from_bits(major_radius.to_bits() & exponent);
        let (major, minor) = (major_radius / unit, minor_radius / unit);
        let margin = 1e-9 * minor + 8.0 * f64::EPSILON * major;
        let (reach, hole) = (major + minor + margin, (major - minor - margin).max(0.0));
        let around = Around {
            reach_squared: reach * reach,
            height: minor + margin,
            hole_squared: hole * hole,
            clear: 1e-4 * minor * minor + 1e-10 * major * minor,
        };
        Self { unit, scale: 1.0 / unit, major, minor, around }
    }

    /// The line of a ray.
    ///
    /// The point of closest approach is summed without rounding on the way, so that it is as good from afar as from
    /// near.
    #[inline]
    pub(super) fn line(&self, ray: &Ray) -> Line {
        let d = ray.direction;
        let o = ray.origin.to_vector() * self.scale;
        let inverse = 1.0 / d.length_squared();
        let stretch = inverse.sqrt();
        let direction = d * stretch;
        let closest = -o.dot(d) * inverse;
        if closest * closest > FAR * inverse {
            return self.line_from_afar(o, d, closest);
        }
        let miss = exact::point_at(o, d, closest);
        Line {
            miss,
            miss_squared: miss.length_squared(),
            direction,
            closest: (closest, 0.0),
            stretch,
            unit: self.unit,
        }
    }

    /// The distance of the closest approach is rounded by more than its place may be: first to where 26 bits of it lead,
    /// then by the rest.
    #[cold]
    fn line_from_afar(&self, o: Vector3D, d: Vector3D, closest: f64) -> Line {
        let inverse = 1.0 / d.length_squared();
        let closest = exact::upper(closest);
        let miss = exact::point_at_short(o, d, closest);
        let rest = -miss.dot(d) * inverse;
        let stretch = inverse.sqrt();
        let (miss, direction) = (miss + d * rest, d * stretch);
        let miss_squared = miss.length_squared();
        Line { miss, miss_squared, direction, closest: (closest, rest), stretch, unit: self.unit }
    }

    /// Where a line can meet the torus: its piece in the bounding sphere and between the planes that touch the
    /// torus, unless that lies in the hole. Both ends are outside, with a margin far above rounding.
    ///
    /// Along the line |p|² = s² + m². The quartic (s² + m² + R² − r²)² − 4 R² ρ² has the sign of `depth`, and a quarter
    /// of its derivative is s³ + p s + q.
    #[inline]
    pub(super) fn span(&self, line: &Line) -> Option<Span> {
        let Around { reach_squared, height, hole_squared, .. } = self.around;
        let squared = reach_squared - line.miss_squared;
        // Of a line so far away that it has no numbers nothing is met either.
        if squared.is_nan() || squared <= 0.0 {
            return None;
        }
        let half = squared.sqrt();
        let (mut first, mut last) = (-half, half);
        let (z, dz) = (line.miss.z, line.direction.z);
        // Along flatter lines the height does not change.
        if dz.abs() > 1e-300 {
            let inverse = 1.0 / dz;
            let (a, b) = ((-height - z) * inverse, (height - z) * inverse);
            first = larger(first, smaller(a, b));
            last = smaller(last, larger(a, b));
        } else if z.abs() > height {
            return None;
        }
        if first >= last {
            return None;
        }
        let in_hole = |s: f64| {
            let (x, y) = (line.miss.x + s * line.direction.x, line.miss.y + s * line.direction.y);
            x * x + y * y < hole_squared
        };
        if in_hole(first) && in_hole(last) {
            return None;
        }
        Some(Span { first, last, quartic: self.quartic(line) })
    }

    #[inline]
    fn quartic(&self, line: &Line) -> Quartic {
        let (z, dz) = (line.miss.z, line.direction.z);
        let (ring, tube) = (self.major * self.major, self.minor * self.minor);
        let across = line.miss.x * line.miss.x + line.miss.y * line.miss.y;
        let sum = line.miss_squared + (ring - tube);
        let p = (line.miss_squared - ring) - tube + 2.0 * ring * (dz * dz);
        Quartic { p, q: 2.0 * ring * z * dz, rest: 0.25 * sum * sum - ring * across }
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
        let p = point.to_vector() * self.scale;
        let rho = (p.x * p.x + p.y * p.y).sqrt();
        let stretch = if rho > 0.0 { (rho - self.major) / rho } else { 0.0 };
        Vector3D::new(p.x * stretch, p.y * stretch, p.z)
    }

    /// Distance from the surface, negative inside.
    pub(super) fn height(&self, p: Vector3D) -> f64 {
        let (depth, rho) = self.depth(p);
        let across = rho - self.major;
        depth / ((across * across + p.z * p.z).sqrt() + self.minor)
    }
}
