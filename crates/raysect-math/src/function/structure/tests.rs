use super::super::{
    Extrapolation, Function, Interpolation, Interpolator2DArray, Interpolator3DArray, axisymmetric,
};
use super::*;
use crate::{Discrete2DMesh, Discrete3DMesh, Point2D, Rng};

/// A knot every so often, not evenly.
fn knots(rng: &mut Rng, count: usize) -> Vec<f64> {
    let mut at = rng.range(-1.0, -0.5);
    (0..count)
        .map(|_| {
            at += rng.range(0.1, 0.5);
            at
        })
        .collect()
}

/// A line through about the middle of everything.
fn line(rng: &mut Rng) -> (Point3D, Vector3D) {
    let mut place = || Point3D::new(rng.range(-2.0, 2.0), rng.range(-2.0, 2.0), rng.range(-2.0, 2.0));
    let (a, b) = (place(), place());
    (a, a.vector_to(b) * 3.0)
}

/// Asserts that a function is a polynomial of degree three or less between any two breaks along random lines: what three
/// of four intervals tell must be true in the fourth. `jumps` are functions that are constant.
pub(super) fn assert_smooth_between_breaks(function: &dyn Structured3D, seed: u64) -> usize {
    let mut rng = Rng::new(seed);
    let mut pieces = 0;
    for _ in 0..2000 {
        let (origin, direction) = line(&mut rng);
        let mut breaks = vec![0.0, 1.0];
        function.add_breaks(origin, direction, &mut breaks);
        breaks.retain(|t| (0.0..=1.0).contains(t));
        breaks.sort_by(f64::total_cmp);
        for piece in breaks.windows(2).filter(|w| w[1] - w[0] > 1e-6) {
            let value = |share: f64| {
                let p = origin + direction * (piece[0] + share * (piece[1] - piece[0]));
                function.evaluate((p.x, p.y, p.z))
            };
            let at: Vec<f64> = [0.01, 0.2, 0.4, 0.6, 0.8, 0.99].map(value).to_vec();
            if at.iter().any(|v| v.is_nan()) {
                assert!(at.iter().all(|v| v.is_nan()), "{at:?}");
                continue;
            }
            // The cubic through the inner four, at both ends.
            let cubic = |x: f64| {
                let nodes = [0.2, 0.4, 0.6, 0.8];
                (0..4)
                    .map(|i| {
                        let others = (0..4).filter(|&k| k != i);
                        let basis: f64 = others.map(|k| (x - nodes[k]) / (nodes[i] - nodes[k])).product();
                        basis * at[i + 1]
                    })
                    .sum::<f64>()
            };
            for (x, found) in [(0.01, at[0]), (0.99, at[5])] {
                assert!(
                    (cubic(x) - found).abs() < 1e-9,
                    "{x}: {} {found}, {origin:?} {direction:?}",
                    cubic(x)
                );
            }
            pieces += 1;
        }
    }
    pieces
}

#[test]
fn grids_are_smooth_between_their_breaks() {
    let mut rng = Rng::new(1);
    let (x, y, z) = (knots(&mut rng, 7), knots(&mut rng, 5), knots(&mut rng, 6));
    let values: Vec<f64> = (0..7 * 5 * 6).map(|_| rng.uniform()).collect();
    let grid = Interpolator3DArray::new(&x, &y, &z, &values, Interpolation::Linear).unwrap();
    assert!(assert_smooth_between_breaks(&grid, 2) > 1000);
    let far = grid.clone().extrapolate(Extrapolation::Nearest, 0.3, 0.2, 0.1).unwrap();
    assert!(assert_smooth_between_breaks(&far, 3) > 1000);
    assert!(grid.length_scale() > 0.1 && grid.length_scale() < 0.5);
}

/// Triangles of a jittered grid in the half-plane, with a random value each.
fn triangles(rng: &mut Rng) -> Discrete2DMesh {
    let side = 7;
    let mut place = |i: usize| 0.25 * i as f64 + rng.range(0.0, 0.1);
    let vertices: Vec<Point2D> =
        (0..side * side).map(|k| Point2D::new(0.2 + place(k % side), place(k / side) - 0.8)).collect();
    let corner = |i: usize, j: usize| (j * side + i) as u32;
    let cells = (0..side - 1).flat_map(|i| (0..side - 1).map(move |j| (i, j)));
    let triangles: Vec<[u32; 3]> = cells
        .flat_map(|(i, j)| {
            let [a, b, c, d] = [corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)];
            [[a, b, c], [a, c, d]]
        })
        .collect();
    let values: Vec<f64> = triangles.iter().map(|_| rng.uniform()).collect();
    Discrete2DMesh::new(vertices, triangles, values).unwrap()
}

