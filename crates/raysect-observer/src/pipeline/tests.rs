//! Pipelines of few channels: closed forms, pictures, tables.

use raysect_optical::{InterpolatedSf, UniformSurfaceEmitter, WithMaterial, World, photon_energy};
use raysect_primitive::Sphere;

use super::*;
use crate::file::scratch::Folder;
use crate::{ColourMap, MonoDisplay, PinholeCamera, Shown};

/// Surroundings of 1 W/m²/sr/nm at 500 nm that grow in proportion to the wavelength.
fn surroundings() -> World {
    let mut world = World::new();
    let radiance = InterpolatedSf::new([100.0, 1000.0], [0.2, 2.0]).unwrap();
    world.add(Sphere::new(10.0).unwrap().material(UniformSurfaceEmitter::new(radiance, 1.0))).unwrap();
    world
}

fn camera(pixels: (usize, usize)) -> PinholeCamera {
    let camera = PinholeCamera::new(pixels, 30.0).unwrap().etendue(2e-9).unwrap();
    camera.wavelengths(400.0, 600.0).spectral_bins(10).pixel_samples(4).quiet(true)
}

/// The integral of the surroundings between two wavelengths.
fn integral(min: f64, max: f64) -> f64 {
    (max * max - min * min) / 1000.0
}

#[track_caller]
fn assert_near(found: f64, expected: f64) {
    assert!((found / expected - 1.0).abs() < 1e-12, "{found} instead of {expected}");
}

#[test]
fn power_is_the_etendue_times_the_radiance() {
    let (mut power, mut radiance) = (PowerPipeline0D::new(), RadiancePipeline0D::new());
    camera((1, 1)).observe(&surroundings(), &mut (&mut power, &mut radiance)).unwrap();
    assert_near(radiance.frame().total().value, integral(400.0, 600.0));
    assert_near(power.frame().total().value, 2e-9 * integral(400.0, 600.0));
}

#[test]
fn the_mosaic_has_red_and_blue_on_its_diagonals() {
    // Filters that pass different amounts of everything tell the colours apart.
    let mut bayer = BayerPipeline2D::new(0.25, 0.5, 1.0);
    let mut power = PowerPipeline2D::new();
    for pixels in [(5, 4), (1, 3), (4, 1)] {
        bayer.frame_mut().clear();
        power.frame_mut().clear();
        camera(pixels).observe(&surroundings(), &mut (&mut bayer, &mut power)).unwrap();
        let whole = power.frame().pixel(0, 0).value;
        for row in 0..pixels.1 {
            for column in 0..pixels.0 {
                let expected = match (row % 2, column % 2) {
                    (0, 0) => 0.25,
                    (1, 1) => 1.0,
                    _ => 0.5,
                };
                let found = bayer.frame().pixel(row * pixels.0 + column, 0).value / whole;
                assert!((found - expected).abs() < 1e-14, "row {row}, column {column}: {found}");
            }
        }
    }
}

#[test]
fn filters_of_the_mosaic_choose_the_wavelengths() {
    let bell =
        |centre: f64| InterpolatedSf::new([centre - 20.0, centre, centre + 20.0], [0.0, 1.0, 0.0]).unwrap();
    let mut bayer = BayerPipeline2D::new(bell(580.0), bell(500.0), bell(420.0));
    camera((2, 2)).observe(&surroundings(), &mut bayer).unwrap();
    // A triangle of 40 nm about its centre, over a slope: bins of 20 nm have half of it each.
    let triangle =
        |centre: f64| 2e-9 * 0.5 * (integral(centre - 20.0, centre) + integral(centre, centre + 20.0));
    for (pixel, centre) in [(0, 580.0), (1, 500.0), (2, 500.0), (3, 420.0)] {
        assert_near(bayer.frame().pixel(pixel, 0).value, triangle(centre));
    }
}

#[test]
fn bands_and_weights_are_integrals_of_the_spectrum() {
    let mut power = FunctionalPipeline::power()
        .band("blue", 420.0, 480.0)
        .unwrap()
        .band("half a bin", 500.0, 510.0)
        .unwrap()
        .functional("difference", InterpolatedSf::new([499.999999, 500.000001], [-1.0, 1.0]).unwrap());
    let mut photons = FunctionalPipeline::photons().band("all", 1.0, 1e4).unwrap();
    let mut radiance =
        FunctionalPipeline::radiance().band("outside", 700.0, 800.0).unwrap().functional("one", 1.0);
    camera((1, 1)).observe(&surroundings(), &mut (&mut power, &mut photons, &mut radiance)).unwrap();
    let frame = power.frame();
    assert_eq!(frame.channels(), ["blue", "half a bin", "difference"]);
    assert_near(frame.pixel(0, 0).value, 2e-9 * integral(420.0, 480.0));
    // Constant within a bin.
    assert_near(frame.pixel(0, 1).value, 1e-9 * integral(500.0, 520.0));
    // The step of the weight has a width of 2e-6 nm.
    let difference = 2e-9 * (integral(500.0, 600.0) - integral(400.0, 500.0));
    assert!((frame.pixel(0, 2).value / difference - 1.0).abs() < 1e-7);
    // As the radiance is in proportion to the wavelength, so is the energy of 1 / wavelength to the photons'.
    let bins = (0..10).map(|i| 410.0 + 20.0 * f64::from(i));
    let expected: f64 = bins.map(|w| 20.0 * 2e-9 * w / 500.0 / photon_energy(w).unwrap()).sum();
    assert!((photons.frame().total().value / expected - 1.0).abs() < 1e-9);
    assert_eq!(photons.frame().unit(), "1/s");
    assert_eq!(radiance.frame().pixel(0, 0).value, 0.0);
    assert_near(radiance.frame().pixel(0, 1).value, integral(400.0, 600.0));
}

