//! One picture of a world: the arguments that several examples share, and the camera.

use std::path::PathBuf;

use clap::Args;
use raysect::prelude::*;

#[derive(Args)]
pub(crate) struct Shot {
    /// Columns and rows of the picture.
    #[arg(long, default_value = "512x288", value_parser = crate::arguments::pixels)]
    pixels: (usize, usize),
    /// Samples of each pixel.
    #[arg(long, default_value_t = 64)]
    samples: u64,
    /// Exposure: the inverse of the radiance that is drawn white [1/(W/m²/sr/nm)].
    #[arg(long, default_value_t = 1.6)]
    sensitivity: f64,
    /// The same seed gives the same bits.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Goes on from the statepoint beside the picture, if there is one, and writes it after each pass, so that a run that
    /// is killed can be resumed by the same command.
    #[arg(long)]
    resume: bool,
    /// Folder of the picture.
    #[arg(long, default_value = ".")]
    out: PathBuf,
    /// Prints nothing but errors.
    #[arg(long)]
    pub(crate) quiet: bool,
}

/// From `distance` [m] in front of a point of the axis at `height` [m], looking down by `pitch` [deg].
pub(crate) fn viewpoint(distance: f64, height: f64, pitch: f64) -> AffineMatrix3D {
    translate(0.0, height, 0.0) * rotate(0.0, -pitch, 0.0) * translate(0.0, 0.0, -distance)
}

impl Shot {
    /// Takes the picture `name`.png with a field of view [deg].
    pub(crate) fn take(
        &self,
        name: &str,
        world: &World,
        from: AffineMatrix3D,
        view: f64,
    ) -> raysect::Result<()> {
        std::fs::create_dir_all(&self.out)?;
        let picture = self.out.join(name).with_extension("png");
        let mut camera = PinholeCamera::new(self.pixels, view)?
            .transform(from)
            .pixel_samples(self.samples)
            .seed(self.seed)
            .quiet(self.quiet);
        let mut rgb = RgbPipeline2D::new().sensitivity(self.sensitivity)?.preview(&picture);
        if self.resume {
            let statepoint = picture.with_extension("statepoint");
            camera = camera.statepoint(&statepoint);
            if camera.resume(world, &mut rgb)? && !self.quiet {
                println!("going on from {}", statepoint.display());
            }
        }
        let report = camera.observe_until(world, &mut rgb, Stop::samples(self.samples))?;
        rgb.save(&picture)?;
        if !self.quiet {
            println!("{report}\n");
            println!("wrote {}", picture.display());
        }
        Ok(())
    }
}
