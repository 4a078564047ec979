//! The contract of [`Primitive`] as code, for our shapes and for users' own.

mod sampling;

use raysect_math::{AffineMatrix3D, Normal3D, Point3D, Rng, Vector3D, rotate, translate};

use sampling::check_sampling;

use crate::save::{SaveError, Saved, SceneWriter};
use crate::{BoundingBox3D, Crossing, Departure, Interval, Primitive, Ray, Scratch, Surface};

/// Tests a shape against the contract of [`Primitive`] with random rays about its bounding box.
///
/// # Errors
/// A sentence that says which rule is broken, by which ray, and by how much.
pub fn check_primitive(shape: &dyn Primitive, rays: usize, seed: u64) -> Result<(), String> {
    let bounds = shape.bounding_box(&AffineMatrix3D::IDENTITY);
    if bounds.is_empty() {
        return Err("the bounding box is empty".to_owned());
    }
    let mut checker = Checker { shape, scratch: Scratch::default(), size: bounds.enclosing_sphere().radius };
    let mut rng = Rng::new(seed);
    for number in 0..rays {
        let ray = random_ray(&bounds, &mut rng);
        checker.check(&ray, &bounds).map_err(|what| format!("{what}\n  ray {number}: {ray:?}"))?;
    }
    check_sampling(shape, &bounds, &mut rng, rays.div_ceil(10))
}

/// From around the box through a point of it; one in eight along an axis.
fn random_ray(bounds: &BoundingBox3D, rng: &mut Rng) -> Ray {
    let sphere = bounds.enclosing_sphere();
    let within = |rng: &mut Rng| {
        let [x, y, z] = [0, 1, 2].map(|a| rng.range(bounds.lower[a], bounds.upper[a].next_up()));
        Point3D::new(x, y, z)
    };
    let target = within(rng);
    let far = 10f64.powf(rng.range(-0.5, 1.0)) * sphere.radius;
    let outward = loop {
        let v = Vector3D::new(rng.range(-1.0, 1.0), rng.range(-1.0, 1.0), rng.range(-1.0, 1.0));
        if v.length() <= 1.0 && v.length() > 0.1 {
            break v.normalise_unchecked();
        }
    };
    let outward = match (rng.uniform() * 24.0) as u32 {
        0 => Vector3D::X,
        1 => Vector3D::Y,
        2 => -Vector3D::Z,
        _ => outward,
    };
    let scale = 10f64.powf(rng.range(-2.0, 2.0));
    Ray::new(target + outward * far, -outward * scale)
}

struct Checker<'a> {
    shape: &'a dyn Primitive,
    scratch: Scratch,
    size: f64,
}

