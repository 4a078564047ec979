use super::*;
use raysect_core::testing::{check_primitive, some_motion};
use raysect_math::{Rng, SphereSampler};

const EPS: f64 = f64::EPSILON;

fn crossings(torus: &Torus, ray: &Ray) -> Vec<Crossing> {
    let mut all = Vec::new();
    torus.crossings(ray, &mut Scratch::default(), &mut all);
    all
}

/// A ray with its exact crossings.
struct Case {
    torus: Torus,
    ray: Ray,
    /// Least distance from the surface where the quartic is level, in major radii.
    margin: f64,
    /// Distance, and cosine between ray and normal.
    exact: Vec<(f64, f64)>,
}

fn recorded() -> Vec<Case> {
    let text = include_str!("../../tests/data/torus.txt");
    let case = |line: &str| {
        let (left, right) = line.split_once(" ;").unwrap();
        let numbers =
            |words: &str| words.split_whitespace().filter_map(|w| w.parse().ok()).collect::<Vec<f64>>();
        let [major, minor, ox, oy, oz, dx, dy, dz, margin] = numbers(left)[..] else { panic!("{line}") };
        let exact = numbers(right).chunks(2).map(|p| (p[0], p[1])).collect();
        let ray = Ray::new(Point3D::new(ox, oy, oz), Vector3D::new(dx, dy, dz));
        Case { torus: Torus::new(major, minor).unwrap(), ray, margin, exact }
    };
    text.lines().filter(|line| !line.starts_with('#')).map(case).collect()
}

/// What is wrong with crossings, and their largest error in units of what rounding of coordinates explains.
fn judge(case: &Case, all: &[Crossing]) -> Result<f64, String> {
    let Case { torus, ray, margin, exact } = case;
    let alternate = all.iter().enumerate().all(|(i, c)| c.exiting == (i % 2 == 1));
    if all.len() % 2 == 1 || !alternate || !all.is_sorted_by(|a, b| a.distance <= b.distance) {
        return Err(format!("not a solid: {all:?}"));
    }
    if *margin < 16.0 * EPS {
        return Ok(0.0); // A touch within rounding: a pair more or less.
    }
    if all.len() != exact.len() {
        return Err(format!("{} crossings instead of {}: {all:?}", all.len(), exact.len()));
    }
    let mut worst = 0.0f64;
    for (c, &(distance, cosine)) in all.iter().zip(exact) {
        if c.exiting != (cosine > 0.0) {
            return Err(format!("{c:?} has the normal on the wrong side"));
        }
        let rounding = EPS * (distance.abs() + torus.major_radius() / cosine.abs() / ray.direction.length());
        worst = worst.max((c.distance - distance).abs() / rounding);
    }
    if worst > 4.0 {
        return Err(format!("distances are off by {worst} roundings: {all:?}, exactly {exact:?}"));
    }
    Ok(worst)
}

#[test]
fn crossings_agree_with_exact_arithmetic() {
    let cases = recorded();
    assert!(cases.len() > 600);
    let mut faults = Vec::new();
    for (number, case) in cases.iter().enumerate() {
        if let Err(what) = judge(case, &crossings(&case.torus, &case.ray)) {
            faults.push(format!("ray {number}, {:?}, margin {:e}: {what}", case.torus, case.margin));
        }
    }
    assert!(faults.is_empty(), "{} of {}:\n{}", faults.len(), cases.len(), faults.join("\n"));
}

#[test]
fn the_judge_refuses_wrong_crossings() {
    let cases = recorded();
    let clear = cases.iter().filter(|c| c.margin > 1e-6 && c.exact.len() == 4).take(20);
    let faults: [fn(&mut Vec<Crossing>); 4] = [
        |all| all.truncate(2),
        |all| all.iter_mut().for_each(|c| c.exiting = !c.exiting),
        |all| all.iter_mut().for_each(|c| c.distance *= 1.0 + 1e-9),
        |all| all.swap(0, 1),
    ];
    for case in clear {
        for fault in faults {
            let mut all = crossings(&case.torus, &case.ray);
            assert!(judge(case, &all).is_ok());
            fault(&mut all);
            assert!(judge(case, &all).is_err());
        }
    }
}

#[test]
fn keeps_the_contract_at_every_size_and_width() {
    for scale in [1e-9, 1e-3, 0.7, 1.0, 1e3, 1e9] {
        for ratio in [1e-4, 0.01, 0.3, 0.5, 0.9, 0.999, 1.0] {
            let torus = Torus::new(scale, ratio * scale).unwrap();
            check_primitive(&torus, 2000, 1).unwrap_or_else(|e| panic!("{torus:?}: {e}"));
        }
    }
    for (major, minor) in [(1e-100, 3e-101), (1e100, 3e99), (1.0, 1e-7)] {
        check_primitive(&Torus::new(major, minor).unwrap(), 2000, 2).unwrap();
    }
}

