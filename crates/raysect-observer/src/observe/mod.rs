//! An observation: passes over the pixels, until enough.

mod adaptive;
mod draw;
mod pass;
mod pilot;
mod replay;
mod until;

use std::path::PathBuf;
use std::sync::Arc;

use raysect_core::Engine;
use raysect_math::AffineMatrix3D;
use raysect_optical::{Ledger, Scene, Slice, World};
pub use replay::Replay;
use replay::prepare;

use crate::progress::Meter;
use crate::statepoint::{scene_fingerprint, write_statepoint};
use crate::{Frame, Observer, ObserverError, Pipeline, Pipelines, Reading, RenderReport, Sensor};

/// Samples that only decide about those that count, the same for all lanes of them.
const PILOT_LANE: u64 = u64::MAX;

/// How long a pass may take, so that previews come and clocks are looked at [s].
const PASS_SECONDS: f64 = 4.0;

/// Everything that stays the same during an observation.
pub(crate) struct Session<'a, S: Sensor> {
    observer: &'a Observer<S>,
    scene: &'a Scene,
    world: &'a World,
    slices: Vec<Slice>,
    to_world: AffineMatrix3D,
    pipelines: Vec<&'a mut dyn Pipeline>,
    /// Where the state is written after each pass, and of what scene.
    statepoint: Option<(PathBuf, String)>,
    /// Which pixels are observed.
    mask: Vec<bool>,
    /// The frames of the pipelines, kept here while they are written to.
    frames: Vec<Frame>,
    /// How many rays were traced for the samples of each pixel, those towards lights included; empty if nobody asks.
    rays: Vec<u64>,
    engine: Arc<dyn Engine>,
    report: RenderReport,
    meter: Meter,
}

impl<'a, S: Sensor> Session<'a, S> {
    pub(crate) fn new(
        observer: &'a Observer<S>,
        world: &'a World,
        pipelines: &'a mut (impl Pipelines + ?Sized),
    ) -> Result<Self, ObserverError> {
        let mut list = Vec::new();
        pipelines.each(&mut list);
        if list.is_empty() {
            return Err(ObserverError::NoPipelines);
        }
        let (scene, slices, to_world) = prepare(observer, world)?;
        let slicing = observer.slicing()?;
        let (sensor, shape) = (observer.sensor(), observer.sensor().shape());
        let mask = observer.checked_mask()?;
        let fingerprint = observer.fingerprint(world)?;
        for pipeline in &mut list {
            if pipeline.needs_etendue()
                && let Some(pixel) = (0..shape.pixels()).find(|&p| sensor.etendue(p).is_none())
            {
                let pipeline = pipeline.frame().name().to_owned();
                return Err(ObserverError::NoEtendue { pipeline, sensor: sensor.kind(), pixel });
            }
            pipeline.frame().check(shape, &pipeline.channels(&slicing), &fingerprint)?;
        }
        let settings = observer.path_settings();
        let statepoint =
            observer.statepoint_path().map(|path| (path.to_owned(), scene_fingerprint(world, settings)));
        if statepoint.is_some() {
            check_names(&list)?;
        }
        let lane = observer.lane_number();
        check_equal(&list, shape.pixels(), lane)?;
        for pipeline in &mut list {
            let channels = pipeline.channels(&slicing);
            pipeline.frame_mut().prepare(shape, channels, &fingerprint, lane, &mask);
            pipeline.begin(shape, &slicing);
        }
        let report = RenderReport {
            pixels: mask.iter().filter(|seen| **seen).count(),
            passes: 0,
            samples: 0,
            pilot_samples: 0,
            elapsed: Default::default(),
            ledger: Ledger::default(),
            invalid: 0,
            cancelled: false,
            contestants: None,
            convergence: None,
            readings: Vec::new(),
        };
        Ok(Self {
            observer,
            scene,
            world,
            slices,
            to_world,
            frames: Vec::new(),
            rays: Vec::new(),
            pipelines: list,
            mask,
            statepoint,
            engine: observer.chosen_engine()?,
            report,
            meter: Meter::new(observer.is_quiet(), observer.watcher()),
        })
    }

    fn pixels(&self) -> u64 {
        self.report.pixels as u64
    }

    /// The pixels that are observed.
    fn observed(&self) -> impl Iterator<Item = usize> {
        self.mask.iter().enumerate().filter(|(_, seen)| **seen).map(|(pixel, _)| pixel)
    }

    /// Samples that every observed pixel has in this lane.
    fn samples_before(&self) -> u64 {
        let (frame, lane) = (self.pipelines[0].frame(), self.observer.lane_number());
        self.observed().map(|p| frame.lane_samples(lane, p)).min().unwrap_or(0)
    }

    /// How many samples each pixel is to have after `count` more, but no more than `limit`.
    fn goals(&self, frame: &Frame, count: u64, limit: u64) -> Vec<u64> {
        self.goals_below(frame, count, &|_| limit)
    }