impl Checker<'_> {
    fn check(&mut self, ray: &Ray, bounds: &BoundingBox3D) -> Result<(), String> {
        let mut all = Vec::new();
        self.shape.crossings(ray, &mut self.scratch, &mut all);
        self.check_order(&all)?;
        self.check_hits(ray, &all)?;
        self.check_within(ray, &all)?;
        for (index, crossing) in all.iter().enumerate() {
            self.check_surface(ray, crossing, bounds)?;
            if self.shape.is_solid() {
                self.check_restart(ray, &all, index)?;
            }
        }
        if self.shape.is_solid() { self.check_inside(ray, &all) } else { Ok(()) }
    }

    fn check_order(&self, all: &[Crossing]) -> Result<(), String> {
        if all.iter().any(|c| !c.distance.is_finite()) {
            return Err(format!("a distance is not finite: {all:?}"));
        }
        if all.windows(2).any(|w| w[0].distance > w[1].distance) {
            return Err(format!("crossings are not in order: {all:?}"));
        }
        if self.shape.is_convex() && all.len() > 2 {
            return Err(format!("{} crossings of a convex shape", all.len()));
        }
        let alternate = all.iter().enumerate().all(|(i, c)| c.exiting == (i % 2 == 1));
        if self.shape.is_solid() && (all.len() % 2 == 1 || !alternate) {
            return Err(format!("crossings of a solid must alternate, beginning with an entry: {all:?}"));
        }
        Ok(())
    }

    fn check_hits(&mut self, ray: &Ray, all: &[Crossing]) -> Result<(), String> {
        let ends = [0.0, 0.5, 0.9, 1.5].map(|f| f * self.size / ray.direction.length() * 8.0);
        for min in ends {
            let first = all.iter().find(|c| c.distance >= min).copied();
            let hit = self.shape.hit(ray, Interval::new(min, f64::INFINITY), &mut self.scratch);
            if hit != first {
                return Err(format!("hit from {min} says {hit:?}, crossings say {first:?}"));
            }
        }
        if let Some(first) = all.iter().find(|c| c.distance >= 0.0) {
            let short = Interval::new(0.0, first.distance * (1.0 - 1e-9));
            if first.distance > 0.0 && self.shape.hit(ray, short, &mut self.scratch).is_some() {
                return Err(format!("a hit beyond the end of the interval {short:?}"));
            }
        }
        Ok(())
    }

    /// Between any two places that are clear of crossings, the shape says the same when it is asked for no more.
    fn check_within(&mut self, ray: &Ray, all: &[Crossing]) -> Result<(), String> {
        let step = self.size / ray.direction.length();
        let mut places = vec![all.first().map_or(0.0, |c| c.distance) - step];
        places.extend(all.windows(2).map(|pair| 0.5 * (pair[0].distance + pair[1].distance)));
        places.push(all.last().map_or(0.0, |c| c.distance) + step);
        for (index, &min) in places.iter().enumerate() {
            for &max in &places[index + 1..] {
                let within = Interval::new(min, max);
                let mut found = Vec::new();
                self.shape.crossings_within(ray, within, &mut self.scratch, &mut found);
                self.check_order(&found)?;
                let before = |list: &[Crossing]| list.iter().filter(|c| c.distance < min).count() % 2;
                let inside = |list: &[Crossing]| -> Vec<Crossing> {
                    list.iter().copied().filter(|c| within.contains(c.distance)).collect()
                };
                let starts_alike = !self.shape.is_solid() || before(&found) == before(all);
                if inside(&found) != inside(all) || !starts_alike {
                    return Err(format!("crossings within {within:?} are {found:?}, in all {all:?}"));
                }
            }
        }
        Ok(())
    }

    fn check_surface(&self, ray: &Ray, crossing: &Crossing, bounds: &BoundingBox3D) -> Result<(), String> {
        let Surface { point, normal, bound, .. } = self.shape.surface(ray, crossing);
        if (normal.length() - 1.0).abs() > 8.0 * f64::EPSILON {
            return Err(format!("normal {normal:?} is not a unit vector"));
        }
        let cosine = normal.dot(ray.direction) / ray.direction.length();
        if (cosine > 1e-6 && !crossing.exiting) || (cosine < -1e-6 && crossing.exiting) {
            return Err(format!("normal {normal:?} does not point outward at {crossing:?}"));
        }
        if !bounds.contains(point) {
            return Err(format!("point {point:?} lies outside the bounding box {bounds:?}"));
        }
        if !bound.is_finite() || bound < 0.0 || bound > 1e-10 * self.size {
            return Err(format!("error bound {bound} m of a shape of {} m", self.size));
        }
        let travelled = crossing.distance.abs() * ray.direction.length() + self.size;
        let off = ray.point_at(crossing.distance).distance_to(point);
        if off > 1e-13 * travelled / cosine.abs().max(1e-3) + bound {
            return Err(format!("point {point:?} lies {off} m beside the ray"));
        }
        Ok(())
    }

    /// A ray that starts at a crossing finds the next one and not this one again, straight on and turned back.
    fn check_restart(&mut self, ray: &Ray, all: &[Crossing], index: usize) -> Result<(), String> {
        let crossing = all[index];
        let surface = self.shape.surface(ray, &crossing);
        let cosine = surface.normal.dot(ray.direction).abs() / ray.direction.length();
        if cosine < 1e-3 {
            return Ok(());
        }
        let length = ray.direction.length();
        let bound = (surface.bound + 1e-14 * self.size) / cosine / length;
        let straight = [(ray.direction, all.get(index + 1).map(|c| c.distance - crossing.distance))];
        let before = index.checked_sub(1).map(|i| crossing.distance - all[i].distance);
        for (direction, expected) in straight.into_iter().chain([(-ray.direction, before)]) {
            let start = Ray::new(surface.point, direction);
            let inward = surface.normal.dot(direction) < 0.0;
            let departure = Departure { inward, bound, feature: crossing.feature };
            let next = self.shape.hit_after(&start, &departure, f64::INFINITY, &mut self.scratch);
            let tolerance = 1e-9 * (self.size / length + crossing.distance.abs());
            let close = |a: f64, b: f64| (a - b).abs() <= tolerance / cosine;
            let right = match (next.map(|c| c.distance), expected) {
                (Some(a), Some(b)) => close(a, b),
                (None, None) => true,
                _ => false,
            };
            if !right {
                return Err(format!(
                    "after {crossing:?} along {direction:?}: {next:?}, expected {expected:?}"
                ));
            }
        }
        Ok(())
    }

    fn check_inside(&self, ray: &Ray, all: &[Crossing]) -> Result<(), String> {
        let reach = 2.0 * self.size / ray.direction.length();
        let (first, last) = match (all.first(), all.last()) {
            (Some(a), Some(b)) => (a.distance - reach, b.distance + reach),
            _ => (0.0, reach),
        };
        let mut places = vec![first];
        places.extend(all.iter().map(|c| c.distance));
        places.push(last);
        for (index, pair) in places.windows(2).enumerate() {
            if (pair[1] - pair[0]) * ray.direction.length() < 1e-9 * self.size {
                continue;
            }
            let point = ray.point_at(0.5 * (pair[0] + pair[1]));
            let expected = index % 2 == 1;
            if self.shape.contains(point) != expected {
                return Err(format!("contains({point:?}) is {}, the crossings say {expected}", !expected));
            }
        }
        Ok(())
    }
}

