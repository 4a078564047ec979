use super::*;
use crate::testing::check_sensor;
use crate::{
    CcdArray, FibreOptic, MeshCamera, MeshPixel, OpenCvCamera, OrthographicCamera, PinholeCamera, Pixel,
    SightLine, Sightline, SightlineArray, ThinLensCamera, VectorCamera,
};
use raysect_core::Primitive;
use raysect_math::{Statistics, rotate, translate};
use raysect_optical::{UniformSurfaceEmitter, WithMaterial};
use raysect_primitive::{Cuboid, Cylinder, MeshData, Sphere};

/// A shape under a map.
fn placed(shape: impl Primitive, to_observer: raysect_math::AffineMatrix3D) -> Target {
    let shape: Arc<dyn Primitive> = Arc::new(shape);
    Target::shape(&shape, to_observer).unwrap()
}

/// Targets high, low, across the horizon, below it and around the sensor: balls, a rectangle, and shapes.
fn every_target() -> Vec<Target> {
    let turned = rotate(20.0, 30.0, 40.0);
    let ball = |x, y, z, r| Target::sphere(Point3D::new(x, y, z), r).unwrap();
    let edges = [Vector3D::X * 0.5, Vector3D::Z * 0.3];
    vec![
        ball(0.0, 0.0, 2.0, 0.3),
        ball(1.0, 0.0, 0.05, 0.04),
        ball(0.0, 1.0, 0.05, 0.2),
        ball(0.0, 0.0, -1.0, 0.3),
        ball(0.0, 0.0, 0.0, 7.0),
        Target::rectangle(Point3D::new(0.2, -1.0, 0.1), edges).unwrap(),
        placed(Cuboid::centred(3.0, 0.02, 0.05).unwrap(), translate(0.0, 0.4, 0.6) * turned),
        // A wall across the horizon near by, seen within its longest edge, and a sheet.
        placed(Cuboid::centred(0.1, 2.0, 2.0).unwrap(), translate(-0.5, 0.0, 0.2)),
        placed(Cuboid::centred(0.6, 0.6, 0.0).unwrap(), translate(0.2, 0.3, 0.9) * turned),
        placed(Cylinder::new(0.05, 2.0).unwrap(), translate(0.4, -0.3, 0.2) * turned),
        placed(Sphere::new(0.2).unwrap(), translate(0.4, 0.3, 0.7)),
        // In the plane of the sensor: nothing of it is seen from anywhere.
        placed(Cuboid::centred(0.6, 0.6, 0.0).unwrap(), translate(1.0, 0.0, 0.0)),
        // Around the sensor.
        placed(Cuboid::centred(3.0, 3.0, 3.0).unwrap(), turned),
    ]
}

