use super::*;
use raysect_math::Point3D;

/// A cube of edge 2 about a centre, fronts outward.
fn cube(centre: [f64; 3]) -> (Vec<[f64; 3]>, Vec<[u32; 3]>) {
    let corner = |i: u32| {
        let sign = |bit: u32| if i & bit == 0 { -1.0 } else { 1.0 };
        [centre[0] + sign(1), centre[1] + sign(2), centre[2] + sign(4)]
    };
    let quads = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    let triangles = quads.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect();
    ((0..8).map(corner).collect(), triangles)
}

fn mesh((vertices, triangles): (Vec<[f64; 3]>, Vec<[u32; 3]>)) -> MeshData {
    MeshData::new(vertices, triangles).unwrap()
}

/// Both in one mesh.
fn both(a: &MeshData, b: &MeshData) -> MeshData {
    let shift = a.vertex_count() as u32;
    let vertices = a.vertices().iter().chain(b.vertices()).copied();
    let moved = b.triangles().iter().map(|t| t.map(|v| v + shift));
    MeshData::new(vertices.collect::<Vec<Point3D>>(), a.triangles().iter().copied().chain(moved)).unwrap()
}

fn soup(m: &MeshData) -> MeshData {
    let corners = (0..m.triangle_count()).flat_map(|t| m.corners(t));
    let triangles = (0..m.triangle_count() as u32).map(|t| [3 * t, 3 * t + 1, 3 * t + 2]);
    MeshData::new(corners, triangles).unwrap()
}

#[test]
fn a_cube_is_sound() {
    let sound = mesh(cube([5.0, -3.0, 1.0]));
    for health in [sound.health(), soup(&sound).health()] {
        assert!(health.is_solid() && health.is_manifold());
        assert_eq!((health.volume(), health.surface_area), (Some(8.0), 24.0));
        assert_eq!((health.shells, health.closed_shells), (1, 1));
        assert_eq!(health.bounding_box.lower, Point3D::new(4.0, -4.0, 0.0));
    }
    assert_eq!(soup(&sound).health().unmerged_vertices, 28);
    assert_eq!(soup(&sound).weld().health().unmerged_vertices, 0);
    let text = sound.health().to_string();
    assert!(
        text.contains("watertight            yes") && text.ends_with("volume                8 m³"),
        "{text}"
    );
    assert!(!text.contains("boundary"), "{text}");
}

#[test]
fn a_missing_triangle_is_a_hole() {
    let (vertices, mut triangles) = cube([0.0; 3]);
    triangles.pop();
    let health = mesh((vertices, triangles)).health();
    assert!(!health.is_watertight() && !health.is_outward() && health.is_manifold());
    assert!(health.is_consistently_oriented());
    assert_eq!((health.boundary_edges, health.closed_shells, health.volume()), (3, 0, None));
    assert!(health.to_string().contains("boundary edges        3"));
}

#[test]
fn fronts_that_look_inward_are_told() {
    let inward = mesh(cube([0.0; 3])).flipped().health();
    assert!(inward.is_watertight() && inward.is_consistently_oriented() && !inward.is_outward());
    assert_eq!((inward.volume(), inward.misdirected_shells), (Some(-8.0), 1));
    let (vertices, mut triangles) = cube([0.0; 3]);
    triangles[3].swap(0, 1);
    let mixed = mesh((vertices, triangles)).health();
    assert_eq!((mixed.inconsistent_edges, mixed.volume()), (3, None));
    assert!(mixed.is_watertight() && !mixed.is_consistently_oriented());
}

#[test]
fn cavities_look_inward_and_neighbours_do_not() {
    let outer = mesh(cube([0.0; 3])).scaled(3.0).unwrap();
    let inner = mesh(cube([0.0; 3]));
    let hollow = both(&outer, &inner.clone().flipped()).health();
    assert!(hollow.is_solid(), "{hollow}");
    assert_eq!((hollow.volume(), hollow.closed_shells), (Some(208.0), 2));
    assert_eq!(both(&outer, &inner).health().misdirected_shells, 1);
    // A ball in the cavity is a solid again, beside it the inversion shows although the sum is positive.
    let core = inner.clone().scaled(0.5).unwrap();
    assert!(both(&both(&core, &outer), &inner.clone().flipped()).health().is_solid());
    assert!(!both(&both(&core.flipped(), &outer), &inner.flipped()).health().is_solid());
    let beside = mesh(cube([10.0, 0.0, 0.0])).flipped();
    assert_eq!(both(&outer, &beside).health().misdirected_shells, 1);
    // Above and below, at the same x and y as corners and edges.
    for z in [-20.0, 20.0] {
        assert!(both(&outer, &mesh(cube([0.0, 0.0, z]))).health().is_solid());
        assert!(both(&outer, &mesh(cube([2.0, 2.0, z]))).health().is_solid());
    }
}

