//! Every sensor of many pixels has regions of interest.

use raysect::observer::{ObserverError, Sensor};
use raysect::prelude::*;

use crate::bits::own_bits;

/// What is observed in every picture: the pixels with an even number, and a rectangle.
fn pixels_of_interest(observer: &Observer<impl Sensor>) -> Vec<bool> {
    (0..observer.sensor().shape().pixels()).map(|pixel| pixel % 2 == 0).collect()
}

/// A lamp of which every sensor sees a part, with noise.
fn lamp() -> World {
    let mut world = World::new();
    let bright = |x: f64, y: f64, z: f64| {
        let ball = Sphere::new(0.7).unwrap().material(UniformSurfaceEmitter::new(1.0, 2.0));
        ball.transform(translate(x, y, z))
    };
    for place in [(0.5, 0.3, 2.0), (-0.9, -0.4, 2.5), (0.1, -1.0, 3.0), (0.0, 0.9, -2.0)] {
        world.add(bright(place.0, place.1, place.2)).unwrap();
    }
    world
}

fn frame<S: Sensor>(observer: &Observer<S>, world: &World) -> (Frame, RenderReport) {
    let mut radiance = RadiancePipeline2D::new();
    let report = observer.observe(world, &mut radiance).unwrap();
    (radiance.frame().clone(), report)
}

/// Asserts that a part of the pixels has the bits that it has in the whole, and that nothing else is seen.
fn a_part_is_a_part_of_the_whole<S: Sensor + Clone>(name: &str, observer: Observer<S>) {
    let world = lamp();
    let observer =
        observer.wavelengths(500.0, 501.0).spectral_bins(1).pixel_samples(70).engine(Serial).quiet(true);
    let (whole, _) = frame(&observer, &world);
    assert!(whole.total().value > 0.0, "{name} sees nothing");
    let shape = observer.sensor().shape();
    let (columns, rows) = (shape.columns(), shape.rows());
    let region = (columns / 3..columns, rows / 3..rows.div_ceil(3) + rows / 3);
    let inside =
        |pixel: usize| region.0.contains(&(pixel % columns)) && region.1.contains(&(pixel / columns));
    let of_region: Vec<bool> = (0..shape.pixels()).map(inside).collect();
    let every_other = pixels_of_interest(&observer);
    let parts = [
        (observer.clone().mask(every_other.clone()).unwrap(), every_other),
        (observer.clone().region(region.0.clone(), region.1.clone()).unwrap(), of_region),
    ];
    for (part, seen) in parts {
        let (found, report) = frame(&part, &world);
        let count = seen.iter().filter(|seen| **seen).count();
        assert!(count > 0 && count < shape.pixels(), "{name}");
        assert_eq!((report.pixels, report.samples), (count, 70 * count as u64), "{name}");
        for (pixel, seen) in seen.into_iter().enumerate() {
            assert_eq!(found.is_masked(pixel), !seen, "{name}, pixel {pixel}");
            if seen {
                assert_eq!(own_bits(&found, pixel), own_bits(&whole, pixel), "{name}, pixel {pixel}");
            }
            assert_eq!(found.samples(pixel), if seen { 70 } else { 0 }, "{name}, pixel {pixel}");
        }
    }
    let beyond = observer.region(0..columns + 1, 0..rows);
    assert!(matches!(beyond, Err(ObserverError::Region { .. })), "{name}");
}

#[test]
fn every_sensor_of_many_pixels_has_regions_of_interest() {
    let ball = [Target::sphere(Point3D::new(0.5, 0.3, 2.0), 0.7).unwrap()];
    let ccd = || CcdArray::new((5, 4), 0.4).unwrap();
    a_part_is_a_part_of_the_whole("pinhole", PinholeCamera::new((6, 4), 70.0).unwrap());
    a_part_is_a_part_of_the_whole("orthographic", OrthographicCamera::new((6, 4), 3.0).unwrap());
    a_part_is_a_part_of_the_whole("CCD", ccd());
    a_part_is_a_part_of_the_whole("targeted CCD", ccd().targets(ball, 0.5).unwrap());
    a_part_is_a_part_of_the_whole("thin lens", ThinLensCamera::new((6, 4), 70.0, 0.1, 2.0).unwrap());
    let matrix = [[5.0, 0.0, 2.5], [0.0, 5.0, 1.5], [0.0, 0.0, 1.0]];
    a_part_is_a_part_of_the_whole(
        "OpenCV",
        OpenCvCamera::new((6, 4), matrix, &[-0.05, 0.01, 0.0, 0.0]).unwrap(),
    );
    let fan =
        |pixel: usize| Vector3D::new(0.6 - 0.2 * (pixel % 6) as f64, 0.4 - 0.2 * (pixel / 6) as f64, 1.0);
    let vectors = VectorCamera::new((6, 4), vec![Point3D::ORIGIN; 24], (0..24).map(fan).collect()).unwrap();
    a_part_is_a_part_of_the_whole("vectors", vectors);
    let line = |pixel| Sightline::new(Point3D::ORIGIN, fan(pixel)).unwrap().acceptance(5.0).unwrap();
    let lines: Vec<Sightline> = (0..12).map(line).collect();
    a_part_is_a_part_of_the_whole("lines of sight", SightlineArray::new(lines).unwrap());
    a_part_is_a_part_of_the_whole("mesh", MeshCamera::new(&MeshData::cube(0.4).unwrap()).unwrap());
}
