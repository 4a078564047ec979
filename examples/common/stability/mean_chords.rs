//! The mean chord of isotropic, uniform lines is four volumes over the area (A. Cauchy 1841; L. A. Santaló, *Integral
//! Geometry and Geometric Probability*, 1976, § 14.7); for solids that are not convex, the mean length inside over the
//! mean number of stretches.

use raysect::core::{Ray, Scratch};
use raysect::math::{AffineMatrix3D, Rng, SphereSampler, Statistics, sampling};

use super::Cell;
use super::bodies::{self, Body};
use super::wrong::{Fault, Wrong};

/// Standard errors by which a mean may lie off.
const SIGMAS: f64 = 4.0;

pub(crate) fn cells() -> Vec<Cell> {
    let mut cells = Vec::new();
    for scale in [1e-9, 1.0, 1e9] {
        for body in bodies::all(scale).into_iter().filter(|b| b.volume.is_finite()) {
            let name = format!("{} {scale:e} m [standard errors]", body.name);
            cells.push(cell(name, body).share(10.0).core(scale == 1.0));
        }
    }
    cells
}

pub(crate) fn controls() -> Vec<Cell> {
    let all = ["sphere", "torus", "mesh bracket", "subtract", "meniscus"];
    let wrong = all.iter().flat_map(|name| {
        let body = bodies::named(name, 1.0);
        let (mut volume, mut area) = (body.clone(), body.clone());
        volume.volume *= 1.03;
        area.area *= 1.03;
        let longer = body.with_shape(Wrong(body.shape.clone(), Fault::Stretches(0.03)));
        [("volume", volume), ("area", area), ("chords", longer)]
            .map(|(what, b)| (format!("{what} of {name}"), b))
    });
    wrong.map(|(name, body)| cell(format!("{name} 3 % too large"), body).share(10.0)).collect()
}

/// The mean length inside over lines that meet a ball about the body is 4 V over the area of the ball, the mean number of
/// crossings 2 S over it.
fn cell(name: String, body: Body) -> Cell {
    Cell::new(name, SIGMAS, move |rays, tally| {
        // Larger than the body, so that some lines miss it.
        let mut ball = body.shape.bounding_sphere(&AffineMatrix3D::IDENTITY);
        ball.radius *= 1.1;
        let mut rng = Rng::new(91);
        let (mut scratch, mut found) = (Scratch::default(), Vec::new());
        let (mut lengths, mut counts) = (Statistics::new(), Statistics::new());
        for _ in 0..rays {
            let direction = SphereSampler.sample(&mut rng);
            let (x, p) =
                (direction.orthogonal().unwrap(), sampling::disk::sample(sampling::uniforms(&mut rng)));
            let target = ball.centre + (x * p.x + direction.cross(x) * p.y) * ball.radius;
            found.clear();
            body.shape.crossings(&Ray::new(target, direction), &mut scratch, &mut found);
            tally.ray();
            let inside: f64 =
                found.chunks(2).map(|pair| pair[pair.len() - 1].distance - pair[0].distance).sum();
            lengths.add(inside / ball.radius);
            counts.add(found.len() as f64);
        }
        let area = 4.0 * std::f64::consts::PI * ball.radius * ball.radius;
        for (what, statistics, expected) in [
            ("length", &lengths, 4.0 * body.volume / area / ball.radius),
            ("number", &counts, 2.0 * body.area / area),
        ] {
            let z = (statistics.mean() - expected) / statistics.error();
            tally.error(z.abs(), || format!("mean {what} {statistics}, not {expected}: z = {z:.1}"));
        }
        let noise = lengths.error() / lengths.mean();
        tally.check(noise * (rays as f64).sqrt() < 5.0, || format!("relative error {noise}"));
    })
}
