//! Plots as SVG: spectra with axes, units and error bands, pictures with a colour bar. Needs the feature `plot`.
//!
//! ```
//! use raysect_observer::plot::LinePlot;
//! let plot = LinePlot::new("A lamp", "wavelength [nm]", "power [W/nm]")
//!     .curve("measured", &[400.0, 500.0, 600.0], &[1e-6, 3e-6, 2e-6], Some(&[1e-7, 2e-7, 1e-7]));
//! assert!(plot.to_svg().contains("wavelength [nm]"));
//! ```

mod axis;
mod image_plot;
mod line_plot;
mod of_frames;
mod svg;

pub use image_plot::ImagePlot;
pub use line_plot::LinePlot;
