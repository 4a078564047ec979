use std::path::Path;

use super::axis::Axis;
use super::svg::{Anchor, Area, Svg, save};
use crate::ObserverError;

/// Curves over a common axis, with bands of ± one standard error.
///
/// Points that are not finite interrupt a curve. A legend appears for more than one curve.
#[derive(Debug, Clone)]
pub struct LinePlot {
    title: String,
    x_label: String,
    y_label: String,
    curves: Vec<Curve>,
    /// The ends of the x axis, if they are not those of the curves.
    range: Option<(f64, f64)>,
}

#[derive(Debug, Clone)]
struct Curve {
    name: String,
    /// Place, value and half the height of the band.
    points: Vec<(f64, f64, f64)>,
}

const SIZE: (f64, f64) = (800.0, 500.0);
const AREA: Area = Area { left: 84.0, top: 40.0, width: 692.0, height: 396.0 };

/// Colours that people of any colour vision tell apart (M. Okabe, K. Ito, *Color Universal Design*, 2008).
const COLOURS: [&str; 7] = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#56b4e9", "#e69f00", "#000000"];

impl LinePlot {
    /// Without curves. The label of an axis ends with its unit in brackets: `power [W/nm]`.
    pub fn new(title: impl Into<String>, x_label: impl Into<String>, y_label: impl Into<String>) -> Self {
        let (title, x_label, y_label) = (title.into(), x_label.into(), y_label.into());
        Self { title, x_label, y_label, curves: Vec::new(), range: None }
    }

    /// Adds a curve, with a band if there are errors. Of lists of different lengths, the shortest counts.
    pub fn curve(mut self, name: impl Into<String>, x: &[f64], y: &[f64], errors: Option<&[f64]>) -> Self {
        let error =
            |i: usize| errors.and_then(|e| e.get(i)).copied().filter(|e| e.is_finite()).unwrap_or(0.0);
        let points = x.iter().zip(y).enumerate().map(|(i, (&x, &y))| (x, y, error(i))).collect();
        self.curves.push(Curve { name: name.into(), points });
        self
    }

    /// With an x axis from one value to another, instead of from the first point to the last. Curves that reach farther
    /// widen it; values that are not finite change nothing.
    pub fn x_range(mut self, low: f64, high: f64) -> Self {
        self.range = (low.is_finite() && high.is_finite()).then_some((low, high));
        self
    }

    /// The plot as the text of an SVG file.
    pub fn to_svg(&self) -> String {
        let (x_axis, y_axis) = self.axes();
        let place = |x: f64, y: f64| {
            (AREA.left + x_axis.place(x) * AREA.width, AREA.top + (1.0 - y_axis.place(y)) * AREA.height)
        };
        let mut svg = Svg::new(SIZE.0, SIZE.1);
        for (value, _) in y_axis.marks() {
            let (_, y) = place(x_axis.low, value);
            svg.line((AREA.left, y), (AREA.left + AREA.width, y), "#dddddd", 1.0);
        }
        for (curve, colour) in self.curves.iter().zip(COLOURS.iter().cycle()) {
            for run in curve.points.split(|(x, y, _)| !(x.is_finite() && y.is_finite())) {
                let upper = run.iter().map(|&(x, y, e)| place(x, y + e));
                let lower = run.iter().rev().map(|&(x, y, e)| place(x, y - e));
                let band: Vec<(f64, f64)> = upper.chain(lower).collect();
                let line: Vec<(f64, f64)> = run.iter().map(|&(x, y, _)| place(x, y)).collect();
                if run.iter().any(|(_, _, error)| *error > 0.0) {
                    svg.polygon(&band, colour);
                }
                if !line.is_empty() {
                    svg.polyline(&line, colour);
                }
            }
        }
        svg.rectangle(AREA, "none", "black");
        svg.x_axis(AREA, &x_axis, &self.x_label);
        svg.y_axis(AREA, &y_axis, &self.y_label);
        svg.title(AREA, &self.title);
        self.legend(&mut svg);
        svg.finish()
    }

    /// Writes the plot as SVG.
    ///
    /// # Errors
    /// [`ObserverError::File`].
    pub fn save(&self, path: impl AsRef<Path>) -> Result<(), ObserverError> {
        save(path.as_ref(), &self.to_svg())
    }

    fn axes(&self) -> (Axis, Axis) {
        let all =
            || self.curves.iter().flat_map(|c| &c.points).filter(|(x, y, _)| x.is_finite() && y.is_finite());
        let span = |values: &mut dyn Iterator<Item = f64>| {
            values.fold(None, |span, v| match span {
                None => Some((v, v)),
                Some((low, high)) => Some((f64::min(low, v), f64::max(high, v))),
            })
        };
        let ends = self.range.into_iter().flat_map(|(low, high)| [low, high]);
        let x = span(&mut all().map(|p| p.0).chain(ends)).unwrap_or((0.0, 1.0));
        let y = span(&mut all().flat_map(|p| [p.1 - p.2, p.1 + p.2])).unwrap_or((0.0, 1.0));
        // A band below zero says nothing of values that cannot be there.
        let lowest = span(&mut all().map(|p| p.1)).map_or(0.0, |(low, _)| low);
        let low = if lowest >= 0.0 { y.0.max(0.0) } else { y.0 };
        (Axis::over(x.0, x.1), Axis::around(low, y.1))
    }

