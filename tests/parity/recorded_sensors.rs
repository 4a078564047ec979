//! What sensors of Raysect 0.9.1 read in a closed emitter of radiance 1 in a band of 1 nm: their radiance is that of an
//! étendue without its cosine, their power is right.

use raysect::observer::Sensor;
use raysect::prelude::*;

/// Radiance [W/m²/sr] and power [W] of the first pixel, and the standard error of the radiance.
fn reading<S: Sensor>(observer: Observer<S>) -> (f64, f64, f64) {
    let mut world = World::new();
    world.add(Sphere::new(10.0).unwrap().material(UniformSurfaceEmitter::new(1.0, 1.0))).unwrap();
    let observer = observer.wavelengths(500.0, 501.0).spectral_bins(1).pixel_samples(20_000);
    let (mut radiance, mut power) = (RadiancePipeline2D::new(), PowerPipeline2D::new());
    observer.engine(Serial).quiet(true).observe(&world, &mut (&mut radiance, &mut power)).unwrap();
    let found = radiance.frame().pixel(0, 0);
    (found.value, power.frame().pixel(0, 0).value, found.error)
}

/// Asserts that a sensor reads what Raysect has read, to the digits that were recorded, and the same power without the
/// cosine as with it.
#[track_caller]
fn reads<S: Sensor>(recorded: f64, digit: f64, without: Observer<S>, with: Observer<S>) -> f64 {
    let (ours, right) = (reading(without), reading(with));
    assert!((ours.0 - recorded).abs() < 0.5 * digit + 4.0 * ours.2, "{ours:?}");
    assert!((right.0 - 1.0).abs() < 1e-12 + 4.0 * right.2, "{right:?}");
    assert!((ours.1 / right.1 - 1.0).abs() < 1e-13, "{ours:?} {right:?}");
    ours.1
}

#[test]
fn sensors_without_cosine_read_what_raysect_has_read() {
    let pixel = || Pixel::new(0.01, 0.01).unwrap();
    let power = reads(0.5, 1e-13, pixel().etendue_without_cosine(true), pixel());
    assert!((power - 3.14159e-4).abs() < 0.5e-9, "{power}");
    let fibre = || FibreOptic::new(30.0, 1e-3).unwrap();
    let power = reads(0.933, 1e-3, fibre().etendue_without_cosine(true), fibre());
    assert!((power - 2.467e-6).abs() < 0.5e-9, "{power}");
    let ccd = || CcdArray::new((3, 2), 0.035).unwrap();
    reads(0.5, 1e-13, ccd().etendue_without_cosine(true), ccd());
    let cube = MeshData::cube(0.05).unwrap();
    let whole = || MeshPixel::new(&cube).unwrap();
    reads(0.5, 1e-13, whole().etendue_without_cosine(true), whole());
    let patches = || MeshCamera::new(&cube).unwrap();
    reads(0.5, 1e-13, patches().etendue_without_cosine(true), patches());
}

#[test]
fn targeted_sensors_without_cosine_read_half_of_the_radiance_too() {
    let ball = || [Target::sphere(Point3D::new(0.5, 0.0, 2.0), 0.8).unwrap()];
    let pixel = || Pixel::new(0.01, 0.02).unwrap();
    let aimed = |pixel: Pixel| pixel.targets(ball(), 0.5).unwrap();
    reads(0.5, 1e-13, aimed(pixel().etendue_without_cosine(true)), aimed(pixel()));
    let ccd = || CcdArray::new((2, 1), 0.02).unwrap();
    let aimed = |ccd: CcdArray| ccd.targets(ball(), 0.5).unwrap();
    reads(0.5, 1e-13, aimed(ccd().etendue_without_cosine(true)), aimed(ccd()));
}

#[test]
fn the_contract_of_sensors_refuses_an_etendue_without_cosine() {
    use raysect::observer::testing::check_sensor;
    let pixel = Pixel::new(0.01, 0.01).unwrap();
    check_sensor(pixel.sensor(), 1000, 1).unwrap();
    assert!(check_sensor(pixel.etendue_without_cosine(true).sensor(), 1000, 1).is_err());
}
