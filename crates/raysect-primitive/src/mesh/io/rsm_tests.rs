use super::*;

fn read(bytes: &[u8]) -> Result<(MeshData, RsmFlags), String> {
    parse(bytes, 1.0).map_err(|fault| fault.in_file(Path::new("a.rsm")).to_string())
}

fn sheet() -> MeshData {
    let corners = [[0.0, 0.0, 0.25], [1.5, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 1.0, -3.0]];
    MeshData::new(corners, [[0, 1, 2], [2, 1, 3]]).unwrap()
}

#[test]
fn numbers_of_32_bits_come_back() {
    let normals = [[0.0, 0.0, 1.0], [0.0, -1.0, 0.0]];
    let smooth = sheet().with_normals(normals, [[0, 0, 1], [1, 1, 0]]).unwrap();
    for mesh in [sheet(), smooth] {
        for flags in [
            RsmFlags::default(),
            RsmFlags { smoothing: false, closed: true },
            RsmFlags { smoothing: true, closed: false },
        ] {
            assert_eq!(read(&encode(&mesh, flags).unwrap()), Ok((mesh.clone(), flags)));
        }
    }
    let many: Vec<[f64; 3]> =
        (0..3000).map(|k| [f64::from(k % 97), f64::from(k * k % 89), f64::from(k % 83)]).collect();
    let many = MeshData::new(many, (0..1000).map(|t| [3 * t, 3 * t + 1, 3 * t + 2])).unwrap();
    let bytes = encode(&many, RsmFlags::default()).unwrap();
    assert!(read(&bytes).unwrap().0 == many);
    // The tree has branches.
    let start = 8 + 12 + 12 * 3000 + 12 * 1000 + 24 + 48 + 4;
    assert!((0..3).contains(&i32::from_le_bytes(bytes[start..start + 4].try_into().unwrap())));
}

#[test]
fn what_the_format_cannot_hold_is_told_or_left_out() {
    let flags = RsmFlags::default();
    let far = sheet().scaled(1e39).unwrap();
    assert!(encode(&far, flags).unwrap_err().contains("vertex 1 is beyond"));
    let tiny = [[1.0, 0.0, 0.0], [1.0 + 1e-12, 0.0, 0.0], [1.0, 1e-12, 0.0], [0.0, 1.0, 0.0]];
    let thin = MeshData::new(tiny, [[0, 1, 2], [0, 2, 3]]).unwrap();
    assert!(thin.clone().without_degenerate().is_ok_and(|(_, dropped)| dropped == 0));
    assert_eq!(read(&encode(&thin, flags).unwrap()).unwrap().0.triangles(), [[0, 2, 3]]);
    let point = MeshData::new(tiny, [[0, 1, 2]]).unwrap();
    assert!(encode(&point, flags).unwrap_err().contains("no triangle"));
}

#[test]
fn faults_name_their_byte() {
    let bytes = encode(&sheet(), RsmFlags::default()).unwrap();
    let with = |at: usize, new: &[u8]| {
        let mut wrong = bytes.clone();
        wrong[at..at + new.len()].copy_from_slice(new);
        read(&wrong).unwrap_err()
    };
    let triangles = 20 + 4 * 12;
    let tree = triangles + 2 * 12;
    assert!(with(0, b"rsm").starts_with("a.rsm: byte 0: not a Raysect mesh"));
    assert!(with(3, &[2]).contains("byte 3: version 2.0 of RSM"));
    assert!(with(6, &[2]).contains("byte 6: a flag is 0 or 1"));
    assert!(with(8, &[0xff; 4]).contains("byte 8: the number of vertices: -1 is negative"));
    for count in [i32::MAX, 1 << 20] {
        for at in [8, 12, 16, tree + 72] {
            assert!(with(at, &count.to_le_bytes()).contains("should follow"), "{at}");
        }
    }
    assert!(with(24, &f32::NAN.to_le_bytes()).contains("byte 24: a vertex: NaN"));
    assert!(with(triangles + 12, &4i32.to_le_bytes()).contains("byte 80: vertex 4 is named, there are 4"));
    assert!(with(triangles + 16, &(-1i32).to_le_bytes()).contains("byte 84: the index -1 is negative"));
    assert!(with(tree + 76, &3i32.to_le_bytes()).contains(&format!("byte {}: a node", tree + 76)));
    assert!(with(7, &[0]).contains(&format!("byte {tree}: ")));
    let more = [bytes.as_slice(), &[0]].concat();
    assert!(read(&more).unwrap_err().contains("1 bytes follow the end"));
}
