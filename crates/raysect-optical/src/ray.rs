use raysect_math::{MathError, Point3D, Rng, StreamKey, Vector3D};

use crate::{Ledger, LoggedPath, OpticalError, Path, PathSettings, Scene, Slice, Slicing, Spectrum, World};

/// A single ray that asks for the spectrum arriving at its origin, without any camera.
///
/// ```
/// use raysect_core::Node;
/// use raysect_math::{Point3D, Vector3D};
/// use raysect_optical::{Optics, Ray, UniformSurfaceEmitter, World};
/// # use raysect_primitive::Sphere;
/// let mut world = World::new();
/// world.add(Node::of(Sphere::new(1.0)?, Optics::new(UniformSurfaceEmitter::new(2.0, 1.0))))?;
/// let ray = Ray::new(Point3D::new(0.0, 0.0, -5.0), Vector3D::Z).spectrum(400.0, 500.0, 4);
/// assert_eq!(ray.trace(&world)?.samples(), [2.0; 4]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct Ray {
    geometry: raysect_core::Ray,
    min: f64,
    max: f64,
    bins: usize,
    seed: u64,
    settings: PathSettings,
}

/// The mean spectrum of many paths, with its standard error.
#[derive(Debug, Clone, PartialEq)]
pub struct SampledSpectrum {
    /// The mean [W/m²/sr/nm].
    pub mean: Spectrum,
    /// Standard error of each bin [W/m²/sr/nm]; infinite for a single path.
    pub error: Vec<f64>,
    /// The integral over the range, with its own standard error [W/m²/sr].
    pub total: raysect_math::Statistics,
    /// How many paths.
    pub samples: u64,
    /// How many of them had a bin that is not a finite number, and count as zero: a fault in a material.
    pub invalid: u64,
    /// What has become of them: what was cut off, lost or left unresolved is missing from the mean.
    pub ledger: Ledger,
}

impl Ray {
    /// From a point [m] along a direction of any length, with 40 bins over 375 … 785 nm.
    pub fn new(origin: Point3D, direction: Vector3D) -> Self {
        Self {
            geometry: raysect_core::Ray::new(origin, direction),
            min: 375.0,
            max: 785.0,
            bins: 40,
            seed: 1,
            settings: PathSettings::default(),
        }
    }

    /// Over a range of wavelengths [nm] in bins.
    #[doc(alias("min_wavelength", "max_wavelength", "wavelength_range", "bins"))]
    pub fn spectrum(self, min: f64, max: f64, bins: usize) -> Self {
        Self { min, max, bins, ..self }
    }

    /// With an end, in units of the direction's length.
    pub fn max_distance(mut self, max_distance: f64) -> Self {
        self.geometry.max_distance = max_distance;
        self
    }

    /// With another seed; the same seed gives the same numbers.
    pub fn seed(self, seed: u64) -> Self {
        Self { seed, ..self }
    }

    /// With other settings of its paths.
    pub fn settings(self, settings: PathSettings) -> Self {
        Self { settings, ..self }
    }

    /// Where it begins and ends, as set.
    pub fn geometry(&self) -> &raysect_core::Ray {
        &self.geometry
    }

    /// The range of wavelengths and its bins, all in one slice.
    ///
    /// # Errors
    /// [`OpticalError::Slicing`] for an impossible range.
    #[doc(alias("min_wavelength", "max_wavelength", "wavelength_range", "bins"))]
    pub fn slicing(&self) -> Result<Slicing, OpticalError> {
        Slicing::new(self.min, self.max, self.bins, 1)
    }

    /// The seed, as set.
    pub fn seed_value(&self) -> u64 {
        self.seed
    }

    /// The settings of its paths.
    pub fn path_settings(&self) -> &PathSettings {
        &self.settings
    }

    /// The spectrum along one path.
    ///
    /// # Errors
    /// [`OpticalError::Core`] for a ray that leads nowhere or a scene that cannot be compiled,
    /// [`OpticalError::Slicing`] for an impossible range, and what a material says of it.
    pub fn trace(&self, world: &World) -> Result<Spectrum, OpticalError> {
        Ok(self.sample(world, 1)?.mean)
    }

    /// The mean spectrum of a number of independent paths.
    ///
    /// # Errors
    /// As [`trace`](Self::trace), and [`OpticalError::Math`] for no paths.
    pub fn sample(&self, world: &World, count: u64) -> Result<SampledSpectrum, OpticalError> {
        MathError::check(count >= 1, count as f64, "number of paths", "", "1 or more")?;
        let (scene, slices) = self.prepare(world)?;
        let slice = &slices[0];
        let mut path = Path::new(scene, slice, &self.settings);
        let mut bins = vec![raysect_math::Statistics::new(); self.bins];
        let (mut total, mut invalid) = (raysect_math::Statistics::new(), 0);
        let dark = vec![0.0; self.bins];
        for sample in 0..count {
            let mut radiance = path.follow(&self.geometry, self.rng(sample));
            if radiance.iter().any(|r| !r.is_finite()) {
                (radiance, invalid) = (&dark, invalid + 1);
            }
            bins.iter_mut().zip(radiance).for_each(|(s, r)| s.add(*r));
            total.add(radiance.iter().sum::<f64>() * slice.bin_width());
        }
        let mean = Spectrum::from_samples(self.min, self.max, bins.iter().map(|s| s.mean()).collect())?;
        let error = bins.iter().map(|s| s.error()).collect();
        Ok(SampledSpectrum { mean, error, total, samples: count, invalid, ledger: *path.ledger() })
    }

    /// Follows one of the paths of [`sample`](Self::sample) again, by its number, and notes all that happens to it; number
    /// 0 is that of [`trace`](Self::trace).
    ///
    /// # Errors
    /// As [`trace`](Self::trace).
    #[doc(alias("LoggedRay", "path_vertices", "ray_count"))]
    pub fn replay(&self, world: &World, sample: u64) -> Result<LoggedPath, OpticalError> {
        let (scene, slices) = self.prepare(world)?;
        let mut path = Path::new(scene, &slices[0], &self.settings);
        Ok(path.follow_logged(&self.geometry, self.rng(sample)).with_names(world))
    }

    /// The random numbers of a path.
    fn rng(&self, sample: u64) -> Rng {
        Rng::keyed(StreamKey { seed: self.seed, sample, ..StreamKey::default() })
    }

    /// Scene and the one slice of all bins, if paths can be followed with them.
    fn prepare<'w>(&self, world: &'w World) -> Result<(&'w Scene, Vec<Slice>), OpticalError> {
        self.geometry.check()?;
        let scene = world.scene()?;
        let slices = self.slicing()?.slices();
        for instance in &scene.instances {
            instance.attached.material().check(&slices[0])?;
        }
        Ok((scene, slices))
    }
}
