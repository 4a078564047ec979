//! The paths of one sample, followed again.

use raysect_math::AffineMatrix3D;
use raysect_optical::{LoggedPath, Path, Scene, Slice, World};

use super::draw::{Drawn, draw};
use crate::strata::Strata;
use crate::{Observer, ObserverError, Sensor};

/// A path of a sample that has been followed again.
#[derive(Debug, Clone, PartialEq)]
pub struct Replay {
    /// Number of the slice of the spectrum that it carries.
    pub slice: usize,
    /// Number of the first bin of the slice in the whole spectrum.
    pub offset: usize,
    /// By how much its radiance counts: the sample is this times [`LoggedPath::radiance`].
    pub weight: f64,
    /// What has happened to it.
    pub path: LoggedPath,
}

/// What paths need besides a sensor: the scene, the slices of the spectrum, and the place of the sensor, if all of it
/// is possible.
pub(super) fn prepare<'w, S: Sensor>(
    observer: &Observer<S>,
    world: &'w World,
) -> Result<(&'w Scene, Vec<Slice>, AffineMatrix3D), ObserverError> {
    let scene = world.scene()?;
    let slices = observer.slicing()?.slices();
    for instance in &scene.instances {
        for slice in &slices {
            instance.attached.material().check(slice)?;
        }
    }
    let to_world = observer.to_root(world)?;
    to_world.inverse()?;
    Ok((scene, slices, to_world))
}

impl<S: Sensor> Observer<S> {
    /// Follows the paths of one sample of a pixel again, one for each slice of the spectrum, from nothing but the seed,
    /// the lane and the numbers of pixel and sample, and notes all that happens to them. Pixels are numbered row by row,
    /// and samples from 0 up to [`pixel_samples`](Self::pixel_samples); for the later samples of an observation that was
    /// continued, or ended by a rule, that must be the number which its frame has.
    ///
    /// The mean of weight × radiance over all samples is that of the frame, in which samples that are not finite count
    /// nothing.
    ///
    /// ```
    /// # use raysect_observer::{PinholeCamera, RgbPipeline2D};
    /// # use raysect_optical::{UniformSurfaceEmitter, WithMaterial, World};
    /// # use raysect_primitive::Sphere;
    /// # let mut world = World::new();
    /// # world.add(Sphere::new(10.0)?.material(UniformSurfaceEmitter::new(1.0, 1.0)))?;
    /// let camera = PinholeCamera::new((16, 16), 45.0)?.pixel_samples(10);
    /// for replay in camera.replay(&world, 5 * 16 + 3, 7)? {
    ///     println!("{}", replay.path);
    /// }
    /// assert!(camera.replay(&world, 16 * 16, 0).is_err() && camera.replay(&world, 0, 10).is_err());
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`ObserverError::NoPixel`] and [`ObserverError::NoSample`] beyond the limits, [`ObserverError::MaskedPixel`] for a
    /// pixel that a mask leaves out, and whatever makes the scene or the range impossible.
    #[doc(alias("LoggedRay", "path_vertices"))]
    pub fn replay(&self, world: &World, pixel: usize, sample: u64) -> Result<Vec<Replay>, ObserverError> {
        let (shape, samples) = (self.sensor().shape(), self.samples_per_observation());
        if pixel >= shape.pixels() {
            return Err(ObserverError::NoPixel { pixel, shape });
        }
        if !self.checked_mask()?[pixel] {
            return Err(ObserverError::MaskedPixel { pixel });
        }
        if sample >= samples {
            return Err(ObserverError::NoSample { sample, samples });
        }
        let (scene, slices, to_world) = prepare(self, world)?;
        let lane = self.lane_number();
        let stratum = Strata::default().of(self.seed_value(), lane, pixel, sample);
        let replays = slices.iter().map(|slice| {
            let Drawn { ray, weight, rng } = draw(self, &to_world, slice, (lane, pixel, sample), stratum);
            let path = Path::new(scene, slice, self.path_settings()).follow_logged(&ray, rng);
            Replay { slice: slice.index, offset: slice.offset, weight, path: path.with_names(world) }
        });
        Ok(replays.collect())
    }
}
