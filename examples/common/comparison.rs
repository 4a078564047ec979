//! Compares two pictures with error bars, element by element, block by block, and as a whole.

use std::fmt;

/// Means and standard errors of a picture, \[row, column, channel\].
#[derive(Debug, Clone)]
pub(crate) struct Picture {
    pub(crate) rows: usize,
    pub(crate) columns: usize,
    pub(crate) channels: usize,
    pub(crate) mean: Vec<f64>,
    pub(crate) error: Vec<f64>,
}

/// What a comparison finds, and whether it is good enough.
#[derive(Debug, Clone)]
pub(crate) struct Comparison {
    pub(crate) elements: usize,
    /// Share of elements that differ by more than 4.5 of their combined errors.
    pub(crate) outliers: f64,
    pub(crate) mean_z: f64,
    pub(crate) deviation_z: f64,
    /// The largest difference of a block of 4×4 pixels, and of the whole, in combined errors.
    pub(crate) worst_block: f64,
    pub(crate) worst_total: f64,
    /// Median relative error of the first picture.
    pub(crate) median_error: f64,
}

/// Side of a block of pixels.
const BLOCK: usize = 4;

impl Picture {
    fn at(&self, row: usize, column: usize, channel: usize) -> usize {
        (row * self.columns + column) * self.channels + channel
    }

    /// Median of the relative standard errors.
    pub(crate) fn median_error(&self) -> f64 {
        let mut relative: Vec<f64> =
            self.mean.iter().zip(&self.error).filter(|(m, _)| **m != 0.0).map(|(m, e)| e / m.abs()).collect();
        relative.sort_by(f64::total_cmp);
        relative.get(relative.len() / 2).copied().unwrap_or(f64::INFINITY)
    }
}

/// Difference of two values in units of their combined error.
fn z_score(a: (f64, f64), b: (f64, f64)) -> f64 {
    // Elements without variance on either side may still differ by rounding.
    let floor = 1e-9 * a.0.abs().max(b.0.abs());
    let sigma = (a.1 * a.1 + b.1 * b.1 + floor * floor).sqrt();
    if sigma == 0.0 { 0.0 } else { (a.0 - b.0) / sigma }
}

/// Sum and its error over a rectangle of pixels.
fn region(
    p: &Picture,
    rows: std::ops::Range<usize>,
    columns: std::ops::Range<usize>,
    channel: usize,
) -> (f64, f64) {
    let mut sum = (0.0, 0.0);
    for row in rows {
        for column in columns.clone() {
            let i = p.at(row, column, channel);
            sum = (sum.0 + p.mean[i], sum.1 + p.error[i] * p.error[i]);
        }
    }
    (sum.0, sum.1.sqrt())
}

/// Compares two pictures of the same shape.
pub(crate) fn compare(ours: &Picture, theirs: &Picture) -> Result<Comparison, String> {
    let shape = |p: &Picture| (p.rows, p.columns, p.channels);
    if shape(ours) != shape(theirs) {
        return Err(format!("shapes {:?} and {:?} cannot be compared", shape(ours), shape(theirs)));
    }
    let n = ours.mean.len();
    let z: Vec<f64> =
        (0..n).map(|i| z_score((ours.mean[i], ours.error[i]), (theirs.mean[i], theirs.error[i]))).collect();
    let mean_z = z.iter().sum::<f64>() / n as f64;
    let deviation_z = (z.iter().map(|z| (z - mean_z).powi(2)).sum::<f64>() / (n as f64 - 1.0)).sqrt();
    let (mut worst_block, mut worst_total) = (0.0f64, 0.0f64);
    for channel in 0..ours.channels {
        for row in (0..ours.rows).step_by(BLOCK) {
            for column in (0..ours.columns).step_by(BLOCK) {
                let rows = row..(row + BLOCK).min(ours.rows);
                let columns = column..(column + BLOCK).min(ours.columns);
                let of = |p| region(p, rows.clone(), columns.clone(), channel);
                worst_block = worst_block.max(z_score(of(ours), of(theirs)).abs());
            }
        }
        let of = |p| region(p, 0..ours.rows, 0..ours.columns, channel);
        worst_total = worst_total.max(z_score(of(ours), of(theirs)).abs());
    }
    Ok(Comparison {
        elements: n,
        outliers: z.iter().filter(|z| z.abs() > 4.5).count() as f64 / n as f64,
        mean_z,
        deviation_z,
        worst_block,
        worst_total,
        median_error: ours.median_error(),
    })
}

impl Comparison {
    /// Each criterion with what was found and whether it holds.
    pub(crate) fn criteria(&self, largest_error: f64) -> Vec<(String, bool)> {
        let range = |v: f64, low: f64, high: f64| v >= low && v <= high;
        vec![
            (
                format!("beyond 4.5 sigma: {:.3} % (at most 1 %)", 100.0 * self.outliers),
                self.outliers <= 0.01,
            ),
            (format!("mean z: {:+.3} (within 0.25)", self.mean_z), self.mean_z.abs() < 0.25),
            (
                format!("standard deviation of z: {:.3} (0.7 to 1.5)", self.deviation_z),
                range(self.deviation_z, 0.7, 1.5),
            ),
            (format!("worst 4x4 block: {:.2} sigma (within 4)", self.worst_block), self.worst_block < 4.0),
            (format!("frame total: {:.2} sigma (within 4)", self.worst_total), self.worst_total < 4.0),
            (
                format!(
                    "median error: {:.3} % (at most {} %)",
                    100.0 * self.median_error,
                    100.0 * largest_error
                ),
                self.median_error <= largest_error,
            ),
        ]
    }

    /// True if every criterion holds.
    pub(crate) fn holds(&self, largest_error: f64) -> bool {
        self.criteria(largest_error).iter().all(|(_, holds)| *holds)
    }
}

impl fmt::Display for Comparison {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} elements, mean z {:+.3}, sd {:.3}", self.elements, self.mean_z, self.deviation_z)
    }
}