/// Asserts that targets leave the étendue as it is.
#[track_caller]
fn keeps_its_etendue<S: Sensor>(observer: Observer<S>) {
    check_sensor(observer.sensor(), 10_000, 3).unwrap();
    let targeted = observer.targets(every_target(), 0.7).unwrap();
    check_sensor(targeted.sensor(), 15_000, 3).unwrap();
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

#[test]
fn a_disk_leaves_the_etendue_as_it_is() {
    let window = Target::disk(Point3D::new(-0.3, 0.5, 0.8), Vector3D::new(0.3, 0.0, 1.0), 0.6).unwrap();
    let pixel = Pixel::new(0.02, 0.03).unwrap().targets([window], 0.7).unwrap();
    check_sensor(pixel.sensor(), 30_000, 3).unwrap();
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

#[test]
fn a_density_of_another_shape_is_found_out() {
    let bar = |width| placed(Cuboid::centred(1.0, width, 0.1).unwrap(), translate(0.0, 0.2, 0.7));
    let pixel = |width| Pixel::new(0.02, 0.03).unwrap().targets([bar(width)], 0.7).unwrap();
    struct Mistaken([Targeted<crate::Rectangle>; 2]);
    impl Sensor for Mistaken {
        fn shape(&self) -> FrameShape {
            self.0[0].shape()
        }
        fn sample_ray(&self, pixel: usize, rng: &mut Rng) -> Ray {
            self.0[0].sample_ray(pixel, rng)
        }
        fn pdf(&self, pixel: usize, origin: Point3D, direction: Vector3D) -> Option<f64> {
            self.0[1].pdf(pixel, origin, direction)
        }
        fn etendue(&self, pixel: usize) -> Option<f64> {
            self.0[0].etendue(pixel)
        }
    }
    let mistaken = |width| Mistaken([pixel(1.0).sensor().clone(), pixel(width).sensor().clone()]);
    check_sensor(&mistaken(1.0), 60_000, 3).unwrap();
    assert!(check_sensor(&mistaken(1.3), 60_000, 3).is_err());
}

/// The relative variance of a sample of a small pixel that looks at a shining shape, aimed at one target or another, and
/// how long a sample takes [µs].
fn relative_variance(
    shape: impl Primitive + Clone,
    place: raysect_math::AffineMatrix3D,
    sphere: bool,
) -> (f64, f64) {
    let mut world = raysect_optical::World::new();
    let lamp = shape.material(UniformSurfaceEmitter::new(1.0, 1.0)).transform(place);
    let node = world.add(lamp).unwrap();
    let pixel = Pixel::new(1e-4, 1e-4).unwrap().wavelengths(500.0, 501.0).spectral_bins(1).quiet(true);
    let around = world.primitive(node).unwrap().unwrap().bounding_sphere(&place);
    let around = Target::sphere(around.centre, around.radius).unwrap();
    let aimed = if sphere { pixel.targets([around], 0.9) } else { pixel.aimed_at(&world, &[node], 0.9) };
    let mut power = crate::PowerPipeline0D::new();
    let aimed = aimed.unwrap().pixel_samples(20_000).engine(raysect_core::Serial);
    let report = aimed.observe(&world, &mut power).unwrap();
    let found = power.frame().pixel(0, 0);
    (20_000.0 * found.relative_error().powi(2), 1e6 * report.elapsed.as_secs_f64() / 20_000.0)
}

#[test]
fn flat_and_long_shapes_are_seen_with_less_noise_than_by_their_bounding_spheres() {
    let turned = rotate(20.0, 30.0, 40.0);
    let gain = |name: &str, shape: &dyn Fn(bool) -> (f64, f64)| {
        let ((sphere, long), (exact, time)) = (shape(true), shape(false));
        let ratio = sphere / exact;
        println!("{name}: {sphere:.3}, {long:.2} µs by the sphere; {exact:.4}, {time:.2} µs: {ratio:.0}");
        ratio
    };
    let plate = |sphere| {
        relative_variance(Cuboid::centred(0.6, 0.6, 0.01).unwrap(), translate(0.2, 0.1, 1.5) * turned, sphere)
    };
    let bar = |sphere| {
        relative_variance(
            Cuboid::centred(1.5, 0.02, 0.02).unwrap(),
            translate(0.2, 0.1, 1.5) * turned,
            sphere,
        )
    };
    let tube = |sphere| {
        relative_variance(Cylinder::new(0.01, 1.5).unwrap(), translate(0.2, 0.1, 1.0) * turned, sphere)
    };
    let ball = |sphere| relative_variance(Sphere::new(0.3).unwrap(), translate(0.2, 0.1, 1.5), sphere);
    assert!(gain("plate", &plate) > 3.0);
    assert!(gain("bar", &bar) > 50.0);
    assert!(gain("tube", &tube) > 50.0);
    assert!((gain("ball", &ball) - 1.0).abs() < 0.1);
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
fn keeps_its_means<S: Sensor + Clone>(observer: Observer<S>, target: &Target) {
    let plain = mean(observer.sensor(), 0);
    let targeted = mean(observer.targets([target.clone()], 0.6).unwrap().sensor(), 0);
    let error = plain.error().hypot(targeted.error());
    assert!((plain.mean() - targeted.mean()).abs() < 4.0 * error, "{plain} {targeted}");
    assert!(targeted.error() < 0.01 * targeted.mean(), "{targeted}");
}

#[test]
fn sensors_of_one_point_keep_their_means() {
    let ball = Target::sphere(Point3D::new(0.5, 0.3, 2.0), 0.3).unwrap();
    let bar = placed(Cuboid::centred(0.05, 1.0, 0.02).unwrap(), translate(0.3, 0.2, 1.5));
    for target in [&ball, &bar] {
        keeps_its_means(PinholeCamera::new((1, 1), 80.0).unwrap(), target);
        keeps_its_means(PinholeCamera::new((1, 1), 80.0).unwrap().cosine_weighted(true), target);
        let matrix = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        keeps_its_means(OpenCvCamera::new((1, 1), matrix, &[-0.1, 0.02, 0.01, 0.0]).unwrap(), target);
        let line =
            Sightline::new(Point3D::ORIGIN, Vector3D::new(0.1, 0.1, 1.0)).unwrap().acceptance(30.0).unwrap();
        keeps_its_means(SightlineArray::new([line]).unwrap(), target);
    }
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