#[test]
fn shells_that_touch_are_told_apart() {
    let big = mesh(cube([0.0; 3])).scaled(3.0).unwrap();
    let at = |p: [f64; 3], first: usize| {
        let small = mesh(cube([0.0; 3]));
        let image = small.vertices().iter().map(|v| [v.x + p[0], v.y + p[1], v.z + p[2]]);
        let mut triangles = small.triangles().to_vec();
        triangles.rotate_left(2 * first);
        MeshData::new(image.collect::<Vec<_>>(), triangles).unwrap()
    };
    for axis in 0..3 {
        for side in [-1.0, 1.0] {
            // Flush with other faces too, or with none.
            for (first, along) in (0..6).flat_map(|face| [0.0, 0.3, 2.0, -2.0].map(|along| (face, along))) {
                let mut place = [along; 3];
                place[axis] = 4.0 * side;
                let outside = at(place, first);
                assert!(both(&big, &outside).health().is_solid(), "{place:?}");
                assert_eq!(both(&big, &outside.flipped()).health().misdirected_shells, 1, "{place:?}");
                place[axis] = 2.0 * side;
                let inside = at(place, first);
                assert!(both(&big, &inside.clone().flipped()).health().is_solid(), "{place:?}");
                assert_eq!(both(&big, &inside).health().misdirected_shells, 1, "{place:?}");
            }
        }
    }
}

#[test]
fn touching_in_an_edge_or_a_corner_is_not_manifold() {
    let a = mesh(cube([0.0; 3]));
    let edge = both(&a, &mesh(cube([2.0, 2.0, 0.0]))).health();
    assert!(edge.is_solid() && !edge.is_manifold());
    assert_eq!((edge.non_manifold_edges, edge.unmerged_vertices, edge.shells), (1, 2, 1));
    let corner = both(&a, &mesh(cube([2.0, 2.0, 2.0]))).health();
    assert_eq!((corner.non_manifold_edges, corner.touching_vertices, corner.shells), (0, 1, 2));
    assert!(corner.is_solid() && !corner.is_manifold());
}

#[test]
fn degenerate_and_duplicate_triangles_are_counted() {
    let (mut vertices, mut triangles) = cube([0.0; 3]);
    vertices.push([9.0; 3]);
    triangles.extend([[0, 0, 1], triangles[0], [1, 3, 5]]);
    let health = mesh((vertices, triangles)).health();
    assert_eq!((health.degenerate_triangles, health.duplicate_triangles), (1, 1));
    assert_eq!((health.unused_vertices, health.is_solid()), (1, false));
    // A triangle on a line closes the seam between an edge and its two halves.
    let line = [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0, 0.0, 2.0], [1.0, 0.0, 0.0]];
    let halves = [[0, 2, 4], [4, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]];
    assert_eq!(MeshData::new(line, halves).unwrap().health().boundary_edges, 3);
    let seam = MeshData::new(line, halves.into_iter().chain([[0, 4, 1]])).unwrap().health();
    assert!(seam.is_solid() && seam.degenerate_triangles == 1, "{seam}");
    assert!((seam.volume().unwrap() - 8.0 / 6.0).abs() < 1e-15);
}

#[test]
fn volumes_hold_at_every_size_and_far_away() {
    for scale in [1e-100, 1e-9, 1e9, 1e100] {
        let health = mesh(cube([0.0; 3])).scaled(scale).unwrap().health();
        let expected = 8.0 * scale.powi(3);
        assert!((health.volume().unwrap() - expected).abs() <= 1e-14 * expected, "{scale}");
    }
    let far = mesh(cube([1e12, 1e12, -1e12])).health();
    assert_eq!(far.volume(), Some(8.0));
}
