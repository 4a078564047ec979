//! A cell of a grid: one question, many rays.

/// What a judge has seen.
#[derive(Debug, Clone)]
pub(crate) struct Tally {
    /// Rays, bounces or questions that were judged.
    pub(crate) rays: u64,
    /// How many were wrong.
    pub(crate) failures: u64,
    /// The greatest error, in units of the cell; 0 where there is only right and wrong.
    pub(crate) worst: f64,
    /// The greatest error that is admitted.
    pub(crate) limit: f64,
    /// What was wrong first.
    pub(crate) first: Option<String>,
}

impl Tally {
    /// Counts a ray.
    pub(crate) fn ray(&mut self) {
        self.rays += 1;
    }

    /// Counts a failure.
    pub(crate) fn fail(&mut self, what: impl FnOnce() -> String) {
        self.failures += 1;
        self.first.get_or_insert_with(what);
    }

    /// Counts a failure unless something holds.
    pub(crate) fn check(&mut self, holds: bool, what: impl FnOnce() -> String) {
        if !holds {
            self.fail(what);
        }
    }

    /// Takes note of an error, which is a failure above the limit.
    pub(crate) fn error(&mut self, error: f64, what: impl FnOnce() -> String) {
        if error > self.worst || error.is_nan() {
            self.worst = error;
        }
        self.check(error <= self.limit, what);
    }

    /// True if something was judged and nothing was wrong.
    pub(crate) fn holds(&self) -> bool {
        self.rays > 0 && self.failures == 0 && self.worst <= self.limit
    }
}

type Judge = dyn Fn(u64, &mut Tally) + Send + Sync;

/// A question with its judge.
pub(crate) struct Cell {
    /// What is asked, of what.
    pub(crate) name: String,
    /// Takes part in the test-suite; the others are left to the example.
    pub(crate) core: bool,
    limit: f64,
    share: f64,
    judge: Box<Judge>,
}

impl Cell {
    /// A judge is given a number of rays and the tally, which carries the limit.
    pub(crate) fn new(
        name: impl Into<String>,
        limit: f64,
        judge: impl Fn(u64, &mut Tally) + Send + Sync + 'static,
    ) -> Self {
        Self { name: name.into(), core: true, limit, share: 1.0, judge: Box::new(judge) }
    }

    /// With so many rays for one of other cells: less where a ray is dear, more where it is cheap.
    pub(crate) fn share(self, share: f64) -> Self {
        Self { share, ..self }
    }

    /// Only in the example, unless `core`.
    pub(crate) fn core(self, core: bool) -> Self {
        Self { core, ..self }
    }

    /// Asks with about so many rays.
    pub(crate) fn run(&self, rays: u64) -> Tally {
        let mut tally = Tally { rays: 0, failures: 0, worst: 0.0, limit: self.limit, first: None };
        (self.judge)(((rays as f64 * self.share) as u64).max(1), &mut tally);
        tally
    }
}
