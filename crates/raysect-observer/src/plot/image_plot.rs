use std::path::Path;

use super::axis::Axis;
use super::svg::{Area, Svg, base64, save};
use crate::file::png_rgb8;
use crate::{MonoDisplay, ObserverError};

/// A picture with numbered rows and columns and a colour bar.
///
/// The picture is a PNG within the SVG, so that the file stays small for any number of pixels.
#[derive(Debug, Clone)]
pub struct ImagePlot {
    title: String,
    label: String,
    columns: usize,
    rows: usize,
    values: Vec<f64>,
    display: MonoDisplay,
}

/// Longer side of the picture, and how wide and high it is at least: pixels of a line are drawn longer than wide, and a
/// title has room.
const SIDE: f64 = 600.0;
const LEAST: (f64, f64) = (200.0, 60.0);
const MARGIN: (f64, f64) = (84.0, 40.0);
const BAR: f64 = 20.0;
/// Steps of the colour bar.
const STEPS: usize = 256;

impl ImagePlot {
    /// Of values, row by row from the upper left corner; the label of the colour bar ends with their unit in
    /// brackets. NaN is shown in middle grey.
    ///
    /// # Errors
    /// [`ObserverError::PixelCount`] for a number of values that is not the product of columns and rows.
    pub fn new(
        title: impl Into<String>,
        label: impl Into<String>,
        (columns, rows): (usize, usize),
        values: impl Into<Vec<f64>>,
        display: MonoDisplay,
    ) -> Result<Self, ObserverError> {
        let values = values.into();
        if columns.checked_mul(rows) != Some(values.len()) || values.is_empty() {
            let (what, expected) = ("picture to plot", columns.saturating_mul(rows));
            return Err(ObserverError::PixelCount { what, found: values.len(), expected });
        }
        Ok(Self { title: title.into(), label: label.into(), columns, rows, values, display })
    }

    /// The plot as the text of an SVG file.
    ///
    /// # Errors
    /// [`ObserverError::File`] for a picture that PNG cannot hold.
    pub fn to_svg(&self) -> Result<String, ObserverError> {
        let scale = SIDE / self.columns.max(self.rows) as f64;
        let width = (scale * self.columns as f64).max(LEAST.0);
        let height = (scale * self.rows as f64).max(LEAST.1);
        let area = Area { left: MARGIN.0, top: MARGIN.1, width, height };
        let bar = Area { left: area.left + width + 24.0, width: BAR, height: height.max(120.0), ..area };
        let mut svg = Svg::new(bar.left + BAR + 84.0, MARGIN.1 + bar.height.max(height) + 64.0);
        embed(&mut svg, area, (self.columns, self.rows), &self.display.to_srgb(&self.values))?;
        svg.rectangle(area, "none", "black");
        svg.x_axis(area, &Axis::counting(0.0, self.columns as f64), "column");
        // Rows are counted from the top.
        let rows = Axis::counting(-(self.rows as f64), 0.0);
        for (value, mark) in rows.marks() {
            svg.row_mark(area, rows.place(value), mark.trim_start_matches('−'));
        }
        svg.side_title(area, "row");
        self.colour_bar(&mut svg, bar)?;
        svg.title(area, &self.title);
        Ok(svg.finish())
    }

    /// Writes the plot as SVG.
    ///
    /// # Errors
    /// [`ObserverError::File`].
    pub fn save(&self, path: impl AsRef<Path>) -> Result<(), ObserverError> {
        save(path.as_ref(), &self.to_svg()?)
    }

    fn colour_bar(&self, svg: &mut Svg, bar: Area) -> Result<(), ObserverError> {
        let (black, white) = self.display.range(&self.values);
        let value = |step: usize| black + (white - black) * (1.0 - (step as f64 + 0.5) / STEPS as f64);
        let steps: Vec<f64> = (0..STEPS).map(value).collect();
        let fixed = self.display.between(black, white);
        embed(svg, bar, (1, STEPS), &fixed.to_srgb(&steps))?;
        svg.rectangle(bar, "none", "black");
        svg.right_axis(bar, &Axis::over(black, white), &self.label);
        Ok(())
    }
}

/// Draws a picture over an area, its pixels as sharp rectangles.
fn embed(
    svg: &mut Svg,
    area: Area,
    (columns, rows): (usize, usize),
    rgb: &[u8],
) -> Result<(), ObserverError> {
    let Area { left, top, width, height } = area;
    let data = base64(&png_rgb8(Path::new("the picture"), columns, rows, rgb)?);
    svg.raw(&format!(
        r#"<image x="{left:.2}" y="{top:.2}" width="{width:.2}" height="{height:.2}" preserveAspectRatio="none" style="image-rendering:pixelated" href="data:image/png;base64,{data}"/>"#
    ));
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ColourMap;

    #[test]
    fn the_picture_is_in_the_plot_and_the_bar_has_its_range() {
        let display = MonoDisplay::new().gamma(1.0).unwrap().colours(ColourMap::Viridis);
        let values = [0.0, 1.0, 2.0, f64::NAN, 4.0, 2e-6];
        let plot = ImagePlot::new("A <picture>", "power [W]", (3, 2), values, display).unwrap();
        let svg = plot.to_svg().unwrap();
        let png = png_rgb8(Path::new("x"), 3, 2, &display.to_srgb(&values)).unwrap();
        assert!(
            svg.contains(&base64(&png)) && svg.contains("A &lt;picture&gt;") && svg.contains(">power [W]<")
        );
        for mark in ["0", "1", "2", "3", "4"] {
            assert!(svg.contains(&format!(">{mark}<")) || svg.contains(&format!(">{mark}.0<")), "{mark}");
        }
    }

    #[test]
    fn lines_of_pixels_are_drawn_wide_enough_to_see() {
        for (size, picture) in [
            ((200, 1), r#"width="600.00" height="60.00" preserve"#),
            ((1, 40), r#"width="200.00" height="600.00" preserve"#),
            ((30, 20), r#"width="600.00" height="400.00" preserve"#),
        ] {
            let values = vec![1.0; size.0 * size.1];
            let plot = ImagePlot::new("", "power [W]", size, values, MonoDisplay::new()).unwrap();
            assert!(plot.to_svg().unwrap().contains(picture), "{size:?}");
        }
    }

    #[test]
    fn small_values_have_their_power_of_ten_at_the_bar() {
        let plot = ImagePlot::new("", "power [W]", (2, 1), [1e-9, 4e-9], MonoDisplay::new()).unwrap();
        assert!(plot.to_svg().unwrap().contains(">power [10⁻⁹ W]<"));
    }

    #[test]
    fn other_numbers_of_values_are_refused() {
        let wrong = |size, values: &[f64]| ImagePlot::new("", "", size, values, MonoDisplay::new()).is_err();
        assert!(wrong((2, 2), &[0.0; 3]) && wrong((0, 3), &[]) && wrong((usize::MAX, 2), &[0.0]));
        assert!(!wrong((2, 2), &[0.0; 4]));
    }
}