/// A plain ball about the origin, for tests and examples of this crate alone; the shapes of
/// `raysect-primitive` are more careful.
#[derive(Debug, Clone, Copy)]
pub struct Ball {
    radius: f64,
}

impl Ball {
    /// Of a radius [m], which must be positive.
    pub fn new(radius: f64) -> Self {
        Self { radius: radius.abs() }
    }
}

impl Primitive for Ball {
    fn save(&self, _: &mut SceneWriter) -> Result<Saved, SaveError> {
        Ok(Saved::new("Ball").number("radius", self.radius))
    }
    fn bounding_box(&self, m: &AffineMatrix3D) -> BoundingBox3D {
        let r = self.radius;
        let mut b = BoundingBox3D::around([Point3D::new(-r, -r, -r), Point3D::new(r, r, r)]);
        b.pad(8.0 * f64::EPSILON * r);
        b.transformed(m)
    }
    fn contains(&self, point: Point3D) -> bool {
        point.to_vector().length() <= self.radius
    }
    fn crossings(&self, ray: &Ray, _: &mut Scratch, out: &mut Vec<Crossing>) {
        let d = ray.direction;
        let closest = -ray.origin.to_vector().dot(d) / d.length_squared();
        let miss = ray.point_at(closest).to_vector().length_squared();
        if miss < self.radius * self.radius {
            let half = ((self.radius * self.radius - miss) / d.length_squared()).sqrt();
            for (distance, exiting) in [(closest - half, false), (closest + half, true)] {
                out.push(Crossing { distance, feature: crate::Feature::default(), exiting });
            }
        }
    }
    fn is_convex(&self) -> bool {
        true
    }
    fn surface(&self, ray: &Ray, crossing: &Crossing) -> Surface {
        let normal = ray.point_at(crossing.distance).to_vector().normalise_unchecked();
        let point = Point3D::ORIGIN + normal * self.radius;
        let normal = Normal3D::from(normal);
        Surface { point, normal, shading_normal: normal, bound: 8.0 * f64::EPSILON * self.radius }
    }
}

/// A rigid motion for tests.
pub fn some_motion() -> AffineMatrix3D {
    translate(0.3, -1.7, 2.2) * rotate(31.0, -64.0, 12.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_right_shape_passes() {
        check_primitive(&Ball::new(0.7), 3000, 1).unwrap();
    }

    /// A ball with a fault: in all of its crossings, in those of an interval, or in what it contains.
    struct Broken {
        ball: Ball,
        all: fn(&mut Vec<Crossing>),
        within: fn(&mut Vec<Crossing>, Interval),
        inverted: bool,
    }

    const RIGHT: Broken =
        Broken { ball: Ball { radius: 1.0 }, all: |_| (), within: |_, _| (), inverted: false };

    impl Broken {
        fn passes(&self) -> bool {
            check_primitive(self, 200, 2).is_ok()
        }
    }

    impl Primitive for Broken {
        fn bounding_box(&self, m: &AffineMatrix3D) -> BoundingBox3D {
            self.ball.bounding_box(m)
        }
        fn contains(&self, point: Point3D) -> bool {
            self.ball.contains(point) != self.inverted
        }
        fn crossings(&self, ray: &Ray, scratch: &mut Scratch, out: &mut Vec<Crossing>) {
            self.ball.crossings(ray, scratch, out);
            (self.all)(out);
        }
        fn crossings_within(&self, ray: &Ray, within: Interval, s: &mut Scratch, out: &mut Vec<Crossing>) {
            self.crossings(ray, s, out);
            (self.within)(out, within);
        }
        fn surface(&self, ray: &Ray, crossing: &Crossing) -> Surface {
            self.ball.surface(ray, crossing)
        }
    }

    #[test]
    fn shapes_that_forget_crossings_of_an_interval_are_found_out() {
        let passes = |within| Broken { within, ..RIGHT }.passes();
        assert!(passes(|_, _| ()));
        // A pair that lies before or behind may be left out.
        assert!(passes(|all, within| {
            if all.iter().all(|c| c.distance < within.min) || all.iter().all(|c| c.distance > within.max) {
                all.clear();
            }
        }));
        assert!(!passes(|all, _| all.clear()));
        assert!(!passes(|all, within| all.retain(|c| within.contains(c.distance))));
    }

    #[test]
    fn broken_shapes_are_found_out() {
        let faults: [fn(&mut Vec<Crossing>); 4] = [
            |all| all.reverse(),
            |all| all.truncate(1),
            |all| all.iter_mut().for_each(|c| c.exiting = !c.exiting),
            |all| all.iter_mut().for_each(|c| c.distance *= 1.001),
        ];
        for all in faults {
            assert!(!Broken { all, ..RIGHT }.passes());
        }
        assert!(!Broken { inverted: true, ..RIGHT }.passes());
        assert!(RIGHT.passes());
    }
}
