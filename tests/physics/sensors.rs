//! Every sensor in a closed emitter, in glass, and against closed forms of what it collects.

use raysect::math::translate;
use raysect::observer::{Estimate, MeshCamera, Observer, Sensor, Sightline, Target};
use raysect::optical::{Dielectric, Lambert, WithMaterial};
use raysect::prelude::*;

use crate::check::{Demand, expected};
use crate::irradiance::ball_factor;
use crate::readings::{Place, accept_estimate, judge, read, read_radiance};
use crate::scenes::{ball, ball_lamp, dome, lamp, tilted, times, world};

/// Asserts that every pixel of a sensor in a closed emitter of radiance 1 reads 1, and its étendue as power.
#[track_caller]
fn reads_its_etendue<S: Sensor>(case: &str, observer: Observer<S>, demand: Demand, samples: u64) {
    let place = Place { parent: None, transform: translate(1.0, 2.0, 3.0) * rotate(10.0, 20.0, 30.0) };
    let etendues: Vec<Option<f64>> =
        (0..observer.sensor().shape().pixels()).map(|p| observer.sensor().etendue(p)).collect();
    for (pixel, reading) in read(observer, &world([dome()]), place, samples).into_iter().enumerate() {
        accept_estimate(format!("{case}, radiance of pixel {pixel}"), 1.0, demand, reading.radiance);
        let etendue = etendues[pixel].expect("an étendue");
        accept_estimate(format!("{case}, power of pixel {pixel}"), etendue, demand, reading.power);
    }
}

/// Asserts the power of the first pixel of a sensor in a closed emitter.
#[track_caller]
fn collects<S: Sensor>(id: &str, observer: Observer<S>) {
    let reading = read(observer, &world([dome()]), Place::default(), 200)[0];
    accept_estimate(id, expected(id), Demand::Exact, reading.power);
    accept_estimate(format!("{id} radiance"), 1.0, Demand::Exact, reading.radiance);
}

fn matrix() -> [[f64; 3]; 3] {
    [[4.0, 0.0, 1.5], [0.0, 4.0, 1.0], [0.0, 0.0, 1.0]]
}

#[test]
fn sensors_in_a_closed_emitter_read_its_radiance_without_noise() {
    let cube = MeshData::cube(0.05).unwrap();
    let exact = Demand::Exact;
    collects("W01", Pixel::new(0.01, 0.01).unwrap());
    collects("W03", CcdArray::new((10, 10), 0.035).unwrap());
    collects("W04", FibreOptic::new(30.0, 1e-3).unwrap());
    collects("V10", FibreOptic::new(20.0, 5e-3).unwrap());
    collects("W06", MeshPixel::new(&cube).unwrap());
    collects("W07", MeshCamera::new(&cube).unwrap());
    reads_its_etendue("CCD", CcdArray::new((3, 2), 0.035).unwrap(), exact, 100);
    reads_its_etendue("mesh camera", MeshCamera::new(&cube).unwrap(), exact, 100);
    reads_its_etendue(
        "pinhole",
        PinholeCamera::new((3, 5), 70.0).unwrap().aperture(1e-6).unwrap(),
        exact,
        100,
    );
    reads_its_etendue(
        "orthographic",
        OrthographicCamera::new((4, 2), 0.3).unwrap().etendue(2e-7).unwrap(),
        exact,
        100,
    );
    reads_its_etendue("sight line", SightLine::new().etendue(3e-8).unwrap(), exact, 100);
    let opencv = OpenCvCamera::new((4, 3), matrix(), &[-0.1, 0.01, 0.001, 0.002, 0.0]).unwrap();
    reads_its_etendue("OpenCV", opencv.etendue(1e-9).unwrap(), exact, 100);
    let directions = (0..6).map(|i| Vector3D::new(0.1 * f64::from(i), 0.0, 1.0)).collect();
    let vectors = VectorCamera::new((3, 2), vec![Point3D::ORIGIN; 6], directions).unwrap();
    reads_its_etendue(
        "vectors",
        vectors.etendue_map(vec![1e-9, 2e-9, 3e-9, 4e-9, 5e-9, 6e-9]).unwrap(),
        exact,
        100,
    );
    let line = |x| Sightline::new(Point3D::new(x, 0.0, 0.0), Vector3D::new(x, 1.0, 1.0)).unwrap();
    let lines =
        [line(0.0).etendue(1e-9).unwrap(), line(1.0).acceptance(20.0).unwrap().aperture(1e-6).unwrap()];
    reads_its_etendue("lines of sight", SightlineArray::new(lines).unwrap(), exact, 100);
}