    fn legend(&self, svg: &mut Svg) {
        if self.curves.len() < 2 {
            return;
        }
        for (number, (curve, colour)) in self.curves.iter().zip(COLOURS.iter().cycle()).enumerate() {
            let (right, y) = (AREA.left + AREA.width - 12.0, AREA.top + 20.0 + 18.0 * number as f64);
            svg.line((right - 24.0, y - 4.0), (right, y - 4.0), colour, 3.0);
            svg.text((right - 30.0, y), Anchor::End, 13.0, &curve.name);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The points of all elements of a kind.
    fn points(svg: &str, element: &str) -> Vec<Vec<(f64, f64)>> {
        let pairs = |text: &str| {
            let pair =
                |p: &str| p.split_once(',').map(|(x, y)| (x.parse().unwrap(), y.parse().unwrap())).unwrap();
            text.split(' ').map(pair).collect()
        };
        let lead = format!("<{element} points=\"");
        svg.split(&lead).skip(1).map(|rest| pairs(rest.split('"').next().unwrap())).collect()
    }

    #[test]
    fn points_lie_where_the_axes_say() {
        let plot = LinePlot::new("t", "x [m]", "y [s]").curve("a", &[0.0, 1.0, 4.0], &[0.0, 2.0, 8.0], None);
        let svg = plot.to_svg();
        let lines = points(&svg, "polyline");
        let (x, y) = (|x: f64| 84.0 + 692.0 * x / 4.0, |y: f64| 436.0 - 396.0 * y / 8.4);
        assert_eq!(lines.len(), 1);
        for (found, expected) in lines[0].iter().zip([(0.0, 0.0), (1.0, 2.0), (4.0, 8.0)]) {
            assert!(
                (found.0 - x(expected.0)).abs() < 0.011 && (found.1 - y(expected.1)).abs() < 0.011,
                "{found:?}"
            );
        }
        assert!(points(&svg, "polygon").is_empty());
        for text in [">t<", ">x [m]<", ">y [s]<"] {
            assert_eq!(svg.matches(text).count(), 1, "{text}");
        }
    }

    #[test]
    fn an_x_axis_of_its_own_reaches_as_far_as_it_says_and_no_curve_leaves_it() {
        let plot = LinePlot::new("t", "x [m]", "y [s]").curve("a", &[1.0, 3.0], &[0.0, 2.0], None);
        let ends = |plot: &LinePlot| {
            let line = &points(&plot.to_svg(), "polyline")[0];
            [line[0].0, line[1].0]
        };
        let near = |found: [f64; 2], expected: [f64; 2]| {
            found.iter().zip(expected).all(|(f, e)| (f - (84.0 + 692.0 * e)).abs() < 0.011)
        };
        assert!(near(ends(&plot), [0.0, 1.0]));
        assert!(near(ends(&plot.clone().x_range(0.0, 4.0)), [0.25, 0.75]));
        assert!(near(ends(&plot.clone().x_range(2.0, 5.0)), [0.0, 0.5]));
        assert!(near(ends(&plot.x_range(f64::NAN, 5.0)), [0.0, 1.0]));
    }

    #[test]
    fn bands_reach_one_error_up_and_down() {
        let (x, y, errors) = ([1.0, 2.0], [10.0, 20.0], [1.0, 4.0]);
        let svg = LinePlot::new("", "x", "y").curve("a", &x, &y, Some(&errors)).to_svg();
        let (line, band) = (points(&svg, "polyline").remove(0), points(&svg, "polygon").remove(0));
        let unit = (line[0].1 - line[1].1) / 10.0;
        let heights =
            [line[0].1 - band[0].1, line[1].1 - band[1].1, band[2].1 - line[1].1, band[3].1 - line[0].1];
        for (height, error) in heights.iter().zip([1.0, 4.0, 4.0, 1.0]) {
            assert!((height - unit * error).abs() < 0.03, "{heights:?} {unit}");
        }
    }

    #[test]
    fn what_is_not_finite_interrupts_the_curve() {
        let y = [1.0, 2.0, f64::NAN, 3.0, 4.0, f64::INFINITY];
        let plot = LinePlot::new("", "x", "y").curve(
            "a",
            &[0.0, 1.0, 2.0, 3.0, 4.0, 5.0],
            &y,
            Some(&[f64::INFINITY; 6]),
        );
        let svg = plot.to_svg();
        assert_eq!(points(&svg, "polyline").iter().map(Vec::len).collect::<Vec<_>>(), [2, 2]);
        assert!(points(&svg, "polygon").is_empty() && !svg.contains("NaN") && !svg.contains("inf"));
        let empty = LinePlot::new("", "x", "y").to_svg();
        assert!(!empty.contains("NaN") && points(&empty, "polyline").is_empty());
    }

    #[test]
    fn several_curves_have_a_legend() {
        let one = LinePlot::new("", "x", "y").curve("first", &[0.0, 1.0], &[0.0, 1.0], None);
        assert!(!one.to_svg().contains("first"));
        let two = one.curve("second", &[0.0, 1.0], &[1.0, 0.0], None).to_svg();
        assert!(two.contains(">first<") && two.contains(">second<"));
    }
}
