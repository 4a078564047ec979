use super::*;

type Vtk = (MeshData, Vec<TriangleScalars>);

fn read(bytes: impl AsRef<[u8]>) -> Result<Vtk, String> {
    parse(bytes.as_ref(), 1.0).map_err(|fault| fault.in_file(Path::new("a.vtk")).to_string())
}

fn sheet() -> MeshData {
    let corners = [[0.0, 0.0, 0.25], [1.5, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 1.0, -3.0]];
    MeshData::new(corners, [[0, 1, 2], [2, 1, 3]]).unwrap()
}

fn named(name: &str, values: &[f64]) -> TriangleScalars {
    TriangleScalars { name: name.into(), values: values.to_vec() }
}

const HEAD: &str = "# vtk DataFile Version 3.0\na title\nASCII\nDATASET POLYDATA\n";
const POINTS: &str = "POINTS 4 float\n0 0 0.25 1.5 0 0\n0 1 0 1 1 -3\n";

#[test]
fn both_forms_give_back_every_bit() {
    let odd =
        MeshData::new([[0.1, 1e300, -1e-310], [5e-324, 0.0, 1.0 / 3.0], [1.0; 3]], [[0, 1, 2]]).unwrap();
    let one = [named("1/3 of %", &[1.0 / 3.0])];
    let two = [named("power density", &[f64::MAX, -0.1]), named("é", &[f64::INFINITY, 0.0])];
    for encoding in [MeshEncoding::Ascii, MeshEncoding::Binary] {
        assert_eq!(read(encode::encode(&odd, &one, encoding).unwrap()), Ok((odd.clone(), one.to_vec())));
        assert_eq!(read(encode::encode(&sheet(), &two, encoding).unwrap()), Ok((sheet(), two.to_vec())));
        assert_eq!(read(encode::encode(&sheet(), &[], encoding).unwrap()), Ok((sheet(), vec![])));
        let nan = encode::encode(&odd, &[named("n", &[f64::NAN])], encoding).unwrap();
        assert!(read(nan).unwrap().1[0].values[0].is_nan());
    }
    assert!(encode::encode(&odd, &[named("", &[1.0])], MeshEncoding::Ascii).is_err());
    let error = export_vtk("never.vtk", &odd, &two, MeshEncoding::Ascii).unwrap_err();
    assert_eq!(error, MeshError::ScalarCount { name: "power density".into(), triangles: 1, found: 2 });
}

#[test]
fn normals_are_kept_with_their_corners() {
    let up = [[0.0, 0.0, 1.0], [0.0, 1.0, 0.0]];
    let mesh = sheet().with_normals(up, [[0, 0, 1], [1, 1, 0]]).unwrap();
    for encoding in [MeshEncoding::Ascii, MeshEncoding::Binary] {
        let (again, _) = read(encode::encode(&mesh, &[], encoding).unwrap()).unwrap();
        for t in 0..2 {
            assert_eq!(again.corners(t), mesh.corners(t));
            assert_eq!(again.corner_normals(t), mesh.corner_normals(t));
        }
    }
}

#[test]
fn polygonal_data_of_every_make_is_read() {
    let expected = Ok((sheet(), vec![]));
    let texts = [
        format!("{HEAD}{POINTS}POLYGONS 2 8\n3 0 1 2\n3 2 1 3\n"),
        format!("{HEAD}{POINTS}POLYGONS 2 8\n3 0 1 2 3 2 1 3"),
        format!("{HEAD}{POINTS}TRIANGLE_STRIPS 1 5\n4 0 1 2 3\n"),
        format!("{HEAD}{POINTS}VERTICES 1 2\n1 0\nLINES 1 3\n2 0 1\nPOLYGONS 2 8\n3 0 1 2\n3 2 1 3\n"),
        format!("{HEAD}{POINTS}METADATA\nINFORMATION 1\nNAME x LOCATION y\nDATA 2 0 1\n\nPOLYGONS 2 8 3 0 1 2 3 2 1 3")
            .replace("8 3", "8\n3"),
        format!("{HEAD}{POINTS}POLYGONS 2 8\n3 0 1 2\n3 2 1 3\n").replace('\n', "\r\n"),
        format!("{HEAD}FIELD FieldData 1\nTIME 1 1 double\n0.5\n{POINTS}POLYGONS 2 8\n3 0 1 2\n3 2 1 3\n"),
        format!("{HEAD}{}POLYGONS 2 8\n3 0 1 2\n3 2 1 3\n", POINTS.replace("float", "double")),
        format!("{}{POINTS}POLYGONS 2 8\n3 0 1 2\n3 2 1 3\n", HEAD.replace("Version 3.0", "Version 1.0")),
        format!("{}{POINTS}polygons 2 8\n3 0 1 2\n3 2 1 3\n", HEAD.to_lowercase()),
        format!(
            "{}{POINTS}LINES 0 0\nPOLYGONS 3 6\nOFFSETS vtktypeint64\n0 3 6 \nCONNECTIVITY vtktypeint64\n0 1 2 2 1\n3\n",
            HEAD.replace("3.0", "5.1")
        ),
    ];
    for text in texts {
        assert_eq!(read(&text), expected, "{text}");
    }
    let whole =
        format!("{HEAD}{}POLYGONS 1 5\n4 0 1 3 2\n", POINTS.replace("float", "int").replace("0.25", "0"));
    let whole = whole.replace("1.5", "1").replace("-3", "0");
    assert_eq!(read(whole).unwrap().0.triangles(), [[0, 1, 3], [0, 3, 2]]);
}

