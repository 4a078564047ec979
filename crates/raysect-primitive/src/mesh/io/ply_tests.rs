use super::*;

fn read(bytes: impl AsRef<[u8]>) -> Result<MeshData, String> {
    parse(bytes.as_ref(), 1.0).map_err(|fault| fault.in_file(Path::new("a.ply")).to_string())
}

fn sheet() -> MeshData {
    let corners = [[0.0, 0.0, 0.25], [1.5, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 1.0, -3.0]];
    MeshData::new(corners, [[0, 1, 2], [2, 1, 3]]).unwrap()
}

const HEADER: &str = "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n\
                      element face 2\nproperty list uchar int vertex_indices\nend_header\n";
const ROWS: &str = "0 0 0.25\n1.5 0 0\n0 1 0\n1 1 -3\n3 0 1 2\n3 2 1 3\n";

#[test]
fn both_forms_give_back_every_bit() {
    let odd =
        MeshData::new([[0.1, 1e300, -1e-310], [5e-324, 0.0, 1.0 / 3.0], [1.0; 3]], [[0, 1, 2]]).unwrap();
    for mesh in [sheet(), odd] {
        for encoding in [MeshEncoding::Ascii, MeshEncoding::Binary] {
            assert_eq!(read(encode::encode(&mesh, encoding).unwrap()).as_ref(), Ok(&mesh));
        }
    }
    let binary = encode::encode(&sheet(), MeshEncoding::Binary).unwrap();
    assert!(String::from_utf8_lossy(&binary).contains("property float z"));
    assert_eq!(parse(&binary, 2.0).unwrap().vertices()[1].x, 3.0);
}

