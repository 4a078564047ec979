//! What every solid of revolution must pass.

use raysect_core::testing::check_primitive;
use raysect_core::{
    BoundingBox3D, Crossing, Departure, Feature, Interval, Leaving, Node, Primitive, Ray, Scratch, Surface,
    World,
};
use raysect_math::{AffineMatrix3D, Point3D, Rng, SphereSampler, Vector3D, translate};

use super::{Subject, inward, line};

/// Sizes and proportions: ordinary, tiny, huge, flat, needle, pancakes.
const SHAPES: [(f64, f64); 7] =
    [(0.5, 1.0), (5e-10, 1e-9), (5e8, 1e9), (2.0, 0.3), (1e-6, 1.0), (1.0, 1e-6), (1e3, 1e-3)];

/// Makes a subject of a radius and a height, for a judge.
pub(crate) type Maker = dyn Fn(f64, f64, &mut dyn FnMut(&Subject));

/// The contract at every size and proportion.
pub(crate) fn keeps_the_contract(make: &Maker) {
    for (radius, height) in SHAPES {
        make(radius, height, &mut |s| {
            check_primitive(s.shape, 4000, 1).unwrap_or_else(|what| panic!("{radius} × {height}: {what}"));
        });
    }
}

/// Crossings from near and far against 32 digits, and a wrong shape that is found out.
pub(crate) fn distances_are_right(make: &Maker) {
    let mut rng = Rng::new(11);
    for (radius, height) in SHAPES {
        make(radius, height, &mut |s| {
            for k in [1.0, 1e3, 1e7, 1e9] {
                let (worst, wrong) = s.distance_errors(k, 4000, &mut rng);
                println!("{radius} × {height} from {k}: {worst:.2} ε");
                assert!(worst <= 4.0 && wrong == 0, "{radius} × {height} from {k}: {worst}, {wrong} wrong");
            }
        });
    }
    make(0.5, 1.0, &mut |right| {
        make(0.5 * (1.0 + 1e-12), 1.0, &mut |other| {
            let wrong = Subject { shape: other.shape, ..*right };
            assert!(wrong.distance_errors(1.0, 300, &mut rng).0 > 100.0);
        });
    });
}

/// Surface points lie on the surface within their bound, which is of the order of rounding.
pub(crate) fn points_keep_their_bound(make: &Maker) {
    let mut rng = Rng::new(12);
    for (radius, height) in SHAPES {
        make(radius, height, &mut |s| {
            for k in [1.0, 1e7] {
                let worst = s.residual(k, 4000, &mut rng);
                println!("{radius} × {height} from {k}: {worst:.2} of the bound");
                assert!(worst <= 1.0, "{radius} × {height} from {k}: {worst}");
            }
        });
    }
    make(0.5, 1.0, &mut |right| {
        make(0.5 * (1.0 + 1e-14), 1.0, &mut |other| {
            assert!(Subject { shape: other.shape, ..*right }.residual(1.0, 300, &mut rng) > 1.0);
        });
    });
}

/// Mean chord and share of hits; areas ten per cent too large are found out.
pub(crate) fn chords_agree_with_cauchy(make: &Maker) {
    let mut rng = Rng::new(13);
    for (radius, height) in [(0.5, 1.0), (1.0, 0.2), (0.2, 1.5)] {
        make(radius, height, &mut |s| {
            let scores = s.chord_scores(200_000, &mut rng);
            assert!(scores.iter().all(|z| z.abs() < 4.0), "{radius} × {height}: {scores:?}");
            let wrong = Subject { area: 1.1 * s.area, ..*s }.chord_scores(200_000, &mut rng);
            assert!(wrong.iter().all(|z| z.abs() > 4.0), "{radius} × {height}: {wrong:?}");
        });
    }
}

/// Rays that start again from the surface, in the space of the shape.
pub(crate) fn restarts_are_right(make: &Maker) {
    let mut rng = Rng::new(14);
    let sizes = [1e-9, 1e-3, 1.0, 1e3, 1e9].map(|size| (0.5 * size, size));
    for (radius, height) in sizes.into_iter().chain(SHAPES) {
        make(radius, height, &mut |s| {
            assert_eq!(s.restart_failures(10_000, &mut rng), 0, "{radius} × {height}");
        });
    }
    make(0.5, 1.0, &mut |right| {
        make(0.5 * (1.0 + 1e-12), 1.0, &mut |other| {
            assert!(Subject { shape: other.shape, ..*right }.restart_failures(300, &mut rng) > 100);
        });
    });
}

/// Rays that are reflected inside a shape that is placed in a world.
pub(crate) fn nothing_is_lost<P: Primitive>(make: impl Fn(f64, f64) -> P) {
    let mut rng = Rng::new(15);
    let sizes = [1e-9, 1e-3, 1.0, 1e3, 1e9].map(|size| (0.5 * size, size));
    for (radius, height) in sizes.into_iter().chain(SHAPES) {
        for shift in [0.0, 1.0, 1e3, 1e6] {
            let size = radius.hypot(height);
            let lost = lost_in_world(make(radius, height), size, shift, 10_000, &mut rng);
            assert_eq!(lost, 0, "{radius} × {height}, {shift} sizes away");
        }
    }
    assert!(lost_in_world(Forgetful(make(0.5, 1.0)), 1.0, 1e3, 10_000, &mut rng) > 1000);
}

