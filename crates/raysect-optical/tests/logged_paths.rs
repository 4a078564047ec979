//! Paths that note what happens to them are the paths that do not.

use std::collections::BTreeSet;
use std::path::PathBuf;

use raysect_core::Node;
use raysect_math::{
    AffineMatrix3D, Normal3D, Point3D, Rng, Statistics, StreamKey, Vector3D, rotate, translate,
};
use raysect_optical::library::schott;
use raysect_optical::*;
use raysect_primitive::{Cuboid, Sphere};

/// Bins of all spectra here.
const BINS: usize = 5;

fn ball(radius: f64, x: f64, y: f64, z: f64, material: impl Material) -> Node<Optics> {
    Sphere::new(radius).unwrap().material(material).transform(translate(x, y, z))
}

fn slab(lower: [f64; 3], upper: [f64; 3], material: impl Material) -> Node<Optics> {
    Cuboid::new(Point3D::from(lower), Point3D::from(upper)).unwrap().material(material)
}

/// Everything that can happen to a path: glass that disperses, rough glass, a glowing fog around a shape that glows as
/// well, a lamp to be looked for, a mirror, and a way out.
fn everything() -> World {
    let mut world = World::new();
    let fog = UniformVolume::emitter(0.02).absorption(0.1).scattering(0.4, Rayleigh);
    for node in [
        slab([-9.0, -2.0, -9.0], [9.0, -1.5, 9.0], Lambert::new(0.7)).name("floor"),
        ball(1.0, -2.0, 0.0, 0.0, schott("SF11").unwrap()).name("glass"),
        ball(1.0, 2.0, 0.0, 0.0, RoughDielectric::of(schott("N-BK7").unwrap(), 0.3).unwrap()).name("frosted"),
        ball(1.2, 0.0, 0.5, 3.0, fog).name("fog"),
        ball(0.2, 0.0, 0.5, 3.0, UniformSurfaceEmitter::new(0.5, 0.3)).name("coal"),
        ball(0.6, 0.0, 5.0, 0.0, UniformSurfaceEmitter::new(1.0, 4.0)).name("lamp"),
        ball(0.5, 0.0, 0.0, -2.0, PerfectReflectingSurface).name("mirror"),
    ] {
        world.add(node).unwrap();
    }
    world
}

fn rng(sample: u64) -> Rng {
    Rng::keyed(StreamKey { seed: 4, sample, ..StreamKey::default() })
}

/// A ray from somewhere around towards somewhere in the middle.
fn ray(sample: u64) -> raysect_core::Ray {
    let mut rng = Rng::keyed(StreamKey { seed: 9, sample, ..StreamKey::default() });
    let mut point =
        |size: f64| Vector3D::new(rng.range(-size, size), rng.range(-1.0, 1.5), rng.range(-size, size));
    let (from, to) = (point(6.0), point(3.0));
    raysect_core::Ray::new(Point3D::ORIGIN + from, to - from)
}

/// Follows many paths with and without notes, and answers with the notes.
fn both_ways(settings: &PathSettings, count: u64) -> Vec<LoggedPath> {
    let world = everything();
    let slices = Slicing::new(400.0, 700.0, BINS, 1).unwrap().slices();
    let scene = world.scene().unwrap();
    let (mut plain, mut logged) =
        (Path::new(scene, &slices[0], settings), Path::new(scene, &slices[0], settings));
    let paths = (0..count).map(|sample| {
        let radiance = plain.follow(&ray(sample), rng(sample)).to_vec();
        let path = logged.follow_logged(&ray(sample), rng(sample));
        let bits = |radiance: &[f64]| radiance.iter().map(|r| r.to_bits()).collect::<Vec<_>>();
        assert_eq!(bits(&radiance), bits(&path.radiance), "{path}");
        assert_eq!(plain.rng().bits(), logged.rng().bits(), "{path}");
        path
    });
    let paths = paths.collect();
    assert_eq!(plain.ledger(), logged.ledger());
    paths
}

fn events(paths: &[LoggedPath]) -> BTreeSet<usize> {
    paths.iter().flat_map(|path| path.vertices.iter().map(|vertex| vertex.event as usize)).collect()
}

#[test]
fn logged_paths_have_the_bits_of_others() {
    let mut seen = events(&both_ways(&PathSettings::default(), 3000));
    seen.extend(events(&both_ways(&PathSettings::default().max_depth(3), 300)));
    seen.extend(events(&both_ways(&PathSettings::default().light_sampling(LightSampling::Off), 300)));
    let missing: Vec<_> = PathEvent::ALL.iter().filter(|event| !seen.contains(&(**event as usize))).collect();
    assert_eq!(missing, [&PathEvent::Lost]);
}

