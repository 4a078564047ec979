//! The scene of Raysect's quickstart: a glass ball on the ground, in front of a luminous chequered wall.

use raysect::optical::colour::d65_white;
use raysect::prelude::*;

/// Builds the scene; the ball stands at the origin.
pub(crate) fn world() -> raysect::Result<World> {
    let mut world = World::new();

    let ground = Cuboid::new(Point3D::new(-50.0, -1.51, -50.0), Point3D::new(50.0, -1.5, 50.0))?;
    world.add(ground.material(Lambert::new(0.5)).name("ground"))?;

    // Squares of 4 m in the white of daylight, the bright ones twenty times as bright as the dim ones.
    let wall = Cuboid::new(Point3D::new(-10.0, -10.0, 10.0), Point3D::new(10.0, 10.0, 10.1))?;
    let squares = Checkerboard::new(4.0)?.spectra((d65_white(), 0.1), (d65_white(), 2.0));
    world.add(wall.material(squares).transform(rotate(45.0, 0.0, 0.0)).name("wall"))?;

    // A tenth of a millimetre above the ground.
    let ball = Sphere::new(1.5)?;
    world.add(ball.material(schott("N-BK7")?).transform(translate(0.0, 0.0001, 0.0)).name("ball"))?;
    Ok(world)
}

/// Where the camera stands: above and in front, looking down at the ball along its z axis.
pub(crate) fn viewpoint() -> AffineMatrix3D {
    translate(0.0, 10.0, -10.0) * rotate(0.0, -45.0, 0.0)
}
