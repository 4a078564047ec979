//! Emission along rays through densities that know their structure, against sums over their pieces.

use raysect_math::function::{
    Function, Interpolation, Interpolation1D, Interpolator1DArray, Interpolator2DArray, Interpolator3DArray,
    Shells, Structured3D, axisymmetric, coaxial, spherical,
};
use raysect_math::{Discrete2DMesh, Discrete3DMesh, Point2D, Point3D, Rng, Vector3D};
use raysect_optical::{Material, ProfileVolume, Ray, UniformVolume, WithMaterial, World};
use raysect_primitive::Cuboid;

/// Half the width of the box that the density fills [m].
const HALF: f64 = 1.2;

fn world(material: impl Material + 'static) -> World {
    let mut world = World::new();
    world.add(Cuboid::centred(2.0 * HALF, 2.0 * HALF, 2.0 * HALF).unwrap().material(material)).unwrap();
    world
}

/// The integral of a density through the box, piece by piece: Simpson's rule is exact for the cubics between breaks.
fn expected(density: &dyn Structured3D, origin: Point3D, direction: Vector3D) -> f64 {
    let (mut near, mut far) = (f64::NEG_INFINITY, f64::INFINITY);
    for (o, d) in origin.to_array().into_iter().zip(direction.to_array()) {
        let ends = [(-HALF - o) / d, (HALF - o) / d];
        near = near.max(ends[0].min(ends[1]));
        far = far.min(ends[0].max(ends[1]));
    }
    if near >= far {
        return 0.0;
    }
    let mut breaks = vec![near, far];
    density.add_breaks(origin, direction, &mut breaks);
    breaks.retain(|t| (near..=far).contains(t));
    breaks.sort_by(f64::total_cmp);
    let value = |t: f64| {
        let p = origin + direction * t;
        let value = density.evaluate((p.x, p.y, p.z));
        if value.is_nan() { 0.0 } else { value }
    };
    let piece = |w: &[f64]| {
        let at = |share: f64| value(w[0] + share * (w[1] - w[0]));
        // A hair inside, on the near side of the breaks, and by more than their rounding.
        (w[1] - w[0]) * (at(1e-7) + 4.0 * at(0.5) + at(1.0 - 1e-7)) / 6.0
    };
    breaks.windows(2).map(piece).sum()
}

/// The largest relative difference from what is expected, of random rays.
fn worst(density: &dyn Structured3D, world: &World, seed: u64) -> f64 {
    let mut rng = Rng::new(seed);
    let (mut worst, mut met) = (0.0f64, 0);
    for _ in 0..200 {
        let mut place =
            |far: f64| Vector3D::new(rng.range(-far, far), rng.range(-far, far), rng.range(-far, far));
        let (away, at) = (place(1.0).normalise().unwrap() * 5.0, place(0.8));
        let origin = Point3D::ORIGIN + away;
        let direction = (at - away).normalise().unwrap();
        let should = expected(density, origin, direction);
        let found = Ray::new(origin, direction).spectrum(500.0, 501.0, 1).trace(world).unwrap().samples()[0];
        if should > 1e-3 {
            worst = worst.max((found / should - 1.0).abs());
            met += 1;
        }
    }
    assert!(met > 100, "{met}");
    worst
}

/// Asserts that what a density says of itself makes integrals right to the tolerance of paths, and that without it they
/// are wrong.
fn assert_integrals(density: impl Structured3D + Clone + 'static, seed: u64) {
    let lamp = || UniformVolume::new().emission(1.0);
    let told = world(ProfileVolume::structured(lamp(), density.clone(), 1.0).unwrap());
    let error = worst(&density, &told, seed);
    assert!(error < 1e-6, "{error}");
    let secret = density.clone();
    let value = move |p: Point3D| {
        let value = secret.evaluate((p.x, p.y, p.z));
        if value.is_nan() { 0.0 } else { value }
    };
    let untold = world(ProfileVolume::new(lamp(), value, 1.0, 10.0).unwrap());
    let error = worst(&density, &untold, seed);
    assert!(error > 1e-4, "{error}");
}

fn knots(from: f64, count: usize, rng: &mut Rng) -> Vec<f64> {
    (0..count).map(|i| from + 0.2 * i as f64 + rng.range(0.0, 0.1)).collect()
}

#[test]
fn grids_in_space_are_integrated_exactly() {
    let mut rng = Rng::new(1);
    let axes = [0; 3].map(|_| knots(-1.0, 10, &mut rng));
    let values: Vec<f64> = (0..1000).map(|_| rng.uniform()).collect();
    let [x, y, z] = &axes;
    assert_integrals(Interpolator3DArray::new(x, y, z, &values, Interpolation::Linear).unwrap(), 2);
}

