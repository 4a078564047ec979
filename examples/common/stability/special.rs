//! Rays that hit exactly: tangents, apices, rims, edges, axes and generators, signed zeros and denormal numbers.

use raysect::core::{Crossing, Interval, Ray, Scratch};
use raysect::math::{Point3D, Rng, SphereSampler, Vector3D};

use super::bodies::Shape;
use super::exact::Plain;
use super::wrong::{Fault, Wrong};
use super::{Cell, Tally};

/// Relative error of a distance.
const LIMIT: f64 = 1e-12;
/// The smallest tilt: a denormal number.
const TINY: f64 = 1e-310;

const BALL: Plain = Plain::Sphere(1.0);
const BOX: Plain = Plain::Cuboid([-1.0; 3], [1.0; 3]);
const ROD: Plain = Plain::Cylinder(1.0, 2.0);
const SPIKE: Plain = Plain::Cone(1.0, 2.0);
const DISH: Plain = Plain::Parabola(1.0, 1.0);
const RING: Plain = Plain::Torus(2.0, 0.5);

/// A line and where it crosses: distances, and normals where they are defined by more than a rule.
struct Row {
    what: &'static str,
    solid: Plain,
    origin: [f64; 3],
    direction: [f64; 3],
    at: Vec<f64>,
    /// A touch, or a line within the surface: nothing will do as well.
    optional: bool,
    normals: Vec<[f64; 3]>,
}

fn row(what: &'static str, solid: Plain, origin: [f64; 3], direction: [f64; 3], at: &[f64]) -> Row {
    Row { what, solid, origin, direction, at: at.to_vec(), optional: false, normals: Vec::new() }
}

impl Row {
    fn normals(self, normals: &[[f64; 3]]) -> Self {
        Self { normals: normals.to_vec(), ..self }
    }

    fn or_none(self) -> Self {
        Self { optional: true, ..self }
    }
}

