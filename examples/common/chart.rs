//! A chart of curves and bands, written as PNG.

use std::io;
use std::path::Path;

use kuva::plot::{BandPlot, LegendEntry, LegendPosition, LegendShape, LinePlot};
use kuva::render::layout::Layout;
use kuva::render::plots::Plot;

/// Curves and bands of values that are not negative; what is added later lies on top.
pub(crate) struct Chart {
    labels: [String; 3],
    x: Vec<f64>,
    top: f64,
    plots: Vec<Plot>,
    legend: Vec<LegendEntry>,
}

/// Logical size in pixels; the file has twice as many.
const SIZE: (f64, f64) = (800.0, 500.0);

/// Height of the chart relative to the largest value: the legend fits in above.
const HEADROOM: f64 = 1.3;

impl Chart {
    /// With places in ascending order that all curves share. A label of an axis ends with its unit.
    pub(crate) fn new(title: &str, x_label: &str, y_label: &str, x: Vec<f64>) -> Self {
        let labels = [title, x_label, y_label].map(str::to_owned);
        Self { labels, x, top: 0.0, plots: Vec::new(), legend: Vec::new() }
    }

    /// Adds a line.
    pub(crate) fn curve(self, name: &str, colour: &str, y: &[f64]) -> Self {
        let points: Vec<(f64, f64)> = self.x.iter().copied().zip(y.iter().copied()).collect();
        let line = LinePlot::new().with_data(points).with_color(colour).with_stroke_width(1.5);
        self.add(line, LegendShape::Line, name, colour, y)
    }

    /// Adds an area that reaches so far above and below a line.
    pub(crate) fn band(self, name: &str, colour: &str, y: &[f64], half: &[f64]) -> Self {
        let edge = |sign: f64| y.iter().zip(half).map(|(y, h)| y + sign * h).collect::<Vec<f64>>();
        let (lower, upper) = (edge(-1.0), edge(1.0));
        let band = BandPlot::new(self.x.clone(), lower, upper.clone()).with_color(colour).with_opacity(1.0);
        self.add(band, LegendShape::Rect, name, colour, &upper)
    }

    fn add(
        mut self,
        plot: impl Into<Plot>,
        shape: LegendShape,
        name: &str,
        colour: &str,
        values: &[f64],
    ) -> Self {
        let (label, color) = (name.to_owned(), colour.to_owned());
        self.plots.push(plot.into());
        self.legend.push(LegendEntry { label, color, shape, dasharray: None });
        self.top = values.iter().copied().fold(self.top, f64::max);
        self
    }

    /// Writes the picture.
    pub(crate) fn save(self, path: &Path) -> io::Result<()> {
        let [title, x_label, y_label] = self.labels;
        let layout = Layout::auto_from_plots(&self.plots)
            .with_width(SIZE.0)
            .with_height(SIZE.1)
            .with_title(title)
            .with_x_label(x_label)
            .with_y_label(y_label)
            .with_x_axis_min(self.x[0])
            .with_x_axis_max(self.x[self.x.len() - 1])
            .with_y_axis_min(0.0)
            .with_y_axis_max(if self.top > 0.0 { HEADROOM * self.top } else { 1.0 })
            .with_legend_entries(self.legend)
            .with_legend_position(LegendPosition::InsideTopRight);
        let png = kuva::render_to_png(self.plots, layout, 2.0).map_err(io::Error::other)?;
        std::fs::write(path, png)
    }
}
