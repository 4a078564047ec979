use std::fmt;
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use raysect_core::save::{Entry, MakeError, SaveError, Saved, SceneWriter, Storable};
use raysect_core::{Engine, Multicore, NodeId};
use raysect_math::AffineMatrix3D;
use raysect_optical::{PathSettings, Slicing, World};

use crate::observe::Session;
use crate::progress::{Progress, Watcher};
use crate::{AdaptiveSampling, ObserverError, Pipelines, Plan, RenderReport, Sensor, Statepoint, Stop};

/// A handle that ends an observation from elsewhere; what is finished is kept.
#[derive(Debug, Clone, Default)]
pub struct CancelToken(Arc<AtomicBool>);

impl CancelToken {
    /// A handle that has not been used yet.
    pub fn new() -> Self {
        Self::default()
    }

    /// Ends every observation that holds a clone of this handle.
    pub fn cancel(&self) {
        self.0.store(true, Ordering::Relaxed);
    }

    /// True after [`cancel`](Self::cancel).
    pub fn is_cancelled(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }
}

/// A sensor placed in the world, with everything that says how it observes.
///
/// ```
/// use raysect_math::translate;
/// use raysect_observer::{PinholeCamera, RgbPipeline2D};
/// use raysect_optical::{UniformSurfaceEmitter, WithMaterial, World};
/// # use raysect_primitive::Sphere;
/// let mut world = World::new();
/// world.add(Sphere::new(1.0)?.material(UniformSurfaceEmitter::new(1.0, 1.0)))?;
///
/// let camera = PinholeCamera::new((16, 16), 45.0)?.transform(translate(0.0, 0.0, -5.0)).pixel_samples(10);
/// let mut rgb = RgbPipeline2D::new();
/// let report = camera.observe(&world, &mut rgb)?;
/// assert_eq!(report.ledger.paths, 16 * 16 * 10);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[doc(alias("Observer0D", "Observer1D", "Observer2D"))]
#[derive(Clone)]
pub struct Observer<S: Sensor> {
    sensor: S,
    transform: AffineMatrix3D,
    parent: Option<NodeId>,
    range: (f64, f64),
    bins: usize,
    rays: usize,
    pixel_samples: u64,
    seed: u64,
    paths: PathSettings,
    /// Which pixels are observed; all of them if it is empty.
    mask: Vec<bool>,
    /// Number of the lane, and of how many.
    lane: (u64, u64),
    statepoint: Option<PathBuf>,
    engine: Option<Arc<dyn Engine>>,
    quiet: bool,
    watcher: Option<Arc<Watcher>>,
    cancel: CancelToken,
}

impl<S: Sensor> fmt::Debug for Observer<S> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}, {}, {} samples a pixel", self.sensor.kind(), self.sensor.shape(), self.pixel_samples)
    }
}

impl<S: Sensor> Observer<S> {
    /// Around a sensor, with 15 bins over 375 … 740 nm, one ray for all of them, 100 samples a pixel, seed 1, all
    /// processors of this machine, and unless it is quiet a progress bar on a terminal and warnings at the end.
    pub fn with_sensor(sensor: S) -> Self {
        Self {
            sensor,
            transform: AffineMatrix3D::IDENTITY,
            parent: None,
            range: (375.0, 740.0),
            bins: 15,
            rays: 1,
            pixel_samples: 100,
            seed: 1,
            paths: PathSettings::default(),
            mask: Vec::new(),
            lane: (0, 1),
            statepoint: None,
            engine: None,
            quiet: false,
            watcher: None,
            cancel: CancelToken::default(),
        }
    }

    /// Places it relative to its parent. Moving an observer changes nothing in the scene.
    pub fn transform(mut self, transform: AffineMatrix3D) -> Self {
        self.transform = transform;
        self
    }

    /// Hangs it under a node of the world instead of the root; it moves with the node.
    pub fn parent(mut self, node: NodeId) -> Self {
        self.parent = Some(node);
        self
    }

    /// Between two wavelengths [nm].
    #[doc(alias("min_wavelength", "max_wavelength"))]
    pub fn wavelengths(mut self, min: f64, max: f64) -> Self {
        self.range = (min, max);
        self
    }

    /// In this many bins.
    pub fn spectral_bins(mut self, bins: usize) -> Self {
        self.bins = bins;
        self
    }

