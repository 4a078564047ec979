use super::*;
use raysect_math::Point3D;

fn read(text: &str) -> Result<MeshData, String> {
    parse(text.as_bytes(), 1.0).map_err(|fault| fault.in_file(Path::new("a.obj")).to_string())
}

const SQUARE: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

#[test]
fn every_way_of_naming_corners_is_read() {
    let faces = [
        "f 1 2 3",
        "f 1/1 2/1 3/1",
        "f 1/ 2/ 3/",
        "f -4 -3 -2",
        "f  1\t2   3 ",
        "f 1 \\\n 2 \\\r\n3",
        "fo 1 2 3",
    ];
    for face in faces {
        let mesh = read(&format!("{SQUARE}vt 0 0\n{face}\n")).unwrap();
        assert_eq!((mesh.triangles(), mesh.vertex_normals()), ([[0, 1, 2]].as_slice(), None), "{face}");
    }
    for face in ["f 1//2 2//1 3//2", "f 1/1/2 2/1/1 3/1/2", "f -4//-1 -3//-2 -2//-1"] {
        let mesh = read(&format!("{SQUARE}vt 0 0\nvn 0 0 5\nvn 0 3 4\n{face}\n")).unwrap();
        assert_eq!(mesh.normal_indices(), Some([[1, 0, 1]].as_slice()), "{face}");
        let n = mesh.vertex_normal(1).unwrap();
        assert!(n.x == 0.0 && (n.y - 0.6).abs() <= f64::EPSILON && (n.z - 0.8).abs() <= f64::EPSILON);
    }
}

#[test]
fn the_odd_lines_of_real_files_are_read() {
    let text = "# made by hand\r\nmtllib a.mtl\r\no thing \u{e9}\r\n\r\n  v 0 0 0 1.0\r\nv 1 0 0 0.1 0.2 0.3\r\n\
                v\t0  1e0 -0.0 # last\r\ng side one\r\nusemtl red\r\ns off\r\nl 1 2\r\np 1\r\nbevel on\r\nf 1 2 3";
    let mesh = read(text).unwrap();
    assert_eq!(mesh.vertices()[2], Point3D::new(0.0, 1.0, 0.0));
    assert_eq!(mesh.triangles(), [[0, 1, 2]]);
    let mut latin = b"o caf\xe9\n".to_vec();
    latin.extend(format!("{SQUARE}f 1 2 3\n").bytes());
    assert!(parse(&latin, 1.0).is_ok());
    // Groups share their vertices, and faces may come first.
    let groups = format!("f 1 2 3\n{SQUARE}g two\nf 1 3 4\n");
    assert_eq!(read(&groups).unwrap().triangles(), [[0, 1, 2], [0, 2, 3]]);
}

#[test]
fn polygons_become_triangles() {
    let quad = read(&format!("{SQUARE}vn 0 0 1\nf 1//1 2//1 3//1 4//1\n")).unwrap();
    assert_eq!(quad.triangles(), [[0, 1, 2], [0, 2, 3]]);
    assert_eq!(quad.normal_indices(), Some([[0; 3]; 2].as_slice()));
    // An arrowhead, whose fan from the first corner would cover the outside.
    let arrow = read("v 2 0 0\nv 0 2 0\nv 0.4 0.4 0\nv 0 0.1 0\nf 2 3 4 1\n").unwrap();
    // By the shoelace formula: half of 4 + 0 − 0.8 + 0.04 + 0 − 0.2.
    let area: f64 = (0..2).map(|t| arrow.triangle_area(t)).sum();
    assert!((area - 1.52).abs() < 1e-15, "{area}");
    assert!((0..2).all(|t| arrow.face_normal(t).unwrap().z == 1.0));
    // Corners that are named twice running.
    assert_eq!(read(&format!("{SQUARE}f 1 2 2 3 3 1\n")).unwrap().triangles(), [[0, 1, 2]]);
    assert_eq!(read(&format!("{SQUARE}f 1 1 2\n")).unwrap().triangles(), [[0, 0, 1]]);
}