/// A shape that takes the surface from which a ray starts for the next one.
struct Forgetful<P>(P);

impl<P: Primitive> Primitive for Forgetful<P> {
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

/// Shapes at the ends of the admitted sizes are hit twice by lines through their inside, and nothing overflows.
pub(crate) fn extremes_are_finite(make: &Maker) {
    let mut rng = Rng::new(17);
    let ends =
        [(1e-100, 1e-100), (1e100, 1e100), (1e100, 1e50), (1e50, 1e100), (1e-50, 1e-100), (1e-100, 1e-50)];
    for (radius, height) in ends {
        make(radius, height, &mut |s| {
            for k in [1.0, 1e7] {
                let direction = SphereSampler.sample(&mut rng);
                let inside = Point3D::new(0.0, 0.0, 0.4 * height);
                let ray = Ray::new(inside - direction * (k * s.size()), direction);
                let found = line(s.shape, ray.origin.to_array(), direction.to_array());
                let blurred = k * f64::EPSILON * s.size() > 0.1 * radius.min(height);
                assert!(found.len() == 2 || blurred, "{radius} × {height} from {k}: {found:?}");
                let start = line(s.shape, inside.to_array(), direction.to_array());
                assert!(
                    start.len() == 2 && start[0].0 < 0.0 && start[1].0 > 0.0,
                    "{radius} × {height}: {start:?}"
                );
                let sample = s.shape.sample_surface(ray.origin, [0.3, 0.4, 0.5]).unwrap();
                assert!(sample.density > 0.0 && sample.point.is_finite(), "{sample:?}");
            }
            assert!(s.volume > 0.0 && s.area > 0.0 && s.area.is_finite());
        });
    }
}

/// Light sampling as seen from around shapes; a density for another place is found out.
pub(crate) fn light_sampling_is_right(make: &Maker) {
    let mut rng = Rng::new(16);
    let places = [[3.0, 1.0, 2.0], [0.2, 0.1, 1.9], [1.0, -0.4, 0.5], [-0.7, 0.2, -0.4], [0.0, 0.0, -2.0]];
    let places = places.map(Point3D::from);
    for (radius, height) in [(0.5, 1.2), (1.0, 0.1), (0.1, 1.2)] {
        make(radius, height, &mut |s| {
            for from in places {
                let scores = s.sampling_scores(from, from, 20_000, &mut rng);
                assert!(scores[0] < 4.5 && scores[1] < 4.5, "{radius} × {height}, {from:?}: {scores:?}");
            }
        });
    }
    make(0.5, 1.2, &mut |s| {
        let wrong = s.sampling_scores(places[0], Point3D::new(3.0, -1.0, 1.0), 20_000, &mut rng);
        assert!(wrong[0] > 4.5, "{wrong:?}");
        assert!(s.shape.sample_surface(Point3D::new(0.05, 0.1, 0.5), [0.5; 3]).is_none());
        let (from, hidden) = (Point3D::new(3.0, 0.0, 0.5), Point3D::new(-0.3, 0.0, 0.3));
        for face in [0, 1, 2, 7] {
            let feature = Feature { face, ..Default::default() };
            assert_eq!(s.shape.surface_density(from, hidden, feature), 0.0, "{face}");
        }
    });
}

/// How many of so many rays that are reflected to and fro inside a shape, far from the origin of the world, are lost or
/// found outside of it by more than rounding.
fn lost_in_world(shape: impl Primitive, size: f64, shift: f64, rays: usize, rng: &mut Rng) -> usize {
    let mut world = World::<()>::new();
    let offset = Vector3D::new(0.6, -0.64, 0.48) * (shift * size);
    let centre = shape.bounding_box(&AffineMatrix3D::IDENTITY).enclosing_sphere().centre;
    world.add(Node::of(shape, ()).transform(translate(offset.x, offset.y, offset.z))).unwrap();
    let scene = world.scene().unwrap();
    let mut scratch = Scratch::default();
    let mut lost = 0;
    let mut at = (Ray::new(centre + offset, SphereSampler.sample(rng)), None);
    for _ in 0..rays {
        let (ray, leaving) = &at;
        let Some(hit) = scene.hit(ray, leaving.as_ref(), &mut scratch) else {
            lost += 1;
            at = (Ray::new(centre + offset, SphereSampler.sample(rng)), None);
            continue;
        };
        let surface = scene.finish(ray, &hit);
        let off = ray.point_at(hit.crossing.distance).distance_to(surface.point);
        let cosine = surface.normal.dot(ray.direction).abs().max(1e-3);
        let wrong = !surface.exiting || off > (surface.bound + 1e-13 * size) / cosine;
        lost += usize::from(wrong);
        let towards = inward(surface.normal, rng);
        let leaving = Leaving::new(&surface, ray.direction, towards, leaving.as_ref());
        at = (Ray::new(surface.point, towards), Some(leaving));
    }
    lost
}
