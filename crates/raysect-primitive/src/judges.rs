//! Judges of the solids of revolution: against 32 digits, against integral geometry, and of rays that start again.

use raysect_core::{BoundingBox3D, Crossing, Departure, Interval, Primitive, Ray, Scratch, Surface};
use raysect_math::{AffineMatrix3D, Normal3D, Point3D, Rng, SphereSampler, Statistics, Vector3D, sampling};

use crate::double_double::{Dd, dd};

mod battery;

pub(crate) use battery::{
    chords_agree_with_cauchy, distances_are_right, extremes_are_finite, keeps_the_contract,
    light_sampling_is_right, nothing_is_lost, points_keep_their_bound, restarts_are_right,
};

/// A symmetric form on homogeneous coordinates (x, y, depth below the top, weight), negative inside a quadric.
pub(crate) type Form = dyn Fn([Dd; 4], [Dd; 4]) -> Dd;

/// A shape with what the judges need to know of it.
pub(crate) struct Subject<'a> {
    pub(crate) shape: &'a dyn Primitive,
    pub(crate) radius: f64,
    pub(crate) height: f64,
    /// True if the top is cut off by a plane.
    pub(crate) capped: bool,
    pub(crate) form: &'a Form,
    pub(crate) volume: f64,
    pub(crate) area: f64,
}

