//! Directions towards a rectangle, uniform in solid angle.

use super::draws;
use crate::{Frame, MathError, Point3D, Vector3D};

/// Uniform directions over the solid angle that a rectangle fills, seen from a point.
///
/// C. Ureña, M. Fajardo, A. King, *An Area-Preserving Parametrization for Spherical Rectangles*, Computer Graphics
/// Forum 32(4), 2013; with a solid angle that has no cancellation, so that small and far rectangles keep their digits.
///
/// ```
/// use raysect_math::{Point3D, SphericalRectangleSampler, Vector3D};
/// // One face of a cube around the observer: a sixth of all directions.
/// let corner = Point3D::new(-1.0, -1.0, 1.0);
/// let edges = [Vector3D::X * 2.0, Vector3D::Y * 2.0];
/// let sampler = SphericalRectangleSampler::new(Point3D::ORIGIN, corner, edges)?;
/// assert!((sampler.solid_angle() - 4.0 * std::f64::consts::PI / 6.0).abs() < 1e-15);
/// let v = sampler.sample_at([0.2, 0.9]);
/// assert_eq!(sampler.pdf(v), 1.0 / sampler.solid_angle());
/// # Ok::<(), raysect_math::MathError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SphericalRectangleSampler {
    /// x and y along the edges, z from the observer to the plane.
    frame: Frame,
    /// The smaller coordinates in the plane, in units of the largest distance.
    low: [f64; 2],
    /// Lengths of the edges, in the same units.
    size: [f64; 2],
    /// Distance of the plane, in the same units.
    height: f64,
    solid_angle: f64,
}

draws!(SphericalRectangleSampler -> Vector3D);

impl SphericalRectangleSampler {
    /// The rectangle with the given corner and the two edges that leave it [m], seen from the observer [m].
    ///
    /// # Errors
    /// [`MathError::NoDirection`] for an edge without length, [`MathError::OutOfRange`] for edges that are not
    /// perpendicular to within 1e-8, an observer in the plane of the rectangle, or a solid angle below 1e-290 sr.
    pub fn new(observer: Point3D, corner: Point3D, edges: [Vector3D; 2]) -> Result<Self, MathError> {
        let to_corner = observer.vector_to(corner);
        let scale = to_corner.max_abs().max(edges[0].max_abs()).max(edges[1].max_abs());
        let (x, second) = (edges[0].normalise()?, edges[1].normalise()?);
        let cosine = x.dot(second);
        MathError::check(cosine.abs() <= 1e-8, cosine, "cosine between the edges", "", "-1e-8 … 1e-8")?;
        let to_corner = to_corner / scale;
        let normal = x.cross(second).normalise()?;
        let height = normal.dot(to_corner);
        let above = height.abs() > 0.0 && height.is_finite();
        MathError::check(above, height, "distance of the observer from the plane", "", "other than 0")?;
        let z = normal * height.signum();
        let frame = Frame { x, y: z.cross(x), z };
        let size = edges.map(|edge| (edge / scale).length());
        let mut low = [frame.x.dot(to_corner), frame.y.dot(to_corner)];
        if height < 0.0 {
            // Seen from the other side, the second edge goes down.
            low[1] -= size[1];
        }
        let height = height.abs();
        let solid_angle = solid_angle([low[0], size[0]], [low[1], size[1]], height);
        let admitted = (1e-290..=std::f64::consts::TAU).contains(&solid_angle);
        MathError::check(admitted, solid_angle, "solid angle of the rectangle", "sr", "1e-290 … 2 π")?;
        Ok(Self { frame, low, size, height, solid_angle })
    }

    /// Solid angle [sr], right to a few roundings at every size and distance.
    #[inline]
    pub fn solid_angle(&self) -> f64 {
        self.solid_angle
    }

    /// The unit vector for two uniforms in (0, 1): the first gives the place along the first edge, the second that
    /// along the second.
    pub fn sample_at(&self, u: [f64; 2]) -> Vector3D {
        let x = self.low[0] + self.offset(u[0]);
        let y = self.second_coordinate(x, u[1]);
        self.frame.to_world(Vector3D::new(x, y, self.height).normalise_unchecked())
    }

    /// How far along the first edge the strip ends that holds the share `u` of the solid angle.
    ///
    /// The closed form of the paper is right to about 4 ε in the solid angle itself, which is all there is to lose where
    /// that is large.
    fn offset(&self, u: f64) -> f64 {
        let width = self.size[0];
        let closed = self.closed_form(u) - self.low[0];
        let within = closed > 0.0 && closed < width;
        if within && (1e-3..6.0).contains(&self.solid_angle) {
            return closed;
        }
        self.polish(if within { closed } else { u * width }, u)
    }

    /// The end of that strip to rounding, from a guess: Newton's method between bounds, most often in one step or none.
    fn polish(&self, guess: f64, u: f64) -> f64 {
        let target = u * self.solid_angle;
        let (mut t, mut below, mut above) = (guess, 0.0, self.size[0]);
        for _ in 0..100 {
            let excess = self.strip(t) - target;
            if excess.abs() <= 4.0 * f64::EPSILON * self.solid_angle {
                break;
            }
            if excess > 0.0 {
                above = t;
            } else {
                below = t;
            }
            let mut next = t - excess / self.growth(self.low[0] + t);
            if !(next > below && next < above) {
                next = 0.5 * (below + above);
            }
            if next == t {
                break;
            }
            t = next;
        }
        t
    }