#[test]
fn grids_of_many_kinds_are_read() {
    let grid = HEAD.replace("POLYDATA", "UNSTRUCTURED_GRID");
    let cells = "CELLS 6 25\n1 0\n3 0 1 2\n4 0 1 3 2\n4 0 1 2 3\n4 0 1 2 3\n3 2 1 3\n";
    let kinds = "CELL_TYPES 6\n1\n5\n9\n8\n6\n7\n";
    let data = "CELL_DATA 6\nSCALARS a FLOAT\nLOOKUP_TABLE default\n0 1 2 3 4 5\n";
    let text = format!("{grid}{POINTS}{cells}{kinds}{data}");
    let (mesh, scalars) = read(text).unwrap();
    let expected = [[0, 1, 2], [0, 1, 3], [0, 3, 2], [0, 1, 3], [0, 3, 2], [0, 1, 2], [2, 1, 3], [2, 1, 3]];
    assert_eq!(mesh.triangles(), expected);
    assert_eq!(scalars, [named("a", &[1.0, 2.0, 2.0, 3.0, 3.0, 4.0, 4.0, 5.0])]);
    let voxel = format!("{grid}{POINTS}CELLS 1 9\n8 0 1 2 3 0 1 2 3\nCELL_TYPES 1\n11\n");
    assert!(read(voxel).unwrap_err().contains("line 9: a cell of kind 11, a voxel"));
}

#[test]
fn cells_have_several_arrays() {
    let data = "CELL_DATA 3\nSCALARS a double\nLOOKUP_TABLE mine\n1 2 3\nLOOKUP_TABLE mine 2\n0 0 0 1 1 1 1 1\n\
                SCALARS bare int 1\n7 8 nan\nVECTORS v float\n1 2 3 4 5 6 7 8 9\nSCALARS pair float 2\n\
                LOOKUP_TABLE default\n1 2 3 4 5 6\nCOLOR_SCALARS c 3\n0 0 0 1 1 1 0 0 0\nTENSORS t float\n\
                1 0 0 0 1 0 0 0 1\n1 0 0 0 1 0 0 0 1\n1 0 0 0 1 0 0 0 1\nMETADATA\nCOMPONENT_NAMES\nXX\n\n\
                FIELD FieldData 3\nheat%20load 1 3 double\n0.1 0.2 0.3\nMETADATA\nINFORMATION 0\n\npair 2 3 int\n\
                1 2 3 4 5 6\nother 1 1 float\n5\nGLOBAL_IDS ids vtkIdType\n10 11 12\n\
                POINT_DATA 4\nSCALARS p float\nLOOKUP_TABLE default\n1 2 3 4\nNORMALS n float\n\
                0 0 1 0 0 1 0 0 1 0 0 2\nTEXTURE_COORDINATES t 2 float\n0 0 0 0 0 0 0 0\n";
    let text = format!("{HEAD}{POINTS}LINES 1 3\n2 0 1\nPOLYGONS 2 8\n3 0 1 2\n3 2 1 3\n{data}");
    let (mesh, scalars) = read(text).unwrap();
    let names: Vec<&str> = scalars.iter().map(|s| s.name.as_str()).collect();
    assert_eq!(names, ["a", "bare", "heat load", "ids"]);
    // The line comes first.
    assert_eq!(scalars[0].values, [2.0, 3.0]);
    assert!(scalars[1].values[0] == 8.0 && scalars[1].values[1].is_nan());
    assert_eq!(scalars[2].values, [0.2, 0.3]);
    assert_eq!(mesh.corner_normals(1).unwrap()[2].to_array(), [0.0, 0.0, 1.0]);
}

