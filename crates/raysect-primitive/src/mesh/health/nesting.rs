use raysect_math::Point3D;

use super::super::MeshData;

/// How often the shells other than its own wind round the point of each shell, positive where fronts look outward.
///
/// The crossings of the ray along +z are counted with the sign of the front. Points are sorted by x, so that each
/// triangle finds those below it. A triangle counts by the crossing number of its outline in the plane with half-open
/// edges, each computed the same way from both of its sides: no edge is crossed twice or missed (M. Shimrat,
/// *Algorithm 112: Position of Point Relative to Polygon*, 1962).
pub(super) fn windings(mesh: &MeshData, shell_of: &[u32], points: &[Point3D]) -> Vec<i64> {
    let mut order: Vec<usize> = (0..points.len()).collect();
    order.sort_unstable_by(|&a, &b| points[a].x.total_cmp(&points[b].x));
    let mut windings = vec![0; points.len()];
    for (triangle, &shell) in shell_of.iter().enumerate() {
        let corners = mesh.corners(triangle);
        let [low, high] = range(corners.map(|p| p.x));
        let [bottom, top] = range(corners.map(|p| p.y));
        let first = order.partition_point(|&p| points[p].x < low);
        for &p in order[first..].iter().take_while(|&&p| points[p].x <= high) {
            let point = points[p];
            if p != shell as usize && point.y >= bottom && point.y <= top {
                windings[p] += crossing(corners, point);
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
