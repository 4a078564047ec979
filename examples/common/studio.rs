//! A studio for pictures of shapes: a pale ground, a large lamp, and a sky.

use raysect::optical::colour::d65_white;
use raysect::prelude::*;

/// A world with ground at y = 0, a square lamp to the upper left behind the camera, and a dim sky all around.
pub(crate) fn studio() -> raysect::Result<World> {
    let mut world = World::new();
    let ground = Cuboid::new(Point3D::new(-100.0, -1.0, -100.0), Point3D::new(100.0, 0.0, 100.0))?;
    world.add(ground.material(Lambert::new(0.45)).name("ground"))?;
    let lamp = Cuboid::centred(7.0, 7.0, 0.1)?.material(UniformSurfaceEmitter::new(d65_white(), 5.0));
    world.add(lamp.transform(translate(6.0, 9.0, -6.0) * rotate(45.0, -47.0, 0.0)).name("lamp"))?;
    let sky = Sphere::new(300.0)?.material(UniformSurfaceEmitter::new(d65_white(), 0.12));
    world.add(sky.name("sky"))?;
    Ok(world)
}
