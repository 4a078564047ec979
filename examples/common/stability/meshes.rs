//! Meshes: rays through corners and edges, distances from afar, coordinates far from the origin, needles, flat scenes, open and
//! inverted surfaces, points below corners. What a mesh answers is compared with all its triangles one by one, in 32
//! digits.

use std::sync::Arc;

use raysect::core::{Interval, Leaving, Node, Primitive, Ray, Scratch, World};
use raysect::math::{AffineMatrix3D, Point3D, Rng, SphereSampler, Vector3D, rotate, translate};
use raysect::primitive::{Mesh, MeshData, MeshError};

use super::bodies::{Shape, bracket};
use super::double_double::{Dd, dd};
use super::wrong::{Fault, Wrong};
use super::{Cell, Tally};

pub(crate) fn cells() -> Vec<Cell> {
    let mut cells = corners();
    cells.extend(afar());
    cells.extend(needles());
    cells.extend(brute_force());
    cells.push(diagnoses(false));
    cells.extend([0, 1].map(|n| below(n, |m| Arc::new(m))));
    cells
}

pub(crate) fn controls() -> Vec<Cell> {
    let (ball, flat) = (MeshData::icosphere(4, 1.0).unwrap(), grid(1.0));
    let holed = {
        let all_but_one = ball.triangles()[1..].iter().copied();
        MeshData::new(ball.vertices().iter().copied(), all_but_one).unwrap()
    };
    let holed: Shape = Arc::new(Mesh::builder(holed).closed(true).build().unwrap());
    let wrong =
        |data: &MeshData, fault: Fault| -> Shape { Arc::new(Wrong(Mesh::new(data.clone()).unwrap(), fault)) };
    let small = MeshData::icosphere(2, 1.0).unwrap();
    vec![
        aimed("a triangle missing".to_owned(), &ball, holed, AffineMatrix3D::IDENTITY),
        distance("vertices in single precision".to_owned(), &ball, 10.0, 12.0, |m| single(m)).share(0.1),
        against_all(
            "distances off by 1e-13".to_owned(),
            small.clone(),
            wrong(&small, Fault::Stretches(1e-13)),
        )
        .share(0.1),
        against_all("one ray in 100 missed".to_owned(), flat.clone(), wrong(&flat, Fault::Misses(100)))
            .share(0.1),
        diagnoses(true),
        below(0, |m| Arc::new(Wrong(m, Fault::Denies))),
    ]
}

/// The icosphere of 5120 faces, turned, and far away.
fn corners() -> Vec<Cell> {
    let data = MeshData::icosphere(4, 1.0).unwrap();
    let turned = rotate(12.0, 34.0, 56.0);
    let far = translate(1e6, -0.5e6, 0.75e6);
    [
        ("", AffineMatrix3D::IDENTITY),
        (", turned", turned),
        (", 1000 km away", far),
        (", turned, 1000 km away", far * turned),
    ]
    .into_iter()
    .flat_map(|(name, m)| {
        let shape = || -> Shape { Arc::new(Mesh::new(data.clone()).unwrap()) };
        let in_place = aimed(format!("icosphere{name}: corners and edges"), &data, shape(), m);
        // The same with mapped vertices.
        let mapped = data.clone().transformed(&m).unwrap();
        let shape: Shape = Arc::new(Mesh::new(mapped.clone()).unwrap());
        let title = format!("icosphere{name}, vertices mapped: corners and edges");
        [in_place, aimed(title, &mapped, shape, AffineMatrix3D::IDENTITY)]
    })
    .collect()
}