#[test]
fn impossible_bands_are_refused() {
    for (min, max) in [(500.0, 400.0), (500.0, 500.0), (0.0, 400.0), (400.0, f64::INFINITY), (f64::NAN, 1.0)]
    {
        assert!(FunctionalPipeline::power().band("x", min, max).is_err(), "{min} {max}");
    }
}

/// A pipeline with pixels of different brightness, by an étendue map.
fn gradient() -> PowerPipeline2D {
    let camera = PinholeCamera::new((4, 2), 30.0).unwrap().wavelengths(400.0, 600.0).spectral_bins(1);
    let camera = camera.etendue_map((0..8).map(f64::from).collect::<Vec<f64>>()).unwrap().pixel_samples(2);
    let mut power = PowerPipeline2D::new();
    camera.quiet(true).observe(&surroundings(), &mut power).unwrap();
    power
}

#[test]
fn pictures_of_mono_frames_have_the_colours_of_their_map() {
    let (folder, power) = (Folder::new(), gradient());
    let display = MonoDisplay::new().gamma(1.0).unwrap().colours(ColourMap::Plasma);
    let power = power.display(display);
    power.save(folder.join("a.png")).unwrap();
    let picture = image::open(folder.join("a.png")).unwrap().into_rgb8();
    assert_eq!(picture.dimensions(), (4, 2));
    for (x, y, pixel) in picture.enumerate_pixels() {
        assert_eq!(pixel.0, ColourMap::Plasma.colour(f64::from(4 * y + x) / 7.0), "{x} {y}");
    }
    let grey = gradient();
    grey.save(folder.join("b.PNG")).unwrap();
    let picture = image::open(folder.join("b.PNG")).unwrap().into_rgb8();
    let level = (255.0 * (3.0f64 / 7.0).powf(1.0 / 2.2)).round() as u8;
    assert_eq!(picture.get_pixel(3, 0).0, [level; 3]);
}

#[test]
fn maps_of_errors_tell_what_is_not_known() {
    let (folder, power) = (Folder::new(), gradient());
    let frame = power.frame();
    let relative = frame.values(0, Shown::RelativeError);
    assert!(relative[0].is_nan() && relative[1..] == [0.0; 7]);
    assert_eq!(frame.values(0, Shown::Error), [0.0; 8]);
    assert_eq!(frame.values(0, Shown::Mean), frame.mean());
    let display = MonoDisplay::new().colours(ColourMap::Viridis);
    frame.save_map(folder.join("a.png"), 0, Shown::RelativeError, &display).unwrap();
    let picture = image::open(folder.join("a.png")).unwrap().into_rgb8();
    assert_eq!(picture.get_pixel(0, 0).0, [128; 3]);
    assert_eq!(picture.get_pixel(1, 0).0, ColourMap::Viridis.colour(0.0));
    // One sample tells nothing of its error.
    let mut once = PowerPipeline2D::new();
    camera((2, 1)).pixel_samples(1).observe(&surroundings(), &mut once).unwrap();
    assert!(once.frame().values(0, Shown::Error).iter().all(|e| e.is_nan()));
}

#[test]
fn tables_have_a_line_for_each_pixel() {
    let (folder, power) = (Folder::new(), gradient());
    power.save(folder.join("a.csv")).unwrap();
    let text = std::fs::read_to_string(folder.join("a.csv")).unwrap();
    let lines: Vec<&str> = text.lines().collect();
    assert_eq!((lines[0], lines.len()), ("row,column,power [W],error of power [W],samples", 9));
    let found: Vec<f64> = lines[6].split(',').map(|n| n.parse().unwrap()).collect();
    assert_eq!(found, [1.0, 1.0, power.frame().pixel(5, 0).value, 0.0, 2.0]);
}

