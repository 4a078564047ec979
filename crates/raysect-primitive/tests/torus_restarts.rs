//! Rays that bounce about in and on tori of all sizes, near the origin of the world and far from it.

use raysect_core::{
    BoundingBox3D, Crossing, Leaving, Node, Primitive, Ray, Scene, Scratch, Surface, SurfacePoint, World,
};
use raysect_math::{AffineMatrix3D, Point3D, Rng, SphereSampler, Vector3D, rotate, translate};
use raysect_primitive::Torus;

fn world(shape: impl Primitive, offset: f64) -> World<()> {
    let mut world = World::<()>::new();
    let place = translate(offset, -0.7 * offset, 0.3 * offset) * rotate(31.0, -64.0, 12.0);
    world.add(Node::of(shape, ()).transform(place)).unwrap();
    world
}

/// Somewhere into a hemisphere: one in four almost along the surface.
fn direction(normal: Vector3D, inward: bool, rng: &mut Rng) -> Vector3D {
    let v = SphereSampler.sample_at([rng.uniform(), rng.uniform()]);
    let side = if inward { -1.0 } else { 1.0 };
    let tangent = v - normal * v.dot(normal);
    let steep = if rng.uniform() < 0.25 { 10f64.powf(rng.range(-16.0, -2.0)) } else { v.dot(normal).abs() };
    let out = tangent.normalise_unchecked() + normal * (side * steep);
    let out = out.normalise_unchecked();
    if (out.dot(normal) < 0.0) == inward { out } else { normal * side }
}

/// Distance from the surface in local space, negative inside.
fn height(torus: &Torus, p: Point3D) -> f64 {
    (p.x.hypot(p.y) - torus.major_radius()).hypot(p.z) - torus.minor_radius()
}

/// What is wrong with a step from one surface point to the next: nothing may lie between, the kind must be right.
fn fault(
    torus: &Torus,
    scene: &Scene<()>,
    from: &SurfacePoint,
    ray: &Ray,
    next: Option<&SurfacePoint>,
) -> Option<String> {
    let inward = from.normal.dot(ray.direction) < 0.0;
    let instance = &scene.instances[0];
    let length = match next {
        None if inward => return Some("lost inside".to_owned()),
        None => 4.0 * (torus.major_radius() + torus.minor_radius()),
        Some(s) if s.exiting != inward => return Some(format!("wrong kind {s:?}")),
        Some(s) => s.distance,
    };
    // Rounding of the two ends in the world, as seen by the torus.
    let doubt = 2.0 * (from.bound + next.map_or(0.0, |s| s.bound));
    (1..200).find_map(|i| {
        let p = instance.to_local.transform_point(ray.point_at(length * f64::from(i) / 200.0));
        let h = if inward { height(torus, p) } else { -height(torus, p) };
        (h > doubt).then(|| {
            format!("{h:e} m on the wrong side, {doubt:e} m in doubt, of {length:e} m, next {next:?}")
        })
    })
}

/// Number of restarts on `shape`, which is a kind of `torus`, and what was wrong with them.
fn bounce(torus: Torus, shape: impl Primitive, offset: f64, chains: usize) -> (usize, Vec<String>) {
    let world = world(shape, offset);
    let scene = world.scene().unwrap();
    let (mut rng, mut scratch) = (Rng::new(3), Scratch::default());
    let centre = scene.instances[0].to_world.origin();
    let (mut restarts, mut faults) = (0, Vec::new());
    for _ in 0..chains {
        let phi = rng.range(0.0, std::f64::consts::TAU);
        let aim = Point3D::new(torus.major_radius() * phi.cos(), torus.major_radius() * phi.sin(), 0.0);
        let aim = scene.instances[0].to_world.transform_point(aim);
        let towards = SphereSampler.sample_at([rng.uniform(), rng.uniform()]);
        let far = 3.0 * torus.major_radius();
        let mut ray = Ray::new(aim - towards * far, towards);
        if torus.contains(scene.instances[0].to_local.transform_point(ray.origin)) {
            continue;
        }
        let Some(hit) = scene.hit(&ray, None, &mut scratch) else {
            faults.push(format!("{ray:?} aimed at the tube misses, centre {centre:?}"));
            continue;
        };
        let mut surface = scene.finish(&ray, &hit);
        let mut before: Option<Leaving> = None;
        for _ in 0..20 {
            let inward = rng.uniform() < 0.85;
            let out = direction(surface.normal.as_vector(), inward, &mut rng);
            let leaving = Leaving::new(&surface, ray.direction, out, before.as_ref());
            ray = Ray::new(surface.point, out);
            let next = scene.hit(&ray, Some(&leaving), &mut scratch).map(|hit| scene.finish(&ray, &hit));
            restarts += 1;
            faults.extend(fault(&torus, scene, &surface, &ray, next.as_ref()));
            let Some(next) = next else { break };
            (surface, before) = (next, Some(leaving));
        }
    }
    (restarts, faults)
}

#[test]
fn no_ray_is_lost_or_meets_the_wrong_surface() {
    let mut report = Vec::new();
    for scale in [1e-9, 1e-3, 1.0, 1e3, 1e9] {
        let mut all = 0;
        for ratio in [0.01, 0.4, 0.95] {
            for offset in [0.0, 1.0, 1e3, 1e6] {
                let torus = Torus::new(scale, ratio * scale).unwrap();
                let (restarts, faults) = bounce(torus, torus, offset * scale, 300);
                all += restarts;
                if let Some(first) = faults.first() {
                    report.push(format!(
                        "{torus:?} at {offset} sizes: {} of {restarts}: {first}",
                        faults.len()
                    ));
                }
            }
        }
        assert!(all > 10_000, "{all}");
    }
    assert!(report.is_empty(), "{}", report.join("\n"));
}

/// A torus that recognises the crossing it leaves by being nearest within the bound, which is not enough for rays
/// almost along the surface.
struct ByNearness(Torus);

impl Primitive for ByNearness {
    fn bounding_box(&self, m: &AffineMatrix3D) -> BoundingBox3D {
        self.0.bounding_box(m)
    }
    fn contains(&self, point: Point3D) -> bool {
        self.0.contains(point)
    }
    fn crossings(&self, ray: &Ray, scratch: &mut Scratch, out: &mut Vec<Crossing>) {
        self.0.crossings(ray, scratch, out);
    }
    fn surface(&self, ray: &Ray, crossing: &Crossing) -> Surface {
        self.0.surface(ray, crossing)
    }
}

#[test]
fn the_judge_finds_wrong_surfaces() {
    let torus = Torus::new(1.0, 0.4).unwrap();
    let (_, faults) = bounce(torus, ByNearness(torus), 1e6, 1000);
    assert!(!faults.is_empty());
}