#[test]
fn meshes_of_tetrahedra_are_integrated_exactly() {
    let mut rng = Rng::new(3);
    // Tetrahedra apart from each other, with gaps.
    let (mut vertices, mut tetrahedra) = (Vec::new(), Vec::new());
    for i in 0..1000u32 {
        let centre = [i % 10, i / 10 % 10, i / 100].map(|k| 0.2 * f64::from(k) - 0.9);
        let mut corner = || Point3D::from(centre.map(|c| c + rng.range(-0.1, 0.1)));
        vertices.extend([corner(), corner(), corner(), corner()]);
        tetrahedra.push([4 * i, 4 * i + 1, 4 * i + 2, 4 * i + 3]);
    }
    let values: Vec<f64> = (0..1000).map(|_| rng.uniform()).collect();
    let mesh = Discrete3DMesh::new(vertices, tetrahedra, values).unwrap();
    assert_integrals(std::sync::Arc::new(mesh), 4);
}

#[test]
fn what_is_turned_around_an_axis_is_integrated_exactly() {
    let mut rng = Rng::new(5);
    let (mut vertices, mut triangles) = (Vec::new(), Vec::new());
    for i in 0..50u32 {
        let centre = [0.2 + 0.2 * f64::from(i % 5), 0.2 * f64::from(i / 5) - 0.9];
        let mut corner = || Point2D::new(centre[0] + rng.range(-0.1, 0.1), centre[1] + rng.range(-0.1, 0.1));
        vertices.extend([corner(), corner(), corner()]);
        triangles.push([3 * i, 3 * i + 1, 3 * i + 2]);
    }
    let values: Vec<f64> = (0..50).map(|_| rng.uniform()).collect();
    assert_integrals(axisymmetric(Discrete2DMesh::new(vertices, triangles, values).unwrap()), 6);
}

#[test]
fn shells_about_a_point_and_an_axis_are_integrated_exactly() {
    let mut rng = Rng::new(9);
    let (centre, axis) = (Point3D::new(0.1, -0.2, 0.05), Vector3D::new(0.3, 1.0, -0.2));
    let edges = knots(0.05, 5, &mut rng);
    let values: Vec<f64> = (0..4).map(|_| rng.uniform()).collect();
    let shells = Shells::new(&edges, &values).unwrap();
    assert_integrals(spherical(shells.clone(), centre), 10);
    assert_integrals(coaxial(shells, centre, axis).unwrap(), 11);
}

#[test]
fn radial_tables_are_integrated_to_the_tolerance() {
    let mut rng = Rng::new(12);
    let (centre, axis) = (Point3D::new(0.1, -0.2, 0.05), Vector3D::new(0.3, 1.0, -0.2));
    let r = knots(0.05, 6, &mut rng);
    let values: Vec<f64> = r.iter().map(|_| rng.uniform()).collect();
    for interpolation in [Interpolation1D::Linear, Interpolation1D::Monotone] {
        let table = Interpolator1DArray::new(&r, &values, interpolation).unwrap();
        let lamp = || UniformVolume::new().emission(1.0);
        let ball = spherical(table.clone(), centre);
        let error =
            worst(&Finer(ball.clone()), &world(ProfileVolume::structured(lamp(), ball, 1.0).unwrap()), 13);
        assert!(error < 1e-6, "{interpolation:?}: {error}");
        let tube = coaxial(table, centre, axis).unwrap();
        let error =
            worst(&Finer(tube.clone()), &world(ProfileVolume::structured(lamp(), tube, 1.0).unwrap()), 14);
        assert!(error < 1e-6, "{interpolation:?}: {error}");
    }
}

#[test]
fn tables_in_the_half_plane_are_integrated_to_the_tolerance() {
    // Not a polynomial along a ray: against Simpson's rule with a thousand steps a piece.
    let mut rng = Rng::new(7);
    let (r, z) = (knots(0.05, 5, &mut rng), knots(-0.9, 9, &mut rng));
    let values: Vec<f64> = (0..45).map(|_| rng.uniform()).collect();
    let density = axisymmetric(Interpolator2DArray::new(&r, &z, &values, Interpolation::Cubic).unwrap());
    let told =
        world(ProfileVolume::structured(UniformVolume::new().emission(1.0), density.clone(), 1.5).unwrap());
    let fine = Finer(density);
    let error = worst(&fine, &told, 8);
    assert!(error < 1e-6, "{error}");
}

/// With a thousand breaks more between any two.
struct Finer<T>(T);

impl<T: Structured3D> Function<(f64, f64, f64)> for Finer<T> {
    type Value = f64;
    fn evaluate(&self, at: (f64, f64, f64)) -> f64 {
        self.0.evaluate(at)
    }
}

impl<T: Structured3D> Structured3D for Finer<T> {
    fn length_scale(&self) -> f64 {
        self.0.length_scale()
    }
    fn add_breaks(&self, origin: Point3D, direction: Vector3D, out: &mut Vec<f64>) {
        let mut breaks = Vec::new();
        self.0.add_breaks(origin, direction, &mut breaks);
        breaks.sort_by(f64::total_cmp);
        for w in breaks.windows(2) {
            out.extend((0..1000).map(|i| w[0] + (w[1] - w[0]) * f64::from(i) / 1000.0));
        }
        out.extend(breaks);
    }
}
