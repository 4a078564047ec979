//! Every sampler in one table: its density integrates to one, its samples follow it, and a wrong density is told.

use super::check::{Chart, cap};
use super::*;
use crate::*;
use std::f64::consts::{PI, TAU};

const COUNT: usize = 60_000;

/// What came out for one sampler.
struct Row {
    name: &'static str,
    integral: f64,
    follows: bool,
    /// Wrong densities that were taken for right.
    believed: Vec<&'static str>,
}

type Density<'a, P> = &'a dyn Fn(P) -> f64;

/// Judges a sampler; of the wrong densities one is always tilted by a tenth along the first coordinate.
fn row<P: Copy>(
    name: &'static str,
    chart: &Chart<P>,
    mut draw: impl FnMut(&mut Rng) -> P,
    pdf: Density<P>,
    wrong: &[(&'static str, Density<P>)],
) -> Row {
    let mut rng = Rng::new(7);
    let samples: Vec<P> = (0..COUNT).map(|_| draw(&mut rng)).collect();
    let middle = 0.5 * (chart.low[0] + chart.high[0]);
    let tilt = |p: P| 0.2 * ((chart.coordinates)(p)[0] - middle) / (chart.high[0] - chart.low[0]);
    let tilted = |p: P| pdf(p) * (1.0 + tilt(p));
    let all = [("tilted", &tilted as Density<P>)].into_iter().chain(wrong.iter().copied());
    Row {
        name,
        integral: chart.integral(pdf),
        follows: chart.fits(&samples, pdf),
        believed: all.filter(|(_, density)| chart.fits(&samples, density)).map(|(what, _)| what).collect(),
    }
}

fn chart<P>(
    high: [f64; 2],
    place: impl Fn([f64; 2]) -> P + 'static,
    coordinates: impl Fn(P) -> [f64; 2] + 'static,
    jacobian: impl Fn([f64; 2]) -> f64 + 'static,
) -> Chart<P> {
    Chart {
        low: [0.0, 0.0],
        high,
        bins: [10, 12],
        place: Box::new(place),
        coordinates: Box::new(coordinates),
        jacobian: Box::new(jacobian),
    }
}

/// Squared share of the radius, and angle.
fn round(radius: f64) -> Chart<Point3D> {
    let place = move |[q, phi]: [f64; 2]| {
        Point3D::new(radius * q.sqrt() * phi.cos(), radius * q.sqrt() * phi.sin(), 0.0)
    };
    let coordinates =
        move |p: Point3D| [(p.x * p.x + p.y * p.y) / (radius * radius), p.y.atan2(p.x).rem_euclid(TAU)];
    chart([1.0, TAU], place, coordinates, move |_| 0.5 * radius * radius)
}

/// From a corner.
fn oblong(corner: [f64; 2], size: [f64; 2]) -> Chart<Point3D> {
    let place = move |[x, y]: [f64; 2]| Point3D::new(corner[0] + x, corner[1] + y, 0.0);
    chart(size, place, move |p| [p.x - corner[0], p.y - corner[1]], |_| 1.0)
}

const CORNERS: [Point3D; 3] =
    [Point3D::new(0.2, -0.4, 1.0), Point3D::new(1.5, 0.1, 1.0), Point3D::new(0.3, 1.1, 1.0)];

/// β + γ and γ / (β + γ) of the shares of the second and third corner.
fn three_cornered() -> Chart<Point3D> {
    let [a, b, c] = CORNERS;
    let (e, f) = (a.vector_to(b), a.vector_to(c));
    let area = e.cross(f).length();
    let place = move |[s, g]: [f64; 2]| a + e * (s * (1.0 - g)) + f * (s * g);
    let coordinates = move |p: Point3D| {
        let flat = |p: Point3D| Point2D::new(p.x, p.y);
        let [_, beta, gamma] = triangle_shares(CORNERS.map(flat), flat(p)).unwrap();
        [beta + gamma, gamma / (beta + gamma)]
    };
    chart([1.0, 1.0], place, coordinates, move |[s, _]| s * area)
}

/// A chart of the plane z = 1, or of z = 0 and then moved there, as one of directions from the origin.
fn seen(flat: Chart<Point3D>) -> Chart<Vector3D> {
    let Chart { low, high, bins, place, coordinates, jacobian } = flat;
    let place = std::rc::Rc::new(place);
    let raised = {
        let place = place.clone();
        move |at| {
            let p = place(at);
            Vector3D::new(p.x, p.y, 1.0)
        }
    };
    let again = raised.clone();
    Chart {
        low,
        high,
        bins,
        place: Box::new(move |at| raised(at).normalise().unwrap()),
        coordinates: Box::new(move |v| coordinates(Point3D::new(v.x / v.z, v.y / v.z, 1.0))),
        jacobian: Box::new(move |at| jacobian(at) * again(at).length().powi(-3)),
    }
}

fn points() -> Vec<Row> {
    let lift = |p: Point2D| Point3D::new(p.x, p.y, 0.0);
    let drop = |p: Point3D| Point2D::new(p.x, p.y);
    let disk = DiskSampler3D::new(2.5).unwrap();
    let rectangle = RectangleSampler3D::new(3.0, 0.5).unwrap();
    let triangle = TriangleSampler3D::new(CORNERS[0], CORNERS[1], CORNERS[2]).unwrap();
    let smaller = DiskSampler3D::new(2.4).unwrap();
    let place = |[s, g]: [f64; 2]| [1.0 - s, s * (1.0 - g), s * g];
    let shares = chart([1.0, 1.0], place, |[_, b, c]| [b + c, c / (b + c)], |[s, _]| s);
    // A radius that is uniform crowds the centre.
    let crowded = |p: Point3D| 1.0 / (TAU * 2.5 * p.x.hypot(p.y));
    vec![
        row("disk::sample", &round(1.0), |r| lift(disk::sample(uniforms(r))), &|p| disk::pdf(drop(p)), &[]),
        row(
            "DiskSampler3D",
            &round(2.5),
            |r| disk.sample(r),
            &|p| disk.pdf(p),
            &[("smaller", &|p| smaller.pdf(p)), ("crowded", &crowded)],
        ),
        row(
            "square::sample",
            &oblong([0.0; 2], [1.0; 2]),
            |r| lift(square::sample(uniforms(r))),
            &|p| square::pdf(drop(p)),
            &[],
        ),
        row(
            "RectangleSampler3D",
            &oblong([-1.5, -0.25], [3.0, 0.5]),
            |r| rectangle.sample(r),
            &|p| rectangle.pdf(p),
            &[],
        ),
        row("triangle::sample", &shares, |r| triangle::sample(uniforms(r)), &triangle::pdf, &[]),
        row("TriangleSampler3D", &three_cornered(), |r| triangle.sample(r), &|p| triangle.pdf(p), &[]),
    ]
}

fn directions() -> Vec<Row> {
    let (half, all) = (cap(1.0), cap(2.0));
    let cone = Cone::from_angle(35.0).unwrap();
    let versine = cone.solid_angle() / TAU;
    let ball = Cone::of_sphere(1.0, 3.0);
    let (uniform, cosine) = (ConeUniformSampler::new(35.0).unwrap(), ConeCosineSampler::new(80.0).unwrap());
    let even = ConeUniformSampler::new(80.0).unwrap();
    let narrow = cap(even.solid_angle() / TAU);
    let cos_dropped: Density<Vector3D> = &hemisphere::pdf_uniform;
    let cos_invented: Density<Vector3D> = &hemisphere::pdf_cosine;
    vec![
        row("sphere::sample", &all, |r| sphere::sample(uniforms(r)), &sphere::pdf, &[]),
        row("SphereSampler", &all, |r| SphereSampler.sample(r), &|v| SphereSampler.pdf(v), &[]),
        row(
            "hemisphere::sample_uniform",
            &half,
            |r| hemisphere::sample_uniform(uniforms(r)),
            &hemisphere::pdf_uniform,
            &[("cos invented", cos_invented)],
        ),
        row(
            "HemisphereUniformSampler",
            &half,
            |r| HemisphereUniformSampler.sample(r),
            &|v| HemisphereUniformSampler.pdf(v),
            &[("cos invented", cos_invented)],
        ),
        row(
            "hemisphere::sample_cosine",
            &half,
            |r| hemisphere::sample_cosine(uniforms(r)),
            &hemisphere::pdf_cosine,
            &[("cos dropped", cos_dropped)],
        ),
        row(
            "HemisphereCosineSampler",
            &half,
            |r| HemisphereCosineSampler.sample(r),
            &|v| HemisphereCosineSampler.pdf(v),
            &[("cos dropped", cos_dropped)],
        ),
        row("Cone", &cap(versine), |r| cone.sample(r), &|v| cone.pdf(v), &[("half space", cos_dropped)]),
        row("Cone::of_sphere", &cap(1.0 - 8f64.sqrt() / 3.0), |r| ball.sample(r), &|v| ball.pdf(v), &[]),
        row("ConeUniformSampler", &cap(versine), |r| uniform.sample(r), &|v| uniform.pdf(v), &[]),
        row(
            "ConeCosineSampler",
            &narrow,
            |r| cosine.sample(r),
            &|v| cosine.pdf(v),
            &[("cos dropped", &|v| even.pdf(v))],
        ),
    ]
}

fn solid_angles() -> Vec<Row> {
    let o = Point3D::ORIGIN;
    let centre = Point3D::new(0.0, 0.0, 1.0);
    let disk = SphericalDiskSampler::new(o, centre, Vector3D::Z, 1.5).unwrap();
    let corner = Point3D::new(-0.4, 0.3, 1.0);
    let edges = [Vector3D::X * 1.6, Vector3D::Y * 1.1];
    let rectangle = SphericalRectangleSampler::new(o, corner, edges).unwrap();
    let triangle = SphericalTriangleSampler::new(o, CORNERS).unwrap();
    // What samples uniform in area have, whose jacobian is a constant.
    let area = |size: f64| move |v: Vector3D| 1.0 / (size * v.z.powi(3));
    let flat = 0.5 * CORNERS[0].vector_to(CORNERS[1]).cross(CORNERS[0].vector_to(CORNERS[2])).length();
    vec![
        row(
            "SphericalDiskSampler",
            &seen(round(1.5)),
            |r| disk.sample(r),
            &|v| disk.pdf(v),
            &[("uniform in area", &area(PI * 2.25))],
        ),
        row(
            "SphericalRectangleSampler",
            &seen(oblong([-0.4, 0.3], [1.6, 1.1])),
            |r| rectangle.sample(r),
            &|v| rectangle.pdf(v),
            &[("uniform in area", &area(1.6 * 1.1))],
        ),
        row(
            "SphericalTriangleSampler",
            &seen(three_cornered()),
            |r| triangle.sample(r),
            &|v| triangle.pdf(v),
            &[("uniform in area", &area(flat))],
        ),
    ]
}

fn targeted() -> Vec<Row> {
    let from = Point3D::new(0.5, -0.2, 0.3);
    let target = |z: f64, radius: f64| TargetSphere::new(from + Vector3D::Z * z, radius, 0.3).unwrap();
    // Two balls around one axis, one behind the other; the density has steps where the chart has edges of bins.
    let cone = |versine: f64| (versine * (2.0 - versine)).sqrt();
    let pair = [target(3.0, 3.0 * cone(0.5)), target(5.0, 5.0 * cone(0.2))];
    let sphere = TargetedSphereSampler::new(pair).unwrap();
    let hemisphere = TargetedHemisphereSampler::new(pair).unwrap();
    // One in the plane: half of the directions follow the cosine.
    let mixed = TargetedHemisphereSampler::new([pair[1], target(0.0, 0.1)]).unwrap();
    let half = cap(1.0);
    let dropped =
        |v: Vector3D| mixed.pdf(from, v) - 0.5 * hemisphere::pdf_cosine(v) + 0.5 * hemisphere::pdf_uniform(v);
    vec![
        row("TargetedSphereSampler", &half, |r| sphere.sample(from, r), &|v| sphere.pdf(from, v), &[]),
        row(
            "TargetedHemisphereSampler",
            &half,
            |r| hemisphere.sample(from, r),
            &|v| hemisphere.pdf(from, v),
            &[],
        ),
        row(
            "TargetedHemisphereSampler, low",
            &half,
            |r| mixed.sample(from, r),
            &|v| mixed.pdf(from, v),
            &[("cos dropped", &dropped)],
        ),
    ]
}

#[test]
fn every_sampler_follows_its_density_and_no_other() {
    let rows: Vec<Row> = [points(), directions(), solid_angles(), targeted()].into_iter().flatten().collect();
    for Row { name, integral, follows, believed } in &rows {
        // The midpoint rule, where the density is not constant in the coordinates.
        assert!((integral - 1.0).abs() < 4e-3, "{name}: {integral}");
        assert!(follows, "{name}");
        assert!(believed.is_empty(), "{name}: {believed:?}");
    }
    // No sampler of the folder is missing.
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("src/sampling");
    let mut count = 0;
    for entry in std::fs::read_dir(folder).unwrap() {
        let Ok(text) = std::fs::read_to_string(entry.unwrap().path()) else { continue };
        for found in text.split("pub struct ").skip(1) {
            let name = found.split(|c: char| !c.is_alphanumeric()).next().unwrap();
            if name.ends_with("Sampler") || name.ends_with("Sampler3D") || name == "Cone" {
                assert!(rows.iter().any(|row| row.name == name), "{name} is not tested");
                count += 1;
            }
        }
    }
    assert!(count >= 13, "{count}");
}
