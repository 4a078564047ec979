use super::rule::Rule;
use super::samples::Sample;

/// Differences of radiance below this are not worth a halving: numbers so small have lost their digits.
pub(super) const UNDERFLOW: f64 = f64::MIN_POSITIVE / f64::EPSILON;

/// What a piece adds, and how much it lets through, bin by bin.
#[derive(Debug, Clone, Default)]
pub(super) struct Cell {
    /// Light that leaves it at the end where the path comes in [W/m²/sr/nm].
    pub(super) light: Vec<f64>,
    /// Its optical depth.
    pub(super) depth: Vec<f64>,
    /// The largest emission met [W/m³/sr/nm] and attenuation [1/m].
    pub(super) peak: [f64; 2],
}

impl Cell {
    pub(super) fn clear(&mut self, bins: usize) {
        for values in [&mut self.light, &mut self.depth] {
            values.clear();
            values.resize(bins, 0.0);
        }
    }
}

/// Room for line integrals, grown at first use.
#[derive(Debug)]
pub(in crate::path) struct LineRoom {
    pub(super) rule: Rule,
    pub(super) breaks: Vec<f64>,
    pub(super) samples: Vec<Sample>,
    /// Sum from the beginning of the piece.
    pub(super) sum: Cell,
    pub(super) cells: [Cell; 3],
    /// How much light a piece will add, roughly.
    pub(super) scale: Vec<f64>,
    /// Coefficients at the nodes of a cell, node by node.
    pub(super) emission: Vec<f64>,
    pub(super) attenuation: Vec<f64>,
    pub(super) stack: Vec<(f64, f64, u32)>,
}

impl Default for LineRoom {
    fn default() -> Self {
        Self {
            rule: Rule::new(),
            breaks: Vec::new(),
            samples: Vec::new(),
            sum: Cell::default(),
            cells: Default::default(),
            scale: Vec::new(),
            emission: Vec::new(),
            attenuation: Vec::new(),
            stack: Vec::new(),
        }
    }
}

impl LineRoom {
    /// Appends a cell to the sum.
    pub(super) fn add(&mut self, place: usize) {
        let cell = &self.cells[place];
        for i in 0..cell.light.len() {
            if cell.light[i] != 0.0 {
                self.sum.light[i] += cell.light[i] * (-self.sum.depth[i]).exp();
            }
            self.sum.depth[i] += cell.depth[i];
        }
    }

    /// True if a cell and its two halves give the same.
    pub(super) fn agrees(&self, tolerance: f64) -> bool {
        let [whole, first, second] = &self.cells;
        (0..whole.light.len()).all(|i| {
            let depth = first.depth[i] + second.depth[i];
            let light = first.light[i] + second.light[i] * (-first.depth[i]).exp();
            let off = (whole.light[i] - light).abs();
            let through = (-self.sum.depth[i]).exp();
            let seen = off * through <= tolerance * (self.scale[i] * through).max(self.sum.light[i].abs());
            // What nothing gets through need not be known to many digits.
            let depth_off = (whole.depth[i] - depth).abs();
            let deep = depth_off * (-whole.depth[i].min(depth)).exp() <= tolerance || through == 0.0;
            (seen || off <= UNDERFLOW || through == 0.0) && deep
        })
    }
}
