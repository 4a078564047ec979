use super::*;

fn read(bytes: &[u8]) -> Result<MeshData, String> {
    parse(bytes, 1.0).map_err(|fault| fault.in_file(Path::new("a.stl")).to_string())
}

/// Two triangles with a common edge; every coordinate is a 32-bit number.
fn sheet() -> MeshData {
    let corners =
        [[0.0, 0.0, 0.25], [1.5, 0.0, 0.0], [0.0, f64::from(0.1f32), 0.0], [1.0, 1.0, f64::from(-3e38f32)]];
    MeshData::new(corners, [[0, 1, 2], [2, 1, 3]]).unwrap()
}

const FACET: &str =
    "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0.1\nendloop\nendfacet\n";

#[test]
fn binary_files_give_back_every_bit() {
    let bytes = encode_binary(&sheet()).unwrap();
    assert_eq!(bytes.len(), 84 + 100);
    assert_eq!(read(&bytes).unwrap(), sheet());
    let mut solid = bytes.clone();
    solid[..16].copy_from_slice(b"solid facet \0 ok");
    assert_eq!(read(&solid).unwrap(), sheet());
    solid[12] = b' ';
    assert_eq!(read(&solid).unwrap(), sheet());
    let far = sheet().scaled(10.0).unwrap();
    assert!(encode_binary(&far).unwrap_err().contains("triangle 1"));
    assert_eq!(parse(&bytes, 0.5).unwrap().vertices()[1].x, 0.75);
}

#[test]
fn text_gives_back_every_bit() {
    let mesh =
        MeshData::new([[0.1, 1e300, -1e-310], [5e-324, 0.0, 1.0 / 3.0], [1.0; 3]], [[0, 1, 2]]).unwrap();
    assert_eq!(read(encode_text(&mesh).as_bytes()).unwrap(), mesh);
    assert_eq!(read(encode_text(&sheet()).as_bytes()).unwrap(), sheet());
}

#[test]
fn every_way_of_writing_text_is_read() {
    let one = read(format!("solid\n{FACET}endsolid").as_bytes()).unwrap();
    assert_eq!((one.triangle_count(), one.vertices()[2].z), (1, 0.1));
    let texts = [
        format!("solid a name of several facets\n{FACET}endsolid a name of several facets\n"),
        format!("solid {FACET}endsolid"),
        format!("solid facet\n{FACET}endsolid facet\n"),
        format!("  SOLID UP\n{}ENDSOLID UP", FACET.to_uppercase()),
        format!("solid x\r\n{}endsolid x\r\n\r\n", FACET.replace('\n', "\r\n")),
        format!("solid x\r{}endsolid x", FACET.replace('\n', "\r")),
        format!("\n\nsolid x\n{}\nendsolid\n\n", FACET.replace('\n', "\n\n \t")),
        format!("solid x\n{}endsolid", FACET.replace("0 0 1\n", "nan nan nan\n")),
        format!("\u{feff}solid x\n{FACET}endsolid"),
    ];
    for text in texts {
        assert_eq!(read(text.as_bytes()).as_ref(), Ok(&one), "{text:?}");
    }
    let two = format!("solid a\n{FACET}endsolid a\nsolid b\n{}endsolid b\n", FACET.replace("0 0 0", "1 1 1"));
    let two = read(two.as_bytes()).unwrap();
    assert_eq!((two.triangles(), two.vertex_count()), ([[0, 1, 2], [3, 1, 2]].as_slice(), 4));
    let quad = FACET.replace("vertex 0 1 0.1", "vertex 1 1 0\nvertex 0 1 0");
    assert_eq!(
        read(format!("solid\n{quad}endsolid").as_bytes()).unwrap().triangles(),
        [[0, 1, 2], [0, 2, 3]]
    );
}

#[test]
fn faults_of_texts_name_their_line() {
    let wrong = [
        ("solid x\n", "a.stl: line 2: the file ends where facet or endsolid should follow"),
        ("solid x\nendsolid x\n", "a.stl: the mesh has no triangle"),
        ("solid x\nfacet normal 0 0\nouter loop\n", "line 3: 'loop' where 'outer'"),
        ("solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0 inf\n", "line 4: a corner: inf is not finite"),
        ("solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0 a\n", "line 4: a corner: 'a' is no number"),
        (
            "solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nendloop\nendfacet\nendsolid",
            "line 2: a face of 1",
        ),
        ("solid x\nface", "line 2: 'face' where 'facet'"),
    ];
    for (text, expected) in wrong {
        let error = read(text.as_bytes()).unwrap_err();
        assert!(error.contains(expected), "{text:?}: {error}");
    }
    let more = format!("solid x\n{FACET}endsolid x\nrubbish\n");
    assert!(read(more.as_bytes()).unwrap_err().contains("line 10: 'rubbish' where 'solid'"));
}

#[test]
fn faults_of_binary_files_name_their_byte() {
    let bytes = encode_binary(&sheet()).unwrap();
    for count in [0, 1, 3, 1 << 31, u32::MAX] {
        let mut wrong = bytes.clone();
        wrong[80..84].copy_from_slice(&count.to_le_bytes());
        assert!(read(&wrong).unwrap_err().starts_with("a.stl: byte "), "{count}");
    }
    assert_eq!(
        read(&bytes[..183]).unwrap_err(),
        "a.stl: byte 84: 2 triangles of at least 50 bytes should follow, 99 bytes do"
    );
    assert!(read(&bytes[..83]).unwrap_err().contains("byte 83: neither"));
    assert!(read(b"").unwrap_err().contains("byte 0"));
    let mut wrong = bytes.clone();
    wrong[84 + 50 + 16..84 + 50 + 20].copy_from_slice(&f32::NAN.to_le_bytes());
    assert_eq!(read(&wrong).unwrap_err(), "a.stl: byte 150: a corner: NaN is not finite");
    // The normal of the file may be anything.
    let mut odd = bytes;
    odd[84..96].fill(0xff);
    assert_eq!(read(&odd).unwrap(), sheet());
    let mut none = vec![b' '; 84];
    none[80..].fill(0);
    assert_eq!(read(&none).unwrap_err(), "a.stl: the mesh has no triangle");
}