#[test]
fn what_is_turned_around_an_axis_is_smooth_between_its_breaks() {
    // Constant on each triangle, so that any jump that is not told is seen.
    let mesh = triangles(&mut Rng::new(4));
    let turned = axisymmetric(mesh.clone().with_default(0.0));
    assert!(assert_smooth_between_breaks(&turned, 5) > 1000);
    assert!(assert_smooth_between_breaks(&axisymmetric(mesh), 6) > 500);
}

#[test]
fn tables_in_the_half_plane_tell_the_cylinders_and_planes_of_their_knots() {
    let r = [0.5, 1.0, 1.5];
    let values = [1.0; 9];
    let table = Interpolator2DArray::new(&r, &[-1.0, 0.0, 1.0], &values, Interpolation::Cubic).unwrap();
    let turned = axisymmetric(table);
    let mut breaks = Vec::new();
    turned.add_breaks(Point3D::new(-2.0, 0.0, 0.3), Vector3D::X, &mut breaks);
    breaks.sort_by(f64::total_cmp);
    // The radius bends where the line meets the axis, too: at 2, and twice as far each time.
    assert_eq!(
        (breaks[..3].to_vec(), breaks[breaks.len() - 3..].to_vec()),
        (vec![0.5, 1.0, 1.5], vec![2.5, 3.0, 3.5])
    );
    let bends = &breaks[3..breaks.len() - 3];
    assert!(bends.contains(&2.0) && bends.iter().all(|t| (t - 2.0).abs() < 0.5), "{bends:?}");
    breaks.clear();
    turned.add_breaks(Point3D::new(0.7, 0.0, -2.0), Vector3D::Z * 0.5, &mut breaks);
    assert_eq!(breaks, [2.0, 4.0, 6.0]);
}

#[test]
fn tables_that_go_on_for_ever_have_corners_there_too() {
    let table =
        Interpolator2DArray::new(&[0.5, 1.0, 1.5], &[-1.0, 1.0], &[1.0; 6], Interpolation::Linear).unwrap();
    let found = |range: f64| {
        let table = table.clone().extrapolate(Extrapolation::Nearest, range, range).unwrap();
        assert_eq!(table.length_scale(), 0.5);
        let mut breaks = Vec::new();
        // Far above the last knot, and past the axis by more than the length scale.
        axisymmetric(table).add_breaks(Point3D::new(-2.0, 0.6, 30.0), Vector3D::X, &mut breaks);
        breaks.iter().filter(|t| **t > 0.0 && **t != 2.0).count()
    };
    assert_eq!((found(f64::INFINITY), found(100.0), found(1e-6)), (4, 6, 0));
}

#[test]
fn tetrahedra_are_constant_between_their_breaks() {
    let (vertices, tetrahedra) = crate::mesh_function::cubes(4, 0.0);
    let vertices: Vec<Point3D> =
        vertices.iter().map(|p| Point3D::new(2.0 * p.x - 1.0, 2.0 * p.y - 1.1, 1.8 * p.z - 0.7)).collect();
    let values: Vec<f64> = (0..tetrahedra.len()).map(|i| i as f64).collect();
    let mesh = Discrete3DMesh::new(vertices, tetrahedra, values).unwrap();
    assert!(assert_smooth_between_breaks(&mesh, 7) > 1000);
    assert!(assert_smooth_between_breaks(&mesh.with_default(-1.0), 8) > 1000);
}

/// A function that keeps its breaks to itself.
pub(super) struct Secret<T>(pub(super) T);

impl<T: Structured3D> Function<(f64, f64, f64)> for Secret<T> {
    type Value = f64;
    fn evaluate(&self, at: (f64, f64, f64)) -> f64 {
        self.0.evaluate(at)
    }
}

impl<T: Structured3D> Structured3D for Secret<T> {
    fn length_scale(&self) -> f64 {
        self.0.length_scale()
    }
    fn add_breaks(&self, _: Point3D, _: Vector3D, _: &mut Vec<f64>) {}
}

#[test]
#[should_panic(expected = "Point3D")]
fn breaks_that_are_kept_secret_are_missed() {
    let mesh = triangles(&mut Rng::new(4)).with_default(0.0);
    assert_smooth_between_breaks(&Secret(axisymmetric(mesh)), 5);
}
