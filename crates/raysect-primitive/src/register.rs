use raysect_core::save::Registry;

use crate::{Cuboid, Sphere};

/// Teaches a registry how the shapes of this crate are made of what a file says.
///
/// ```
/// let mut registry = raysect_core::save::Registry::new();
/// raysect_primitive::register(&mut registry);
/// ```
pub fn register(registry: &mut Registry) {
    registry.primitive("Cuboid", |entry| {
        Ok(Cuboid::new(entry.array("lower")?.into(), entry.array("upper")?.into())?)
    });
    registry.primitive("Sphere", |entry| Ok(Sphere::new(entry.number("radius")?)?));
}
