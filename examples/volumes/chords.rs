//! Chords through volumes whose radiance has a closed form.

use std::f64::consts::TAU;
use std::sync::Arc;

use raysect::prelude::*;

/// A chord, and what is seen along it.
pub(crate) struct Chord {
    pub(crate) name: String,
    /// One bin over 1 nm, and the number of paths.
    pub(crate) seen: Estimate,
    /// The closed form [W/m²/sr/nm].
    pub(crate) expected: f64,
}

/// All balls here have a radius of 2 m.
const RADIUS: f64 = 2.0;
/// Standard deviations of a blob of light along x, y and z [m].
const BLOB: [f64; 3] = [0.24, 0.14, 0.18];
/// Where the blob is moved, and the angle by which it is turned about z [deg].
const MOVED: ([f64; 2], f64) = ([0.2, 0.1], 30.0);

/// Emission of a blob of light at a point, relative to its centre.
pub(crate) fn blob([x, y, z]: [f64; 3]) -> f64 {
    let squared = [x, y, z].iter().zip(BLOB).map(|(p, width)| (p / width).powi(2)).sum::<f64>();
    (-0.5 * squared).exp()
}

/// All chords.
pub(crate) fn chords() -> raysect::Result<Vec<Chord>> {
    let mut all = Vec::new();
    for place in [[0.0, 0.0], [1.2, 0.0], [1.4, 1.4]] {
        all.push(glow(place)?);
    }
    for place in [[0.0, 0.0], [0.2, 0.1]] {
        all.push(peak(place)?);
    }
    for place in [[0.2, 0.1], [0.4, 0.2], [0.1, 0.3]] {
        all.push(moved(place)?);
    }
    for place in [[0.0, 0.0], [1.6, 0.0]] {
        all.push(shade(place)?);
    }
    all.push(fog([0.3, 0.2])?);
    Ok(all)
}

/// Looks along z through a ball at a place in the plane z = 0.
fn look(
    name: &str,
    place: [f64; 2],
    material: impl Material,
    sky: Option<f64>,
    paths: u64,
    expected: f64,
) -> raysect::Result<Chord> {
    let mut world = World::new();
    world.add(Sphere::new(RADIUS)?.material(material))?;
    if let Some(radiance) = sky {
        world.add(Sphere::new(50.0)?.material(UniformSurfaceEmitter::new(radiance, 1.0)))?;
    }
    let ray = Ray::new(Point3D::new(place[0], place[1], -5.0), Vector3D::Z).spectrum(500.0, 501.0, 1);
    let sampled = ray.sample(&world, paths)?;
    let seen = Estimate { value: sampled.total.mean(), error: sampled.total.error() };
    Ok(Chord { name: format!("{name} at ({}, {}) m", place[0], place[1]), seen, expected })
}

/// Length of the chord [m].
fn length([x, y]: [f64; 2]) -> f64 {
    2.0 * (RADIUS * RADIUS - x * x - y * y).sqrt()
}

/// A uniform glow that attenuates itself: j (1 − exp(−α s)) / α.
fn glow(place: [f64; 2]) -> raysect::Result<Chord> {
    let (emission, attenuation) = (3.0, 0.8);
    let expected = emission * (1.0 - (-attenuation * length(place)).exp()) / attenuation;
    look("glow", place, UniformVolume::emitter(emission).absorption(attenuation), None, 1, expected)
}

/// A Gaussian: its peak on the chord times √(2π) times its width along it. The ball ends ten widths
/// away.
fn peak([x, y]: [f64; 2]) -> raysect::Result<Chord> {
    let expected = TAU.sqrt() * BLOB[2] * blob([x, y, 0.0]);
    look("blob", [x, y], blob_of_light(1.0)?, None, 1, expected)
}

/// The same, turned and moved within the ball.
fn moved([x, y]: [f64; 2]) -> raysect::Result<Chord> {
    let ([left, up], angle) = MOVED;
    let (sine, cosine) = angle.to_radians().sin_cos();
    let (dx, dy) = (x - left, y - up);
    let expected = TAU.sqrt() * BLOB[2] * blob([cosine * dx + sine * dy, cosine * dy - sine * dx, 0.0]);
    let material = VolumeTransform::new(Arc::new(blob_of_light(1.0)?), placement())?;
    look("moved blob", [x, y], material, None, 1, expected)
}

/// An absorber in front of a sky of radiance 2: 2 exp(−α s).
fn shade(place: [f64; 2]) -> raysect::Result<Chord> {
    let expected = 2.0 * (-1.5 * length(place)).exp();
    look("shade", place, UniformVolume::new().absorption(1.5), Some(2.0), 1, expected)
}

/// A fog that scatters, absorbs, and emits as a body as warm as the sky does: nobody sees it.
fn fog(place: [f64; 2]) -> raysect::Result<Chord> {
    let warm = UniformVolume::emitter(0.7 * 2.0).absorption(0.7);
    let fog = warm.scattering(3.0, HenyeyGreenstein::new(0.5)?);
    look("fog as warm as the sky", place, fog, Some(2.0), 20_000, 2.0)
}

/// A blob of light of a colour.
pub(crate) fn blob_of_light(colour: impl Into<SpectralTable>) -> raysect::Result<impl Material> {
    let colour = colour.into();
    Ok(InhomogeneousVolumeEmitter::length_scale(BLOB[1], move |p, _, at, bins| {
        let strength = blob([p.x, p.y, p.z]);
        bins.iter_mut().zip(at.slice.table(&colour)).for_each(|(bin, c)| *bin += strength * c);
    })?)
}

/// Where the moved blob is.
pub(crate) fn placement() -> AffineMatrix3D {
    let ([left, up], angle) = MOVED;
    translate(left, up, 0.0) * rotate_z(angle)
}