    /// Shared by this many rays: each carries a slice of the bins.
    pub fn spectral_rays(mut self, rays: usize) -> Self {
        self.rays = rays;
        self
    }

    /// With this many samples a pixel in each [`observe`](Self::observe).
    pub fn pixel_samples(mut self, samples: u64) -> Self {
        self.pixel_samples = samples;
        self
    }

    /// With another seed. The same seed gives the same bits, on any number of threads.
    pub fn seed(mut self, seed: u64) -> Self {
        self.seed = seed;
        self
    }

    /// With other settings of its paths.
    pub fn paths(mut self, paths: PathSettings) -> Self {
        self.paths = paths;
        self
    }

    /// Of these pixels only, row by row: those with `true`. The others keep the samples that they have, which are
    /// none in a new pipeline: a mean of 0 with an infinite error, which totals and averages leave out.
    ///
    /// # Errors
    /// [`ObserverError::PixelCount`] for another number of values than pixels, [`ObserverError::NoPixels`] without any
    /// `true`.
    #[doc(alias("FullFrameSampler1D", "FullFrameSampler2D"))]
    pub fn mask(mut self, mask: impl Into<Vec<bool>>) -> Result<Self, ObserverError> {
        self.mask = mask.into();
        let (found, expected) = (self.mask.len(), self.sensor.shape().pixels());
        if found != expected {
            return Err(ObserverError::PixelCount { what: "mask", found, expected });
        }
        self.checked_mask()?;
        Ok(self)
    }