#[test]
fn impossible_radii_are_named() {
    for (major, minor) in [(0.0, 0.0), (-1.0, 0.5), (f64::NAN, 0.5), (f64::INFINITY, 1.0)] {
        let message = Torus::new(major, minor).unwrap_err().to_string();
        assert!(message.contains("torus: major_radius"), "{message}");
    }
    for minor in [0.0, -0.1, 1.0 + EPS, 1e-10, f64::NAN] {
        let message = Torus::new(1.0, minor).unwrap_err().to_string();
        assert!(message.contains("torus: minor_radius"), "{message}");
    }
    assert_eq!(Torus::new(1.0, 0.5).unwrap(), Torus::default());
}

/// A point of the surface.
fn point(torus: &Torus, phi: f64, theta: f64) -> Point3D {
    let circle = torus.major_radius() + torus.minor_radius() * theta.cos();
    Point3D::new(circle * phi.cos(), circle * phi.sin(), torus.minor_radius() * theta.sin())
}

#[test]
fn boxes_are_tight_under_every_map() {
    let sheared = AffineMatrix3D::from_axes(
        Vector3D::new(3.0, 0.0, 0.0),
        Vector3D::new(0.5, 0.2, 0.0),
        Vector3D::new(-1.0, 0.3, 2.0),
        Point3D::new(5.0, 6.0, 7.0),
    );
    let mut rng = Rng::new(4);
    for torus in [Torus::new(2.0, 0.3).unwrap(), Torus::new(1e-3, 9e-4).unwrap()] {
        for m in [AffineMatrix3D::IDENTITY, some_motion(), sheared] {
            let (image, sphere) = (torus.bounding_box(&m), torus.bounding_sphere(&m));
            let mut seen = BoundingBox3D::EMPTY;
            for _ in 0..40_000 {
                let p = m * point(&torus, rng.range(0.0, 6.3), rng.range(0.0, 6.3));
                assert!(image.contains(p) && sphere.contains(p));
                seen.extend(p, 0.0);
            }
            for axis in 0..3 {
                let slack = 1.0 - seen.extent(axis) / image.extent(axis);
                assert!((0.0..2e-3).contains(&slack), "{slack}");
            }
        }
    }
    let turned = Torus::default().bounding_sphere(&some_motion());
    assert!((turned.radius - 1.5).abs() < 1e-8, "{turned:?}");
}

#[test]
fn points_normals_and_bounds_hold() {
    for case in recorded() {
        let Case { torus, ray, .. } = case;
        let (major, minor) = (torus.major_radius(), torus.minor_radius());
        for c in crossings(&torus, &ray) {
            let Surface { point, normal, bound, .. } = torus.surface(&ray, &c);
            // Distance from the surface, without cancellation beyond that of the coordinates' last bits.
            let (rho, z) = (point.x.hypot(point.y), point.z);
            let off = (rho - major).hypot(z) - minor;
            assert!(off.abs() <= bound + 2.0 * EPS * (major + minor), "{off:e} {bound:e}");
            assert!(bound <= 8.0 * EPS * (major + minor));
            let exact =
                Vector3D::new(point.x * (rho - major) / rho, point.y * (rho - major) / rho, z) / minor;
            let turned = (exact - normal.as_vector()).length();
            assert!(turned <= 8.0 * EPS * (major + minor) / minor, "{turned:e}");
        }
    }
}

/// Of a body of volume V and surface S, chords of an isotropic field of lines have the mean 4 V / S, counting each
/// piece inside (Cauchy).
#[test]
fn chords_have_cauchys_mean() {
    let mut rng = Rng::new(11);
    for (major, minor) in [(1.0, 0.5), (1e-3, 1e-4), (1e6, 9.9e5)] {
        let torus = Torus::new(major, minor).unwrap();
        let reach = major + minor;
        let (mut inside, mut pieces, mut squares) = (0.0, 0.0, 0.0);
        let rays = 200_000;
        let mean = 2.0 * minor;
        for _ in 0..rays {
            let direction = SphereSampler.sample_at([rng.uniform(), rng.uniform()]);
            let x = direction.orthogonal().unwrap();
            let (phi, r) = (rng.range(0.0, std::f64::consts::TAU), reach * rng.uniform().sqrt());
            let beside = x * (r * phi.cos()) + direction.cross(x) * (r * phi.sin());
            let all = crossings(&torus, &Ray::new(Point3D::ORIGIN + beside, direction));
            let length: f64 = all.chunks(2).map(|c| c[1].distance - c[0].distance).sum();
            let count = all.len() as f64 / 2.0;
            (inside, pieces) = (inside + length, pieces + count);
            squares += (length - mean * count).powi(2);
        }
        let (found, error) = (inside / pieces, squares.sqrt() / pieces);
        let z = (found - 4.0 * torus.volume() / torus.surface_area()) / error;
        assert!(z.abs() < 4.0 && error < 0.01 * mean, "{found} ± {error}, expected {mean}");
        // Negative control: the mean chord of a torus of another tube.
        assert!(((found - 1.05 * mean) / error).abs() > 4.0);
    }
}