    /// The same with a limit for each pixel.
    fn goals_below(&self, frame: &Frame, count: u64, limit: &dyn Fn(usize) -> u64) -> Vec<u64> {
        let lane = self.observer.lane_number();
        let mut goals = vec![0; self.mask.len()];
        for pixel in self.observed() {
            goals[pixel] = frame.lane_samples(lane, pixel).saturating_add(count).min(limit(pixel));
        }
        goals
    }

    pub(crate) fn observe(mut self, samples: u64) -> Result<RenderReport, ObserverError> {
        self.meter.foresee(samples * self.pixels());
        self.take(samples, u64::MAX, None)?;
        Ok(self.finish())
    }

    fn finish(mut self) -> RenderReport {
        let (added, elapsed) = (self.report.samples, self.meter.elapsed());
        self.report.elapsed = elapsed;
        self.report.contestants =
            self.report.ledger.contestants.map(|pair| pair.map(|index| self.name_of(index)));
        self.report.readings = self.pipelines.iter().map(|p| Reading::of(&**p, added, elapsed)).collect();
        drop(self.meter);
        if !self.observer.is_quiet() {
            // Whoever does not look at the report is to know all the same.
            self.report.warnings().iter().for_each(|warning| eprintln!("warning: {warning}"));
        }
        self.report
    }

    /// What an instance is called in messages: its name or its shape, and its material.
    fn name_of(&self, instance: u32) -> String {
        let placed = &self.scene.instances[instance as usize];
        let name = self.world.name(placed.node).unwrap_or_default();
        let shape = if name.is_empty() { placed.primitive.kind() } else { name };
        format!("{shape} ({})", placed.attached.material().facts().name)
    }

    /// Takes more samples of every pixel that has fewer than `limit`, in passes of a few seconds, until the deadline
    /// [s]; the number taken.
    fn take(&mut self, samples: u64, limit: u64, deadline: Option<f64>) -> Result<u64, ObserverError> {
        self.take_below(samples, &|_| limit, deadline)
    }

    /// The same with a limit for each pixel.
    fn take_below(
        &mut self,
        samples: u64,
        limit: &dyn Fn(usize) -> u64,
        deadline: Option<f64>,
    ) -> Result<u64, ObserverError> {
        let mut done = 0;
        let mut speed: Option<f64> = None;
        while done < samples && !self.report.cancelled {
            let left = deadline.map_or(f64::INFINITY, |d| d - self.meter.elapsed().as_secs_f64());
            if left <= 0.0 && done > 0 {
                break;
            }
            let time = PASS_SECONDS.min(0.5 * left);
            let wanted = speed.map_or(1, |per_second| ((per_second * time) as u64).max(1));
            let count = wanted.min(samples - done);
            let before = self.meter.elapsed().as_secs_f64();
            self.main_pass(count, limit)?;
            let took = (self.meter.elapsed().as_secs_f64() - before).max(1e-9);
            speed = Some(count as f64 / took);
            done += count;
        }
        Ok(done)
    }

    /// One pass of the samples that count.
    fn main_pass(&mut self, count: u64, limit: &dyn Fn(usize) -> u64) -> Result<(), ObserverError> {
        self.frames =
            self.pipelines.iter_mut().map(|p| std::mem::replace(p.frame_mut(), Frame::new("", ""))).collect();
        let mut frames = std::mem::take(&mut self.frames);
        let goals = self.goals_below(&frames[0], count, limit);
        let outcome = self.pass(&mut frames, self.observer.lane_number(), &goals);
        for (pipeline, frame) in self.pipelines.iter_mut().zip(frames) {
            *pipeline.frame_mut() = frame;
        }
        if let Some((path, scene)) = &self.statepoint {
            let frames: Vec<&Frame> = self.pipelines.iter().map(|p| p.frame()).collect();
            write_statepoint(path, scene, &frames)?;
        }
        self.report.passes += 1;
        self.report.samples += outcome?;
        self.meter.set_error(self.pipelines[0].frame().total().relative_error());
        for pipeline in &mut self.pipelines {
            pipeline.pass_finished()?;
        }
        Ok(())
    }
}

/// Refuses pipelines that a statepoint could not tell apart.
fn check_names(list: &[&mut dyn Pipeline]) -> Result<(), ObserverError> {
    for (number, one) in list.iter().map(|p| p.frame()).enumerate() {
        let same = |other: &Frame| other.name() == one.name() && other.unit() == one.unit();
        if list[..number].iter().any(|p| same(p.frame())) {
            return Err(ObserverError::SameName(one.name().to_owned(), one.unit().to_owned()));
        }
    }
    Ok(())
}

fn check_equal(list: &[&mut dyn Pipeline], pixels: usize, lane: u64) -> Result<(), ObserverError> {
    let first = list[0].frame();
    for other in list[1..].iter().map(|p| p.frame()) {
        let unequal = (0..pixels).find(|&p| first.lane_samples(lane, p) != other.lane_samples(lane, p));
        if let Some(pixel) = unequal {
            return Err(ObserverError::UnequalPipelines {
                first: first.name().to_owned(),
                first_samples: first.lane_samples(lane, pixel),
                second: other.name().to_owned(),
                second_samples: other.lane_samples(lane, pixel),
            });
        }
    }
    Ok(())
}
