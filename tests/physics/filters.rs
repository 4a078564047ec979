//! Pipelines of radiance and power behind a filter.

use raysect::observer::{Estimate, Pixel, PowerPipeline, RadiancePipeline};
use raysect::optical::{InterpolatedSf, SpectralTable, TopHat, UniformSurfaceEmitter};
use raysect::prelude::Serial;

use crate::check::Demand;
use crate::readings::{accept_estimate, judge};
use crate::scenes::{ball, world};

/// Étendue of the pixel [m² sr].
const ETENDUE: f64 = 2e-4 * std::f64::consts::PI;

/// What a pixel in a closed emitter reads behind a filter, in so many slices: radiance and power. The emitter goes from
/// 1 at 400 nm straight to 3 at 600 nm, in four bins of 1.25, 1.75, 2.25 and 2.75.
fn behind(filter: Option<&SpectralTable>, slices: usize) -> [Estimate; 2] {
    let slope = InterpolatedSf::new([400.0, 600.0], [1.0, 3.0]).unwrap();
    let room = world([ball([0.0; 3], 5.0, UniformSurfaceEmitter::new(slope, 1.0))]);
    let pixel = Pixel::new(0.01, 0.02).unwrap().wavelengths(400.0, 600.0).spectral_bins(4);
    let pixel = pixel.spectral_rays(slices).pixel_samples(20).engine(Serial).quiet(true);
    let (mut radiance, mut power) = (RadiancePipeline::new(), PowerPipeline::new());
    if let Some(filter) = filter {
        (radiance, power) = (radiance.filter(filter.clone()), power.filter(filter.clone()));
    }
    pixel.observe(&room, &mut (&mut radiance, &mut power)).unwrap();
    [radiance.frame().pixel(0, 0), power.frame().pixel(0, 0)]
}

#[test]
fn filters_weigh_each_bin() {
    let band = |min, max, value| SpectralTable::new(TopHat::new(min, max, value).unwrap());
    let cases = [
        ("no filter", None, 400.0),
        ("half", Some(SpectralTable::from(0.5)), 200.0),
        ("the upper half of the bins", Some(band(500.0, 600.0, 1.0)), 250.0),
        ("the lower half of the bins", Some(band(400.0, 500.0, 1.0)), 150.0),
        ("the inner half of the bins", Some(band(450.0, 550.0, 1.0)), 200.0),
        ("the inner half of the bins, dimmed", Some(band(450.0, 550.0, 0.3)), 60.0),
        // A bin counts by the mean of the filter over it.
        ("half of a bin", Some(band(500.0, 525.0, 1.0)), 56.25),
        ("none of the bins", Some(band(600.0, 700.0, 1.0)), 0.0),
    ];
    for (name, filter, expected) in cases {
        for slices in [1, 2, 4] {
            let [radiance, power] = behind(filter.as_ref(), slices);
            let case = format!("{name}, {slices} slices");
            accept_estimate(&case, expected, Demand::Exact, radiance);
            accept_estimate(&case, ETENDUE * expected, Demand::Exact, power);
            assert!(judge(1.01 * expected + 1e-9, Demand::Exact, radiance).is_err(), "{case}");
        }
    }
}
