use raysect_core::{BoundingBox3D, Departure, Feature, Interval, Leaving, Node, Surface, World};
use raysect_math::Normal3D;

use super::*;

/// How many of so many rays that start on the surface of a body in a world, inward and outward, meet what they should
/// not: an entry from inside, an exit from outside, nothing from inside, or a point outside the chord.
fn lost(body: &Shape, place: AffineMatrix3D, rays: usize, rng: &mut Rng) -> usize {
    let mut world = World::<()>::new();
    world.add(Node::of(body.clone(), ()).transform(place)).unwrap();
    let scene = world.scene().unwrap();
    let ball = body.bounding_sphere(&AffineMatrix3D::IDENTITY);
    let (mut scratch, mut lost, mut done) = (Scratch::default(), 0, 0);
    while done < rays {
        let local = line_through(ball.centre, ball.radius, rng);
        let mut ray = Ray::new(place * local.origin, (place * local.direction).normalise().unwrap());
        let mut leaving = None;
        // To and fro through the surface, eight times.
        for _ in 0..8 {
            let Some(hit) = scene.hit(&ray, leaving.as_ref(), &mut scratch) else { break };
            let surface = scene.finish(&ray, &hit);
            done += 1;
            let along = ray.direction.dot(surface.normal);
            lost += usize::from((along > 0.0) != surface.exiting && along.abs() > 1e-6);
            let towards = SphereSampler.sample(rng);
            let inward = towards.dot(surface.normal) < 0.0;
            let next = Leaving::new(&surface, ray.direction, towards, leaving.as_ref());
            ray = Ray::new(surface.point, towards);
            let met = scene.hit(&ray, Some(&next), &mut scratch);
            let right = met.is_none_or(|m| m.crossing.exiting == inward) && (met.is_some() || !inward);
            lost += usize::from(!right);
            // What is met is a crossing of the line, and the first ahead but for what is being left.
            let all = crossings(body, &Ray::new(surface.local_point, place.inverse().unwrap() * towards));
            let slack = 1e4 * surface.bound;
            let expected = all.iter().find(|c| c.distance > slack).map(|c| c.distance);
            let near = all.iter().filter(|c| c.distance.abs() <= slack).count();
            let same = match (met.map(|m| m.crossing.distance), expected) {
                (Some(a), Some(b)) => (a - b).abs() <= 1e-6 * b || a <= slack,
                (None, None) => true,
                (Some(a), None) => a <= slack,
                (None, Some(_)) => false,
            };
            lost += usize::from(!same && near == 1);
            leaving = Some(next);
        }
    }
    lost
}

#[test]
fn rays_that_start_again_lose_nothing_at_any_scale() {
    let mut rng = Rng::new(41);
    let turn = rotate(31.0, -64.0, 12.0);
    for exponent in [-9, -6, -3, 0, 3, 6, 9] {
        let size = 10f64.powi(exponent);
        let place = translate(3.0 * size, -2.0 * size, size) * turn * scale(size);
        for (name, body) in bodies().iter().filter(|(name, _)| !["tiny", "huge"].contains(name)) {
            let wrong = lost(body, place, 1000, &mut rng);
            assert_eq!(wrong, 0, "{name} at {size}");
        }
    }
}

#[test]
fn bodies_that_touch_lose_nothing_where_they_touch() {
    let mut rng = Rng::new(42);
    let piece = |from: f64, to: f64| cuboid([-1.0, -1.0, from], [1.0, 1.0, to]);
    let pile = (1..6).fold(piece(0.0, 0.3), |body, k| {
        let next = moved(&piece(0.3 * f64::from(k), 0.3 * f64::from(k + 1)), blurred(1.0, &mut rng));
        if k % 2 == 0 { union(&body, &next) } else { union(&next, &body) }
    });
    let cut = subtract(&pile, &moved(&piece(0.6, 0.9), blurred(1.0, &mut rng)));
    for size in [1e-9, 1.0, 1e9] {
        for body in [&pile, &cut] {
            let place = rotate(10.0, 20.0, 30.0) * scale(size);
            assert_eq!(lost(body, place, 10_000, &mut rng), 0, "{size}");
            assert_eq!(lost(body, place * shear(), 10_000, &mut rng), 0, "sheared, {size}");
        }
    }
}

/// A body that takes the surface from which a ray starts for the next one.
struct Forgetful(Shape);

impl Primitive for Forgetful {
    fn bounding_box(&self, m: &AffineMatrix3D) -> BoundingBox3D {
        self.0.bounding_box(m)
    }
    fn contains(&self, point: Point3D) -> bool {
        self.0.contains(point)
    }
    fn crossings(&self, ray: &Ray, scratch: &mut Scratch, out: &mut Vec<Crossing>) {
        self.0.crossings(ray, scratch, out);
    }
    fn hit_after(&self, ray: &Ray, _: &Departure, max: f64, scratch: &mut Scratch) -> Option<Crossing> {
        self.0.hit(ray, Interval::new(0.0, max), scratch)
    }
    fn surface(&self, ray: &Ray, crossing: &Crossing) -> Surface {
        self.0.surface(ray, crossing)
    }
}

#[test]
fn a_body_that_forgets_where_the_ray_comes_from_is_found_out() {
    let forgetful = share(Forgetful(drilled()));
    assert!(lost(&forgetful, rotate(10.0, 20.0, 30.0), 1000, &mut Rng::new(43)) > 50);
}

#[test]
fn a_ray_in_a_wedge_thinner_than_rounding_leaves_at_once() {
    // Two half spaces that leave a wedge of 1e-3; the ray starts on one face, nearer to the edge than rounding knows.
    let block = cuboid([-1.0, -1.0, -1.0], [1.0, 1.0, 0.0]);
    let tilted = moved(&cuboid([-1.0, -1.0, 0.0], [1.0, 1.0, 1.0]), rotate_y(0.05));
    let wedge = intersect(&block, &tilted);
    let mut rng = Rng::new(44);
    let mut scratch = Scratch::default();
    for _ in 0..2000 {
        let at = Point3D::new(10f64.powf(rng.range(-18.0, -10.0)), rng.range(-0.5, 0.5), 0.0);
        let direction = Vector3D::new(rng.range(-0.3, 0.3), rng.range(-0.3, 0.3), -1.0).normalise().unwrap();
        let normal = Normal3D::new(0.0, 0.0, 1.0);
        let bound = 1e-14;
        // The upper face of the block.
        let feature = Feature { face: 5, ..Feature::default() };
        let departure = Departure { inward: normal.dot(direction) < 0.0, bound, feature };
        let start = Ray::new(at, direction);
        let next = wedge.hit_after(&start, &departure, f64::INFINITY, &mut scratch);
        assert!(next.is_some_and(|n| n.exiting && n.distance <= 1e-11), "{start:?} {next:?}");
    }
}
