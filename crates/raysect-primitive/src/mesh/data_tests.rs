use super::*;
use raysect_math::{rotate, translate};

/// The tetrahedron of the origin and the three unit points, fronts outward.
fn tetrahedron() -> MeshData {
    let corners = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    MeshData::new(corners, [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]]).unwrap()
}

fn axes(x: f64, y: f64, z: f64) -> AffineMatrix3D {
    AffineMatrix3D::from_axes(Vector3D::X * x, Vector3D::Y * y, Vector3D::Z * z, Point3D::ORIGIN)
}

#[test]
fn faults_are_named_by_their_element() {
    let corners = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    let error = MeshData::new(corners, [[0, 1, 2], [2, 1, 3]]).unwrap_err();
    assert_eq!(error.to_string(), "triangle 1 names vertex 3, there are 3 (counted from 0)");
    let none: [[u32; 3]; 0] = [];
    assert_eq!(MeshData::new(corners, none), Err(MeshError::Empty));
    for wrong in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let error = MeshData::new([[0.0; 3], [0.0, wrong, 0.0]], [[0, 1, 0]]).unwrap_err();
        assert!(matches!(error, MeshError::NotFinite { vertex: 1, .. }), "{error}");
    }
}

#[test]
fn normals_are_checked_and_made_units() {
    let up = [[0, 0, 0]; 4];
    let mesh = tetrahedron().with_normals([[0.0, 0.0, 1e-200]], up).unwrap();
    assert_eq!(mesh.vertex_normal(0), Some(Normal3D::new(0.0, 0.0, 1.0)));
    assert_eq!(mesh.corner_normals(3), Some([Normal3D::new(0.0, 0.0, 1.0); 3]));
    assert_eq!(mesh.without_normals().vertex_normals(), None);
    let error = tetrahedron().with_normals([[0.0; 3]], up).unwrap_err();
    assert!(matches!(error, MeshError::Normal { normal: 0, .. }));
    let error = tetrahedron().with_normals([[0.0, 1.0, 0.0]], [[0, 0, 0]; 3]).unwrap_err();
    assert_eq!(error, MeshError::NormalCount { triangles: 4, found: 3 });
    let indices = [[0, 0, 0], [0, 0, 0], [0, 1, 0], [0, 0, 0]];
    let error = tetrahedron().with_normals([[0.0, 1.0, 0.0]], indices).unwrap_err();
    assert_eq!(error, MeshError::NormalIndex { triangle: 2, index: 1, normals: 1 });
}

#[test]
fn elements_beyond_the_end_are_none() {
    let mesh = tetrahedron();
    assert_eq!((mesh.vertex(3), mesh.vertex(4)), (Some(Point3D::new(0.0, 0.0, 1.0)), None));
    assert_eq!((mesh.triangle(3), mesh.triangle(4)), (Some([2, 0, 3]), None));
    assert_eq!((mesh.vertex_normal(0), mesh.face_normal(4), mesh.triangle_area(4)), (None, None, 0.0));
}

#[test]
fn faces_have_normals_and_areas_at_every_size() {
    for scale in [1e-160, 1e-9, 1.0, 1e9, 1e150] {
        let mesh = tetrahedron().scaled(scale).unwrap();
        assert_eq!(mesh.face_normal(0), Some(Normal3D::new(0.0, 0.0, -1.0)));
        let third = 1.0 / 3f64.sqrt();
        let n = mesh.face_normal(2).unwrap();
        assert!((n.as_vector() - Vector3D::new(third, third, third)).length() < 1e-15);
        let unit = scale.powi(2);
        assert!((mesh.triangle_area(0) - 0.5 * unit).abs() <= 1e-15 * unit);
        assert!((mesh.triangle_area(2) - 0.75f64.sqrt() * unit).abs() <= 1e-15 * unit);
    }
    let wide = MeshData::new([[-1.7e308, 0.0, 0.0], [1.7e308, 0.0, 0.0], [0.0, 1.7e308, 0.0]], [[0, 1, 2]]);
    assert_eq!(wide.unwrap().face_normal(0), Some(Normal3D::new(0.0, 0.0, 1.0)));
}

#[test]
fn needles_keep_their_normal_whichever_corner_comes_first() {
    // Height 1e-10 above a base of 1, far from equilateral: the area is known exactly.
    let corners = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.25, 1e-10, 0.0]];
    for order in [[0, 1, 2], [1, 2, 0], [2, 0, 1]] {
        let mesh = MeshData::new(corners, [order]).unwrap();
        assert!((mesh.triangle_area(0) - 0.5e-10).abs() < 1e-25);
        assert_eq!(mesh.face_normal(0), Some(Normal3D::new(0.0, 0.0, 1.0)));
    }
}

