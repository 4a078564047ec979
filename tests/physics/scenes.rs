//! The scenes of the cases: all of balls and boxes.

use raysect::core::Node;
use raysect::math::{Point3D, translate};
use raysect::optical::{Lambert, Material, Optics, UniformSurfaceEmitter, WithMaterial, World};
use raysect::primitive::{Cuboid, Sphere};

/// A box from its corners.
pub(crate) fn cuboid(lower: [f64; 3], upper: [f64; 3]) -> Cuboid {
    Cuboid::new(Point3D::from(lower), Point3D::from(upper)).unwrap()
}

/// A ball about a centre.
pub(crate) fn ball(centre: [f64; 3], radius: f64, material: impl Material) -> Node<Optics> {
    Sphere::new(radius).unwrap().material(material).transform(translate(centre[0], centre[1], centre[2]))
}

/// An emitter of radiance one.
pub(crate) fn lamp() -> UniformSurfaceEmitter {
    UniformSurfaceEmitter::new(1.0, 1.0)
}

/// A world of nodes, in this order.
pub(crate) fn world(nodes: impl IntoIterator<Item = Node<Optics>>) -> World {
    let mut world = World::new();
    for node in nodes {
        world.add(node).unwrap();
    }
    world
}

/// A closed emitter of radiance one far around the origin.
pub(crate) fn dome() -> Node<Optics> {
    ball([0.0; 3], 60.0, lamp())
}

/// A plate of 2 m × 2 m whose upper side is the plane z = 0.
pub(crate) fn plate(material: impl Material) -> Node<Optics> {
    cuboid([-1.0, -1.0, -0.01], [1.0, 1.0, 0.0]).material(material)
}

/// The direction at an angle [deg] off the z axis, towards x.
pub(crate) fn tilted(degrees: f64) -> [f64; 3] {
    let (sine, cosine) = degrees.to_radians().sin_cos();
    [sine, 0.0, cosine]
}

/// A vector times a number.
pub(crate) fn times(v: [f64; 3], factor: f64) -> [f64; 3] {
    v.map(|x| x * factor)
}

/// A lamp ball of a radius at a distance and an angle [deg] off the normal of the plate.
pub(crate) fn ball_lamp(radius: f64, distance: f64, degrees: f64) -> Node<Optics> {
    ball(times(tilted(degrees), distance), radius, lamp())
}

/// A Lambert plate of reflectivity 0.7 under a ball lamp.
pub(crate) fn lit_plate(radius: f64, distance: f64, degrees: f64) -> Vec<Node<Optics>> {
    vec![plate(Lambert::new(0.7)), ball_lamp(radius, distance, degrees)]
}

/// Where a plate is looked at from, past the lamps: its origin in the direction [`VIEW`].
pub(crate) const EYE: [f64; 3] = [-0.8, 0.3, 1.1];
/// From [`EYE`] to the origin.
pub(crate) const VIEW: [f64; 3] = [0.8, -0.3, -1.1];