#[test]
fn cells_of_many_triangles_do_not_multiply_their_values_without_limit() {
    let strip = |arrays: usize| {
        let corners: String = (0..4000).map(|k| format!(" {k}")).collect();
        let points = "0 0 0\n".repeat(4000);
        let scalars = "SCALARS a int\n0\n".repeat(arrays);
        read(format!(
            "{HEAD}POINTS 4000 int\n{points}TRIANGLE_STRIPS 1 4001\n4000{corners}\nCELL_DATA 1\n{scalars}"
        ))
    };
    assert_eq!(strip(100).unwrap().1[99].values.len(), 3998);
    assert!(strip(2000).unwrap_err().contains("7996000 values"));
}

/// A binary file of version 2 or 5, by hand.
fn binary(has_offsets: bool) -> Vec<u8> {
    let version = if has_offsets { "5.1" } else { "2.0" };
    let mut bytes = format!("# vtk DataFile Version {version}\n\nBINARY\nDATASET POLYDATA\nPOINTS 4 short\n")
        .into_bytes();
    for p in [[0i16, 0, 10], [1, 0, 0], [0, 1, 0], [1, 1, -3]] {
        bytes.extend(p.iter().flat_map(|x| x.to_be_bytes()));
    }
    if has_offsets {
        bytes.extend(b"\nPOLYGONS 3 6\nOFFSETS vtktypeint64\n");
        bytes.extend([0i64, 3, 6].iter().flat_map(|x| x.to_be_bytes()));
        bytes.extend(b"\nCONNECTIVITY vtktypeint64\n");
        bytes.extend([0i64, 1, 2, 2, 1, 3].iter().flat_map(|x| x.to_be_bytes()));
    } else {
        bytes.extend(b"\nPOLYGONS 2 8\n");
        bytes.extend([3i32, 0, 1, 2, 3, 2, 1, 3].iter().flat_map(|x| x.to_be_bytes()));
    }
    bytes.extend(
        b"\nCELL_DATA 2\nSCALARS mark bit\nLOOKUP_TABLE default\n\x40\nSCALARS code unsigned_short\n",
    );
    bytes.extend(b"\x0a\x0a\x01\x00\nFIELD F 2\nx 1 2 double\n");
    bytes.extend([0.5f64, 0.1].iter().flat_map(|x| x.to_be_bytes()));
    bytes.extend(b"\nMETADATA\nINFORMATION 0\n\ny 1 2 char\n\xff\x0a\n");
    bytes
}

#[test]
fn binary_files_of_every_make_are_read() {
    let corners = [[0.0, 0.0, 10.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 1.0, -3.0]];
    let mesh = MeshData::new(corners, [[0, 1, 2], [2, 1, 3]]).unwrap();
    let scalars = vec![
        named("mark", &[0.0, 1.0]),
        named("code", &[2570.0, 256.0]),
        named("x", &[0.5, 0.1]),
        named("y", &[-1.0, 10.0]),
    ];
    for has_offsets in [false, true] {
        assert_eq!(read(binary(has_offsets)), Ok((mesh.clone(), scalars.clone())), "{has_offsets}");
    }
}

