//! The state of an observation as a file.

mod bytes;
mod error;
mod fingerprint;

use std::path::Path;

pub(crate) use bytes::{ByteReader, ByteWriter};
pub use error::StatepointError;
pub(crate) use fingerprint::scene_fingerprint;
use raysect_optical::World;

use crate::file::{FileError, write_atomically};
use crate::{Frame, Observer, ObserverError, Pipelines, Sensor};

/// What every file begins with; then come version and length, the contents, and a checksum (CRC-32) of all before it.
const MAGIC: &[u8; 8] = b"raysect\x1a";
const VERSION: u32 = 2;
const HEADER: usize = 8 + 4 + 8;
const CHECKSUM: usize = 4;

/// Everything that several pipelines have gathered by a moment, to go on from, to merge, and to look at.
///
/// Random numbers are keyed by the number of a sample, so that nothing but the samples' sums and their numbers has to be
/// kept. A statepoint also knows what it is of: sensor, place, spectral range, seed and lanes (as frames do), settings of
/// the paths, and the scene: all that a file of it would hold if it can be saved, otherwise its tree with the place and
/// box of each shape. It does not know the settings of pipelines, such as filters.
///
/// ```
/// # use raysect_math::translate;
/// # use raysect_observer::{PinholeCamera, RgbPipeline2D, Statepoint, Stop};
/// # use raysect_optical::{UniformSurfaceEmitter, WithMaterial, World};
/// # use raysect_primitive::Sphere;
/// # let mut world = World::new();
/// # world.add(Sphere::new(1.0)?.material(UniformSurfaceEmitter::new(1.0, 1.0)))?;
/// # let camera = PinholeCamera::new((4, 4), 45.0)?.transform(translate(0.0, 0.0, -5.0));
/// // On two machines:
/// let half = |lane: u64| -> Result<Statepoint, Box<dyn std::error::Error>> {
///     let (mut rgb, camera) = (RgbPipeline2D::new(), camera.clone().lane(lane, 2)?);
///     camera.observe_until(&world, &mut rgb, Stop::samples(20))?;
///     Ok(Statepoint::of(&camera, &world, &mut rgb)?)
/// };
/// // And afterwards, in any order:
/// let mut all = half(1)?;
/// all.merge(&half(0)?)?;
/// assert_eq!(all.frames()[0].samples(0), 40);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Statepoint {
    scene: String,
    frames: Vec<Frame>,
}

impl Statepoint {
    /// What the pipelines of an observer have now.
    ///
    /// # Errors
    /// [`ObserverError::NoPipelines`].
    pub fn of<S: Sensor>(
        observer: &Observer<S>,
        world: &World,
        pipelines: &mut (impl Pipelines + ?Sized),
    ) -> Result<Self, ObserverError> {
        let mut list = Vec::new();
        pipelines.each(&mut list);
        if list.is_empty() {
            return Err(ObserverError::NoPipelines);
        }
        let frames = list.iter().map(|pipeline| pipeline.frame().clone()).collect();
        Ok(Self { scene: scene_fingerprint(world, observer.path_settings()), frames })
    }

    /// The frames of the pipelines, in their order.
    pub fn frames(&self) -> &[Frame] {
        &self.frames
    }

    /// Adds the samples of another statepoint of the same observation: those of other lanes, or of other pixels in the
    /// same lane. In whatever order lanes are merged, the bits are those of the undivided observation.
    ///
    /// # Errors
    /// [`StatepointError::OtherScene`], [`StatepointError::OtherPipelines`], or as [`Frame::merge`]; nothing is changed
    /// then.
    pub fn merge(&mut self, other: &Self) -> Result<(), ObserverError> {
        self.check_scene(&other.scene)?;
        self.check_names(other.frames.iter())?;
        let mut merged = self.frames.clone();
        for (ours, theirs) in merged.iter_mut().zip(&other.frames) {
            ours.merge(theirs)?;
        }
        self.frames = merged;
        Ok(())
    }

    /// Gives the pipelines what they had, instead of what they have.
    ///
    /// # Errors
    /// [`StatepointError::OtherScene`] and [`StatepointError::OtherPipelines`]; [`ObserverError::OtherFrame`] if the
    /// observer is another one. The pipelines are then as before.
    pub fn restore<S: Sensor>(
        self,
        observer: &Observer<S>,
        world: &World,
        pipelines: &mut (impl Pipelines + ?Sized),
    ) -> Result<(), ObserverError> {
        let mut list = Vec::new();
        pipelines.each(&mut list);
        self.check_scene(&scene_fingerprint(world, observer.path_settings()))?;
        self.check_names(list.iter().map(|pipeline| pipeline.frame()))?;
        let (slicing, fingerprint) = (observer.slicing()?, observer.fingerprint(world)?);
        let shape = observer.sensor().shape();
        for (pipeline, frame) in list.iter().zip(&self.frames) {
            frame.check(shape, &pipeline.channels(&slicing), &fingerprint)?;
        }
        for (pipeline, frame) in list.into_iter().zip(self.frames) {
            *pipeline.frame_mut() = frame;
            pipeline.begin(shape, &slicing);
        }
        Ok(())
    }