impl Subject<'_> {
    pub(crate) fn size(&self) -> f64 {
        self.radius.hypot(self.height)
    }

    fn centre(&self) -> Point3D {
        Point3D::new(0.0, 0.0, 0.5 * self.height)
    }

    /// A line of an isotropic, uniform field through the ball around the shape, begun `k` sizes away.
    pub(crate) fn isotropic(&self, k: f64, rng: &mut Rng) -> Ray {
        let axis = SphereSampler.sample(rng);
        let (x, size) = (axis.orthogonal().unwrap(), self.size());
        let p = sampling::disk::sample(sampling::uniforms(rng));
        let target = self.centre() + (x * p.x + axis.cross(x) * p.y) * size;
        Ray::new(target - axis * (k * size), axis)
    }

    /// A line through a uniform point of a cylinder half as large again, begun `k` sizes away.
    fn aimed(&self, k: f64, rng: &mut Rng) -> Ray {
        let p = sampling::disk::sample(sampling::uniforms(rng));
        let z = self.height * rng.range(-0.25, 1.25);
        let target = Point3D::new(1.5 * self.radius * p.x, 1.5 * self.radius * p.y, z);
        let axis = SphereSampler.sample(rng);
        Ray::new(target - axis * (k * self.size()), axis)
    }

    /// Entry and exit by the textbook, in 32 digits.
    pub(crate) fn exact(&self, ray: &Ray) -> Option<(Dd, Dd)> {
        let (o, d) = (ray.origin, ray.direction);
        let (zero, one, h) = (dd(0.0), dd(1.0), dd(self.height));
        let from = [dd(o.x), dd(o.y), h - dd(o.z), one];
        let along = [dd(d.x), dd(d.y), -dd(d.z), zero];
        let at = |t: Dd| -> [Dd; 4] { std::array::from_fn(|i| from[i] + along[i] * t) };
        let mut all = Vec::new();
        let (a, b, c) = ((self.form)(along, along), (self.form)(from, along), (self.form)(from, from));
        let discriminant = b * b - a * c;
        if discriminant >= zero {
            let root = discriminant.sqrt();
            let sum = if b > zero { -(b + root) } else { root - b };
            for t in [sum / a, c / sum] {
                let depth = at(t)[2];
                if depth >= zero && depth <= h {
                    all.push(t);
                }
            }
        }
        for depth in [h, zero].into_iter().take(if self.capped { 2 } else { 1 }) {
            let t = (depth - from[2]) / along[2];
            let p = at(t);
            if p[0] * p[0] + p[1] * p[1] <= dd(self.radius) * dd(self.radius) {
                all.push(t);
            }
        }
        all.sort_by(|a, b| a.partial_cmp(b).unwrap());
        (all.len() >= 2).then(|| (all[0], all[all.len() - 1]))
    }

    fn crossings(&self, ray: &Ray) -> Vec<Crossing> {
        let mut out = Vec::new();
        self.shape.crossings(ray, &mut Scratch::default(), &mut out);
        out
    }

    /// The greatest error of crossings from `k` sizes away, in units of ε (distance + size) / cosine, and how many
    /// lines are wrongly hit or missed.
    pub(crate) fn distance_errors(&self, k: f64, lines: usize, rng: &mut Rng) -> (f64, usize) {
        let (mut worst, mut wrong) = (0.0f64, 0);
        for _ in 0..lines {
            let mut ray = self.aimed(k, rng);
            ray.direction = ray.direction * 10f64.powf(rng.range(-3.0, 3.0));
            let found = self.crossings(&ray);
            let Some((near, far)) = self.exact(&ray) else {
                wrong += usize::from(!found.is_empty() && !self.is_marginal(&ray, k));
                continue;
            };
            if found.len() != 2 {
                wrong += usize::from(!self.is_marginal(&ray, k));
                continue;
            }
            for (crossing, exact) in found.iter().zip([near, far]) {
                let cosine = self.shape.surface(&ray, crossing).normal.dot(ray.direction).abs();
                let error = (dd(crossing.distance) - exact).value().abs() * cosine;
                worst = worst.max(error / (f64::EPSILON * (k + 1.0) * self.size()));
            }
        }
        (worst, wrong)
    }

    /// True if a shift of the line by the rounding of its distance, 2 ε at the most, decides whether it hits.
    fn is_marginal(&self, ray: &Ray, k: f64) -> bool {
        let x = ray.direction.orthogonal().unwrap();
        let y = x.cross(ray.direction).normalise().unwrap();
        let hits = self.exact(ray).is_some();
        (0..64).any(|i| {
            let (sine, cosine) = (f64::from(i % 16) * std::f64::consts::FRAC_PI_8).sin_cos();
            let shift = 0.5 * f64::from(i / 16 + 1) * f64::EPSILON * (k + 1.0) * self.size();
            let origin = ray.origin + (x * cosine + y * sine) * shift;
            self.exact(&Ray::new(origin, ray.direction)).is_some() != hits
        })
    }

    /// How far surface points lie beside the surface, in units of their bound, and whether they are in the box.
    pub(crate) fn residual(&self, k: f64, lines: usize, rng: &mut Rng) -> f64 {
        let mut worst = 0.0f64;
        for _ in 0..lines {
            let ray = self.aimed(k, rng);
            for crossing in self.crossings(&ray).iter().filter(|c| c.feature.face == 0) {
                let Surface { point, normal, bound, .. } = self.shape.surface(&ray, crossing);
                let p = [dd(point.x), dd(point.y), dd(self.height) - dd(point.z), dd(1.0)];
                let n = [dd(normal.x), dd(normal.y), -dd(normal.z), dd(0.0)];
                let (value, slope) = ((self.form)(p, p).value(), 2.0 * (self.form)(p, n).value());
                worst = worst.max((value / slope).abs() / bound);
            }
        }
        worst
    }

    /// Mean chord against 4 V/S and share of hits against S/(4 π R²), in standard errors (A. Cauchy 1841).
    pub(crate) fn chord_scores(&self, lines: usize, rng: &mut Rng) -> [f64; 2] {
        let (mut chords, mut hits) = (Statistics::new(), Statistics::new());
        for _ in 0..lines {
            let found = self.crossings(&self.isotropic(3.0, rng));
            hits.add(if found.is_empty() { 0.0 } else { 1.0 });
            if let [near, far] = found[..] {
                chords.add((far.distance - near.distance) / self.size());
            }
        }
        let chord = 4.0 * self.volume / self.area / self.size();
        let share = self.area / (4.0 * std::f64::consts::PI * self.size() * self.size());
        [(chords.mean() - chord) / chords.error(), (hits.mean() - share) / hits.error()]
    }

    /// One of the crossings of a line that hits, and that line.
    fn some_crossing(&self, draw: impl Fn(&mut Rng) -> Ray, rng: &mut Rng) -> (Ray, Crossing) {
        loop {
            let ray = draw(rng);
            let found = self.crossings(&ray);
            if !found.is_empty() {
                return (ray, found[usize::from(rng.uniform() < 0.5)]);
            }
        }
    }

    /// How many rays that start inward from the surface do not leave where 32 digits say.
    pub(crate) fn restart_failures(&self, rays: usize, rng: &mut Rng) -> usize {
        let mut failures = 0;
        for _ in 0..rays {
            let (ray, crossing) = self.some_crossing(|rng| self.aimed(3.0, rng), rng);
            let Surface { point, normal, bound, .. } = self.shape.surface(&ray, &crossing);
            let direction = inward(normal, rng);
            let start = Ray::new(point, direction);
            let cosine = -normal.dot(direction);
            let departure = Departure { inward: true, bound: bound / cosine, feature: crossing.feature };
            let next = self.shape.hit_after(&start, &departure, f64::INFINITY, &mut Scratch::default());
            let right = next.is_some_and(|next| {
                let out = self.shape.surface(&start, &next).normal.dot(direction);
                let far = self.exact(&start).map_or(0.0, |(_, far)| far.value());
                let slack = 32.0 * f64::EPSILON * self.size() / out.min(cosine);
                next.exiting && next.distance >= 0.0 && (next.distance - far).abs() <= slack
            });
            failures += usize::from(!right);
            let outward = Departure { inward: false, ..departure };
            let start = Ray::new(point, -direction);
            failures += usize::from(
                self.shape.hit_after(&start, &outward, f64::INFINITY, &mut Scratch::default()).is_some(),
            );
        }
        failures
    }

    /// The density of light sampling, as seen from `from`, against the points that are drawn as seen from `drawn_from`,
    /// in cells of the surface: the greatest difference in standard errors, and that of the integral from one.
    pub(crate) fn sampling_scores(
        &self,
        from: Point3D,
        drawn_from: Point3D,
        n: usize,
        rng: &mut Rng,
    ) -> [f64; 2] {
        const CELLS: usize = 3 * 8 * 3;
        let cell = |face: u32, p: Point3D| {
            let sector = ((p.y.atan2(p.x) / std::f64::consts::TAU + 0.5) * 8.0).min(7.0) as usize;
            let level = if face == 0 { p.z / self.height } else { p.x.hypot(p.y) / self.radius };
            (face as usize * 8 + sector) * 3 + (level * 3.0).min(2.0) as usize
        };
        let (mut expected, mut drawn) = (vec![Statistics::new(); CELLS + 1], vec![Statistics::new(); CELLS]);
        for _ in 0..n {
            // The ends of isotropic lines are uniform on the surface of a convex body.
            let (ray, crossing) = self.some_crossing(|rng| self.isotropic(3.0, rng), rng);
            let point = self.shape.surface(&ray, &crossing).point;
            let density = self.area * self.shape.surface_density(from, point, crossing.feature);
            let here = cell(crossing.feature.face, point);
            (0..CELLS).for_each(|i| expected[i].add(if i == here { density } else { 0.0 }));
            expected[CELLS].add(density);
            let u = [rng.uniform(), rng.uniform(), rng.uniform()];
            let there = self.shape.sample_surface(drawn_from, u).map(|s| {
                let again = self.shape.surface_density(drawn_from, s.point, s.feature);
                assert!((s.density / again - 1.0).abs() < 1e-6, "{s:?} {again}");
                cell(s.feature.face, s.point)
            });
            (0..CELLS).for_each(|i| drawn[i].add(if Some(i) == there { 1.0 } else { 0.0 }));
        }
        let score = |a: &Statistics, b: &Statistics| {
            let error = a.error().hypot(b.error());
            if error == 0.0 { 0.0 } else { (a.mean() - b.mean()).abs() / error }
        };
        let worst = (0..CELLS).map(|i| score(&expected[i], &drawn[i])).fold(0.0, f64::max);
        let total = &expected[CELLS];
        [worst, (total.mean() - 1.0).abs() / total.error()]
    }
}

