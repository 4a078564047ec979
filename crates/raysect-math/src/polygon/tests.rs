use super::*;
use crate::Rng;
use std::f64::consts::TAU;

fn points(list: &[[f64; 2]]) -> Vec<Point2D> {
    list.iter().map(|&[x, y]| Point2D::new(x, y)).collect()
}

/// A star around a centre, with random radii: simple, and often concave.
fn star(count: usize, rng: &mut Rng) -> Polygon2D {
    let vertices: Vec<Point2D> = (0..count)
        .map(|i| {
            let (s, c) = (TAU * i as f64 / count as f64).sin_cos();
            let r = rng.range(0.2, 1.0);
            Point2D::new(3.0 + r * c, -2.0 + r * s)
        })
        .collect();
    Polygon2D::new(vertices).unwrap()
}

fn reversed(polygon: &Polygon2D) -> Polygon2D {
    Polygon2D::new(polygon.vertices.iter().rev().copied().collect::<Vec<_>>()).unwrap()
}

#[test]
fn area_and_winding_follow_the_order_of_the_vertices() {
    let square =
        Polygon2D::new(points(&[[1.0, 1.0], [3.0, 1.0], [3.0, 2.0], [1.0, 2.0], [1.0, 1.0]])).unwrap();
    assert_eq!((square.vertices().len(), square.signed_area(), square.is_clockwise()), (4, 2.0, false));
    let back = reversed(&square);
    assert_eq!((back.signed_area(), back.is_clockwise()), (-2.0, true));
    let mut rng = Rng::new(1);
    for count in [3, 5, 17, 200] {
        let star = star(count, &mut rng);
        assert!(star.signed_area() > 0.0 && !star.is_clockwise());
        assert!(reversed(&star).signed_area() < 0.0 && reversed(&star).is_clockwise());
    }
}

#[test]
fn vertices_and_edges_belong_to_the_polygon() {
    let mut rng = Rng::new(2);
    for count in [4, 9, 60] {
        for polygon in [star(count, &mut rng), reversed(&star(count, &mut rng))] {
            assert!(polygon.vertices.iter().all(|&p| polygon.contains(p)));
        }
    }
    // Coordinates of few digits: middles and quarters of edges are exact.
    let exact =
        Polygon2D::new(points(&[[0.0, 0.0], [4.0, 1.0], [8.0, 0.0], [6.0, 5.0], [4.0, 2.0], [1.0, 7.0]]))
            .unwrap();
    for (a, b) in exact.edges() {
        for t in [0.25, 0.5, 0.75] {
            assert!(exact.contains(a + a.vector_to(b) * t));
        }
    }
    for outside in [[4.0, 0.999_999_999], [4.0, 2.000_000_001], [-1.0, 0.0], [9.0, 0.0], [f64::NAN, 1.0]] {
        assert!(!exact.contains(Point2D::new(outside[0], outside[1])), "{outside:?}");
    }
}

#[test]
fn containment_agrees_with_the_sum_of_angles_and_with_the_triangles() {
    let mut rng = Rng::new(3);
    let (mut inside, mut mistaken) = (0, 0);
    for count in [3, 7, 40] {
        for polygon in [star(count, &mut rng), reversed(&star(count, &mut rng))] {
            let triangles = polygon.triangulate().unwrap();
            for _ in 0..2000 {
                let p = Point2D::new(rng.range(2.0, 4.0), rng.range(-3.0, -1.0));
                let angle = |(a, b): (Point2D, Point2D)| {
                    let (u, v) = (p.vector_to(a), p.vector_to(b));
                    u.cross(v).atan2(u.dot(v))
                };
                let around = polygon.edges().map(angle).sum::<f64>().abs() > 3.0;
                assert_eq!(polygon.contains(p), around, "{p:?}");
                let holds = |t: &[u32; 3]| {
                    let [a, b, c] = t.map(|k| polygon.vertices[k as usize]);
                    orientation(a, b, p) <= 0.0 && orientation(b, c, p) <= 0.0 && orientation(c, a, p) <= 0.0
                };
                assert_eq!(triangles.iter().any(holds), around, "{p:?}");
                inside += usize::from(around);
                // Negative control: without the last triangle some are missing.
                mistaken += usize::from(triangles[1..].iter().any(holds) != around);
            }
        }
    }
    assert!(inside > 2000 && mistaken > 20, "{inside} {mistaken}");
}

