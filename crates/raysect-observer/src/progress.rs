//! Telling how far an observation is.

use std::io::IsTerminal;
use std::sync::Arc;
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

/// How far an observation is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Progress {
    /// Samples of all pixels that are done.
    pub samples: u64,
    /// Samples of all pixels that are foreseen, where time ends an observation by the rate so far; `u64::MAX` as long as
    /// nothing is foreseen.
    pub total: u64,
    /// Time since its beginning.
    pub elapsed: Duration,
    /// Relative standard error of the total of the first pipeline's first channel after the last pass; infinite before
    /// the first.
    pub relative_error: f64,
}

impl Progress {
    /// Samples of all pixels a second, so far.
    pub fn rate(&self) -> f64 {
        let seconds = self.elapsed.as_secs_f64();
        if seconds > 0.0 { self.samples as f64 / seconds } else { 0.0 }
    }

    /// The time that the samples still missing will take at this rate; none before the first sample, and as long as
    /// nothing is foreseen.
    pub fn left(&self) -> Option<Duration> {
        if self.total == u64::MAX {
            return None;
        }
        let missing = self.total.saturating_sub(self.samples) as f64;
        Duration::try_from_secs_f64(missing / self.rate()).ok()
    }
}

/// A user's function that follows an observation.
pub(crate) type Watcher = dyn Fn(&Progress) + Send + Sync;

/// Shows a bar on a terminal, and tells a user's function.
pub(crate) struct Meter {
    bar: ProgressBar,
    watcher: Option<Arc<Watcher>>,
    started: Instant,
    told: Instant,
    samples: u64,
    /// What is foreseen by numbers, and when time ends it [s].
    total: u64,
    deadline: Option<f64>,
    relative_error: f64,
}

const INTERVAL: Duration = Duration::from_millis(200);

impl Meter {
    pub(crate) fn new(quiet: bool, watcher: Option<Arc<Watcher>>) -> Self {
        let bar = ProgressBar::with_draw_target(Some(0), ProgressDrawTarget::hidden());
        if !quiet && std::io::stderr().is_terminal() {
            bar.set_draw_target(ProgressDrawTarget::stderr_with_hz(4));
        }
        let template =
            "{elapsed_precise} {wide_bar} {percent:>3} % {human_pos} samples, {per_sec}, {eta} left {msg}";
        if let Ok(style) = ProgressStyle::with_template(template) {
            bar.set_style(style);
        }
        let now = Instant::now();
        Self {
            bar,
            watcher,
            started: now,
            told: now,
            samples: 0,
            total: u64::MAX,
            deadline: None,
            relative_error: f64::INFINITY,
        }
    }

    /// Time ends the observation [s].
    pub(crate) fn end_after(&mut self, deadline: Option<f64>) {
        self.deadline = deadline;
    }

    /// Samples that will have been taken when numbers or time end the observation.
    fn expected(&self) -> u64 {
        let Some(deadline) = self.deadline else { return self.total };
        let in_time = self.samples as f64 * deadline / self.elapsed().as_secs_f64();
        if in_time.is_nan() { self.total } else { (in_time as u64).clamp(self.samples, self.total) }
    }

    /// Another number of samples is foreseen.
    pub(crate) fn foresee(&mut self, total: u64) {
        self.total = total.max(self.samples);
        self.bar.set_length(self.expected());
    }

    /// The relative error of the total is known anew.
    pub(crate) fn set_error(&mut self, relative_error: f64) {
        self.relative_error = relative_error;
        if relative_error.is_finite() {
            self.say(format!("± {:.2} %", 100.0 * relative_error));
        }
    }

    pub(crate) fn say(&self, message: String) {
        self.bar.set_message(message);
    }

    pub(crate) fn add(&mut self, samples: u64) {
        self.samples += samples;
        self.bar.set_position(self.samples);
        if self.told.elapsed() >= INTERVAL || self.samples >= self.total {
            self.told = Instant::now();
            let total = self.expected();
            self.bar.set_length(total);
            if let Some(watcher) = &self.watcher {
                watcher(&Progress {
                    samples: self.samples,
                    total,
                    elapsed: self.started.elapsed(),
                    relative_error: self.relative_error,
                });
            }
        }
    }

    pub(crate) fn elapsed(&self) -> Duration {
        self.started.elapsed()
    }
}

impl Drop for Meter {
    fn drop(&mut self) {
        self.bar.finish_and_clear();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rate_and_time_left_are_those_of_the_samples() {
        let elapsed = Duration::from_secs(20);
        let progress = Progress { samples: 100, total: 400, elapsed, relative_error: 0.1 };
        assert_eq!((progress.rate(), progress.left()), (5.0, Some(Duration::from_secs(60))));
        let begun = Progress { samples: 0, total: 400, elapsed: Duration::ZERO, ..progress };
        assert_eq!((begun.rate(), begun.left()), (0.0, None));
        let done = Progress { samples: 400, ..progress };
        assert_eq!(done.left(), Some(Duration::ZERO));
        assert_eq!(Progress { total: u64::MAX, ..progress }.left(), None);
    }

    #[test]
    fn time_foresees_samples_by_their_rate() {
        let mut meter = Meter::new(true, None);
        meter.end_after(Some(1000.0));
        meter.add(50);
        std::thread::sleep(Duration::from_millis(20));
        let expected = meter.expected() as f64;
        let by_rate = 50.0 * 1000.0 / meter.elapsed().as_secs_f64();
        assert!(expected >= by_rate && expected < 50.0 * 1000.0 / 0.02, "{expected} {by_rate}");
        meter.foresee(60);
        assert_eq!(meter.expected(), 60);
        meter.end_after(Some(1e-9));
        assert_eq!(meter.expected(), 50);
    }
}
