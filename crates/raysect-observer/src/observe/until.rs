//! Observing until an error is reached.

use super::{PILOT_LANE, Session};
use crate::stop::{elements, needed_samples, verdict};
use crate::{Convergence, Frame, ObserverError, RenderReport, Sensor, Stop};

/// Samples a pixel with which a pilot begins.
const PILOT: u64 = 32;
/// What a pilot may take of the samples or the time allowed.
const PILOT_SHARE: f64 = 0.25;
/// Samples are added to until there are this many times as many as foreseen, at most.
const EXTENSION: u64 = 4;

impl<S: Sensor> Session<'_, S> {
    pub(crate) fn observe_until(mut self, stop: &Stop) -> Result<RenderReport, ObserverError> {
        let deadline = stop.time.map(|t| t.as_secs_f64());
        let limit = stop.samples.unwrap_or(u64::MAX);
        if !stop.has_target() {
            let pixels = self.pixels();
            self.meter.foresee(stop.samples.unwrap_or(0).saturating_mul(pixels));
            let before = self.samples_before();
            self.take(limit.saturating_sub(before), limit, deadline)?;
            return Ok(self.finish());
        }
        let (foreseen, pilot_samples) = self.pilot(stop, limit, deadline)?;
        let mut wanted = foreseen.unwrap_or(limit).min(limit);
        let most = foreseen.map_or(limit, |n| n.saturating_mul(EXTENSION)).min(limit);
        loop {
            let before = self.samples_before();
            let pixels = self.pixels();
            self.meter.foresee(wanted.saturating_add(pilot_samples).saturating_mul(pixels));
            let due = wanted.saturating_sub(before);
            let taken = self.take(due, wanted, deadline)?;
            let lane = self.observer.lane_number();
            let frames: Vec<Frame> =
                self.pipelines.iter().map(|p| p.frame().part(lane, &self.mask)).collect();
            let looked_at = elements(stop, &frames);
            let (reached, unconverged) = verdict(stop, &looked_at);
            self.report.convergence =
                Some(Convergence { reached, unconverged, elements: looked_at.len(), pilot_samples });
            let exhausted = taken < due || wanted >= most || self.report.cancelled;
            if reached || exhausted {
                return Ok(self.finish());
            }
            let more = needed_samples(stop, &looked_at).unwrap_or(u64::MAX);
            wanted = more.max(wanted + wanted / 16 + 1).min(most);
        }
    }

    /// How many samples a pixel are needed in all, by samples that are thrown away afterwards, and how many those
    /// were. None if they could not tell within their share.
    fn pilot(
        &mut self,
        stop: &Stop,
        limit: u64,
        deadline: Option<f64>,
    ) -> Result<(Option<u64>, u64), ObserverError> {
        let lane = self.observer.lane_number();
        let mut frames: Vec<Frame> =
            self.pipelines.iter().map(|p| p.frame().emptied(lane, &self.mask)).collect();
        let most = ((limit as f64 * PILOT_SHARE) as u64).max(1);
        let (mut done, mut next) = (0, PILOT.min(most));
        loop {
            self.meter.say("pilot".to_owned());
            let pixels = self.pixels();
            self.meter.foresee((done + next) * pixels);
            done += next;
            let goals = self.goals(&frames[0], next, u64::MAX);
            self.pass(&mut frames, PILOT_LANE, &goals)?;
            let needed = needed_samples(stop, &elements(stop, &frames));
            let late = deadline.is_some_and(|d| self.meter.elapsed().as_secs_f64() >= PILOT_SHARE * d);
            if needed.is_some() || late || done >= most || self.report.cancelled {
                self.meter.say(String::new());
                // Fewer than the pilot took would be decided by too little.
                return Ok((needed.map(|n| n.max(2 * done)), done));
            }
            next = done.min(most - done);
        }
    }
}
