use raysect_math::Point3D;

use super::super::MeshData;

/// How often the shells other than its own wind round each point of a shell, positive where fronts look outward.
///
/// The crossings of the ray along +z are counted with the sign of the front. Points are sorted by x, so that each
/// triangle finds those below it. A triangle counts by the crossing number of its outline in the plane with half-open
/// edges, each computed the same way from both of its sides: no edge is crossed twice or missed (M. Shimrat,
/// *Algorithm 112: Position of Point Relative to Polygon*, 1962).
pub(super) fn windings(mesh: &MeshData, shell_of: &[u32], points: &[(usize, Point3D)]) -> Vec<i64> {
    let mut order: Vec<usize> = (0..points.len()).collect();
    order.sort_unstable_by(|&a, &b| points[a].1.x.total_cmp(&points[b].1.x));
    let mut windings = vec![0; points.len()];
    for (triangle, &shell) in shell_of.iter().enumerate() {
        let corners = mesh.corners(triangle);
        let [low, high] = range(corners.map(|p| p.x));
        let [bottom, top] = range(corners.map(|p| p.y));
        let first = order.partition_point(|&k| points[k].1.x < low);
        for &k in order[first..].iter().take_while(|&&k| points[k].1.x <= high) {
            let (own, point) = points[k];
            if own != shell as usize && point.y >= bottom && point.y <= top {
                windings[k] += crossing(corners, point);
            }
        }
    }
    windings
}

fn range([a, b, c]: [f64; 3]) -> [f64; 2] {
    [a.min(b).min(c), a.max(b).max(c)]
}

/// 1 or -1 if the ray from a point along +z crosses a triangle from the back or from the front, otherwise 0.
fn crossing(corners: [Point3D; 3], point: Point3D) -> i64 {
    let [a, b, c] = corners;
    let sides = [(a, b), (b, c), (c, a)];
    // The sense of the outline: an edge to the right of the point counts by whether it climbs.
    let turns: i64 = sides.iter().map(|&(p, q)| turn(p, q, point)).sum();
    if turns != 0 && height(corners, point) > point.z { turns } else { 0 }
}

/// 1 or -1 if an edge passes the point on the side of greater x, upward or downward.
fn turn(p: Point3D, q: Point3D, point: Point3D) -> i64 {
    let (above_p, above_q) = (p.y > point.y, q.y > point.y);
    if above_p == above_q {
        return 0;
    }
    let (low, high) = if above_q { (p, q) } else { (q, p) };
    let x = low.x + (high.x - low.x) * ((point.y - low.y) / (high.y - low.y));
    if point.x >= x {
        return 0;
    }
    if above_q { 1 } else { -1 }
}

/// Where the vertical line through a point of the outline meets the plane of a triangle.
fn height([a, b, c]: [Point3D; 3], point: Point3D) -> f64 {
    let (u, v) = (a.vector_to(b), a.vector_to(c));
    let n = u.cross(v);
    let w = a.vector_to(point);
    a.z - (n.x * w.x + n.y * w.y) / n.z
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_in_line_with_edges_and_corners_are_wound_round_once() {
        // A cube of edge 2 whose faces have a corner in the middle.
        let corner = |i: u32| [1, 2, 4].map(|bit| if i & bit == 0 { -1.0 } else { 1.0 });
        let quads = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
        let mut vertices: Vec<[f64; 3]> = (0..8).map(corner).collect();
        let mut triangles = Vec::new();
        for quad in quads {
            let middle = vertices.len() as u32;
            triangles.extend((0..4).map(|k| [quad[k], quad[(k + 1) % 4], middle]));
            let mean = |axis: usize| quad.iter().map(|&v| vertices[v as usize][axis]).sum::<f64>() / 4.0;
            vertices.push([mean(0), mean(1), mean(2)]);
        }
        let cube = MeshData::new(vertices, triangles).unwrap();
        assert!(cube.health().is_solid());
        let places = [-1.0, -0.5, 0.0, 0.5, 1.0];
        let mut inside = 0;
        for (x, y) in places.iter().flat_map(|&x| places.map(|y| (x, y))) {
            let around = |z: f64| windings(&cube, &[0; 24], &[(1, Point3D::new(x, y, z))])[0];
            assert_eq!((around(-3.0), around(3.0)), (0, 0), "{x} {y}");
            // On the rim either answer will do.
            assert!(around(0.5) == 1 || x.abs() == 1.0 || y.abs() == 1.0, "{x} {y}");
            inside += around(0.5);
        }
        assert!((9..=25).contains(&inside));
    }
}