    /// Of the pixels in some columns (from the left) and rows (from the top) only, instead of an earlier
    /// [`mask`](Self::mask).
    ///
    /// ```
    /// # use raysect_observer::PinholeCamera;
    /// let corner = PinholeCamera::new((16, 9), 45.0)?.region(12..16, 0..3)?;
    /// assert!(PinholeCamera::new((16, 9), 45.0)?.region(12..17, 0..3).is_err());
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`ObserverError::Region`] for a region that reaches beyond the picture, [`ObserverError::NoPixels`] for an empty
    /// one.
    pub fn region(self, columns: Range<usize>, rows: Range<usize>) -> Result<Self, ObserverError> {
        let shape = self.sensor.shape();
        if columns.end > shape.columns() || rows.end > shape.rows() {
            return Err(ObserverError::Region { columns, rows, shape });
        }
        let place = |pixel: usize| (pixel % shape.columns(), pixel / shape.columns());
        let inside = |(column, row): (usize, usize)| columns.contains(&column) && rows.contains(&row);
        let mask: Vec<bool> = (0..shape.pixels()).map(|pixel| inside(place(pixel))).collect();
        self.mask(mask)
    }

    /// In lane `lane` of `of` sets of samples that are independent of each other, counted from 0: a part of an
    /// observation that is divided among machines. [Statepoints](crate::Statepoint) of the lanes, merged in any order,
    /// have the bits of the undivided observation, which takes all the lanes one after the other with the same
    /// pipelines. By default lane 0 of 1.
    ///
    /// A number of samples is that of the lane, and so is what a stop rule looks at.
    ///
    /// # Errors
    /// [`ObserverError::Lane`] unless `lane` is less than `of`.
    pub fn lane(mut self, lane: u64, of: u64) -> Result<Self, ObserverError> {
        if lane >= of {
            return Err(ObserverError::Lane { lane, of });
        }
        self.lane = (lane, of);
        Ok(self)
    }

    /// Writes a [`Statepoint`] of all pipelines after each pass, so that a program that ends at any time loses only the
    /// pass in progress; see [`resume`](Self::resume). The file is at any time the last one or the new one.
    pub fn statepoint(mut self, path: impl Into<PathBuf>) -> Self {
        self.statepoint = Some(path.into());
        self
    }

    /// On another engine.
    #[doc(alias = "render_engine")]
    pub fn engine(mut self, engine: impl Engine + 'static) -> Self {
        self.engine = Some(Arc::new(engine));
        self
    }

    /// On this many threads.
    ///
    /// # Errors
    /// [`ObserverError::Engine`] for none, or if they cannot be started.
    pub fn threads(self, threads: usize) -> Result<Self, ObserverError> {
        Ok(self.engine(Multicore::with_threads(threads)?))
    }

    /// Without a progress bar, and without the [warnings](crate::RenderReport::warnings) of the report on the standard error
    /// stream.
    pub fn quiet(mut self, quiet: bool) -> Self {
        self.quiet = quiet;
        self
    }

    /// Tells a function how far it is, a few times a second: samples done and foreseen, their rate, the time left and the
    /// error reached.
    pub fn on_progress(mut self, watcher: impl Fn(&Progress) + Send + Sync + 'static) -> Self {
        self.watcher = Some(Arc::new(watcher));
        self
    }

    /// Ends when a handle says so.
    pub fn cancelled_by(mut self, token: &CancelToken) -> Self {
        self.cancel = token.clone();
        self
    }

    /// The sensor.
    pub fn sensor(&self) -> &S {
        &self.sensor
    }

    /// The sensor, to be changed.
    pub fn sensor_mut(&mut self) -> &mut S {
        &mut self.sensor
    }

    /// Its place relative to its parent, as set.
    pub fn chosen_transform(&self) -> &AffineMatrix3D {
        &self.transform
    }

    /// The node that it hangs under; none for the root.
    pub fn chosen_parent(&self) -> Option<NodeId> {
        self.parent
    }

    /// How many samples a pixel gets in each [`observe`](Self::observe), as set.
    pub fn samples_per_observation(&self) -> u64 {
        self.pixel_samples
    }

    /// The seed, as set.
    pub fn seed_value(&self) -> u64 {
        self.seed
    }

    /// The settings of its paths.
    pub fn path_settings(&self) -> &PathSettings {
        &self.paths
    }

    /// Which pixels are observed, row by row, as set; none if all are.
    pub fn chosen_mask(&self) -> Option<&[bool]> {
        (!self.mask.is_empty()).then_some(&self.mask[..])
    }

    /// The map from its own space to that of the world.
    ///
    /// # Errors
    /// [`raysect_core::CoreError::UnknownNode`] for a parent of another world.
    pub fn to_root(&self, world: &World) -> Result<AffineMatrix3D, ObserverError> {
        let parent = match self.parent {
            Some(node) => world.to_root(node)?,
            None => AffineMatrix3D::IDENTITY,
        };
        Ok(parent * self.transform)
    }

    /// The map from its own space to that of a node.
    ///
    /// # Errors
    /// [`raysect_core::CoreError::UnknownNode`] for a node of another world.
    pub fn to(&self, world: &World, node: NodeId) -> Result<AffineMatrix3D, ObserverError> {
        Ok(world.to(self.parent.unwrap_or(world.root()), node)? * self.transform)
    }

    /// The spectral range, its bins and slices.
    ///
    /// # Errors
    /// [`raysect_optical::OpticalError::Slicing`] for an impossible combination.
    pub fn slicing(&self) -> Result<Slicing, ObserverError> {
        Ok(Slicing::new(self.range.0, self.range.1, self.bins, self.rays)?)
    }

    /// What an observation will model, what it will not, and why.
    ///
    /// # Errors
    /// As [`observe`](Self::observe).
    pub fn plan(&self, world: &World) -> Result<Plan, ObserverError> {
        Plan::new(self, world)
    }

    /// Observes with [`pixel_samples`](Self::pixel_samples) more samples of every pixel. A pipeline that has seen
    /// samples before goes on where it ended: the bits are those of one long observation.
    ///
    /// # Errors
    /// Whatever makes the scene, the range or the pipelines impossible; a panic in a user's material, with all
    /// finished work kept.
    pub fn observe(
        &self,
        world: &World,
        pipelines: &mut (impl Pipelines + ?Sized),
    ) -> Result<RenderReport, ObserverError> {
        Session::new(self, world, pipelines)?.observe(self.pixel_samples)
    }

    /// Observes until a rule says stop.
    ///
    /// # Errors
    /// As [`observe`](Self::observe); [`ObserverError::Math`] for an error, a share or a level that makes no sense,
    /// [`ObserverError::Stop`] for no samples.
    #[doc(alias(
        "MonoAdaptiveSampler2D",
        "RGBAdaptiveSampler2D",
        "SpectralAdaptiveSampler2D",
        "render_complete"
    ))]
    pub fn observe_until(
        &self,
        world: &World,
        pipelines: &mut (impl Pipelines + ?Sized),
        stop: Stop,
    ) -> Result<RenderReport, ObserverError> {
        stop.check()?;
        Session::new(self, world, pipelines)?.observe_until(&stop)
    }

    /// Observes with more samples of some pixels than of others, until there are as many as `adaptive` says, in the mean
    /// over the pixels. Samples that the pipelines have already, in this lane, are counted in: an observation that was
    /// interrupted goes on to the same bits.
    ///
    /// # Errors
    /// As [`observe`](Self::observe); [`ObserverError::Adaptive`] for a first pipeline that cannot decide,
    /// [`ObserverError::Math`] for no samples.
    #[doc(alias = "frame_sampler")]
    pub fn observe_adaptive(
        &self,
        world: &World,
        pipelines: &mut (impl Pipelines + ?Sized),
        adaptive: &AdaptiveSampling,
    ) -> Result<RenderReport, ObserverError> {
        Session::new(self, world, pipelines)?.observe_adaptive(adaptive)
    }

    /// Takes so many more samples of each pixel, row by row, for a program that distributes samples by a rule of its own: it
    /// looks at the frame, decides, and calls again. Masked pixels are left out, whatever their number.
    ///
    /// Samples that decide about their own number make an average biased, see [`AdaptiveSampling`]: better decide by the
    /// frame of another pipeline, seen with another [`seed`](Self::seed).
    ///
    /// ```
    /// # use raysect_math::translate;
    /// # use raysect_optical::{UniformSurfaceEmitter, WithMaterial, World};
    /// # use raysect_primitive::Sphere;
    /// use raysect_observer::{PinholeCamera, RadiancePipeline2D};
    /// # let mut world = World::new();
    /// # world.add(Sphere::new(1.0)?.material(UniformSurfaceEmitter::new(1.0, 1.0)))?;
    /// let camera = PinholeCamera::new((8, 8), 45.0)?.transform(translate(0.0, 0.0, -5.0)).pixel_samples(20);
    /// let (mut trial, mut radiance) = (RadiancePipeline2D::new(), RadiancePipeline2D::new());
    /// camera.clone().seed(2).observe(&world, &mut trial)?;
    /// // Ten times as many where the trial has seen the edge of the lamp.
    /// let error = trial.frame().error();
    /// let samples: Vec<u64> = error.iter().map(|e| if *e > 0.0 { 200 } else { 20 }).collect();
    /// camera.observe_samples(&world, &mut radiance, &samples)?;
    /// assert_eq!(radiance.frame().total_samples(), samples.iter().sum::<u64>());
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// As [`observe`](Self::observe); [`ObserverError::PixelNumbers`] unless there is a number for each pixel.
    #[doc(alias = "generate_tasks")]
    pub fn observe_samples(
        &self,
        world: &World,
        pipelines: &mut (impl Pipelines + ?Sized),
        samples: &[u64],
    ) -> Result<RenderReport, ObserverError> {
        Session::new(self, world, pipelines)?.observe_samples(samples)
    }

    /// The same around another sensor.
    pub(crate) fn try_map<T: Sensor>(
        self,
        map: impl FnOnce(S) -> Result<T, ObserverError>,
    ) -> Result<Observer<T>, ObserverError> {
        Ok(Observer {
            sensor: map(self.sensor)?,
            transform: self.transform,
            parent: self.parent,
            range: self.range,
            bins: self.bins,
            rays: self.rays,
            pixel_samples: self.pixel_samples,
            seed: self.seed,
            paths: self.paths,
            mask: self.mask,
            lane: self.lane,
            statepoint: self.statepoint,
            engine: self.engine,
            quiet: self.quiet,
            watcher: self.watcher,
            cancel: self.cancel,
        })
    }

    /// Goes back to the [statepoint](Self::statepoint) that was written last: the pipelines have the samples that they
    /// had then, and the next observation goes on with the bits of an undisturbed one. Answers with `false`, and
    /// leaves the pipelines alone, if there is no file yet.
    ///
    /// # Errors
    /// As [`Statepoint::load`] and [`Statepoint::restore`]; the pipelines are then as before.
    pub fn resume(
        &self,
        world: &World,
        pipelines: &mut (impl Pipelines + ?Sized),
    ) -> Result<bool, ObserverError> {
        match &self.statepoint {
            Some(path) if path.exists() => {
                Statepoint::load(path)?.restore(self, world, pipelines)?;
                Ok(true)
            }
            _ => Ok(false),
        }
    }

    /// What is observed: what frames are known by.
    pub(crate) fn fingerprint(&self, world: &World) -> Result<String, ObserverError> {
        let slicing = self.slicing()?;
        let lanes = match self.lane.1 {
            1 => String::new(),
            of => format!(", samples in {of} lanes"),
        };
        Ok(format!(
            "{} at {:?}, {} bins over {} … {} nm in {} slices, seed {}{lanes}",
            self.sensor.description(),
            self.to_root(world)?.to_rows(),
            slicing.bins(),
            slicing.min_wavelength(),
            slicing.max_wavelength(),
            slicing.slice_count(),
            self.seed,
        ))
    }

    pub(crate) fn statepoint_path(&self) -> Option<&Path> {
        self.statepoint.as_deref()
    }

    /// Which pixels are observed, if that is possible.
    pub(crate) fn checked_mask(&self) -> Result<Vec<bool>, ObserverError> {
        let expected = self.sensor.shape().pixels();
        let mask = if self.mask.is_empty() { vec![true; expected] } else { self.mask.clone() };
        if mask.len() != expected {
            return Err(ObserverError::PixelCount { what: "mask", found: mask.len(), expected });
        }
        if !mask.contains(&true) {
            return Err(ObserverError::NoPixels);
        }
        Ok(mask)
    }

    pub(crate) fn lane_number(&self) -> u64 {
        self.lane.0
    }

    pub(crate) fn chosen_engine(&self) -> Result<Arc<dyn Engine>, ObserverError> {
        match &self.engine {
            Some(engine) => Ok(engine.clone()),
            None => Ok(Arc::new(Multicore::new()?)),
        }
    }

    pub(crate) fn is_quiet(&self) -> bool {
        self.quiet
    }

    pub(crate) fn watcher(&self) -> Option<Arc<Watcher>> {
        self.watcher.clone()
    }

    pub(crate) fn cancel_token(&self) -> &CancelToken {
        &self.cancel
    }
}

