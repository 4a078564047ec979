use std::fmt;
use std::time::Duration;

use raysect_optical::Ledger;

use crate::Reading;

/// Whether an error that was asked for has been reached.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Convergence {
    /// True if it has been reached in the scope asked for.
    pub reached: bool,
    /// How many values are not accurate enough, among them those that no light has reached.
    pub unconverged: usize,
    /// Of how many.
    pub elements: usize,
    /// Samples a pixel that were spent on the decision alone.
    pub pilot_samples: u64,
}

/// What an observation has done.
#[derive(Debug, Clone, PartialEq)]
pub struct RenderReport {
    /// Number of pixels.
    pub pixels: usize,
    /// Number of passes over them.
    pub passes: usize,
    /// Samples taken of all pixels, by this observation, without those of the pilot.
    pub samples: u64,
    /// Samples taken of all pixels that only decided about the others, and were thrown away.
    pub pilot_samples: u64,
    /// Time taken.
    pub elapsed: Duration,
    /// What has become of the paths, those of the pilot included.
    pub ledger: Ledger,
    /// Samples that were not finite numbers and were counted as zero: a fault in a material.
    pub invalid: u64,
    /// True if it was cancelled.
    pub cancelled: bool,
    /// The two refracting volumes of equal priority in which a path was at once, by their names, if there were such.
    pub contestants: Option<[String; 2]>,
    /// What has been reached, if an error was asked for.
    pub convergence: Option<Convergence>,
    /// What each pipeline has gathered by now, in their order.
    pub readings: Vec<Reading>,
}

impl RenderReport {
    /// Figure of merit of the total of each pipeline's first channel, 1 / (R² t) [1/s]; see [`Reading`].
    pub fn figures_of_merit(&self) -> Vec<f64> {
        self.readings.iter().map(|reading| reading.figure_of_merit).collect()
    }

    /// Paths per second.
    pub fn paths_per_second(&self) -> f64 {
        self.ledger.paths as f64 / self.elapsed.as_secs_f64()
    }

    /// Rays per second, those towards lights included.
    pub fn rays_per_second(&self) -> f64 {
        (self.ledger.rays + self.ledger.shadow_rays) as f64 / self.elapsed.as_secs_f64()
    }

    /// The share of light that paths cut off by `max_depth` may have missed, in an enclosure of uniform radiance.
    pub fn truncated_share(&self) -> f64 {
        self.ledger.truncated_throughput / (self.ledger.paths as f64).max(1.0)
    }

    /// What a careful user should know before believing the result.
    pub fn warnings(&self) -> Vec<String> {
        let mut all = Vec::new();
        let l = &self.ledger;
        if self.invalid > 0 {
            all.push(format!(
                "{} samples were not finite and were counted as zero: a material is at fault",
                self.invalid
            ));
        }
        if l.truncated > 0 {
            let share = self.truncated_share();
            all.push(format!(
                "{} paths were cut off by max_depth, with {share:.2e} of the throughput",
                l.truncated
            ));
        }
        if l.lost > 0 {
            all.push(format!(
                "{} paths were lost between transparent surfaces or in a volume without end",
                l.lost
            ));
        }
        if l.inconsistencies > 0 {
            all.push(format!(
                "{} times the surfaces passed did not agree with the media around",
                l.inconsistencies
            ));
        }
        if let Some([first, second]) = &self.contestants {
            all.push(format!(
                "{} times a path was in two refracting volumes of equal priority at once, as {first} and {second}: \
                 the later node counts; say by their priorities which is meant",
                l.contested
            ));
        }
        if l.unresolved > 0 {
            all.push(format!(
                "{} line integrals through volumes did not reach their tolerance, or met more attenuation than was declared",
                l.unresolved
            ));
        }
        if let Some(c) = self.convergence.filter(|c| !c.reached) {
            all.push(format!(
                "not converged: {} of {} values are less accurate than asked for",
                c.unconverged, c.elements
            ));
        }
        all.extend(self.readings.iter().flat_map(Reading::warnings));
        all
    }

    /// What has become of the paths, in words.
    fn fates(&self) -> String {
        let l = &self.ledger;
        let share = |number: u64, fate: &str| {
            let percent = 100.0 * number as f64 / (l.paths as f64).max(1.0);
            let some = if number == 0 { "none".to_owned() } else { format!("{number} ({percent:.3} %)") };
            format!("{some} {fate}")
        };
        let fates = [
            share(l.absorbed, "absorbed"),
            share(l.escaped, "escaped"),
            share(l.killed, "ended by roulette"),
            share(l.truncated, "cut off"),
            share(l.lost, "lost"),
        ];
        format!("{} paths, {} with light: {}", l.paths, l.collected, fates.join(", "))
    }
}

impl fmt::Display for RenderReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let l = &self.ledger;
        let per_path = (l.rays + l.shadow_rays) as f64 / (l.paths as f64).max(1.0);
        writeln!(
            f,
            "{} samples of {} pixels in {} passes, {:.2} s: {:.3e} paths/s, {:.3e} rays/s ({per_path:.2} a path)",
            self.samples,
            self.pixels,
            self.passes,
            self.elapsed.as_secs_f64(),
            self.paths_per_second(),
            self.rays_per_second(),
        )?;
        f.write_str(&self.fates())?;
        if self.pilot_samples > 0 {
            write!(f, "\n{} more samples decided how many to take, and do not count", self.pilot_samples)?;
        }
        for reading in &self.readings {
            write!(f, "\n{reading}")?;
        }
        if let Some(c) = &self.convergence {
            let word = if c.reached { "reached" } else { "not reached" };
            write!(f, "\nerror {word}: {} of {} values within it", c.elements - c.unconverged, c.elements)?;
        }
        for warning in self.warnings() {
            write!(f, "\nwarning: {warning}")?;
        }
        Ok(())
    }
}
