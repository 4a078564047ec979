//! Samples that only decide, in passes that can be watched.

use super::{PASS_SECONDS, PILOT_LANE, Session};
use crate::{Frame, ObserverError, Sensor};

impl<S: Sensor> Session<'_, S> {
    /// Takes samples of a pilot until every pixel has its goal, in passes of a few seconds. What it has seen is shown
    /// after each.
    pub(super) fn pilot(&mut self, frames: &mut [Frame], goals: &[u64]) -> Result<(), ObserverError> {
        let mut count = 1;
        loop {
            let lane = self.observer.lane_number();
            let goal = |(pixel, &goal): (usize, &u64)| goal.min(frames[0].lane_samples(lane, pixel) + count);
            let next: Vec<u64> = goals.iter().enumerate().map(goal).collect();
            let before = self.meter.elapsed().as_secs_f64();
            if self.pass(frames, PILOT_LANE, &next)? > 0 {
                self.show(frames)?;
            }
            if next == goals || self.report.cancelled {
                return Ok(());
            }
            let took = (self.meter.elapsed().as_secs_f64() - before).max(1e-9);
            count = ((count as f64 / took * PASS_SECONDS) as u64).max(1);
        }
    }

    /// Lends the frames of a pilot to the pipelines for their previews, as long as those have nothing of their own.
    fn show(&mut self, frames: &mut [Frame]) -> Result<(), ObserverError> {
        if self.pipelines.iter().any(|pipeline| pipeline.frame().total_samples() > 0) {
            return Ok(());
        }
        let mut exchange = |pipelines: &mut [&mut dyn crate::Pipeline]| {
            for (pipeline, frame) in pipelines.iter_mut().zip(frames.iter_mut()) {
                std::mem::swap(pipeline.frame_mut(), frame);
            }
        };
        exchange(&mut self.pipelines);
        let shown = self.pipelines.iter_mut().try_for_each(|pipeline| pipeline.pass_finished());
        exchange(&mut self.pipelines);
        shown
    }
}

#[cfg(test)]
#[path = "pilot_tests.rs"]
mod tests;
