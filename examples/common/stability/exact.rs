//! Where lines cross plain solids, in 32 digits.

use raysect::core::{Primitive, Ray};
use raysect::math::{Point3D, Rng, SphereSampler, Vector3D, sampling};
use raysect::primitive::{Cone, Cuboid, Cylinder, Parabola, Sphere, Torus};

use super::bodies::Shape;
use super::double_double::{Dd, dd};

/// A plain solid by its dimensions [m].
#[derive(Debug, Clone, Copy)]
pub(crate) enum Plain {
    Sphere(f64),
    Cuboid([f64; 3], [f64; 3]),
    Cylinder(f64, f64),
    Cone(f64, f64),
    Parabola(f64, f64),
    Torus(f64, f64),
}

/// A point or vector with 32 digits.
pub(crate) type Triple = [Dd; 3];

/// A line, with 32 digits.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Line {
    pub(crate) from: Triple,
    pub(crate) along: Triple,
}

impl From<&Ray> for Line {
    fn from(ray: &Ray) -> Self {
        Self { from: ray.origin.to_array().map(dd), along: ray.direction.to_array().map(dd) }
    }
}

impl Line {
    fn at(&self, t: Dd) -> Triple {
        [0, 1, 2].map(|i| self.from[i] + self.along[i] * t)
    }
}

