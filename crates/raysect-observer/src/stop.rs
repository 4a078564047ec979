//! When to stop, and what the samples that decide have to do with those that count: nothing.

use std::time::Duration;

use raysect_math::MathError;

use crate::frame::Estimate;
use crate::{Frame, ObserverError};

/// What a stop rule looks at.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum Scope {
    /// The sum over all pixels of each channel.
    #[default]
    Total,
    /// Each pixel and channel: this share of them, 0 … 1, must be accurate enough.
    Pixels(f64),
    /// Each pixel and channel that may be as bright as a level: this share of them. A pixel is left out once its value
    /// lies three standard errors below the level, and so does what could hide between its samples.
    Above {
        /// The level [unit of the pipeline].
        level: f64,
        /// The share, 0 … 1.
        share: f64,
    },
}

impl Scope {
    /// How many of the values that it looks at must be accurate enough, 0 … 1.
    fn share(self) -> f64 {
        match self {
            Self::Total => 1.0,
            Self::Pixels(share) | Self::Above { share, .. } => share,
        }
    }
}

/// When an observation is good enough, or has taken long enough.
///
/// ```
/// use raysect_observer::{Scope, Stop, minutes};
/// let stop = Stop::relative_error(0.01).or_after(minutes(10.0));
/// let picture = Stop::relative_error(0.05).scope(Scope::Pixels(0.95)).or_samples(10_000);
/// // Two per cent of what is bright, and 0.1 of what is dark.
/// let both = Stop::relative_error(0.02).or_absolute_error(0.1).scope(Scope::Pixels(1.0));
/// let spots = Stop::relative_error(0.02).scope(Scope::Above { level: 10.0, share: 0.99 });
/// ```
///
/// Whether the error is small enough is decided by *pilot* samples of their own, which are thrown away: an average
/// that decides about its own end is biased (a rare bright sample ends it late, its absence early). The pilot needs
/// 30 samples that contribute to each element before it says how many are needed; then that many are taken. Should
/// their error come out a little too large all the same, they are added to, up to four times as many. If that does not
/// suffice either, the pilot was too small: it goes on, and foresees anew, until it sees no reason for more samples than
/// were taken.
///
/// Samples that are all alike do not show that there are no others: where n of them are, fewer than 3 / n of all may
/// differ (the rule of three, at 95 %), and if those are dark the average is off by √3 / n of its value. Only if this
/// is small enough, too, is an error of zero believed: 0.3 % is reached by 578 equal samples, 0.1 % by 1733.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stop {
    relative: Option<f64>,
    absolute: Option<f64>,
    pub(crate) scope: Scope,
    pub(crate) samples: Option<u64>,
    pub(crate) time: Option<Duration>,
}

/// A time in minutes.
pub fn minutes(minutes: f64) -> Duration {
    seconds(60.0 * minutes)
}

/// A time in seconds; none for a negative or NaN number.
pub fn seconds(seconds: f64) -> Duration {
    Duration::try_from_secs_f64(seconds.max(0.0)).unwrap_or(Duration::MAX)
}

/// What an element needs before its error is believed.
pub(crate) const CONTRIBUTING: u64 = 30;

/// Relative error below which samples are alike: rounding.
const ALIKE: f64 = 1e-12;

impl Stop {
    const NEVER: Self =
        Self { relative: None, absolute: None, scope: Scope::Total, samples: None, time: None };

    /// When the standard error is this small relative to the value.
    pub fn relative_error(error: f64) -> Self {
        Self { relative: Some(error), ..Self::NEVER }
    }

    /// When the standard error is this small, in the unit of the pipeline.
    pub fn absolute_error(error: f64) -> Self {
        Self { absolute: Some(error), ..Self::NEVER }
    }

    /// Also when the standard error is this small relative to the value: each value needs one of the two.
    pub fn or_relative_error(self, error: f64) -> Self {
        Self { relative: Some(error), ..self }
    }

    /// Also when the standard error is this small, in the unit of the pipeline: each value needs one of the two.
    pub fn or_absolute_error(self, error: f64) -> Self {
        Self { absolute: Some(error), ..self }
    }

    /// After this many samples a pixel.
    pub fn samples(samples: u64) -> Self {
        Self { samples: Some(samples), ..Self::NEVER }
    }

    /// After this time.
    pub fn time(time: Duration) -> Self {
        Self { time: Some(time), ..Self::NEVER }
    }

    /// Also after this time, whatever is reached by then.
    pub fn or_after(self, time: Duration) -> Self {
        Self { time: Some(time), ..self }
    }

    /// Also after this many samples a pixel, whatever is reached by then.
    pub fn or_samples(self, samples: u64) -> Self {
        Self { samples: Some(samples), ..self }
    }

    /// What the error is asked of.
    pub fn scope(self, scope: Scope) -> Self {
        Self { scope, ..self }
    }

    pub(crate) fn check(&self) -> Result<(), ObserverError> {
        for error in [self.relative, self.absolute].into_iter().flatten() {
            MathError::check(error > 0.0, error, "error to be reached", "", "positive")?;
        }
        if self.samples == Some(0) {
            return Err(ObserverError::Stop("no samples at all"));
        }
        let share = self.scope.share();
        let admitted = share > 0.0 && share <= 1.0;
        MathError::check(admitted, share, "share of the pixels", "", "0 … 1, without 0")?;
        if let Scope::Above { level, .. } = self.scope {
            let (admitted, name) = (level > 0.0 && level.is_finite(), "level of the pixels that count");
            MathError::check(admitted, level, name, "", "positive and finite, in the unit of the pipeline")?;
        }
        Ok(())
    }

