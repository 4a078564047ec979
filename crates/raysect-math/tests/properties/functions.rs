//! Functions, tables, functions on meshes, polygons.

use proptest::prelude::*;
use raysect_math::function::{
    Arg, Extrapolation1D, Function, Interpolation1D, Interpolator1DArray, blend, components, function,
    function1d, function3d, sample_path, sample_points, sample1d, sample2d, sample3d,
};
use raysect_math::{
    Discrete2DMesh, Discrete3DMesh, Interpolator2DMesh, Point2D, Point3D, Polygon2D, Vector3D, rotate,
};

fn numbers(count: usize) -> impl Strategy<Value = Vec<f64>> {
    prop::collection::vec(-1.0..1.0f64, count)
}

/// A rotated, sheared square of n × n cells, each cut in two.
fn plane(n: u32, [a, b]: [f64; 2]) -> (Vec<Point2D>, Vec<[u32; 3]>) {
    let corner = |i: u32, j: u32| {
        let (x, y) = (f64::from(i) / f64::from(n), f64::from(j) / f64::from(n));
        Point2D::new(x + a * y, b * x + y)
    };
    let vertices = (0..=n).flat_map(|i| (0..=n).map(move |j| corner(i, j))).collect();
    let cell = move |i: u32, j: u32| {
        let at = |i, j| i * (n + 1) + j;
        [[at(i, j), at(i + 1, j), at(i + 1, j + 1)], [at(i, j), at(i, j + 1), at(i + 1, j + 1)]]
    };
    (vertices, (0..n).flat_map(|i| (0..n).flat_map(move |j| cell(i, j))).collect())
}

/// A simple polygon around the origin.
fn star(radii: &[f64]) -> Vec<Point2D> {
    let turn = |i: usize| (std::f64::consts::TAU * i as f64 / radii.len() as f64).sin_cos();
    radii.iter().enumerate().map(|(i, r)| Point2D::new(r * turn(i).1, r * turn(i).0)).collect()
}