#[test]
fn faces_without_normals_get_their_own() {
    let mesh =
        read(&format!("{SQUARE}vn 0 1 1\nvn 0 0 0\nf 1//1 2//1 3//1\nf 1 3 4\nf 1//2 2//1 4//2\n")).unwrap();
    let up = raysect_math::Normal3D::new(0.0, 0.0, 1.0);
    assert_eq!(mesh.corner_normals(1), Some([up; 3]));
    let [first, second, third] = mesh.corner_normals(2).unwrap();
    assert_eq!((first, third), (up, up));
    assert!((second.y - second.z).abs() < 1e-16 && second.y > 0.7);
    assert_eq!(read(&format!("{SQUARE}vn 0 0 0\nf 1//1 2//1 3//1\n")).unwrap().vertex_normals(), None);
    assert_eq!(read(&format!("{SQUARE}vn 0 0 1\nf 1 2 3\n")).unwrap().vertex_normals(), None);
}

#[test]
fn faults_name_their_line() {
    let wrong = [
        ("v 0 0\n", "a.obj: line 1: three coordinates of a vertex are needed, 2 follow"),
        ("v 0 0 nan\n", "a.obj: line 1: coordinates of a vertex: nan is not finite"),
        ("v 0 0 -inf\n", "line 1: "),
        ("v 0 0 1e400\n", "line 1: "),
        ("v 0 0 zero\n", "line 1: coordinates of a vertex: 'zero' is no number"),
        ("v 0 0 0\nvn 0 0 NaN\n", "line 2: "),
        ("f 1 2 3\n", "line 1: vertex 0 is named, there are 0"),
        ("v 0 0 0\n\nf 1 0 1\n", "line 3: vertex 0 is named after 1 of them"),
        ("v 0 0 0\nf 1 -2 1\n", "line 2: vertex -2 is named after 1 of them"),
        ("v 0 0 0\nf 1 1 2\n", "line 2: vertex 1 is named, there are 1 (counted from 0)"),
        ("v 0 0 0\nf 1//1 1//1 1//1\n", "line 2: normal 0 is named, there are 0"),
        ("v 0 0 0\nf 1 1 4294967296\n", "line 2: vertex 4294967296"),
        (
            "v 0 0 0\nf 1 1 99999999999999999999\n",
            "line 2: vertex: '99999999999999999999' is no such integer",
        ),
        ("v 0 0 0\nf 1 1 1/1/1/1\n", "line 2: the corner '1/1/1/1' has more than three parts"),
        ("v 0 0 0\nf 1 1\n", "line 2: a face of 2 corners: at least 3 are needed"),
        ("v 0 0 0\nf 1 \\\n1 x\n", "line 3: "),
        ("surf 0 1 0 1 1 2 3 4\n", "line 1: free-form surfaces"),
        ("\nDear Sir,\nf \n", "line 3: a face of 0 corners"),
        ("\nDear Sir,\n", "line 2: 'Dear' is no keyword of OBJ"),
        ("v 0 0 0\n", "a.obj: the mesh has no triangle"),
        ("", "a.obj: the mesh has no triangle"),
    ];
    for (text, expected) in wrong {
        let error = read(text).unwrap_err();
        assert!(error.contains(expected), "{text:?}: {error}");
    }
}

#[test]
fn text_gives_back_every_bit() {
    let corners =
        [[0.1, 1.0 / 3.0, -1e-310], [1e300, -2.5e-7, f64::MAX], [5e-324, 1.0, 123_456_789.123_456_79]];
    let mesh = MeshData::new(corners, [[0, 1, 2], [2, 1, 0]]).unwrap();
    let normals = [[0.1, 0.2, 0.3], [-1.0, 0.7, 0.0]];
    let smooth = mesh.clone().with_normals(normals, [[0, 1, 1], [1, 0, 1]]).unwrap();
    assert_eq!(read(&encode(&mesh)).unwrap(), mesh);
    let again = read(&encode(&smooth)).unwrap();
    assert_eq!((again.vertices(), again.normal_indices()), (smooth.vertices(), smooth.normal_indices()));
    for (a, b) in again.vertex_normals().unwrap().iter().zip(smooth.vertex_normals().unwrap()) {
        assert!((a.as_vector() - b.as_vector()).length() <= 2.0 * f64::EPSILON);
    }
}

#[test]
fn scaling_acts_on_coordinates_alone() {
    let text = format!("{SQUARE}vn 0 0 1\nf 1//1 2//1 3//1\n");
    let mesh = parse(text.as_bytes(), 0.001).unwrap();
    assert_eq!(mesh.vertices()[2], Point3D::new(0.001, 0.001, 0.0));
    assert_eq!(mesh.vertex_normal(0).unwrap().z, 1.0);
    for scaling in [0.0, -1.0, f64::NAN] {
        assert!(matches!(parse(text.as_bytes(), scaling), Err(Fault::Mesh(MeshError::Transform(_)))));
    }
}
