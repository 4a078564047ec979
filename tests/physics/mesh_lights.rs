//! Meshes as lamps: sampled by the areas of their triangles, found as often as lamps of other shapes.

use raysect::core::{
    BoundingBox3D, Crossing, Feature, Node, Primitive, Ray, Scratch, Surface, SurfaceSample, SurfaceSampling,
};
use raysect::math::{AffineMatrix3D, Point3D, Vector3D, translate};
use raysect::optical::LightSampling::{BoundingSpheres, Lights, Off};
use raysect::optical::{AnisotropicSurfaceEmitter, Lambert, Optics, WithMaterial, World};
use raysect::primitive::{Cuboid, Mesh, MeshData};

use crate::check::{Demand, Probe, accept, refuse};
use crate::irradiance::box_factor;
use crate::lights::{accept_all, all_agree, look, over_a_plate, shear};
use crate::scenes::{ball, cuboid, lamp, world};

/// The square of 0.8 m at a height of 0.7 m, in triangles about a point beside its middle, each side split so often. They
/// are of very different areas, and all face down.
fn square(splits: usize) -> MeshData {
    let corners = [[-0.4, -0.4], [-0.4, 0.4], [0.4, 0.4], [0.4, -0.4]];
    let rim = (0..4 * splits).map(|i| {
        let ([a, b], share) = ([corners[i / splits], corners[(i / splits + 1) % 4]], (i % splits) as f64);
        let t = share / splits as f64;
        [a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1]), 0.7]
    });
    let count = 4 * splits as u32;
    let triangles = (0..count).map(|i| [0, 1 + i, 1 + (i + 1) % count]);
    MeshData::new([[0.3, -0.25, 0.7]].into_iter().chain(rim), triangles).unwrap()
}

/// The same square as a sheet.
fn sheet() -> Cuboid {
    cuboid([-0.4, -0.4, 0.7], [0.4, 0.4, 0.7])
}

/// A mesh that is a sheet.
fn open(data: MeshData) -> Mesh {
    Mesh::builder(data).closed(false).build().unwrap()
}

/// A cube, and what it is as a cuboid.
fn cube() -> (Mesh, Cuboid) {
    (Mesh::new(MeshData::cube(0.5).unwrap()).unwrap(), Cuboid::centred(1.0, 1.0, 1.0).unwrap())
}

/// Meshes in one.
fn together(meshes: impl IntoIterator<Item = MeshData>) -> MeshData {
    let (mut vertices, mut triangles): (Vec<[f64; 3]>, Vec<[u32; 3]>) = Default::default();
    for mesh in meshes {
        let first = vertices.len() as u32;
        vertices.extend(mesh.vertices().iter().map(|v| v.to_array()));
        triangles.extend(mesh.triangles().iter().map(|t| t.map(|v| v + first)));
    }
    MeshData::new(vertices, triangles).unwrap()
}

fn moved(data: MeshData, x: f64, y: f64, z: f64) -> MeshData {
    data.transformed(&translate(x, y, z)).unwrap()
}

#[test]
fn a_square_of_triangles_shines_as_the_sheet() {
    let factor = box_factor(&sheet(), &AffineMatrix3D::IDENTITY);
    for splits in [1, 40] {
        let world = over_a_plate([open(square(splits)).material(lamp())]);
        let case = format!("square of {} triangles", 4 * splits);
        accept_all(&case, factor, &world, [600_000, 300_000, 400_000]);
    }
    let solid = over_a_plate([sheet().material(lamp())]);
    let triangles = over_a_plate([open(square(40)).material(lamp())]);
    let (a, b) = (look(&solid, Lights, 600_000).radiance, look(&triangles, Lights, 600_000).radiance);
    let error = a.error().hypot(b.error());
    println!("as a sheet {a}, as triangles {b}");
    assert!(error < 1e-3 * a.mean() && (a.mean() - b.mean()).abs() < 4.0 * error, "{a} {b}");
}

#[test]
fn cubes_of_triangles_under_affine_maps() {
    for (name, map) in [
        ("moved", translate(0.3, -0.2, 1.5)),
        ("sheared", translate(0.2, 0.0, 1.3) * shear()),
        (
            "mirrored",
            translate(0.2, 0.1, 1.4)
                * AffineMatrix3D::from_axes(Vector3D::X * -1.0, Vector3D::Y, Vector3D::Z, Point3D::ORIGIN),
        ),
    ] {
        let (mesh, solid) = cube();
        let world = over_a_plate([mesh.material(lamp()).transform(map)]);
        accept_all(name, box_factor(&solid, &map), &world, [300_000, 640_000, 750_000]);
    }
}

#[test]
fn triangles_shine_on_the_sides_that_the_material_says() {
    let seen = |from_the_back: bool| {
        let material = AnisotropicSurfaceEmitter::new(move |_, _, back, out| {
            out.fill(f64::from(u8::from(back == from_the_back)));
        });
        look(&over_a_plate([open(square(3)).material(material)]), Lights, 200_000)
    };
    // The fronts look down, at the plate.
    assert!(square(3).face_normal(0).unwrap().z < 0.0);
    let factor = box_factor(&sheet(), &AffineMatrix3D::IDENTITY);
    accept("front", 0.7 * factor, Demand::Mean, &seen(false));
    assert_eq!(seen(true).highest, 0.0);
}