    /// True if an error is to be reached.
    pub(crate) fn has_target(&self) -> bool {
        self.relative.is_some() || self.absolute.is_some()
    }

    /// The error that an element of a value is to reach.
    fn target(&self, value: f64) -> f64 {
        let relative = self.relative.map_or(0.0, |r| r * value.abs());
        relative.max(self.absolute.unwrap_or(0.0))
    }
}

/// One number that a stop rule looks at.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Element {
    estimate: Estimate,
    samples: u64,
    contributing: u64,
    /// What its error may be, and what a value too small to matter is.
    target: f64,
    negligible: f64,
    largest: f64,
}

impl Element {
    /// True if nothing has been seen, and what could hide is negligible: fewer than one in n / 3 samples at 95 %
    /// confidence (the rule of three), none larger than the largest seen anywhere.
    fn is_negligible(&self) -> bool {
        self.contributing == 0 && self.hides_at_most(self.negligible)
    }

    /// True if what could hide between the samples would not bring a value to a level. Where nothing at all has been
    /// seen, nothing is known of it.
    fn hides_at_most(&self, level: f64) -> bool {
        self.largest > 0.0 && 3.0 / self.samples as f64 * self.largest <= level
    }

    /// True if the value lies below a level, whatever chance has done to it.
    fn is_below(&self, level: f64) -> bool {
        self.estimate.value + 3.0 * self.estimate.error < level && self.hides_at_most(level)
    }

    /// How many samples that are all alike it takes to be as accurate as asked for; none if they are not alike, or
    /// dark.
    fn alike(&self) -> Option<f64> {
        let value = self.estimate.value.abs();
        let alike = value > 0.0 && self.estimate.error <= ALIKE * value;
        alike.then(|| 3f64.sqrt() * value / self.target)
    }

    pub(crate) fn is_converged(&self) -> bool {
        let shown = self.alike().is_none_or(|needed| self.contributing as f64 >= needed);
        let known = self.contributing >= CONTRIBUTING && self.estimate.error <= self.target && shown;
        known || self.is_negligible()
    }

    /// How many samples it needs in all, from what these tell; none if they tell too little.
    pub(crate) fn needed(&self) -> Option<f64> {
        if self.is_negligible() {
            return Some(self.samples as f64);
        }
        if self.contributing < CONTRIBUTING {
            return None;
        }
        if let Some(needed) = self.alike() {
            let share = self.contributing as f64 / self.samples.max(1) as f64;
            return Some((needed / share).max(self.samples as f64));
        }
        if self.estimate.error == 0.0 {
            // Dark in this channel.
            return Some(self.samples as f64);
        }
        if self.target <= 0.0 {
            return None;
        }
        let ratio = self.estimate.error / self.target;
        // The variance itself is only known to about two over the root of the contributions.
        let margin = 1.0 + 2.0 / (self.contributing as f64).sqrt();
        Some(self.samples as f64 * ratio * ratio * margin)
    }
}

/// The elements that a rule looks at.
pub(crate) fn elements(stop: &Stop, frames: &[Frame]) -> Vec<Element> {
    let mut all = Vec::new();
    for frame in frames {
        let pixels: Vec<usize> = frame.observed_pixels().collect();
        let count = pixels.len() as u64;
        let largest = pixels.iter().map(|&p| frame.largest(p)).fold(0.0, f64::max);
        for channel in 0..frame.channels().len() {
            let total = frame.total_of(channel);
            match stop.scope {
                Scope::Total => all.push(Element {
                    estimate: total,
                    samples: pixels.iter().map(|&p| frame.samples(p)).sum::<u64>() / count.max(1),
                    contributing: pixels.iter().map(|&p| frame.contributing(p)).sum(),
                    target: stop.target(total.value),
                    negligible: 0.0,
                    largest,
                }),
                Scope::Pixels(_) | Scope::Above { .. } => {
                    let negligible = stop.target(total.value / count as f64);
                    let of_pixels = pixels.iter().map(|&p| {
                        let estimate = frame.pixel(p, channel);
                        Element {
                            estimate,
                            samples: frame.samples(p),
                            contributing: frame.contributing(p),
                            target: stop.target(estimate.value),
                            negligible,
                            largest,
                        }
                    });
                    all.extend(of_pixels.filter(|element| match stop.scope {
                        Scope::Above { level, .. } => !element.is_below(level),
                        _ => true,
                    }));
                }
            }
        }
    }
    all
}

/// Samples a pixel that satisfy a rule, by what the pilot tells; none if it tells too little.
pub(crate) fn needed_samples(stop: &Stop, elements: &[Element]) -> Option<u64> {
    let mut needed: Vec<f64> = elements.iter().map(|e| e.needed().unwrap_or(f64::INFINITY)).collect();
    needed.sort_by(f64::total_cmp);
    let place = (needed.len() as f64 * stop.scope.share()).ceil() as usize;
    let Some(most) = place.checked_sub(1) else {
        // Nothing is as bright as the level.
        return Some(0);
    };
    needed.get(most).filter(|n| n.is_finite()).map(|n| n.ceil() as u64)
}

/// True if enough elements have converged, and how many have not.
pub(crate) fn verdict(stop: &Stop, elements: &[Element]) -> (bool, usize) {
    let failed = elements.iter().filter(|e| !e.is_converged()).count();
    let allowed = (1.0 - stop.scope.share()) * elements.len() as f64 + 1e-9;
    (failed as f64 <= allowed, failed)
}
