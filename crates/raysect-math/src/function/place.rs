/// Where a function is evaluated: one number, or a pair or triple of them.
///
/// Implemented by `f64`, `(f64, f64)` and `(f64, f64, f64)`, the arguments of functions of one, two and three
/// variables.
pub trait Place: Copy + Send + Sync + 'static {
    /// The coordinates in order, for messages.
    fn coordinates(self) -> Vec<f64>;
}

impl Place for f64 {
    fn coordinates(self) -> Vec<f64> {
        vec![self]
    }
}

impl Place for (f64, f64) {
    fn coordinates(self) -> Vec<f64> {
        vec![self.0, self.1]
    }
}

impl Place for (f64, f64, f64) {
    fn coordinates(self) -> Vec<f64> {
        vec![self.0, self.1, self.2]
    }
}
