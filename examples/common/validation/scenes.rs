//! What the scenes of the cases are made of.

use std::sync::Arc;

use raysect::core::Node;
use raysect::optical::Optics;
use raysect::prelude::*;

use super::fault::{Fault, WrongDiffuse, WrongGlass};

/// What a case is measured with.
#[derive(Debug, Clone, Copy)]
pub(super) struct Bench {
    pub(super) seed: u64,
    pub(super) fault: Option<Fault>,
}

impl Bench {
    /// A diffuse surface.
    pub(super) fn lambert(&self, reflectivity: f64) -> Arc<dyn Material> {
        match self.fault {
            None | Some(Fault::Fresnel) => Arc::new(Lambert::new(reflectivity)),
            Some(fault) => Arc::new(WrongDiffuse { reflectivity, fault }),
        }
    }

    /// Glass of an index and a transmission per metre.
    pub(super) fn glass(&self, index: f64, transmission: f64) -> Result<Arc<dyn Material>, String> {
        let glass = Dielectric::new(index, transmission).map_err(wrong)?;
        Ok(match self.fault {
            Some(Fault::Fresnel) => Arc::new(WrongGlass(glass)),
            _ => Arc::new(glass),
        })
    }
}

/// Any error as a sentence.
pub(super) fn wrong(error: impl std::fmt::Display) -> String {
    error.to_string()
}

/// A box from its corners.
pub(super) fn cuboid(lower: [f64; 3], upper: [f64; 3]) -> Result<Cuboid, String> {
    Cuboid::new(Point3D::from(lower), Point3D::from(upper)).map_err(wrong)
}

/// A ball about a centre.
pub(super) fn ball(centre: [f64; 3], radius: f64, material: impl Material) -> Result<Node<Optics>, String> {
    let place = translate(centre[0], centre[1], centre[2]);
    Ok(Sphere::new(radius).map_err(wrong)?.material(material).transform(place))
}

/// A surface of radiance one.
pub(super) fn lamp() -> UniformSurfaceEmitter {
    UniformSurfaceEmitter::new(1.0, 1.0)
}

/// A closed emitter of radiance one that encloses a ball of a size about the origin by far.
pub(super) fn dome(size: f64) -> Result<Node<Optics>, String> {
    ball([0.0; 3], 60.0 * size, lamp())
}

/// A flat disk of radiance one that faces down the z axis at a height: the base of a cone so flat that nothing else
/// of it is seen from the plane z = 0 within a radius `seen`.
pub(super) fn disk_lamp(radius: f64, height: f64, seen: f64) -> Result<Node<Optics>, String> {
    let depth = 0.5 * height * radius / seen.max(radius);
    let cone = Cone::new(radius, depth).map_err(wrong)?;
    Ok(cone.material(lamp()).transform(translate(0.0, 0.0, height)))
}

/// A world of nodes, in this order.
pub(super) fn world(nodes: impl IntoIterator<Item = Node<Optics>>) -> Result<World, String> {
    let mut world = World::new();
    for node in nodes {
        world.add(node).map_err(wrong)?;
    }
    Ok(world)
}

/// The direction at an angle [deg] off the z axis, towards x.
pub(super) fn tilted(degrees: f64) -> [f64; 3] {
    let (sine, cosine) = degrees.to_radians().sin_cos();
    [sine, 0.0, cosine]
}

/// A vector times a number.
pub(super) fn times(v: [f64; 3], factor: f64) -> [f64; 3] {
    v.map(|x| x * factor)
}
