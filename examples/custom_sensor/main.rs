//! A sensor of one's own: a small ball that sees all around, tested against the contract and aimed at a lamp.

use std::f64::consts::PI;

use clap::Parser;
use raysect::core::Ray;
use raysect::math::sampling::{hemisphere, sphere, uniforms};
use raysect::math::{Frame, Rng};
use raysect::observer::testing::check_sensor;
use raysect::observer::{Estimate, FrameShape};
use raysect::prelude::{
    Node, Observer, Point3D, PowerPipeline2D, Sensor, Sphere, UniformSurfaceEmitter, Vector3D, WithMaterial,
    World, translate,
};

/// Tests a user's own sensor against the contract of all sensors, and compares what it collects with closed forms.
#[derive(Parser)]
struct Arguments {
    /// Samples of each measurement.
    #[arg(long, default_value_t = 200_000)]
    samples: u64,
    /// Prints nothing but errors.
    #[arg(long)]
    quiet: bool,
}

/// A ball of a radius [m] about the origin: every point of its surface sees the half space in front of it.
#[derive(Clone)]
struct Bead {
    radius: f64,
}

impl Sensor for Bead {
    fn shape(&self) -> FrameShape {
        FrameShape::Single
    }
    fn sample_ray(&self, _: usize, rng: &mut Rng) -> Ray {
        let normal = sphere::sample(uniforms(rng));
        let direction = Frame::from_z(normal).to_world(hemisphere::sample_cosine(uniforms(rng)));
        Ray::new(Point3D::ORIGIN + normal * self.radius, direction)
    }
    fn pdf(&self, pixel: usize, origin: Point3D, direction: Vector3D) -> Option<f64> {
        Some(self.origin_pdf(pixel, origin)? * self.cosine(pixel, origin, direction) / PI)
    }
    fn origin_pdf(&self, _: usize, _: Point3D) -> Option<f64> {
        Some(1.0 / (4.0 * PI * self.radius * self.radius))
    }
    fn cosine(&self, _: usize, origin: Point3D, direction: Vector3D) -> f64 {
        (origin.to_vector().dot(direction) / self.radius).max(0.0)
    }
    fn etendue(&self, _: usize) -> Option<f64> {
        Some(4.0 * PI * PI * self.radius * self.radius)
    }
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let arguments = Arguments::parse();
    let bead = Bead { radius: 1e-3 };
    check_sensor(&bead, 10_000, 1)?;

    // In a closed emitter of radiance 1 it collects its étendue, and from a distant lamp what its disk does.
    let mut room = World::new();
    room.add(lamp(10.0)?)?;
    let mut hall = World::new();
    let far = hall.add(lamp(0.5)?.transform(translate(3.0, 0.0, 4.0)))?;

    let observer = Observer::with_sensor(bead.clone())
        .wavelengths(500.0, 501.0)
        .spectral_bins(1)
        .pixel_samples(arguments.samples)
        .quiet(true);
    let closed = power(&observer, &room)?;
    let aimed = power(&observer.aimed_at(&hall, &[far], 0.9)?, &hall)?;
    // From all sides a bead looks like a disk: it collects π r² times the solid angle of the lamp.
    let solid_angle = 2.0 * PI * (1.0 - (1.0 - 0.1f64 * 0.1).sqrt());
    let expected = [4.0 * PI * PI * 1e-6, PI * 1e-6 * solid_angle];
    if !arguments.quiet {
        println!("a bead keeps the contract of sensors");
        println!("in a closed emitter {closed} W, expected {:.6e} W", expected[0]);
        println!("from a distant lamp {aimed} W, expected {:.6e} W", expected[1]);
    }
    for (found, expected) in [closed, aimed].into_iter().zip(expected) {
        if (found.value - expected).abs() > 5.0 * found.error + 1e-6 * expected {
            return Err(format!("{found} W is not {expected:.6e} W").into());
        }
    }
    Ok(())
}

/// A ball of a radius [m] that shines with radiance 1 all over.
fn lamp(radius: f64) -> raysect::Result<Node<raysect::optical::Optics>> {
    Ok(Sphere::new(radius)?.material(UniformSurfaceEmitter::new(1.0, 1.0)))
}

fn power(observer: &Observer<impl Sensor>, world: &World) -> raysect::Result<Estimate> {
    let mut power = PowerPipeline2D::new();
    observer.observe(world, &mut power)?;
    Ok(power.frame().total())
}