/// A direction to the inside of a surface, by the cosine.
fn inward(normal: Normal3D, rng: &mut Rng) -> Vector3D {
    let direction = SphereSampler.sample(rng) * (1.0 - 1e-6) - normal.as_vector();
    direction.normalise().unwrap()
}

/// The distances of all crossings, with their faces.
pub(crate) fn line(shape: &dyn Primitive, origin: [f64; 3], direction: [f64; 3]) -> Vec<(f64, u32)> {
    let mut out = Vec::new();
    let ray = Ray::new(origin.into(), direction.into());
    shape.crossings(&ray, &mut Scratch::default(), &mut out);
    for crossing in &out {
        let surface = shape.surface(&ray, crossing);
        assert!(surface.point.is_finite() && surface.normal.is_finite(), "{crossing:?} {surface:?}");
        assert!((surface.normal.length() - 1.0).abs() < 1e-15, "{surface:?}");
    }
    let first = shape.hit(&ray, Interval::new(f64::NEG_INFINITY, f64::INFINITY), &mut Scratch::default());
    assert_eq!(first, out.first().copied());
    out.iter().map(|c| (c.distance, c.feature.face)).collect()
}

/// Bounds hold every surface point, and touch the surface on every side: `points` gives two from a place in 0 … 1 and an
/// azimuth [rad].
pub(crate) fn check_bounds(
    shape: &dyn Primitive,
    m: &AffineMatrix3D,
    points: impl Fn(f64, f64) -> [Point3D; 2],
) {
    let (image, ball) = (shape.bounding_box(m), shape.bounding_sphere(m));
    let mut least = BoundingBox3D::EMPTY;
    let mut farthest = 0.0f64;
    for i in 0..=1000 {
        for j in 0..1000 {
            for p in points(f64::from(i) * 1e-3, f64::from(j) * 1e-3 * std::f64::consts::TAU) {
                let p = *m * p;
                assert!(image.contains(p) && ball.contains(p), "{p:?}");
                least.extend(p, 0.0);
                farthest = farthest.max(ball.centre.distance_to(p));
            }
        }
    }
    let slack = 1e-5 * image.enclosing_sphere().radius;
    for axis in 0..3 {
        let loose = (least.lower[axis] - image.lower[axis]).max(image.upper[axis] - least.upper[axis]);
        assert!(loose <= slack, "axis {axis}: {image:?} around {least:?}");
    }
    if m.similarity_scale().is_some() {
        assert!(ball.radius <= farthest * (1.0 + 1e-5), "{ball:?} around {farthest}");
    }
}