#[test]
fn sensors_without_an_etendue_read_radiance() {
    let furnace = world([dome()]);
    let w08 = read_radiance(PinholeCamera::new((3, 5), 70.0).unwrap(), &furnace, 50);
    let w09 = read_radiance(OrthographicCamera::new((4, 2), 0.3).unwrap(), &furnace, 50);
    let w10 = read_radiance(SightLine::new(), &furnace, 50);
    for found in w08.into_iter().chain(w09).chain(w10) {
        assert_eq!(judge(1.0, Demand::Exact, found), Ok(()));
    }
}

#[test]
fn sensors_whose_rays_weigh_differently_read_the_same_within_their_errors() {
    let mean = Demand::Mean;
    reads_its_etendue("thin lens", ThinLensCamera::new((2, 3), 80.0, 0.4, 1.5).unwrap(), mean, 20_000);
    let target = || [Target::sphere(Point3D::new(0.5, 0.0, 2.0), 0.8).unwrap()];
    reads_its_etendue(
        "targeted pixel",
        Pixel::new(0.01, 0.02).unwrap().targets(target(), 0.5).unwrap(),
        mean,
        200_000,
    );
    let ccd: TargetedCcdArray = CcdArray::new((2, 1), 0.02).unwrap().targets(target(), 0.5).unwrap();
    reads_its_etendue("targeted CCD", ccd, mean, 200_000);
}

#[test]
fn a_sensor_in_glass_reads_the_radiance_in_glass() {
    let world = world([dome(), ball([0.0; 3], 1.0, Dielectric::new(1.5, 1.0).unwrap())]);
    let reading = read(Pixel::new(0.01, 0.01).unwrap(), &world, Place::default(), 20_000)[0];
    // A pixel of this size sees no part of the ball beyond the critical angle: every path reads the same.
    accept_estimate("X03", expected("X03"), Demand::Exact, reading.radiance);
    accept_estimate("X04", expected("X04"), Demand::Exact, reading.power);
}

#[test]
fn two_holes_have_the_etendue_of_their_view_factor() {
    for (id, distance) in [("V06a", 0.1), ("V06b", 0.01), ("V06c", 0.001)] {
        // What shines through the second hole is a disk of radiance 1: the end of a rod behind it.
        let rod =
            Cylinder::new(1e-3, 0.01).unwrap().material(lamp()).transform(translate(0.0, 0.0, distance));
        let target = Target::sphere(Point3D::new(0.0, 0.0, distance), 1e-3).unwrap();
        let hole = FibreOptic::new(90.0, 1e-3).unwrap().targets([target], 0.9).unwrap();
        let reading = read(hole, &world([rod]), Place::default(), 320_000)[0];
        accept_estimate(id, expected(id), Demand::Mean, reading.power);
    }
}

/// A lamp that fills 10° around a direction at an elevation over a small pixel, and what the pixel collects.
fn low_lamp(elevation: f64) -> (World, Target, f64) {
    let (radius, distance) = (5.0 * 10f64.to_radians().sin(), 5.0);
    let lamp = ball_lamp(radius, distance, 90.0 - elevation);
    let centre = Point3D::from(times(tilted(90.0 - elevation), distance));
    let factor = ball_factor(radius, distance, (90.0 - elevation).to_radians());
    let target = Target::sphere(centre, radius).unwrap();
    (world([lamp]), target, std::f64::consts::PI * 1e-8 * factor)
}

#[test]
fn a_targeted_pixel_reads_what_a_pixel_reads_at_every_elevation() {
    for elevation in [90.0, 45.0, 12.0, 3.0] {
        let (world, target, power) = low_lamp(elevation);
        let pixel = || Pixel::new(1e-4, 1e-4).unwrap();
        let targeted =
            read(pixel().targets([target], 0.9).unwrap(), &world, Place::default(), 400_000)[0].power;
        accept_estimate(format!("targeted, {elevation}°"), power, Demand::Mean, targeted);
        let plain = read(pixel(), &world, Place::default(), 250_000)[0].power;
        let off = (plain.value - power) / plain.error;
        println!("plain, {elevation}°: {plain:?}, z {off:+.2}");
        assert!(off.abs() < 4.0 && plain.error < 0.05 * power, "{elevation}°: {plain:?} of {power}");
    }
}

/// Radius of the emitting ball in its box, whose half size is 1 m.
const BALL: f64 = 0.4;