    /// Section 4 of the paper, there with the plane at −z.
    fn closed_form(&self, u: f64) -> f64 {
        let z = self.height;
        let [[x0, y0], [x1, y1]] = [self.low, [self.low[0] + self.size[0], self.low[1] + self.size[1]]];
        let (b0, b1) = (-y0 / z.hypot(y0), y1 / z.hypot(y1));
        let (left, right) = (-x0 / z.hypot(x0), x1 / z.hypot(x1));
        debug_assert!(left + right >= 0.0);
        let angles = (-b1 * left).acos() + (-left * b0).acos();
        let (sin, cos) = (u * self.solid_angle - angles).sin_cos();
        // k = 2π − angles; a whole turn more or less changes nothing.
        let f = (cos * b0 - b1) / sin;
        let c = (1.0 / f.hypot(b0)).copysign(f).clamp(-1.0, 1.0);
        c * z / ((1.0 - c) * (1.0 + c)).sqrt()
    }

    /// Solid angle of the first `t` of the rectangle.
    fn strip(&self, t: f64) -> f64 {
        solid_angle([self.low[0], t], [self.low[1], self.size[1]], self.height)
    }

    /// Solid angle of a strip at `x` per width.
    fn growth(&self, x: f64) -> f64 {
        let (d2, y0) = (x * x + self.height * self.height, self.low[1]);
        let y1 = y0 + self.size[1];
        let (r0, r1) = ((d2 + y0 * y0).sqrt(), (d2 + y1 * y1).sqrt());
        let sines = if y0 * y1 > 0.0 {
            self.size[1] * (y1 + y0) * d2 / (r0 * r1 * (y1 * r0 + y0 * r1))
        } else {
            y1 / r1 - y0 / r0
        };
        self.height / d2 * sines
    }

    /// The place across the strip at `x`: the sine of the elevation above the plane y = 0 is uniform.
    ///
    /// It is had from 1 − sine or 1 + sine, whichever is small, so that strips that are long for their distance keep
    /// their digits.
    fn second_coordinate(&self, x: f64, v: f64) -> f64 {
        let d = x.hypot(self.height);
        let (y0, y1) = (self.low[1], self.low[1] + self.size[1]);
        let one_minus = |y: f64| {
            let r = d.hypot(y);
            if y > 0.0 { d / r * (d / (r + y)) } else { 1.0 - y / r }
        };
        let mixed = |sign: f64| (1.0 - v) * one_minus(sign * y0) + v * one_minus(sign * y1);
        let (rest, sign) = if mixed(1.0) <= 1.0 { (mixed(1.0), 1.0) } else { (mixed(-1.0), -1.0) };
        let y = sign * (1.0 - rest) * d / (rest * (2.0 - rest)).sqrt();
        y.clamp(y0, y1)
    }

    /// Density [1/sr] at a unit vector: 1 / solid angle towards the rectangle, 0 elsewhere.
    #[inline]
    pub fn pdf(&self, direction: Vector3D) -> f64 {
        let v = self.frame.to_local(direction);
        if v.z <= 0.0 {
            return 0.0;
        }
        let distance = self.height / v.z;
        let meets = |axis: usize, component: f64| {
            let place = component * distance;
            // By how much rounding of the direction moves the place.
            let slack = 8.0 * f64::EPSILON * (distance * (1.0 + component.abs() / v.z) + self.size[axis]);
            place >= self.low[axis] - slack && place <= self.low[axis] + self.size[axis] + slack
        };
        if meets(0, v.x) && meets(1, v.y) { 1.0 / self.solid_angle } else { 0.0 }
    }
}

/// Solid angle of the rectangle with the given lower coordinates and widths in the plane at height `z`.
///
/// It is cut where the foot of the observer has its coordinates: no piece reaches across, so that the terms of each are
/// all positive.
fn solid_angle([x, width]: [f64; 2], [y, height]: [f64; 2], z: f64) -> f64 {
    let mut sum = 0.0;
    for across in pieces(x, width) {
        for up in pieces(y, height) {
            sum += piece(across, up, z);
        }
    }
    sum
}

/// Beginnings and widths of the parts of an interval on both sides of 0, mirrored to positive coordinates.
fn pieces(start: f64, width: f64) -> [[f64; 2]; 2] {
    let end = start + width;
    if start >= 0.0 {
        [[start, width], [0.0, 0.0]]
    } else if end <= 0.0 {
        [[-end, width], [0.0, 0.0]]
    } else {
        [[0.0, -start], [0.0, end]]
    }
}

/// Two triangles by A. Van Oosterom, J. Strackee, *The Solid Angle of a Plane Triangle*, IEEE Transactions on
/// Biomedical Engineering 30, 1983; a corner above the foot of the observer in one arc tangent.
fn piece([x, width]: [f64; 2], [y, height]: [f64; 2], z: f64) -> f64 {
    if width <= 0.0 || height <= 0.0 {
        return 0.0;
    }
    if x == 0.0 && y == 0.0 {
        return (width * height).atan2(z * Vector3D::new(width, height, z).length());
    }
    let corner = |across: f64, up: f64| Vector3D::new(x + across, y + up, z);
    let (a, b, c, d) = (corner(0.0, 0.0), corner(width, 0.0), corner(width, height), corner(0.0, height));
    let volume = z * width * height;
    let triangle = |a: Vector3D, b: Vector3D, c: Vector3D| {
        let (ra, rb, rc) = (a.length(), b.length(), c.length());
        2.0 * volume.atan2(ra * rb * rc + a.dot(b) * rc + b.dot(c) * ra + c.dot(a) * rb)
    };
    triangle(a, b, c) + triangle(a, c, d)
}

#[cfg(test)]
mod tests;