/// Rays at corners, edges and the middles of edges, from outside and from inside: none passes through.
fn aimed(name: String, data: &MeshData, shape: Shape, m: AffineMatrix3D) -> Cell {
    let data = data.clone();
    Cell::new(name, 0.0, move |rays, tally| {
        let mut world = World::<()>::new();
        world.add(Node::of(shape.clone(), ()).transform(m)).unwrap();
        let scene = world.scene().unwrap();
        let centre = data.bounding_box().enclosing_sphere().centre;
        let (mut rng, mut scratch) = (Rng::new(71), Scratch::default());
        // Six targets a triangle: all of them at 3e4 rays, and then from other sides.
        let targets = 6 * data.triangle_count() as u64;
        for i in 0..rays {
            // A stride without a common factor visits every target.
            let target = (i * 7919) % targets;
            let [a, b, c] = data.corners((target / 6) as usize);
            let at = match target % 6 {
                0 => a,
                1 => b,
                2 => a + a.vector_to(b) * 0.5,
                3 => b + b.vector_to(c) * 0.5,
                4 => a + a.vector_to(c) * rng.uniform(),
                _ => b + b.vector_to(c) * rng.uniform(),
            };
            let inside = centre + SphereSampler.sample(&mut rng) * (0.3 * rng.uniform());
            let (near, far) = (m * inside, m * (at + inside.vector_to(at) * rng.range(0.1, 4.0)));
            tally.ray();
            let outward = Ray::new(near, near.vector_to(m * at).normalise_unchecked());
            let exits = scene.crossings(&outward, &mut scratch);
            tally.check(exits.len() == 1 && exits[0].crossing.exiting, || {
                format!("{} ways out: {outward:?}", exits.len())
            });
            let inward = Ray::new(far, far.vector_to(near).normalise_unchecked());
            let both = scene.crossings(&inward, &mut scratch);
            let kinds: Vec<bool> = both.iter().map(|c| c.crossing.exiting).collect();
            tally.check(kinds == [false, true], || format!("{both:?}: {inward:?}"));
            let first = scene.hit(&inward, None, &mut scratch);
            tally.check(first.is_some() && first == both.first().copied(), || {
                format!("{first:?}: {inward:?}")
            });
            // On from there, and back.
            let Some(entry) = first else { continue };
            let surface = scene.finish(&inward, &entry);
            let leaving = Leaving::new(&surface, inward.direction, inward.direction, None);
            let onward = Ray::new(surface.point, inward.direction);
            let exit = scene.hit(&onward, Some(&leaving), &mut scratch);
            tally.check(exit.is_some_and(|e| e.crossing.exiting), || format!("{exit:?}: {onward:?}"));
        }
    })
}

/// Distances from afar, and coordinates far from the origin of the mesh.
fn afar() -> Vec<Cell> {
    let data = MeshData::icosphere(4, 1.0).unwrap();
    let mut cells = Vec::new();
    for exponent in 0..=6 {
        let title = format!("icosphere from 1e{exponent} m [8 ε (distance + size)]");
        cells.push(distance(title, &data, 10f64.powi(exponent), 0.0, exact).share(0.3));
    }
    for offset in [1.2e1, 1.2e3, 1.2e4, 1.2e5, 1.2e6] {
        let title = format!("icosphere with vertices {offset:e} m off [4 ε offset]");
        cells.push(distance(title, &data, 3.0, offset, exact).share(0.3));
    }
    cells
}

fn exact(data: MeshData) -> Shape {
    Arc::new(Mesh::new(data).unwrap())
}

/// Vertices rounded to single precision.
fn single(data: MeshData) -> Shape {
    let vertices: Vec<[f64; 3]> =
        data.vertices().iter().map(|v| v.to_array().map(|x| f64::from(x as f32))).collect();
    exact(MeshData::new(vertices, data.triangles().iter().copied()).unwrap())
}

