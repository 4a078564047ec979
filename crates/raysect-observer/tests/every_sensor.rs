//! The contract of every sensor, at sizes from a thousandth of a millimetre to kilometres.

use raysect_math::{Point3D, Vector3D, translate};
use raysect_observer::testing::check_sensor;
use raysect_observer::*;
use raysect_primitive::MeshData;

const SIZES: [f64; 3] = [1e-6, 0.3, 4e3];

#[track_caller]
fn keeps_the_contract<S: Sensor>(observer: Observer<S>) {
    check_sensor(observer.sensor(), 10_000, 5).unwrap_or_else(|fault| panic!("{observer:?}: {fault}"));
}

/// A ball and a plate over a sensor of a size.
fn targets(size: f64) -> Vec<Target> {
    let edges = [Vector3D::X * size, Vector3D::Y * (0.2 * size)];
    vec![
        Target::sphere(Point3D::new(0.5 * size, 0.0, 2.0 * size), 0.4 * size).unwrap(),
        Target::rectangle(Point3D::new(0.0, -size, 1.5 * size), edges).unwrap(),
    ]
}

#[test]
fn every_sensor_of_an_area_keeps_its_contract_at_every_size() {
    for size in SIZES {
        let aimed = targets(size);
        let pixel = || Pixel::new(size, 0.3 * size).unwrap();
        keeps_the_contract(pixel());
        keeps_the_contract(pixel().targets(aimed.clone(), 0.6).unwrap());
        let ccd = || CcdArray::new((5, 3), size).unwrap();
        keeps_the_contract(ccd());
        keeps_the_contract(ccd().targets(aimed.clone(), 0.6).unwrap());
        let fibre = || FibreOptic::new(37.0, size).unwrap();
        keeps_the_contract(fibre());
        keeps_the_contract(fibre().targets(aimed.clone(), 0.6).unwrap());
        let lens = || ThinLensCamera::new((3, 2), 65.0, 0.3 * size, 1.7 * size).unwrap();
        keeps_the_contract(lens());
        keeps_the_contract(lens().targets(aimed.clone(), 0.6).unwrap());
        let ball = MeshData::icosphere(1, size).unwrap().transformed(&translate(size, 0.0, 0.0)).unwrap();
        keeps_the_contract(MeshPixel::new(&ball).unwrap());
        keeps_the_contract(MeshPixel::new(&ball).unwrap().targets(aimed.clone(), 0.6).unwrap());
        keeps_the_contract(MeshCamera::new(&ball).unwrap().surface_offset(0.01 * size).unwrap());
        keeps_the_contract(MeshCamera::new(&ball).unwrap().targets(aimed, 0.6).unwrap());
    }
}

#[test]
fn every_sensor_of_one_point_or_one_way_keeps_its_contract() {
    let aimed = targets(1.0);
    let pinhole = || PinholeCamera::new((7, 3), 95.0).unwrap().aperture(3e-6).unwrap();
    keeps_the_contract(pinhole());
    keeps_the_contract(pinhole().targets(aimed.clone(), 0.6).unwrap());
    let matrix = [[5.0, 0.1, 2.4], [0.0, 6.0, 1.6], [0.0, 0.0, 1.0]];
    let opencv = || OpenCvCamera::new((6, 4), matrix, &[-0.05, 0.01, 1e-3, -2e-3, 0.0]).unwrap();
    let opencv = || opencv().extrinsics([0.1, 0.2, 0.3], [1.0, -2.0, 0.5]).unwrap().etendue(2e-9).unwrap();
    keeps_the_contract(opencv());
    keeps_the_contract(opencv().targets(aimed.clone(), 0.6).unwrap());
    let line = |x: f64| Sightline::new(Point3D::new(x, 2.0, -1.0), Vector3D::new(x, 1.0, 3.0)).unwrap();
    let cone = |x: f64| line(x).acceptance(10.0 + 20.0 * x).unwrap().aperture(3e-6).unwrap();
    keeps_the_contract(SightlineArray::new([line(0.0), cone(0.5), cone(4.0)]).unwrap());
    keeps_the_contract(SightlineArray::new([cone(0.1), cone(0.5)]).unwrap().targets(aimed, 0.6).unwrap());
    keeps_the_contract(SightLine::new().etendue(3e-9).unwrap());
    for size in SIZES {
        keeps_the_contract(OrthographicCamera::new((3, 5), size).unwrap().etendue(2e-9).unwrap());
        let origins = (0..12).map(|i| Point3D::new(size * f64::from(i % 4), size * f64::from(i / 4), 0.0));
        let directions = (0..12).map(|i| Vector3D::new(0.1 * f64::from(i % 4), 0.0, 1.0)).collect();
        keeps_the_contract(VectorCamera::new((4, 3), origins.collect(), directions).unwrap());
    }
}