fn dot(a: Triple, b: Triple) -> Dd {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

impl Plain {
    /// One of each kind, about as large as `size`.
    pub(crate) fn all(size: f64) -> [(&'static str, Self); 6] {
        let s = |x: f64| x * size;
        [
            ("sphere", Self::Sphere(size)),
            ("cuboid", Self::Cuboid([-0.7, -0.5, -0.6].map(s), [0.6, 0.8, 0.5].map(s))),
            ("cylinder", Self::Cylinder(s(0.5), s(1.2))),
            ("cone", Self::Cone(s(0.6), s(1.1))),
            ("parabola", Self::Parabola(s(0.6), s(1.0))),
            ("torus", Self::Torus(s(0.7), s(0.3))),
        ]
    }

    /// The shape.
    pub(crate) fn shape(self) -> Shape {
        fn share(shape: impl Primitive) -> Shape {
            std::sync::Arc::new(shape)
        }
        match self {
            Self::Sphere(r) => share(Sphere::new(r).unwrap()),
            Self::Cuboid(low, high) => share(Cuboid::new(low.into(), high.into()).unwrap()),
            Self::Cylinder(r, h) => share(Cylinder::new(r, h).unwrap()),
            Self::Cone(r, h) => share(Cone::new(r, h).unwrap()),
            Self::Parabola(r, h) => share(Parabola::new(r, h).unwrap()),
            Self::Torus(major, minor) => share(Torus::new(major, minor).unwrap()),
        }
    }

    /// About the middle [m].
    pub(crate) fn centre(self) -> Point3D {
        match self {
            Self::Cylinder(_, h) | Self::Cone(_, h) | Self::Parabola(_, h) => Point3D::new(0.0, 0.0, 0.5 * h),
            _ => Point3D::ORIGIN,
        }
    }

    /// A length as large as the solid [m].
    pub(crate) fn size(self) -> f64 {
        match self {
            Self::Sphere(r) => r,
            Self::Cuboid(low, high) => {
                (0..3).map(|i| low[i].abs().max(high[i].abs()).powi(2)).sum::<f64>().sqrt()
            }
            Self::Cylinder(r, h) | Self::Cone(r, h) | Self::Parabola(r, h) => r.hypot(h),
            Self::Torus(major, minor) => major + minor,
        }
    }

    /// A ray of unit length of direction, from `k` sizes away, at a ball somewhat larger than the solid.
    pub(crate) fn aimed(self, k: f64, rng: &mut Rng) -> Ray {
        let axis = SphereSampler.sample(rng);
        let x = axis.orthogonal().unwrap();
        let p = sampling::disk::sample(sampling::uniforms(rng));
        let reach = 1.1 * self.size();
        let target = self.centre() + (x * p.x + axis.cross(x) * p.y) * reach;
        Ray::new(target - axis * (k * self.size()), axis)
    }

    /// All crossings of a ray's line, in order.
    pub(crate) fn crossings(self, ray: &Ray) -> Vec<Dd> {
        self.crossings_of(&ray.into())
    }

    /// All crossings of a line, in order.
    pub(crate) fn crossings_of(self, line: &Line) -> Vec<Dd> {
        let mut all = match self {
            Self::Sphere(r) => {
                let r = dd(r) * dd(r);
                quadric(line, &|p, q, weight| dot(p, q) - r * weight)
            }
            Self::Cuboid(low, high) => slabs(line, low, high),
            Self::Cylinder(r, h) => {
                let r = dd(r) * dd(r);
                capped(line, h, r, true, &|p, q, weight| p[0] * q[0] + p[1] * q[1] - r * weight)
            }
            Self::Cone(r, h) => {
                let slope = dd(r) / dd(h);
                let form =
                    |p: Triple, q: Triple, _: Dd| p[0] * q[0] + p[1] * q[1] - slope * slope * p[2] * q[2];
                capped(line, h, dd(r) * dd(r), false, &form)
            }
            Self::Parabola(r, h) => paraboloid(line, dd(r), dd(h)),
            Self::Torus(major, minor) => return torus(line, major, minor),
        };
        all.sort_by(|a, b| a.partial_cmp(b).unwrap());
        if all.len() < 2 {
            return Vec::new();
        }
        vec![all[0], all[all.len() - 1]]
    }

    /// True if lines beside this one, by up to `shift` [m], hit the solid another number of times.
    pub(crate) fn is_near_limb(self, ray: &Ray, shift: f64) -> bool {
        let x = ray.direction.orthogonal().unwrap();
        let y = x.cross(ray.direction).normalise().unwrap();
        let count = self.crossings(ray).len();
        (0..64).any(|i| {
            let (sine, cosine) = (f64::from(i % 16) * std::f64::consts::FRAC_PI_8).sin_cos();
            let step = shift * f64::from(i / 16 + 1) / 4.0;
            let origin = ray.origin + (x * cosine + y * sine) * step;
            self.crossings(&Ray::new(origin, ray.direction)).len() != count
        })
    }

    /// The outward unit normal at a crossing, by the gradient.
    pub(crate) fn normal(self, line: &Line, t: Dd) -> Vector3D {
        let [x, y, z] = line.at(t).map(Dd::value);
        let gradient = match self {
            Self::Sphere(_) => Vector3D::new(x, y, z),
            Self::Cuboid(low, high) => {
                let p = [x, y, z];
                let faces = (0..3).flat_map(|i| [(i, -1.0, p[i] - low[i]), (i, 1.0, high[i] - p[i])]);
                let (axis, sign, _) = faces.min_by(|a, b| a.2.abs().total_cmp(&b.2.abs())).unwrap();
                let mut n = [0.0; 3];
                n[axis] = sign;
                n.into()
            }
            Self::Cylinder(r, h) => match () {
                () if z.abs() < (x.hypot(y) - r).abs().min((h - z).abs()) => -Vector3D::Z,
                () if (h - z).abs() < (x.hypot(y) - r).abs() => Vector3D::Z,
                () => Vector3D::new(x, y, 0.0),
            },
            Self::Cone(r, h) => {
                let side = (x.hypot(y) - r / h * (h - z)).abs();
                if z.abs() < side { -Vector3D::Z } else { Vector3D::new(x, y, r / h * x.hypot(y)) }
            }
            Self::Parabola(r, h) => {
                let side = (x * x + y * y - r * r / h * (h - z)).abs() / r;
                if z.abs() < side { -Vector3D::Z } else { Vector3D::new(x, y, 0.5 * r * r / h) }
            }
            Self::Torus(major, _) => {
                let rho = x.hypot(y);
                let part = (rho - major) / rho;
                Vector3D::new(x * part, y * part, z)
            }
        };
        gradient.normalise_unchecked()
    }
}

/// Both roots of a t² + 2 b t + c, if they are real.
fn roots(a: Dd, b: Dd, c: Dd) -> Vec<Dd> {
    let discriminant = b * b - a * c;
    if discriminant < dd(0.0) {
        return Vec::new();
    }
    let root = discriminant.sqrt();
    let sum = if b > dd(0.0) { -(b + root) } else { root - b };
    vec![sum / a, c / sum]
}

/// Crossings with a quadric, by its symmetric form on points (weight 1) and vectors (weight 0).
fn quadric(line: &Line, form: &dyn Fn(Triple, Triple, Dd) -> Dd) -> Vec<Dd> {
    let (o, d) = (line.from, line.along);
    roots(form(d, d, dd(0.0)), form(o, d, dd(0.0)), form(o, o, dd(1.0)))
}

/// Crossings with a plane z = const. within a circle.
fn disk(line: &Line, z: Dd, radius_squared: Dd) -> Option<Dd> {
    if line.along[2] == dd(0.0) {
        return None;
    }
    let t = (z - line.from[2]) / line.along[2];
    let p = line.at(t);
    (p[0] * p[0] + p[1] * p[1] <= radius_squared).then_some(t)
}

/// Crossings with a quadric of revolution, in terms of the depth below the top, and its end faces.
fn capped(
    line: &Line,
    height: f64,
    radius_squared: Dd,
    top: bool,
    form: &dyn Fn(Triple, Triple, Dd) -> Dd,
) -> Vec<Dd> {
    let (o, d) = (line.from, line.along);
    let (from, along) = ([o[0], o[1], dd(height) - o[2]], [d[0], d[1], -d[2]]);
    let (zero, one) = (dd(0.0), dd(1.0));
    let all = roots(form(along, along, zero), form(from, along, zero), form(from, from, one));
    let within = |t: &Dd| {
        let depth = from[2] + along[2] * *t;
        depth >= zero && depth <= dd(height)
    };
    let mut all: Vec<Dd> = all.into_iter().filter(within).collect();
    all.extend(disk(line, zero, radius_squared));
    all.extend(disk(line, dd(height), radius_squared).filter(|_| top));
    all
}

/// ρ² = w r²/h, where w is the depth below the vertex, and the base.
fn paraboloid(line: &Line, r: Dd, h: Dd) -> Vec<Dd> {
    let (o, d, latus, zero) = (line.from, line.along, r * r / h, dd(0.0));
    let a = d[0] * d[0] + d[1] * d[1];
    let b = o[0] * d[0] + o[1] * d[1] + latus * d[2] * dd(0.5);
    let c = o[0] * o[0] + o[1] * o[1] - latus * (h - o[2]);
    let within = |t: &Dd| {
        let z = line.at(*t)[2];
        z >= zero && z <= h
    };
    let mut all: Vec<Dd> = roots(a, b, c).into_iter().filter(within).collect();
    all.extend(disk(line, zero, r * r));
    all
}

fn slabs(line: &Line, low: [f64; 3], high: [f64; 3]) -> Vec<Dd> {
    let (mut near, mut far) = (dd(f64::MIN), dd(f64::MAX));
    for i in 0..3 {
        let (o, d) = (line.from[i], line.along[i]);
        if d == dd(0.0) {
            if o < dd(low[i]) || o > dd(high[i]) {
                return Vec::new();
            }
            continue;
        }
        let [a, b] = [low[i], high[i]].map(|x| (dd(x) - o) / d);
        let (first, last) = if d > dd(0.0) { (a, b) } else { (b, a) };
        near = if first > near { first } else { near };
        far = if last < far { last } else { far };
    }
    if near <= far { vec![near, far] } else { Vec::new() }
}

/// Crossings with a torus: the quartic about the point of closest approach, its roots between those of its derivatives.
fn torus(line: &Line, major: f64, minor: f64) -> Vec<Dd> {
    let two = dd(2.0);
    let d = line.along;
    let squared = dot(d, d);
    let closest = -(dot(line.from, d) / squared);
    let p = line.at(closest);
    let (r2, ring) = (dd(minor) * dd(minor), dd(major) * dd(major));
    let (a, b) = (squared, dot(p, d));
    let k = dot(p, p) + ring - r2;
    let flat = [d[0] * d[0] + d[1] * d[1], p[0] * d[0] + p[1] * d[1], p[0] * p[0] + p[1] * p[1]];
    let four = dd(4.0) * ring;
    let quartic = vec![
        k * k - four * flat[2],
        dd(4.0) * b * k - two * four * flat[1],
        dd(4.0) * b * b + two * a * k - four * flat[0],
        dd(4.0) * a * b,
        a * a,
    ];
    let reach = 1.5 * (major + minor) / squared.sqrt().value();
    polynomial(&quartic, reach).into_iter().map(|t| closest + t).collect()
}

fn horner(c: &[Dd], t: Dd) -> Dd {
    c.iter().rev().fold(dd(0.0), |sum, &c| sum * t + c)
}

/// Roots with a change of sign of a polynomial within ± reach.
fn polynomial(c: &[Dd], reach: f64) -> Vec<Dd> {
    if c.len() < 2 {
        return Vec::new();
    }
    let slope: Vec<Dd> = c.iter().enumerate().skip(1).map(|(i, &c)| c * dd(i as f64)).collect();
    let mut ends = vec![dd(-reach)];
    ends.extend(polynomial(&slope, reach));
    ends.push(dd(reach));
    let crossing = |pair: &[Dd]| {
        let (mut low, mut high) = (pair[0], pair[1]);
        let rising = horner(c, low) < dd(0.0);
        if rising == (horner(c, high) < dd(0.0)) {
            return None;
        }
        for _ in 0..54 {
            let middle = (low + high) * dd(0.5);
            if rising == (horner(c, middle) < dd(0.0)) { low = middle } else { high = middle }
        }
        let mut t = (low + high) * dd(0.5);
        for _ in 0..2 {
            let next = t - horner(c, t) / horner(&slope, t);
            // Beside a double root halving is all there is.
            if next >= low && next <= high {
                t = next;
            }
        }
        Some(t)
    };
    ends.windows(2).filter_map(crossing).collect()
}