    /// Writes it; the file is at any time the old one or the whole new one.
    ///
    /// # Errors
    /// [`ObserverError::File`].
    pub fn save(&self, path: impl AsRef<Path>) -> Result<(), ObserverError> {
        let frames: Vec<&Frame> = self.frames.iter().collect();
        write_statepoint(path.as_ref(), &self.scene, &frames)
    }

    /// Reads one.
    ///
    /// # Errors
    /// [`ObserverError::File`] if it cannot be read; [`StatepointError`] if it is something else, of another version,
    /// truncated or damaged.
    pub fn load(path: impl AsRef<Path>) -> Result<Self, ObserverError> {
        let path = path.as_ref();
        let bytes = std::fs::read(path).map_err(|source| FileError::Io { path: path.to_owned(), source })?;
        let contents = checked_contents(path, &bytes)?;
        let wrong = |what: String| StatepointError::Contents { path: path.to_owned(), what };
        Ok(Self::from_contents(contents).map_err(wrong)?)
    }

    fn from_contents(contents: &[u8]) -> Result<Self, String> {
        let mut bytes = ByteReader(contents);
        let scene = bytes.text()?;
        let frames = (0..bytes.count()?).map(|_| Frame::read(&mut bytes)).collect::<Result<_, _>>()?;
        match bytes.0.len() {
            0 => Ok(Self { scene, frames }),
            more => Err(format!("{more} bytes too many")),
        }
    }

    fn check_scene(&self, other: &str) -> Result<(), StatepointError> {
        if self.scene == other {
            return Ok(());
        }
        Err(StatepointError::OtherScene { before: self.scene.clone(), now: other.to_owned() })
    }

    fn check_names<'f>(&self, others: impl Iterator<Item = &'f Frame>) -> Result<(), StatepointError> {
        let describe = |frame: &Frame| format!("{} [{}]", frame.name(), frame.unit());
        let before: Vec<String> = self.frames.iter().map(describe).collect();
        let now: Vec<String> = others.map(describe).collect();
        if before == now { Ok(()) } else { Err(StatepointError::OtherPipelines { before, now }) }
    }
}

/// Writes frames of a scene as a file.
pub(crate) fn write_statepoint(path: &Path, scene: &str, frames: &[&Frame]) -> Result<(), ObserverError> {
    let mut contents = ByteWriter::default();
    contents.text(scene);
    contents.count(frames.len() as u64);
    frames.iter().for_each(|frame| frame.write(&mut contents));
    let mut bytes = MAGIC.to_vec();
    bytes.extend(VERSION.to_le_bytes());
    bytes.extend((contents.0.len() as u64).to_le_bytes());
    bytes.append(&mut contents.0);
    let checksum = crc32fast::hash(&bytes);
    bytes.extend(checksum.to_le_bytes());
    Ok(write_atomically(path, |writer| writer.write_all(&bytes))?)
}

/// The contents of a file, if it is whole.
fn checked_contents<'b>(path: &Path, bytes: &'b [u8]) -> Result<&'b [u8], StatepointError> {
    let path = || path.to_owned();
    let Some(after) = bytes.strip_prefix(MAGIC) else {
        return Err(StatepointError::Foreign { path: path() });
    };
    let found = bytes.len() as u64;
    let short = || StatepointError::Length { path: path(), expected: (HEADER + CHECKSUM) as u64, found };
    let (&version, after) = after.split_first_chunk().ok_or_else(short)?;
    let version = u32::from_le_bytes(version);
    if version != VERSION {
        return Err(StatepointError::Version { path: path(), found: version, known: VERSION });
    }
    let (&length, _) = after.split_first_chunk().ok_or_else(short)?;
    let expected = u64::from_le_bytes(length).saturating_add((HEADER + CHECKSUM) as u64);
    if expected != found {
        return Err(StatepointError::Length { path: path(), expected, found });
    }
    let (all, &checksum) = bytes.split_last_chunk().ok_or_else(short)?;
    let (expected, found) = (u32::from_le_bytes(checksum), crc32fast::hash(all));
    if expected != found {
        return Err(StatepointError::Checksum { path: path(), expected, found });
    }
    Ok(&all[HEADER..])
}
