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
    /// Samples of all pixels that are foreseen.
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

    /// The time that the samples still missing will take at this rate; none before the first sample.
    pub fn left(&self) -> Option<Duration> {
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
    total: u64,
    relative_error: f64,
}

const INTERVAL: Duration = Duration::from_millis(200);

impl Meter {
    pub(crate) fn new(total: u64, quiet: bool, watcher: Option<Arc<Watcher>>) -> Self {
        let bar = ProgressBar::with_draw_target(Some(total), ProgressDrawTarget::hidden());
        if !quiet && std::io::stderr().is_terminal() {
            bar.set_draw_target(ProgressDrawTarget::stderr_with_hz(4));
        }
        let template =
            "{elapsed_precise} {wide_bar} {percent:>3} % {human_pos} samples, {per_sec}, {eta} left {msg}";
        if let Ok(style) = ProgressStyle::with_template(template) {
            bar.set_style(style);
        }
        let now = Instant::now();
        Self { bar, watcher, started: now, told: now, samples: 0, total, relative_error: f64::INFINITY }
    }

    /// Another number of samples is foreseen.
    pub(crate) fn foresee(&mut self, total: u64) {
        self.total = total.max(self.samples);
        self.bar.set_length(self.total);
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
            if let Some(watcher) = &self.watcher {
                watcher(&Progress {
                    samples: self.samples,
                    total: self.total,
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
    }
}