#[test]
fn rgb_exposure_follows_the_share_that_may_be_saturated() {
    let camera =
        PinholeCamera::new((4, 2), 30.0).unwrap().wavelengths(400.0, 700.0).pixel_samples(2).quiet(true);
    let shown = |rgb: RgbPipeline2D| {
        let mut rgb = rgb;
        camera.observe(&surroundings(), &mut rgb).unwrap();
        rgb.to_srgb()
    };
    let automatic = shown(RgbPipeline2D::new());
    let luminance = {
        let mut rgb = RgbPipeline2D::new();
        camera.observe(&surroundings(), &mut rgb).unwrap();
        rgb.frame().pixel(0, 1).value
    };
    assert_eq!(shown(RgbPipeline2D::new().sensitivity(1.0 / luminance).unwrap()), automatic);
    assert_ne!(shown(RgbPipeline2D::new().sensitivity(0.5 / luminance).unwrap()), automatic);
    for wrong in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert!(RgbPipeline2D::new().sensitivity(wrong).is_err());
        assert!(RgbPipeline2D::new().unsaturated_fraction(wrong).is_err());
    }
}

#[test]
fn previews_of_pictures_are_written_after_every_pass() {
    let folder = Folder::new();
    let mut power = PowerPipeline2D::new().preview(folder.join("power.png"));
    let mut bayer = BayerPipeline2D::new(1.0, 1.0, 1.0).preview(folder.join("bayer.png"));
    camera((3, 2)).observe(&surroundings(), &mut (&mut power, &mut bayer)).unwrap();
    assert_eq!(folder.names(), ["bayer.png", "power.png"]);
    let missing = folder.join("no/power.png");
    let mut power = PowerPipeline2D::new().preview(missing);
    assert!(camera((3, 2)).observe(&surroundings(), &mut power).is_err());
}

/// Looks at files that others write, whenever a pass is finished.
struct Viewer {
    frame: Frame,
    look: Box<dyn Fn() + Send + Sync>,
    passes: usize,
}

impl Pipeline for Viewer {
    fn channels(&self, _: &Slicing) -> Vec<String> {
        vec!["nothing".to_owned()]
    }
    fn measure(&self, _: &Measurement<'_>, _: &mut [f64]) {}
    fn frame(&self) -> &Frame {
        &self.frame
    }
    fn frame_mut(&mut self) -> &mut Frame {
        &mut self.frame
    }
    fn pass_finished(&mut self) -> Result<(), ObserverError> {
        (self.look)();
        self.passes += 1;
        Ok(())
    }
}

#[test]
fn previews_are_whole_and_new_after_every_pass_and_progress_is_told() {
    use std::sync::{Arc, Mutex};
    let folder = Folder::new();
    let (png, table) = (folder.join("power.png"), folder.join("power.csv"));
    let mut power = PowerPipeline2D::new().preview(&png);
    let mut numbers = PowerPipeline2D::new().preview(&table);
    let look = move || {
        assert_eq!(image::open(&png).unwrap().into_rgb8().dimensions(), (3, 2));
        assert_eq!(std::fs::read_to_string(&table).unwrap().lines().count(), 7);
        // Gone until the next pass writes them anew.
        std::fs::remove_file(&png).unwrap();
        std::fs::remove_file(&table).unwrap();
    };
    let mut viewer = Viewer { frame: Frame::new("viewer", "1"), look: Box::new(look), passes: 0 };
    let told = Arc::new(Mutex::new(Vec::new()));
    let hears = told.clone();
    let camera = camera((3, 2)).on_progress(move |progress| hears.lock().unwrap().push(*progress));
    let report = camera.observe(&surroundings(), &mut (&mut power, &mut numbers, &mut viewer)).unwrap();
    assert!(report.passes > 1 && viewer.passes == report.passes, "{report}");
    let told = told.lock().unwrap();
    let last = told.last().unwrap();
    assert_eq!((last.samples, last.total, last.left()), (24, 24, Some(std::time::Duration::ZERO)));
    // One sample tells no error; afterwards there is no noise.
    assert_eq!(last.relative_error, if report.passes > 2 { 0.0 } else { f64::INFINITY });
}

#[cfg(feature = "plot")]
#[test]
fn frames_are_plotted_with_names_and_units() {
    let (folder, power) = (Folder::new(), gradient());
    let path = folder.join("a.svg");
    let display = MonoDisplay::new().colours(ColourMap::Magma);
    power.frame().save_plot(&path, 0, Shown::Mean, &display).unwrap();
    let mean = std::fs::read_to_string(&path).unwrap();
    assert!(mean.contains(">power [W]<") && mean.contains("data:image/png;base64,"));
    power.frame().save_plot(&path, 0, Shown::RelativeError, &display).unwrap();
    assert!(std::fs::read_to_string(&path).unwrap().contains("Relative error of power"));
    assert!(PowerPipeline2D::new().frame().save_plot(&path, 0, Shown::Mean, &display).is_err());
}
