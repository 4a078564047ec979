use super::*;
use raysect_math::rotate;
use raysect_math::translate;
use raysect_primitive::{Cone as ConeShape, Cuboid, Cylinder, Sphere, Torus};

fn stretch(x: f64, y: f64, z: f64) -> AffineMatrix3D {
    AffineMatrix3D::from_axes(Vector3D::X * x, Vector3D::Y * y, Vector3D::Z * z, Point3D::ORIGIN)
}

/// The map of shapes: turned, moved and of another size.
fn place() -> AffineMatrix3D {
    translate(1.0, 2.0, 3.0) * rotate(20.0, 30.0, 40.0) * stretch(0.3, 0.3, 0.3)
}

fn shape(shape: impl Primitive) -> Target {
    let shape: Arc<dyn Primitive> = Arc::new(shape);
    Target::shape(&shape, place()).unwrap()
}

fn facet() -> Target {
    Target::triangle([Point3D::new(-0.3, 0.0, 2.0), Point3D::new(0.5, 0.1, 2.0), Point3D::new(0.0, 0.7, 2.0)])
        .unwrap()
}

fn flat() -> [Target; 4] {
    [
        Target::sphere(Point3D::new(1.0, 2.0, 3.0), 0.5).unwrap(),
        Target::rectangle(Point3D::new(1.0, 0.0, 2.0), [Vector3D::X, Vector3D::Y * 0.1]).unwrap(),
        Target::disk(Point3D::new(0.3, 0.0, 2.0), Vector3D::new(0.0, 0.1, 1.0), 0.4).unwrap(),
        facet(),
    ]
}

#[test]
fn directions_meet_the_target_and_have_a_density() {
    let mut rng = Rng::new(1);
    let bar = shape(Cuboid::centred(0.02, 0.05, 2.0).unwrap());
    let others = [
        shape(Sphere::new(1.0).unwrap()),
        shape(Cylinder::new(0.1, 3.0).unwrap()),
        shape(ConeShape::new(0.5, 0.1).unwrap()),
    ];
    for target in flat().into_iter().chain([bar]).chain(others) {
        for _ in 0..1000 {
            let d = target.sample(Point3D::ORIGIN, &mut rng).unwrap();
            assert!((d.length() - 1.0).abs() < 1e-14);
            assert!(target.pdf(Point3D::ORIGIN, d).unwrap() > 0.0, "{target:?}");
            assert_eq!(target.pdf(Point3D::ORIGIN, -d), Some(0.0), "{target:?}");
        }
    }
    for target in flat() {
        assert_eq!(Target::from_numbers(&target.numbers()).unwrap(), target);
    }
}

#[test]
fn from_inside_and_in_the_plane_of_what_is_flat_nothing_is_aimed_at() {
    let [ball, port, window, facet] = flat();
    let unseen = |target: &Target, x, y, z| {
        let from = Point3D::new(x, y, z);
        let drawn = target.sample(from, &mut Rng::new(1)).is_some();
        assert_eq!(drawn, target.pdf(from, Vector3D::X).is_some(), "{target:?}");
        !drawn
    };
    assert!(unseen(&ball, 1.0, 2.1, 3.0) && unseen(&port, 0.0, 5.0, 2.0) && unseen(&window, 5.0, 0.0, 2.0));
    assert!(unseen(&facet, 5.0, 0.0, 2.0) && !unseen(&facet, 5.0, 0.0, 2.1));
    let cube: Arc<dyn Primitive> = Arc::new(Cuboid::centred(2.0, 2.0, 2.0).unwrap());
    let cube = Target::shape(&cube, AffineMatrix3D::IDENTITY).unwrap();
    assert!(unseen(&cube, 0.9, 0.9, 0.9) && !unseen(&cube, 1.1, 0.9, 0.9));
    let sheet: Arc<dyn Primitive> = Arc::new(Cuboid::centred(2.0, 2.0, 0.0).unwrap());
    let sheet = Target::shape(&sheet, AffineMatrix3D::IDENTITY).unwrap();
    assert!(unseen(&sheet, 3.0, 0.0, 0.0) && !unseen(&sheet, 3.0, 0.0, 0.1));
}

#[test]
fn what_cannot_be_sampled_exactly_is_aimed_at_by_its_bounding_sphere() {
    let is_sphere = |target: Target| matches!(target, Target(Kind::Sphere { .. }));
    let bar: Arc<dyn Primitive> = Arc::new(Cuboid::centred(0.02, 0.05, 2.0).unwrap());
    assert!(!is_sphere(Target::shape(&bar, place()).unwrap()));
    let stretched = stretch(1.0, 1.0, 2.0);
    assert!(is_sphere(Target::shape(&bar, stretched).unwrap()));
    assert!(is_sphere(shape(Torus::new(1.0, 0.2).unwrap())));
}

#[test]
fn impossible_targets_are_refused() {
    assert!(Target::sphere(Point3D::ORIGIN, 0.0).is_err());
    assert!(Target::sphere(Point3D::new(f64::NAN, 0.0, 0.0), 1.0).is_err());
    assert!(Target::disk(Point3D::ORIGIN, Vector3D::ZERO, 1.0).is_err());
    assert!(Target::disk(Point3D::ORIGIN, Vector3D::Z, 0.0).is_err());
    for edges in [
        [Vector3D::X, Vector3D::X],
        [Vector3D::X, Vector3D::ZERO],
        [Vector3D::X, Vector3D::new(1.0, 1.0, 0.0)],
    ] {
        assert!(Target::rectangle(Point3D::ORIGIN, edges).is_err());
    }
    assert!(Target::from_numbers(&[1.0; 5]).is_err());
}