#[test]
fn the_parts_make_the_whole() {
    let (mut rays, mut shadow_rays, mut depth) = (0, 0, 0);
    for path in both_ways(&PathSettings::default(), 1000) {
        let last = path.vertices.len() - 1;
        assert!(last >= 1 && path.vertices[0].event == PathEvent::Started, "{path}");
        for bin in 0..BINS {
            let parts: f64 = path.vertices.iter().map(|v| v.along[bin] + v.radiance[bin]).sum();
            assert!((parts - path.radiance[bin]).abs() <= 1e-13 * path.radiance[bin].abs(), "{path}");
        }
        for (number, vertex) in path.vertices.iter().enumerate() {
            assert_eq!(vertex.event.is_end(), number == last, "{path}");
            assert_eq!(vertex.hit.is_none(), matches!(vertex.event, PathEvent::Started | PathEvent::Escaped));
        }
        let scatterings = path
            .vertices
            .iter()
            .filter(|v| !v.event.is_end() && !matches!(v.event, PathEvent::Started | PathEvent::Passed));
        // Roulette and directions that carry nothing end a path just after a scattering.
        let more = path.depth - scatterings.count() as u32;
        let possible = match path.end() {
            PathEvent::Killed | PathEvent::Truncated => more == 1,
            PathEvent::Absorbed => more <= 1,
            _ => more == 0,
        };
        assert!(possible, "{path}");
        (rays, shadow_rays, depth) = (rays + path.rays, shadow_rays + path.shadow_rays, depth + path.depth);
        // Each vertex but the first is the end of one ray.
        assert_eq!(path.rays, last as u64, "{path}");
    }
    assert!(rays > 3000 && shadow_rays > 500 && depth > 2000, "{rays} {shadow_rays} {depth}");
}

#[test]
fn throughputs_change_at_vertices_and_in_media_only() {
    let (world, mut dimmed) = (everything(), 0);
    for path in both_ways(&PathSettings::default(), 1000) {
        let mut settled = false;
        for pair in path.vertices.windows(2) {
            let (here, next) = (&pair[0], &pair[1]);
            let middle = here.point + here.point.vector_to(next.point) * 0.5;
            if world.contains(middle).unwrap().is_empty() {
                assert_eq!(here.after, next.before, "{path}");
            } else {
                dimmed += usize::from(next.mean_before() < here.mean_after());
            }
            let carried = here.after.iter().filter(|t| **t > 0.0).count();
            assert!(!settled || carried <= 1, "{path}");
            settled |= carried == 1;
        }
        assert!(path.wavelength.is_some() || !settled, "{path}");
        assert!(path.wavelength.is_none_or(|w| (400.0..700.0).contains(&w)));
    }
    assert!(dimmed > 300, "{dimmed}");
}

/// A window without reflections, a null surface in front, a mirror behind it, and a lamp behind the start.
fn cabinet() -> World {
    let mut world = World::new();
    let window = Dielectric::new(1.5, 0.25).unwrap().transmission_only(true).named("window");
    for node in [
        slab([-1.0, -1.0, 1.0], [1.0, 1.0, 1.5], NullMaterial).name("ghost"),
        slab([-1.0, -1.0, 2.0], [1.0, 1.0, 2.5], window).name("pane"),
        slab([-1.0, -1.0, 4.0], [1.0, 1.0, 5.0], PerfectReflectingSurface).name("mirror, back"),
        slab([-1.0, -1.0, -3.0], [1.0, 1.0, -2.0], UniformSurfaceEmitter::new(1.0, 8.0)).name("lamp"),
    ] {
        world.add(node).unwrap();
    }
    world
}

fn straight() -> Ray {
    Ray::new(Point3D::new(0.1, 0.2, 0.0), Vector3D::new(0.0, 0.0, 7.0)).spectrum(500.0, 501.0, 1)
}

