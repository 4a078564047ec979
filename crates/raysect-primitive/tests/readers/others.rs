//! Files by Raysect and VTK give the meshes they were made of.

use raysect_math::{Normal3D, Point3D};
use raysect_primitive::mesh::io::{MeshFormat, RsmFlags, import_rsm, import_vtk_with_scalars};
use raysect_primitive::{MeshData, MeshError};

use crate::{Folder, files};

fn tetrahedron() -> MeshData {
    let corners = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.5]];
    MeshData::new(corners, [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]]).unwrap()
}

/// The quadrilateral is cut from its first corner, or from its second as VTK does it for STL.
fn sheet(cut_from_second: bool) -> MeshData {
    let corners = [
        [0.0, 0.0, 0.0],
        [1.0, 0.0, 0.0],
        [1.0, 1.0, 0.1],
        [0.0, 1.0, 0.0],
        [2.0, 0.0, 0.0],
        [2.0, 1.0, 0.0],
    ];
    let quad = if cut_from_second { [[0, 1, 3], [1, 2, 3]] } else { [[0, 1, 2], [0, 2, 3]] };
    MeshData::new(corners, quad.into_iter().chain([[1, 4, 2], [4, 5, 2]])).unwrap()
}

/// The corners of all triangles, the least first, in order.
fn triangles(mesh: &MeshData) -> Vec<[[f64; 3]; 3]> {
    let mut triangles: Vec<_> =
        (0..mesh.triangle_count()).map(|t| mesh.corners(t).map(Point3D::to_array)).collect();
    for t in &mut triangles {
        let least = (0..3).min_by(|&a, &b| t[a].partial_cmp(&t[b]).unwrap()).unwrap();
        t.rotate_left(least);
    }
    triangles.sort_by(|a, b| a.partial_cmp(b).unwrap());
    triangles
}

fn agree(a: &MeshData, b: &MeshData, tolerance: f64) -> bool {
    let (a, b) = (triangles(a), triangles(b));
    let close = |(x, y): (&f64, &f64)| (x - y).abs() <= tolerance;
    a.len() == b.len()
        && a.as_flattened().as_flattened().iter().zip(b.as_flattened().as_flattened()).all(close)
}

#[test]
fn every_file_gives_its_shape() {
    for (path, format) in files() {
        let mesh = MeshData::load(&path, 1.0).unwrap();
        let name = path.file_name().unwrap().to_str().unwrap();
        // VTK writes 0.1 as a 32-bit number into PLY and STL.
        let (expected, other, tolerance) = match name.starts_with("raysect") {
            true => (tetrahedron(), sheet(false), 0.0),
            false => (sheet(format == MeshFormat::Stl), tetrahedron(), 2e-9),
        };
        assert!(agree(&mesh, &expected, tolerance), "{name}: {mesh:?}");
        assert!(!agree(&mesh, &other, 0.4) && !agree(&mesh, &expected.flipped(), 1e-3), "{name}");
        let small = MeshData::load(&path, 0.001).unwrap();
        assert_eq!(small.vertices()[1].x, mesh.vertices()[1].x * 0.001, "{name}");
    }
}

#[test]
fn normals_flags_and_scalars_come_along() {
    for (path, format) in files() {
        let name = path.file_name().unwrap().to_str().unwrap();
        let mesh = MeshData::load(&path, 1.0).unwrap();
        match name {
            "raysect_smooth.obj" | "raysect_smooth.rsm" => {
                let third = 1.0 / 3f64.sqrt();
                let expected = [[0.0, 0.0, -1.0], [0.0, -1.0, 0.0], [third; 3], [-1.0, 0.0, 0.0]];
                for (t, n) in expected.into_iter().enumerate() {
                    let found = mesh.corner_normals(t).unwrap()[1];
                    assert!((found - Normal3D::from(n)).length() < 1e-7, "{name} {t} {found:?}");
                }
            }
            "vtk.obj" => assert_eq!(mesh.corner_normals(3), Some([Normal3D::new(0.0, 0.0, 1.0); 3])),
            _ if name.starts_with("vtk") && format == MeshFormat::Vtk => {
                let (_, scalars) = import_vtk_with_scalars(&path, 1.0).unwrap();
                let names: Vec<&str> = scalars.iter().map(|s| s.name.as_str()).collect();
                assert_eq!(names, ["power density", "count"], "{name}");
                // The line has the first value, the quadrilateral's two triangles the second.
                let expected = [0.1, 0.1, 1.0 / 3.0, 7.0];
                let close = |(a, b): (&f64, &f64)| (a - b).abs() < 1e-11;
                assert!(scalars[0].values.iter().zip(&expected).all(close), "{name} {scalars:?}");
                assert_eq!(scalars[1].values, [3.0, 3.0, 2.0, 1.0]);
                assert!(mesh.corner_normals(0).is_some());
            }
            _ => assert_eq!(mesh.vertex_normals(), None, "{name}"),
        }
        if format == MeshFormat::Rsm {
            let closed = name == "raysect.rsm";
            let expected = RsmFlags { smoothing: !closed, closed };
            assert_eq!(import_rsm(&path, 1.0).unwrap().1, expected);
        }
        if name == "raysect.vtk" {
            let scalars = import_vtk_with_scalars(&path, 1.0).unwrap().1;
            assert_eq!((scalars[0].name.as_str(), scalars.len()), ("power_density", 1));
            assert_eq!(scalars[0].values, [1.0, 2.5, -3e-7, 4.0]);
        }
    }
}

#[test]
fn files_are_known_by_name_or_first_bytes() {
    let folder = Folder::new("known");
    for (path, format) in files() {
        let bytes = std::fs::read(&path).unwrap();
        let expected = (format != MeshFormat::Obj).then_some(format);
        assert_eq!(MeshFormat::of_bytes(&bytes), expected, "{}", path.display());
        let (plain, capitals) = (
            folder.join("mesh"),
            folder.join("MESH").with_extension(path.extension().unwrap().to_ascii_uppercase()),
        );
        std::fs::write(&plain, &bytes).unwrap();
        std::fs::write(&capitals, &bytes).unwrap();
        assert!(MeshData::load(&capitals, 1.0).is_ok());
        match MeshData::load(&plain, 1.0) {
            Ok(_) => assert!(expected.is_some()),
            Err(error) => assert_eq!((error, expected), (MeshError::UnknownFormat { path: plain }, None)),
        }
    }
    let missing = MeshData::load(folder.join("none.obj"), 1.0).unwrap_err();
    assert!(matches!(missing, MeshError::Io { kind: std::io::ErrorKind::NotFound, .. }));
    assert!(missing.to_string().contains("none.obj: "));
    std::fs::create_dir(folder.join("folder.stl")).unwrap();
    assert!(matches!(MeshData::load(folder.join("folder.stl"), 1.0), Err(MeshError::Io { .. })));
    assert!(matches!(tetrahedron().save(folder.join("a.gltf")), Err(MeshError::UnknownFormat { .. })));
}

#[test]
fn saved_files_load_again() {
    let folder = Folder::new("saved");
    for extension in ["obj", "stl", "ply", "vtk", "rsm"] {
        let path = folder.join("mesh").with_extension(extension);
        tetrahedron().save(&path).unwrap();
        let again = MeshData::load(&path, 1.0).unwrap();
        assert!(agree(&again, &tetrahedron(), 0.0), "{extension}");
        assert!(again.health().is_solid(), "{extension}");
    }
}