/// What it observes and how is saved, its place in the tree included. Where it computes and who watches is a matter of
/// the program that runs: engine, progress function and cancel token are not saved, and change no bit of a result.
impl<S: Sensor + Storable> Storable for Observer<S> {
    const KIND: &'static str = S::KIND;

    fn save(&self, saved: Saved, writer: &mut SceneWriter) -> Result<Saved, SaveError> {
        let mut saved = self.sensor.save(saved, writer)?.transform("transform", &self.transform);
        if let Some(parent) = self.parent {
            saved = saved.reference("parent", writer.node(parent)?);
        }
        let saved = saved
            .numbers("wavelengths", &[self.range.0, self.range.1])
            .count("spectral_bins", self.bins as u64)
            .count("spectral_rays", self.rays as u64)
            .count("pixel_samples", self.pixel_samples)
            .count("seed", self.seed)
            .flag("quiet", self.quiet);
        let mut saved = self.paths.save(saved, writer)?;
        if !self.mask.is_empty() {
            saved = saved
                .text("mask", self.mask.iter().map(|&seen| if seen { '1' } else { '0' }).collect::<String>());
        }
        if self.lane.1 != 1 {
            saved = saved.count("lane", self.lane.0).count("lanes", self.lane.1);
        }
        Ok(saved)
    }

    fn load(entry: &Entry<'_>) -> Result<Self, MakeError> {
        let [min, max] = entry.array("wavelengths")?;
        let mut observer = Self::with_sensor(S::load(entry)?)
            .transform(entry.transform("transform")?)
            .wavelengths(min, max)
            .spectral_bins(entry.integer("spectral_bins")?)
            .spectral_rays(entry.integer("spectral_rays")?)
            .pixel_samples(entry.count("pixel_samples")?)
            .seed(entry.count("seed")?)
            .quiet(entry.flag("quiet")?)
            .paths(PathSettings::load(entry)?);
        observer.slicing()?;
        if entry.has("mask") {
            observer = observer.mask(entry.text("mask")?.bytes().map(|b| b == b'1').collect::<Vec<_>>())?;
        }
        if entry.has("lanes") {
            observer = observer.lane(entry.count("lane")?, entry.count("lanes")?)?;
        }
        if entry.has("parent") {
            observer = observer.parent(entry.node("parent")?);
        }
        Ok(observer)
    }
}