/// Distances against the plane of the triangle in 32 digits, and sides of the points that are launched from.
fn distance(name: String, data: &MeshData, from: f64, offset: f64, make: fn(MeshData) -> Shape) -> Cell {
    let shift = translate(offset, -0.5 * offset, 0.25 * offset);
    let data = data.clone().transformed(&shift).unwrap();
    Cell::new(name, 1.0, move |rays, tally| {
        let shape = make(data.clone());
        let mut world = World::<()>::new();
        world.add(Node::of(shape.clone(), ())).unwrap();
        let scene = world.scene().unwrap();
        let centre = data.bounding_box().enclosing_sphere().centre;
        let (mut rng, mut scratch) = (Rng::new(72), Scratch::default());
        for _ in 0..rays {
            let inside = centre + SphereSampler.sample(&mut rng) * (0.95 * rng.uniform().cbrt());
            let direction = SphereSampler.sample(&mut rng);
            let ray = Ray::new(inside - direction * (from + 1.0), direction);
            tally.ray();
            let all = scene.crossings(&ray, &mut scratch);
            tally.check(all.len() == 2, || format!("{all:?}: {ray:?}"));
            for hit in &all {
                let corners = data.corners(hit.crossing.feature.face as usize);
                let (t, cosine) = plane(&corners, &ray);
                let unit = if offset == 0.0 { 8.0 * (from + 1.0) } else { 4.0 * offset } * f64::EPSILON;
                let off = (dd(hit.crossing.distance) - t).value().abs() * cosine;
                tally.error(off / unit, || format!("{off:e} m off: {hit:?}, {ray:?}"));
                let surface = scene.finish(&ray, hit);
                for outward in [false, true] {
                    let side = side(&corners, surface.launch_point(outward));
                    tally.check((side > 0.0) == outward, || {
                        format!("{side:e} on the wrong side: {surface:?}")
                    });
                }
            }
        }
    })
}

type Triple = [Dd; 3];

fn minus(a: Point3D, b: Point3D) -> Triple {
    [0, 1, 2].map(|i| dd(a[i]) - dd(b[i]))
}

