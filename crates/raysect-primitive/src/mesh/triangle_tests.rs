use fearless_simd::{Level, dispatch};
use raysect_core::Ray;
use raysect_core::accel::wide::LEAF_ITEMS;
use raysect_math::{Point3D, Rng, Vector3D};

use super::super::block::{Block, RayLanes, Triangles};
use super::*;

type Corners = [[f64; 3]; 3];

fn meet_block<T: Triangles>(block: &T, ray: &ShearedRay, level: Level) -> ([f64; LEAF_ITEMS], u64, u64) {
    dispatch!(level, simd => RayLanes::new(simd, ray).meet(block))
}

fn random_ray(target: [f64; 3], rng: &mut Rng) -> Ray {
    let d = Vector3D::new(rng.range(-1.0, 1.0), rng.range(-1.0, 1.0), rng.range(-1.0, 1.0));
    Ray::new(Point3D::from(target) - d * 3.0, d)
}

#[test]
fn vectors_say_what_the_oracle_says_to_the_bit() {
    let mut rng = Rng::new(1);
    let (mut hits, mut misses) = (0, 0);
    for _ in 0..20_000 {
        let mut random = || std::array::from_fn(|_| std::array::from_fn(|_| rng.range(-1.0, 1.0)));
        let triangles: [Corners; LEAF_ITEMS] = [random(), random(), random(), random()];
        let single = triangles.map(|t| t.map(|p| p.map(|x| f64::from(x as f32))));
        let ray = random_ray([0.0; 3], &mut rng);
        let ray = ShearedRay::new(&ray, rng.range(0.0, 1.0));
        let double = Block::<f64>::of(triangles.map(Some)).unwrap();
        assert!(Block::<f32>::of(triangles.map(Some)).is_none());
        let exact = Block::<f32>::of(single.map(Some)).unwrap();
        for level in [Level::new(), Level::baseline()] {
            for (given, answer) in
                [(triangles, meet_block(&double, &ray, level)), (single, meet_block(&exact, &ray, level))]
            {
                let (distances, met, doubtful) = answer;
                assert_eq!(doubtful, 0);
                for lane in 0..LEAF_ITEMS {
                    let oracle = ray.meet(given[lane]).map(|m| m.distance);
                    let found = (met >> lane & 1 == 1).then_some(distances[lane]);
                    assert_eq!(found, oracle);
                    if found.is_some() { hits += 1 } else { misses += 1 }
                }
            }
        }
    }
    assert!(hits > 1000 && misses > 1000, "{hits} {misses}");
}

#[test]
fn places_without_a_triangle_meet_nothing() {
    let corners = [[0.0, 0.0, 1.0], [1.0, 0.0, 1.0], [0.0, 1.0, 1.0]];
    let block = Block::<f32>::of([Some(corners), None, None, None]).unwrap();
    let ray = ShearedRay::new(&Ray::new(Point3D::new(0.2, 0.2, 0.0), Vector3D::Z), 0.0);
    assert_eq!(meet_block(&block, &ray, Level::new()).1, 1);
    let through_corner = ShearedRay::new(&Ray::new(Point3D::ORIGIN, Vector3D::Z), 0.0);
    let (_, met, doubtful) = meet_block(&block, &through_corner, Level::new());
    assert_eq!((met, doubtful), (0, 1));
}

#[test]
fn sides_distances_and_coordinates_are_right() {
    // Anticlockwise as seen from above.
    let corners = [[0.0, 0.0, 1.0], [2.0, 0.0, 1.0], [0.0, 4.0, 1.0]];
    let down = Ray::new(Point3D::new(0.5, 1.0, 4.0), Vector3D::new(0.0, 0.0, -2.0));
    let met = ShearedRay::new(&down, 0.0).meet(corners).unwrap();
    assert_eq!(met, Meeting { distance: 1.5, uv: [0.25, 0.25], from_behind: false });
    let up = Ray::new(Point3D::new(0.5, 1.0, 4.0), Vector3D::new(0.0, 0.0, 1.0));
    let met = ShearedRay::new(&up, -1.0).meet(corners).unwrap();
    assert_eq!(met, Meeting { distance: -3.0, uv: [0.25, 0.25], from_behind: true });
    let aside = Ray::new(Point3D::new(2.5, 1.0, 4.0), Vector3D::new(0.0, 0.0, -2.0));
    assert_eq!(ShearedRay::new(&aside, 0.0).meet(corners), None);
}

/// A fan of triangles about a point, closed around it, with coordinates that are exact and rays that pass through
/// corners and edges exactly: every ray is met once.
#[test]
fn a_ray_through_an_edge_or_a_corner_is_met_once() {
    let rim = [[4, 0], [4, 4], [0, 4], [-4, 4], [-4, 0], [-4, -4], [0, -4], [4, -4]]
        .map(|p: [i32; 2]| p.map(f64::from));
    let mut rng = Rng::new(3);
    for turn in 0..3 {
        let place = |p: [f64; 2], z: f64| {
            let mut q = [p[0], p[1], z];
            q.rotate_right(turn);
            q
        };
        let fan: Vec<Corners> = (0..8)
            .map(|i| [place([0.0, 0.0], 1.0), place(rim[i], 0.5), place(rim[(i + 1) % 8], 0.5)])
            .collect();
        for _ in 0..3000 {
            let x = [rng.range(-3.0, 4.0).floor(), rng.range(-3.0, 4.0).floor()];
            let slope = [rng.range(-2.0, 3.0).floor() * 0.25, rng.range(-2.0, 3.0).floor() * 0.25];
            let (mut o, mut d) =
                ([x[0] - 8.0 * slope[0], x[1] - 8.0 * slope[1], -7.0], [slope[0], slope[1], 1.0]);
            o.rotate_right(turn);
            d.rotate_right(turn);
            for sign in [1.0, -1.0] {
                let ray = Ray::new(o.into(), Vector3D::from(d) * sign);
                let sheared = ShearedRay::new(&ray, 0.0);
                let met = fan.iter().filter(|t| sheared.meet(**t).is_some()).count();
                let inside = x.iter().all(|x| x.abs() <= 3.0);
                assert!(met == 1 || !inside, "{met} meetings of {ray:?}");
            }
        }
    }
}

#[test]
fn a_wrong_tie_would_be_noticed() {
    // Through the common edge of two triangles: met once, although both say that it lies on their edge.
    let (a, b) = ([0.0, -1.0, 0.0], [0.0, 1.0, 0.0]);
    let (left, right) = ([a, b, [-1.0, 0.0, 0.0]], [b, a, [1.0, 0.0, 0.0]]);
    let ray = ShearedRay::new(&Ray::new(Point3D::new(0.0, 0.25, -1.0), Vector3D::Z), 0.0);
    let on_edge = |t: Corners| t.map(|p| ray.corner(p));
    assert_eq!(edge(on_edge(left)[1], on_edge(left)[0]), 0.0);
    assert_eq!(u32::from(ray.meet(left).is_some()) + u32::from(ray.meet(right).is_some()), 1);
}

#[test]
fn products_are_taken_apart_without_error() {
    let mut rng = Rng::new(9);
    for _ in 0..1000 {
        let (a, b) = (rng.range(-1.0, 1.0), rng.range(-1.0, 1.0));
        let (high, low) = product(a, b);
        assert_eq!(high, a * b);
        assert_eq!(low, f64::mul_add(a, b, -high));
    }
}