fn rows() -> Vec<Row> {
    let root = 0.5f64.sqrt();
    let (up, down) = ([0.0, 0.0, 1.0], [0.0, 0.0, -1.0]);
    let mut rows = vec![
        row("tangent, from the point of touch", BALL, [1.0, 0.0, 0.0], up, &[0.0]).or_none(),
        row("tangent, from afar", BALL, [1.0, 0.0, -4.0], up, &[4.0]).or_none(),
        row("from the middle", BALL, [0.0; 3], up, &[-1.0, 1.0]).normals(&[down, up]),
        row("long direction", BALL, [0.0, 0.0, -3.0], [0.0, 0.0, 1e3], &[2e-3, 4e-3]),
        row("denormal tilt", BALL, [0.0, 0.0, -3.0], [TINY, -TINY, 1.0], &[2.0, 4.0]).normals(&[down, up]),
        row("through the middle", BOX, [0.0, 0.0, -5.0], up, &[4.0, 6.0]).normals(&[down, up]),
        row("in a face", BOX, [1.0, 0.0, -5.0], up, &[4.0, 6.0]),
        row("in the opposite face", BOX, [-1.0, 0.0, -5.0], up, &[4.0, 6.0]),
        row("along an edge", BOX, [1.0, 1.0, -5.0], up, &[4.0, 6.0]),
        row("along an edge, backwards", BOX, [-1.0, 1.0, 5.0], down, &[4.0, 6.0]),
        row("beside a face", BOX, [1.0f64.next_up(), 0.0, -5.0], up, &[]),
        row("negative zeros", BOX, [-0.0, -0.0, -5.0], [-0.0, -0.0, 1.0], &[4.0, 6.0]),
        row("negative zeros in a face", BOX, [1.0, -0.0, -5.0], [-0.0, 0.0, 1.0], &[4.0, 6.0]),
        row("denormal tilt in a face", BOX, [1.0, 0.0, -5.0], [-TINY, 0.0, 1.0], &[4.0, 6.0]),
        row("through a corner, diagonally", BOX, [-3.0; 3], [1.0; 3], &[2.0, 4.0]),
        row("through two faces", BOX, [-1.0, 0.0, 2.0], [1.0, 0.0, -1.0], &[1.0, 2.0]),
        row("begins on a face", BOX, [0.0, 0.0, -1.0], up, &[0.0, 2.0]),
        row("along the axis", ROD, [0.0, 0.0, -1.0], up, &[1.0, 3.0]).normals(&[down, up]),
        row("along the axis, backwards", ROD, [0.0, 0.0, 4.0], down, &[2.0, 4.0]).normals(&[up, down]),
        row("denormal tilt to the axis", ROD, [0.0, 0.0, -1.0], [TINY, TINY, 1.0], &[1.0, 3.0]),
        row("tilt of 1e-170", ROD, [0.0, 0.0, -1.0], [1e-170, 0.0, 1.0], &[1.0, 3.0]),
        row("parallel to the axis", ROD, [0.6, 0.8 - 1e-9, -1.0], up, &[1.0, 3.0]),
        row("along a generator", ROD, [1.0, 0.0, -1.0], up, &[1.0, 3.0]).or_none(),
        row("beside a generator", ROD, [1.0f64.next_up(), 0.0, -1.0], up, &[]),
        row("across", ROD, [-3.0, 0.0, 1.0], [1.0, 0.0, 0.0], &[2.0, 4.0])
            .normals(&[[-1.0, 0.0, 0.0], [1.0, 0.0, 0.0]]),
        row("in the base", ROD, [-3.0, 0.0, 0.0], [1.0, 0.0, 0.0], &[2.0, 4.0]).or_none(),
        row("through both rims", ROD, [-2.0, 0.0, -1.0], [1.0, 0.0, 1.0], &[1.0, 3.0]),
        row("tangent to the side", ROD, [-3.0, 1.0, 1.0], [1.0, 0.0, 0.0], &[3.0]).or_none(),
        row("down the axis through the apex", SPIKE, [0.0, 0.0, 5.0], down, &[3.0, 5.0]),
        row("up the axis through the apex", SPIKE, [0.0, 0.0, -1.0], up, &[1.0, 3.0]),
        row("across the apex", SPIKE, [-3.0, 0.0, 2.0], [1.0, 0.0, 0.0], &[3.0]).or_none(),
        row("in the plane x = 0", SPIKE, [0.0, -3.0, 1.0], [0.0, 1.0, 0.0], &[2.5, 3.5]).normals(&[
            [0.0, -2.0 / 5f64.sqrt(), 1.0 / 5f64.sqrt()],
            [0.0, 2.0 / 5f64.sqrt(), 1.0 / 5f64.sqrt()],
        ]),
        row("along a generator", SPIKE, [2.0, 0.0, -2.0], [-1.0, 0.0, 2.0], &[1.0, 2.0]).or_none(),
        row("parallel to a generator", SPIKE, [0.5, 0.0, -1.0], [-1.0, 0.0, 2.0], &[0.5, 1.0]),
        row("denormal tilt to the axis", SPIKE, [0.0, 0.0, 5.0], [TINY, 0.0, -1.0], &[3.0, 5.0]),
        row("in the base", SPIKE, [-3.0, 0.0, 0.0], [1.0, 0.0, 0.0], &[2.0, 4.0]).or_none(),
        row("parallel to the axis", SPIKE, [0.5, 0.0, -1.0], up, &[1.0, 2.0]),
        row("along the axis", DISH, [0.0, 0.0, -1.0], up, &[1.0, 2.0]).normals(&[down, up]),
        row("parallel to the axis", DISH, [0.5, 0.0, 3.0], down, &[2.25, 3.0])
            .normals(&[[root, 0.0, root], down]),
        row("denormal tilt to the axis", DISH, [0.5, 0.0, 3.0], [TINY, 0.0, -1.0], &[2.25, 3.0]),
        row("tangent to the vertex", DISH, [-3.0, 0.0, 1.0], [1.0, 0.0, 0.0], &[3.0]).or_none(),
        row("in the base", DISH, [-3.0, 0.0, 0.0], [1.0, 0.0, 0.0], &[2.0, 4.0]).or_none(),
        row("in the plane of the ring", RING, [-4.0, 0.0, 0.0], [1.0, 0.0, 0.0], &[1.5, 2.5, 5.5, 6.5]),
        row("on the top of the ring", RING, [-4.0, 0.0, 0.5], [1.0, 0.0, 0.0], &[2.0, 6.0]).or_none(),
        row("along the axis", RING, [0.0, 0.0, -4.0], up, &[]),
        row("parallel to the axis", RING, [2.0, 0.0, -4.0], up, &[3.5, 4.5]).normals(&[down, up]),
        row("denormal tilt", RING, [2.0, 0.0, -4.0], [TINY, -TINY, 1.0], &[3.5, 4.5]),
        row("touches the inner equator", RING, [1.5, 0.0, -4.0], up, &[4.0]).or_none(),
        row("touches the outer equator", RING, [2.5, 0.0, -4.0], up, &[4.0]).or_none(),
    ];
    // The far root is the one that a small leading coefficient spoils.
    for tilt in [1e-3, 1e-6, 1e-9, 1e-12, 1e-15] {
        rows.push(row("nearly parallel to the axis", ROD, [0.0, 0.0, -1.0], [tilt, 0.0, 1.0], &[1.0, 3.0]));
        rows.push(row("nearly along the axis", SPIKE, [0.0, 0.0, 5.0], [0.0, tilt, -1.0], &[]).exact());
        rows.push(row("nearly parallel to the axis", DISH, [0.5, 0.0, 3.0], [tilt, 0.0, -1.0], &[]).exact());
        rows.push(row("nearly parallel", SPIKE, [0.5, 0.0, -1.0], [-1.0 + tilt, 0.0, 2.0], &[]).exact());
        rows.push(row("nearly in a face", BOX, [1.0, 0.0, -5.0], [-tilt, 0.0, 1.0], &[]).exact());
        rows.push(row("nearly in the plane", RING, [-4.0, 0.1, 0.0], [1.0, 0.0, tilt], &[]).exact());
    }
    rows
}