#[test]
fn faults_name_their_line() {
    let body = format!("{HEAD}{POINTS}POLYGONS 2 8\n3 0 1 2\n3 2 1 3\n");
    let grid = HEAD.replace("POLYDATA", "UNSTRUCTURED_GRID");
    let wrong = [
        (String::new(), "a.vtk: line 1: not a legacy VTK file"),
        ("<VTKFile type=\"PolyData\">".to_owned(), "line 1: not a legacy VTK file"),
        (body.replace("Version 3.0", "Version 6.0"), "line 1: not a legacy VTK file"),
        (body.replace("ASCII", "MORSE"), "line 3: the third line is neither ASCII nor BINARY"),
        (body.replace("POLYDATA", "STRUCTURED_GRID"), "line 4: 'STRUCTURED_GRID': POLYDATA and"),
        (body.replace("float", "string"), "line 5: the type 'string' is not read"),
        (body.replace("4 float", "four float"), "line 5: the number of points: 'four'"),
        (body.replace("1.5", "inf"), "line 6: a coordinate of a point: inf is not finite"),
        (body.replace("1.5", "x"), "line 6: a coordinate of a point: 'x' is no number"),
        (body.replace("3 2 1 3", "3 2 1 4"), "line 10: vertex 4 is named, there are 4"),
        (body.replace("3 2 1 3", "3 2 1 -1"), "line 10: -1 is no vertex"),
        (body.replace("3 2 1 3", "2 2 1 3"), "line 10: the cells leave 1 numbers"),
        (body.replace("3 2 1 3", "4 2 1 3"), "line 10: the cell has more corners"),
        (body.replace("3 2 1 3", "3 2 1"), "line 11: the file ends where a corner"),
        (body.replace("2 8\n3 0 1 2\n3 2 1 3", "1 3\n2 0 1"), "line 9: a face of 2 corners"),
        (
            body.replace("POLYGONS 2 8\n3 0 1 2\n3 2 1 3", "TRIANGLE_STRIPS 1 3\n2 0 1"),
            "line 9: a strip of 2",
        ),
        (body.replace("POLYGONS", "CELLS"), "line 8: 'CELLS' does not begin a section"),
        (format!("{body}SCALARS a float\nLOOKUP_TABLE default\n1 2\n"), "before POINT_DATA or CELL_DATA"),
        (format!("{body}CELL_DATA 3\n1\n2\n3\n"), "line 12: '1' does not begin a section"),
        (
            format!("{body}CELL_DATA 1\nSCALARS a float\nLOOKUP_TABLE default\n1\n"),
            "values for 1 cells, there are 2",
        ),
        (
            format!("{body}POINT_DATA 1\nSCALARS a float\nLOOKUP_TABLE d\n1\n"),
            "values for 1 points, there are 4",
        ),
        (format!("{body}CELL_DATA 2\nSCALARS a float\nLOOKUP_TABLE d\n10"), "the file ends where a value"),
        (format!("{grid}{POINTS}CELLS 1 4\n3 0 1 2\nCELL_TYPES 2\n5 5\n"), "2 kinds of cells for 1 cells"),
        (format!("{grid}{POINTS}CELLS 1 4\n3 0 1 2\n"), "0 kinds of cells for 1 cells"),
        (
            format!("{grid}{POINTS}CELLS 1 4\n3 0 1 2\nCELL_TYPES 1\n9\n"),
            "line 9: a cell of kind 9 with 3 corners",
        ),
        (format!("{HEAD}{POINTS}"), "a.vtk: the mesh has no triangle"),
    ];
    for (text, expected) in wrong {
        let error = read(&text).map(|_| ()).unwrap_err();
        assert!(error.contains(expected), "{text}: {error}");
    }
    let five = HEAD.replace("3.0", "5.1");
    for (offsets, corners) in [
        ("0 3 7", "0 1 2 2 1 3"),
        ("1 3 6", "0 1 2 2 1 3"),
        ("0 4 3", "0 1 2 2 1 3"),
        ("0 3 5", "0 1 2 2 1 3"),
    ] {
        let text = format!(
            "{five}{POINTS}POLYGONS 3 6\nOFFSETS vtktypeint64\n{offsets}\nCONNECTIVITY vtktypeint64\n{corners}\n"
        );
        assert!(read(&text).unwrap_err().contains("offset"), "{text}");
    }
    let error = read(&binary(false)[..120]).unwrap_err();
    assert!(error.contains("byte 117: the file ends at byte 120"), "{error}");
}

#[test]
fn declared_sizes_are_not_believed() {
    let body = format!(
        "{HEAD}{POINTS}POLYGONS 2 8\n3 0 1 2\n3 2 1 3\nCELL_DATA 2\nSCALARS a float\nLOOKUP_TABLE d\n1 2\nFIELD f 1\nb 1 2 float\n1 2\n"
    );
    let declared = ["POINTS 4", "POLYGONS 2", "POLYGONS 2 8", "CELL_DATA 2", "FIELD f 1", "b 1", "b 1 2"];
    for count in
        ["2147483648", "4294967295", "9223372036854775808", "18446744073709551615", "99999999999999999999"]
    {
        for place in declared {
            let (before, _) = place.rsplit_once(' ').unwrap();
            let text = body.replace(place, &format!("{before} {count}"));
            assert!(text != body && read(&text).is_err(), "{text}");
            let binary = text.replace("ASCII", "BINARY");
            assert!(read(binary).is_err());
        }
    }
    assert!(read(body).is_ok());
}
