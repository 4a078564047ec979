//! One pass over the pixels, split into work items.

use std::ops::{ControlFlow, Range};

use raysect_math::Stratum;
use raysect_optical::{LEDGER_NUMBERS, Ledger, Path};

use super::draw::{Drawn, draw};
use super::{PILOT_LANE, Session};
use crate::frame::{BLOCK, Sums, add_sample};
use crate::strata::Strata;
use crate::{Frame, Measurement, ObserverError, Pipeline, Sensor};

/// Consecutive samples of one pixel.
#[derive(Debug, Clone, Copy)]
struct Task {
    pixel: usize,
    first: u64,
    count: u64,
}

impl Task {
    /// How many blocks its samples belong to.
    fn blocks(&self) -> u64 {
        (self.first % BLOCK + self.count).div_ceil(BLOCK)
    }
}

/// Samples in a work item at most: some milliseconds of work.
const ITEM_SAMPLES: u64 = 4096;

/// The tasks of a pass and how they are grouped into work items. Neither changes the result.
struct Items {
    tasks: Vec<Task>,
    groups: Vec<Range<usize>>,
}

impl Items {
    /// Of the samples that pixels are short of their `goals`.
    fn new(sums: &Sums, goals: &[u64], workers: usize, slices: usize) -> Self {
        let all: u64 = goals.iter().enumerate().map(|(p, goal)| goal.saturating_sub(sums.samples(p))).sum();
        let size = (all / (16 * workers as u64)).clamp(1, (ITEM_SAMPLES / slices as u64).max(1));
        let mut tasks = Vec::with_capacity(goals.len());
        for (pixel, &end) in goals.iter().enumerate() {
            let mut first = sums.samples(pixel);
            while first < end {
                // Only whole blocks can be computed apart from each other.
                let stop = ((first + size) / BLOCK * BLOCK).max((first / BLOCK + 1) * BLOCK).min(end);
                tasks.push(Task { pixel, first, count: stop - first });
                first = stop;
            }
        }
        let (mut groups, mut start, mut samples) = (Vec::new(), 0, 0);
        for (index, task) in tasks.iter().enumerate() {
            samples += task.count;
            if samples >= size {
                groups.push(start..index + 1);
                (start, samples) = (index + 1, 0);
            }
        }
        if start < tasks.len() {
            groups.push(start..tasks.len());
        }
        Self { tasks, groups }
    }
}

/// What all workers share.
struct Shared<'s, 'a, S: Sensor> {
    session: &'s Session<'a, S>,
    pipelines: &'s [&'s dyn Pipeline],
    /// The blocks that were open when the pass began, and the number of channels, for each pipeline.
    open: &'s [Sums],
    lane: u64,
}

impl<'a, S: Sensor> Session<'a, S> {
    /// Takes samples of every pixel that has fewer than its goal into `frames`, from the streams of `stream`; answers
    /// with the number of samples taken.
    pub(super) fn pass(
        &mut self,
        frames: &mut [Frame],
        stream: u64,
        goals: &[u64],
    ) -> Result<u64, ObserverError> {
        let lane = self.observer.lane_number();
        let mut sums: Vec<Sums> = frames.iter_mut().map(|frame| frame.take_lane(lane)).collect();
        let outcome = self.fold(&mut sums, stream, goals);
        frames.iter_mut().zip(sums).for_each(|(frame, sums)| frame.put_lane(lane, sums));
        if stream == PILOT_LANE {
            self.report.pilot_samples += outcome.as_ref().unwrap_or(&0);
        }
        outcome
    }

    fn fold(&mut self, sums: &mut [Sums], lane: u64, goals: &[u64]) -> Result<u64, ObserverError> {
        let items = Items::new(&sums[0], goals, self.engine.workers(), self.slices.len());
        let strides: Vec<usize> = sums.iter().map(Sums::open_stride).collect();
        let (mut ledger, mut invalid, mut samples, mut cancelled) = (Ledger::default(), 0, 0, false);
        let mut rays = std::mem::take(&mut self.rays);
        let mut meter = std::mem::replace(&mut self.meter, crate::progress::Meter::new(true, None));
        let before: Vec<Sums> = sums.iter().map(Sums::open_part).collect();
        let outcome = {
            let pipelines: Vec<&dyn Pipeline> = self.pipelines.iter().map(|p| &**p).collect();
            let shared = Shared { session: self, pipelines: &pipelines, open: &before, lane };
            let work = |item: usize| shared.item(&items.tasks[items.groups[item].clone()]);
            let cancel = self.observer.cancel_token();
            self.engine.run(items.groups.len(), &work, &mut |item, numbers| {
                let mut rest = &numbers[..];
                for task in &items.tasks[items.groups[item].clone()] {
                    for _ in 0..task.blocks() {
                        for (sums, stride) in sums.iter_mut().zip(&strides) {
                            let (block, after) = rest.split_at(*stride);
                            sums.put_block(task.pixel, block);
                            rest = after;
                        }
                    }
                    samples += task.count;
                    if let Some((&traced, after)) = rest.split_first() {
                        if let Some(rays) = rays.get_mut(task.pixel) {
                            *rays += traced as u64;
                        }
                        rest = after;
                    }
                }
                if let Some((&bad, numbers)) = rest.split_first() {
                    invalid += bad as u64;
                    if let Ok(numbers) = numbers.try_into() {
                        ledger.add_numbers(numbers);
                    }
                }
                meter.add(items.tasks[items.groups[item].clone()].iter().map(|t| t.count).sum());
                if cancel.is_cancelled() {
                    cancelled = true;
                    return ControlFlow::Break(());
                }
                ControlFlow::Continue(())
            })
        };
        (self.meter, self.rays) = (meter, rays);
        self.report.ledger.add_numbers(&ledger.to_numbers());
        self.report.invalid += invalid;
        self.report.cancelled |= cancelled;
        outcome?;
        Ok(samples)
    }
}

