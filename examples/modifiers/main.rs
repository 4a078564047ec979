//! Materials made of others: sums, blends and tilted normals: `modifiers.png`.

#[path = "../common/arguments.rs"]
mod arguments;
#[path = "../common/paint.rs"]
mod paint;
#[path = "../common/shot.rs"]
mod shot;
#[path = "../common/studio.rs"]
mod studio;

use std::sync::Arc;

use clap::Parser;
use paint::paint;
use raysect::prelude::*;

/// Renders balls of blended, added and roughened materials.
#[derive(Parser)]
struct Arguments {
    #[command(flatten)]
    shot: shot::Shot,
}

fn main() -> raysect::Result<()> {
    let arguments = Arguments::parse();
    let mut world = studio::studio()?;
    let red: Arc<dyn Material> = Arc::new(paint(0.75, 0.12, 0.1)?);
    let mirror: Arc<dyn Material> = Arc::new(PerfectReflectingSurface);
    let glass: Arc<dyn Material> = Arc::new(schott("N-BK7")?);
    let amber = InterpolatedSf::new([375.0, 500.0, 620.0, 740.0], [0.0, 0.1, 0.5, 0.6])?;
    let lamp: Arc<dyn Material> = Arc::new(UniformSurfaceEmitter::new(amber, 0.5));
    let null: Arc<dyn Material> = Arc::new(NullMaterial);

    // Back: a varnish, the same of tilted normals, a satin mirror, frosted glass.
    let varnish: Arc<dyn Material> = Arc::new(Blend::new(red.clone(), mirror.clone(), 0.15)?);
    let materials: [(&str, Arc<dyn Material>); 8] = [
        ("varnish", varnish.clone()),
        ("satin varnish", Arc::new(Roughen::new(varnish, 0.15)?)),
        ("satin mirror", Arc::new(Roughen::new(mirror.clone(), 0.15)?)),
        ("frosted glass", Arc::new(Roughen::new(glass.clone(), 0.1)?)),
        // Front: a hot mirror, a veil, spotted glass, a blend within a blend.
        ("hot mirror", Arc::new(Add::new(Arc::new(Blend::new(mirror, red.clone(), 0.6)?), lamp))),
        ("veil", Arc::new(Blend::new(red.clone(), null, 0.5)?)),
        ("spotted glass", Arc::new(Blend::new(glass.clone(), red.clone(), 0.3)?)),
        ("milk glass", {
            let white: Arc<dyn Material> = Arc::new(Lambert::new(0.85));
            Arc::new(Blend::new(Arc::new(Blend::new(glass, white, 0.5)?), red, 0.1)?)
        }),
    ];
    for (number, (name, material)) in materials.into_iter().enumerate() {
        let (row, column) = (number / 4, number % 4);
        let place = translate(2.55 - 1.7 * column as f64, 0.7, 1.1 - 1.9 * row as f64);
        world.add(Sphere::new(0.7)?.material(material).transform(place).name(name))?;
    }
    arguments.shot.take("modifiers", &world, shot::viewpoint(10.5, 0.6, 22.0), 38.0)
}
