//! Meshes of the tests.

use crate::{Point2D, Point3D, Rng};

/// What Raysect has evaluated.
pub(super) struct Saved {
    pub(super) vertices: Vec<Point2D>,
    pub(super) triangles: Vec<[u32; 3]>,
    pub(super) of_vertices: Vec<f64>,
    pub(super) of_triangles: Vec<f64>,
    /// x, y, and the values that are interpolated and discrete.
    pub(super) at: Vec<[f64; 4]>,
}

impl Saved {
    pub(super) fn read() -> Self {
        let (mut vertices, mut triangles, mut at) = (vec![], vec![], vec![]);
        let (mut of_vertices, mut of_triangles) = (vec![], vec![]);
        for line in include_str!("../../tests/data/mesh2d_raysect.txt").lines() {
            let words: Vec<&str> = line.split(' ').collect();
            let n: Vec<f64> = words[1..].iter().map(|w| w.parse().unwrap()).collect();
            match words[0] {
                "vertex" => {
                    vertices.push(Point2D::new(n[0], n[1]));
                    of_vertices.push(n[2]);
                }
                "triangle" => {
                    triangles.push([n[0] as u32, n[1] as u32, n[2] as u32]);
                    of_triangles.push(n[3]);
                }
                _ => at.push([n[0], n[1], n[2], n[3]]),
            }
        }
        assert_eq!((vertices.len(), triangles.len(), at.len()), (40, 69, 60));
        Self { vertices, triangles, of_vertices, of_triangles, at }
    }
}

/// Equal to within the tolerance of the comparison with Raysect.
pub(super) fn close(a: f64, b: f64) -> bool {
    (a - b).abs() <= 1e-9 * b.abs().max(1e-3)
}

/// n × n squares with random corners inside, each cut in two; it reaches from `from` to `from` + 1 and has a straight
/// border.
pub(super) fn grid(n: usize, from: f64) -> (Vec<Point2D>, Vec<[u32; 3]>) {
    let mut rng = Rng::new(42);
    let mut place = |i: usize, last: usize| {
        let shift = if i == 0 || i == last { 0.0 } else { rng.range(-0.2, 0.2) };
        from + (i as f64 + shift) / last as f64
    };
    let mut vertices = Vec::new();
    for i in 0..=n {
        for j in 0..=n {
            vertices.push(Point2D::new(place(i, n), place(j, n)));
        }
    }
    let at = |i: usize, j: usize| (i * (n + 1) + j) as u32;
    let mut triangles = Vec::new();
    for i in 0..n {
        for j in 0..n {
            let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            triangles.extend(if (i + j) % 2 == 0 { [[a, b, c], [a, d, c]] } else { [[a, b, d], [b, d, c]] });
        }
    }
    (vertices, triangles)
}

/// The mesh turned by 0.5 rad: points on its border are then rounded off it.
pub(super) fn turned(vertices: &[Point2D]) -> Vec<Point2D> {
    let (s, c) = 0.5f64.sin_cos();
    vertices.iter().map(|p| Point2D::new(c * p.x - s * p.y, s * p.x + c * p.y)).collect()
}

/// Points on the edges of triangles, as near as rounding lets them, and the triangle of each.
pub(super) fn on_edges(
    vertices: &[Point2D],
    triangles: &[[u32; 3]],
    count: usize,
) -> impl Iterator<Item = (Point2D, usize)> {
    let mut rng = Rng::new(7);
    (0..count).map(move |i| {
        let triangle = i % triangles.len();
        let places = triangles[triangle].map(|v| vertices[v as usize]);
        let k = (rng.uniform() * 3.0) as usize;
        (places[k] + places[k].vector_to(places[(k + 1) % 3]) * rng.uniform(), triangle)
    })
}

/// n³ cubes with random corners inside, each cut into six tetrahedra around a diagonal (H. Freudenthal).
pub(crate) fn cubes(n: usize, from: f64) -> (Vec<Point3D>, Vec<[u32; 4]>) {
    let mut rng = Rng::new(43);
    let mut place = |i: usize| {
        let shift = if i == 0 || i == n { 0.0 } else { rng.range(-0.1, 0.1) };
        from + (i as f64 + shift) / n as f64
    };
    let side = n + 1;
    let mut vertices = Vec::new();
    for k in 0..side * side * side {
        vertices.push(Point3D::new(place(k / side / side), place(k / side % side), place(k % side)));
    }
    let step = [side * side, side, 1];
    let mut tetrahedra = Vec::new();
    for cube in 0..n * n * n {
        let first = (cube / n / n) * step[0] + (cube / n % n) * step[1] + cube % n;
        for [a, b] in [[0, 1], [0, 2], [1, 0], [1, 2], [2, 0], [2, 1]] {
            let corners =
                [first, first + step[a], first + step[a] + step[b], first + step[0] + step[1] + step[2]];
            tetrahedra.push(corners.map(|v| v as u32));
        }
    }
    (vertices, tetrahedra)
}