/// A box of six pixels around an emitting ball, under a node, with all of them together.
fn six_faces(transform: AffineMatrix3D) -> Estimate {
    let mut world = World::new();
    let room = world.add(Node::group().transform(transform)).unwrap();
    let node = world.add(Sphere::new(BALL).unwrap().material(lamp()).parent(room)).unwrap();
    let face = translate(0.0, 0.0, -1.0);
    let turns =
        [rotate_x(0.0), rotate_x(90.0), rotate_x(180.0), rotate_x(270.0), rotate_y(90.0), rotate_y(270.0)];
    let mut sum = Estimate { value: 0.0, error: 0.0 };
    for turn in turns {
        let place = Place { parent: Some(room), transform: turn * face };
        let pixel = Pixel::new(2.0, 2.0).unwrap().transform(place.transform).parent(room);
        let power = read(pixel.aimed_at(&world, &[node], 0.9).unwrap(), &world, place, 40_000)[0].power;
        sum = Estimate { value: sum.value + power.value, error: sum.error.hypot(power.error) };
    }
    sum
}

#[test]
fn six_faces_around_a_ball_collect_all_of_its_power_wherever_they_hang() {
    let all = 4.0 * std::f64::consts::PI.powi(2) * BALL * BALL;
    accept_estimate("six faces", all, Demand::Mean, six_faces(AffineMatrix3D::IDENTITY));
    let moved = translate(100.0, -20.0, 3.0) * rotate(40.0, 50.0, 60.0);
    accept_estimate("six faces, moved", all, Demand::Mean, six_faces(moved));
}

#[test]
fn the_triangles_of_an_inward_box_collect_all_of_the_power_of_a_ball() {
    let world = world([ball([0.1, 0.0, -0.1], BALL, lamp())]);
    let inward = MeshData::cube(1.0).unwrap().flipped();
    let target = || [Target::sphere(Point3D::new(0.1, 0.0, -0.1), BALL).unwrap()];
    let all = 4.0 * std::f64::consts::PI.powi(2) * BALL * BALL;
    let sum = |readings: Vec<crate::readings::PixelReading>| {
        let value = readings.iter().map(|r| r.power.value).sum();
        let error = readings.iter().map(|r| r.power.error.powi(2)).sum::<f64>().sqrt();
        Estimate { value, error }
    };
    let camera = MeshCamera::new(&inward).unwrap().targets(target(), 0.9).unwrap();
    accept_estimate("mesh camera", all, Demand::Mean, sum(read(camera, &world, Place::default(), 20_000)));
    let pixel = MeshPixel::new(&inward).unwrap().targets(target(), 0.9).unwrap();
    accept_estimate("mesh pixel", all, Demand::Mean, sum(read(pixel, &world, Place::default(), 200_000)));
}

#[test]
fn a_mesh_sensor_takes_over_the_transform_of_its_node_and_leaves_a_mesh_of_the_scene_by_its_offset() {
    let data = MeshData::cube(0.5).unwrap();
    let moved = translate(3.0, 1.0, -2.0) * rotate(20.0, 30.0, 40.0);
    let mut world = world([dome()]);
    let body = Mesh::new(data.clone()).unwrap().material(Lambert::new(0.0)).transform(moved);
    let node = world.add(body).unwrap();
    let place = Place { parent: Some(node), transform: AffineMatrix3D::IDENTITY };
    let lifted = MeshPixel::new(&data).unwrap().surface_offset(1e-9).unwrap();
    let power = read(lifted, &world, place, 2000)[0].power;
    accept_estimate("mesh pixel on a mesh", 6.0 * std::f64::consts::PI, Demand::Exact, power);
    // In another place it begins within the black cube, or sees a part of it.
    let elsewhere = MeshPixel::new(&data).unwrap().surface_offset(1e-9).unwrap();
    let place = Place { parent: Some(node), transform: translate(0.5, 0.0, 0.0) };
    let power = read(elsewhere, &world, place, 2000)[0].power;
    assert!(judge(6.0 * std::f64::consts::PI, Demand::Exact, power).is_err());
}

#[test]
fn an_observer_looks_where_its_node_looks() {
    let mut world = world([ball([0.0, 0.0, 5.0], 1.0, lamp())]);
    let arm = world.add(Node::group()).unwrap();
    let place = Place { parent: Some(arm), transform: AffineMatrix3D::IDENTITY };
    let line = || SightLine::new().etendue(1.0).unwrap();
    assert_eq!(read(line(), &world, place, 10)[0].radiance.value, 1.0);
    world.set_transform(arm, rotate_x(180.0)).unwrap();
    assert_eq!(read(line(), &world, place, 10)[0].radiance.value, 0.0);
}
