//! Numbers that are known from elsewhere: of whole lamps, coatings, glasses, metals and lenses.

use std::f64::consts::PI;

use raysect::core::Node;
use raysect::math::{Point3D, Vector3D, rotate_x, rotate_y, translate};
use raysect::observer::{Estimate, FibreOptic, MeshCamera, MeshPixel, Observer, Pixel, Sensor, Target};
use raysect::optical::library::{metal_index, schott};
use raysect::optical::{
    BlackBody, Conductor, Dielectric, Dispersion, FresnelLaw, Optics, PathSettings, Ray, SpectralFunction,
    UniformVolume, WithMaterial, World,
};
use raysect::primitive::{BiConvex, Meniscus, MeshData, Sphere};

use crate::check::{Demand, Probe, accept};
use crate::readings::{Place, accept_estimate, read};
use crate::scenes::{ball, cuboid, dome, lamp, tilted, times, world};

/// Radius of the lamps [m].
const RADIUS: f64 = 0.6;

/// Balls of 1 W/m²/sr/nm on their surface, and of 1 W/m³/sr/nm in their volume, with the power of each [W/nm].
fn lamps() -> [(&'static str, World, f64); 2] {
    let surface: Node<Optics> = ball([0.0; 3], RADIUS, lamp());
    let volume = ball([0.0; 3], RADIUS, UniformVolume::emitter(1.0));
    let surface_power = 4.0 * PI * PI * RADIUS.powi(2);
    let volume_power = 16.0 / 3.0 * PI * PI * RADIUS.powi(3);
    [("surface", world([surface]), surface_power), ("volume", world([volume]), volume_power)]
}

/// An observer that looks for the lamps.
fn aimed<S: Sensor + 'static>(observer: Observer<S>, centre: Point3D) -> Observer<impl Sensor> {
    observer.targets([Target::sphere(centre, RADIUS).unwrap()], 0.9).unwrap()
}

/// The sum of independent estimates.
fn sum(all: impl IntoIterator<Item = Estimate>) -> Estimate {
    let add = |(v, e): (f64, f64), x: Estimate| (v + x.value, e + x.error * x.error);
    let (value, variance) = all.into_iter().fold((0.0, 0.0), add);
    Estimate { value, error: variance.sqrt() }
}

#[test]
fn all_that_a_lamp_emits_arrives_on_what_encloses_it() {
    // A box of 2 m: as six pixels, as one pixel of the shape of its inner side, and as a pixel for each triangle.
    let inside = MeshData::cube(1.0).unwrap().flipped();
    for (name, world, expected) in lamps() {
        let turns = [0.0, 90.0, 180.0, 270.0].map(rotate_x).into_iter().chain([90.0, -90.0].map(rotate_y));
        let faces = turns.map(|turn| {
            let face = aimed(Pixel::new(2.0, 2.0).unwrap(), Point3D::new(0.0, 0.0, 1.0));
            let place = Place { parent: None, transform: turn * translate(0.0, 0.0, -1.0) };
            read(face, &world, place, 60_000)[0].power
        });
        let faces: Vec<Estimate> = faces.collect();
        accept_estimate(format!("{name}, a face"), expected / 6.0, Demand::Mean, faces[0]);
        accept_estimate(format!("{name}, mesh pixel"), expected, Demand::Mean, {
            read(aimed(MeshPixel::new(&inside).unwrap(), Point3D::ORIGIN), &world, Place::default(), 400_000)
                [0]
            .power
        });
        let triangles = aimed(MeshCamera::new(&inside).unwrap(), Point3D::ORIGIN);
        let triangles = read(triangles, &world, Place::default(), 40_000);
        let triangles = sum(triangles.iter().map(|t| t.power));
        accept_estimate(format!("{name}, mesh camera"), expected, Demand::Mean, triangles);
    }
}

#[test]
fn a_small_fibre_far_away_tells_the_power_of_a_lamp() {
    let (distance, radius) = (8.0, 1e-3);
    for (name, world, expected) in lamps() {
        let fibre = aimed(FibreOptic::new(10.0, radius).unwrap(), Point3D::new(0.0, 0.0, distance));
        let place = Place { parent: None, transform: translate(0.0, 0.0, -distance) };
        let power = read(fibre, &world, place, 400_000)[0].power;
        let scale = (2.0 * distance / radius).powi(2);
        let whole = Estimate { value: scale * power.value, error: scale * power.error };
        accept_estimate(format!("{name}, fibre"), expected, Demand::Mean, whole);
    }
}

#[test]
fn a_clear_plate_lets_through_twelve_thirteenths() {
    let plate = cuboid([-9.0, -9.0, 0.0], [9.0, 9.0, 0.2]).material(Dielectric::new(1.5, 1.0).unwrap());
    let above = cuboid([-90.0, -90.0, 5.0], [90.0, 90.0, 6.0]).material(lamp());
    let reading = Probe::new(80_000).along(&world([plate, above]), [0.1, 0.2, -3.0], [0.0, 0.0, 1.0]);
    accept("plate of 1.5", 12.0 / 13.0, Demand::Mean, &reading);
}