impl Row {
    /// With distances in 32 digits.
    fn exact(mut self) -> Self {
        let ray = Ray::new(self.origin.into(), self.direction.into());
        self.at = self.solid.crossings(&ray).into_iter().map(|t| t.value()).collect();
        self
    }
}

pub(crate) fn cells() -> Vec<Cell> {
    let mut cells = vec![table("table".to_owned(), |s| s.shape())];
    for (name, solid) in
        [("sphere", BALL), ("cuboid", BOX), ("cylinder", ROD), ("cone", SPIKE), ("parabola", DISH)]
    {
        cells.push(near_tangent(name, solid, solid.shape()));
    }
    for (name, solid) in Plain::all(1.0) {
        let share = if name == "torus" { 0.1 } else { 1.0 };
        cells.push(plane_of_symmetry(name, solid, solid.shape()).share(share));
    }
    cells
}

pub(crate) fn controls() -> Vec<Cell> {
    let wrong = |fault: Fault| move |s: Plain| -> Shape { std::sync::Arc::new(Wrong(s.shape(), fault)) };
    let larger: Shape = Plain::Sphere(1.0 + 1e-12).shape();
    let tilted: Shape = std::sync::Arc::new(Wrong(SPIKE.shape(), Fault::Tilts(f64::NAN)));
    vec![
        table("distances off by 1e-11".to_owned(), wrong(Fault::Stretches(1e-11))),
        table("normals off by 1e-9".to_owned(), wrong(Fault::Tilts(1e-9))),
        near_tangent("sphere larger by 1e-12", BALL, larger),
        plane_of_symmetry("normals that are NaN", SPIKE, tilted),
    ]
}

/// Every row of the table, in both senses of the line and under permutation of signs.
fn table(name: String, make: impl Fn(Plain) -> Shape + Send + Sync + 'static) -> Cell {
    Cell::new(format!("{name} [relative]"), LIMIT, move |_, tally| {
        for row in rows() {
            let shape = make(row.solid);
            for sign in [1.0, -1.0] {
                for speed in [1.0, 1e-6, 1e6] {
                    let d = row.direction.map(|x| x * sign * speed);
                    // A tilt that vanishes by the change of length would be another line.
                    if speed < 1.0 && row.direction.iter().any(|x| *x != 0.0 && x.abs() < 1e-300) {
                        continue;
                    }
                    judge(&row, &shape, &Ray::new(row.origin.into(), d.into()), sign * speed, tally);
                }
            }
        }
    })
}

fn judge(row: &Row, shape: &Shape, ray: &Ray, speed: f64, tally: &mut Tally) {
    tally.ray();
    let (mut found, mut scratch) = (Vec::new(), Scratch::default());
    shape.crossings(ray, &mut scratch, &mut found);
    let what = || format!("{} of {:?}: {found:?} of {ray:?}, not {:?}", row.what, row.solid, row.at);
    let is_finite = |c: &Crossing| {
        let s = shape.surface(ray, c);
        c.distance.is_finite() && s.point.is_finite() && (s.normal.length() - 1.0).abs() < 1e-14
    };
    tally.check(found.iter().all(is_finite), what);
    tally.check(found.len().is_multiple_of(2), what);
    let first = shape.hit(ray, Interval::new(f64::NEG_INFINITY, f64::INFINITY), &mut scratch);
    tally.check(first.map(|c| c.distance) == found.first().map(|c| c.distance), what);
    let mut along: Vec<(f64, Vector3D)> =
        found.iter().map(|c| (c.distance * speed, shape.surface(ray, c).normal.as_vector())).collect();
    along.sort_by(|a, b| a.0.total_cmp(&b.0));
    if row.optional {
        // As exact as a place along a tangent can be.
        let somewhere = |t: f64| row.at.iter().any(|at| (t - at).abs() < 4.0 * f64::EPSILON.sqrt());
        tally.check(along.iter().all(|(t, _)| somewhere(*t)), what);
        return;
    }
    tally.check(along.len() == row.at.len(), what);
    for (i, (t, at)) in along.iter().zip(&row.at).enumerate() {
        tally.error((t.0 - at).abs() / at.abs().max(1.0), what);
        if let Some(n) = row.normals.get(i) {
            tally.error((t.1 - Vector3D::from(*n)).length(), what);
        }
    }
}

