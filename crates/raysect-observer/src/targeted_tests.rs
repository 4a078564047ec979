use super::*;
use crate::testing::check_sensor;
use crate::{
    CcdArray, FibreOptic, MeshCamera, MeshPixel, OpenCvCamera, OrthographicCamera, PinholeCamera, Pixel,
    SightLine, Sightline, SightlineArray, ThinLensCamera, VectorCamera,
};
use raysect_math::Statistics;
use raysect_primitive::MeshData;

/// Targets high, low, across the horizon, below it, around the sensor, and a rectangle.
fn every_target() -> Vec<Target> {
    let ball = |x, y, z, r| Target::sphere(Point3D::new(x, y, z), r).unwrap();
    let edges = [Vector3D::X * 0.5, Vector3D::Z * 0.3];
    vec![
        ball(0.0, 0.0, 2.0, 0.3),
        ball(1.0, 0.0, 0.05, 0.04),
        ball(0.0, 1.0, 0.05, 0.2),
        ball(0.0, 0.0, -1.0, 0.3),
        ball(0.0, 0.0, 0.0, 7.0),
        Target::rectangle(Point3D::new(0.2, -1.0, 0.1), edges).unwrap(),
    ]
}

/// Asserts that targets leave the étendue as it is.
#[track_caller]
fn keeps_its_etendue<S: Sensor>(observer: Observer<S>) {
    check_sensor(observer.sensor(), 20_000, 3).unwrap();
    let targeted = observer.targets(every_target(), 0.7).unwrap();
    check_sensor(targeted.sensor(), 60_000, 3).unwrap();
}

#[test]
fn every_sensor_of_an_area_keeps_its_etendue() {
    keeps_its_etendue(Pixel::new(0.02, 0.03).unwrap());
    keeps_its_etendue(CcdArray::new((3, 2), 0.1).unwrap());
    keeps_its_etendue(FibreOptic::new(60.0, 0.01).unwrap());
    keeps_its_etendue(ThinLensCamera::new((2, 2), 70.0, 0.1, 1.0).unwrap());
    keeps_its_etendue(MeshPixel::new(&MeshData::cube(0.05).unwrap()).unwrap());
    keeps_its_etendue(MeshCamera::new(&MeshData::cube(0.05).unwrap()).unwrap());
    keeps_its_etendue(Pixel::new(0.02, 0.03).unwrap().targets(every_target(), 0.5).unwrap());
}

/// A density of directions that is wrong by a part in fifty.
struct Wrong(Targeted<crate::Rectangle>);

impl Sensor for Wrong {
    fn shape(&self) -> FrameShape {
        self.0.shape()
    }
    fn sample_ray(&self, pixel: usize, rng: &mut Rng) -> Ray {
        self.0.sample_ray(pixel, rng)
    }
    fn pdf(&self, pixel: usize, origin: Point3D, direction: Vector3D) -> Option<f64> {
        let shifted = Targeted { probability: self.0.probability - 0.02, ..self.0.clone() };
        shifted.pdf(pixel, origin, direction)
    }
    fn etendue(&self, pixel: usize) -> Option<f64> {
        self.0.etendue(pixel)
    }
}

#[test]
fn a_density_with_another_share_is_found_out() {
    let above = Target::sphere(Point3D::new(0.0, 0.0, 2.0), 0.3).unwrap();
    let pixel = Pixel::new(0.02, 0.03).unwrap().targets([above], 0.7).unwrap();
    check_sensor(pixel.sensor(), 60_000, 3).unwrap();
    assert!(check_sensor(&Wrong(pixel.sensor().clone()), 60_000, 3).is_err());
}

/// The mean over the rays of a pixel of a smooth function of the direction.
fn mean<S: Sensor>(sensor: &S, pixel: usize) -> Statistics {
    let (mut mean, mut rng) = (Statistics::new(), Rng::new(9));
    for _ in 0..60_000 {
        let ray = sensor.sample_ray(pixel, &mut rng);
        let weight = crate::sensor::radiance_weight(sensor, pixel, &ray);
        mean.add(weight * (1.0 + ray.direction.x - 0.5 * ray.direction.y));
    }
    mean
}

/// Asserts that targets change no mean of a sensor whose rays begin at one point.
#[track_caller]
fn keeps_its_means<S: Sensor + Clone>(observer: Observer<S>, target: Target) {
    let plain = mean(observer.sensor(), 0);
    let targeted = mean(observer.targets([target], 0.6).unwrap().sensor(), 0);
    let error = plain.error().hypot(targeted.error());
    assert!((plain.mean() - targeted.mean()).abs() < 4.0 * error, "{plain} {targeted}");
    assert!(targeted.error() < 0.01 * targeted.mean(), "{targeted}");
}

#[test]
fn sensors_of_one_point_keep_their_means() {
    let target = Target::sphere(Point3D::new(0.5, 0.3, 2.0), 0.3).unwrap();
    keeps_its_means(PinholeCamera::new((1, 1), 80.0).unwrap(), target);
    keeps_its_means(PinholeCamera::new((1, 1), 80.0).unwrap().cosine_weighted(true), target);
    let matrix = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    keeps_its_means(OpenCvCamera::new((1, 1), matrix, &[-0.1, 0.02, 0.01, 0.0]).unwrap(), target);
    let line =
        Sightline::new(Point3D::ORIGIN, Vector3D::new(0.1, 0.1, 1.0)).unwrap().acceptance(30.0).unwrap();
    keeps_its_means(SightlineArray::new([line]).unwrap(), target);
}

#[test]
fn sensors_that_look_one_way_only_are_refused() {
    let target = || [Target::sphere(Point3D::new(0.0, 0.0, 2.0), 0.3).unwrap()];
    let one_way = |refusal: Option<ObserverError>| matches!(refusal, Some(ObserverError::OneWay { .. }));
    assert!(one_way(SightLine::new().targets(target(), 0.5).err()));
    assert!(one_way(OrthographicCamera::new((2, 2), 1.0).unwrap().targets(target(), 0.5).err()));
    let vectors = VectorCamera::new((1, 1), vec![Point3D::ORIGIN], vec![Vector3D::Z]).unwrap();
    assert!(one_way(vectors.targets(target(), 0.5).err()));
    for probability in [0.0, 1.0, -0.1, f64::NAN] {
        assert!(Pixel::new(1.0, 1.0).unwrap().targets(target(), probability).is_err());
    }
    assert!(Pixel::new(1.0, 1.0).unwrap().targets([], 0.5).is_err());
}