#[test]
fn a_simple_path_is_told_in_full() {
    let path = straight().replay(&cabinet(), 0).unwrap();
    use PathEvent::*;
    // Places along z, events, names, whether from inside, and throughput afterwards: radiance changes by n², and 0.5 m
    // of glass let a half through.
    let (n, half) = (2.25, 0.5);
    let expected = [
        (0.0, Started, "", false, 1.0),
        (1.0, Passed, "ghost", false, 1.0),
        (1.5, Passed, "ghost", true, 1.0),
        (2.0, Refracted, "pane", false, 1.0 / n),
        (2.5, Refracted, "pane", true, half),
        (4.0, Mirrored, "mirror, back", false, half),
        (2.5, Refracted, "pane", false, half / n),
        (2.0, Refracted, "pane", true, half * half),
        (1.5, Passed, "ghost", false, half * half),
        (1.0, Passed, "ghost", true, half * half),
        (-2.0, Emitted, "lamp", false, 0.0),
    ];
    assert_eq!(path.vertices.len(), expected.len(), "{path}");
    for (vertex, (z, event, name, inside, after)) in path.vertices.iter().zip(expected) {
        assert!(vertex.point.distance_to(Point3D::new(0.1, 0.2, z)) < 1e-12, "{path}");
        assert_eq!(vertex.event, event, "{path}");
        let hit = vertex.hit.as_ref().map_or(("", false), |hit| (hit.name.as_str(), hit.inside));
        assert_eq!(hit, (name, inside), "{path}");
        assert!((vertex.mean_after() - after).abs() < 1e-12, "{path}");
    }
    let lamp = &path.vertices[10];
    assert!(
        (lamp.mean_radiance() - 8.0 * 0.25).abs() < 1e-12
            && lamp.mean_before() == path.vertices[9].mean_after()
    );
    assert_eq!((path.rays, path.shadow_rays, path.depth, path.wavelength), (10, 0, 5, None));
    assert_eq!(path.spectrum().unwrap(), straight().trace(&cabinet()).unwrap());
    assert!(
        path.to_string().contains("passed      at (0.100000, 0.200000, 1.500000) m, inside of ghost"),
        "{path}"
    );
}

#[test]
fn hits_tell_their_normals_and_where_they_lie_in_their_shapes() {
    // A turned, moved and stretched ball of fog that scatters, before a wall.
    let stretch =
        AffineMatrix3D::from_axes(Vector3D::X, Vector3D::Y * 2.0, Vector3D::Z * 0.5, Point3D::ORIGIN);
    let place = translate(0.3, -0.2, 4.0) * rotate(30.0, 40.0, 50.0) * stretch;
    let fog = UniformVolume::new().scattering(3.0, HenyeyGreenstein::isotropic());
    let mut world = World::new();
    world.add(Sphere::new(1.0).unwrap().material(fog).transform(place)).unwrap();
    let (mut surfaces, mut volumes) = (0, 0);
    for sample in 0..20 {
        for vertex in straight().replay(&world, sample).unwrap().vertices {
            let Some(hit) = vertex.hit else { continue };
            assert!((place * hit.local_point).distance_to(vertex.point) < 1e-12, "{hit:?}");
            let centre = Point3D::ORIGIN.distance_to(hit.local_point);
            let Some(normal) = hit.normal else {
                assert!(vertex.event == PathEvent::Scattered && centre < 1.0, "{hit:?}");
                volumes += 1;
                continue;
            };
            // The gradient of x² + y² + z² of the shape.
            let local = Point3D::ORIGIN.vector_to(hit.local_point);
            let expected = place
                .transform_normal(Normal3D::new(local.x, local.y, local.z))
                .unwrap()
                .as_vector()
                .normalise()
                .unwrap();
            assert!(
                (centre - 1.0).abs() < 1e-12 && (normal.as_vector() - expected).length() < 1e-12,
                "{hit:?}"
            );
            surfaces += 1;
        }
    }
    assert!(surfaces > 30 && volumes > 20, "{surfaces} {volumes}");
}

#[test]
fn emission_of_media_belongs_to_the_way() {
    let mut world = World::new();
    let cloud = UniformVolume::emitter(3.0).absorption(0.5);
    world.add(slab([-1.0, -1.0, 1.0], [1.0, 1.0, 3.0], cloud)).unwrap();
    let path = straight().replay(&world, 0).unwrap();
    let expected = 3.0 / 0.5 * (1.0 - (-1.0f64).exp());
    let along: Vec<f64> = path.vertices.iter().map(PathVertex::mean_along).collect();
    assert!((along[2] - expected).abs() < 1e-12 && along.iter().sum::<f64>() == along[2], "{path}");
    assert!(path.vertices.iter().all(|vertex| vertex.mean_radiance() == 0.0));
    assert_eq!(path.end(), PathEvent::Escaped);
    // Drawn to outside of the box of the scene, along the ray.
    let end = path.vertices[3].point;
    assert!(end.z > 3.0 && end.z < 10.0 && (end.x, end.y) == (0.1, 0.2), "{path}");
    // A ray with an end is drawn to there, and sees what lies before it.
    let path = straight().max_distance(2.0 / 7.0).replay(&world, 0).unwrap();
    let expected = 3.0 / 0.5 * (1.0 - (-0.5f64).exp());
    let last = &path.vertices[2];
    assert!((last.point.z - 2.0).abs() < 1e-12 && (last.mean_along() - expected).abs() < 1e-12, "{path}");
}

