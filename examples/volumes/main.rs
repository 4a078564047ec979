//! What fills volumes: light, shade and fog: `volumes.png`, and chords beside their closed forms.

#[path = "../common/arguments.rs"]
mod arguments;
mod chords;
#[path = "../common/shot.rs"]
mod shot;
#[path = "../common/studio.rs"]
mod studio;

use std::sync::Arc;

use chords::{blob_of_light, chords, placement};
use clap::Parser;
use raysect::prelude::*;

/// Renders balls of a uniform glow, of blobs of light, of shade and of fog, and compares chords with closed forms.
#[derive(Parser)]
#[command(mut_arg("pixels", |pixels| pixels.default_value("384x144")))]
#[command(mut_arg("samples", |samples| samples.default_value("40")))]
struct Arguments {
    #[command(flatten)]
    shot: shot::Shot,
}

fn main() -> raysect::Result<()> {
    let arguments = Arguments::parse();
    if !arguments.shot.quiet {
        println!(
            "{:<38} {:<14} {:<14} {:<12} standard error",
            "chord [W/m²/sr/nm]", "traced", "exact", "difference"
        );
        for chord in chords()? {
            let (seen, difference) = (chord.seen.value, chord.seen.value - chord.expected);
            // A path through volumes without scattering has no noise.
            let error = if chord.seen.error.is_finite() {
                format!("{:.1e}", chord.seen.error)
            } else {
                "none".to_owned()
            };
            println!("{:<38} {seen:<14.9} {:<14.9} {difference:<12.1e} {error}", chord.name, chord.expected);
        }
        println!();
    }
    arguments.shot.take("volumes", &world()?, shot::viewpoint(10.5, 0.7, 16.0), 52.0)
}

/// Five balls in a studio.
fn world() -> raysect::Result<World> {
    let mut world = studio::studio()?;
    let amber = InterpolatedSf::new([375.0, 500.0, 620.0, 740.0], [0.0, 0.1, 0.6, 0.7])?;
    let not_blue = InterpolatedSf::new([375.0, 470.0, 560.0, 740.0], [0.1, 0.1, 1.6, 2.0])?;
    let green = |wavelength: f64| 4.0 * (-0.5 * ((wavelength - 530.0) / 35.0).powi(2)).exp();
    let violet = |wavelength: f64| 6.0 * (-0.5 * ((wavelength - 445.0) / 30.0).powi(2)).exp();
    let materials: [(&str, Arc<dyn Material>); 5] = [
        ("glow", Arc::new(UniformVolume::emitter(amber).absorption(0.4))),
        ("blob", Arc::new(blob_of_light(green)?)),
        ("shade", Arc::new(UniformVolume::new().absorption(not_blue))),
        ("moved blob", Arc::new(VolumeTransform::new(Arc::new(blob_of_light(violet)?), placement())?)),
        ("fog", Arc::new(UniformVolume::new().scattering(2.5, HenyeyGreenstein::new(0.3)?))),
    ];
    for (number, (name, material)) in materials.into_iter().enumerate() {
        let place = translate(3.8 - 1.9 * number as f64, 0.9, 0.0);
        world.add(Sphere::new(0.85)?.material(material).transform(place).name(name))?;
    }
    Ok(world)
}
