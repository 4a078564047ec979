//! Every sensor of the library beside a world.

use std::sync::Arc;

use raysect::observer::Sightline;
use raysect::prelude::*;
use raysect::save::{SceneWriter, Storable};

use crate::cameras::comes_back;
use crate::read;

fn vectors() -> VectorCamera {
    let directions = (0..6).map(|i| Vector3D::new(0.1 * f64::from(i), 1.0 / 3.0, 1.0)).collect();
    VectorCamera::new((3, 2), vec![Point3D::new(1.0 / 7.0, 0.0, -2.0); 6], directions).unwrap()
}

fn opencv() -> OpenCvCamera {
    let matrix = [[400.0, 0.1, 1.5], [0.0, 410.0, 1.0], [0.0, 0.0, 1.0]];
    let camera = OpenCvCamera::new((4, 3), matrix, &[-0.1, 0.01, 1e-3, 2e-3, 0.1, 0.2, 0.3, 0.4]).unwrap();
    camera.extrinsics([0.1, 0.2, 0.3], [1.0, 2.0, 3.0]).unwrap()
}

fn targets() -> [Target; 4] {
    let bar: Arc<dyn Primitive> = Arc::new(Cuboid::centred(1.0 / 3.0, 0.1, 2.0).unwrap());
    [
        Target::sphere(Point3D::new(0.0, 1.0 / 3.0, 2.0), 0.3).unwrap(),
        Target::rectangle(Point3D::new(0.5, 0.0, 1.0), [Vector3D::X, Vector3D::Y]).unwrap(),
        Target::disk(Point3D::new(0.5, 0.0, 1.0), Vector3D::new(0.1, 0.0, 1.0), 0.2).unwrap(),
        Target::shape(&bar, translate(0.0, 0.1, 1.0) * rotate(10.0, 20.0, 30.0)).unwrap(),
    ]
}

#[test]
fn every_sensor_comes_back() {
    let ball = MeshData::icosphere(1, 0.3).unwrap();
    comes_back(&OrthographicCamera::new((3, 2), 0.7).unwrap());
    comes_back(&OrthographicCamera::new((1, 2), 0.7).unwrap().etendue_map(vec![1e-9, 0.0]).unwrap());
    comes_back(&CcdArray::new((7, 3), 0.1).unwrap());
    comes_back(&vectors());
    comes_back(&vectors().footprint(false).etendue(1e-9).unwrap());
    comes_back(&opencv());
    comes_back(&opencv().etendue(1e-9).unwrap());
    comes_back(&ThinLensCamera::new((7, 3), 33.3, 0.07, 1.7).unwrap());
    comes_back(&SightLine::new());
    comes_back(&SightLine::new().etendue(1e-9).unwrap());
    comes_back(&FibreOptic::new(7.7, 1e-3).unwrap());
    comes_back(&Pixel::new(0.1, 1.0 / 3.0).unwrap());
    comes_back(&MeshPixel::new(&ball).unwrap().surface_offset(1e-6).unwrap());
    comes_back(&MeshCamera::new(&ball).unwrap().surface_offset(1e-6).unwrap());
    let line = Sightline::new(Point3D::new(0.1, 0.2, 0.3), Vector3D::new(1.0, 2.0, 3.0)).unwrap();
    comes_back(&SightlineArray::new([line, line.acceptance(1.1).unwrap().aperture(1e-6).unwrap()]).unwrap());
    comes_back(&Pixel::new(0.1, 0.2).unwrap().etendue_without_cosine(true));
    comes_back(&CcdArray::new((7, 3), 0.1).unwrap().etendue_without_cosine(true));
    comes_back(&FibreOptic::new(7.7, 1e-3).unwrap().etendue_without_cosine(true));
    comes_back(&MeshPixel::new(&ball).unwrap().etendue_without_cosine(true).surface_offset(1e-6).unwrap());
    comes_back(&MeshCamera::new(&ball).unwrap().etendue_without_cosine(true));
    comes_back(&Pixel::new(0.1, 0.2).unwrap().targets(targets(), 0.7).unwrap());
    comes_back(&CcdArray::new((2, 2), 0.1).unwrap().targets(targets(), 0.3).unwrap());
    comes_back(&PinholeCamera::new((2, 2), 33.3).unwrap().targets(targets(), 0.3).unwrap());
}

/// The message of a camera whose text has been changed.
fn refusal<T: Storable>(value: &T, old: &str, new: &str) -> String {
    let mut writer = SceneWriter::new(&World::new()).unwrap();
    writer.keep("it", value).unwrap();
    let text = writer.to_json();
    assert_eq!(text.matches(old).count(), 1, "{old} in {text}");
    match read(&text.replace(old, new)).unwrap().get::<T>("it") {
        Ok(_) => "none".to_owned(),
        Err(error) => error.to_string(),
    }
}

#[test]
fn settings_that_no_sensor_has_are_refused() {
    let fibre = FibreOptic::new(7.7, 1e-3).unwrap();
    assert!(refusal(&fibre, "\"acceptance\": 7.7", "\"acceptance\": 97").contains("cone angle = 97"));
    let lens = ThinLensCamera::new((7, 3), 33.3, 0.07, 1.7).unwrap();
    assert!(refusal(&lens, "\"radius\": 0.07", "\"radius\": -1").contains("radius of the lens = -1"));
    assert!(refusal(&opencv(), "\"columns\": 4", "\"columns\": 0").contains("pixels across"));
    assert!(refusal(&vectors(), "\"columns\": 3", "\"columns\": 4").contains("origins: 6 values for 8"));
    let mesh = MeshPixel::new(&MeshData::cube(0.5).unwrap()).unwrap();
    assert!(
        refusal(&mesh, "\"surface_offset\": 0", "\"surface_offset\": -1").contains("surface offset = -1")
    );
    let aimed = Pixel::new(0.1, 0.2).unwrap().targets(targets(), 0.7).unwrap();
    assert!(refusal(&aimed, "\"Rectangle\"", "\"Ccd\"").contains("targeted_sensor"));
    assert!(refusal(&aimed, "\"target_count\": 4", "\"target_count\": 3").contains("target_3"));
    let ortho = OrthographicCamera::new((3, 2), 0.7).unwrap().etendue(1e-9).unwrap();
    assert!(refusal(&ortho, "\"etendue\"", "\"aperture\"").contains("aperture"));
}