/// Rays traced so far, those towards lights included.
fn rays_of(paths: &[Path<'_>]) -> u64 {
    paths.iter().map(|path| path.ledger().rays + path.ledger().shadow_rays).sum()
}

impl<S: Sensor> Shared<'_, '_, S> {
    /// The blocks of each task of an item, pipeline by pipeline, and its number of rays; at the end the number of invalid
    /// samples and the ledger.
    fn item(&self, tasks: &[Task]) -> Vec<f64> {
        let session = self.session;
        let settings = session.observer.path_settings();
        let mut paths: Vec<Path<'_>> =
            session.slices.iter().map(|slice| Path::new(session.scene, slice, settings)).collect();
        let widest = session.slices.iter().map(|s| s.bins).max().unwrap_or(0);
        let mut weighted = vec![0.0; widest];
        let mut samples: Vec<Vec<f64>> = self.open.iter().map(|s| vec![0.0; s.channels()]).collect();
        let mut blocks: Vec<Vec<f64>> = self.open.iter().map(|s| vec![0.0; s.open_stride()]).collect();
        let (mut out, mut invalid, mut strata) = (Vec::new(), 0.0, Strata::default());
        for task in tasks {
            let before = rays_of(&paths);
            for (block, open) in blocks.iter_mut().zip(self.open) {
                block.copy_from_slice(open.open_block(task.pixel));
                if task.first % BLOCK == 0 {
                    block.fill(0.0);
                }
            }
            for number in task.first..task.first + task.count {
                let stratum = strata.of(session.observer.seed_value(), self.lane, task.pixel, number);
                self.sample(task.pixel, number, stratum, &mut paths, &mut weighted, &mut samples);
                for (block, sample) in blocks.iter_mut().zip(&mut samples) {
                    if sample.iter().any(|x| !x.is_finite()) {
                        sample.fill(0.0);
                        invalid += 1.0;
                    }
                    add_sample(block, sample);
                }
                if (number + 1) % BLOCK == 0 {
                    blocks.iter_mut().for_each(|block| {
                        out.extend_from_slice(block);
                        block.fill(0.0);
                    });
                }
            }
            if (task.first + task.count) % BLOCK != 0 {
                blocks.iter().for_each(|block| out.extend_from_slice(block));
            }
            out.push((rays_of(&paths) - before) as f64);
        }
        let mut ledger = Ledger::default();
        paths.iter().for_each(|path| ledger.add_numbers(&path.ledger().to_numbers()));
        out.push(invalid);
        out.extend::<[f64; LEDGER_NUMBERS]>(ledger.to_numbers());
        out
    }

    /// One sample of a pixel: a path for each slice, reduced by each pipeline.
    fn sample(
        &self,
        pixel: usize,
        number: u64,
        stratum: Stratum,
        paths: &mut [Path<'_>],
        weighted: &mut [f64],
        samples: &mut [Vec<f64>],
    ) {
        let session = self.session;
        samples.iter_mut().for_each(|s| s.fill(0.0));
        let etendue = session.observer.sensor().etendue(pixel).unwrap_or(f64::NAN);
        for (path, slice) in paths.iter_mut().zip(&session.slices) {
            let key = (self.lane, pixel, number);
            let Drawn { ray, weight, rng } = draw(session.observer, &session.to_world, slice, key, stratum);
            let radiance = path.follow(&ray, rng);
            let radiance = if weight == 1.0 {
                radiance
            } else {
                weighted.iter_mut().zip(radiance).for_each(|(w, r)| *w = weight * r);
                &weighted[..slice.bins]
            };
            let measurement = Measurement { pixel, slice, radiance, etendue };
            for (pipeline, sample) in self.pipelines.iter().zip(samples.iter_mut()) {
                pipeline.measure(&measurement, sample);
            }
        }
    }
}