#[test]
fn paths_of_a_mean_can_be_followed_one_by_one() {
    let world = everything();
    let ray =
        Ray::new(Point3D::new(0.0, 3.0, -5.0), Vector3D::new(0.3, -0.5, 1.0)).spectrum(400.0, 700.0, BINS);
    let sampled = ray.sample(&world, 200).unwrap();
    let mut means = [Statistics::new(); BINS];
    for sample in 0..200 {
        let path = ray.replay(&world, sample).unwrap();
        means.iter_mut().zip(&path.radiance).for_each(|(mean, radiance)| mean.add(*radiance));
    }
    let found: Vec<f64> = means.iter().map(Statistics::mean).collect();
    assert_eq!(found, sampled.mean.samples());
    assert!(ray.replay(&world, 0).unwrap() != ray.replay(&world, 1).unwrap());
}

struct Folder(PathBuf);

impl Folder {
    fn new(name: &str) -> Self {
        let path = std::env::temp_dir().join(format!("raysect-{name}-{}", std::process::id()));
        std::fs::create_dir_all(&path).unwrap();
        Self(path)
    }

    fn read(&self, name: &str) -> String {
        std::fs::read_to_string(self.0.join(name)).unwrap()
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

#[test]
fn files_have_every_vertex() {
    let (folder, path) = (Folder::new("logged"), straight().replay(&cabinet(), 0).unwrap());
    path.save_csv(folder.0.join("a.csv")).unwrap();
    path.save_obj(folder.0.join("a.obj")).unwrap();
    path.save_vtk(folder.0.join("a.vtk")).unwrap();

    let csv = folder.read("a.csv");
    let lines: Vec<&str> = csv.lines().collect();
    assert_eq!((lines.len(), lines[0].split(',').count()), (12, 18));
    assert_eq!(lines[1], "0.1,0.2,0,started,,,,,1,1,0,0,,,,,,");
    assert!(lines[6].starts_with("0.1,0.2,4,mirrored,Cuboid,\"mirror, back\",PerfectReflectingSurface,0,"));
    assert!(lines[11].starts_with("0.1,0.2,-2,emitted,Cuboid,lamp,UniformSurfaceEmitter,0,"));
    let numbers = |line: &str, skip: usize| -> Vec<f64> {
        line.split(',').skip(skip).map(|number| number.parse().unwrap()).collect()
    };
    let lamp = &path.vertices[10];
    let (places, mirror) = (numbers(lines[11], 12), numbers(lines[6], 13));
    assert_eq!(numbers(lines[11], 8)[..4], [lamp.mean_before(), 0.0, 0.0, lamp.mean_radiance()]);
    let hit = lamp.hit.as_ref().unwrap();
    assert_eq!((&places[..3], &places[3..]), (&[0.0, 0.0, 1.0][..], &hit.local_point.to_array()[..]));
    // The name of the mirror has a comma.
    assert_eq!(mirror[..3], [0.0, 0.0, -1.0]);

    let obj = folder.read("a.obj");
    assert_eq!(obj.lines().filter(|line| line.starts_with("v ")).nth(5), Some("v 0.1 0.2 4"));
    assert_eq!(obj.lines().last(), Some("l 1 2 3 4 5 6 7 8 9 10 11"));

    let vtk = folder.read("a.vtk");
    let words: Vec<&str> = vtk.lines().skip(4).flat_map(str::split_whitespace).collect();
    assert_eq!(&words[..3], ["POINTS", "11", "double"]);
    assert_eq!(&words[3 + 33..3 + 33 + 5], ["LINES", "1", "12", "11", "0"]);
    let at = |word: &str| words.iter().position(|w| *w == word).unwrap();
    assert_eq!(words[at("throughput") + 5 + 3].parse(), Ok(path.vertices[3].mean_after()));
    assert_eq!(words[at("radiance") + 5 + 10].parse(), Ok(lamp.mean_radiance()));
    assert_eq!((words[at("event") + 5 + 5], words[at("event") + 5 + 11]), ("2", "VECTORS"));
    assert_eq!(words[at("normal") + 2..][..9], ["0", "0", "0", "0", "0", "-1", "0", "0", "1"]);
    let (first, last) = (at("local_point") + 2, words.len() - 3);
    assert_eq!((&words[first..first + 3], last), (&["0", "0", "0"][..], first + 30));
    let written: Vec<f64> = words[last..].iter().map(|word| word.parse().unwrap()).collect();
    assert_eq!(written, hit.local_point.to_array());

    let lost = path.save_csv(folder.0.join("no/a.csv")).unwrap_err();
    assert!(matches!(&lost, OpticalError::File { .. }) && lost.to_string().contains("no"), "{lost}");
}
