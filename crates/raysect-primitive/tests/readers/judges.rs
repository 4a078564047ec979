//! Two crates that read OBJ and STL by other means see the same meshes.

use raysect_math::{Point3D, Rng};
use raysect_primitive::MeshData;
use raysect_primitive::mesh::io::{MeshEncoding, export_obj, export_stl, import_obj, import_stl};

use crate::Folder;

/// Triangles between random vertices, which are 32-bit numbers if `single`.
fn random_mesh(seed: u64, single: bool) -> MeshData {
    let mut rng = Rng::new(seed);
    let coordinate = |rng: &mut Rng| {
        let x = (rng.uniform() - 0.5) * 10f64.powf(6.0 * rng.uniform() - 3.0);
        if single { f64::from(x as f32) } else { x }
    };
    let vertices: Vec<Point3D> = (0..200)
        .map(|_| Point3D::new(coordinate(&mut rng), coordinate(&mut rng), coordinate(&mut rng)))
        .collect();
    let normals: Vec<[f64; 3]> = (0..50).map(|_| [rng.uniform(), rng.uniform(), rng.uniform()]).collect();
    let index = |rng: &mut Rng, n: f64| (rng.uniform() * n) as u32;
    let triple = |rng: &mut Rng, n: f64| [index(rng, n), index(rng, n), index(rng, n)];
    let triangles: Vec<[u32; 3]> = (0..500).map(|_| triple(&mut rng, 200.0)).collect();
    let of_normals: Vec<[u32; 3]> = (0..500).map(|_| triple(&mut rng, 50.0)).collect();
    MeshData::new(vertices, triangles).unwrap().with_normals(normals, of_normals).unwrap()
}

#[test]
fn tobj_sees_the_same_triangles_and_normals() {
    let folder = Folder::new("tobj");
    let path = folder.join("a.obj");
    for seed in 0..5 {
        let mesh = random_mesh(seed, false);
        export_obj(&path, &mesh).unwrap();
        let (models, _) = tobj::load_obj(&path, &tobj::LoadOptions::default()).unwrap();
        let [model] = models.as_slice() else { panic!("{} models", models.len()) };
        let (points, _) = model.mesh.positions.as_chunks::<3>();
        let (normals, _) = model.mesh.normals.as_chunks::<3>();
        let ours = import_obj(&path, 1.0).unwrap();
        assert!(ours.vertices() == mesh.vertices() && ours.triangles() == mesh.triangles());
        let corners = model.mesh.indices.iter().zip(&model.mesh.normal_indices);
        let corners: Vec<_> = corners.map(|(&v, &n)| (points[v as usize], normals[n as usize])).collect();
        assert_eq!(corners.len(), 1500);
        for (triangle, theirs) in corners.as_chunks::<3>().0.iter().enumerate() {
            let (place, normal) = (ours.corners(triangle), mesh.corner_normals(triangle).unwrap());
            for k in 0..3 {
                assert_eq!((theirs[k].0, theirs[k].1), (place[k].to_array(), normal[k].to_array()));
            }
        }
    }
}

#[test]
fn stl_io_sees_the_same_triangles() {
    let folder = Folder::new("stl");
    let path = folder.join("a.stl");
    for encoding in [MeshEncoding::Binary, MeshEncoding::Ascii] {
        let mesh = random_mesh(9, true);
        export_stl(&path, &mesh, encoding).unwrap();
        let theirs = stl_io::read_stl(&mut std::fs::File::open(&path).unwrap()).unwrap();
        let ours = import_stl(&path, 1.0).unwrap();
        assert_eq!((theirs.faces.len(), ours.triangle_count()), (500, 500));
        for (triangle, face) in theirs.faces.iter().enumerate() {
            let corners = face.vertices.map(|v| theirs.vertices[v]);
            for (k, place) in ours.corners(triangle).into_iter().enumerate() {
                assert_eq!(place, mesh.corners(triangle)[k]);
                assert_eq!(place.to_array(), [0, 1, 2].map(|axis| f64::from(corners[k][axis])));
            }
        }
        // The other way round.
        let triangles: Vec<stl_io::Triangle> = (0..500)
            .map(|t| stl_io::Triangle {
                normal: stl_io::Normal::new([0.0; 3]),
                vertices: mesh.corners(t).map(|p| stl_io::Vertex::new(p.to_array().map(|x| x as f32))),
            })
            .collect();
        stl_io::write_stl(&mut std::fs::File::create(&path).unwrap(), triangles.iter()).unwrap();
        let again = import_stl(&path, 1.0).unwrap();
        assert!((0..500).all(|t| again.corners(t) == mesh.corners(t)));
    }
}
