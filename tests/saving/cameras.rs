//! Cameras and pipelines beside a world.

use raysect::optical::colour::CieObserver;
use raysect::prelude::*;
use raysect::save::{SceneWriter, Storable};

use crate::read;

/// The text with one thing kept, and the same after reading.
fn again<T: Storable>(world: &World, value: &T) -> (String, String) {
    let text = |world: &World, value: &T| {
        let mut writer = SceneWriter::new(world).unwrap();
        writer.keep("it", value).unwrap();
        writer.to_json()
    };
    let first = text(world, value);
    let scene = read(&first).unwrap_or_else(|error| panic!("{error}\n{first}"));
    let value = scene.get("it").unwrap_or_else(|error| panic!("{error}\n{first}"));
    (text(&scene.world, &value), first)
}

/// Asserts that a value comes back with every bit.
#[track_caller]
pub(crate) fn comes_back<T: Storable>(value: &T) {
    let (after, before) = again(&World::new(), value);
    assert_eq!(after, before);
}

fn plain() -> PinholeCamera {
    PinholeCamera::new((3, 2), 33.3).unwrap()
}

#[test]
fn every_setting_of_a_camera_comes_back() {
    let paths = PathSettings::default()
        .max_depth(17)
        .light_sampling(LightSampling::Off)
        .roulette_threshold(0.03)
        .unwrap()
        .important_path_weight(0.7)
        .unwrap();
    let mut world = World::new();
    let arm = world.add(Node::group().name("arm").transform(translate(0.0, 1.0 / 3.0, 0.0))).unwrap();
    let camera = plain()
        .transform(rotate(10.0, 20.0, 30.0))
        .parent(arm)
        .wavelengths(401.5, 688.8)
        .spectral_bins(9)
        .spectral_rays(4)
        .pixel_samples(12)
        .seed(u64::MAX)
        .quiet(true)
        .paths(paths)
        .cosine_weighted(true);
    let (after, before) = again(&world, &camera);
    assert_eq!(after, before);
    let mut writer = SceneWriter::new(&world).unwrap();
    writer.keep("camera", &camera).unwrap();
    let scene = read(&writer.to_json()).unwrap();
    let same: PinholeCamera = scene.get("camera").unwrap();
    assert_eq!(same.to_root(&scene.world).unwrap(), camera.to_root(&world).unwrap());
    assert_eq!((same.sensor(), same.slicing().unwrap()), (camera.sensor(), camera.slicing().unwrap()));
}

#[test]
fn every_etendue_comes_back() {
    let cameras = [
        plain(),
        plain().etendue(1e-9).unwrap(),
        plain().aperture(2e-6).unwrap(),
        plain().etendue_map(vec![0.1, 0.2, 0.3, 0.4, 0.5, 0.0]).unwrap(),
    ];
    for camera in &cameras {
        comes_back(camera);
    }
    // Texts that do not tell the cameras apart would come back, too.
    let texts: std::collections::BTreeSet<String> =
        cameras.iter().map(|camera| again(&World::new(), camera).0).collect();
    assert_eq!(texts.len(), 4);
}

#[test]
fn pipelines_come_back_without_their_samples() {
    let filter = InterpolatedSf::new([400.0, 500.0], [0.1, 0.9]).unwrap();
    comes_back(&PowerPipeline2D::new().named("through the slit"));
    comes_back(&PowerPipeline2D::new().filter(filter.clone()));
    comes_back(&RadiancePipeline2D::new().filter(filter.clone()));
    comes_back(&BayerPipeline2D::new(filter.clone(), 0.5, 0.25).preview("bayer.png"));
    comes_back(&SpectralPowerPipeline::new().preview("a.csv"));
    comes_back(&SpectralRadiancePipeline::new().named("spectrum"));
    comes_back(&FunctionalPipeline::photons().band("all", 100.0, 1000.0).unwrap());
    comes_back(&FunctionalPipeline::radiance().functional("slope", filter.clone()).functional("one", 1.0));
    comes_back(&RgbPipeline2D::new().observer(CieObserver::FiveNanometres).preview("a.png"));
    comes_back(&RgbPipeline2D::new().unsaturated_fraction(0.95).unwrap());
    comes_back(&RgbPipeline2D::new().named("left").sensitivity(3.5).unwrap());

    let mut world = World::new();
    world.add(Sphere::new(10.0).unwrap().material(UniformSurfaceEmitter::new(1.0, 1.0))).unwrap();
    let mut seen = RadiancePipeline2D::new();
    plain().pixel_samples(2).quiet(true).observe(&world, &mut seen).unwrap();
    let mut writer = SceneWriter::new(&world).unwrap();
    writer.keep("radiance", &seen).unwrap();
    let read: RadiancePipeline2D = read(&writer.to_json()).unwrap().get("radiance").unwrap();
    assert!(read.frame().is_empty() && !seen.frame().is_empty());
}