#[test]
fn triangles_fill_the_polygon_clockwise() {
    let mut rng = Rng::new(4);
    for count in [3, 4, 5, 10, 100, 1000] {
        for polygon in [star(count, &mut rng), reversed(&star(count, &mut rng))] {
            let triangles = polygon.triangulate().unwrap();
            assert_eq!(triangles.len(), count - 2);
            let mut sum = 0.0;
            for t in triangles {
                let [a, b, c] = t.map(|k| polygon.vertices[k as usize]);
                assert!(orientation(a, b, c) <= 0.0);
                sum -= 0.5 * orientation(a, b, c);
            }
            assert!((sum / polygon.signed_area().abs() - 1.0).abs() < 1e-12);
        }
    }
}

#[test]
fn outlines_that_cross_or_touch_themselves_are_refused() {
    let crossing = |list: &[[f64; 2]]| match Polygon2D::new(points(list)) {
        Err(MathError::PolygonCrossing { first, second }) => [first, second],
        other => panic!("{other:?}"),
    };
    assert_eq!(crossing(&[[0.0, 0.0], [1.0, 1.0], [1.0, 0.0], [0.0, 1.0]]), [0, 2]);
    // A vertex on an edge, and two vertices in one place.
    let touched = crossing(&[[0.0, 0.0], [4.0, 0.0], [4.0, 2.0], [2.0, 0.0], [0.0, 2.0]]);
    assert!(touched == [0, 2] || touched == [0, 3], "both edges at the vertex touch: {touched:?}");
    crossing(&[[0.0, 0.0], [2.0, 0.0], [1.0, 1.0], [2.0, 2.0], [0.0, 2.0], [1.0, 1.0]]);
    // Negative control: a hair's breadth away from the edge it is simple.
    let close = [[0.0, 0.0], [4.0, 0.0], [4.0, 2.0], [2.0, 1e-300], [0.0, 2.0]];
    assert!(Polygon2D::new(points(&close)).is_ok());
    let message =
        Polygon2D::new(points(&[[0.0, 0.0], [1.0, 1.0], [1.0, 0.0], [0.0, 1.0]])).unwrap_err().to_string();
    assert_eq!(message, "the edges that leave the vertices 0 and 2 of the polygon cross or touch");
}

#[test]
fn wrong_vertices_are_named() {
    let named = |list: &[[f64; 2]]| match Polygon2D::new(points(list)) {
        Err(MathError::PolygonVertex { vertex, .. }) => vertex,
        other => panic!("{other:?}"),
    };
    assert_eq!(named(&[]), 0);
    assert_eq!(named(&[[0.0, 0.0], [1.0, 0.0], [0.0, 0.0]]), 1);
    assert_eq!(named(&[[0.0, 0.0], [1.0, 0.0], [f64::NAN, 1.0], [0.0, 1.0]]), 2);
    assert_eq!(named(&[[0.0, 0.0], [1.0, 0.0], [1.0, 0.0], [0.0, 1.0]]), 2);
    assert_eq!(named(&[[0.0, 0.0], [2.0, 0.0], [1.0, 0.0], [0.0, 1.0]]), 1);
    assert_eq!(named(&[[0.0, 0.0], [1.0, 1.0], [2.0, 2.0]]), 0);
    let message = Polygon2D::new(points(&[[0.0, 0.0], [1.0, 0.0], [1.0, 0.0]])).unwrap_err().to_string();
    assert_eq!(message, "vertex 2 = (1, 0) of the polygon: it equals the vertex before it");
}
