//! Observing with more samples where they are needed.

use super::Session;
use crate::adaptive::{Noise, SamplePlan};
use crate::{AdaptiveSampling, Convergence, Frame, ObserverError, RenderReport, Sensor};

impl<S: Sensor> Session<'_, S> {
    pub(crate) fn observe_adaptive(
        mut self,
        sampling: &AdaptiveSampling,
    ) -> Result<RenderReport, ObserverError> {
        sampling.check(self.pipelines[0].frame())?;
        let goals = self.decide(sampling)?;
        if self.report.cancelled {
            return Ok(self.finish());
        }
        let (frame, lane) = (self.pipelines[0].frame(), self.observer.lane_number());
        let missing = |pixel: usize| goals[pixel].saturating_sub(frame.lane_samples(lane, pixel));
        let all: u64 = self.observed().map(missing).sum();
        let most = self.observed().map(missing).max().unwrap_or(0);
        self.meter.foresee(self.report.pilot_samples + all);
        self.take_below(most, &|pixel| goals[pixel], None)?;
        Ok(self.finish())
    }

    /// Takes a number of more samples of each pixel.
    pub(crate) fn observe_samples(mut self, samples: &[u64]) -> Result<RenderReport, ObserverError> {
        let pixels = self.mask.len();
        if samples.len() != pixels {
            return Err(ObserverError::PixelNumbers { found: samples.len(), pixels });
        }
        let (frame, lane) = (self.pipelines[0].frame(), self.observer.lane_number());
        let goals: Vec<u64> =
            (0..pixels).map(|p| frame.lane_samples(lane, p).saturating_add(samples[p])).collect();
        self.meter.foresee(self.observed().map(|p| samples[p]).sum());
        let most = self.observed().map(|p| samples[p]).max().unwrap_or(0);
        self.take_below(most, &|pixel| goals[pixel], None)?;
        Ok(self.finish())
    }

    /// How many samples each pixel is to have, by a pilot alone: no sample that counts has any influence.
    fn decide(&mut self, sampling: &AdaptiveSampling) -> Result<Vec<u64>, ObserverError> {
        let lane = self.observer.lane_number();
        let pixels: Vec<usize> = self.observed().collect();
        let mut pilot: Vec<Frame> =
            self.pipelines.iter().map(|p| p.frame().emptied(lane, &self.mask)).collect();
        self.rays = vec![0; self.mask.len()];
        self.meter.say("pilot".to_owned());
        let mut plan = SamplePlan::new(sampling, pixels.len());
        loop {
            let due: Vec<u64> = plan.samples().iter().map(|&samples| plan.pilot(samples)).collect();
            let goals = spread(self.mask.len(), &pixels, &due);
            self.meter.foresee(goals.iter().sum());
            self.pilot(&mut pilot, &goals)?;
            let noise = Noise::of(sampling, &pilot[0], &pixels, &self.rays);
            if self.report.cancelled || !plan.extend(&noise) {
                self.meter.say(String::new());
                self.rays = Vec::new();
                let inaccurate = plan.inaccurate(&noise);
                self.report.convergence = sampling.target().map(|_| Convergence {
                    reached: inaccurate == 0 && !self.report.cancelled,
                    unconverged: inaccurate,
                    elements: pixels.len(),
                    pilot_samples: self.report.pilot_samples / pixels.len() as u64,
                });
                return Ok(spread(self.mask.len(), &pixels, plan.samples()));
            }
        }
    }
}

/// Numbers of some pixels in their places in the picture; zero elsewhere.
fn spread(count: usize, pixels: &[usize], numbers: &[u64]) -> Vec<u64> {
    let mut all = vec![0; count];
    pixels.iter().zip(numbers).for_each(|(&pixel, &number)| all[pixel] = number);
    all
}
