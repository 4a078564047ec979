//! Shapes within shapes, without optics: a hollow ball, a ring and a bored die in it, and a rod through everything.

use raysect::core::{CoreError, Node, NodeId, World};
use raysect::prelude::{
    Cuboid, Cylinder, Intersect, Place, Sphere, Subtract, Torus, Union, rotate_x, rotate_y, translate,
};

/// Radius of the whole \[m\].
pub(crate) const RADIUS: f64 = 2.0;

/// A shape, and its colour in pictures: red, green and blue, 0 to 1.
type Colour = (&'static str, [f64; 3]);

const COLOURS: [Colour; 5] = [
    ("shell", [0.20, 0.45, 0.95]),
    ("ring", [1.00, 0.62, 0.10]),
    ("die", [0.10, 0.80, 0.55]),
    ("kernel", [1.00, 0.25, 0.25]),
    ("rod", [0.85, 0.40, 0.95]),
];

/// Builds the shapes.
pub(crate) fn world() -> raysect::Result<World<()>> {
    let mut world = World::new();
    let shell = Subtract::new(Sphere::new(RADIUS)?, Sphere::new(0.93 * RADIUS)?)?;
    world.add(Node::of(shell, ()).name("shell"))?;
    let tilt = rotate_x(25.0);
    world.add(Node::of(Torus::new(1.35, 0.28)?, ()).transform(tilt).name("ring"))?;

    let rounded = Intersect::new(Cuboid::centred(1.1, 1.1, 1.1)?, Sphere::new(0.74)?)?;
    let bore = Cylinder::new(0.3, 2.0)?;
    let along_z = translate(0.0, 0.0, -1.0);
    let two = Union::new(bore.placed(rotate_y(90.0) * along_z), bore.placed(rotate_x(90.0) * along_z))?;
    let die = Subtract::new(rounded, Union::new(two, bore.placed(along_z))?)?;
    world.add(Node::of(die, ()).transform(tilt).name("die"))?;
    world.add(Node::of(Sphere::new(0.22)?, ()).name("kernel"))?;

    let rod = Node::of(Cylinder::new(0.12, 2.4 * RADIUS)?, ());
    let place = tilt * rotate_y(35.0) * translate(0.0, 0.0, -1.2 * RADIUS);
    world.add(rod.transform(place).name("rod"))?;
    Ok(world)
}

/// The colour of a shape.
pub(crate) fn colour(world: &World<()>, node: NodeId) -> Result<[f64; 3], CoreError> {
    let name = world.name(node)?;
    let known = COLOURS.iter().find(|(other, _)| *other == name);
    Ok(known.map_or([1.0; 3], |(_, colour)| *colour))
}