/// Lines that pass at 1 ± e radii: no wrong hit or miss beyond rounding, and places as exact as can be.
fn near_tangent(name: &str, solid: Plain, shape: Shape) -> Cell {
    Cell::new(format!("{name}, near tangents [4 √ε; 16 ε across]"), 1.0, move |rays, tally| {
        let (mut rng, mut scratch, mut found) = (Rng::new(41), Scratch::default(), Vec::new());
        for _ in 0..rays {
            // A tangent at some point of the surface, moved out or in by e.
            let inner = solid.aimed(3.0, &mut rng);
            let Some(t) = solid.crossings(&inner).first().copied() else { continue };
            let (normal, v) = (solid.normal(&(&inner).into(), t), SphereSampler.sample(&mut rng));
            let Ok(along) = (v - normal * v.dot(normal)).normalise() else { continue };
            let e = 10f64.powf(rng.range(-15.0, -4.0)) * if rng.uniform() < 0.5 { -1.0 } else { 1.0 };
            let at = inner.point_at(t.value()) + normal * (e * solid.size());
            let ray = Ray::new(at - along * (2.0 * solid.size()), along);
            found.clear();
            shape.crossings(&ray, &mut scratch, &mut found);
            tally.ray();
            let exact = solid.crossings(&ray);
            if exact.len() != found.len() {
                let clear = !solid.is_near_limb(&ray, 16.0 * f64::EPSILON * solid.size());
                tally.check(!clear, || format!("{} crossings, not {}: {ray:?}", found.len(), exact.len()));
                continue;
            }
            for (c, t) in found.iter().zip(exact) {
                let off = (c.distance - t.value()).abs() / solid.size();
                let cosine = solid.normal(&(&ray).into(), t).dot(ray.direction).abs();
                // Where the surface is straight along the line, only the distance across it is well defined.
                let error = match solid {
                    Plain::Sphere(_) => off / (4.0 * f64::EPSILON.sqrt()),
                    _ => off * cosine / (16.0 * f64::EPSILON),
                };
                tally.error(error, || format!("{c:?}, not {t:?}: {ray:?}"));
                let normal = shape.surface(&ray, c).normal;
                tally.check(normal.is_finite(), || format!("{normal:?}: {ray:?}"));
            }
        }
    })
}

/// Lines in the planes x = 0, y = 0 and z = const.: no division by a coordinate.
fn plane_of_symmetry(name: &str, solid: Plain, shape: Shape) -> Cell {
    Cell::new(format!("{name}, lines in planes of symmetry"), 0.0, move |rays, tally| {
        let (mut rng, mut scratch, mut found) = (Rng::new(42), Scratch::default(), Vec::new());
        for i in 0..rays {
            let mut ray = solid.aimed(3.0, &mut rng);
            let (mut o, mut d) = (ray.origin.to_array(), ray.direction.to_array());
            let axis = (i % 3) as usize;
            o[axis] = solid.centre()[axis];
            d[axis] = if i % 2 == 0 { 0.0 } else { -0.0 };
            ray = Ray::new(Point3D::from(o), Vector3D::from(d));
            found.clear();
            shape.crossings(&ray, &mut scratch, &mut found);
            tally.ray();
            let exact = solid.crossings(&ray);
            let right =
                exact.len() == found.len() || solid.is_near_limb(&ray, 16.0 * f64::EPSILON * solid.size());
            tally.check(right, || format!("{} crossings, not {}: {ray:?}", found.len(), exact.len()));
            for c in &found {
                let s = shape.surface(&ray, c);
                let finite = c.distance.is_finite() && s.point.is_finite();
                let upright = (s.normal.length() - 1.0).abs() < 1e-14;
                tally.check(finite && upright, || format!("{s:?}: {ray:?}"));
            }
        }
    })
}