#[test]
fn meshes_that_hide_parts_of_themselves() {
    let small = moved(MeshData::cube(0.3).unwrap(), 0.1, 0.1, 0.6);
    let large = moved(MeshData::cube(0.6).unwrap(), 0.2, -0.2, 1.8);
    let mesh = Mesh::new(together([small, large])).unwrap();
    assert!(mesh.is_closed());
    all_agree("two cubes in one", &over_a_plate([mesh.material(lamp())]), [200_000, 400_000, 400_000]);
}

#[test]
fn smooth_meshes_shine_by_their_smooth_normals() {
    let coarse = MeshData::icosphere(1, 0.5).unwrap();
    let normals: Vec<[f64; 3]> = coarse.vertices().iter().map(|v| v.to_array().map(|x| 2.0 * x)).collect();
    let triangles = coarse.triangles().to_vec();
    let smooth = coarse.with_normals(normals, triangles).unwrap();
    let star = AnisotropicSurfaceEmitter::new(|_, cosine, _, out| out.fill(cosine.powi(4)));
    let node = Mesh::new(smooth).unwrap().material(star).transform(translate(0.2, 0.1, 0.9));
    all_agree("smooth ball", &over_a_plate([node]), [300_000, 600_000, 900_000]);
}

#[test]
fn an_enclosing_mesh_is_left_to_the_directions_of_the_surface() {
    let dome = || MeshData::icosphere(3, 60.0).unwrap();
    let room = |shell: Mesh| world([shell.material(lamp()), ball([0.0; 3], 1.0, Lambert::new(0.8))]);
    let closed = Probe::new(2000).along(&room(Mesh::new(dome()).unwrap()), [0.3, 0.2, -5.0], [0.0, 0.0, 1.0]);
    accept("ball in a mesh", 0.8, Demand::Exact, &closed);
    assert_eq!(closed.ledger.shadow_rays, 0);
    // One that is said to be a sheet is sampled, with weights below a bound.
    let shell = Probe::new(300_000).along(&room(open(dome())), [0.3, 0.2, -5.0], [0.0, 0.0, 1.0]);
    accept("ball in a shell", 0.8, Demand::Mean, &shell);
    assert!(shell.highest <= 2.0, "{}", shell.highest);
}

/// Variance of a sample of the plate under a lamp, each way of looking for it.
fn variances(case: &str, lamps: impl Fn() -> Node<Optics>, count: u64) -> [f64; 3] {
    let scene: World = over_a_plate([lamps()]);
    let found = [Lights, BoundingSpheres, Off].map(|sampling| {
        let radiance = look(&scene, sampling, count).radiance;
        radiance.variance() / radiance.mean().powi(2)
    });
    let [lights, spheres, off] = found;
    println!("{case:<24} variance/mean²: by area {lights:.3}, bounding sphere {spheres:.3}, chance {off:.3}");
    found
}

#[test]
fn sampling_by_area_is_less_noisy_than_by_bounding_spheres() {
    let rod = || {
        MeshData::cube(0.5).unwrap().transformed(&AffineMatrix3D::from_axes(
            Vector3D::X * 3.0,
            Vector3D::Y * 0.05,
            Vector3D::Z * 0.05,
            Point3D::new(0.0, 0.2, 0.8),
        ))
    };
    let rod = variances("rod", || Mesh::new(rod().unwrap()).unwrap().material(lamp()), 400_000);
    let square = variances("square", || open(square(40)).material(lamp()), 100_000);
    let cubes = variances("cube", || cube().0.material(lamp()).transform(translate(0.3, -0.2, 1.5)), 100_000);
    let small = || Mesh::new(MeshData::icosphere(3, 0.1).unwrap()).unwrap().material(lamp());
    let ball = variances("small ball", || small().transform(translate(0.0, 0.3, 1.5)), 400_000);
    for (found, gain) in [(rod, 20.0), (square, 20.0), (cubes, 8.0), (ball, 3.0)] {
        assert!(gain * found[0] < found[1] && found[0] < found[2], "{found:?}");
    }
}

/// A mesh that draws its triangles by area, but says that all are equally likely.
struct Equal(Mesh);

impl Primitive for Equal {
    fn bounding_box(&self, m: &AffineMatrix3D) -> BoundingBox3D {
        self.0.bounding_box(m)
    }
    fn contains(&self, point: Point3D) -> bool {
        self.0.contains(point)
    }
    fn crossings(&self, ray: &Ray, scratch: &mut Scratch, out: &mut Vec<Crossing>) {
        self.0.crossings(ray, scratch, out);
    }
    fn surface(&self, ray: &Ray, crossing: &Crossing) -> Surface {
        self.0.surface(ray, crossing)
    }
    fn is_solid(&self) -> bool {
        false
    }
    fn surface_sampling(&self) -> SurfaceSampling {
        SurfaceSampling::Area
    }
    fn sample_surface(&self, from: Point3D, u: [f64; 3]) -> Option<SurfaceSample> {
        let sample = self.0.sample_surface(from, u)?;
        Some(SurfaceSample { density: self.surface_density(from, sample.point, sample.feature), ..sample })
    }
    fn surface_density(&self, _: Point3D, _: Point3D, feature: Feature) -> f64 {
        let data = self.0.data();
        1.0 / (data.triangle_count() as f64 * data.triangle_area(feature.face as usize))
    }
}

#[test]
fn a_wrong_density_of_triangles_is_found_out() {
    let factor = box_factor(&sheet(), &AffineMatrix3D::IDENTITY);
    let reading = look(&over_a_plate([Equal(open(square(1))).material(lamp())]), Lights, 600_000);
    refuse("equal densities", 0.7 * factor, Demand::Mean, &reading);
}
