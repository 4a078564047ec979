//! Sets of rays for measurements of speed.

use raysect::core::Ray;
use raysect::math::{Point3D, Rng, Vector3D};

/// How rays follow each other.
#[derive(Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
pub(crate) enum Order {
    /// From one place, row by row, like the pixels of a camera.
    Coherent,
    /// From everywhere to everywhere, like the bounces of light.
    Incoherent,
}

/// A pinhole camera of `side`² pixels with 45 degrees of view, three radii in front of a ball.
fn coherent(centre: Point3D, radius: f64, side: usize) -> Vec<Ray> {
    let width = 2.0 * (22.5f64.to_radians()).tan();
    let at = |i: usize| ((i as f64 + 0.5) / side as f64 - 0.5) * width;
    let origin = centre - Vector3D::Z * (3.0 * radius);
    let pixels = (0..side * side).map(|i| (at(i % side), -at(i / side)));
    pixels.map(|(x, y)| Ray::new(origin, Vector3D::new(x, y, 1.0).normalise_unchecked())).collect()
}

/// From random points on a sphere of two radii towards random points of a ball.
fn incoherent(centre: Point3D, radius: f64, count: usize) -> Vec<Ray> {
    let mut rng = Rng::new(1);
    (0..count)
        .map(|_| {
            let direction = |rng: &mut Rng| {
                let (z, phi) = (rng.range(-1.0, 1.0), rng.range(0.0, std::f64::consts::TAU));
                let r = (1.0 - z * z).sqrt();
                Vector3D::new(r * phi.cos(), r * phi.sin(), z)
            };
            let origin = centre + direction(&mut rng) * (2.0 * radius);
            let target = centre + direction(&mut rng) * (radius * rng.uniform().cbrt());
            Ray::new(origin, origin.vector_to(target).normalise_unchecked())
        })
        .collect()
}

/// About `count` rays that look at a ball.
pub(crate) fn rays(order: Order, centre: Point3D, radius: f64, count: usize) -> Vec<Ray> {
    match order {
        Order::Coherent => coherent(centre, radius, (count as f64).sqrt().round() as usize),
        Order::Incoherent => incoherent(centre, radius, count),
    }
}
