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
        Self { bar, watcher, started: now, told: now, samples: 0, total }
    }

    /// Another number of samples is foreseen.
    pub(crate) fn foresee(&mut self, total: u64) {
        self.total = total.max(self.samples);
        self.bar.set_length(self.total);
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