#[test]
fn touches_give_none_or_a_pair() {
    let torus = Torus::default();
    let along = |o: [f64; 3], d: [f64; 3]| crossings(&torus, &Ray::new(o.into(), d.into()));
    for (o, d) in [
        ([0.0, 0.0, 0.5], [1.0, 0.0, 0.0]),
        ([1.5, -9.0, 0.0], [0.0, 1.0, 0.0]),
        ([-4.0, 1.0, 0.5], [1.0, 0.0, 0.0]),
        ([0.5, 0.0, -3.0], [0.0, 0.0, 1.0]),
        ([0.5, -9.0, 0.0], [0.0, 1.0, 0.0]),
    ] {
        let all = along(o, d);
        assert!(
            all.len() % 2 == 0 && all.iter().enumerate().all(|(i, c)| c.exiting == (i % 2 == 1)),
            "{all:?}"
        );
    }
    // Two touches at once, of the tube's upper and lower side (Y. Villarceau).
    let both = along([0.0, 0.0, 0.0], [0.75f64.sqrt(), 0.0, 0.5]);
    assert!(both.len() % 2 == 0 && both.windows(2).all(|w| w[0].distance <= w[1].distance), "{both:?}");
    let through = along([-4.0, 0.0, 0.0], [2.0, 0.0, 0.0]);
    assert_eq!(through.iter().map(|c| c.distance).collect::<Vec<_>>(), [1.25, 1.75, 2.25, 2.75]);
}

/// What is told without brackets of rays that leave the surface is what the brackets say.
#[test]
fn clear_ways_onward_are_those_of_the_brackets() {
    let mut rng = Rng::new(21);
    for minor in [1e-6, 0.1, 0.6, 1.0] {
        let torus = Torus::new(1.5, 1.5 * minor).unwrap();
        let mut clear = [0; 2];
        for _ in 0..20_000 {
            let from = point(&torus, rng.range(0.0, 6.3), rng.range(0.0, 6.3));
            let direction = SphereSampler.sample_at([rng.uniform(), rng.uniform()]);
            let inward = torus.tube.gradient(from).dot(direction) < 0.0;
            let line = torus.tube.line(&Ray::new(from, direction));
            let Some(span) = torus.tube.span(&line) else { continue };
            let Some(told) = torus.tube.clear_next(&line, &span, inward) else { continue };
            clear[usize::from(inward)] += 1;
            let found = torus.next_in_brackets(&line, &span, inward);
            assert!(found.is_none_or(|c| c.exiting), "{minor}: {found:?}");
            assert_eq!(found.map(|c| c.distance), told, "{minor}: {from:?} {direction:?}");
        }
        assert!(clear.iter().all(|&count| count > 4000), "{minor}: {clear:?}");
    }
}

/// How many crossings lines have that pass a touch on the one side or on the other, by a part of the tube, outside, in the
/// hole and on top: all numbers are exact.
fn counts_beside_touches(torus: &Torus, gap: f64) -> [[usize; 2]; 4] {
    let (major, minor) = (2.0, 0.5);
    let beside = |from: &dyn Fn(f64) -> [f64; 3], direction: [f64; 3]| {
        [gap, -gap].map(|gap| {
            let ray = Ray::new(from(gap * minor).into(), direction.into());
            let all = crossings(torus, &ray);
            let everywhere = Interval::new(f64::NEG_INFINITY, f64::INFINITY);
            assert_eq!(torus.hit(&ray, everywhere, &mut Scratch::default()), all.first().copied());
            all.len()
        })
    };
    [
        beside(&|off| [major + minor + off, 0.0, -3.0], [0.0, 0.0, 0.5]),
        beside(&|off| [major - minor - off, 0.0, -3.0], [0.0, 0.0, 2.0]),
        beside(&|off| [major - minor - off, -5.0, 0.0], [0.0, 1.0, 0.0]),
        beside(&|off| [-7.0, 0.0, minor + off], [1.0, 0.0, 0.0]),
    ]
}

