use std::path::PathBuf;

use raysect_math::translate;
use raysect_optical::{Slicing, UniformSurfaceEmitter, WithMaterial, World};
use raysect_primitive::Sphere;

use crate::file::scratch::Folder;
use crate::*;

/// A lamp that fills a part of what is seen.
fn lamp() -> World {
    let mut world = World::new();
    let ball = Sphere::new(1.0).unwrap().material(UniformSurfaceEmitter::new(1.0, 1.0));
    world.add(ball.transform(translate(0.3, 0.2, 3.0))).unwrap();
    world
}

/// Looks at a file that another pipeline writes whenever a pass is finished, and takes it away.
struct Viewer {
    frame: Frame,
    file: PathBuf,
    check: fn(&PathBuf),
    /// The samples that were there at each look.
    samples: Vec<u64>,
    contents: Vec<Vec<u8>>,
}

impl Viewer {
    fn new(file: PathBuf, check: fn(&PathBuf)) -> Self {
        Self { frame: Frame::new("viewer", "1"), file, check, samples: Vec::new(), contents: Vec::new() }
    }
}

impl Pipeline for Viewer {
    fn channels(&self, _: &Slicing) -> Vec<String> {
        vec!["power".to_owned()]
    }
    fn measure(&self, sample: &Measurement<'_>, out: &mut [f64]) {
        out[0] += sample.radiance.iter().sum::<f64>();
    }
    fn frame(&self) -> &Frame {
        &self.frame
    }
    fn frame_mut(&mut self) -> &mut Frame {
        &mut self.frame
    }
    fn pass_finished(&mut self) -> Result<(), ObserverError> {
        (self.check)(&self.file);
        self.samples.push(self.frame.total_samples());
        self.contents.push(std::fs::read(&self.file).unwrap());
        std::fs::remove_file(&self.file).unwrap();
        Ok(())
    }
}

fn is_picture(path: &PathBuf) {
    assert_eq!(image::open(path).unwrap().into_rgb8().dimensions(), (4, 3));
}

#[cfg(feature = "plot")]
fn pixel() -> Pixel {
    Pixel::new(0.1, 0.1).unwrap().wavelengths(400.0, 600.0).spectral_bins(4).quiet(true)
}

fn camera() -> PinholeCamera {
    let camera = PinholeCamera::new((4, 3), 60.0).unwrap().etendue(1e-9).unwrap();
    camera.wavelengths(400.0, 600.0).spectral_bins(4).quiet(true)
}

/// Asserts that there was something new to see after each pass, those of the pilot before those that count.
fn saw_every_pass(viewer: &Viewer, report: &RenderReport) {
    let pilots = viewer.samples.len() - report.passes;
    assert!(pilots >= 2 && report.passes >= 2, "{pilots} {report}");
    let (pilot, counted) = viewer.samples.split_at(pilots);
    assert_eq!(
        (pilot.last().copied(), counted.last().copied()),
        (Some(report.pilot_samples), Some(report.samples))
    );
    for part in [pilot, counted] {
        assert!(part.is_sorted_by(|a, b| a < b), "{part:?}");
    }
    assert_eq!(viewer.frame.total_samples(), report.samples);
    // A pass adds samples of another number, so that nothing is as it was.
    assert!(viewer.contents.windows(2).all(|pair| pair[0] != pair[1]));
}

#[test]
fn pictures_are_new_after_every_pass_of_the_pilot_and_after_those_that_count() {
    let folder = Folder::new();
    let path = folder.join("power.png");
    let (mut power, mut viewer) = (PowerPipeline2D::new().preview(&path), Viewer::new(path, is_picture));
    let stop = Stop::relative_error(0.01);
    let report = camera().observe_until(&lamp(), &mut (&mut power, &mut viewer), stop).unwrap();
    saw_every_pass(&viewer, &report);
    // Samples that were there before are not hidden by a pilot.
    let looks = viewer.samples.len();
    let stop = Stop::relative_error(0.005);
    let report = camera().observe_until(&lamp(), &mut (&mut power, &mut viewer), stop).unwrap();
    assert!(report.pilot_samples > 0);
    assert_eq!(viewer.samples.len(), looks + report.passes);
}

#[test]
fn the_pilot_of_an_adaptive_observation_is_seen() {
    let folder = Folder::new();
    let path = folder.join("power.png");
    let (mut power, mut viewer) = (PowerPipeline2D::new().preview(&path), Viewer::new(path, is_picture));
    let adaptive = AdaptiveSampling::mono(200);
    let report = camera().observe_adaptive(&lamp(), &mut (&mut power, &mut viewer), &adaptive).unwrap();
    saw_every_pass(&viewer, &report);
}

#[cfg(feature = "plot")]
#[test]
fn plots_of_a_spectrum_are_new_after_every_pass_over_all_of_its_bins() {
    let folder = Folder::new();
    let path = folder.join("spectrum.svg");
    let is_plot = |path: &PathBuf| {
        let text = std::fs::read_to_string(path).unwrap();
        assert!(text.starts_with("<svg") && text.trim_end().ends_with("</svg>"), "{text}");
        assert_eq!(text.matches("<polyline").count(), 1);
        // The marks are the edges of the bins, and none of their centres.
        assert!(text.contains(">400<") && text.contains(">600<") && !text.contains(">425<"), "{text}");
    };
    let (mut power, mut viewer) = (SpectralPowerPipeline0D::new().preview(&path), Viewer::new(path, is_plot));
    let stop = Stop::relative_error(0.02);
    let report = pixel().observe_until(&lamp(), &mut (&mut power, &mut viewer), stop).unwrap();
    saw_every_pass(&viewer, &report);
}

#[test]
fn a_picture_that_cannot_be_written_ends_the_pilot_and_leaves_nothing_behind() {
    let folder = Folder::new();
    let mut power = PowerPipeline2D::new().preview(folder.join("no/power.png"));
    assert!(camera().observe_until(&lamp(), &mut power, Stop::relative_error(0.01)).is_err());
    assert_eq!(power.frame().total_samples(), 0);
}
