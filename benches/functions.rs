//! Look-ups in tables and meshes, at places in no order.

use criterion::{Criterion, criterion_group, criterion_main};
use raysect::math::function::{
    Arg, Function, Interpolation, Interpolation1D, Interpolator1DArray, Interpolator2DArray,
    Interpolator3DArray, sample1d, sample2d, sample3d,
};
use raysect::math::{Discrete2DMesh, Discrete3DMesh, Interpolator2DMesh, MathError, Point2D, Point3D, Rng};
use std::hint::black_box;

/// So many places, over and over: they and what they touch stay in the cache.
const PLACES: usize = 1000;

/// Knots along each axis of a table.
const KNOTS: usize = 32;

/// The next place at each call.
fn draw<P: Copy>(mut place: impl FnMut(&mut Rng) -> P) -> impl FnMut() -> P {
    let mut rng = Rng::new(1);
    let places: Vec<P> = (0..PLACES).map(|_| place(&mut rng)).collect();
    let mut next = 0;
    move || {
        next = (next + 1) % PLACES;
        places[next]
    }
}

fn one(rng: &mut Rng) -> f64 {
    rng.uniform()
}

fn two(rng: &mut Rng) -> (f64, f64) {
    (rng.uniform(), rng.uniform())
}

fn three(rng: &mut Rng) -> (f64, f64, f64) {
    (rng.uniform(), rng.uniform(), rng.uniform())
}

fn bench<P: Copy, V>(c: &mut Criterion, name: &str, mut places: impl FnMut() -> P, f: impl Fn(P) -> V) {
    c.bench_function(name, |b| b.iter(|| f(black_box(places()))));
}

fn tables(c: &mut Criterion) -> Result<(), MathError> {
    let axis = (0.0, 1.0, KNOTS);
    let wave = (7.0 * Arg::X).sin();
    let (x, f) = sample1d(&wave, axis)?;
    // Ever wider steps: the cell cannot be computed.
    let uneven: Vec<f64> = x.iter().map(|x| x * x).collect();
    for (name, kind) in [("linear", Interpolation1D::Linear), ("cubic", Interpolation1D::Cubic)] {
        let table = Interpolator1DArray::new(&x, &f, kind)?;
        bench(c, &format!("{name} table of one variable"), draw(one), |at| table.evaluate(at));
    }
    let plane = wave * (5.0 * Arg::Y).cos();
    let ([x, y], f) = sample2d(&plane, axis, axis)?;
    let space = plane + Arg::Z;
    let (_, g) = sample3d(&space, axis, axis, axis)?;
    for (name, kind) in [("linear", Interpolation::Linear), ("cubic", Interpolation::Cubic)] {
        let table = Interpolator2DArray::new(&x, &y, &f, kind)?;
        bench(c, &format!("{name} table of two variables"), draw(two), |at| table.evaluate(at));
        let table = Interpolator3DArray::new(&x, &x, &x, &g, kind)?;
        bench(c, &format!("{name} table of three variables"), draw(three), |at| table.evaluate(at));
        let table = Interpolator3DArray::new(&uneven, &uneven, &uneven, &g, kind)?;
        bench(c, &format!("{name} table of three variables, uneven"), draw(three), |at| table.evaluate(at));
    }
    Ok(())
}

/// Two triangles for each of n × n squares.
fn triangles(n: u32) -> (Vec<Point2D>, Vec<[u32; 3]>) {
    let place = |i: u32| f64::from(i) / f64::from(n);
    let vertices = (0..=n).flat_map(|i| (0..=n).map(move |j| Point2D::new(place(i), place(j)))).collect();
    let square = move |i: u32, j: u32| {
        let [a, b, c, d] = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)].map(|(i, j)| i * (n + 1) + j);
        [[a, b, c], [a, c, d]]
    };
    (vertices, (0..n).flat_map(|i| (0..n).flat_map(move |j| square(i, j))).collect())
}

/// Five tetrahedra for each of n × n × n cubes, corners of neighbours their own.
fn tetrahedra(n: u32) -> (Vec<Point3D>, Vec<[u32; 4]>) {
    let (mut vertices, mut corners) = (Vec::new(), Vec::new());
    let place = |i: u32| f64::from(i) / f64::from(n);
    for cube in 0..n * n * n {
        let (i, j, k) = (cube / (n * n), cube / n % n, cube % n);
        let first = vertices.len() as u32;
        vertices.extend(
            (0..8).map(|c| Point3D::new(place(i + (c >> 2)), place(j + (c >> 1 & 1)), place(k + (c & 1)))),
        );
        let parts = [[0, 1, 2, 4], [3, 1, 2, 7], [5, 1, 4, 7], [6, 2, 4, 7], [1, 2, 4, 7]];
        corners.extend(parts.map(|part| part.map(|c| first + c)));
    }
    (vertices, corners)
}

fn meshes(c: &mut Criterion) -> Result<(), MathError> {
    let (vertices, corners) = triangles(708);
    c.bench_function("mesh of 1 002 528 triangles made", |b| {
        b.iter(|| Discrete2DMesh::new(&*vertices, &*corners, vec![0.0; corners.len()]))
    });
    let (vertices, corners) = triangles(224);
    let values: Vec<f64> = (0..corners.len()).map(|i| i as f64).collect();
    let constant = Discrete2DMesh::new(vertices.clone(), corners.clone(), values)?;
    let heights: Vec<f64> = vertices.iter().map(|p| p.x * p.y).collect();
    let linear = Interpolator2DMesh::new(vertices, corners, heights)?;
    bench(c, "constant on each of 100 352 triangles", draw(two), |at| constant.evaluate(at));
    bench(c, "linear on each of 100 352 triangles", draw(two), |at| linear.evaluate(at));
    let (vertices, corners) = tetrahedra(27);
    let values: Vec<f64> = (0..corners.len()).map(|i| i as f64).collect();
    let constant = Discrete3DMesh::new(vertices, corners, values)?;
    bench(c, "constant on each of 98 415 tetrahedra", draw(three), |at| constant.evaluate(at));
    Ok(())
}

fn all(c: &mut Criterion) {
    if let Err(error) = tables(c).and_then(|()| meshes(c)) {
        panic!("{error}");
    }
}

criterion_group!(name = benches; config = Criterion::default().sample_size(20); targets = all);
criterion_main!(benches);