#[test]
fn lines_that_all_but_touch_are_counted_right() {
    let torus = Torus::new(2.0, 0.5).unwrap();
    let expected = [[0, 2], [0, 2], [4, 2], [0, 4]];
    for exponent in 10..46 {
        let gap = 2f64.powi(-exponent);
        assert_eq!(counts_beside_touches(&torus, gap), expected, "2^-{exponent}");
        let wider = Torus::new(2.0, 0.5 * (1.0 + 4.0 * gap)).unwrap();
        let found = counts_beside_touches(&wider, gap);
        assert!(found.iter().zip(&expected).all(|(a, b)| a != b), "2^-{exponent}: {found:?}");
    }
}

#[test]
fn contains_its_tube_only() {
    let torus = Torus::new(2.0, 0.5).unwrap();
    assert!(torus.contains(Point3D::new(0.0, 2.5, 0.0)) && torus.contains(Point3D::new(2.0, 0.0, -0.5)));
    for p in
        [[0.0, 0.0, 0.0], [2.0, 0.0, 0.501], [2.501, 0.0, 0.0], [1e300, 0.0, 1e300], [f64::NAN, 0.0, 0.0]]
    {
        assert!(!torus.contains(p.into()), "{p:?}");
    }
}

/// Mean of a function over the surface by draws that cannot be refused, as each point faces one of two sides.
#[test]
fn draws_are_uniform_over_the_area() {
    let torus = Torus::new(2.0, 1.5).unwrap();
    let mut rng = Rng::new(8);
    let (mut rings, draws) = ([0.0; 8], 80_000);
    for _ in 0..draws {
        let u = [0; 3].map(|_| rng.uniform());
        // From far above and far below: what does not face the one faces the other.
        let sides = [1e9, -1e9].map(|z| torus.sample_surface(Point3D::new(0.0, 0.0, z), u));
        assert!(sides[0].is_some() != sides[1].is_some());
        let s = sides.into_iter().flatten().next().unwrap();
        assert_eq!(s.density, 1.0 / torus.surface_area());
        let p = s.point;
        let theta = p.z.atan2(p.x.hypot(p.y) - 2.0).rem_euclid(std::f64::consts::TAU);
        rings[(theta / std::f64::consts::FRAC_PI_4) as usize] += 1.0;
        let exact = point(&torus, p.y.atan2(p.x), theta);
        assert!(p.distance_to(exact) < 1e-14 && s.normal.dot(Vector3D::new(p.x, p.y, p.z)) > -2.0);
    }
    for (i, found) in rings.into_iter().enumerate() {
        let angle = |k: usize| k as f64 * std::f64::consts::FRAC_PI_4;
        // The share of a ring between two angles about the tube.
        let share = (angle(1) + 0.75 * (angle(i + 1).sin() - angle(i).sin())) / std::f64::consts::TAU;
        let (mean, error) = (share * f64::from(draws), (share * (1.0 - share) * f64::from(draws)).sqrt());
        assert!((found - mean).abs() < 4.0 * error, "ring {i}: {found}, expected {mean} ± {error}");
    }
}

/// A torus that claims to choose points on both sides, or never chooses any.
struct WrongLight(Torus, bool);

impl Primitive for WrongLight {
    fn bounding_box(&self, m: &AffineMatrix3D) -> BoundingBox3D {
        self.0.bounding_box(m)
    }
    fn contains(&self, point: Point3D) -> bool {
        self.0.contains(point)
    }
    fn crossings(&self, ray: &Ray, scratch: &mut Scratch, out: &mut Vec<Crossing>) {
        self.0.crossings(ray, scratch, out);
    }
    fn surface(&self, ray: &Ray, crossing: &Crossing) -> Surface {
        self.0.surface(ray, crossing)
    }
    fn surface_sampling(&self) -> SurfaceSampling {
        SurfaceSampling::Area
    }
    fn sample_surface(&self, from: Point3D, u: [f64; 3]) -> Option<SurfaceSample> {
        self.0.sample_surface(from, u).filter(|_| self.1)
    }
    fn surface_density(&self, _: Point3D, _: Point3D, _: Feature) -> f64 {
        if self.1 { 1.0 / self.0.surface_area() } else { 0.0 }
    }
}

#[test]
fn the_contract_refuses_wrong_densities() {
    for both_sides in [true, false] {
        let outcome = check_primitive(&WrongLight(Torus::default(), both_sides), 100, 3);
        assert!(outcome.is_err_and(|e| e.contains("sampling density")), "{both_sides}");
    }
}
