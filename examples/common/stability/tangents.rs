//! Lines that all but touch a torus: outside, in the hole, and on top.

use raysect::core::{Interval, Ray, Scratch};
use raysect::math::{Point3D, Rng, Vector3D};

use super::Cell;
use super::bodies::Shape;
use super::exact::Plain;
use super::wrong::{Fault, Wrong};

/// Errors of crossings across the surface, in ε times the size.
const LIMIT: f64 = 8.0;
/// How far from a touch, in radii of the tube.
const GAPS: [f64; 4] = [1e-6, 1e-8, 1e-10, 1e-12];
/// Where, by the angle about the tube from its outer equator and how far around [rad].
const PLACES: [(&str, f64, f64); 3] = [
    ("outside", 0.0, 1.2),
    ("in the hole", std::f64::consts::PI, 1.2),
    ("on top", 0.5 * std::f64::consts::PI, 0.02),
];
/// Radii of the circle and of the tube.
const TORI: [(f64, f64); 3] = [(0.7, 0.3), (1.0, 0.02), (1.0, 0.95)];

pub(crate) fn cells() -> Vec<Cell> {
    let mut cells = Vec::new();
    for (major, minor) in TORI {
        for place in PLACES {
            for gap in GAPS {
                let torus = Plain::Torus(major, minor);
                let name = format!("torus {major} × {minor}, {gap:e} radii off a touch {}", place.0);
                let core = minor == 0.3 && (gap == 1e-6 || gap == 1e-12);
                cells.push(beside(name, torus, torus.shape(), place, gap).core(core));
            }
        }
    }
    cells
}

pub(crate) fn controls() -> Vec<Cell> {
    let torus = Plain::Torus(0.7, 0.3);
    let mut controls = Vec::new();
    for place in PLACES {
        let wider = Plain::Torus(0.7, 0.3 * (1.0 + 1e-11)).shape();
        controls.push(beside(format!("torus wider by 1e-11, {}", place.0), torus, wider, place, 1e-12));
    }
    let missing: Shape = std::sync::Arc::new(Wrong(torus.shape(), Fault::Misses(50)));
    controls.push(beside("one line in 50 missed".to_owned(), torus, missing, PLACES[0], 1e-6));
    controls
}

/// A line at a distance from one of the tangents at a point of the torus, in or out.
fn line(major: f64, minor: f64, (_, angle, around): (&str, f64, f64), gap: f64, rng: &mut Rng) -> Ray {
    let side = if rng.uniform() < 0.5 { -1.0 } else { 1.0 };
    let (sine, cosine) = (side * (angle + rng.range(-around, around))).sin_cos();
    let (y, x) = rng.range(0.0, std::f64::consts::TAU).sin_cos();
    let normal = Vector3D::new(cosine * x, cosine * y, sine);
    let (ring, meridian) = (Vector3D::new(-y, x, 0.0), Vector3D::new(-sine * x, -sine * y, cosine));
    let (b, a) = rng.range(0.0, std::f64::consts::TAU).sin_cos();
    let along = ring * a + meridian * b;
    let off = if rng.uniform() < 0.5 { 1.0 + gap } else { 1.0 - gap };
    let touch = Point3D::new(major * x, major * y, 0.0) + normal * (off * minor);
    Ray::new(touch - along * (rng.range(0.5, 4.0) * (major + minor)), along)
}

/// As many crossings as by 32 digits, but for a few roundings off a touch, and where they are; the first of them is what is
/// hit.
fn beside(name: String, torus: Plain, shape: Shape, place: (&'static str, f64, f64), gap: f64) -> Cell {
    Cell::new(format!("{name} [ε across]"), LIMIT, move |rays, tally| {
        let Plain::Torus(major, minor) = torus else { return };
        let (mut rng, mut scratch, mut found) = (Rng::new(43), Scratch::default(), Vec::new());
        for _ in 0..rays {
            let ray = line(major, minor, place, gap, &mut rng);
            found.clear();
            shape.crossings(&ray, &mut scratch, &mut found);
            tally.ray();
            let hit = shape.hit(&ray, Interval::new(f64::NEG_INFINITY, f64::INFINITY), &mut scratch);
            tally.check(hit == found.first().copied(), || format!("{hit:?} instead of {found:?}: {ray:?}"));
            let exact = torus.crossings(&ray);
            if exact.len() != found.len() {
                let clear = !torus.is_near_limb(&ray, 4.0 * f64::EPSILON * torus.size());
                tally.check(!clear, || format!("{} crossings, not {}: {ray:?}", found.len(), exact.len()));
                continue;
            }
            for (c, t) in found.iter().zip(exact) {
                let cosine = torus.normal(&(&ray).into(), t).dot(ray.direction).abs();
                let error = (c.distance - t.value()).abs() * cosine / (f64::EPSILON * torus.size());
                tally.error(error, || format!("{c:?}, not {t:?}: {ray:?}"));
            }
        }
    })
    .share(0.1)
}