#[test]
fn slivers_between_two_long_edges_keep_their_area() {
    // By exact arithmetic with the numbers as they are stored; the product of the long edges errs by 1e-8.
    let corners = [[0.0; 3], [0.3, 0.7, 0.1], [0.3 + 1e-9, 0.7 - 2e-9, 0.1 + 3e-9]];
    for order in [[0, 1, 2], [1, 2, 0], [2, 0, 1]] {
        let mesh = MeshData::new(corners, [order]).unwrap();
        assert!((mesh.triangle_area(0) / 1.380_217_383_864_442_2e-9 - 1.0).abs() < 1e-15);
        let n = mesh.face_normal(0).unwrap();
        let expected =
            Normal3D::new(0.833_202_085_131_247_2, -0.289_809_419_210_274_76, -0.470_940_320_921_818_2);
        assert!((n - expected).length() < 1e-15, "{:e}", (n - expected).length());
    }
}

#[test]
fn triangles_without_area_are_dropped_on_demand() {
    let corners = [[0.0, 0.0, 0.0], [1.0, 1.0, 1.0], [2.0, 2.0, 2.0], [0.0, 1.0, 0.0]];
    let mesh = MeshData::new(corners, [[0, 1, 2], [0, 1, 3], [3, 3, 1], [3, 3, 3]]).unwrap();
    let normals = mesh.with_normals([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]], [[0; 3], [1; 3], [0; 3], [0; 3]]);
    let (mesh, dropped) = normals.unwrap().without_degenerate().unwrap();
    assert_eq!((dropped, mesh.triangles()), (3, [[0, 1, 3]].as_slice()));
    assert_eq!(mesh.normal_indices(), Some([[1, 1, 1]].as_slice()));
    let line = MeshData::new(corners, [[0, 1, 2]]).unwrap();
    assert_eq!(line.without_degenerate(), Err(MeshError::Empty));
}

#[test]
fn boxes_hold_what_triangles_use() {
    let corners = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 2.0, 0.0], [9.0, 9.0, 9.0]];
    let image = MeshData::new(corners, [[0, 1, 2]]).unwrap().bounding_box();
    assert_eq!((image.lower, image.upper), (Point3D::ORIGIN, Point3D::new(1.0, 2.0, 0.0)));
}

#[test]
fn fronts_turn_with_the_mesh() {
    let normals = [[0.0, 0.0, -1.0], [0.0, -1.0, 0.0], [1.0, 1.0, 1.0], [-1.0, 0.0, 0.0]];
    let mesh = tetrahedron().with_normals(normals, [[0; 3], [1; 3], [2; 3], [3; 3]]).unwrap();
    let agree = |mesh: &MeshData| {
        let close = |t| mesh.face_normal(t).unwrap().dot(mesh.corner_normals(t).unwrap()[1]) > 1.0 - 1e-14;
        (0..4).all(close)
    };
    assert!(agree(&mesh));
    let flipped = mesh.clone().flipped();
    assert_eq!(flipped.face_normal(0), Some(Normal3D::new(0.0, 0.0, 1.0)));
    assert!(agree(&flipped));
    // A shear, a mirror image, and a mirror image whose determinant is no number.
    let shear =
        AffineMatrix3D::from_axes(Vector3D::X, Vector3D::new(3.0, 1.0, 0.0), Vector3D::Z, Point3D::ORIGIN);
    let moved = translate(1.0, 2.0, 3.0) * rotate(10.0, 20.0, 30.0) * shear;
    for m in [moved, axes(-1.0, 2.0, 3.0), axes(-1e-140, 1e-140, 1e-140)] {
        let image = mesh.clone().transformed(&m).unwrap();
        assert!(agree(&image), "{m:?}");
        let inside = m * Point3D::new(0.1, 0.1, 0.1);
        let outward =
            |t: usize| image.face_normal(t).unwrap().dot(inside.vector_to(image.corners(t)[0])) > 0.0;
        assert!((0..4).all(outward), "{m:?}");
    }
    assert!(matches!(mesh.clone().transformed(&axes(1.0, 0.0, 1.0)), Err(MeshError::Transform(_))));
    assert!(mesh.transformed(&translate(f64::MAX, 0.0, 0.0)).is_ok());
}

#[test]
fn impossible_scales_are_refused() {
    for factor in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert!(matches!(tetrahedron().scaled(factor), Err(MeshError::Transform(_))));
    }
    let big = tetrahedron().scaled(1e300).unwrap();
    assert!(matches!(big.scaled(1e10), Err(MeshError::NotFinite { vertex: 1, .. })));
}