fn cross(a: Triple, b: Triple) -> Triple {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn dot(a: Triple, b: Triple) -> Dd {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// Distance of a plane along a ray, and the cosine of its normal to it.
fn plane(corners: &[Point3D; 3], ray: &Ray) -> (Dd, f64) {
    let normal = cross(minus(corners[1], corners[0]), minus(corners[2], corners[0]));
    let d = ray.direction.to_array().map(dd);
    let slope = dot(normal, d);
    let cosine = slope.value() / dot(normal, normal).sqrt().value() / ray.direction.length();
    (dot(normal, minus(corners[0], ray.origin)) / slope, cosine.abs())
}

/// Height of a point above the plane of a triangle [m].
fn side(corners: &[Point3D; 3], p: Point3D) -> f64 {
    let normal = cross(minus(corners[1], corners[0]), minus(corners[2], corners[0]));
    (dot(normal, minus(p, corners[0])) / dot(normal, normal).sqrt()).value()
}

/// Fans of needles about a corner, so many times as long as wide.
fn needles() -> Vec<Cell> {
    (2..=7)
        .map(|exponent| {
            let aspect = 10f64.powi(exponent);
            let name = format!("needles 1e{exponent} times as long as wide [ε length²/width]");
            Cell::new(name, 1.0, move |rays, tally| {
                let count = 200u32;
                let rim = (0..=count).map(|i| {
                    let (sine, cosine) = (f64::from(i) / aspect).sin_cos();
                    [cosine, sine, 0.25 * cosine]
                });
                let vertices: Vec<[f64; 3]> = std::iter::once([0.0; 3]).chain(rim).collect();
                let fan: Vec<[u32; 3]> = (1..=count).map(|i| [0, i, i + 1]).collect();
                let mesh = Mesh::new(MeshData::new(vertices.clone(), fan.iter().copied()).unwrap()).unwrap();
                // Triangles with equal corners among them change nothing.
                let idle = fan.iter().flat_map(|&[a, b, c]| [[a, b, c], [b, b, c]]);
                let more = Mesh::new(MeshData::new(vertices.clone(), idle).unwrap()).unwrap();
                let (mut rng, mut scratch) = (Rng::new(73), Scratch::default());
                for _ in 0..rays {
                    // On an edge, or within the fan.
                    let i = 1 + (rng.uniform() * f64::from(count)) as usize;
                    let part = rng.range(0.01, 0.99);
                    let [a, b] = [i.clamp(2, count as usize), i + 1].map(|i| Point3D::from(vertices[i]));
                    let along = if rng.uniform() < 0.5 { 0.0 } else { rng.range(0.01, 0.99) };
                    let along = if i < 2 || i >= count as usize { 0.0 } else { along };
                    let p = a + a.vector_to(b) * along;
                    let at = Point3D::from(p.to_vector().to_array().map(|x| x * part));
                    let direction = Vector3D::new(rng.range(-0.3, 0.3), rng.range(-0.3, 0.3), -1.0);
                    let ray = Ray::new(at - direction * 2.0, direction);
                    tally.ray();
                    let hit = mesh.hit(&ray, Interval::AHEAD, &mut scratch);
                    // Places within a triangle are ratios of areas, which are as small as it is narrow.
                    let off = hit.map_or(f64::NAN, |h| (h.distance - 2.0).abs());
                    tally.error(off / (f64::EPSILON * aspect), || format!("{hit:?}: {ray:?}"));
                    let again = more.hit(&ray, Interval::AHEAD, &mut scratch);
                    let same = hit.map(|h| h.distance.to_bits()) == again.map(|h| h.distance.to_bits());
                    tally.check(same, || format!("{hit:?} and {again:?}: {ray:?}"));
                }
            })
            .share(0.3)
        })
        .collect()
}

/// Three flat, axis-aligned sheets of squares: every box has no thickness.
fn grid(s: f64) -> MeshData {
    let n = 8u32;
    let mut vertices = Vec::new();
    let mut triangles = Vec::new();
    for axis in 0..3 {
        let base = vertices.len() as u32;
        for i in 0..=n {
            for j in 0..=n {
                let mut p =
                    [f64::from(axis) * 0.1 * s, f64::from(i) / 4.0 * s - s, f64::from(j) / 4.0 * s - s];
                p.rotate_right(axis as usize);
                vertices.push(p);
            }
        }
        for i in 0..n {
            for j in 0..n {
                let a = base + i * (n + 1) + j;
                triangles.extend([[a, a + n + 1, a + 1], [a + 1, a + n + 1, a + n + 2]]);
            }
        }
    }
    MeshData::new(vertices, triangles).unwrap()
}

/// Loose triangles, some of them long.
fn soup(s: f64) -> MeshData {
    let mut rng = Rng::new(74);
    let vertices: Vec<[f64; 3]> = (0..200)
        .flat_map(|i| {
            let centre = [0, 1, 2].map(|_| rng.range(-1.0, 1.0));
            let reach = if i % 10 == 0 { 1.0 } else { 0.1 };
            [0, 1, 2].map(|_| centre.map(|x| s * (x + reach * rng.range(-1.0, 1.0))))
        })
        .collect();
    MeshData::new(vertices, (0..200).map(|i| [3 * i, 3 * i + 1, 3 * i + 2])).unwrap()
}

fn brute_force() -> Vec<Cell> {
    type Maker = fn(f64) -> MeshData;
    let kinds: [(&str, Maker); 4] = [
        ("icosphere", |s| MeshData::icosphere(2, s).unwrap()),
        ("flat sheets", grid),
        ("loose triangles", soup),
        ("bracket", bracket),
    ];
    let mut cells = Vec::new();
    for (name, make) in kinds {
        for exponent in [-6, -3, 0, 3, 6] {
            let data = make(10f64.powi(exponent));
            let shape: Shape = Arc::new(Mesh::builder(data.clone()).build().unwrap());
            let title = format!("{name} 1e{exponent} m, one by one [8 ε reach]");
            cells.push(against_all(title, data, shape).share(0.2));
        }
    }
    cells
}

/// Where a line meets a triangle, in 32 digits, and how clearly: the least area of the three parts over the greatest.
fn meet(corners: &[Point3D; 3], ray: &Ray) -> Option<(Dd, f64)> {
    let [a, b, c] = corners.map(|p| minus(p, ray.origin));
    let d = ray.direction.to_array().map(dd);
    let areas = [dot(d, cross(b, c)), dot(d, cross(c, a)), dot(d, cross(a, b))].map(Dd::value);
    let largest = areas.iter().fold(0.0, |m: f64, x| m.max(x.abs()));
    let sign = areas.iter().sum::<f64>().signum();
    let least = areas.iter().fold(f64::INFINITY, |m: f64, x| m.min(x * sign));
    let (t, _) = plane(corners, ray);
    (largest > 0.0 && least > -1e-12 * largest).then_some((t, least / largest))
}

/// A mesh against all its triangles: the right one first, at the right distance; `hit` and `crossings` agree to the bit.
fn against_all(name: String, data: MeshData, shape: Shape) -> Cell {
    Cell::new(name, 1.0, move |rays, tally| {
        let ball = data.bounding_box().enclosing_sphere();
        let triangles: Vec<[Point3D; 3]> = (0..data.triangle_count()).map(|t| data.corners(t)).collect();
        let (mut rng, mut scratch, mut all) = (Rng::new(75), Scratch::default(), Vec::new());
        for i in 0..rays {
            let direction = SphereSampler.sample(&mut rng);
            let target = ball.centre + SphereSampler.sample(&mut rng) * (ball.radius * rng.uniform().cbrt());
            let mut ray = Ray::new(target - direction * (ball.radius * rng.range(0.0, 4.0)), direction);
            if i % 4 == 0 {
                // Along an axis.
                let axis = [Vector3D::X, Vector3D::Y, Vector3D::Z][(i / 4 % 3) as usize];
                ray = Ray::new(target - axis * (3.0 * ball.radius), axis);
            }
            judge_all(&shape, &triangles, ball.radius, &ray, &mut scratch, &mut all, tally);
        }
    })
}

fn judge_all(
    shape: &Shape,
    triangles: &[[Point3D; 3]],
    size: f64,
    ray: &Ray,
    scratch: &mut Scratch,
    all: &mut Vec<raysect::core::Crossing>,
    tally: &mut Tally,
) {
    tally.ray();
    let near = triangles.iter().enumerate().filter(|(_, t)| may_meet(t, ray, size));
    let mut expected: Vec<(Dd, f64, usize)> =
        near.filter_map(|(i, t)| meet(t, ray).map(|(at, clear)| (at, clear, i))).collect();
    expected.sort_by(|a, b| a.0.partial_cmp(&b.0).unwrap_or(std::cmp::Ordering::Equal));
    all.clear();
    shape.crossings(ray, scratch, all);
    let hit = shape.hit(ray, Interval::AHEAD, scratch);
    let first = all.iter().find(|c| c.distance >= 0.0);
    let same =
        hit.map(|c| (c.distance.to_bits(), c.exiting)) == first.map(|c| (c.distance.to_bits(), c.exiting));
    tally.check(same, || format!("{hit:?} is not the first of {all:?}: {ray:?}"));
    // On an edge either neighbour is right; elsewhere each triangle is met once.
    for (t, clear, index) in expected.iter().filter(|e| e.1 > 1e-12) {
        let found: Vec<_> = all.iter().filter(|c| c.feature.face as usize == *index).collect();
        let [crossing] = found[..] else {
            tally.fail(|| {
                format!("triangle {index}, clear by {clear:e}, is met {} times: {ray:?}", found.len())
            });
            continue;
        };
        let (_, cosine) = plane(&triangles[*index], ray);
        let off = (dd(crossing.distance) - *t).value().abs() * cosine;
        let unit = 8.0 * f64::EPSILON * 6.0 * size;
        tally.error(off / unit, || format!("{off:e} m off: {crossing:?}, {ray:?}"));
    }
    let known = all.iter().all(|c| expected.iter().any(|e| e.2 == c.feature.face as usize));
    tally.check(known, || format!("{all:?}, not {expected:?}: {ray:?}"));
}

/// False if the line is far beside the triangle.
fn may_meet(corners: &[Point3D; 3], ray: &Ray, size: f64) -> bool {
    let d = ray.direction.normalise_unchecked();
    let centre =
        corners[0] + (corners[0].vector_to(corners[1]) + corners[0].vector_to(corners[2])) * (1.0 / 3.0);
    let reach = corners.iter().map(|c| centre.distance_to(*c)).fold(0.0, f64::max);
    let v = ray.origin.vector_to(centre);
    (v - d * v.dot(d)).length() <= reach + 1e-9 * size
}

/// Four cubes: sound, inside out, open, with one face turned. Each is right or told to be wrong.
fn diagnoses(swapped: bool) -> Cell {
    Cell::new("open, inverted and inconsistent cubes are told", 0.0, move |_, tally| {
        let cube = MeshData::cube(1.0).unwrap();
        let of =
            |triangles: Vec<[u32; 3]>| MeshData::new(cube.vertices().iter().copied(), triangles).unwrap();
        let all = cube.triangles().to_vec();
        let inverted: Vec<_> = all.iter().map(|&[a, b, c]| [a, c, b]).collect();
        let mut turned = all.clone();
        turned[3].swap(1, 2);
        let (sound, inverted) = if swapped { (inverted, all.clone()) } else { (all.clone(), inverted) };
        let centre = Point3D::ORIGIN;
        tally.rays += 4;
        let whole = Mesh::new(of(sound));
        tally.check(whole.is_ok_and(|m| m.is_closed() && m.contains(centre)), || "sound".to_owned());
        tally.check(matches!(Mesh::new(of(inverted)), Err(MeshError::InsideOut)), || "inside out".to_owned());
        let open = of(all[2..].to_vec());
        let told = !open.health().is_watertight() && open.health().boundary_edges == 4;
        let mesh = Mesh::new(open).unwrap();
        tally.check(told && !mesh.is_closed() && !mesh.contains(centre), || "open".to_owned());
        let turned = of(turned);
        let told = !turned.health().is_consistently_oriented();
        let mesh = Mesh::new(turned).unwrap();
        tally.check(told && !mesh.is_closed() && !mesh.contains(centre), || "a face turned".to_owned());
    })
}

/// Points straight below corners and edges, along the axes and along whatever line `contains` may look.
fn below(number: usize, make: fn(Mesh) -> Shape) -> Cell {
    let data = [MeshData::icosphere(3, 1.0).unwrap(), MeshData::cube(1.0).unwrap()][number].clone();
    let name = ["icosphere", "cube"][number];
    Cell::new(format!("{name}: points below corners and edges"), 0.0, move |rays, tally| {
        let shape = make(Mesh::new(data.clone()).unwrap());
        let mut rng = Rng::new(76);
        let inner = if number == 0 { 0.98 } else { 1.0 };
        let outer = if number == 0 { 1.0 } else { 3f64.sqrt() };
        for i in 0..rays {
            let [a, b, _] = data.corners((i as usize * 31) % data.triangle_count());
            let at = match i % 3 {
                0 => a,
                1 => a + a.vector_to(b) * 0.5,
                _ => a + a.vector_to(b) * rng.uniform(),
            };
            let along = match i % 5 {
                0 => Vector3D::X,
                1 => Vector3D::Y,
                2 => Vector3D::Z,
                3 => Vector3D::new(0.537_299, 0.274_653, 0.797_427),
                _ => SphereSampler.sample(&mut rng),
            };
            let p = at - along * rng.range(-3.0, 3.0);
            let (r, m) = (p.to_vector().length(), p.max_abs());
            // Between the ball within and the ball around the answer is another question.
            let expected = match number {
                0 if r < inner => true,
                0 if r > outer + 1e-12 => false,
                1 if m < 1.0 - 1e-12 => true,
                1 if m > 1.0 + 1e-12 => false,
                _ => continue,
            };
            tally.ray();
            tally.check(shape.contains(p) == expected, || format!("{p:?} inside: not {expected}"));
        }
    })
}
