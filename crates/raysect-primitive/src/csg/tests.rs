//! Judges of composites: the contract, Boolean algebra, faces in common, rays that start again.

mod algebra;
mod coincidence;
mod contract;
mod flat;
mod restart;

use std::sync::Arc;

use raysect_core::{Crossing, Primitive, Ray, Scratch};
use raysect_math::{
    AffineMatrix3D, Point3D, Rng, SphereSampler, Vector3D, rotate, rotate_x, rotate_y, translate,
};

use super::{Intersect, Place, Subtract, Union};
use crate::{Cone, Cuboid, Cylinder, Parabola, Sphere};

type Shape = Arc<dyn Primitive>;

fn share(shape: impl Primitive) -> Shape {
    Arc::new(shape)
}

fn union(a: &Shape, b: &Shape) -> Shape {
    share(Union::new(a.clone(), b.clone()).unwrap())
}

fn intersect(a: &Shape, b: &Shape) -> Shape {
    share(Intersect::new(a.clone(), b.clone()).unwrap())
}

fn subtract(a: &Shape, b: &Shape) -> Shape {
    share(Subtract::new(a.clone(), b.clone()).unwrap())
}

/// The shape under a map, as a shape.
fn moved(shape: &Shape, m: AffineMatrix3D) -> Shape {
    // What has everything in common with something larger is itself.
    share(Union::new(shape.clone().placed(m), shape.clone().placed(m)).unwrap())
}

fn scale(s: f64) -> AffineMatrix3D {
    stretch(s, s, s)
}

fn stretch(x: f64, y: f64, z: f64) -> AffineMatrix3D {
    AffineMatrix3D::from_axes(Vector3D::X * x, Vector3D::Y * y, Vector3D::Z * z, Point3D::ORIGIN)
}

fn shear() -> AffineMatrix3D {
    AffineMatrix3D::from_axes(
        Vector3D::new(1.0, 0.3, -0.2),
        Vector3D::new(0.6, 1.4, 0.1),
        Vector3D::new(-0.3, 0.2, 0.7),
        Point3D::new(0.1, -0.2, 0.15),
    )
}

/// Turned to and fro and stretched and shrunk: the identity but for rounding, for a body of some size [m].
fn blurred(size: f64, rng: &mut Rng) -> AffineMatrix3D {
    let [yaw, pitch, roll] = [180.0, 90.0, 180.0].map(|limit| rng.range(-limit, limit));
    let [x, y, z] = [0, 1, 2].map(|_| size * rng.range(-1.0, 1.0));
    let m = translate(x, y, z) * rotate(yaw, pitch, roll) * scale(rng.range(0.3, 3.0));
    m * m.inverse().unwrap()
}

fn cuboid(lower: [f64; 3], upper: [f64; 3]) -> Shape {
    share(Cuboid::new(lower.into(), upper.into()).unwrap())
}

fn crossings(shape: &dyn Primitive, ray: &Ray) -> Vec<Crossing> {
    let mut out = Vec::new();
    shape.crossings(ray, &mut Scratch::default(), &mut out);
    out
}

/// A line through a uniform point of the ball around `centre`, from a few radii away.
fn line_through(centre: Point3D, radius: f64, rng: &mut Rng) -> Ray {
    let target = centre + SphereSampler.sample(rng) * (radius * rng.uniform().cbrt());
    let direction = SphereSampler.sample(rng);
    let speed = 10f64.powf(rng.range(-2.0, 2.0));
    Ray::new(target - direction * (radius * rng.range(1.0, 8.0)), direction * speed)
}

/// Three drill holes through the common part of a ball and a cube: 4 levels, shared operands.
fn drilled() -> Shape {
    let rod = Arc::new(Cylinder::new(1.0, 4.2).unwrap());
    let along_z = translate(0.0, 0.0, -2.1);
    let two = Union::new(
        rod.clone().placed(rotate_x(90.0) * along_z),
        rod.clone().placed(rotate_y(90.0) * along_z),
    );
    let holes = Union::new(two.unwrap(), rod.placed(along_z)).unwrap();
    let frame = Subtract::new(Cuboid::centred(3.0, 3.0, 3.0).unwrap(), holes).unwrap();
    share(Intersect::new(Sphere::new(2.0).unwrap(), frame).unwrap())
}

/// Bodies with transforms of all kinds, up to six levels deep.
fn bodies() -> Vec<(&'static str, Shape)> {
    let ball = share(Sphere::new(0.8).unwrap());
    let brick = cuboid([-0.7, -0.5, -0.6], [0.6, 0.8, 0.5]);
    let rod = share(Cylinder::new(0.4, 1.7).unwrap());
    let bowl = share(Parabola::new(0.6, 1.1).unwrap());
    let spike = share(Cone::new(0.5, 1.3).unwrap());
    let mirrored = moved(&spike, rotate(40.0, 30.0, 20.0) * stretch(1.0, -1.0, 1.2));
    let lens = intersect(&ball, &moved(&ball, translate(0.3, 0.2, 0.9)));
    let cup = subtract(&bowl, &moved(&bowl, translate(0.0, 0.0, -0.1)));
    let drilled = drilled();
    let sheared = moved(&drilled, shear());
    let chain = (0..4).fold(brick.clone(), |body, i| {
        let bite = moved(&ball, translate(0.9 - 0.5 * f64::from(i), 0.7, 0.3 * f64::from(i)) * scale(0.4));
        if i % 2 == 0 { subtract(&body, &bite) } else { union(&body, &bite) }
    });
    vec![
        ("union", union(&ball, &moved(&rod, rotate(20.0, 50.0, 0.0)))),
        ("intersect", intersect(&brick, &moved(&spike, translate(0.0, 0.1, -0.5)))),
        ("subtract", subtract(&brick, &moved(&rod, translate(0.1, 0.0, -0.8)))),
        ("apart", union(&ball, &moved(&brick, translate(3.0, 1.0, 0.0)))),
        ("shell", subtract(&ball, &moved(&ball, scale(0.9)))),
        ("mirrored", subtract(&ball, &mirrored)),
        ("lens", lens.clone()),
        ("cup", cup.clone()),
        ("drilled", drilled),
        ("sheared", sheared.clone()),
        ("chain", chain.clone()),
        ("deep", subtract(&union(&sheared, &chain), &moved(&cup, shear() * translate(0.5, 0.0, 0.2)))),
        ("tiny", moved(&chain, rotate(10.0, 20.0, 30.0) * scale(1e-9))),
        ("huge", moved(&drilled_in_place(), scale(1e9))),
        ("touching", union(&brick, &moved(&brick, translate(1.3, 0.0, 0.0)))),
        ("lens of lens", intersect(&lens, &moved(&lens, rotate(0.0, 35.0, 90.0)))),
    ]
}

fn drilled_in_place() -> Shape {
    moved(&drilled(), rotate(30.0, -20.0, 0.0))
}