#[test]
fn displays_of_pipelines_come_back() {
    let displays = [
        MonoDisplay::new(),
        MonoDisplay::new().colours(ColourMap::Inferno).gamma(1.0).unwrap(),
        MonoDisplay::new().unsaturated_fraction(0.9).unwrap().black_point(0.1).unwrap(),
        MonoDisplay::new().black_point(-3.0).unwrap().white_point(-1.0).unwrap(),
    ];
    let mut texts = std::collections::BTreeSet::new();
    for display in displays {
        comes_back(&PowerPipeline2D::new().display(display).preview("a.png"));
        comes_back(&RadiancePipeline2D::new().display(display));
        comes_back(&FunctionalPipeline::power().named("lines").display(display));
        texts.insert(again(&World::new(), &BayerPipeline2D::new(1.0, 1.0, 1.0).display(display)).0);
    }
    assert_eq!(texts.len(), 4);
    // A spectrum of radiance is none of power.
    let mut writer = SceneWriter::new(&World::new()).unwrap();
    writer.keep("radiance", &SpectralRadiancePipeline::new()).unwrap();
    let scene = read(&writer.to_json()).unwrap();
    assert!(scene.get::<SpectralPowerPipeline>("radiance").is_err());
    assert!(scene.get::<SpectralRadiancePipeline>("radiance").is_ok());
}

#[test]
fn what_cannot_be_kept_is_named() {
    let world = World::new();
    let mut writer = SceneWriter::new(&world).unwrap();
    let closure = PowerPipeline2D::new().filter(|wavelength: f64| wavelength / 1000.0);
    let message = writer.keep("power", &closure).unwrap_err().to_string();
    assert!(message.starts_with("'power': ") && message.contains("closure"), "{message}");
    let mut other = World::new();
    let foreign = other.add(Node::group()).unwrap();
    let message = writer.keep("camera", &plain().parent(foreign)).unwrap_err().to_string();
    assert!(message.starts_with("'camera': ") && message.contains("another world"), "{message}");
    let endless = plain().wavelengths(400.0, f64::INFINITY);
    let message = writer.keep("camera", &endless).unwrap_err().to_string();
    assert!(message.contains("wavelengths = inf"), "{message}");
    writer.keep("camera", &plain()).unwrap();
    assert!(writer.keep("camera", &plain()).is_err());
}

#[test]
fn settings_that_no_camera_has_are_refused() {
    let mut writer = SceneWriter::new(&World::new()).unwrap();
    writer.keep("camera", &plain().etendue(1e-9).unwrap()).unwrap();
    let text = writer.to_json();
    let refusal = |old: &str, new: &str| {
        assert_eq!(text.matches(old).count(), 1, "{old} in {text}");
        let scene = read(&text.replace(old, new)).unwrap();
        let message = scene.get::<PinholeCamera>("camera").unwrap_err().to_string();
        assert!(message.starts_with("'camera': "), "{message}");
        message
    };
    assert!(refusal("\"columns\": 3", "\"columns\": 0").contains("pixels across = 0"));
    assert!(refusal("\"columns\": 3", "\"columns\": -3").contains("'columns' must be an integer"));
    assert!(refusal("\"columns\": 3", "\"columns\": 9000000000000000000").contains("pixels = "));
    assert!(refusal("\"etendue\": 1e-9", "\"etendue\": -1").contains("étendue = -1"));
    assert!(
        refusal("\"etendue\": 1e-9", "\"etendue\": 1, \"aperture\": 1").contains("'aperture' has no meaning")
    );
    assert!(refusal("\"spectral_rays\": 1", "\"spectral_rays\": 99").contains("99 slices"));
    assert!(refusal("\"light_sampling\": \"lights\"", "\"light_sampling\": \"no\"").contains("not one of"));
    assert!(refusal("\"seed\": 1", "\"seed\": 1, \"parent\": 5").contains("node 5"));
    assert!(refusal("\"kind\": \"Pinhole\"", "\"kind\": \"Lens\"").contains("a Lens, not a Pinhole"));
    let scene = read(&text).unwrap();
    assert!(scene.get::<PinholeCamera>("lens").unwrap_err().to_string().contains("there are: camera"));
    assert_eq!(scene.names().collect::<Vec<_>>(), ["camera"]);
}