#[test]
fn normals_are_kept_with_their_corners() {
    let up = [[0.0, 0.0, 1.0], [0.0, 1.0, 0.0]];
    // One vertex with two normals, one without triangle.
    let mesh = MeshData::new([[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [7.0; 3]], [[0, 1, 2], [2, 1, 0]]);
    let mesh = mesh.unwrap().with_normals(up, [[0, 0, 1], [1, 1, 0]]).unwrap();
    for encoding in [MeshEncoding::Ascii, MeshEncoding::Binary] {
        let again = read(encode::encode(&mesh, encoding).unwrap()).unwrap();
        assert_eq!(again.vertex_count(), 5);
        for t in 0..2 {
            assert_eq!(again.corners(t), mesh.corners(t));
            assert_eq!(again.corner_normals(t), mesh.corner_normals(t));
        }
    }
}

#[test]
fn texts_of_every_make_are_read() {
    let sheet = sheet();
    let texts = [
        format!("{HEADER}{ROWS}"),
        format!("{HEADER}{}", ROWS.trim_end()),
        format!("{HEADER}{ROWS}\n \n"),
        format!("{HEADER}{ROWS}").replace('\n', "\r\n"),
        format!("{HEADER}{ROWS}").replace('\n', "\r"),
        format!("{HEADER}{}", ROWS.replace(' ', "\n")),
        format!(
            "{}{ROWS}",
            HEADER.replace(
                "element vertex",
                "comment made by hand\nobj_info x\n\nCreated by Blender3D 247\nelement vertex"
            )
        ),
        format!("{}{ROWS}", HEADER.replace("vertex_indices", "vertex_index").replace("float", "float64")),
    ];
    for text in texts {
        assert_eq!(read(&text).as_ref(), Ok(&sheet), "{text:?}");
    }
    let rich = "ply\nformat ascii 1.0\nelement camera 1\nproperty list uint8 double view\nelement vertex 4\n\
                property uchar red\nproperty double z\nproperty double y\nproperty list uchar int tags\n\
                property int x\nproperty float nx\nproperty float ny\nproperty float nz\nelement nothing 99999999999\n\
                element face 1\nproperty float quality\nproperty list uint uint vertex_indices\n\
                property list uchar float texcoord\nelement edge 1\nproperty int vertex1\nproperty int vertex2\n\
                end_header\n2 nan 1\n255 0 0 0 0 0 0 2\n0 0 0 1 7 1 0 0 2\n9 0 1 0 1 0 0 2\n8 0 1 2 1 2 0 0 0 0\n\
                0.5 4 0 1 2 3 2 0.1 0.2\n0 1\n";
    let mesh = read(rich).unwrap();
    assert_eq!(mesh.triangles().len(), 2);
    assert_eq!(mesh.vertices()[2].to_array(), [1.0, 1.0, 0.0]);
    assert!(mesh.corner_normals(1).unwrap().iter().all(|n| n.z == 1.0));
}

#[test]
fn strips_turn_every_second_triangle() {
    let strip = HEADER.replace("element face 2", "element tristrips 1");
    let mesh = read(format!("{strip}0 0 0\n1 0 0\n0 1 0\n1 1 0\n9 0 1 2 3 -1 1 3 2 -1\n")).unwrap();
    assert_eq!(mesh.triangles(), [[0, 1, 2], [2, 1, 3], [1, 3, 2]]);
    assert!((0..3).all(|t| mesh.face_normal(t).unwrap().z == 1.0));
}

/// A file of the given byte order with mixed types, by hand.
fn binary(order: &str, put: fn(&mut Vec<u8>, &[u8])) -> Vec<u8> {
    let mut bytes = format!(
        "ply\r\nformat binary_{order}_endian 1.0\r\nelement vertex 4\r\nproperty double x\r\nproperty short y\r\n\
         property uchar red\r\nproperty float z\r\nelement face 2\r\nproperty list ushort uint vertex_index\r\n\
         property char mark\r\nend_header\r\n"
    )
    .into_bytes();
    for p in sheet().vertices() {
        put(&mut bytes, &p.x.to_le_bytes());
        put(&mut bytes, &(p.y as i16).to_le_bytes());
        bytes.push(10);
        put(&mut bytes, &(p.z as f32).to_le_bytes());
    }
    for t in sheet().triangles() {
        put(&mut bytes, &3u16.to_le_bytes());
        t.iter().for_each(|v| put(&mut bytes, &v.to_le_bytes()));
        bytes.push(10);
    }
    bytes
}

#[test]
fn both_byte_orders_are_read() {
    let little = binary("little", |bytes, word| bytes.extend(word));
    let big = binary("big", |bytes, word| bytes.extend(word.iter().rev()));
    assert_eq!(read(&little), Ok(sheet()));
    assert_eq!(read(&big), Ok(sheet()));
    assert_ne!(little, big);
    // The wrong order is noticed.
    let swapped = binary("little", |bytes, word| bytes.extend(word.iter().rev()));
    assert!(read(swapped).is_err());
}

#[test]
fn faults_name_their_line_or_byte() {
    let wrong = [
        ("plx\n".to_owned(), "a.ply: line 1: not a PLY file"),
        (String::new(), "line 1: not a PLY file"),
        ("ply\nformat ascii 1.0\n".to_owned(), "line 2: the header has no end"),
        ("ply\nend_header\n".to_owned(), "line 2: the header names no format"),
        (HEADER.replace("ascii 1.0", "ascii 2.0"), "line 2: 'format' does not begin"),
        (HEADER.replace("ascii", "morse"), "the format 'morse' is not known"),
        (HEADER.replace("property float y", "property string y"), "line 5: the type 'string' is not known"),
        (HEADER.replace("property float y\n", ""), "line 3: the vertices have no properties x, y and z"),
        (HEADER.replace("vertex_indices", "corners"), "line 3: 4 rows of 'vertex' do not fit 0 bytes"),
        (format!("{}{ROWS}", HEADER.replace("vertex_indices", "corners")), "line 7: the faces have no list"),
        (HEADER.replace("list uchar", "list float"), "line 8: the list 'vertex_indices' has a length"),
        (HEADER.replace("element vertex 4\n", ""), "line 3: a property before the first element"),
        (HEADER.replace("vertex 4", "vertex -4"), "line 3: the number of rows: '-4'"),
        (format!("{HEADER}{}", ROWS.replace("1.5 0 0", "1.5 nan 0")), "line 11: a vertex with (1.5, NaN, 0)"),
        (format!("{HEADER}{}", ROWS.replace("1.5 0 0", "1.5 x 0")), "line 11: a property of a vertex: 'x'"),
        (
            format!("{HEADER}{}", ROWS.replace("3 2 1 3", "3 2 1 4")),
            "line 15: vertex 4 is named, there are 4",
        ),
        (format!("{HEADER}{}", ROWS.replace("3 2 1 3", "3 2 1 -1")), "line 15: -1 is no vertex"),
        (format!("{HEADER}{}", ROWS.replace("3 2 1 3", "3 2 1 0.5")), "line 15: 0.5 is no vertex"),
        (format!("{HEADER}{}", ROWS.replace("3 2 1 3", "2 2 1")), "line 15: a face of 2 corners"),
        (format!("{HEADER}{}", ROWS.replace("3 2 1 3", "4 2 1 3")), "the file ends where an item of a list"),
        (format!("{HEADER}{}", ROWS.replace("3 2 1 3", "nan 2 1 3")), "line 15: NaN is no length"),
        (format!("{HEADER}{ROWS}5\n"), "line 16: more follows"),
        (
            HEADER.replace("face 2", "face 0").replace("vertex 4", "vertex 0"),
            "a.ply: the mesh has no triangle",
        ),
    ];
    for (text, expected) in wrong {
        let error = read(&text).map(|_| ()).unwrap_err();
        assert!(error.contains(expected), "{text:?}: {error}");
    }
    let bytes = encode::encode(&sheet(), MeshEncoding::Binary).unwrap();
    let start = bytes.len() - 4 * 12 - 2 * 13;
    let mut nan = bytes.clone();
    nan[start + 16..start + 20].copy_from_slice(&f32::NAN.to_le_bytes());
    assert!(read(&nan).unwrap_err().contains(&format!("byte {}: a vertex with (1.5, NaN, 0)", start + 24)));
    let mut beyond = bytes.clone();
    beyond[bytes.len() - 4] = 9;
    assert!(read(&beyond).unwrap_err().contains(&format!("byte {}: vertex 9 is named", bytes.len() - 13)));
    let more = [bytes.as_slice(), b"\n\0"].concat();
    assert!(read(&more).unwrap_err().contains(&format!("byte {}: 2 bytes follow", bytes.len())));
}

#[test]
fn declared_sizes_are_not_believed() {
    for count in
        ["2147483648", "4294967295", "9223372036854775808", "18446744073709551615", "99999999999999999999"]
    {
        for element in ["vertex 4", "face 2"] {
            for encoding in ["ascii", "binary_little_endian"] {
                let name = element.split(' ').next().unwrap();
                let text = format!("{HEADER}{ROWS}").replace(element, &format!("{name} {count}"));
                assert!(read(text.replace("ascii", encoding)).is_err());
            }
        }
    }
    let list = HEADER.replace("face 2", "face 1").replace("list uchar", "list uint");
    assert!(read(format!("{list}{}4294967295 0 1", &ROWS[..ROWS.len() - 16])).is_err());
}