proptest! {
    #[test]
    fn operations_are_those_of_numbers(x in -3.0..3.0f64, y in -3.0..3.0f64, t in -0.5..1.5f64) {
        let at = (x, y);
        let number = |yes: bool| f64::from(yes);
        prop_assert_eq!(Arg::X.less(Arg::Y).evaluate(at), number(x < y));
        prop_assert_eq!(Arg::X.less_equal(Arg::Y).evaluate(at), number(x <= y));
        prop_assert_eq!(Arg::X.greater(Arg::Y).evaluate(at), number(x > y));
        prop_assert_eq!(Arg::X.greater_equal(Arg::Y).evaluate(at), number(x >= y));
        prop_assert_eq!(Arg::X.equal(Arg::X).evaluate(at) + Arg::X.not_equal(Arg::Y).evaluate(at), 1.0 + number(x != y));
        let (s, c) = (x.sin(), x.cos());
        prop_assert_eq!((function(s).asin().evaluate(at), function(c).acos().evaluate(at)), (s.asin(), c.acos()));
        prop_assert_eq!((Arg::X.tan().evaluate(at), Arg::X.atan2(Arg::Y).evaluate(at)), (x.tan(), x.atan2(y)));
        prop_assert_eq!((Arg::X % Arg::Y).evaluate(at), x % y);
        prop_assert_eq!(Arg::X.abs().pow(Arg::Y).evaluate(at), x.abs().powf(y));
        prop_assert_eq!(Arg::X.erf().evaluate(at), -(-Arg::X).erf().evaluate(at));
        let clamped = t.clamp(0.0, 1.0);
        let mixed = blend(Arg::X, Arg::Y, t).evaluate(at);
        prop_assert!((mixed - (x + clamped * (y - x))).abs() < 1e-14);
        let v = components(Arg::X, Arg::Y, t).evaluate(at);
        prop_assert_eq!((v, function3d(|a, b, c| a + b + c).evaluate((x, y, t))), (Vector3D::new(x, y, t), x + y + t));
        prop_assert_eq!(function1d(|x: f64| x * x).of(Arg::Y).checked(at), Ok(y * y));
    }

    #[test]
    fn samples_are_values_at_their_places(
        low in -2.0..2.0f64, width in 0.0..3.0f64, n in 1..9usize, m in 1..7usize, corners in numbers(9),
    ) {
        let f = Arg::X * Arg::X - 3.0 * Arg::Y;
        let (axis, other) = ((low, low + width, n), (-1.0, low.abs(), m));
        let ([x, y], values) = sample2d(&f, axis, other).unwrap();
        prop_assert_eq!((x.len(), y.len(), x[0]), (n, m, low));
        for (index, value) in values.iter().enumerate() {
            prop_assert_eq!(*value, f.evaluate((x[index / m], y[index % m])));
        }
        let g = f * Arg::Z;
        let ([x, y, z], values) = sample3d(&g, axis, other, axis).unwrap();
        for (index, value) in values.iter().enumerate() {
            prop_assert_eq!(*value, g.evaluate((x[index / (m * n)], y[index / n % m], z[index % n])));
        }
        let (x, values) = sample1d(&Arg::X.exp(), axis).unwrap();
        prop_assert!(x.is_sorted() && values == sample_points(&Arg::X.exp(), &x));
        // Along a path, the distance itself and the first and last corner.
        let corners: Vec<Point3D> = corners.chunks(3).map(|c| Point3D::new(c[0], c[1], c[2])).collect();
        let (distance, values) = sample_path(&components(Arg::X, Arg::Y, Arg::Z), &corners, n + 1).unwrap();
        let length = corners[0].distance_to(corners[1]) + corners[1].distance_to(corners[2]);
        prop_assert!((distance[n] - length).abs() < 1e-14);
        prop_assert!((values[0] - corners[0].to_vector()).length() < 1e-14);
        prop_assert!((values[n] - corners[2].to_vector()).length() < 1e-13);
    }

    #[test]
    fn integrals_add_up_and_monotone_curves_do_not_overshoot(
        f in numbers(7), a in -1.0..7.0f64, b in -1.0..7.0f64, c in -1.0..7.0f64,
    ) {
        let knots: Vec<f64> = (0..7).map(|i| f64::from(i) * (1.0 + 0.03 * f64::from(i))).collect();
        for kind in [Interpolation1D::Linear, Interpolation1D::Cubic, Interpolation1D::Monotone] {
            let table = Interpolator1DArray::new(&knots, &f, kind).unwrap();
            prop_assert_eq!(table.domain(), (knots[0], knots[6]));
            let table = table.extrapolate(Extrapolation1D::Nearest, 2.0).unwrap();
            let whole = table.integral(a, b) + table.integral(b, c);
            prop_assert!((whole - table.integral(a, c)).abs() < 1e-13);
            prop_assert!((table.average(a, b) - table.average(b, a)).abs() < 1e-13);
            prop_assert_eq!(table.evaluate(-1.5), f[0]);
        }
        let mut rising = f.clone();
        rising.sort_by(f64::total_cmp);
        let table = Interpolator1DArray::new(&knots, &rising, Interpolation1D::Monotone).unwrap();
        let (low, high) = (a.clamp(0.0, 7.0).min(b.clamp(0.0, 7.0)), a.clamp(0.0, 7.0).max(b.clamp(0.0, 7.0)));
        prop_assert!(table.evaluate(low) <= table.evaluate(high) + 1e-15);
    }

    #[test]
    fn functions_on_meshes_of_the_plane(
        shear in prop::array::uniform2(-0.6..0.6f64), at in prop::array::uniform2(-0.5..1.5f64), n in 1..6u32,
    ) {
        let (vertices, triangles) = plane(n, shear);
        let f = |p: Point2D| 3.0 * p.x - 2.0 * p.y + 0.5;
        let heights: Vec<f64> = vertices.iter().map(|&p| f(p)).collect();
        let numbers: Vec<f64> = (0..triangles.len()).map(|i| i as f64).collect();
        let place = Point2D::new(at[0] + shear[0] * at[1], shear[1] * at[0] + at[1]);
        let inside = at.iter().all(|x| (0.0..=1.0).contains(x));
        let border = at.iter().any(|x| x.abs() < 1e-12 || (x - 1.0).abs() < 1e-12);
        prop_assume!(!border);
        let linear = Interpolator2DMesh::new(vertices.clone(), triangles.clone(), heights.clone()).unwrap();
        let constant = Discrete2DMesh::new(vertices.clone(), triangles.clone(), numbers).unwrap();
        let place = (place.x, place.y);
        prop_assert_eq!(linear.checked(place).is_ok(), inside);
        prop_assert_eq!(constant.evaluate(place).is_nan(), !inside);
        prop_assert_eq!(linear.clone().with_default(9.0).evaluate(place) == 9.0, !inside);
        if inside {
            prop_assert!((linear.evaluate(place) - f(Point2D::new(place.0, place.1))).abs() < 1e-13);
            let corners = triangles[constant.evaluate(place) as usize].map(|v| vertices[v as usize]);
            let shares = raysect_math::triangle_shares(corners, Point2D::new(place.0, place.1)).unwrap();
            prop_assert!(shares.iter().all(|&share| share > -1e-12));
            let twice = linear.instance(heights.iter().map(|h| 2.0 * h).collect::<Vec<_>>()).unwrap();
            prop_assert!((twice.evaluate(place) - 2.0 * linear.evaluate(place)).abs() < 1e-13);
        }
    }

    #[test]
    fn functions_on_tetrahedra(angles in prop::array::uniform3(-180.0..180.0f64), at in prop::array::uniform3(-1.0..2.0f64)) {
        // The cube of unit edge, cut into six tetrahedra around a diagonal, turned.
        let turn = rotate(angles[0], angles[1], angles[2]);
        let corner = |i: u32| Point3D::new(f64::from(i & 1), f64::from(i >> 1 & 1), f64::from(i >> 2));
        let vertices: Vec<Point3D> = (0..8).map(|i| turn * corner(i)).collect();
        let ways = [[1, 3], [1, 5], [2, 3], [2, 6], [4, 5], [4, 6]];
        let tetrahedra: Vec<[u32; 4]> = ways.iter().map(|&[a, b]| [0, a, b, 7]).collect();
        let f = Discrete3DMesh::new(vertices.clone(), tetrahedra.clone(), (0..6).map(f64::from).collect::<Vec<_>>());
        let f = f.unwrap();
        let place = turn * Point3D::from(at);
        prop_assume!(at.iter().all(|x| x.abs() > 1e-12 && (x - 1.0).abs() > 1e-12));
        let inside = at.iter().all(|x| (0.0..=1.0).contains(x));
        let place_of = (place.x, place.y, place.z);
        prop_assert_eq!(f.checked(place_of).is_ok(), inside);
        prop_assert_eq!(f.clone().with_default(-1.0).evaluate(place_of) == -1.0, !inside);
        if inside {
            let corners = tetrahedra[f.evaluate(place_of) as usize].map(|v| vertices[v as usize]);
            let shares = raysect_math::tetrahedron_shares(corners, place).unwrap();
            prop_assert!(shares.iter().all(|&share| share > -1e-12));
            prop_assert_eq!(f.instance(vec![4.0; 6]).unwrap().evaluate(place_of), 4.0);
        }
    }

    #[test]
    fn polygons_turned_round_and_moved_are_the_same(
        radii in prop::collection::vec(0.2..1.0f64, 3..20), shift in prop::array::uniform2(-5.0..5.0f64),
        at in prop::array::uniform2(-1.0..1.0f64),
    ) {
        let outline = star(&radii);
        let polygon = Polygon2D::new(outline.clone()).unwrap();
        let back = Polygon2D::new(outline.iter().rev().copied().collect::<Vec<_>>()).unwrap();
        prop_assert!(!polygon.is_clockwise() && back.is_clockwise());
        prop_assert!((polygon.signed_area() + back.signed_area()).abs() < 1e-14 && polygon.signed_area() > 0.0);
        let p = Point2D::from(at);
        prop_assert_eq!(polygon.contains(p), back.contains(p));
        let triangles = polygon.triangulate().unwrap();
        prop_assert_eq!((triangles.len(), polygon.vertices().len()), (radii.len() - 2, radii.len()));
        let holds = |t: &[u32; 3]| {
            let corners = t.map(|v| outline[v as usize]);
            raysect_math::triangle_shares(corners, p).is_ok_and(|shares| shares.iter().all(|&s| s >= 0.0))
        };
        prop_assert_eq!(triangles.iter().any(holds), polygon.contains(p));
        let moved: Vec<Point2D> = outline.iter().map(|q| Point2D::new(q.x + shift[0], q.y + shift[1])).collect();
        prop_assert!((Polygon2D::new(moved).unwrap().signed_area() - polygon.signed_area()).abs() < 1e-13);
    }
}
