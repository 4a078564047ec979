//! Observing until an error is reached.

use super::Session;
use crate::stop::{elements, needed_samples, verdict};
use crate::{Convergence, Frame, ObserverError, RenderReport, Sensor, Stop};

/// Samples a pixel with which a pilot begins.
const PILOT: u64 = 32;
/// What a pilot may take of the samples or the time allowed.
const PILOT_SHARE: f64 = 0.25;
/// Samples are added to until there are this many times as many as foreseen; then the pilot has to see farther.
const EXTENSION: u64 = 4;

impl<S: Sensor> Session<'_, S> {
    pub(crate) fn observe_until(mut self, stop: &Stop) -> Result<RenderReport, ObserverError> {
        let deadline = stop.time.map(|t| t.as_secs_f64());
        let limit = stop.samples.unwrap_or(u64::MAX);
        let (pixels, earlier) = (self.pixels(), self.samples_before());
        self.meter.end_after(deadline);
        if !stop.has_target() {
            let due = limit.saturating_sub(earlier);
            self.meter.foresee(due.saturating_mul(pixels));
            self.take(due, limit, deadline)?;
            return Ok(self.finish());
        }
        let mut pilot = Pilot::new(&self, limit);
        let foreseen = self.foresee(stop, &mut pilot, deadline)?;
        let mut wanted = foreseen.unwrap_or(limit).min(limit);
        let mut most = extended(foreseen, limit);
        loop {
            let before = self.samples_before();
            let all = wanted.saturating_sub(earlier).saturating_add(pilot.samples);
            self.meter.foresee(all.saturating_mul(pixels));
            let due = wanted.saturating_sub(before);
            let taken = self.take(due, wanted, deadline)?;
            let lane = self.observer.lane_number();
            let frames: Vec<Frame> =
                self.pipelines.iter().map(|p| p.frame().part(lane, &self.mask)).collect();
            let looked_at = elements(stop, &frames);
            let (reached, unconverged) = verdict(stop, &looked_at);
            let (elements, pilot_samples) = (looked_at.len(), pilot.samples);
            self.report.convergence = Some(Convergence { reached, unconverged, elements, pilot_samples });
            if reached || taken < due || wanted >= limit || self.report.cancelled {
                return Ok(self.finish());
            }
            if wanted >= most {
                // So far off was the pilot that it must have been too small.
                pilot.wanted = (wanted / EXTENSION).max(2 * pilot.samples);
                let larger = extended(self.foresee(stop, &mut pilot, deadline)?, limit);
                if larger <= most {
                    return Ok(self.finish());
                }
                most = larger;
            }
            let more = needed_samples(stop, &looked_at).unwrap_or(u64::MAX);
            wanted = more.max(wanted + wanted / 16 + 1).min(most);
        }
    }

    /// How many samples a pixel are needed in all, by samples that are thrown away afterwards. None if they could not
    /// tell within their share.
    fn foresee(
        &mut self,
        stop: &Stop,
        pilot: &mut Pilot,
        deadline: Option<f64>,
    ) -> Result<Option<u64>, ObserverError> {
        pilot.wanted = pilot.wanted.min(pilot.most);
        loop {
            self.meter.say("pilot".to_owned());
            let pixels = self.pixels();
            self.meter.foresee(pilot.wanted.saturating_mul(pixels));
            let next = pilot.wanted.saturating_sub(pilot.samples);
            let goals = self.goals(&pilot.frames[0], next, u64::MAX);
            self.pilot(&mut pilot.frames, &goals)?;
            pilot.samples += next;
            let needed = needed_samples(stop, &elements(stop, &pilot.frames));
            let late = deadline.is_some_and(|d| self.meter.elapsed().as_secs_f64() >= PILOT_SHARE * d);
            if needed.is_some() || late || pilot.samples >= pilot.most || self.report.cancelled {
                self.meter.say(String::new());
                // Fewer than the pilot took would be decided by too little.
                return Ok(needed.map(|n| n.max(2 * pilot.samples)));
            }
            pilot.wanted = (2 * pilot.samples).min(pilot.most);
        }
    }
}

/// How many samples are taken at most if so many are foreseen.
fn extended(foreseen: Option<u64>, limit: u64) -> u64 {
    foreseen.map_or(limit, |n| n.saturating_mul(EXTENSION)).min(limit)
}

/// Samples that decide, and are thrown away.
struct Pilot {
    frames: Vec<Frame>,
    /// How many it has of a pixel, how many it is to have next, and at most.
    samples: u64,
    wanted: u64,
    most: u64,
}

impl Pilot {
    fn new<S: Sensor>(session: &Session<'_, S>, limit: u64) -> Self {
        let lane = session.observer.lane_number();
        let frames = session.pipelines.iter().map(|p| p.frame().emptied(lane, &session.mask)).collect();
        let most = ((limit as f64 * PILOT_SHARE) as u64).max(1);
        Self { frames, samples: 0, wanted: PILOT, most }
    }
}
