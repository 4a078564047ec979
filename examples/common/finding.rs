//! What a comparison with recorded numbers finds.

/// What the comparison of one case finds.
pub(crate) struct Finding {
    pub(crate) id: String,
    /// How many things were compared.
    pub(crate) compared: usize,
    /// A sentence for each that differs.
    pub(crate) mismatches: Vec<String>,
    /// The largest error in the units of its tolerance's rule; infinite where ours is not a number.
    pub(crate) max_error: f64,
}

impl Finding {
    /// Nothing compared yet.
    pub(crate) fn new(id: impl Into<String>) -> Self {
        Self { id: id.into(), compared: 0, mismatches: Vec::new(), max_error: 0.0 }
    }

    /// Something that either holds or does not.
    pub(crate) fn expect(&mut self, holds: bool, sentence: impl FnOnce() -> String) {
        self.compared += 1;
        if !holds {
            self.mismatches.push(sentence());
        }
    }

    /// An error that may be as large as a tolerance; NaN never is small enough.
    pub(crate) fn measure(&mut self, error: f64, tolerance: f64, sentence: impl FnOnce() -> String) {
        self.expect(error <= tolerance, sentence);
        self.max_error = self.max_error.max(if error.is_nan() { f64::INFINITY } else { error });
    }
}