#[test]
fn a_metal_reflects_by_either_law_what_it_should() {
    let cases = [
        (0.0, 0.9233716475095786, 0.923372),
        (45.0, 0.9213196206930542, 0.922464),
        (80.0, 0.9385583697111498, 0.940644),
    ];
    for (degrees, exact, large) in cases {
        for (law, expected, digits) in
            [(FresnelLaw::Exact, exact, 1e-13), (FresnelLaw::LargeIndex, large, 5.1e-7)]
        {
            let metal = Conductor::new(0.2, 3.0).fresnel(law);
            let plate = cuboid([-9.0, -9.0, -1.0], [9.0, 9.0, 0.0]).material(metal);
            let scene = world([plate, dome()]);
            let from = tilted(degrees);
            let reading = Probe::new(1).along(&scene, times(from, 2.0), times(from, -1.0));
            let found = reading.radiance.mean();
            assert!((found - expected).abs() < digits, "{law:?} at {degrees} degrees: {found} {expected}");
        }
    }
}

#[test]
fn a_path_through_a_ball_of_n_bk7_meets_the_known_places() {
    let bk7 = schott("N-BK7").unwrap().transmission_only(true);
    let screen = cuboid([-9.0, -9.0, 3.0], [9.0, 9.0, 4.0]).material(lamp());
    let world = world([Sphere::new(1.0).unwrap().material(bk7.clone()), screen]);
    let ray = Ray::new(Point3D::new(0.3, 0.0, -5.0), Vector3D::Z).spectrum(375.0, 785.0, 40);
    let log = ray.settings(PathSettings::default().dispersion(Dispersion::Mean)).replay(&world, 0).unwrap();
    assert_eq!(log.vertices.len(), 4, "{log}");
    // In the plane of incidence it is turned towards the axis by i − r at each surface, about chords of 2 cos r.
    let index = bk7.index().function().average(375.0, 785.0);
    let incident = 0.3f64.asin();
    let refracted = (0.3 / index).asin();
    let along = |turns: f64| {
        let (sine, cosine) = (turns * (incident - refracted)).sin_cos();
        Vector3D::new(-sine, 0.0, cosine)
    };
    let entry = Point3D::new(0.3, 0.0, -incident.cos());
    let exit = entry + along(1.0) * (2.0 * refracted.cos());
    let end = exit + along(2.0) * ((3.0 - exit.z) / along(2.0).z);
    // Seven digits of another ray tracer, which lifts its rays off each surface by a micrometre.
    let known = [[0.3, 0.0, -0.953939], [0.0928314, 0.0, 0.9956818], [-0.3379947, 0.0, 3.0]];
    for ((vertex, place), known) in log.vertices[1..].iter().zip([entry, exit, end]).zip(known) {
        let off = vertex.point.distance_to(place);
        assert!(off < 1e-14, "{:?} is {off} m from {place:?}", vertex.point);
        let off = vertex.point.distance_to(known.into());
        assert!(off < 2e-6, "{:?} is {off} m from {known:?}", vertex.point);
    }
}

#[test]
fn data_and_laws_have_the_values_of_the_literature() {
    // Of an older edition of the table, whose bins differ by up to 2e-3.
    let (n, k) = metal_index("Gold").unwrap();
    assert!((n.evaluate(500.0) - 0.865143).abs() < 2e-3, "{}", n.evaluate(500.0));
    assert!((k.evaluate(500.0) - 1.849294).abs() < 2e-3, "{}", k.evaluate(500.0));
    // By older constants, of which c₂ is larger by 3.3e-7, in an exponent of 5.8.
    let warm = BlackBody::new(5000.0).unwrap().evaluate(500.0);
    let (c1, c2) = (1.19104295e20, 1.43877735e7);
    let known = c1 / 500f64.powi(5) / ((c2 / (500.0 * 5000.0f64)).exp() - 1.0);
    assert!(
        (known - 12107.1674).abs() < 1e-4 && (warm / known - 1.0 - 1.9e-6).abs() < 1e-7,
        "{warm} {known}"
    );
}

#[test]
fn lenses_have_the_edges_of_the_catalogue() {
    let lens = BiConvex::new(0.0254, 0.0052, 0.0506, 0.0506).unwrap();
    assert!((lens.edge_thickness() - 0.00196060).abs() < 5.1e-9, "{}", lens.edge_thickness());
    for sag in [lens.front_thickness(), lens.back_thickness()] {
        assert!((sag - 0.00161970).abs() < 5.1e-9, "{sag}");
    }
    let lens = Meniscus::new(0.0254, 0.0036, 0.0321, 0.0822).unwrap();
    assert!((lens.edge_thickness() - 0.00196785).abs() < 5.1e-9, "{}", lens.edge_thickness());
}
